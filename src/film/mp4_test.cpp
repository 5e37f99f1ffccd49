#include "film/mp4.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/test_folder.h"

namespace scumble::film {
namespace {

std::string number(uint64_t value, int size = 4) {
  std::string bytes;
  for (int i = size; i-- > 0;) bytes += char(value >> (8 * i));
  return bytes;
}
std::string box(const std::string& type, const std::string& content) {
  return number(content.size() + 8) + type + content;
}

// The film of two chunks that these tests are about, laid out as ffmpeg does: index last.
const std::string kAvcC = box("avcC", "1234"), kColr = box("colr", "5678");
const std::string kKind = box("ftyp", "isom"), kFirst = "first chunk", kSecond = "the second";

std::string indexFor(uint64_t first, bool wide, uint32_t frames = 2) {
  const int width = wide ? 8 : 4;
  const std::string entry = box("avc1", std::string(78, 'f') + kAvcC + kColr);
  const std::string table =
      box("stsd", number(0) + number(1) + entry) + box("stsz", number(0) + number(0) + number(frames)) +
      box(wide ? "co64" : "stco",
          number(0) + number(2) + number(first, width) + number(first + kFirst.size(), width));
  return box("moov", box("mvhd", "clock") + box("trak", box("mdia", box("minf", box("stbl", table)))));
}
std::string filmOf(bool wide, bool longHeader) {
  const std::string data = kFirst + kSecond;
  const std::string mdat =
      longHeader ? number(1) + "mdat" + number(data.size() + 16, 8) + data : box("mdat", data);
  const std::string before = kKind + (longHeader ? "" : box("free", ""));
  return before + mdat + indexFor(before.size() + (longHeader ? 16 : 8), wide);
}

struct Outcome {
  std::string problem, film;
};
Outcome rearranged(const std::string& film, FilmLayout layout, uint64_t frames = 2) {
  TestFolder folder;
  putContent(folder.file("in"), film);
  const int in = open(folder.file("in").c_str(), O_RDONLY | O_CLOEXEC);
  WholeFile out(folder.file("out"));
  Outcome outcome;
  outcome.problem = rearrangeMp4(in, layout, frames, out);
  close(in);
  if (outcome.problem.empty() && out.commit()) outcome.film = contentOf(folder.file("out"));
  return outcome;
}

TEST(Mp4, indexComesInFrontAndPointsToTheSameBytes) {
  for (const bool wide : {false, true})
    for (const bool longHeader : {false, true}) {
      const Outcome outcome = rearranged(filmOf(wide, longHeader), FilmLayout::mono);
      ASSERT_EQ(outcome.problem, "");
      const size_t first = outcome.film.find(kFirst);
      // Places need 64 bits in large files only.
      EXPECT_EQ(outcome.film.substr(0, outcome.film.find("mdat") - 4), kKind + indexFor(first, false));
      EXPECT_EQ(outcome.film.substr(first), kFirst + kSecond);
    }
}

TEST(Mp4, layoutStandsInTheVideosDescription) {
  for (const FilmLayout layout : {FilmLayout::sideBySide, FilmLayout::overUnder}) {
    const Outcome outcome = rearranged(filmOf(false, false), layout);
    ASSERT_EQ(outcome.problem, "");
    const char mode = layout == FilmLayout::overUnder ? 1 : 2;
    const std::string stereo = box("st3d", number(0) + mode);
    EXPECT_NE(outcome.film.find(kAvcC + stereo + kColr), std::string::npos);
    // Every box around it has grown.
    std::string without = outcome.film;
    without.erase(without.find(stereo), stereo.size());
    const std::string mono = rearranged(filmOf(false, false), FilmLayout::mono).film;
    ASSERT_EQ(without.size(), mono.size());
    for (const char* name : {"moov", "trak", "mdia", "minf", "stbl", "stsd", "avc1"}) {
      const size_t size = without.find(name) - 1;
      EXPECT_EQ(uint8_t(without[size]), uint8_t(mono[size] + char(stereo.size()))) << name;
    }
    // Places too.
    const size_t list = outcome.film.find("stco") + 12;
    EXPECT_EQ(outcome.film.substr(list, 4), number(outcome.film.find(kFirst)));
  }
}

TEST(Mp4, whatIsNotTheFilmIsAProblem) {
  const std::string good = filmOf(false, false);
  EXPECT_EQ(rearranged(good, FilmLayout::mono, 3).problem, "it has 2 frames instead of 3");
  EXPECT_NE(rearranged("", FilmLayout::mono).problem, "");
  EXPECT_NE(rearranged(good + good, FilmLayout::mono).problem, "");
  EXPECT_NE(rearranged(kKind + box("mdat", kFirst + kSecond) + indexFor(7, false), FilmLayout::mono).problem,
            "");
  for (size_t size = 0; size < good.size(); ++size)
    ASSERT_NE(rearranged(good.substr(0, size), FilmLayout::sideBySide).problem, "") << size;
}

TEST(Mp4, damageIsNoCrash) {
  const std::string good = filmOf(true, true);
  for (size_t i = 0; i < good.size(); ++i)
    for (const char value : {'\1', '\xff'}) {
      std::string bad = good;
      bad[i] = value;
      rearranged(bad, FilmLayout::overUnder);
    }
}

}  // namespace
}  // namespace scumble::film

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

FilmOptions with(FilmLayout layout, FilmProjection projection = FilmProjection::flat) {
  FilmOptions options;
  options.width = 400, options.height = 200;
  options.layout = layout, options.projection = projection;
  return options;
}
struct Outcome {
  std::string problem, film;
};
Outcome rearranged(const std::string& film, const FilmOptions& options, uint64_t frames = 2) {
  TestFolder folder;
  putContent(folder.file("in"), film);
  const int in = open(folder.file("in").c_str(), O_RDONLY | O_CLOEXEC);
  WholeFile out(folder.file("out"));
  Outcome outcome;
  outcome.problem = rearrangeMp4(in, options, frames, out);
  close(in);
  if (outcome.problem.empty() && out.commit()) outcome.film = contentOf(folder.file("out"));
  return outcome;
}

TEST(Mp4, indexComesInFrontAndPointsToTheSameBytes) {
  for (const bool wide : {false, true})
    for (const bool longHeader : {false, true}) {
      const Outcome outcome = rearranged(filmOf(wide, longHeader), with(FilmLayout::mono));
      ASSERT_EQ(outcome.problem, "");
      const size_t first = outcome.film.find(kFirst);
      // Places need 64 bits in large files only.
      EXPECT_EQ(outcome.film.substr(0, outcome.film.find("mdat") - 4), kKind + indexFor(first, false));
      EXPECT_EQ(outcome.film.substr(first), kFirst + kSecond);
    }
}

TEST(Mp4, layoutStandsInTheVideosDescription) {
  for (const FilmLayout layout : {FilmLayout::sideBySide, FilmLayout::overUnder}) {
    const Outcome outcome = rearranged(filmOf(false, false), with(layout));
    ASSERT_EQ(outcome.problem, "");
    const char mode = layout == FilmLayout::overUnder ? 1 : 2;
    const std::string stereo = box("st3d", number(0) + mode);
    EXPECT_NE(outcome.film.find(kAvcC + stereo + kColr), std::string::npos);
    // Every box around it has grown.
    std::string without = outcome.film;
    without.erase(without.find(stereo), stereo.size());
    const std::string mono = rearranged(filmOf(false, false), with(FilmLayout::mono)).film;
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

// By the words of both versions of the Spherical Video RFC.
TEST(Mp4, aPanoramaSaysSoTwice) {
  struct Case {
    FilmLayout layout;
    FilmProjection projection;
    char mode;
    uint64_t aside;
    std::string xml;
  };
  const auto cropped = [](int width, int height) {
    const auto tag = [](const std::string& name, int value) {
      return "<GSpherical:" + name + ">" + std::to_string(value) + "</GSpherical:" + name + ">";
    };
    return tag("CroppedAreaImageWidthPixels", width) + tag("CroppedAreaImageHeightPixels", height) +
           tag("FullPanoWidthPixels", 2 * width) + tag("FullPanoHeightPixels", height) +
           tag("CroppedAreaLeftPixels", width / 2) + tag("CroppedAreaTopPixels", 0);
  };
  const auto stereo = [](const std::string& mode) {
    return "<GSpherical:StereoMode>" + mode + "</GSpherical:StereoMode>";
  };
  for (const Case& c : {Case{FilmLayout::mono, FilmProjection::sphere, 0, 0, ""},
                        Case{FilmLayout::overUnder, FilmProjection::sphere, 1, 0, stereo("top-bottom")},
                        Case{FilmLayout::sideBySide, FilmProjection::halfSphere, 2, 0x40000000,
                             stereo("left-right") + cropped(200, 200)}}) {
    const Outcome outcome = rearranged(filmOf(false, false), with(c.layout, c.projection));
    ASSERT_EQ(outcome.problem, "");
    const std::string none = number(0);
    const std::string boxes =
        box("st3d", none + c.mode) +
        box("sv3d", box("svhd", none + "scumble" + '\0') +
                        box("proj", box("prhd", none + none + none + none) +
                                        box("equi", none + none + none + number(c.aside) + number(c.aside))));
    EXPECT_NE(outcome.film.find(kAvcC + boxes + kColr), std::string::npos);
    // In the track, behind all else.
    const size_t id =
        outcome.film.find("uuid\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd");
    ASSERT_NE(id, std::string::npos);
    EXPECT_LT(outcome.film.find("stco"), id);
    const std::string xml = outcome.film.substr(id + 20, outcome.film.find("mdat") - 4 - id - 20);
    EXPECT_EQ(xml.find("<?xml version=\"1.0\"?><rdf:SphericalVideo"), 0u);
    const std::string end = "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>" + c.xml +
                            "</rdf:SphericalVideo>";
    EXPECT_TRUE(xml.ends_with(end)) << xml;
    // Places follow.
    const size_t list = outcome.film.find("stco") + 12;
    EXPECT_EQ(outcome.film.substr(list, 4), number(outcome.film.find(kFirst)));
  }
}

TEST(Mp4, whatIsNotTheFilmIsAProblem) {
  const std::string good = filmOf(false, false);
  EXPECT_EQ(rearranged(good, with(FilmLayout::mono), 3).problem, "it has 2 frames instead of 3");
  EXPECT_NE(rearranged("", with(FilmLayout::mono)).problem, "");
  EXPECT_NE(rearranged(good + good, with(FilmLayout::mono)).problem, "");
  EXPECT_NE(
      rearranged(kKind + box("mdat", kFirst + kSecond) + indexFor(7, false), with(FilmLayout::mono)).problem,
      "");
  for (size_t size = 0; size < good.size(); ++size)
    ASSERT_NE(rearranged(good.substr(0, size), with(FilmLayout::sideBySide)).problem, "") << size;
}

TEST(Mp4, damageIsNoCrash) {
  const std::string good = filmOf(true, true);
  for (size_t i = 0; i < good.size(); ++i)
    for (const char value : {'\1', '\xff'}) {
      std::string bad = good;
      bad[i] = value;
      rearranged(bad, with(FilmLayout::overUnder));
    }
}

}  // namespace
}  // namespace scumble::film

// Under a locale with decimal commas, which host programs set for all of their process, everything that the
// library reads and writes is as without.
#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>

#include "base/test_folder.h"
#include "film/test_ffmpeg.h"
#include "scumble/film.h"
#include "scumble/scumble.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

// Makes a locale of commas (with libc's own compiler of locales, of a definition of ours), and sets it for as
// long as it lives.
class CommaLocale {
 public:
  CommaLocale() {
    const std::string definition = folder_.file("comma.def");
    std::ofstream(definition)
        << "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n"
           "LC_CTYPE\ncopy \"POSIX\"\nEND LC_CTYPE\n";
    // It warns of what the definition leaves out.
    const std::string command =
        "cd '" + folder_.path() + "' && localedef -c -i comma.def -f ANSI_X3.4-1968 ./xx_XX >/dev/null 2>&1";
    [[maybe_unused]] const int code = std::system(command.c_str());
    setenv("LOCPATH", folder_.path().c_str(), 1);
    isSet_ = setlocale(LC_ALL, "xx_XX") != nullptr;
    unsetenv("LOCPATH");
  }
  ~CommaLocale() { setlocale(LC_ALL, "C"); }
  bool isSet() const { return isSet_ && *localeconv()->decimal_point == ','; }

 private:
  TestFolder folder_;
  bool isSet_ = false;
};

class Locale : public RenderTest {
 protected:
  static std::string everything();
};

// All of it as one text.
std::string Locale::everything() {
  std::string said;
  const auto say = [&](const std::string& text) { said += text + "\n"; };
  // Looks, by the C++ face and by C's.
  Look look;
  for (const auto& [path, value] : thoseThere({{"shadow.threshold", "0.45"},
                                               {"camera.shift", "0.5,-1.25,3e-1"},
                                               {"background.zenith", "#123456"},
                                               {"ink.shown", "on"},
                                               {"ink.least", "1.75"},
                                               {"materials.Sail*.warp.amount", "2.5"}})) {
    const Status status = look.set(path, value);
    say(path + (status ? " is set" : ": " + status.error().message()));
  }
  say(look.set("shadow.threshold", "1234567.25").error().message());
  scumble_look* const inC = scumble_look_load("age-of-sail");
  say(std::to_string(scumble_look_set(inC, "shadow.threshold", "0.45")) + scumble_error());
  scumble_look_free(inC);
  const Result<Look> read = Look::fromJson(
      R"({"shadow": {"threshold": 0.45, "softness": 1.5e0}, "light": {"azimuth": {"keys": [[0.5, 10.25], [1.5, 20.75]]}}})",
      "look.json");
  say(read ? "a look is read" : read.error().message());
  for (const Knob& knob : Look::knobs())
    say(knob.path + " " + knob.defaultValue + " " + knob.min + " " + knob.max);
  // Scenes, of JSON, and what is drawn of them.
  const TestScene still = stillLife();
  const std::string text = still.text();
  const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "still.gltf", "");
  say(scene ? "a scene is read" : scene.error().message());
  if (!scene) return said;
  const auto views = viewsFrom(*scene, {{0.5f, 1.25f, 6}, {0, 0.5f, 0}}, 96, 54);
  RenderOptions options = sized(96, 54);
  options.drawing = hasKnob("ink.shown");
  const Frame frame = draw(*scene, look, views, options);
  for (const float value : frame.layers[0].views[0].pixels)
    said += std::to_string(std::bit_cast<uint32_t>(value)) + " ";
  for (const Drawing& drawing : frame.drawings) {
    say(svgOf(drawing));
    say(svgOf(drawing, {true, true}));
  }
  return said;
}

TEST_F(Locale, changesNothingThatIsReadOrWritten) {
  const std::string plain = everything();
  EXPECT_EQ(plain.find("is no number"), plain.npos) << plain.substr(0, 2000);
  const CommaLocale comma;
  if (!comma.isSet()) GTEST_SKIP() << "there is no localedef to make a locale with";
  char own[32];
  snprintf(own, sizeof own, "%.1f", 1.5);
  ASSERT_STREQ(own, "1,5");
  const std::string there = everything();
  EXPECT_EQ(there == plain, true)
      << "the first difference is at "
      << std::mismatch(plain.begin(), plain.end(), there.begin(), there.end()).first - plain.begin();
}

// Their rates, and time stamps, which other programs tell as text.
TEST_F(Locale, filmsKeepTheirTimes) {
  NEEDS_FFMPEG();
  const TestFolder folder;
  const auto times = [&](const std::string& name) {
    FilmOptions options;
    options.width = 48, options.height = 32, options.fps = 29.97;
    const auto film = FilmWriter::create(folder.file(name), options);
    EXPECT_TRUE(film) << film.error().message();
    Image image;
    image.width = 48, image.height = 32, image.channels = {"R", "G", "B"};
    image.pixels.assign(48 * 32 * 3, 0.25f);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE((*film)->add(image));
    EXPECT_TRUE((*film)->finish());
    const auto reader = FilmReader::open(folder.file(name));
    EXPECT_TRUE(reader) << reader.error().message();
    return reader ? (*reader)->lastTime() : -1;
  };
  const double plain = times("plain.mp4");
  EXPECT_NEAR(plain, 4 / 29.97, 0.002);
  const CommaLocale comma;
  if (!comma.isSet()) GTEST_SKIP() << "there is no localedef to make a locale with";
  EXPECT_EQ(times("comma.mp4"), plain);
  EXPECT_EQ(contentOf(folder.file("comma.mp4")), contentOf(folder.file("plain.mp4")));
}

}  // namespace
}  // namespace scumble

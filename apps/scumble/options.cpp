#include "options.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "placements.h"
#include "report.h"
#include "scumble/check.h"
#include "stereo_layout.h"

namespace scumble::app {

namespace {

// By its name, by its number, or by what follows the last '|' of its name, where that is one clip's only:
// Blender's exporter writes names like "Armature|Walk".
Result<std::string> findClip(const std::vector<SceneSummary::Clip>& clips, const std::string& wanted) {
  std::vector<std::string> ending;
  std::string all;
  for (const SceneSummary::Clip& clip : clips) {
    if (clip.name == wanted) return wanted;
    if (clip.name.substr(clip.name.rfind('|') + 1) == wanted) ending.push_back(clip.name);
    all += (all.empty() ? "" : ", ") + clip.name;
  }
  if (ending.size() == 1) return ending[0];
  if (wanted.size() < 7 && wanted.find_first_not_of("0123456789") == std::string::npos)
    if (const size_t number = size_t(std::stoul(wanted)); number < clips.size()) return clips[number].name;
  return usage("the scene has no clip '" + wanted + "'",
               all.empty() ? "it has none at all" : "it has: " + all);
}

}  // namespace

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

std::optional<std::vector<double>> parseNumbers(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *const last = text.data() + text.size();
  while (true) {
    // One sign and no more: from_chars knows no plus.
    if (last - at > 1 && at[0] == '+' && at[1] != '-') ++at;
    double number = 0;
    const auto [end, error] = std::from_chars(at, last, number);
    // Most of them go where only single precision fits.
    if (error != std::errc() || !std::isfinite(float(number))) return std::nullopt;
    numbers.push_back(number);
    if (end == last) return numbers;
    if (*end != ',') return std::nullopt;
    at = end + 1;
  }
}

std::optional<std::pair<uint32_t, uint32_t>> parseSize(const std::string& text) {
  const size_t cross = text.find('x');
  const auto number = [](const std::string& digits) -> std::optional<uint32_t> {
    if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos)
      return std::nullopt;
    return uint32_t(std::stoul(digits));
  };
  if (cross == std::string::npos) return std::nullopt;
  const auto width = number(text.substr(0, cross)), height = number(text.substr(cross + 1));
  if (!width || !height) return std::nullopt;
  return std::pair{*width, *height};
}

void SceneArguments::addTo(CLI::App& command, const std::string& without) {
  command
      .add_option(
          "SCENE", files,
          "glTF 2.0 files (.gltf or .glb), or worlds (.json) that list some with their places; several are "
          "placed in one world" +
              (without.empty() ? "" : "; without one, " + without))
      ->required(without.empty());
  command
      .add_option(
          "--place", places,
          "Puts a scene, by its name or number from 1 on, in a place (metres), turned (degrees about "
          "the vertical, or X,Y,Z), scaled, and on a node of another scene, with which it rides; e.g. "
          "'dog:at=0,0.4,0;turn=90;scale=0.5;on=Boat'; repeatable")
      ->type_name("SCENE:HOW")
      ->allow_extra_args(false);
  command.add_option("--scene", sceneNumber,
                     "Which of the file's scenes, by number (default: the file's own choice)");
  command
      .add_option("--pattern-coordinates", patternCoordinates,
                  "What torn edges and marks follow: the file's texture coordinates (file), such as are made "
                  "from the "
                  "shape (own), or the file's unless they are cut into pieces or very uneven (auto)")
      ->type_name("auto|file|own")
      ->capture_default_str();
  command.add_flag("--allow-outside", allowOutside, "Let paths in the scene lead out of its folder");
}

Result<Scene> SceneArguments::load(bool quiet, SceneOptions options) const {
  if (sceneNumber.value_or(0) < 0)
    return usage("there is no scene " + std::to_string(*sceneNumber),
                 "--scene counts a file's scenes from 0");
  options.scene = sceneNumber.value_or(-1);
  options.allowOutside = allowOutside;
  const std::map<std::string, PatternCoordinates> kinds{{"auto", PatternCoordinates::automatic},
                                                        {"file", PatternCoordinates::file},
                                                        {"own", PatternCoordinates::own}};
  const auto kind = kinds.find(patternCoordinates);
  if (kind == kinds.end())
    return usage("--pattern-coordinates " + patternCoordinates + " is unknown", "use auto, file or own");
  options.patternCoordinates = kind->second;
  std::vector<Scene> scenes;
  std::set<std::string> warned;
  for (const std::string& file : files) {
    Result<Scene> scene = Scene::load(file, options);
    if (!scene) return scene.error();
    for (const std::string& warning : scene->warnings())
      if (!quiet && warned.insert(warning).second) warn({warning});
    scenes.push_back(std::move(scene).value());
  }
  return placedScenes(scenes, files, places);
}

void LookArguments::addTo(CLI::App& command) {
  command.add_option(
      "--look", look,
      "A look that ships or a JSON file (default: SCENE.look.json beside the scene, else age-of-sail)");
  command
      .add_option("--set", settings, "Any knob, e.g. shadow.threshold=0.4; repeatable; wins over the look")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option(
      "--clip", clip,
      "Play this clip of the scene alone, by name, its end after '|', or number (`scumble info` lists "
      "them; default: "
      "as the look says, else the first one)");
}

std::string LookArguments::lookFor(const std::string& sceneFile) const {
  if (!look.empty()) return look;
  std::filesystem::path beside(sceneFile);
  beside.replace_extension(".look.json");
  std::error_code ignored;
  return std::filesystem::exists(beside, ignored) ? std::filesystem::absolute(beside).string()
                                                  : "age-of-sail";
}

Result<Look> LookArguments::load(const std::string& sceneFile, bool quiet) const {
  Result<Look> result = Look::load(lookFor(sceneFile));
  if (!result) return result.error();
  if (!quiet) warn(result->warnings());
  if (const Status status = applySettings(*result); !status) return status.error();
  return result;
}

Status LookArguments::applySettings(Look& look_) const {
  for (const std::string& setting : settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos)
      return usage("'" + setting + "' sets nothing", "write it like shadow.threshold=0.4");
    const Status status = look_.set(setting.substr(0, equals), setting.substr(equals + 1));
    if (!status) return status.error();
  }
  return Done{};
}

Result<Look> LookArguments::withClip(const Look& from, const Scene& scene) const {
  if (clip.empty()) return from;
  const Result<std::string> found = findClip(scene.summary().clips, clip);
  if (!found) return found.error();
  Look result = from;
  for (const auto& [pattern, weight] : {std::pair<std::string, const char*>{"*", "0"}, {*found, "1"}})
    if (const Status status = result.set("clips." + pattern + ".play.weight", weight); !status)
      return status.error();
  if (const Status status = applySettings(result); !status) return status.error();
  return result;
}

void LookArguments::warnOfIdle(const Look& from, const Scene& scene, const std::string& sceneFile) const {
  // A look that ships is for many scenes; a file that was named, or that lies beside the scene, is for this
  // one.
  const std::string name = lookFor(sceneFile);
  const bool isFile = isLookFile(name);
  // A line for each name; for each of the other kinds one.
  const std::vector<Finding> findings = check(scene, from, isFile);
  for (auto one = findings.begin(); one != findings.end();) {
    const auto isOther = [&](const Finding& other) {
      return other.kind != one->kind || other.kind == Finding::Kind::noSuchName;
    };
    const auto end = std::find_if(one + 1, findings.end(), isOther);
    std::string names = (one->kind == Finding::Kind::noSuchName && one->bySet ? "--set " : "") + one->setting;
    if (end - one == 2) names += " and " + (one + 1)->setting;
    if (end - one > 2) names += " and " + std::to_string(end - one - 1) + " more";
    warn({names + ": " + one->problem});
    one = end;
  }
}

void PictureArguments::addTo(CLI::App& command) {
  addStandpointTo(command);
  command.add_option("--roll", roll, "Degrees, clockwise (default: the look's camera.roll)");
  command.add_option(
      "--fov", fov,
      "Vertical field of view, degrees (default: the look's camera.fov, the scene's camera's, else 34)");
  command.add_option("--size", size, "Width and height in pixels")->type_name("WxH")->capture_default_str();
  command.add_option("--device", device,
                     "A GPU by name or number, cpu, or gpu for any other (`scumble devices` lists them)");
  addQualityTo(command);
}

void PictureArguments::addStandpointTo(CLI::App& command) {
  command.add_option(
      "--camera", camera,
      "A camera of the scene, by name or number (default: the look's camera, else the scene's first, else a "
      "framing of everything)");
  command
      .add_option(
          "--frame", frame,
          "Frame this node and what hangs below it (a name or pattern) instead of everything; --orbit, "
          "--turntable and --eye then look at it as well")
      ->type_name("NODE");
  command.add_option("--orbit", orbit, "Degrees around the scene's centre, and the distance in scene radii")
      ->type_name("AZ,EL[,DIST]");
  command.add_option("--eye", eye, "Where the camera stands, metres")->type_name("X,Y,Z");
  command.add_option("--target", target, "What it looks at, metres")->type_name("X,Y,Z");
}

void PictureArguments::addQualityTo(CLI::App& command) {
  command.add_option("--samples", samples, "Anti-aliasing: 1 or 4")->capture_default_str();
  command.add_option("--seed", seed, "Moves every pattern; the same seed gives the same picture")
      ->capture_default_str();
  command.add_flag("--validate", validate,
                   "Run under the Vulkan validation layers; a message from them is an error");
}

void PictureArguments::addStereoTo(CLI::App& command) {
  command.add_option("--stereo", stereo, "Two views: " + stereoLayoutNames());
  ipdOption = command.add_option("--ipd", ipd, "Distance between the eyes, metres")->capture_default_str();
}

void PictureArguments::addTurntableTo(CLI::App& command) {
  constexpr const char* kUsual = "8";
  // A scene's name after it would be taken for the seconds.
  const auto isNumber = [](const std::string& text) {
    const auto numbers = parseNumbers(text);
    return numbers && numbers->size() == 1
               ? std::string()
               : "'" + text + "' is no number of seconds; write --turntable=" + kUsual;
  };
  command
      .add_option_function<std::string>(
          "--turntable",
          [this](const std::string& seconds) {
            turntable = parseNumbers(seconds.empty() ? kUsual : seconds)->front();
          },
          "Once around the scene in so many seconds, 8 if none are given: a film or sequence that loops, "
          "its length those seconds unless --frames says otherwise. It begins at --orbit or the look's "
          "camera")
      ->check(CLI::Validator(isNumber, ""))
      ->type_name("[SECONDS]")
      ->expected(0, 1);
}

Result<RenderOptions> PictureArguments::renderOptions() const {
  RenderOptions options;
  const auto parsed = parseSize(size);
  if (!parsed) return usage("'" + size + "' is no size", "write it like 1280x720");
  options.width = parsed->first;
  options.height = parsed->second;
  if (samples != 1 && samples != 4)
    return usage("--samples " + std::to_string(samples) + " is neither 1 nor 4", "use --samples 4");
  options.samples = uint32_t(samples);
  options.seed = seed;
  if (const auto layout = stereoLayoutOf(stereo); !layout) return layout.error();
  return options;
}

Result<Viewpoint> PictureArguments::viewpoint() const {
  // Each of these says where the camera stands; a turntable may begin at an orbit.
  const std::pair<const char*, bool> ways[] = {{"--camera", !camera.empty()},
                                               {"--orbit", !orbit.empty()},
                                               {"--turntable", turntable.has_value()},
                                               {"--eye", !eye.empty()},
                                               {"--target", !target.empty()}};
  for (size_t i = 0; i < std::size(ways); ++i)
    for (size_t j = i + 1; j < std::size(ways); ++j)
      if (ways[i].second && ways[j].second && !(i == 1 && j == 2) && i != 3)
        return usage(
            std::string(ways[i].first) + " and " + ways[j].first + " both say where the camera stands",
            "give one of them");
  if (!frame.empty() && (!camera.empty() || !target.empty()))
    return usage(
        "--frame and " + std::string(camera.empty() ? "--target" : "--camera") + " both say what is seen",
        "give one of them");
  Viewpoint viewpoint;
  viewpoint.frame = frame;
  viewpoint.turntable = turntable;
  viewpoint.camera = camera;
  viewpoint.roll = roll;
  viewpoint.verticalFov = fov;
  if (!orbit.empty()) {
    const auto numbers = parseNumbers(orbit);
    if (!numbers || numbers->size() < 2 || numbers->size() > 3)
      return usage("--orbit " + orbit + " is no orbit", "write it like 30,15 or 30,15,3");
    viewpoint.orbit = true;
    viewpoint.azimuth = float((*numbers)[0]);
    viewpoint.elevation = float((*numbers)[1]);
    if (numbers->size() == 3) viewpoint.distance = float((*numbers)[2]);
  }
  const auto point = [](const std::string& text) -> std::optional<glm::dvec3> {
    const auto numbers = parseNumbers(text);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  };
  if (!eye.empty() && !(viewpoint.eye = point(eye)))
    return usage("--eye " + eye + " is no point", "write it like 2,1.5,4");
  if (!target.empty() && !(viewpoint.target = point(target)))
    return usage("--target " + target + " is no point", "write it like 0,1,0");
  return viewpoint;
}

void PictureArguments::warnOfIdle() const {
  if (ipdOption && ipdOption->count() > 0 && !isStereo()) warn({"--ipd does nothing without --stereo"});
}

Result<std::vector<View>> PictureArguments::views(const Scene& scene, const Look& look, double time) const {
  const Result<Viewpoint> from = viewpoint();
  if (!from) return from.error();
  const Result<RenderOptions> options = renderOptions();
  if (!options) return options.error();
  if (options->width == 0 || options->height == 0)
    return usage("'" + size + "' has no area", "write it like 1280x720");
  return makeViews(scene, *from, float(options->width) / float(options->height),
                   isStereo() ? Stereo::stereo : Stereo::mono, ipd, look, time);
}

RendererOptions PictureArguments::rendererOptions() const {
  RendererOptions options;
  options.device = device;
  options.validation = validate;
  options.cacheFolder = cacheFolder();
  return options;
}

namespace {

// Ours in a base folder of the XDG Base Directory Specification.
std::string baseFolder(const char* variable, const std::string& inHome) {
  if (const char* base = std::getenv(variable); base && *base == '/') return std::string(base) + "/scumble";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::string(home) + "/" + inHome + "/scumble";
  return "";
}

}  // namespace

std::string cacheFolder() {
  return baseFolder("XDG_CACHE_HOME", ".cache");
}
std::string stateFolder() {
  return baseFolder("XDG_STATE_HOME", ".local/state");
}

}  // namespace scumble::app

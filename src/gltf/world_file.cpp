#include "gltf/world_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file_bytes.h"
#include "gltf/uri.h"
#include "scene/import_failure.h"
#include "scene/scene_place.h"
#include "scumble/nearest.h"

namespace scumble::gltf {

using namespace scene;

namespace {

using WorldJson = nlohmann::ordered_json;

constexpr size_t kMostBytes = 16 << 20;

// The first mistake ends it, as an ImportFailure.
class World {
 public:
  World(std::string path, const SceneOptions& options, std::vector<std::string> chain)
      : path_(std::move(path)), options_(options), chain_(std::move(chain)) {}

  Result<Scene> read(const WorldJson& root) {
    if (!root.is_object()) fail("", "a world is a JSON object", kForm);
    const WorldJson* list = nullptr;
    for (const auto& [key, value] : root.items()) {
      if (key == "$schema" || key == "description") continue;
      if (key != "scenes") failUnknown(key, key, {"scenes", "description"});
      list = &value;
    }
    if (!list || !list->is_array() || list->empty()) fail("scenes", "a world lists its scenes", kForm);
    if (list->size() > kMostScenes)
      fail("scenes", "these are too many scenes", "a world has " + std::to_string(kMostScenes) + " at most");
    std::vector<PlacedScene> placed;
    for (size_t i = 0; i < list->size(); ++i) {
      done_ = double(i) / double(list->size()), share_ = 1.0 / double(list->size());
      Result<PlacedScene> one = readScene((*list)[i], at(i));
      if (!one) return one.error();
      placed.push_back(std::move(one).value());
    }
    if (const std::optional<PlacementProblem> problem = problemWith(placed))
      fail(at(problem->scene) + (problem->member.empty() ? "" : "." + problem->member), problem->problem,
           problem->advice);
    Result<Scene> world = Scene::place(placed);
    if (!world) fail("scenes", world.error().problem, world.error().advice);
    return world;
  }

 private:
  static constexpr const char* kForm =
      "write it like {\"scenes\": [{\"file\": \"boat.glb\", \"at\": [0, 0, 2]}]}";

  static std::string at(size_t i) { return "scenes[" + std::to_string(i) + "]"; }

  [[noreturn]] static void failUnknown(const std::string& place, const std::string& word,
                                       const std::vector<std::string>& known) {
    const std::string meant = nearest(word, known);
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    fail(place, "there is no '" + word + "' here",
         meant.empty() ? "there are: " + all : "did you mean '" + meant + "'?");
  }

  static double numberOf(const WorldJson& value, const std::string& place) {
    if (!value.is_number()) fail(place, "it is no number", "write one");
    const double number = value.get<double>();
    if (!(std::abs(number) <= 1e30))
      fail(place, "it is out of range", "write a number that places something");
    return number;
  }

  static glm::dvec3 tripleOf(const WorldJson& value, const std::string& place) {
    if (!value.is_array() || value.size() != 3)
      fail(place, "it is not three numbers", "write it like [1, 0, 2]");
    glm::dvec3 triple;
    for (int i = 0; i < 3; ++i) triple[i] = numberOf(value[size_t(i)], place + "[" + std::to_string(i) + "]");
    return triple;
  }

  static std::string textOf(const WorldJson& value, const std::string& place) {
    if (!value.is_string()) fail(place, "it is no text", "write it in quotes");
    return value.get<std::string>();
  }

  Result<PlacedScene> readScene(const WorldJson& entry, const std::string& place) {
    if (!entry.is_object()) fail(place, "it is no object", kForm);
    PlacedScene one;
    std::string file;
    SceneOptions options = options_;
    if (options_.progress)
      options.progress = [this](double part) { return options_.progress(done_ + part * share_); };
    for (const auto& [key, value] : entry.items()) {
      const std::string here = place + "." + key;
      if (key == "file") {
        file = textOf(value, here);
      } else if (key == "name") {
        one.name = textOf(value, here);
      } else if (key == "at") {
        one.at = tripleOf(value, here);
      } else if (key == "turn") {
        // One number turns it about the vertical.
        one.turn = value.is_array() ? tripleOf(value, here) : glm::dvec3(0, numberOf(value, here), 0);
      } else if (key == "scale") {
        one.scale = float(numberOf(value, here));
      } else if (key == "on") {
        one.on = textOf(value, here);
      } else if (key == "scene") {
        if (!value.is_number_unsigned() || value.get<uint64_t>() > 1000000)
          fail(here, "it is no scene's number", "write a whole number from 0 on");
        options.scene = int(value.get<uint64_t>());
      } else {
        failUnknown(here, key, {"file", "name", "at", "turn", "scale", "on", "scene"});
      }
    }
    if (file.empty()) fail(place + ".file", "it names no file", kForm);
    std::string folder = std::filesystem::path(path_).parent_path().string();
    if (folder.empty()) folder = ".";
    const std::string found = resolveFileUri(file, folder, options_.allowOutside, place + ".file");
    Result<Scene> scene = load(found, options, place + ".file");
    if (!scene) return scene.error();
    one.scene = std::move(scene).value();
    if (one.name.empty()) one.name = std::filesystem::path(file).stem().string();
    return one;
  }

  // Each file is read once.
  Result<Scene> load(const std::string& file, const SceneOptions& options, const std::string& place) {
    const auto known = loaded_.find({file, options.scene});
    if (known != loaded_.end()) return known->second;
    std::error_code failed;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, failed);
    std::string way;
    for (const std::string& one : chain_) {
      way += one + " -> ";
      if (std::filesystem::weakly_canonical(one, failed) == whole)
        fail(place, "these worlds list each other: " + way + file, "let one list scenes only");
    }
    if (chain_.size() > kMostWorlds)
      fail(place, "more than " + std::to_string(kMostWorlds) + " worlds lie within each other",
           "put some together");
    std::optional<Result<Scene>> world;
    if (file.ends_with(".json")) world = loadWorld(file, options, chain_);
    Result<Scene> scene = world ? std::move(*world) : Scene::load(file, options);
    if (scene) loaded_.emplace(std::pair{file, options.scene}, scene.value());
    return scene;
  }

  const std::string path_;
  const SceneOptions options_;
  const std::vector<std::string> chain_;
  double done_ = 0, share_ = 1;  // before the scene that is being read; its part of all
  std::map<std::pair<std::string, int>, Scene> loaded_;
};

}  // namespace

std::optional<Result<Scene>> loadWorld(const std::string& path, const SceneOptions& options,
                                       const std::vector<std::string>& within) {
  FileBytes file;
  std::string problem;
  if (!file.open(path, problem, FileAccess::read)) return std::nullopt;
  const Bytes bytes = file.bytes();
  const auto unusable = [&](int line, std::string what, std::string advice) {
    return Result<Scene>(Error{ErrorKind::unusableFile, path, line, "", std::move(what), std::move(advice)});
  };
  if (bytes.size() > kMostBytes) return std::nullopt;
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    constexpr bool kThrows = true, kSkipsComments = true;
    const WorldJson root = WorldJson::parse(text, nullptr, kThrows, kSkipsComments);
    if (root.is_object() && root.contains("asset")) return std::nullopt;
    if (options.scene >= 0)
      return unusable(0, "a world has no scenes to choose from", "write \"scene\" beside a file in it");
    std::vector<std::string> chain = within;
    chain.push_back(path);
    return World(path, options, std::move(chain)).read(root);
  } catch (const WorldJson::parse_error& error) {
    const auto end = text.begin() + long(std::min(error.byte, text.size()));
    return unusable(1 + int(std::count(text.begin(), end, '\n')), "this is no JSON",
                    "mind commas, quotes and brackets there");
  } catch (ImportFailure& failure) {
    failure.error.file = path;
    return Result<Scene>(failure.error);
  } catch (const WorldJson::exception&) {
    return unusable(0, "this JSON cannot be read", "give a world or a glTF");
  }
}

}  // namespace scumble::gltf

#include "placements.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "options.h"
#include "report.h"

namespace scumble::app {

namespace {

constexpr const char* kExample = "write it like 'dog:at=0,0.4,0;turn=90;scale=0.5;on=Boat'";

// Names of the scenes, all different: as Scene::place makes them.
std::vector<std::string> namesOf(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::string plain = std::filesystem::path(file).stem().string();
    std::string name = plain;
    for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
      name = plain + "-" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

std::optional<size_t> findScene(const std::vector<std::string>& names, const std::string& wanted) {
  if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
    return size_t(found - names.begin());
  if (!wanted.empty() && wanted.size() < 6 && wanted.find_first_not_of("0123456789") == std::string::npos)
    if (const size_t number = size_t(std::stoul(wanted)); number >= 1 && number <= names.size())
      return number - 1;
  return std::nullopt;
}

// One "member=value" of a placement.
Status readMember(const std::string& word, const std::string& option, PlacedScene& out) {
  const size_t equals = word.find('=');
  const std::string member = word.substr(0, equals),
                    value = equals == std::string::npos ? "" : word.substr(equals + 1);
  const auto numbers = parseNumbers(value);
  const auto triple = [&] { return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]); };
  const auto wrong = [&](const char* what) { return usage(option + ": " + what, kExample); };
  if (member == "at") {
    if (!numbers || numbers->size() != 3) return wrong("at takes three numbers");
    out.at = triple();
  } else if (member == "turn") {
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3))
      return wrong("turn takes one number or three");
    out.turn = numbers->size() == 3 ? triple() : glm::dvec3(0, (*numbers)[0], 0);
  } else if (member == "scale") {
    if (!numbers || numbers->size() != 1) return wrong("scale takes one number");
    out.scale = float((*numbers)[0]);
  } else if (member == "on") {
    if (value.empty()) return wrong("on takes the name of a node");
    out.on = value;
  } else {
    return usage(option + ": there is no '" + member + "' in a placement",
                 "there are at, turn, scale and on");
  }
  return Done{};
}

}  // namespace

Result<Scene> placedScenes(const std::vector<Scene>& scenes, const std::vector<std::string>& files,
                           const std::vector<std::string>& places) {
  if (places.empty()) return scenes.size() == 1 ? scenes[0] : Scene::combine(scenes);
  const std::vector<std::string> names = namesOf(files);
  std::vector<PlacedScene> placed;
  for (size_t i = 0; i < scenes.size(); ++i) placed.push_back({scenes[i], names[i]});
  std::vector<bool> isSaid(scenes.size(), false);
  for (const std::string& place : places) {
    const std::string option = "--place '" + place + "'";
    const size_t colon = place.find(':');
    if (colon == std::string::npos || colon + 1 == place.size())
      return usage(option + " says nothing of a scene", kExample);
    const std::optional<size_t> which = findScene(names, place.substr(0, colon));
    if (!which) {
      std::string all;
      for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
      return usage(option + ": no scene is called '" + place.substr(0, colon) + "'", "there are: " + all);
    }
    if (isSaid[*which])
      return usage(option + ": '" + names[*which] + "' has a place already", "say it in one --place");
    isSaid[*which] = true;
    std::stringstream words(place.substr(colon + 1));
    for (std::string word; std::getline(words, word, ';');)
      if (const Status status = readMember(word, option, placed[*which]); !status) return status.error();
  }
  return Scene::place(placed);
}

}  // namespace scumble::app

#include "scene/extras.h"

#include <fmt/format.h>

#include "scene/scene_data.h"

namespace scumble::scene {

void readExtras(const nlohmann::json& object, Node& node,
                const std::function<void(const std::string& path, const std::string& text)>& tell) {
  node.extras.clear();
  for (const ExtraRule& rule : extraRules())
    if (const auto found = object.find(rule.key); found != object.end()) {
      node.extras[rule.key] = std::make_shared<const nlohmann::json>(*found);
      for (const auto& [path, text] : rule.problemsOf(*found))
        tell(fmt::format(".{}{}", rule.key, path), text);
    }
}

}  // namespace scumble::scene

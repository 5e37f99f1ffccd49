// The passes of a frame, in order. To add a pass: a folder under src/passes, and one line in
// standardPasses().
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "frame/feature_parts.h"
#include "frame/pass.h"

namespace scumble::renderer {

using namespace frame;

// Which passes a frame has, in their order.
class PassList {
 public:
  using Make = std::function<std::unique_ptr<Pass>()>;

  void append(Make make) { makes_.push_back(std::move(make)); }
  // Before the first pass, or after the last one, that has this name; false where none has.
  bool insertBefore(const std::string& name, Make make);
  bool insertAfter(const std::string& name, Make make);
  bool has(const std::string& name) const;

  std::vector<std::unique_ptr<Pass>> makeAll() const;

 private:
  std::vector<Make> makes_;
};

// Of the picture, and of the yardstick's (RenderOptions::plain).
PassList standardPasses();
PassList plainPasses();

// A feature's pass, and the pass that it comes after.
struct FeaturePass {
  std::string feature;
  FeatureParts::PlacedPass pass;
};
// Those of all features that come after one pass, in their order (FeatureParts::PlacedPass). Throws
// std::logic_error for features that nobody has heard of, and for such as want to be above each other.
std::vector<FeaturePass> inOrder(std::vector<FeaturePass> passes,
                                 const std::vector<std::string>& knownFeatures);

// What passes may offer to save, in their order, each once.
std::vector<const Aov*> aovsOf(const std::vector<std::unique_ptr<Pass>>& passes);

}  // namespace scumble::renderer

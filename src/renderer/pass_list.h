// The passes of a frame, in order. To add a pass: a folder under src/passes, and one line in
// standardPasses().
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

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

  std::vector<std::unique_ptr<Pass>> makeAll() const;

 private:
  std::vector<Make> makes_;
};

// Of the picture, and of the yardstick's (RenderOptions::plain).
PassList standardPasses();
PassList plainPasses();

// What passes may offer to save, in their order, each once.
std::vector<const Aov*> aovsOf(const std::vector<std::unique_ptr<Pass>>& passes);

}  // namespace scumble::renderer

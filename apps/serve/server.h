// A renderer that other programs drive: docs/serve.md is its protocol.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client_memory.h"
#include "requests.h"
#include "scumble/renderer.h"
#include "served_scene.h"

namespace scumble::serve {

class Server {
 public:
  // Of the protocol: it grows when something that was right becomes wrong.
  static constexpr int kProtocol = 1;

  Server(std::unique_ptr<Renderer> renderer, std::string version)
      : renderer_(std::move(renderer)), version_(std::move(version)) {}

  // Greets, and answers what comes in until that ends. Fails where the answers reach nobody.
  Status run(int in, int out);

 private:
  nlohmann::json answer(Members& request, int64_t id, const Requests& requests, Answers& answers);
  nlohmann::json greeting() const;
  nlohmann::json edit(Members& request);
  nlohmann::json setLook(Members& request);
  nlohmann::json setKnobs(Members& request);
  nlohmann::json render(Members& request, const Progress& progress);
  std::vector<View> viewsOf(Members& request, const Scene& scene, double time,
                            const RenderOptions& options) const;

  std::unique_ptr<Renderer> renderer_;
  std::string version_;
  ClientMemory memory_;
  ServedScene scene_;
  Look look_;
  Scene remembered_;  // of an earlier frame, for motion
};

}  // namespace scumble::serve

// scumble serve: a renderer for other programs, over pipes.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>

#include "../serve/server.h"
#include "commands.h"
#include "options.h"
#include "report.h"

namespace scumble::app {

namespace {

struct ServeArguments {
  std::string device;
  bool validate = false;
};

int run(const ServeArguments& args) {
  // Who goes away is noticed by what cannot be written.
  std::signal(SIGPIPE, SIG_IGN);
  RendererOptions options;
  options.device = args.device;
  options.validation = args.validate;
  options.cacheFolder = cacheFolder();
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(options);
  if (!renderer) return fail(renderer.error());
  serve::Server server(std::move(*renderer), SCUMBLE_VERSION);
  const Status status = server.run(STDIN_FILENO, STDOUT_FILENO);
  return status ? kDone : fail(status.error());
}

}  // namespace

void addServe(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<ServeArguments>();
  CLI::App* command = program.add_subcommand("serve", "A renderer that another program drives, over pipes");
  command->add_option("--device", args->device,
                      "A GPU by name or number, cpu, or gpu for any other (`scumble devices` lists them)");
  command->add_flag("--validate", args->validate,
                    "Run under the Vulkan validation layers; a message from them is an error");
  command->footer(
      "Requests come in and answers go out as JSON, one a line: docs/serve.md. It ends with its input.\n"
      "Example: scumble serve < requests.jsonl > answers.jsonl");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app

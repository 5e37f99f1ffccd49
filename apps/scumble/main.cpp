// The program: reads the command line and hands over to a subcommand.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "command_line.h"
#include "commands.h"
#include "report.h"
#include "scumble/renderer.h"

using namespace scumble;

namespace {

// The build, and the device where there is one: a machine without has a build all the same.
void nameBuild() {
  std::printf("scumble %s\n", SCUMBLE_VERSION);
  const Result<std::vector<GpuInfo>> gpus = listGpus();
  const GpuInfo* used = nullptr;
  if (gpus)
    for (const GpuInfo& gpu : *gpus)
      if (gpu.wouldBeUsed) used = &gpu;
  if (used)
    std::printf("device: %s (%s)\n", used->name.c_str(), used->driver.c_str());
  else
    std::printf("device: none; %s\n", gpus ? "`scumble devices` says why" : gpus.error().message().c_str());
}

int run(int argc, char** argv) {
  try {
    CLI::App program{"scumble: glTF scenes become moving paintings", "scumble"};
    program.require_subcommand(0, 1);
    program.failure_message(CLI::FailureMessage::simple);
    program.set_help_flag("-h,--help", "Show this help");
    program.set_help_all_flag("--help-all", "Show the help of every command");
    bool version = false;
    program.add_flag("--version", version, "Name the build and the device");
    int exitCode = app::kDone;
    app::addRender(program, exitCode);
    app::addFilm(program, exitCode);
    app::addFarm(program, exitCode);
    app::addView(program, exitCode);
    app::addXr(program, exitCode);
    app::addDescriptions(program, exitCode);
    app::addBench(program, exitCode);
    app::addMeasure(program, exitCode);
    app::addPaint(program, exitCode);
    app::addBake(program, exitCode);
    app::addLook(program, exitCode);
    app::addServe(program, exitCode);
    program.footer(
        "Example: scumble render boat.glb -o boat.png\n`scumble COMMAND --help` shows a command's options.");

    app::refuseSlips(program);

    try {
      std::vector<std::string> words = app::wordsOf(argc, argv);
      std::reverse(words.begin(), words.end());  // as the parser wants them
      program.parse(std::move(words));
    } catch (const CLI::Success& done) {
      return program.exit(done);
    } catch (const CLI::ParseError& error) {
      return app::fail(app::wrongWords(program, error));
    }
    if (version) {
      nameBuild();
      return app::kDone;
    }
    if (program.get_subcommands().empty()) {
      std::fputs(program.help().c_str(), stdout);
      return app::kWrongUsage;
    }
    return exitCode;
  } catch (const std::exception& error) {
    return app::fail(Error{ErrorKind::internal, "", 0, "", error.what(), "please report this"});
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A limit on the sizes of files is an output that cannot be written, also where it is printed.
  std::signal(SIGXFSZ, SIG_IGN);
#ifdef __GLIBC__
  // Scenes are read into arrays that come and go. Each goes back to the system, whatever has been freed
  // before it: the heap would keep a tenth of a large scene's file, and more where threads wait for each
  // other.
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
#endif
  const int exitCode = run(argc, argv);
  // What was printed counts as output too: a script that saves it must learn when it did not arrive.
  if (exitCode == app::kDone && (std::fflush(stdout) != 0 || std::ferror(stdout)))
    return app::fail(
        Error{ErrorKind::outputNotWritten, "", 0, "", "the output cannot be printed", "check where it goes"});
  return exitCode;
}

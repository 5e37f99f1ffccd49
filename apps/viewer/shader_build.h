// For who works on shaders: the library's, compiled anew while the window is open, as soon as one of their
// sources is saved.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "file_watch.h"
#include "scumble/result.h"

namespace scumble::viewer {

class ShaderBuild {
 public:
  // `build`: the folder of a build of this program, which says how shaders are compiled
  // (generated/shaders/commands.json). `wake`: called from any thread when poll() has something to do. Fails
  // with unusableFile where it is none, and with outputNotWritten where there is no place for what is
  // compiled.
  static Result<std::unique_ptr<ShaderBuild>> open(const std::string& build, std::function<void()> wake);
  ~ShaderBuild();
  ShaderBuild(const ShaderBuild&) = delete;
  ShaderBuild& operator=(const ShaderBuild&) = delete;

  // Where those are that differ from the build's (RendererOptions::shaderFolder).
  const std::string& folder() const { return folder_; }
  // Begins to compile what was saved; gives what has come of it, once: others are there, or the compiler's
  // first complaint, with file and line; then those before stay.
  std::optional<Status> poll();

 private:
  struct Shader {
    std::vector<std::string> command;  // without where from and where to
    std::string source;
    std::vector<std::string> sources;  // with all that it includes
  };
  explicit ShaderBuild(std::function<void()> wake);
  void watchSources();
  void compile(const std::set<std::string>& names);
  std::string compileOne(const std::string& name) const;

  const std::function<void()> wake_;
  FileWatch watch_;
  std::string folder_;
  std::map<std::string, Shader> shaders_;  // by name
  std::string validator_;
  std::set<std::string> waiting_;  // to be compiled
  std::thread compiler_;
  std::mutex mutex_;
  std::optional<Status> done_;  // by the compiler
};

// The files that a rule of make says something depends on ("a: b.glsl c\ d.glsl").
std::vector<std::string> dependenciesIn(const std::string& rule);

}  // namespace scumble::viewer

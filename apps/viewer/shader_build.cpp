#include "shader_build.h"

#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "export_job.h"

namespace scumble::viewer {

namespace {

namespace fs = std::filesystem;

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What a command has said, where it has failed; empty: it has not. It runs in a folder.
std::string complaintOf(const fs::path& folder, const std::vector<std::string>& words) {
  const std::string command = "cd " + shellText({folder.string()}) + " && " + shellText(words) + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "re");
  if (!pipe) return words[0] + " cannot be started";
  std::string said;
  char part[4096];
  for (size_t got; (got = fread(part, 1, sizeof part, pipe)) > 0;) said.append(part, got);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  // The first complaint stands in one line, before what follows from it.
  const size_t error = said.find("error: ");
  const size_t begin = error == std::string::npos ? 0 : said.rfind('\n', error) + 1;
  std::string line = said.substr(begin, said.find('\n', begin) - begin);
  return line.empty() ? words[0] + " has failed" : line;
}

// Files by what they are called in a folder.
std::vector<std::string> wholeNames(const fs::path& folder, std::vector<std::string> files) {
  for (std::string& file : files) file = (folder / file).lexically_normal().string();
  return files;
}

}  // namespace

std::vector<std::string> dependenciesIn(const std::string& rule) {
  std::vector<std::string> files;
  std::string file;
  const auto end = [&] {
    if (!file.empty()) files.push_back(std::exchange(file, {}));
  };
  for (size_t i = rule.find(": ") + 1; i > 0 && i < rule.size(); ++i) {
    const char next = i + 1 < rule.size() ? rule[i + 1] : '\n';
    if (rule[i] == '\\' && next == ' ')
      file += rule[++i];
    else if (rule[i] == '\\' && next == '\n')
      end(), ++i;
    else if (rule[i] == ' ' || rule[i] == '\n')
      end();
    else
      file += rule[i];
  }
  end();
  return files;
}

ShaderBuild::ShaderBuild(std::function<void()> wake) : wake_(std::move(wake)), watch_(wake_) {}

ShaderBuild::~ShaderBuild() {
  if (compiler_.joinable()) compiler_.join();
  std::error_code error;
  if (!folder_.empty()) fs::remove_all(folder_, error);
}

Result<std::unique_ptr<ShaderBuild>> ShaderBuild::open(const std::string& build, std::function<void()> wake) {
  const fs::path shaders = fs::path(build) / "generated/shaders", list = shaders / "commands.json";
  std::unique_ptr<ShaderBuild> made(new ShaderBuild(std::move(wake)));
  try {
    for (const nlohmann::json& one : nlohmann::json::parse(contentsOf(list))) {
      if (one.contains("validator")) {
        made->validator_ = one["validator"].get<std::string>();
        continue;
      }
      const auto name = one.at("name").get<std::string>();
      Shader shader{
          one.at("command").get<std::vector<std::string>>(), one.at("source").get<std::string>(), {}};
      if (shader.command.empty()) throw std::runtime_error("a command is empty");
      const fs::path built = shaders / (name + ".spv");
      shader.sources = dependenciesIn(contentsOf(built.string() + ".d"));
      if (shader.sources.empty()) shader.sources = {shader.source};
      shader.sources = wholeNames(fs::path(shader.source).parent_path(), shader.sources);
      std::error_code error;
      const auto when = fs::last_write_time(built, error);
      for (const std::string& source : shader.sources)
        if (error || fs::last_write_time(source, error) > when) made->waiting_.insert(name);
      made->shaders_.emplace(name, std::move(shader));
    }
  } catch (const std::exception&) {
    made->shaders_.clear();
  }
  if (made->shaders_.empty())
    return Error{ErrorKind::unusableFile,
                 list.string(),
                 0,
                 "",
                 "it does not say how shaders are compiled",
                 "give the folder of a build: --shaders build"};
  std::error_code error;
  std::string pattern = (fs::temp_directory_path(error) / "scumble-shaders-XXXXXX").string();
  if (error || !mkdtemp(pattern.data()))
    return Error{ErrorKind::outputNotWritten, pattern, 0, "", "the folder cannot be made", "set TMPDIR"};
  made->folder_ = pattern;
  made->watchSources();
  return made;
}

std::optional<Status> ShaderBuild::poll() {
  std::optional<Status> done;
  {
    const std::lock_guard lock(mutex_);
    done = std::exchange(done_, std::nullopt);
  }
  if (done) {
    compiler_.join();
    watchSources();
  }
  if (const std::set<std::string> saved = watch_.takeSaved(); !saved.empty())
    for (const auto& [name, shader] : shaders_)
      if (std::any_of(shader.sources.begin(), shader.sources.end(),
                      [&](const std::string& source) { return saved.count(source) > 0; }))
        waiting_.insert(name);
  // Nothing else is put there until somebody has taken what is.
  if (!done && !waiting_.empty() && !compiler_.joinable())
    compiler_ = std::thread([this, names = std::exchange(waiting_, {})] { compile(names); });
  return done;
}

// All that shaders include, which may be others than before.
void ShaderBuild::watchSources() {
  std::set<std::string> all;
  for (auto& [name, shader] : shaders_) {
    const std::vector<std::string> sources =
        dependenciesIn(contentsOf(fs::path(folder_) / (name + ".new.d")));
    if (!sources.empty()) shader.sources = wholeNames(fs::path(shader.source).parent_path(), sources);
    all.insert(shader.sources.begin(), shader.sources.end());
  }
  watch_.watch({all.begin(), all.end()});
}

std::string ShaderBuild::compileOne(const std::string& name) const {
  const Shader& shader = shaders_.at(name);
  const std::string out = (fs::path(folder_) / (name + ".new")).string();
  // In the source's folder, since the compiler's rules for make know no spaces in names.
  const fs::path source(shader.source), folder = source.parent_path();
  std::vector<std::string> words = shader.command;
  words.insert(words.end(), {"-MD", "-MF", out + ".d", "-o", out, source.filename().string()});
  std::string complaint = complaintOf(folder, words);
  // It calls files by what they are called there.
  const std::string file = complaint.substr(0, complaint.find(':'));
  if (file.starts_with("../") || file == source.filename())
    complaint.replace(0, file.size(), (folder / file).lexically_normal().string());
  if (!complaint.empty() || validator_.empty()) return complaint;
  return complaintOf(folder, {validator_, "--target-env", "vulkan1.3", "--scalar-block-layout", out});
}

// All of them, or none.
void ShaderBuild::compile(const std::set<std::string>& names) {
  const std::vector<std::string> all(names.begin(), names.end());
  std::vector<std::string> complaints(all.size());
  std::atomic<size_t> next = 0;
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
    workers.emplace_back([&] {
      for (size_t one; (one = next++) < all.size();) complaints[one] = compileOne(all[one]);
    });
  for (std::thread& worker : workers) worker.join();
  Status status = Done{};
  for (const std::string& complaint : complaints)
    if (!complaint.empty() && status) status = Error{ErrorKind::unusableFile, "", 0, "", complaint, ""};
  std::error_code error;
  for (const std::string& name : all) {
    const fs::path out = fs::path(folder_) / (name + ".new");
    if (status)
      fs::rename(out, fs::path(folder_) / (name + ".spv"), error);
    else
      fs::remove(out, error);
  }
  {
    const std::lock_guard lock(mutex_);
    done_ = status;
  }
  wake_();
}

}  // namespace scumble::viewer

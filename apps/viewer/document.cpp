#include "document.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "knob_text.h"
#include "look_text.h"

namespace scumble::viewer {

namespace {

bool isFile(const std::string& look) {
  return look.find('/') != std::string::npos || std::filesystem::path(look).extension() == ".json";
}

// Beside and then in its place, so that nobody ever reads a half.
Status putFile(const std::string& file, const std::string& text) {
  const std::string beside = file + ".tmp";
  std::ofstream out(beside, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(beside, file, error);
  if (out && !error) return Done{};
  std::filesystem::remove(beside, error);
  return Error{ErrorKind::outputNotWritten, file, 0, "", "the look cannot be written", "check its folder"};
}

}  // namespace

Document::Document(DocumentSources sources, std::function<void()> wake)
    : sources_(std::move(sources)), wake_(std::move(wake)), watch_(wake_) {
  watch();
  load(true);
}

Document::~Document() {
  if (loader_.joinable()) loader_.join();
}

void Document::load(bool withScene) {
  if (loader_.joinable()) {
    loadsAgain_ = true, loadsSceneAgain_ |= withScene;
    return;
  }
  loadingLook_ = wantedLook_;
  written_ = std::exchange(saving_, {});
  loader_ = std::thread([this, withScene, scene = scene_, lookName = loadingLook_] {
    Result<Loaded> loaded = read(withScene, scene, lookName);
    {
      const std::lock_guard lock(mutex_);
      loaded_ = std::move(loaded);
    }
    wake_();
  });
}

Result<Document::Loaded> Document::read(bool withScene, const Scene& scene,
                                        const std::string& lookName) const {
  Loaded loaded;
  if (withScene) {
    Result<Scene> anew = sources_.loadScene();
    if (!anew) return anew.error();
    loaded.scene = std::move(anew).value();
  }
  Result<Look> look = sources_.loadLook(withScene ? *loaded.scene : scene, lookName);
  if (!look) return look.error();
  loaded.look = std::move(look).value();
  return loaded;
}

Result<bool> Document::poll() {
  std::optional<Result<Loaded>> last;
  {
    const std::lock_guard lock(mutex_);
    last = std::exchange(loaded_, std::nullopt);
  }
  if (last) {
    loader_.join();
    if (*last) {
      Loaded& loaded = last->value();
      problem_.clear();
      problemFile_.clear();
      if (loaded.scene) scene_ = std::move(*loaded.scene);
      saved_ = std::move(loaded.look);
      lookName_ = loadingLook_;
      // What was saved is the file's now, where it was not turned again meanwhile.
      for (const auto& [path, value] : written_)
        if (const auto edit = edits_.find(path); edit != edits_.end() && edit->second == value)
          edits_.erase(edit);
      apply();
    } else if (scene_.empty()) {
      return last->error();
    } else {
      problem_ = last->error().message();
      problemFile_ = last->error().file;
      if (wantedLook_ == loadingLook_) wantedLook_ = lookName_;
    }
    watch();
    if (std::exchange(loadsAgain_, false)) load(std::exchange(loadsSceneAgain_, false));
  }
  const std::set<std::string> saved = watch_.takeSaved();
  if (!saved.empty()) {
    const auto isAmong = [](const std::vector<std::string>& files) {
      return [&files](const std::string& file) {
        return std::find(files.begin(), files.end(), file) != files.end();
      };
    };
    load(std::any_of(saved.begin(), saved.end(), isAmong(sources_.sceneFiles)) ||
         std::any_of(saved.begin(), saved.end(), isAmong(scene_.files())));
  }
  return last.has_value();
}

void Document::chooseLook(const std::string& name) {
  wantedLook_ = name;
  load(false);
}

void Document::watch() {
  std::vector<std::string> files = sources_.sceneFiles;
  files.insert(files.end(), scene_.files().begin(), scene_.files().end());
  if (lookName_.empty() && !sources_.lookFile.empty()) files.push_back(sources_.lookFile);
  for (const std::string& file : saved_.files()) files.push_back(file);
  if (!problemFile_.empty()) files.push_back(problemFile_);
  watch_.watch(files);
}

// A step is what is undone at once.
void Document::begin(const std::string& step) {
  if (step_ == step) return;
  step_ = step;
  undo_.push_back(edits_);
  redo_.clear();
}

Status Document::set(const std::string& path, const std::string& value) {
  // On a copy: what fails changes nothing.
  Look changed = look_;
  if (const Status status = changed.set(path, value); !status) return status.error();
  begin(path);
  edits_[path] = value;
  look_ = std::move(changed);
  ++version_;
  return Done{};
}

void Document::unset(const std::string& path) {
  if (!edits_.count(path)) return;
  closeStep();
  begin(path);
  closeStep();
  edits_.erase(path);
  apply();
}

Result<std::string> Document::save() {
  closeStep();
  const std::string present = lookName_.empty() ? sources_.lookName : lookName_;
  std::string file = present, text;
  if (isFile(present)) {
    std::ifstream in(file, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) return Error{ErrorKind::unusableFile, file, 0, "", "it cannot be read", "it may be gone"};
  } else {
    // A file that is there is another look.
    file = sources_.lookFile;
    const std::string ending = ".look.json";
    const std::string name = file.substr(0, file.size() - ending.size()) + "." + present;
    for (int number = 1; std::filesystem::exists(file); ++number)
      file = name + (number > 1 ? "-" + std::to_string(number) : "") + ending;
    text = "{\n  \"extends\": \"" + present + "\"\n}\n";
  }
  const std::optional<std::string> changed = withKnobs(text, edits_);
  if (!changed)
    return Error{ErrorKind::unusableFile,  file, 0, "", "the knobs have no place in it",
                 "mend it, and save again"};
  if (const Status status = putFile(file, *changed); !status) return status.error();
  if (!isFile(present)) wantedLook_ = file;
  keepHistory(saved_, edits_);
  saving_ = edits_;
  load(false);
  return file;
}

// What was undone before a save is what the file said before, though it says something else now.
void Document::keepHistory(const Look& before, const Edits& written) {
  for (const Knob& knob : Look::knobs()) {
    if (!written.count(knob.path)) continue;
    for (std::vector<Edits>* states : {&undo_, &redo_})
      for (Edits& state : *states) state.try_emplace(knob.path, valueText(before, knob));
  }
}

bool Document::swap(std::vector<Edits>& from, std::vector<Edits>& to) {
  closeStep();
  if (from.empty()) return false;
  to.push_back(std::exchange(edits_, std::move(from.back())));
  from.pop_back();
  apply();
  return true;
}

// A file may come to mean other pictures and names: what an edit says then to no effect is left out.
void Document::apply() {
  look_ = saved_;
  for (const auto& [path, value] : edits_)
    if (const Status status = look_.set(path, value); !status) problem_ = status.error().message();
  ++version_;
}

}  // namespace scumble::viewer

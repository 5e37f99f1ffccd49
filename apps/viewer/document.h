// What the window shows: a scene and a look, from files that are read anew when they are saved, and knobs
// that were turned by hand, which can be undone.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "file_watch.h"
#include "scumble/renderer.h"

namespace scumble::viewer {

// Texts of knobs by their paths, as Look::set takes them.
using Edits = std::map<std::string, std::string>;

struct DocumentSources {
  std::vector<std::string> sceneFiles;  // read anew when one is saved, as are those that they name
  std::string lookName;                 // which look the scene is opened with: one that ships, or a file
  std::string
      lookFile;  // that file, or where one would be looked for; read anew when it is saved, and saved to
  // Called from other threads, one of them at a time, and again when a file was saved.
  std::function<Result<Scene>()> loadScene;
  // `name`: one that ships, or a file; empty: that which the scene was opened with.
  std::function<Result<Look>(const Scene& scene, const std::string& name)> loadLook;
};

class Document {
 public:
  // `wake`: called from any thread when poll() has something to do.
  Document(DocumentSources sources, std::function<void()> wake);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  // Takes what was read since, and begins to read what was saved. True where something is another now. Fails
  // where the first reading did: there is nothing then.
  Result<bool> poll();

  const Scene& scene() const { return scene_; }  // empty until it was read
  const Look& look() const { return look_; }     // with the edits
  uint64_t version() const { return version_; }  // grows with each change
  const std::string& problem() const {
    return problem_;
  }  // with what was saved last; what was there before stays
  void tell(std::string problem) { problem_ = std::move(problem); }

  // Which look is below the edits, as loadLook has it; another one, when it was read.
  const std::string& lookName() const { return lookName_; }
  void chooseLook(const std::string& name);

  const Edits& edits() const { return edits_; }
  // Turns a knob. Until closeStep() further turns of it are undone with this one. Fails as Look::set does.
  Status set(const std::string& path, const std::string& value);
  void unset(const std::string& path);  // to what the file says
  void closeStep() { step_.clear(); }
  // Writes the edits into the look's file (look_text.h), or into a new one that extends a look that ships;
  // they are the file's then. Gives the file's name. Fails with outputNotWritten, and with unusableFile where
  // the file is none.
  Result<std::string> save();
  bool undo() { return swap(undo_, redo_); }
  bool redo() { return swap(redo_, undo_); }

 private:
  struct Loaded {
    std::optional<Scene> scene;  // where it was read anew
    Look look;
  };
  void load(bool withScene);
  Result<Loaded> read(bool withScene, const Scene& scene, const std::string& lookName) const;
  void watch();
  void begin(const std::string& step);
  bool swap(std::vector<Edits>& from, std::vector<Edits>& to);
  void apply();
  void keepHistory(const Look& before, const Edits& written);

  const DocumentSources sources_;
  const std::function<void()> wake_;
  FileWatch watch_;
  std::thread loader_;
  std::mutex mutex_;
  std::optional<Result<Loaded>> loaded_;  // by the loader
  bool loadsAgain_ = false, loadsSceneAgain_ = false;
  Scene scene_;
  Look saved_, look_;
  uint64_t version_ = 1;
  std::string lookName_, wantedLook_, loadingLook_;  // read, wanted, and being read
  std::string problem_, problemFile_, step_;
  Edits edits_;
  Edits saving_, written_;  // into the look's file, before the next reading and before the present one
  std::vector<Edits> undo_, redo_;
};

}  // namespace scumble::viewer

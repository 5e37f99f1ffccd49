// What the window shows: scenes and a look, from files that are read anew when they are saved, and knobs that
// were turned by hand, which can be undone.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "file_watch.h"
#include "scumble/image.h"
#include "scumble/renderer.h"

namespace scumble::viewer {

// Texts of knobs by their paths, as Look::set takes them.
using Edits = std::map<std::string, std::string>;

// What is open.
struct Opened {
  std::vector<std::string> scenes;  // files, all in one world
  std::string look;                 // one that ships, or a file; empty: the scenes' own
  std::string background;           // a picture's file that is behind everything; empty: the sky
  std::string clip;                 // the only one that plays, by name or number; empty: as the look has it
  bool operator==(const Opened&) const = default;
};

// Where the scenes' own look comes from.
struct OwnLook {
  std::string name;  // one that ships, or a file
  std::string file;  // that file, or where one would be looked for
};

struct DocumentSources {
  Opened opened;  // at first
  // The first two are called from other threads, one of them at a time, and again when a file was saved.
  std::function<Result<Scene>(const std::vector<std::string>& files, const Progress& progress)> loadScene;
  std::function<Result<Look>(const Scene& scene, const Opened& opened)> loadLook;
  std::function<OwnLook(const std::vector<std::string>& files)> ownLook;
};

// What something that went wrong has to do with. The last one of each is told, until it is better.
enum class Concern { scene, look, background, knob, saving, picture, shader };

class Document {
 public:
  // `wake`: called from any thread when poll() has something to do.
  Document(DocumentSources sources, std::function<void()> wake);
  ~Document();  // what is being read is given up
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  // Takes what was read since, and begins to read what was saved. True where something is another now. Fails
  // where the first reading did: there is nothing then.
  Result<bool> poll();
  bool isReading() const { return loader_.joinable(); }

  const Opened& opened() const { return opened_; }
  // The look that is there, by its name or file, also where it is the scenes' own. Not before the first
  // reading.
  std::string lookName() const { return lookNameOf(opened_); }
  const Scene& scene() const { return scene_; }  // empty until it was read
  // Grows when other scenes, or other contents of theirs, are there.
  uint64_t sceneVersion() const { return sceneVersion_; }
  const Look& look() const { return look_; }        // with the edits
  const Look& savedLook() const { return saved_; }  // as the file has it
  const std::shared_ptr<const Image>& background() const { return background_; }
  uint64_t version() const { return version_; }  // grows with each change of any of them
  // What is wrong, the most recent of each kind; what was there before stays.
  const std::map<Concern, std::string>& problems() const { return problems_; }
  void tell(Concern concern, std::string problem) { problems_[concern] = std::move(problem); }
  void settle(Concern concern) { problems_.erase(concern); }
  void settleAll() { problems_.clear(); }

  // Other ones, when they were read. Knobs that were turned stay turned where the look stays.
  void openScenes(std::vector<std::string> files);
  void addScenes(const std::vector<std::string>& files);  // to those that are there, or are being read
  void openLook(const std::string& name);
  void openBackground(const std::string& file);
  void openClip(const std::string& clip);

  const Edits& edits() const { return edits_; }
  // Turns a knob. Until closeStep() further turns of it are undone with this one. Fails as Look::set does.
  Status set(const std::string& path, const std::string& value) { return set(path, {{path, value}}); }
  // Turns several at once; until closeStep() further ones of the same step are undone with them.
  Status set(const std::string& step, const Edits& edits);
  void unset(const std::string& path);  // to what the file says
  // Turns many, as one step; what a look does not take is left out.
  void take(const Edits& edits);
  void closeStep() { step_.clear(); }
  // Writes the edits into the look's file (look_text.h), or into a new one that extends a look that ships;
  // they are the file's then. Gives the file's name. Fails with outputNotWritten, and with unusableFile where
  // the file is none, or could not be read again with them; and while something else is being read.
  Result<std::string> save();
  bool undo() { return swap(undo_, redo_); }
  bool redo() { return swap(redo_, undo_); }

 private:
  enum class Parts { look, all };
  struct Loaded {
    std::optional<Scene> scene;  // where it was read anew
    Look look;
    std::shared_ptr<const Image> background;
  };
  struct Failed {
    Error error;
    Concern concern;
  };
  using Reading = std::variant<Loaded, Failed>;
  std::string lookNameOf(const Opened& opened) const;
  void want(Opened opened, Parts parts);
  void load(Parts parts);
  Reading tryRead(Parts parts, const Scene& scene, const Opened& opened) const;
  Reading read(Parts parts, const Scene& scene, const Opened& opened) const;
  void take(Loaded loaded);
  void watch();
  void begin(const std::string& step);
  bool swap(std::vector<Edits>& from, std::vector<Edits>& to);
  void apply();
  void keepHistory(const Look& before, const Edits& written);

  const DocumentSources sources_;
  const std::function<void()> wake_;
  FileWatch watch_;
  std::thread loader_;
  std::atomic<bool> isEnding_ = false;
  std::mutex mutex_;
  std::optional<Reading> read_;  // by the loader
  std::optional<Parts> loadsAgain_;
  Opened opened_, wanted_, loading_;  // read, wanted, and being read
  Scene scene_;
  Look saved_, look_;
  std::shared_ptr<const Image> background_;
  uint64_t version_ = 1, sceneVersion_ = 0;
  std::map<Concern, std::string> problems_;
  std::map<Concern, std::string> problemFiles_;  // that could not be read
  std::string step_;
  Edits edits_;
  Edits saving_, written_;  // into the look's file, before the next reading and before the present one
  std::vector<Edits> undo_, redo_;
};

}  // namespace scumble::viewer

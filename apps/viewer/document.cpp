#include "document.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "knob_text.h"
#include "look_text.h"
#include "track_edit.h"

namespace scumble::viewer {

namespace {

// A picture by where it lies from a look's folder, if it lies below it; by hand it is from the present one.
std::string fromFolderOf(const std::string& lookFile, const Knob& knob, const std::string& value) {
  const std::vector<std::string> builtIn = wordsOf(knob);
  if (std::find(builtIn.begin(), builtIn.end(), value) != builtIn.end()) return value;
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(std::filesystem::absolute(lookFile, error), error).parent_path();
  const std::filesystem::path whole =
      std::filesystem::weakly_canonical(std::filesystem::absolute(value, error), error);
  const std::filesystem::path from = whole.lexically_relative(folder);
  return error || from.empty() || *from.begin() == ".." ? whole.string() : from.string();
}

// As it stands in a look.
std::string inLook(const std::string& path, const std::string& value, const std::string& lookFile) try {
  const std::optional<Setting> setting = settingOf(path);
  if (!setting || setting->knob->type != "picture") return value;
  if (!isTrackText(value)) return fromFolderOf(lookFile, *setting->knob, value);
  const nlohmann::json from = nlohmann::json::parse(value);
  KnobTrack track{{}, Interpolation::step, from.value("repeat", false)};
  for (const nlohmann::json& key : from["keys"])
    track.keys.push_back(
        {key.at(0).get<double>(), fromFolderOf(lookFile, *setting->knob, key.at(1).get<std::string>())});
  return textOf(track, *setting->knob).value_or(value);
} catch (const nlohmann::json::exception&) {
  return value;
}

}  // namespace

Document::Document(DocumentSources sources, std::function<void()> wake)
    : sources_(std::move(sources)), wake_(std::move(wake)), watch_(wake_), wanted_(sources_.opened) {
  watch();
  load(Parts::all);
}

Document::~Document() {
  isEnding_ = true;
  if (loader_.joinable()) loader_.join();
}

void Document::load(Parts parts) {
  if (loader_.joinable()) {
    loadsAgain_ = std::max(loadsAgain_.value_or(parts), parts);
    return;
  }
  loading_ = wanted_;
  written_ = std::exchange(saving_, {});
  loader_ = std::thread([this, parts, scene = scene_, opened = loading_] {
    Reading reading = tryRead(parts, scene, opened);
    {
      const std::lock_guard lock(mutex_);
      read_ = std::move(reading);
    }
    wake_();
  });
}

// What no reader has foreseen is a problem like others.
Document::Reading Document::tryRead(Parts parts, const Scene& scene, const Opened& opened) const {
  try {
    return read(parts, scene, opened);
  } catch (const std::exception& failure) {
    return Failed{Error{ErrorKind::internal, "", 0, "", failure.what(), "please report this"},
                  Concern::scene};
  }
}

Document::Reading Document::read(Parts parts, const Scene& scene, const Opened& opened) const {
  Loaded loaded;
  if (parts == Parts::all) {
    Result<Scene> anew = sources_.loadScene(opened.scenes, [this](double) { return !isEnding_; });
    if (!anew) return Failed{anew.error(), Concern::scene};
    loaded.scene = std::move(anew).value();
  }
  Result<Look> look = sources_.loadLook(loaded.scene.value_or(scene), opened);
  if (!look) return Failed{look.error(), Concern::look};
  loaded.look = std::move(look).value();
  if (!opened.background.empty()) {
    Result<Image> picture = readPicture(opened.background);
    if (!picture) return Failed{picture.error(), Concern::background};
    loaded.background = std::make_shared<const Image>(std::move(picture).value());
  }
  return loaded;
}

std::string Document::lookNameOf(const Opened& opened) const {
  return opened.look.empty() ? sources_.ownLook(opened.scenes).name : opened.look;
}

void Document::take(Loaded loaded) {
  const auto isRight = [this](Concern concern) { settle(concern), problemFiles_.erase(concern); };
  isRight(Concern::look), isRight(Concern::background);
  if (loaded.scene) isRight(Concern::scene);
  const bool isFirst = scene_.empty();
  if (loaded.scene) {
    scene_ = std::move(*loaded.scene);
    ++sceneVersion_;
  }
  saved_ = std::move(loaded.look);
  background_ = std::move(loaded.background);
  if (!isFirst && lookNameOf(opened_) != lookNameOf(loading_)) {
    // Knobs of a look that came with other scenes are theirs; and what was undone is the look's own, but for
    // a save under another name.
    if (opened_.scenes != loading_.scenes) edits_.clear();
    if (written_.empty()) undo_.clear(), redo_.clear(), closeStep();
  }
  opened_ = loading_;
  // What was saved is the file's now, where it was not turned again meanwhile.
  for (const auto& [path, value] : written_)
    if (const auto edit = edits_.find(path); edit != edits_.end() && edit->second == value)
      edits_.erase(edit);
  apply();
}

Result<bool> Document::poll() {
  std::optional<Reading> last;
  {
    const std::lock_guard lock(mutex_);
    last = std::exchange(read_, std::nullopt);
  }
  if (last) {
    loader_.join();
    if (auto* const loaded = std::get_if<Loaded>(&*last)) {
      take(std::move(*loaded));
    } else {
      const Failed& failed = std::get<Failed>(*last);
      if (scene_.empty()) return failed.error;
      tell(failed.concern, failed.error.message());
      problemFiles_[failed.concern] = failed.error.file;
      // Somebody may want something else by now.
      if (wanted_.scenes == loading_.scenes) wanted_.scenes = opened_.scenes;
      if (wanted_.look == loading_.look) wanted_.look = opened_.look;
      if (wanted_.background == loading_.background) wanted_.background = opened_.background;
      if (wanted_.clip == loading_.clip) wanted_.clip = opened_.clip;
    }
    watch();
    if (loadsAgain_) load(*std::exchange(loadsAgain_, std::nullopt));
  }
  const std::set<std::string> saved = watch_.takeSaved();
  if (!saved.empty()) {
    const auto isAmong = [](const std::vector<std::string>& files) {
      return [&files](const std::string& file) {
        return std::find(files.begin(), files.end(), file) != files.end();
      };
    };
    const bool isOfScene =
        std::any_of(saved.begin(), saved.end(), isAmong(wanted_.scenes)) ||
        std::any_of(saved.begin(), saved.end(), isAmong(scene_.files())) ||
        (problemFiles_.count(Concern::scene) && saved.count(problemFiles_[Concern::scene]));
    load(isOfScene ? Parts::all : Parts::look);
  }
  return last.has_value();
}

void Document::want(Opened opened, Parts parts) {
  wanted_ = std::move(opened);
  load(parts);
}

void Document::openScenes(std::vector<std::string> files) {
  Opened opened = wanted_;
  // Another scene has other clips.
  if (opened.scenes[0] != files[0]) opened.clip.clear();
  opened.scenes = std::move(files);
  want(std::move(opened), Parts::all);
}

void Document::addScenes(const std::vector<std::string>& files) {
  std::vector<std::string> all = wanted_.scenes;
  all.insert(all.end(), files.begin(), files.end());
  openScenes(std::move(all));
}

void Document::openLook(const std::string& name) {
  Opened opened = wanted_;
  opened.look = name;
  want(std::move(opened), Parts::look);
}

void Document::openBackground(const std::string& file) {
  Opened opened = wanted_;
  opened.background = file;
  want(std::move(opened), Parts::look);
}

void Document::openClip(const std::string& clip) {
  Opened opened = wanted_;
  opened.clip = clip;
  want(std::move(opened), Parts::look);
}

void Document::watch() {
  const Opened& opened = scene_.empty() ? wanted_ : opened_;
  std::vector<std::string> files = opened.scenes;
  if (!scene_.empty()) files.insert(files.end(), scene_.files().begin(), scene_.files().end());
  if (const std::string own = sources_.ownLook(opened.scenes).file; opened.look.empty() && !own.empty())
    files.push_back(own);
  if (!opened.background.empty()) files.push_back(opened.background);
  for (const std::string& file : saved_.files()) files.push_back(file);
  for (const auto& [concern, file] : problemFiles_)
    if (!file.empty()) files.push_back(file);
  watch_.watch(files);
}

// A step is what is undone at once.
void Document::begin(const std::string& step) {
  if (step_ == step) return;
  step_ = step;
  undo_.push_back(edits_);
  redo_.clear();
}

Status Document::set(const std::string& step, const Edits& edits) {
  // On a copy: what fails changes nothing.
  Look changed = look_;
  for (const auto& [path, value] : edits)
    if (const Status status = changed.set(path, value); !status) return status.error();
  settle(Concern::knob);
  begin(step);
  for (const auto& [path, value] : edits) edits_[path] = value;
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

void Document::take(const Edits& edits) {
  closeStep();
  begin("many");
  closeStep();
  for (const auto& [path, value] : edits) edits_[path] = value;
  apply();
}

Result<std::string> Document::save() {
  closeStep();
  if (!(wanted_ == opened_))
    return Error{ErrorKind::usage,
                 wanted_.look,
                 0,
                 "",
                 "something else is being read just now",
                 "save again when it is there"};
  const std::string present = lookName();
  std::string file = present, text;
  if (isLookFile(present)) {
    std::ifstream in(file, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) return Error{ErrorKind::unusableFile, file, 0, "", "it cannot be read", "it may be gone"};
  } else {
    // A file that is there is another look.
    file = sources_.ownLook(opened_.scenes).file;
    const std::string ending = ".look.json";
    const std::string name = file.substr(0, file.size() - ending.size()) + "." + present;
    std::error_code error;
    for (int number = 1; std::filesystem::exists(file, error); ++number)
      file = name + (number > 1 ? "-" + std::to_string(number) : "") + ending;
    text = "{\n  \"extends\": \"" + present + "\"\n}\n";
  }
  Edits edits;
  for (const auto& [path, value] : edits_) edits[path] = inLook(path, value, file);
  const std::optional<std::string> changed = withKnobs(text, edits);
  if (!changed)
    return Error{ErrorKind::unusableFile,  file, 0, "", "the knobs have no place in it",
                 "mend it, and save again"};
  // What could not be read again is not written.
  if (const Result<Look> again = Look::fromJson(*changed, file); !again) return again.error();
  if (const Status status = writeText(file, *changed); !status) return status.error();
  if (!isLookFile(present)) wanted_.look = file;
  keepHistory(saved_, edits_);
  saving_ = edits_;
  settle(Concern::saving);
  load(Parts::look);
  return file;
}

// What was undone before a save is what the file said before, though it says something else now.
void Document::keepHistory(const Look& before, const Edits& written) {
  for (const auto& [path, value] : written)
    for (std::vector<Edits>* states : {&undo_, &redo_})
      for (Edits& state : *states) state.try_emplace(path, valueText(before, path));
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
  settle(Concern::knob);
  for (const auto& [path, value] : edits_)
    if (const Status status = look_.set(path, value); !status) tell(Concern::knob, status.error().message());
  ++version_;
}

}  // namespace scumble::viewer

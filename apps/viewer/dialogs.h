// Windows that are opened over the picture, ask for something, and close.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "document.h"

namespace scumble::viewer {

// Which scenes are to be seen.
struct OpenWish {
  std::vector<std::string> files;
  bool isAdded = false;  // to what is there
};

// Scenes that were opened last, and a place to type one.
class OpenDialog {
 public:
  void open(std::vector<std::string> recent) { isOpen_ = true, recent_ = std::move(recent); }
  void close() { isOpen_ = false; }
  bool isOpen() const { return isOpen_; }
  std::optional<OpenWish> layOut(const glm::vec2& window);

 private:
  bool isOpen_ = false;
  std::vector<std::string> recent_;
  char typed_[1024] = "";
};

// What is to be made of what is seen.
struct SaveWish {
  enum class Kind { picture, turn, film } kind = Kind::picture;
  glm::uvec2 size{0};
  std::string file;
  float seconds = 8;  // of a turn
};

class SaveDialog {
 public:
  // `file`: that names are made from. `isFilm`: something plays.
  void open(const std::string& file, const glm::uvec2& size, bool isFilm);
  void close() { isOpen_ = false; }
  bool isOpen() const { return isOpen_; }
  std::optional<SaveWish> layOut(const glm::vec2& window);

 private:
  void name();

  bool isOpen_ = false, isFilm_ = false;
  SaveWish wish_;
  glm::uvec2 present_{0};
  std::string from_;
  char typed_[1024] = "";
};

// Files that were dropped, and what they are taken for.
struct Drop {
  std::vector<std::string> scenes, looks, pictures, others;
};
// By their endings; a .json file is a look where its name says so, or where it can be read as one.
Drop sorted(const std::vector<std::string>& files);

// Asks what dropped scenes are for, where there are some already, and what a picture is for.
class DropDialog {
 public:
  // `material`: that pictures may be for alone, besides the whole scene; empty: none.
  void open(Drop drop, std::string material) { drop_ = std::move(drop), material_ = std::move(material); }
  void close() { drop_ = {}; }
  bool isOpen() const { return !drop_.scenes.empty() || !drop_.pictures.empty(); }
  struct Answer {
    std::optional<OpenWish> scenes;
    std::string background;     // a picture's file
    std::string knob, picture;  // that a setting is to be, by its path
  };
  std::optional<Answer> layOut(const glm::vec2& window);

 private:
  Drop drop_;
  std::string material_;
};

}  // namespace scumble::viewer

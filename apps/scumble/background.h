// What --background means: a colour, nothing at all, a picture or a film.
#pragma once

#include <memory>
#include <string>

#include "scumble/film.h"
#include "scumble/look.h"
#include "scumble/result.h"

namespace scumble::app {

class Background {
 public:
  // Opens the file, if it is one. Of an empty text: what the look has.
  static Result<Background> make(const std::string& text);

  bool isTransparent() const { return text_ == "transparent"; }
  // Also of what is meant to be one: the look says then what is wrong with it.
  bool isColor() const { return text_.starts_with('#') || scumble::isColor(text_); }
  // Its name, or empty.
  std::string file() const { return picture_ || film_ ? text_ : ""; }

  // What lies behind the frame at a time; null where there is no file.
  Result<std::shared_ptr<const Image>> at(double time) const;

 private:
  std::string text_;
  std::shared_ptr<const Image> picture_;
  std::shared_ptr<FilmReader> film_;
};

}  // namespace scumble::app

#include "background.h"

#include <filesystem>

#include "options.h"
#include "report.h"
#include "scumble/look.h"

namespace scumble::app {

namespace {

bool isPictureName(const std::string& path) {
  const std::string ending = endingOf(path);
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".webp";
}

}  // namespace

Result<Background> Background::make(const std::string& text) {
  Background background;
  background.text_ = text;
  if (text.empty() || background.isTransparent()) return background;
  if (background.isColor()) {
    if (!scumble::isColor(text))
      // A knob for a colour says what one is.
      return usage("--background " + text + " is no colour",
                   Look().set("background.horizon", text).error().advice);
    return background;
  }
  std::error_code ignored;
  // What looks like no file and is none was meant to be a colour.
  if (text.find_first_of("./") == std::string::npos && !std::filesystem::exists(text, ignored))
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "'" + text + "' is no background",
                 "use a colour like #RRGGBB or navy, transparent, or the name of a picture or film"};
  if (isPictureName(text)) {
    Result<Image> picture = readPicture(text);
    if (!picture) return picture.error();
    background.picture_ = std::make_shared<const Image>(std::move(picture).value());
  } else {
    Result<std::unique_ptr<FilmReader>> film = FilmReader::open(text);
    if (!film) return film.error();
    background.film_ = std::move(film).value();
  }
  return background;
}

Result<std::shared_ptr<const Image>> Background::at(double time) const {
  if (film_) return film_->at(time);
  return picture_;
}

}  // namespace scumble::app

#include "look/read_value.h"

#include <algorithm>
#include <filesystem>

#include "base/image_decode.h"
#include "base/usage.h"

namespace scumble::look {

namespace {

// A picture that fits a knob is no photograph of a landscape.
constexpr uint32_t kMaxPictureSide = 4096;

Result<LookPicture> loadPicture(const std::string& file) {
  const auto fail = [&](std::string problem) {
    return Error{ErrorKind::unusableFile,
                 file,
                 0,
                 "",
                 std::move(problem),
                 "give a PNG, JPEG or WebP of at most " + std::to_string(kMaxPictureSide) +
                     " pixels a side, or a picture that is built in"};
  };
  LookPicture picture{file, {}, 0};
  FileBytes bytes;
  std::string problem;
  if (!bytes.open(file, problem, FileAccess::read)) return fail(problem);
  uint32_t width = 0, height = 0;
  if (!readImageSize(bytes.bytes(), width, height, problem)) return fail(problem);
  if (width > kMaxPictureSide || height > kMaxPictureSide) return fail("this picture is too large");
  // Some are shown in spite of their damage, with what is wrong with them.
  if (!decodeImage(bytes.bytes(), picture.pixels, problem) || !problem.empty()) return fail(problem);
  picture.contents = contentsOf(picture.pixels);
  return picture;
}

}  // namespace

Result<Value> readValue(const ParamRow& row, const std::string& text, const std::string& folder,
                        LookData& data) {
  if (text.find('\0') != std::string::npos) return usage("a setting holds the character NUL", "leave it out");
  if (row.kind == ParamKind::name) {
    if (text.empty()) return Value{};
    const auto known = std::find(data.texts.begin(), data.texts.end(), text);
    const size_t index = size_t(known - data.texts.begin());
    if (known == data.texts.end()) data.texts.push_back(text);
    return Value{double(index + 1), {}};
  }
  Result<Value> parsed = parseValue(row, text);
  if (parsed || row.kind != ParamKind::picture) return parsed;
  // A word without a dot is a slip in a built-in name rather than a file.
  if (text.find('.') == std::string::npos) return parsed;
  // A track may name a picture many times.
  const std::string file = (std::filesystem::path(folder) / text).string();
  for (size_t i = 0; i < data.pictures.size(); ++i)
    if (data.pictures[i]->file == file) return Value{-1 - double(i), {}};
  Result<LookPicture> picture = loadPicture(file);
  if (!picture) return picture.error();
  data.pictures.push_back(std::make_shared<const LookPicture>(std::move(picture).value()));
  return Value{-double(data.pictures.size()), {}};
}

}  // namespace scumble::look

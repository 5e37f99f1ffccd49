#include "look/look_source.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "look/shipped_looks.h"
#include "scumble/nearest.h"

namespace scumble::look {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxLookFile = 16 << 20;

Error unusable(const std::string& file, std::string problem, std::string advice) {
  return {ErrorKind::unusableFile, file, 0, "", std::move(problem), std::move(advice)};
}

Result<LookSource> shippedLook(const std::string& name) {
  std::vector<std::string> names;
  for (const ShippedLookFile& file : shippedLookFiles()) {
    if (file.name == name) return LookSource{name, std::string(file.text)};
    names.emplace_back(file.name);
  }
  const std::string suggestion = nearest(name, names);
  return Error{ErrorKind::usage,
               "",
               0,
               "",
               "no look is called '" + name + "'",
               suggestion.empty() ? "`scumble looks` lists them; a file's name ends in .json"
                                  : "did you mean '" + suggestion + "'?"};
}

// One name for one look, however it is written.
std::string identityOf(const std::string& nameOrFile) {
  std::error_code failed;
  const fs::path path = isLookFile(nameOrFile) ? fs::weakly_canonical(nameOrFile, failed) : fs::path();
  return failed || path.empty() ? nameOrFile : path.string();
}

}  // namespace

Result<LookSource> findLook(const std::string& nameOrFile) {
  if (!isLookFile(nameOrFile)) return shippedLook(nameOrFile);
  std::error_code ignored;
  if (nameOrFile.find('\0') != std::string::npos || !fs::is_regular_file(nameOrFile, ignored))
    return unusable(nameOrFile,
                    fs::exists(nameOrFile, ignored) ? "this is no ordinary file" : "there is no such look",
                    "give a JSON file, or a name that `scumble looks` lists");
  std::ifstream file(nameOrFile, std::ios::binary | std::ios::ate);
  const auto size = file ? file.tellg() : std::streampos(-1);
  if (!file || size < 0) return unusable(nameOrFile, "the look cannot be opened", "check the path");
  if (size_t(size) > kMaxLookFile)
    return unusable(
        nameOrFile,
        "this is too large for a look: " + std::to_string((size_t(size) + (1 << 20) - 1) >> 20) + " MiB",
        "a look has " + std::to_string(kMaxLookFile >> 20) + " MiB at most; check the path");
  std::string text(size_t(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size) && size > 0)
    return unusable(nameOrFile, "the look cannot be read", "check the path");
  return LookSource{nameOrFile, std::move(text)};
}

Status readExtended(const Json& name, const JsonPlace& place, const LookChain& chain, LookData& out) {
  if (!name.is_string() || name.get<std::string>().empty())
    return place.fail("it names no look",
                      "write the name of a look that ships, or of a .json beside this one");
  const std::string wanted = name.get<std::string>();
  std::string found = wanted;
  if (isLookFile(wanted)) {
    // A look may come with a scene from anywhere: it reads what lies beside itself and below.
    if (leadsOutside(wanted))
      return place.fail("this look lies outside of the look's folder", "put it beside the look");
    found = (fs::path(place.file).parent_path() / wanted).lexically_normal().string();
  }
  std::string way;
  bool isCircle = false;
  for (const std::string& one : chain) {
    isCircle |= identityOf(one) == identityOf(found);
    way += one + " -> ";
  }
  if (isCircle) return place.fail("these looks extend each other: " + way + found, "let one extend none");
  if (chain.size() > kMostExtended)
    return place.fail("more than " + std::to_string(kMostExtended) + " looks extend each other",
                      "put some of them together");
  const Result<LookSource> source = findLook(found);
  if (!source)
    return place.fail(
        source.error().file.empty() ? source.error().problem : "'" + wanted + "': " + source.error().problem,
        source.error().advice);
  return readLook(*source, chain, out);
}

}  // namespace scumble::look

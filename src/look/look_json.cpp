// Reading a look's JSON file; its tracks are read in look_json_track.cpp, what it extends in look_source.cpp.
#include "look/look_json.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "look/absent_groups.h"
#include "look/look_source.h"
#include "look/look_text.h"
#include "look/read_value.h"
#include "look/setting_path.h"

namespace scumble {

namespace look {

namespace {

std::string adviceFor(const ParamRow& row) {
  switch (row.kind) {
    case ParamKind::color:
      return "write a colour as \"#RRGGBB\", \"#RGB\" or a name of CSS";
    case ParamKind::choice:
      return std::string("choose one of ") + row.unit;
    case ParamKind::picture:
      return std::string("write a picture's path, or one of ") + row.unit;
    case ParamKind::toggle:
      return "write true or false";
    case ParamKind::triple:
      return "write three numbers, like [1, 2, 3]";
    case ParamKind::name:
      return "write a name in quotes";
    default:
      return "write a number";
  }
}

bool isTriple(const Json& value) {
  return value.is_array() && value.size() == 3 &&
         std::all_of(value.begin(), value.end(), [](const Json& number) { return number.is_number(); });
}

// Walks a look's JSON; the first mistake ends it.
class Reader {
 public:
  Reader(LookData& out, const LookChain& chain) : out_(out), chain_(chain), file_(chain.back()) {}

  Status readRoot(const Json& root) {
    if (!root.is_object()) return place("").fail("a look is a JSON object", "see `scumble schema`");
    // Wherever that stands, it comes first.
    if (root.contains("extends"))
      if (const Status status = readExtended(root["extends"], place("extends"), chain_, out_); !status)
        return status.error();
    for (const auto& [key, value] : root.items()) {
      if (key == "extends") continue;
      if (key == "$schema") {
        if (!value.is_string()) return place(key).fail("the schema is no string", "write its name in quotes");
        continue;
      }
      if (key == "description") {
        if (!value.is_string()) return place(key).fail("the description is no string", "write it in quotes");
        out_.description = value.get<std::string>();
        continue;
      }
      if (isAbsent(key, key)) continue;
      const Section* section = findSection(key);
      if (Status good = checkKey(key, key); !good) return good;
      Status status = section ? readSection(*section, value) : readGroup(value, key, "", nullptr, key);
      if (!status) return status;
    }
    return Done{};
  }

 private:
  JsonPlace place(const std::string& path) const { return {file_, path}; }

  // What a program with all features would know is left out, and that is said once: looks serve both.
  bool isAbsent(const std::string& key, const std::string& path) {
    const std::string feature = absentFeatureOf(key);
    if (feature.empty()) return false;
    if (!absent_.insert(key).second) return true;
    const Error left = place(path).fail("is left out: this program was built without '" + feature + "'", "");
    out_.warnings.push_back(left.message());
    return true;
  }

  // A key is one word of a knob's path, as the schema has it.
  Status checkKey(const std::string& key, const std::string& path) const {
    if (key.empty()) return place(path).fail("a key is empty", "give it a name, or leave it out");
    const size_t dot = key.find('.');
    if (dot == std::string::npos) return Done{};
    return place(path).fail("a dot stands in this key", "nest it: \"" + key.substr(0, dot) + "\": { \"" +
                                                            key.substr(dot + 1) + "\": ... }");
  }

  Status readSection(const Section& section, const Json& value) {
    const std::string one = section.one;
    if (!value.is_object())
      return place(section.name).fail("it is no object", "its keys are " + one + " names or patterns");
    size_t declared = 0;
    for (const auto& [pattern, knobs] : value.items()) {
      if (pattern.empty())
        return place(section.name).fail("a " + one + "'s pattern is empty", "'*' matches all");
      if (section.most > 0 && !isPattern(pattern) && ++declared > section.most)
        return place(std::string(section.name) + "." + pattern)
            .fail("these are too many " + std::string(section.name),
                  "a look declares " + std::to_string(section.most) + " at most");
      Status status = readGroup(knobs, "", pattern, &section, std::string(section.name) + "." + pattern);
      if (!status) return status;
    }
    // Those of the looks that this one extends count too.
    if (section.most > 0 && out_.declared(section.target).size() > section.most)
      return place(section.name)
          .fail("these are too many " + std::string(section.name) + ", with those of the look it extends",
                "a look declares " + std::to_string(section.most) + " at most");
    return Done{};
  }

  // `section`: nullptr for the whole scene.
  Status readGroup(const Json& value, const std::string& knobPath, const std::string& pattern,
                   const Section* section, const std::string& jsonPath) {
    // An object in a knob's place is a track; so is one with keys, at a path that is to be corrected.
    const bool isTrack =
        !knobPath.empty() && value.is_object() && (value.contains("keys") || isKnob(knobPath));
    if (value.is_object() && !isTrack) {
      // No knob lies deeper; a hostile file could use up the stack.
      if (std::count(knobPath.begin(), knobPath.end(), '.') > 8)
        return place(jsonPath).fail("there is no knob so deep inside", "`scumble params` lists them all");
      for (const auto& [key, child] : value.items()) {
        if (Status good = checkKey(key, jsonPath + "." + key); !good) return good;
        if (knobPath.empty() && isAbsent(key, jsonPath + "." + key)) continue;
        Status status = readGroup(child, knobPath.empty() ? key : knobPath + "." + key, pattern, section,
                                  jsonPath + "." + key);
        if (!status) return status;
      }
      return Done{};
    }
    if (knobPath.empty())
      return place(jsonPath).fail("it is no object", "give it knobs: `scumble params` lists them");
    const Result<KnobRef> knob = findKnob(knobPath, section ? section->target : ~Targets(0));
    if (!knob) return place(jsonPath).fail(knob.error().problem, knob.error().advice);
    const Targets allowed = knob->block->targets;
    Assignment assignment{pattern, knob->block, knob->row, {}};
    if (section) assignment.target = section->target;
    if (!(allowed & assignment.target))
      return place(jsonPath).fail("this knob holds for " + listed(allowed),
                                  allowed & kScene
                                      ? std::string("move it out of '") + section->name + "'"
                                      : std::string("move it under '") + firstSection(allowed).name + "'");
    if (isTrack) {
      Result<Track> track = readTrack(*knob->row, value, place(jsonPath), out_);
      if (!track) return track.error();
      assignment.value = track->at(*knob->row, 0);
      assignment.track = std::make_shared<const Track>(std::move(track).value());
    } else {
      const Result<Value> parsed = readJsonValue(*knob->row, value, place(jsonPath), out_);
      if (!parsed) return parsed.error();
      assignment.value = *parsed;
    }
    out_.assignments.push_back(std::move(assignment));
    return Done{};
  }

  LookData& out_;
  const LookChain& chain_;
  const std::string& file_;
  std::set<std::string> absent_;  // of which has been said that they are left out
};

}  // namespace

bool leadsOutside(const std::filesystem::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
}

Error JsonPlace::fail(std::string problem, std::string advice) const {
  return {ErrorKind::unusableFile, file, 0, path, std::move(problem), std::move(advice)};
}

Result<Value> readJsonValue(const ParamRow& row, const Json& value, const JsonPlace& place, LookData& data) {
  const bool wantsText = row.kind == ParamKind::color || row.kind == ParamKind::choice ||
                         row.kind == ParamKind::picture || row.kind == ParamKind::name;
  const bool fits = wantsText                       ? value.is_string()
                    : row.kind == ParamKind::toggle ? value.is_boolean()
                    : row.kind == ParamKind::triple ? isTriple(value)
                                                    : value.is_number();
  if (!fits) return place.fail("the value has the wrong type", adviceFor(row));
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (row.kind == ParamKind::triple) text = text.substr(1, text.size() - 2);  // without the brackets
  const std::filesystem::path folder = std::filesystem::path(place.file).parent_path();
  if (row.kind == ParamKind::picture) {
    // A look may come with a scene from anywhere: it reads pictures beside itself and below, and no others.
    if (!place.file.empty() && leadsOutside(text))
      return place.fail("this picture lies outside of the look's folder", "put it beside the look");
  }
  Result<Value> parsed = readValue(row, text, folder.string(), data);
  if (parsed) return parsed;
  if (place.file.empty() && !parsed.error().file.empty()) return parsed;
  const std::string problem = parsed.error().problem;
  return place.fail(parsed.error().file.empty() ? problem : "'" + text + "': " + problem,
                    parsed.error().advice);
}

Status readLook(const LookSource& source, LookChain chain, LookData& out) {
  const auto& [file, text] = source;
  chain.push_back(file);
  if (isLookFile(file)) out.files.push_back(file);
  const Result<Json> root = parseText(text, file, out.warnings);
  if (!root) return root.error();
  Status status = Reader(out, chain).readRoot(*root);
  if (status) return status;
  // The JSON has forgotten its lines; the text is gone through again for the one that is asked for.
  Error error = status.error();
  if (error.file == file && error.line == 0 && !error.jsonPath.empty())
    error.line = lineOfPath(text, error.jsonPath);
  return error;
}

}  // namespace look

}  // namespace scumble

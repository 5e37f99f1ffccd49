#include "look/setting_path.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "base/usage.h"

namespace scumble::look {

namespace {

Result<Assignment> assignmentTo(const std::string& knobPath, const std::string& pattern,
                                const Section* section) {
  const Result<KnobRef> knob = findKnob(knobPath);
  if (!knob) return knob.error();
  const Target target = section ? section->target : kScene;
  const Targets allowed = knob->block->targets;
  if (!(allowed & target)) {
    return usage("'" + knobPath + "' holds for " + listed(allowed),
                 allowed & kScene
                     ? std::string("set it without '") + section->name + ".'"
                     : std::string("write it like ") + firstSection(allowed).name + ".NAME." + knobPath);
  }
  Assignment assignment{pattern, knob->block, knob->row, {}};
  assignment.target = target;
  return assignment;
}

}  // namespace

const Section* findSection(const std::string& name) {
  for (const Section& section : kSections)
    if (name == section.name) return &section;
  return nullptr;
}

const Section& firstSection(Targets targets) {
  const Section* found = std::find_if(std::begin(kSections), std::end(kSections),
                                      [&](const Section& section) { return targets & section.target; });
  assert(found != std::end(kSections));
  return *found;
}

std::string listed(Targets targets) {
  std::vector<std::string> words;
  if (targets & kScene) words.emplace_back("the whole scene");
  for (const Section& section : kSections)
    if (targets & section.target) words.emplace_back(section.name);
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

namespace {

std::string exampleOf(const Section& section) {
  std::string begin = section.example;
  if (!begin.ends_with('.')) return begin;
  for (const ParamBlock* const block : allBlocks())
    if (block->targets & section.target) return begin + block->path + "." + block->rows.front().name;
  return begin + "GROUP.KNOB";
}

}  // namespace

Result<Assignment> parseSettingPath(const std::string& path) {
  const size_t end = path.find('.');
  const Section* section = end == std::string::npos ? nullptr : findSection(path.substr(0, end));
  if (!section) return assignmentTo(path, "", nullptr);
  const std::string rest = path.substr(end + 1), advice = "write it like " + exampleOf(*section);
  if (rest.empty() || rest[0] == '.') return usage("'" + path + "' names no " + section->one, advice);
  for (size_t dot = rest.rfind('.'); dot != std::string::npos && dot > 0; dot = rest.rfind('.', dot - 1))
    if (isKnob(rest.substr(dot + 1))) return assignmentTo(rest.substr(dot + 1), rest.substr(0, dot), section);
  const size_t dot = rest.find('.');
  if (dot == std::string::npos) return usage("'" + path + "' names no knob", advice);
  return findKnob(rest.substr(dot + 1), section->target).error();
}

}  // namespace scumble::look

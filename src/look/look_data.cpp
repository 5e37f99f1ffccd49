#include "look/look_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace scumble::look {

namespace {

void store(const ParamRow& row, const Value& value, void* out) {
  std::byte* target = static_cast<std::byte*>(out) + row.offset;
  const auto put = [&](const auto& v) { std::memcpy(target, &v, sizeof(v)); };
  switch (row.kind) {
    case ParamKind::number:
      put(float(value.number));
      break;
    case ParamKind::integer:
      put(int(value.number));
      break;
    case ParamKind::toggle:
      put(Toggle(value.number));
      break;
    case ParamKind::choice:
      put(Choice(value.number));
      break;
    case ParamKind::color:
      put(value.linear);
      break;
    case ParamKind::picture:
      put(Picture(value.number));
      break;
  }
}

Error badValue(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

void LookData::fill(const ParamBlock& block, void* out) const {
  for (const bool byHand : {false, true})
    for (const Assignment& a : assignments)
      if (a.block == &block && a.byHand == byHand && a.materialPattern.empty()) store(*a.row, a.value, out);
}

void LookData::fillForMaterial(const ParamBlock& block, const std::string& material, void* out) const {
  for (const bool byHand : {false, true})
    for (const bool forMaterials : {false, true})
      for (const Assignment& a : assignments)
        if (a.block == &block && a.byHand == byHand && a.materialPattern.empty() != forMaterials &&
            (!forMaterials || matches(a.materialPattern, material)))
          store(*a.row, a.value, out);
}

bool matches(const std::string& pattern, const std::string& name) {
  // Greedy with one point of return: the last '*' seen.
  size_t p = 0, n = 0, star = std::string::npos, retry = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p, ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++retry;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  size_t bestDistance = std::max<size_t>(2, std::min<size_t>(word.size(), 64) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const size_t distance = editDistance(word.substr(0, 64), candidate);
    if (distance < bestDistance) best = candidate, bestDistance = distance;
  }
  return best;
}

Result<KnobRef> findKnob(const std::string& path) {
  std::vector<std::string> known;
  for (const ParamBlock* block : allBlocks())
    for (const ParamRow& row : block->rows) {
      known.push_back(std::string(block->path) + "." + row.name);
      if (known.back() == path) return KnobRef{block, &row};
    }
  std::string suggestion = nearest(path, known);
  if (suggestion.empty()) {
    // A right name under the wrong block is a frequent slip.
    const std::string last = path.substr(path.rfind('.') + 1);
    for (const std::string& candidate : known)
      if (candidate.substr(candidate.rfind('.') + 1) == last) suggestion = candidate;
  }
  return badValue("there is no knob '" + path + "'", suggestion.empty()
                                                         ? "`scumble params` lists them all"
                                                         : "did you mean '" + suggestion + "'?");
}

Result<Value> parseValue(const ParamRow& row, const std::string& text) {
  if (row.kind == ParamKind::color) {
    // Digits only: strtoul would also take a sign, spaces and 0x.
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
      return badValue("'" + text + "' is no colour", "write it as #RRGGBB");
    return Value{0, linearFromSrgb(uint32_t(std::strtoul(text.c_str() + 1, nullptr, 16)))};
  }
  if (row.kind == ParamKind::choice || row.kind == ParamKind::picture) {
    const std::vector<std::string> names = choiceNames(row);
    const auto it = std::find(names.begin(), names.end(), text);
    if (it == names.end()) return badValue("'" + text + "' is none of " + row.unit, "choose one of them");
    return Value{double(it - names.begin()), {}};
  }
  if (row.kind == ParamKind::toggle) {
    if (text == "true" || text == "1" || text == "on") return Value{1, {}};
    if (text == "false" || text == "0" || text == "off") return Value{0, {}};
    return badValue("'" + text + "' is neither true nor false", "write true or false");
  }
  char* end = nullptr;
  const double number = text.empty() ? 0 : std::strtod(text.c_str(), &end);
  if (!end || *end || !std::isfinite(number))
    return badValue("'" + text + "' is no number", "write a number");
  if (number < row.min || number > row.max)
    return badValue(fmt::format("{} is out of range", text),
                    fmt::format("it may be {:g} to {:g}", row.min, row.max));
  if (row.kind == ParamKind::integer && number != std::floor(number))
    return badValue("'" + text + "' is no whole number", "write a whole number");
  return Value{number, {}};
}

std::string formatValue(const ParamRow& row, double number) {
  switch (row.kind) {
    case ParamKind::toggle:
      return number != 0 ? "true" : "false";
    case ParamKind::choice:
    case ParamKind::picture:
      return choiceNames(row)[size_t(number)];
    case ParamKind::color:
      return fmt::format("#{:06X}", uint32_t(number));
    default:
      return fmt::format("{:g}", number);
  }
}

}  // namespace scumble::look

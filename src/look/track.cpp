#include "look/track.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/oklab.h"

namespace scumble::look {

namespace {

// Seconds. Frame numbers over frame rates and sums of periods round: what is this near a jump is past it.
constexpr double kRounding = 1e-6;

bool isColor(const ParamRow& row) {
  return row.kind == ParamKind::color;
}

// Where values are mixed: OKLab for colours, the first component for numbers.
glm::dvec3 toMix(const ParamRow& row, const Value& value) {
  if (row.kind == ParamKind::triple) return value.linear;
  return isColor(row) ? oklabFromLinear(value.linear) : glm::dvec3(value.number, 0, 0);
}

Value fromMix(const ParamRow& row, const glm::dvec3& mix) {
  // A chord through OKLab, or a cubic's overshoot, may leave what the knob takes.
  if (isColor(row)) return {0, glm::vec3(glm::clamp(linearFromOklab(mix), 0.0, 1.0))};
  if (row.kind == ParamKind::triple) return {0, glm::vec3(glm::clamp(mix, row.min, row.max))};
  const double number = std::clamp(mix.x, row.min, row.max);
  return {row.kind == ParamKind::integer ? std::round(number) : number, {}};
}

// Two keys around a time, and the neighbours that shape a cubic's tangents. Times are in seconds.
struct Neighbours {
  double before, from, to, after;
  glm::dvec3 valueBefore, valueFrom, valueTo, valueAfter;
};

Neighbours around(const Track& track, const ParamRow& row, size_t i) {
  const std::vector<Key>& keys = track.keys;
  const size_t last = keys.size() - 1;
  const auto mix = [&](size_t k) { return toMix(row, keys[k].value); };
  Neighbours n{keys[i].time, keys[i].time, keys[i + 1].time, keys[i + 1].time,
               mix(i),       mix(i),       mix(i + 1),       mix(i + 1)};
  const double period = keys[last].time - keys[0].time;
  const bool isClosed = track.repeat && mix(0) == mix(last);
  if (i > 0)
    n.before = keys[i - 1].time, n.valueBefore = mix(i - 1);
  else if (isClosed)
    n.before = keys[last - 1].time - period, n.valueBefore = mix(last - 1);
  if (i + 1 < last)
    n.after = keys[i + 2].time, n.valueAfter = mix(i + 2);
  else if (isClosed)
    n.after = keys[1].time + period, n.valueAfter = mix(1);
  return n;
}

// Tangents times the interval's length, written so that near keys do not divide by next to nothing.
struct Tangents {
  glm::dvec3 leaving, arriving;
};

Tangents cubicTangents(const Neighbours& n) {
  const double length = n.to - n.from;
  return {(n.valueTo - n.valueBefore) * (length / (n.to - n.before)),
          (n.valueAfter - n.valueFrom) * (length / (n.after - n.from))};
}

// Those of `cubic`, but none where the values turn back, stay or end, and nowhere steeper than three times
// the straight way on either side: so they stay monotone (Fritsch and Carlson 1980).
Tangents easeTangents(const Neighbours& n) {
  const double length = n.to - n.from, before = n.from - n.before, after = n.after - n.to;
  Tangents tangents = cubicTangents(n);
  const auto rein = [length](double& tangent, double here, double there, double thereLength) {
    if (thereLength <= 0 || here * there <= 0)
      tangent = 0;
    else
      tangent = std::copysign(
          std::min({std::abs(tangent), 3 * std::abs(here), 3 * std::abs(there) * (length / thereLength)}),
          here);
  };
  for (int i = 0; i < 3; ++i) {
    const double here = n.valueTo[i] - n.valueFrom[i];
    rein(tangents.leaving[i], here, n.valueFrom[i] - n.valueBefore[i], before);
    rein(tangents.arriving[i], here, n.valueAfter[i] - n.valueTo[i], after);
  }
  return tangents;
}

glm::dvec3 hermite(const Neighbours& n, const Tangents& tangents, double u) {
  const auto& [leaving, arriving] = tangents;
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * n.valueFrom + (u3 - 2 * u2 + u) * leaving + (3 * u2 - 2 * u3) * n.valueTo +
         (u3 - u2) * arriving;
}

}  // namespace

bool isSmooth(ParamKind kind) {
  return kind == ParamKind::number || kind == ParamKind::integer || kind == ParamKind::color ||
         kind == ParamKind::triple;
}

Value Track::at(const ParamRow& row, double time) const {
  assert(!keys.empty() && (interpolation == Interpolation::step || isSmooth(row.kind)));
  const double first = keys.front().time, period = keys.back().time - first;
  if (repeat && period > 0) {
    double phase = std::fmod(time - first, period);
    if (phase < 0) phase += period;
    time = phase + kRounding < period ? first + phase : first;
  }
  if (!(time >= first)) return keys.front().value;
  // The last key that is not later.
  const double reached = interpolation == Interpolation::step ? time + kRounding : time;
  const auto next = std::upper_bound(keys.begin(), keys.end(), reached,
                                     [](double t, const Key& key) { return t < key.time; });
  const size_t i = size_t(next - keys.begin()) - 1;
  if (interpolation == Interpolation::step || next == keys.end() || time == keys[i].time)
    return keys[i].value;
  const double u = (time - keys[i].time) / (next->time - keys[i].time);
  if (interpolation == Interpolation::cubic || interpolation == Interpolation::ease) {
    const Neighbours n = around(*this, row, i);
    return fromMix(row,
                   hermite(n, interpolation == Interpolation::cubic ? cubicTangents(n) : easeTangents(n), u));
  }
  return fromMix(row, glm::mix(toMix(row, keys[i].value), toMix(row, next->value), u));
}

}  // namespace scumble::look

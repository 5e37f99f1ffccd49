#include "features/ocean/ocean_travel.h"

#include <algorithm>
#include <cmath>

#include "features/ocean/ocean.h"

namespace scumble::ocean {

namespace {

// Metres a second by which an integral may be wrong.
constexpr double kTolerance = 1e-6;
// Between keys, values are smooth but for a few kinks where a cubic leaves the knob's range.
constexpr int kHalvings = 24;
// More keys than this in one stretch, by repetition, are not looked at one by one: that bounds the cost.
constexpr double kMostBreaks = 1 << 18;
constexpr int kHalvingsWithoutBreaks = 12;
// Two tracks that repeat have a common period of this many of the first one's at most.
constexpr int kMostRepeats = 1000;

// A number of the look over time.
struct Signal {
  const look::ParamRow* row = nullptr;
  const look::Track* track = nullptr;  // of at least two keys; null: constant
  double constant = 0;

  double at(double time) const { return track ? track->at(*row, time).number : constant; }
  double first() const { return track->keys.front().time; }
  double last() const { return track->keys.back().time; }
  double period() const { return track->repeat ? last() - first() : 0; }
  bool variesIn(double from, double to) const {
    return track && (track->repeat || (from < last() && to > first()));
  }
  double breaksIn(double from, double to) const {
    const double repeats = track->repeat ? (to - from) / period() + 1 : 1;
    return repeats * double(track->keys.size());
  }
  // Times of keys between two times; what repeats, over and over.
  void addBreaks(double from, double to, std::vector<double>& breaks) const {
    const double turns = track->repeat ? std::floor((from - first()) / period()) : 0;
    for (double turn = turns; first() + turn * period() < to; ++turn) {
      for (const look::Key& key : track->keys)
        if (const double time = key.time + turn * period(); time > from && time < to) breaks.push_back(time);
      if (!track->repeat) break;
    }
  }
};

// 0 where there is none.
double commonPeriod(double a, double b) {
  for (int n = 1; n <= kMostRepeats; ++n) {
    const double turns = n * a / b;
    if (turns > 0.5 && std::abs(turns - std::round(turns)) <= 1e-12 * turns) return n * a;
  }
  return 0;
}

class Course {
 public:
  explicit Course(const look::LookData& look) {
    const OceanParams still = look.get<OceanParams>();
    const auto signal = [&](const char* name, float constant) {
      const look::Assignment* set = look.settingOf(OceanParams::block(), name);
      Signal made{nullptr, nullptr, double(constant)};
      if (set && set->track && set->track->keys.size() > 1) made.row = set->row, made.track = &*set->track;
      return made;
    };
    speed_ = signal("speed", still.speed);
    heading_ = signal("heading", still.heading);
  }

  // From one time to a later one: from key to last key of what does not repeat, and outside of them.
  glm::dvec2 integral(double from, double to) const {
    std::vector<double> ends{from, to};
    for (const Signal* signal : {&speed_, &heading_})
      if (signal->track && !signal->track->repeat)
        for (const double end : {signal->first(), signal->last()})
          if (end > from && end < to) ends.push_back(end);
    std::sort(ends.begin(), ends.end());
    glm::dvec2 sum(0.0);
    for (size_t i = 0; i + 1 < ends.size(); ++i) sum += stretch(ends[i], ends[i + 1]);
    return sum;
  }

 private:
  glm::dvec2 velocity(double time) const {
    const double angle = glm::radians(heading_.at(time));
    return speed_.at(time) * glm::dvec2(std::cos(angle), std::sin(angle));
  }

  // Whole periods count so many times as there are of them.
  glm::dvec2 stretch(double from, double to) const {
    const bool speeds = speed_.variesIn(from, to), turns = heading_.variesIn(from, to);
    if (!speeds && !turns) return velocity(0.5 * (from + to)) * (to - from);
    double period = 0;
    if (speeds && turns)
      period = speed_.track->repeat && heading_.track->repeat
                   ? commonPeriod(speed_.period(), heading_.period())
                   : 0;
    else
      period = (speeds ? speed_ : heading_).period();
    const double whole = period > 0 ? std::floor((to - from) / period) : 0;
    glm::dvec2 sum(0.0);
    if (whole > 0) sum = whole * fromKeyToKey(from, from + period);
    return sum + fromKeyToKey(from, to - whole * period);
  }

  glm::dvec2 fromKeyToKey(double from, double to) const {
    std::vector<const Signal*> varying;
    double count = 0;
    for (const Signal* signal : {&speed_, &heading_})
      if (signal->variesIn(from, to)) varying.push_back(signal), count += signal->breaksIn(from, to);
    if (count > kMostBreaks) return settled(from, to, gauss(from, to), kHalvingsWithoutBreaks);
    std::vector<double> breaks{from, to};
    for (const Signal* signal : varying) signal->addBreaks(from, to, breaks);
    std::sort(breaks.begin(), breaks.end());
    glm::dvec2 sum(0.0);
    for (size_t i = 0; i + 1 < breaks.size(); ++i)
      sum += settled(breaks[i], breaks[i + 1], gauss(breaks[i], breaks[i + 1]), kHalvings);
    return sum;
  }

  // Halves until halves change nothing any more.
  glm::dvec2 settled(double from, double to, const glm::dvec2& whole, int halvings) const {
    const double middle = 0.5 * (from + to);
    const glm::dvec2 left = gauss(from, middle), right = gauss(middle, to);
    if (halvings == 0 || glm::length(left + right - whole) <= kTolerance * (to - from)) return left + right;
    return settled(from, middle, left, halvings - 1) + settled(middle, to, right, halvings - 1);
  }

  // Gauss and Legendre's rule of four points.
  glm::dvec2 gauss(double from, double to) const {
    constexpr double kAt[] = {0.33998104358485626, 0.86113631159405258},
                     kWeight[] = {0.65214515486254614, 0.34785484513745386};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    glm::dvec2 sum(0.0);
    for (int i = 0; i < 2; ++i)
      sum += kWeight[i] * (velocity(middle - half * kAt[i]) + velocity(middle + half * kAt[i]));
    return half * sum;
  }

  Signal speed_, heading_;
};

}  // namespace

Travelled travelledBy(const look::LookData& look) {
  return [course = Course(look)](double time) {
    return time < 0 ? -course.integral(time, 0) : course.integral(0, time);
  };
}

}  // namespace scumble::ocean

#include "features/ocean/waves/waves.h"

#include <kiss_fft.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace scumble::ocean {

namespace {

glm::vec2 times(const glm::vec2& a, const glm::vec2& b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

glm::vec2 conjugate(const glm::vec2& a) {
  return {a.x, -a.y};
}

glm::vec2 timesI(const glm::vec2& a) {
  return {-a.y, a.x};
}

}  // namespace

Waves::Waves(const Spectrum& spectrum) : spectrum_(spectrum) {
  assert(spectrum.grid >= 1 && spectrum.grid <= 256 && spectrum.tile > 0 && spectrum.wind >= 0 &&
         spectrum.fetch > 0 && spectrum.depth > 0 && spectrum.loop > 0 && spectrum.height >= 0 &&
         spectrum.smallest >= 0);
  const int last = lastWave(spectrum), grid = spectrum.grid;
  const double step = 2 * std::numbers::pi / spectrum.tile;
  const auto element = [&](int x, int z) { return uint32_t((x + grid) % grid * grid + (z + grid) % grid); };

  double slopeVariance = 0;
  for (int z = 0; z <= last; ++z)
    for (int x = z == 0 ? 1 : -last; x <= last; ++x) {
      const double forth = waveVariance(spectrum, x, z), back = waveVariance(spectrum, -x, -z);
      const std::complex<double> along = amplitude(spectrum, forth, x, z);
      const std::complex<double> against = amplitude(spectrum, back, -x, -z);
      const double length = step * std::hypot(x, z);
      variance_ += forth + back;
      slopeVariance += (forth + back) * length * length;

      Pair pair;
      pair.at = element(x, z);
      pair.opposite = element(-x, -z);
      pair.cycles = cycles(spectrum, length);
      pair.along = glm::vec2(along.real(), along.imag());
      pair.against = glm::vec2(against.real(), -against.imag());
      pair.k = glm::vec2(step * x, step * z);
      pair.inverseLength = float(1 / length);
      if (pair.along == glm::vec2(0) && pair.against == glm::vec2(0)) continue;
      pairs_.push_back(pair);
      mostCycles_ = std::max(mostCycles_, pair.cycles);
    }
  if (slopeVariance > 0) typicalLength_ = float(std::sqrt(variance_ / slopeVariance));
  if (!pairs_.empty())
    plan_.reset(kiss_fft_alloc(grid, 1, nullptr, nullptr), [](kiss_fft_state* plan) { kiss_fft_free(plan); });
}

// Two real fields by one complex transform: the spectrum of a real field has conjugate values at opposite
// waves, so one field comes out as the real part and the other as the imaginary part of a + i b.
// `factors(pair)` gives by what the heights' spectrum is to be multiplied for each of the two;
// `take(z, row)` gets a row of values, the first field in r and the second in i.
template <class Factors, class Take>
void Waves::transform(const std::vector<glm::vec2>& heights, Factors&& factors, Take&& take) const {
  const size_t grid = size_t(spectrum_.grid);
  std::vector<kiss_fft_cpx> spectrum(grid * grid, kiss_fft_cpx{0, 0}), half(grid * grid), row(grid);
  for (size_t p = 0; p < pairs_.size(); ++p) {
    const glm::vec2 both = factors(pairs_[p]);
    const glm::vec2 here = times(both, heights[p]), there = times(both, conjugate(heights[p]));
    spectrum[pairs_[p].at] = {here.x, here.y};
    spectrum[pairs_[p].opposite] = {there.x, there.y};
  }
  // kissfft's own transform in two dimensions keeps scratch memory in its plan, so threads could not share
  // it.
  kiss_fft_state* const plan = const_cast<kiss_fft_state*>(plan_.get());
  for (size_t x = 0; x < grid; ++x) kiss_fft(plan, &spectrum[x * grid], &half[x * grid]);
  for (size_t z = 0; z < grid; ++z) {
    kiss_fft_stride(plan, &half[z], row.data(), int(grid));
    take(z, row.data());
  }
}

void Waves::at(double seconds, WaveField& out) const {
  // Calm water, to begin with.
  const size_t grid = size_t(spectrum_.grid);
  out.grid = spectrum_.grid;
  out.tile = spectrum_.tile;
  out.displacement.assign(grid * grid, glm::vec4(0, 0, 0, 1));
  out.slopes.assign(grid * grid, glm::vec2(0));
  out.normals.assign(grid * grid, glm::vec3(0, 1, 0));
  out.leastShift = out.greatestShift = glm::vec2(0);
  if (pairs_.empty()) return;

  // h(k, t) of eq. 26, but with waves that travel along k, not against it.
  double loops = seconds / spectrum_.loop;
  loops -= std::floor(loops);
  std::vector<glm::vec2> turned(mostCycles_ + 1);
  for (size_t c = 0; c < turned.size(); ++c) {
    const double turns = double(c) * loops, angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    turned[c] = glm::vec2(std::cos(angle), -std::sin(angle));
  }
  std::vector<glm::vec2> heights(pairs_.size()), odd(pairs_.size());
  for (size_t p = 0; p < pairs_.size(); ++p) {
    const glm::vec2& turn = turned[pairs_[p].cycles];
    heights[p] = times(pairs_[p].along, turn) + times(pairs_[p].against, conjugate(turn));
    odd[p] = timesI(heights[p]);
  }

  // Height, and how the displacement along x changes along z (in w, for now). What shares a transform must be
  // of a size, or the one drowns in the other's rounding.
  const float choppiness = float(spectrum_.choppiness), scale = typicalLength_;
  transform(
      heights,
      [&](const Pair& p) { return glm::vec2(1, -scale * choppiness * p.k.x * p.k.y * p.inverseLength); },
      [&](size_t z, const kiss_fft_cpx* row) {
        for (size_t x = 0; x < grid; ++x) {
          out.displacement[z * grid + x].y = row[x].r;
          out.displacement[z * grid + x].w = row[x].i / scale;
        }
      });
  transform(
      odd, [](const Pair& p) { return p.k; },
      [&](size_t z, const kiss_fft_cpx* row) {
        for (size_t x = 0; x < grid; ++x) out.slopes[z * grid + x] = {row[x].r, row[x].i};
      });
  if (choppiness == 0) {
    for (size_t i = 0; i < grid * grid; ++i) {
      out.displacement[i].w = 1;
      out.normals[i] = glm::normalize(glm::vec3(-out.slopes[i].x, 1, -out.slopes[i].y));
    }
    return;
  }

  // Eq. 29 with the other sign, which draws water towards crests.
  out.leastShift = glm::vec2(std::numeric_limits<float>::max());
  out.greatestShift = -out.leastShift;
  transform(
      odd, [&](const Pair& p) { return choppiness * p.inverseLength * p.k; },
      [&](size_t z, const kiss_fft_cpx* row) {
        for (size_t x = 0; x < grid; ++x) {
          const glm::vec2 shift(row[x].r, row[x].i);
          out.displacement[z * grid + x].x = shift.x;
          out.displacement[z * grid + x].z = shift.y;
          out.leastShift = glm::min(out.leastShift, shift);
          out.greatestShift = glm::max(out.greatestShift, shift);
        }
      });
  // Normals of the displaced surface, and by how much it is stretched (eq. 29 differentiated).
  transform(
      heights, [&](const Pair& p) { return -choppiness * p.inverseLength * p.k * p.k; },
      [&](size_t z, const kiss_fft_cpx* row) {
        for (size_t x = 0; x < grid; ++x) {
          float& w = out.displacement[z * grid + x].w;
          const glm::vec2& slope = out.slopes[z * grid + x];
          const glm::vec3 alongX(1 + row[x].r, slope.x, w), alongZ(w, slope.y, 1 + row[x].i);
          const glm::vec3 normal = glm::cross(alongZ, alongX);
          w = normal.y;
          if (const float length = glm::length(normal); length > 0)
            out.normals[z * grid + x] = normal / length;
        }
      });
}

}  // namespace scumble::ocean

// What the ocean's waves cost on one core, as a table: waves_bench [GRID...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "features/ocean/waves/surface.h"

using namespace scumble::ocean;

namespace {

// Milliseconds of the middle one of several calls.
template <class Call>
double milliseconds(int repeats, Call&& call) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    call(i);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[size_t(repeats / 2)];
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<int> grids;
  for (int i = 1; i < count; ++i) grids.push_back(std::clamp(std::atoi(arguments[i]), 1, 256));
  if (grids.empty()) grids = {40, 64, 80, 83, 128, 256};
  std::printf("grid  significant m  construct ms  at ms   surfaceAt us  floatingAt us\n");
  double keep = 0;
  for (const int grid : grids) {
    Spectrum spectrum;
    spectrum.grid = grid;
    const Waves waves(spectrum);
    WaveField field;
    const double construct = milliseconds(5, [&](int) { keep += Waves(spectrum).variance(); });
    const double at = milliseconds(201, [&](int i) { waves.at(i * 0.1, field); });
    constexpr int kPoints = 1000;
    const double surface = milliseconds(21, [&](int) {
      for (int i = 0; i < kPoints; ++i) keep += surfaceAt(field, i * 0.37, i * 0.11).height;
    });
    const double floating =
        milliseconds(101, [&](int i) { keep += floatingAt(field, i, 2 * i, 12, 4, i).height; });
    std::printf("%4d  %13.2f  %12.2f  %5.3f  %12.3f  %13.2f\n", grid, 4 * std::sqrt(waves.variance()),
                construct, at, surface, floating * 1000);
  }
  return std::isfinite(keep) ? 0 : 1;
}

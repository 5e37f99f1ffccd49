#ifndef SCUMBLE_PREFIX_SUM_SHARED_H
#define SCUMBLE_PREFIX_SUM_SHARED_H
#ifdef __cplusplus
#include <cstdint>
namespace scumble::gpu {
using uint = uint32_t;
#endif

const uint kSumThreads = 64, kSumRun = 32, kSumBlock = kSumThreads * kSumRun;
// Radix sort: digits of so many bits, and what a workgroup ranks.
const uint kDigitBits = 4, kDigits = 1 << kDigitBits;
const uint kSortThreads = 64, kSortRun = 32, kSortBlock = kSortThreads * kSortRun;

#ifdef __cplusplus
}
#endif
#endif

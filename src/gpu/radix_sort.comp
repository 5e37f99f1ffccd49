#version 460
// A radix sort, the least significant digit first: how often a digit occurs in each block of keys; with kScatters, after
// prefix sums over these, every pair goes to its place. With WHOLE defined: all digits at once, of no more than one block.
// Ranks within a block follow the order of its threads and of the keys of each, so that the sort is stable, and the same on
// every device.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "prefix_sum.shared.h"

layout(constant_id = 0) const bool kScatters = false;
layout(constant_id = 1) const uint kAllDigits = 8;  // of WHOLE

#ifdef WHOLE
#define SHARES coherent  // what a thread has written another one reads
#else
#define SHARES
#endif

layout(local_size_x = kSortThreads) in;
layout(set = 0, binding = 0, scalar) SHARES buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, scalar) SHARES buffer Values { uint values[]; };
layout(set = 0, binding = 2, scalar) SHARES buffer OtherKeys { uint otherKeys[]; };
layout(set = 0, binding = 3, scalar) SHARES buffer OtherValues { uint otherValues[]; };
layout(set = 0, binding = 4, scalar) buffer Counts { uint counts[]; };  // by digit, then by block
layout(push_constant, scalar) uniform Push { uint count, blocks, which; };  // which digit, but of WHOLE

// By thread, two digits in each word: a block has fewer than 2^16 keys.
const uint kWords = kDigits / 2;
shared uint ranks[kWords][kSortThreads];
shared uint totals[kWords];

uint digitOf(uint key, uint digit) { return key >> digit * kDigitBits & (kDigits - 1); }
uint half16(uint word, uint digit) { return word >> 16 * (digit & 1) & 0xFFFFu; }

// How often threads before this one have each digit, and how often all have.
void rank(uint first, uint end, uint digit, bool back) {
  uint thread = gl_LocalInvocationID.x;
  for (uint w = 0; w < kWords; ++w) ranks[w][thread] = 0;
  for (uint i = first; i < end; ++i) {
    uint d = digitOf(back ? otherKeys[i] : keys[i], digit);
    ranks[d / 2][thread] += 1u << 16 * (d & 1);
  }
  barrier();
  // One thread for each word goes through them: barriers cost CPU drivers more.
  if (thread < kWords) {
    uint before = 0;
    for (uint i = 0; i < kSortThreads; ++i) {
      uint own = ranks[thread][i];
      ranks[thread][i] = before;
      before += own;
    }
    totals[thread] = before;
  }
  barrier();
}

#ifdef WHOLE
shared uint places[kDigits];
#endif

// The place of the thread's next pair of a digit within its block.
uint nextOf(uint d) {
  uint thread = gl_LocalInvocationID.x, place = half16(ranks[d / 2][thread], d);
  ranks[d / 2][thread] += 1u << 16 * (d & 1);
  return place;
}

void main() {
  uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  uint first = block * kSortBlock + thread * kSortRun, end = min(first + kSortRun, count);
#ifdef WHOLE
  for (uint digit = 0; digit < kAllDigits; ++digit) {
    bool back = (digit & 1) != 0;
    rank(first, end, digit, back);
    if (thread == 0)
      for (uint d = 0, before = 0; d < kDigits; before += half16(totals[d / 2], d), ++d) places[d] = before;
    barrier();
    for (uint i = first; i < end; ++i) {
      uint key = back ? otherKeys[i] : keys[i], value = back ? otherValues[i] : values[i];
      uint d = digitOf(key, digit), place = places[d] + nextOf(d);
      if (back)
        keys[place] = key, values[place] = value;
      else
        otherKeys[place] = key, otherValues[place] = value;
    }
    memoryBarrierBuffer();
    barrier();
  }
#else
  if (block >= blocks) return;
  rank(first, end, which, false);
  if (!kScatters) {
    if (thread < kDigits) counts[thread * blocks + block] = half16(totals[thread / 2], thread);
    return;
  }
  for (uint i = first; i < end; ++i) {
    uint d = digitOf(keys[i], which), place = counts[d * blocks + block] + nextOf(d);
    otherKeys[place] = keys[i];
    otherValues[place] = values[i];
  }
#endif
}

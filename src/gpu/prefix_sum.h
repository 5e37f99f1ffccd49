// Exclusive prefix sums and a stable sort on the device, for whoever compacts or orders what the device has
// made. Neither assumes a subgroup's size, nor that one workgroup goes on while another one waits; results
// are the same on every device, however many threads it has.
#pragma once

#include <array>
#include <vector>

#include "gpu/pipeline.h"

namespace scumble::gpu {

// Of numbers below 2^32 whose sum is.
class PrefixSum {
 public:
  PrefixSum() = default;
  // `values`: a storage buffer of at least `most` 32-bit numbers from its beginning on; it outlives this.
  PrefixSum(Device& device, const Buffer& values, uint32_t most);

  // Records: each of the first `count` numbers (up to `most`) becomes the sum of those before it. Reads what
  // compute shaders have written before; what comes after needs a barrier of its own.
  void record(VkCommandBuffer commands, uint32_t count) const;

 private:
  Pipeline scans_, adds_;
  DescriptorSets sets_;         // one a level
  std::vector<Buffer> levels_;  // the sums of blocks, of blocks of blocks, ...; the last is one number
};

// Pairs of a 32-bit key and a 32-bit value by their keys, the least first; equal keys keep their order
// (a radix sort by digits of 4 bits, ranked in shared memory).
class RadixSort {
 public:
  RadixSort() = default;
  // Of up to `most` pairs, by the lowest `keyBits` of their keys, rounded up to a multiple of 8.
  RadixSort(Device& device, uint32_t most, uint32_t keyBits = 32);

  // Storage buffers, which may be copied to and from: what is to be sorted is written here, and lies here
  // sorted.
  const Buffer& keys() const { return keys_[0]; }
  const Buffer& values() const { return values_[0]; }
  // How many pairs there is room for; 0 before it is made.
  uint32_t most() const { return most_; }

  // Records the sort of the first `count` pairs. Reads what compute shaders have written before; what comes
  // after needs a barrier of its own.
  void record(VkCommandBuffer commands, uint32_t count) const;

 private:
  uint32_t most_ = 0, digitCount_ = 0;
  Pipeline counts_, scatters_, whole_;
  DescriptorSets sets_;  // from the first buffers to the second ones, and back
  std::array<Buffer, 2> keys_, values_;
  Buffer digits_;
  PrefixSum sum_;
};

}  // namespace scumble::gpu

#include "gpu/prefix_sum.h"

#include <algorithm>
#include <cassert>

#include "gpu/dispatch.h"
#include "gpu/prefix_sum.shared.h"
#include "shaders/prefix_sum_comp.h"
#include "shaders/radix_sort_comp.h"
#include "shaders/radix_sort_whole_comp.h"

namespace scumble::gpu {

namespace {

constexpr uint32_t blocksOf(uint32_t count, uint32_t block) {
  return uint32_t((uint64_t(count) + block - 1) / block);
}

Buffer numbers(Device& device, uint32_t count) {
  return Buffer(device, std::max(1u, count) * sizeof(uint32_t),
                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                    VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                MemoryKind::device);
}

ComputePipelineDesc description(Shader shader, const SetLayout& layout, std::vector<uint32_t> constants,
                                uint32_t pushed) {
  ComputePipelineDesc desc;
  desc.shader = shader;
  desc.constants = std::move(constants);
  desc.sets = {layout.handle()};
  desc.pushConstantBytes = pushed;
  return desc;
}

SetLayout storageBuffers(Device& device, size_t count) {
  return SetLayout(
      device, std::vector<Binding>(count, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}));
}

}  // namespace

PrefixSum::PrefixSum(Device& device, const Buffer& values, uint32_t most) {
  for (uint32_t count = blocksOf(std::max(1u, most), kSumBlock);; count = blocksOf(count, kSumBlock)) {
    levels_.push_back(numbers(device, count));
    if (count == 1) break;
  }
  const SetLayout layout = storageBuffers(device, 2);
  scans_ = Pipeline(device, description({shaders::prefix_sum_comp}, layout, {0}, 4));
  adds_ = Pipeline(device, description({shaders::prefix_sum_comp}, layout, {1}, 4));
  sets_ = DescriptorSets(device, layout, uint32_t(levels_.size()));
  for (size_t level = 0; level < levels_.size(); ++level) {
    sets_.writeBuffer(level, 0, (level == 0 ? values : levels_[level - 1]).handle());
    sets_.writeBuffer(level, 1, levels_[level].handle());
  }
}

void PrefixSum::record(VkCommandBuffer commands, uint32_t count) const {
  if (count == 0) return;
  std::vector<uint32_t> counts{count};
  while (counts.back() > kSumBlock) counts.push_back(blocksOf(counts.back(), kSumBlock));
  assert(counts.size() <= levels_.size());
  const auto run = [&](const Pipeline& pipeline, size_t level) {
    computeBarrier(commands);
    const uint32_t groups = blocksOf(counts[level], kSumBlock);
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, sets_[level]);
    pipeline.push(commands, {counts[level]});
    dispatch(commands, groups);
  };
  for (size_t level = 0; level < counts.size(); ++level) run(scans_, level);
  for (size_t level = counts.size() - 1; level-- > 0;) run(adds_, level);
}

// An even number of digits, so that the last one goes back to where the first one came from.
RadixSort::RadixSort(Device& device, uint32_t most, uint32_t keyBits)
    : most_(std::max(1u, most)), digitCount_(2 * blocksOf(std::min(keyBits, 32u), 2 * kDigitBits)) {
  for (Buffer& buffer : keys_) buffer = numbers(device, most);
  for (Buffer& buffer : values_) buffer = numbers(device, most);
  const uint32_t digits = kDigits * blocksOf(most_, kSortBlock);
  digits_ = numbers(device, digits);
  sum_ = PrefixSum(device, digits_, digits);
  const SetLayout layout = storageBuffers(device, 5);
  counts_ = Pipeline(device, description({shaders::radix_sort_comp}, layout, {0}, 12));
  scatters_ = Pipeline(device, description({shaders::radix_sort_comp}, layout, {1}, 12));
  whole_ = Pipeline(device, description({shaders::radix_sort_whole_comp}, layout, {0, digitCount_}, 12));
  sets_ = DescriptorSets(device, layout, 2);
  for (const uint32_t from : {0u, 1u}) {
    const Buffer* const buffers[] = {&keys_[from], &values_[from], &keys_[1 - from], &values_[1 - from],
                                     &digits_};
    for (uint32_t i = 0; i < std::size(buffers); ++i) sets_.writeBuffer(from, i, buffers[i]->handle());
  }
}

void RadixSort::record(VkCommandBuffer commands, uint32_t count) const {
  if (count == 0) return;
  const uint32_t blocks = blocksOf(count, kSortBlock);
  const auto run = [&](const Pipeline& pipeline, uint32_t set, uint32_t digit) {
    computeBarrier(commands);
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, sets_[set]);
    pipeline.push(commands, {count, blocks, digit});
    dispatch(commands, blocks);
  };
  if (blocks == 1) return run(whole_, 0, 0);
  for (uint32_t digit = 0; digit < digitCount_; ++digit) {
    run(counts_, digit % 2, digit);
    sum_.record(commands, kDigits * blocks);
    run(scatters_, digit % 2, digit);
  }
}

}  // namespace scumble::gpu

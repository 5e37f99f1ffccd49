// Bounds on what a file may make us allocate. Every array that the importer makes is backed by bytes of the
// file, but a small file can name the same bytes any number of times (one accessor in ten thousand
// primitives), or name none at all (accessors without a buffer view are zeros). So the sum is bounded too.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "scene/import_failure.h"

namespace scumble::gltf {

using namespace scene;

class ImportBudget {
 public:
  // What any file may ask for, and what every byte that backs it adds.
  static constexpr uint64_t kFreeBytes = 1ull << 30;
  static constexpr uint64_t kBytesPerByte = 64;
  static constexpr uint64_t kMaxZeroNumbers = 16ull << 20;  // in accessors without bytes, together

  void addBacking(uint64_t bytes) { backing_ += bytes; }

  void takeBytes(uint64_t bytes, const std::string& jsonPath) {
    const uint64_t limit = kFreeBytes + kBytesPerByte * backing_;
    if (bytes > limit || (taken_ += bytes) > limit)
      fail(jsonPath, "the file asks for far more memory than its size can justify", "check how it was made");
  }

  void takeZeroNumbers(uint64_t numbers, const std::string& jsonPath) {
    if (numbers > kMaxZeroNumbers || (zeros_ += numbers) > kMaxZeroNumbers)
      fail(jsonPath, "asks for more numbers than any bytes of the file back",
           "give the accessor a bufferView");
  }

 private:
  std::atomic<uint64_t> backing_{0}, taken_{0}, zeros_{0};
};

}  // namespace scumble::gltf

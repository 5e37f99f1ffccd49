// Numbers out of bytes that nobody has checked, least significant byte first.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "base/file_bytes.h"
#include "scene/import_failure.h"

namespace scumble::sketch {

class ByteReader {
 public:
  // `what`: what messages call the bytes.
  ByteReader(Bytes bytes, const char* what) : bytes_(bytes), what_(what) {}

  size_t left() const { return bytes_.size() - offset_; }

  template <class T>
  T read() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  Bytes take(size_t count) {
    require(count);
    const Bytes taken = bytes_.subspan(offset_, count);
    offset_ += count;
    return taken;
  }
  // A count of things that take so many bytes each, all of which must be there.
  template <class T>
  size_t count(size_t bytesEach) {
    const T value = read<T>();
    if (value < 0) failHere(fmt::format("has {} of something", value));
    if (uint64_t(value) * bytesEach > left())
      failHere(fmt::format("ends before the {} things of {} bytes that it announces", value, bytesEach));
    return size_t(value);
  }
  std::string path() const { return fmt::format("{}, byte {}", what_, offset_); }
  [[noreturn]] void failHere(std::string problem) const {
    scene::fail(path(), std::move(problem), "the file is cut off or damaged; get it again");
  }

 private:
  void require(size_t count) const {
    if (count > left()) failHere("ends too early");
  }

  Bytes bytes_;
  const char* what_;
  size_t offset_ = 0;
};

}  // namespace scumble::sketch

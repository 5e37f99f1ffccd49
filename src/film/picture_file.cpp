// Whether a picture's file is whole, without reading its pixels.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <array>
#include <cstring>
#include <fstream>

#include "base/file_bytes.h"
#include "base/image_decode.h"
#include "scumble/image.h"

namespace scumble {
namespace {

constexpr unsigned char kPngStart[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
// The chunk that ends every PNG: no data, its name, its check sum.
constexpr unsigned char kPngEnd[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
constexpr unsigned char kExrStart[] = {0x76, 0x2f, 0x31, 0x01};

uint32_t bigEndian(const unsigned char* bytes) {
  return uint32_t(bytes[0]) << 24 | uint32_t(bytes[1]) << 16 | uint32_t(bytes[2]) << 8 | bytes[3];
}

bool fits(uint32_t wanted, uint32_t found) {
  return wanted == 0 || wanted == found;
}

template <size_t kSize>
bool startsAs(const std::array<unsigned char, kSize>& bytes, const char* text) {
  return std::memcmp(bytes.data(), text, std::strlen(text)) == 0;
}

uint64_t sizeOf(std::ifstream& file) {
  file.clear();
  file.seekg(0, std::ios::end);
  return uint64_t(file.tellg());
}

bool hasSize(const std::string& path, uint32_t width, uint32_t height) {
  FileBytes bytes;
  std::string problem;
  uint32_t foundWidth = 0, foundHeight = 0;
  return bytes.open(path, problem) && readImageSize(bytes.bytes(), foundWidth, foundHeight, problem) &&
         fits(width, foundWidth) && fits(height, foundHeight);
}

// It ends with the marker that says so.
bool isWholeJpeg(const std::string& path, std::ifstream& file, uint32_t width, uint32_t height) {
  unsigned char end[2] = {};
  file.seekg(-2, std::ios::end);
  return file.read(reinterpret_cast<char*>(end), sizeof end) && end[0] == 0xFF && end[1] == 0xD9 &&
         hasSize(path, width, height);
}

// It is as long as its header says.
bool isWholeWebp(const std::string& path, std::ifstream& file, uint32_t width, uint32_t height) {
  unsigned char length[4] = {};
  file.seekg(4);
  if (!file.read(reinterpret_cast<char*>(length), sizeof length)) return false;
  const uint32_t told =
      uint32_t(length[3]) << 24 | uint32_t(length[2]) << 16 | uint32_t(length[1]) << 8 | length[0];
  return sizeOf(file) == uint64_t(told) + 8 && hasSize(path, width, height);
}

// The table of its rows stands in front, and is there before they are: that the outermost ones can be read is
// what tells that the file's end is there.
bool isWholeExr(const std::string& path, uint32_t width, uint32_t height) {
  Imf::InputFile exr(path.c_str());
  const auto window = exr.header().dataWindow();
  if (!exr.isComplete() || !fits(width, uint32_t(window.max.x - window.min.x + 1)) ||
      !fits(height, uint32_t(window.max.y - window.min.y + 1)))
    return false;
  // Of tiles the order is free, and nothing here writes them.
  if (exr.header().hasTileDescription()) return true;
  for (const int row : {window.min.y, window.max.y}) {
    const char* data = nullptr;
    int size = 0;
    exr.rawPixelData(row, data, size);  // throws at the file's end
  }
  return true;
}

}  // namespace

bool isWholePicture(const std::string& path, uint32_t width, uint32_t height) {
  try {
    std::ifstream file(path, std::ios::binary);
    std::array<unsigned char, 24> start{};
    std::array<unsigned char, sizeof(kPngEnd)> end{};
    if (!file.read(reinterpret_cast<char*>(start.data()), start.size())) return false;
    if (std::memcmp(start.data(), kExrStart, sizeof(kExrStart)) == 0) {
      file.close();
      return isWholeExr(path, width, height);
    }
    if (startsAs(start, "\xff\xd8\xff")) return isWholeJpeg(path, file, width, height);
    if (startsAs(start, "RIFF")) return isWholeWebp(path, file, width, height);
    if (std::memcmp(start.data(), kPngStart, sizeof(kPngStart)) != 0) return false;
    // The header's chunk comes first: length, name, width, height.
    if (!fits(width, bigEndian(&start[16])) || !fits(height, bigEndian(&start[20]))) return false;
    file.seekg(-int(end.size()), std::ios::end);
    return file.read(reinterpret_cast<char*>(end.data()), end.size()) &&
           std::memcmp(end.data(), kPngEnd, sizeof(kPngEnd)) == 0;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace scumble

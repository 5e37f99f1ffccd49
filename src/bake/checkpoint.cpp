#include "bake/checkpoint.h"

#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/file_bytes.h"
#include "base/file_size_signal.h"

namespace scumble::bake {

namespace {

constexpr char kMagic[8] = {'s', 'c', 'm', 'b', 'a', 'k', 'e', '2'};

struct Record {
  uint64_t number;
  uint32_t width, height;
  float top;
  uint32_t check;  // of all of it, and of the bytes that follow
};
static_assert(sizeof(Record) == 24);

uint32_t checkOf(Record record, const std::vector<uint8_t>& bytes) {
  uint32_t hash = 2166136261u;
  const auto add = [&](const uint8_t* from, size_t count) {
    for (size_t i = 0; i < count; ++i) hash = (hash ^ from[i]) * 16777619u;
  };
  record.check = 0;
  add(reinterpret_cast<const uint8_t*>(&record), sizeof record);
  add(bytes.data(), bytes.size());
  return hash;
}

}  // namespace

Checkpoint::Checkpoint(std::string path, uint64_t key) : path_(std::move(path)), key_(key) {
  read();
}

Checkpoint::~Checkpoint() {
  if (file_) std::fclose(file_);
}

void Checkpoint::read() {
  std::error_code error;
  isOurs_ = !std::filesystem::exists(path_, error);
  FileBytes file;
  std::string problem;
  if (!file.open(path_, problem)) return;
  const auto bytes = file.bytes();
  uint64_t own = 0;
  constexpr size_t kHeader = sizeof kMagic + sizeof own;
  if (bytes.size() < kHeader || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) return;
  std::memcpy(&own, bytes.data() + sizeof kMagic, sizeof own);
  isOurs_ = true;
  if (own != key_) return;
  good_ = kHeader;
  for (size_t at = kHeader; at + sizeof(Record) <= bytes.size();) {
    Record record;
    std::memcpy(&record, bytes.data() + at, sizeof record);
    at += sizeof record;
    if (record.width > kMaxImageSide || record.height > kMaxImageSide) return;
    const size_t size = size_t(record.width) * record.height * 4;
    if (size > bytes.size() - at) return;
    Piece piece{{record.width,
                 record.height,
                 {bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + size)}},
                record.top};
    if (checkOf(record, piece.tile.rgba) != record.check) return;
    pieces_[record.number] = std::move(piece);
    at += size;
    good_ = at;
  }
}

const Piece* Checkpoint::find(uint64_t number) const {
  const auto found = pieces_.find(number);
  return found != pieces_.end() ? &found->second : nullptr;
}

void Checkpoint::add(uint64_t number, const Piece& piece) {
  const std::lock_guard lock(mutex_);
  if (!isOpened_) open();
  write(number, piece);
}

void Checkpoint::open() {
  isOpened_ = true;
  if (!isOurs_) return;  // somebody else's file stays
  const FileSizeSignalHeld held;
  std::error_code error;
  if (good_ > 0) std::filesystem::resize_file(path_, good_, error);  // after the last whole piece
  file_ = error ? nullptr : std::fopen(path_.c_str(), good_ > 0 ? "ab" : "wb");
  if (!file_ || good_ > 0) return;
  std::fwrite(kMagic, 1, sizeof kMagic, file_);
  std::fwrite(&key_, 1, sizeof key_, file_);
}

void Checkpoint::write(uint64_t number, const Piece& piece) {
  if (!file_) return;
  const FileSizeSignalHeld held;
  Record record{number, piece.tile.width, piece.tile.height, piece.top, 0};
  record.check = checkOf(record, piece.tile.rgba);
  bool isWritten = std::fwrite(&record, 1, sizeof record, file_) == sizeof record;
  if (!piece.tile.rgba.empty())
    isWritten &=
        std::fwrite(piece.tile.rgba.data(), 1, piece.tile.rgba.size(), file_) == piece.tile.rgba.size();
  if (isWritten && std::fflush(file_) == 0) return;
  // A full disk: what is kept takes the room that the result will need.
  std::fclose(file_);
  file_ = nullptr;
  std::remove(path_.c_str());
}

void Checkpoint::finish() {
  if (file_) std::fclose(file_);
  file_ = nullptr;
  if (isOurs_ && (isOpened_ || good_ > 0)) std::remove(path_.c_str());
}

}  // namespace scumble::bake

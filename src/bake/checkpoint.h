// What a bake has done so far, in a file, so that one that was cut off goes on.
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include "bake/capture.h"

namespace scumble::bake {

// A piece of work: a tile, and what else was found of it.
struct Piece {
  Tile tile;
  float top = 1;
};

class Checkpoint {
 public:
  // Nothing is written before the first piece. `key`: of all that pieces follow from. What the file holds of
  // another key, or that ends in the middle, counts for nothing. Where it cannot be written, or the disk is
  // full, nothing is kept.
  Checkpoint(std::string path, uint64_t key);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  size_t known() const { return pieces_.size(); }
  // One that an earlier call has made; null: none. Valid until it is taken.
  const Piece* find(uint64_t number) const;
  // From any thread.
  void add(uint64_t number, const Piece& piece);
  // All is done, or never can be, or there is no room for it: the file goes.
  void finish();

 private:
  void read();
  void open();
  void write(uint64_t number, const Piece& piece);

  std::string path_;
  uint64_t key_;
  std::map<uint64_t, Piece> pieces_;
  std::mutex mutex_;
  bool isOurs_ = false;  // there is none yet, or one that a bake has written
  size_t good_ = 0;      // bytes of it up to the end of the last whole piece
  bool isOpened_ = false;
  FILE* file_ = nullptr;
};

}  // namespace scumble::bake

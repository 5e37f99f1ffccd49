// How two eyes lie in pictures and films.
#pragma once

#include <cstdint>
#include <string>

#include "scumble/drawing.h"
#include "scumble/film.h"
#include "scumble/result.h"

namespace scumble::app {

struct StereoLayout {
  const char* name;         // as `--stereo` takes it
  uint32_t across, down;    // views in a picture
  FilmLayout film;          // what players are told
  bool isSeparate = false;  // files of their own
  bool isInTurns = false;   // one eye after the other
  // Two views in one; null where they are not put together (drawings: cannot be).
  Image (*arrange)(const Image& left, const Image& right) = nullptr;
  Drawing (*arrangeDrawing)(const Drawing& left, const Drawing& right) = nullptr;
  // What is no colour, where that is another way.
  Image (*arrangeFacts)(const Image& left, const Image& right) = nullptr;
};

// As views of EXR files and parts of files' names have them.
inline constexpr const char* kEyes[] = {"left", "right"};

// Of this name; empty: null, one eye. Fails with usage for others.
Result<const StereoLayout*> stereoLayoutOf(const std::string& name);

// "side-by-side, over-under ..." for help and messages.
std::string stereoLayoutNames();

// Frames for which each eye is seen, and whose (1: the right one) turn a frame is, where they take turns.
int framesInTurn(double fps);
size_t eyeInTurn(int frame, double fps);

}  // namespace scumble::app

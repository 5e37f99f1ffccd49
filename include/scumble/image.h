// Pictures in memory, and the files they go into. Functions here keep nothing between calls: several threads
// may call them at once, as long as nobody changes a picture meanwhile. Of two that write one file, one wins.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/result.h"

namespace scumble {

// What a picture's numbers are: 32-bit floats; bits of 16-bit ones, the nearest, infinite beyond 65504; or
// 8-bit codes, of R, G and B in sRGB's curve (IEC 61966-2-1) and of A in proportion, rounded to the nearest.
enum class PixelFormat : uint8_t { float32, half, srgb8 };

// A picture of channels, interleaved, row 0 at the top. Colours are linear but for codes; alpha is straight.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<std::string> channels;  // names, e.g. {"R", "G", "B", "A"}, in the order of the data
  // width * height * channels.size() of them; or, as `format` says, instead `halves` or `codes` are.
  std::vector<float> pixels;
  // Whether R, G and B are a colour of which A is the coverage, as in pictures and in the AOVs of colours. Of
  // others, A is a number like the rest.
  bool isColor = false;
  std::vector<uint16_t> halves = {};
  std::vector<uint8_t> codes = {};
  PixelFormat format = PixelFormat::float32;

  // Of floats.
  float at(uint32_t x, uint32_t y, uint32_t channel) const {
    return pixels[(size_t(y) * width + x) * channels.size() + channel];
  }
};

// One layer of an EXR file. The beauty's name is empty: its channels are plain R, G, B, A.
struct ImageLayer {
  std::string name;  // e.g. "final-shadow"
  std::string view;  // "left", "right", or empty where there is one view only
  const Image* image = nullptr;
  bool half = false;  // 16-bit floats instead of 32-bit ones; finite values are clamped to +-65504
};

enum class ExrCompression {
  zip,  // fast; good for flat and for synthetic layers
  piz   // slower to read; smaller where a picture is noisy or grainy
};

// Mattes of objects by their names (Cryptomatte specification 1.2.0). The layer of this name is given as
// pairs of channels by rank, largest coverage first: the object's number, 1 ... objects.size() or 0 for
// nothing, and the part of the pixel that it covers, in [0, 1]. It is written as layers NAME00, NAME01 ...
// with two ranks each in R, G, B, A, always 32-bit floats, and described in the header. Every view of the
// layer is written so. Objects of one name are one matte.
struct Cryptomatte {
  std::string layer;  // e.g. "CryptoObject"
  // UTF-8; objects[n - 1] is the name of object n, empty for numbers that do not occur.
  std::vector<std::string> objects;
};

struct ExrOptions {
  ExrCompression compression = ExrCompression::zip;
  std::vector<Cryptomatte> cryptomattes;
};

// 8 bit sRGB, straight alpha (kept when `image` has four channels and is not opaque everywhere). Floats, or
// codes as they are; the same goes for the other formats of 8 bit, and for films. Halves are refused (usage).
// The file appears whole or not at all. Fails with ErrorKind::outputNotWritten.
SCUMBLE_API Status writePng(const std::string& path, const Image& image);

// The same as a JPEG: quality 1 ... 100, higher is better and larger; chroma at full resolution from 90 on.
// There is no alpha: it is put over black. EXIF says that values are sRGB. At most 65500 pixels a side.
SCUMBLE_API Status writeJpeg(const std::string& path, const Image& image, int quality = 92);

// The same as a WebP: quality 0 ... 100, where 100 is lossless; alpha is kept as writePng does. At most 16383
// pixels a side.
SCUMBLE_API Status writeWebp(const std::string& path, const Image& image, int quality = 90);

// Reads what writePng writes, and any other PNG, as linear floats (R, G, B, A); a colour.
SCUMBLE_API Result<Image> readPng(const std::string& path);

// Reads a PNG, JPEG or WebP, whatever its name says, as linear floats (R, G, B, A); a colour. Photographs
// come upright, as their EXIF says. Colour profiles are not looked at: values are sRGB. Fails with
// ErrorKind::unusableFile.
SCUMBLE_API Result<Image> readPicture(const std::string& path);

// The picture of an EXR: channels R, G, B and, where there is one, A, as linear floats; a colour, straight
// again, since files hold it multiplied by its alpha. `view`: "left", "right", or empty for the default one;
// a file without views has one picture for both. The picture is what the file's display
// window shows; where there is no data, 0. Fails with ErrorKind::unusableFile, also for a view that a file
// with views lacks.
SCUMBLE_API Result<Image> readExr(const std::string& path, const std::string& view = "");

// Float, compressed without loss. Colours (Image::isColor) are multiplied by their alpha, as OpenEXR and
// compositors have it; a colour of which nothing is there is black. Everything else is as given. Channels are
// named LAYER.CHANNEL. In stereo (layers with views) the standard multiView attribute lists the views, "left"
// first; the picture's channels are R, G, B, A for the left eye and right.R ... for the right one, those of
// layers LAYER.left.CHANNEL and LAYER.right.CHANNEL, since OpenEXR gives only names without a period to the
// default view. All layers have one size. Fails with ErrorKind::usage for layers that do not fit together,
// and with ErrorKind::outputNotWritten.
SCUMBLE_API Status writeExr(const std::string& path, const std::vector<ImageLayer>& layers,
                            const ExrOptions& options = {});

// Whether a file is a PNG, JPEG, WebP or EXR with all its pixels, of this size unless it is 0; false where it
// cannot be read. Pixels themselves are not checked.
SCUMBLE_API bool isWholePicture(const std::string& path, uint32_t width = 0, uint32_t height = 0);

// A report beside pictures, e.g. JSON. The file appears whole or not at all. Fails with
// ErrorKind::outputNotWritten.
SCUMBLE_API Status writeText(const std::string& path, const std::string& text);

// Two pictures in one: left | right, or left over right.
SCUMBLE_API Image sideBySide(const Image& left, const Image& right);
SCUMBLE_API Image overUnder(const Image& left, const Image& right);
// For glasses that are red and cyan: the first channel (red) of the left eye's picture, the others of the
// right one's, and of alphas (A) the greater. A right one of another size or of other channels counts as 0.
SCUMBLE_API Image anaglyph(const Image& left, const Image& right);

}  // namespace scumble

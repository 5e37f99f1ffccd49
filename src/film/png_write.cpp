// PNG files, written fast: after rendering, this is what a still picture waits for. Rows are cut into stripes
// that are encoded, filtered and deflated side by side; the stripes depend on the picture's size only, so the
// file's bytes do not depend on the number of threads.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <system_error>
#include <thread>

#include "base/whole_file.h"
#include "film/checks.h"
#include "film/codes.h"
#include "scumble/image.h"

namespace scumble {
namespace {

constexpr size_t kStripeBytes = 256 << 10;  // large enough that cutting costs no compression to speak of

// Pictures of paint are flat areas and soft gradients: differences of neighbours are runs of one value, and
// zlib that looks for runs only (so that its level does not count) is faster on them than its level 1 and
// makes smaller files of them (0.6 to 0.9 times, measured on rendered scenes).
constexpr int kLevel = 1;
constexpr int kStrategy = Z_RLE;

// Runs work(0) ... work(count - 1) on all processors. `work` must not throw.
void forEachStripe(uint32_t count, const std::function<void(uint32_t)>& work) {
  std::atomic<uint32_t> next{0};
  const auto loop = [&] {
    for (uint32_t stripe; (stripe = next.fetch_add(1)) < count;) work(stripe);
  };
  std::vector<std::thread> helpers;
  const uint32_t wanted = std::min(count, std::max(1u, std::thread::hardware_concurrency()));
  try {
    helpers.reserve(wanted);
    for (uint32_t i = 1; i < wanted; ++i) helpers.emplace_back(loop);
  } catch (const std::exception&) {
    // The system gives no more threads (or memory for them): those that run, and this one, do the work.
  }
  loop();
  for (std::thread& helper : helpers) helper.join();
}

// Filter type 1, "Sub": one for all rows, as trying several takes longer than it saves.
template <uint32_t kSamples>
void filterRow(const uint8_t* row, uint32_t width, uint8_t* out) {
  *out++ = 1;
  for (uint32_t s = 0; s < kSamples; ++s) *out++ = row[s];
  for (uint32_t x = 1; x < width; ++x, row += 4)
    for (uint32_t s = 0; s < kSamples; ++s) *out++ = uint8_t(row[4 + s] - row[s]);
}

// Bytes that are not written before their time, as a vector's would be.
struct Bytes {
  std::unique_ptr<uint8_t[]> data;
  size_t size = 0;

  void take(size_t wanted) {
    data = std::make_unique_for_overwrite<uint8_t[]>(wanted);
    size = wanted;
  }
};

struct Stripe {
  Bytes filtered, deflated;
  uint32_t firstRow = 0, endRow = 0;
  uLong checksum = 0;
  bool opaque = true;
  bool failed = false;
};

// A piece of one deflate stream: pieces end on a byte (sync flush) and look back at nothing before their
// start, so they can be made apart and joined.
void deflateStripe(Stripe& stripe, bool last) {
  z_stream stream = {};
  stripe.failed = deflateInit2(&stream, kLevel, Z_DEFLATED, -15, 9, kStrategy) != Z_OK;
  if (stripe.failed) return;
  stream.next_in = stripe.filtered.data.get();
  stream.avail_in = uInt(stripe.filtered.size);
  stream.next_out = stripe.deflated.data.get();
  stream.avail_out = uInt(stripe.deflated.size);
  const int result = deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
  stripe.failed = result != (last ? Z_STREAM_END : Z_OK) || stream.avail_in != 0;
  stripe.deflated.size -= stream.avail_out;
  deflateEnd(&stream);
  stripe.checksum = adler32(adler32(0, nullptr, 0), stripe.filtered.data.get(), uInt(stripe.filtered.size));
}

void putBigEndian(uint8_t* out, uint32_t value) {
  for (int i = 0; i < 4; ++i) out[i] = uint8_t(value >> (24 - 8 * i));
}

// A chunk from up to three parts, so that nothing is copied together first.
struct Part {
  const void* bytes;
  size_t size;
};
void writeChunk(WholeFile& file, const char* type, std::initializer_list<Part> parts) {
  size_t size = 0;
  uLong crc = crc32(0, reinterpret_cast<const Bytef*>(type), 4);
  for (const Part& part : parts) {
    size += part.size;
    if (part.size) crc = crc32(crc, static_cast<const Bytef*>(part.bytes), uInt(part.size));
  }
  uint8_t length[4], check[4];
  putBigEndian(length, uint32_t(size));
  putBigEndian(check, uint32_t(crc));
  file.write(length, 4);
  file.write(type, 4);
  for (const Part& part : parts) file.write(part.bytes, part.size);
  file.write(check, 4);
}

Error failure(const std::string& path, ErrorKind kind, const std::string& problem) {
  Error error;
  error.kind = kind;
  error.file = path;
  error.problem = problem;
  return error;
}

Status writePngThrowing(const std::string& path, const Image& image) {
  if (const std::string problem = film::problemWith(image); !problem.empty())
    return failure(path, ErrorKind::usage, problem);
  // A place that cannot be written to is found before any work is done.
  WholeFile file(path);
  if (!file.ok()) return file.commit();

  // Encode, and learn whether alpha is needed.
  const uint32_t width = image.width, height = image.height;
  const size_t rowBytes = size_t(width) * 4;
  const uint32_t stripeRows = uint32_t(std::clamp<size_t>(kStripeBytes / rowBytes, 1, height));
  std::vector<Stripe> stripes((height + stripeRows - 1) / stripeRows);
  Bytes encoded;
  encoded.take(rowBytes * height);
  for (size_t i = 0; i < stripes.size(); ++i) {
    stripes[i].firstRow = uint32_t(i) * stripeRows;
    stripes[i].endRow = std::min(height, stripes[i].firstRow + stripeRows);
  }
  forEachStripe(uint32_t(stripes.size()), [&](uint32_t i) {
    stripes[i].opaque = film::encodeRgba(image, stripes[i].firstRow, stripes[i].endRow,
                                         encoded.data.get() + rowBytes * stripes[i].firstRow);
  });
  const bool opaque = std::all_of(stripes.begin(), stripes.end(), [](const Stripe& s) { return s.opaque; });

  // Filter and deflate. All memory is taken here, where running out of it can be reported.
  const uint32_t samples = opaque ? 3 : 4;
  const size_t filteredRow = 1 + size_t(width) * samples;
  for (Stripe& stripe : stripes) {
    stripe.filtered.take(filteredRow * (stripe.endRow - stripe.firstRow));
    stripe.deflated.take(compressBound(uLong(stripe.filtered.size)) + 64);  // 64: the flush and its marker
  }
  forEachStripe(uint32_t(stripes.size()), [&](uint32_t i) {
    Stripe& stripe = stripes[i];
    for (uint32_t y = stripe.firstRow; y < stripe.endRow; ++y) {
      const uint8_t* row = encoded.data.get() + rowBytes * y;
      (opaque ? filterRow<3>
              : filterRow<4>)(row, width, stripe.filtered.data.get() + filteredRow * (y - stripe.firstRow));
    }
    deflateStripe(stripe, i + 1 == stripes.size());
  });
  if (std::any_of(stripes.begin(), stripes.end(), [](const Stripe& s) { return s.failed; }))
    throw std::bad_alloc();

  // The container: signature, header, the note that values are sRGB (perceptual intent), data, end.
  file.write("\x89PNG\r\n\x1a\n", 8);
  uint8_t header[13] = {};
  putBigEndian(header, width);
  putBigEndian(header + 4, height);
  header[8] = 8;
  header[9] = opaque ? 2 : 6;
  writeChunk(file, "IHDR", {{header, sizeof header}});
  writeChunk(file, "sRGB", {{"\0", 1}});
  uLong checksum = adler32(0, nullptr, 0);
  for (size_t i = 0; i < stripes.size(); ++i) {
    const Stripe& stripe = stripes[i];
    checksum = adler32_combine(checksum, stripe.checksum, z_off_t(stripe.filtered.size));
    uint8_t trailer[4];
    putBigEndian(trailer, uint32_t(checksum));
    writeChunk(file, "IDAT",
               {{"\x78\x01", i == 0 ? size_t(2) : 0},
                {stripe.deflated.data.get(), stripe.deflated.size},
                {trailer, i + 1 == stripes.size() ? sizeof trailer : 0}});
  }
  writeChunk(file, "IEND", {});
  return file.commit();
}

}  // namespace

Status writePng(const std::string& path, const Image& image) {
  try {
    return writePngThrowing(path, image);
  } catch (const std::exception&) {
    Error error = failure(path, ErrorKind::outputNotWritten, "cannot be written: not enough memory");
    error.advice = "choose a smaller size";
    return error;
  }
}

}  // namespace scumble

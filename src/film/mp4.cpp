#include "film/mp4.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "film/film_format.h"

namespace scumble::film {
namespace {

using Bytes = std::span<const uint8_t>;
using Buffer = std::vector<uint8_t>;

constexpr uint64_t kLargestIndex = 1 << 30;  // bytes of a moov: about a year of film

// Thrown and caught in this file only.
struct Unusable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr uint32_t code(const char (&name)[5]) {
  return uint32_t(uint8_t(name[0])) << 24 | uint32_t(uint8_t(name[1])) << 16 |
         uint32_t(uint8_t(name[2])) << 8 | uint8_t(name[3]);
}

uint64_t get(Bytes bytes, size_t at, size_t size) {
  if (at > bytes.size() || size > bytes.size() - at) throw Unusable("a box is too short");
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value = value << 8 | bytes[at + i];
  return value;
}

void put(Buffer& out, uint64_t value, size_t size) {
  for (size_t i = size; i-- > 0;) out.push_back(uint8_t(value >> (8 * i)));
}

void append(Buffer& out, Bytes bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

// What stands before a box's content.
struct BoxHeader {
  uint32_t type = 0;
  uint64_t size = 0;   // of the whole box
  uint64_t start = 0;  // of the content, in the box
};

// `bytes` begins with a box, of which it may hold only the beginning; `left` bytes are there in truth.
BoxHeader readHeader(Bytes bytes, uint64_t left) {
  BoxHeader box{uint32_t(get(bytes, 4, 4)), get(bytes, 0, 4), 8};
  if (box.size == 0) box.size = left;  // "to the end of the file"
  if (box.size == 1) box = {box.type, get(bytes, 8, 8), 16};
  if (box.size < box.start || box.size > left) throw Unusable("a box is larger than what holds it");
  return box;
}

// -- The index, made anew

struct Changes {
  const FilmOptions& film;
  int64_t shift = 0;            // added to each place in the file
  bool wide = false;            // places take 64 bits
  uint64_t begin = 0, end = 0;  // where they may point to, before
  uint64_t frames = 0;          // found on the way
};

void copyBox(Bytes box, Changes& changes, Buffer& out);

void copyBoxes(Bytes bytes, Changes& changes, Buffer& out) {
  while (!bytes.empty()) {
    const uint64_t size = readHeader(bytes, bytes.size()).size;
    copyBox(bytes.first(size_t(size)), changes, out);
    bytes = bytes.subspan(size_t(size));
  }
}

// Writes a box around what `content` appends.
template <class Content>
void putBox(Buffer& out, uint32_t type, const Content& content) {
  const size_t begin = out.size();
  put(out, 0, 4);
  put(out, type, 4);
  content();
  const size_t size = out.size() - begin;
  for (size_t i = 0; i < 4; ++i) out[begin + i] = uint8_t(size >> (24 - 8 * i));
}

// stco and co64: where the chunks lie.
void putChunks(Bytes content, size_t width, Changes& changes, Buffer& out) {
  const uint64_t count = get(content, 4, 4);
  if (count != (content.size() - 8) / width) throw Unusable("its list of chunks does not fit its length");
  putBox(out, changes.wide ? code("co64") : code("stco"), [&] {
    append(out, content.first(8));
    for (size_t i = 0; i < count; ++i) {
      const uint64_t place = get(content, 8 + i * width, width);
      if (place < changes.begin || place >= changes.end) throw Unusable("a chunk lies outside its data");
      put(out, uint64_t(int64_t(place) + changes.shift), changes.wide ? 8 : 4);
    }
  });
}

constexpr bool isPanorama(const FilmOptions& film) {
  return film.projection != FilmProjection::flat;
}

// Boxes that have a version and flags, which are 0.
template <class Content>
void putFullBox(Buffer& out, uint32_t type, const Content& content) {
  putBox(out, type, [&] {
    put(out, 0, 4);
    content();
  });
}

void putText(Buffer& out, const std::string& text) {
  out.insert(out.end(), text.begin(), text.end());
}

void putStereo(FilmLayout layout, Buffer& out) {
  constexpr uint64_t kModes[] = {0, 2, 1};  // of FilmLayout
  putFullBox(out, code("st3d"), [&] { put(out, kModes[size_t(layout)], 1); });
}

constexpr const char* kWriter = "scumble";

void putProjection(FilmProjection projection, Buffer& out) {
  putBox(out, code("sv3d"), [&] {
    putFullBox(out, code("svhd"), [&] {
      putText(out, kWriter);
      put(out, 0, 1);
    });
    putBox(out, code("proj"), [&] {
      putFullBox(out, code("prhd"), [&] {
        for (int angle = 0; angle < 3; ++angle) put(out, 0, 4);  // yaw, pitch, roll
      });
      // What the picture leaves of all around: at the top, bottom, left and right, in parts of 2^32.
      const uint64_t aside = projection == FilmProjection::halfSphere ? uint64_t(1) << 30 : 0;
      putFullBox(out, code("equi"), [&] {
        for (const uint64_t part : {uint64_t(0), uint64_t(0), aside, aside}) put(out, part, 4);
      });
    });
  });
}

// The same for players that know the first version alone.
void putSphericalXml(const FilmOptions& film, Buffer& out) {
  constexpr uint8_t kSpherical[16] = {0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93,
                                      0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd};
  std::string xml =
      "<?xml version=\"1.0\"?><rdf:SphericalVideo\n"
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"\n"
      "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">";
  const auto add = [&](const std::string& name, const std::string& value) {
    xml += "<GSpherical:" + name + ">" + value + "</GSpherical:" + name + ">";
  };
  add("Spherical", "true");
  add("Stitched", "true");
  add("StitchingSoftware", kWriter);
  add("ProjectionType", "equirectangular");
  if (film.layout != FilmLayout::mono)
    add("StereoMode", film.layout == FilmLayout::overUnder ? "top-bottom" : "left-right");
  if (film.projection == FilmProjection::halfSphere) {
    const auto [width, height] = eyeSizeOf(film);
    const auto number = [&](const char* name, uint32_t value) { add(name, std::to_string(value)); };
    number("CroppedAreaImageWidthPixels", width), number("CroppedAreaImageHeightPixels", height);
    number("FullPanoWidthPixels", 2 * width), number("FullPanoHeightPixels", height);
    number("CroppedAreaLeftPixels", width / 2), number("CroppedAreaTopPixels", 0);
  }
  xml += "</rdf:SphericalVideo>";
  putBox(out, code("uuid"), [&] {
    append(out, kSpherical);
    putText(out, xml);
  });
}

// avc1, one of stsd's entries: fields of fixed length, then boxes. st3d and sv3d must follow avcC, which is
// the last one that cannot be missing.
void putVideoEntry(Bytes content, Changes& changes, Buffer& out) {
  constexpr size_t kFields = 78;
  if (content.size() < kFields) throw Unusable("a box is too short");
  bool described = false;
  putBox(out, code("avc1"), [&] {
    append(out, content.first(kFields));
    for (Bytes rest = content.subspan(kFields); !rest.empty();) {
      const BoxHeader box = readHeader(rest, rest.size());
      append(out, rest.first(size_t(box.size)));
      rest = rest.subspan(size_t(box.size));
      if (box.type != code("avcC") || described) continue;
      described = true;
      const FilmOptions& film = changes.film;
      if (film.layout != FilmLayout::mono || isPanorama(film)) putStereo(film.layout, out);
      if (isPanorama(film)) putProjection(film.projection, out);
    }
  });
  if (!described) throw Unusable("it holds no H.264");
}

void copyBox(Bytes box, Changes& changes, Buffer& out) {
  const BoxHeader header = readHeader(box, box.size());
  const Bytes content = box.subspan(size_t(header.start));
  switch (header.type) {
    case code("trak"):
      return putBox(out, header.type, [&] {
        copyBoxes(content, changes, out);
        if (isPanorama(changes.film)) putSphericalXml(changes.film, out);
      });
    case code("moov"):
    case code("mdia"):
    case code("minf"):
    case code("stbl"):
      return putBox(out, header.type, [&] { copyBoxes(content, changes, out); });
    case code("stsd"):
      get(content, 0, 8);
      return putBox(out, header.type, [&] {
        append(out, content.first(8));
        copyBoxes(content.subspan(8), changes, out);
      });
    case code("avc1"):
      return putVideoEntry(content, changes, out);
    case code("stco"):
      return putChunks(content, 4, changes, out);
    case code("co64"):
      return putChunks(content, 8, changes, out);
    case code("stsz"):
      changes.frames += get(content, 8, 4);
      break;
  }
  append(out, box);
}

// -- The file

Buffer readAt(int descriptor, uint64_t place, uint64_t size) {
  Buffer bytes(static_cast<size_t>(size));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count = pread(descriptor, bytes.data() + done, bytes.size() - done, off_t(place + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Unusable("it cannot be read back");
    done += size_t(count);
  }
  return bytes;
}

struct Part {
  uint64_t place = 0, size = 0;
};

void copyPart(int descriptor, Part part, WholeFile& out) {
  constexpr uint64_t kPiece = 1 << 20;
  while (part.size > 0 && out.ok()) {
    const Buffer bytes = readAt(descriptor, part.place, std::min(part.size, kPiece));
    out.write(bytes.data(), bytes.size());
    part.place += bytes.size();
    part.size -= bytes.size();
  }
}

void rearrange(int descriptor, const FilmOptions& options, uint64_t frames, WholeFile& out) {
  struct stat facts = {};
  if (fstat(descriptor, &facts) != 0) throw Unusable("it cannot be read back");
  const uint64_t fileSize = uint64_t(facts.st_size);

  // The three parts of a film; what else there is holds nothing.
  std::optional<Part> kind, index, data;
  for (uint64_t place = 0; place < fileSize;) {
    const uint64_t left = fileSize - place;
    const BoxHeader box = readHeader(readAt(descriptor, place, std::min<uint64_t>(left, 16)), left);
    std::optional<Part>* part = box.type == code("ftyp")   ? &kind
                                : box.type == code("moov") ? &index
                                : box.type == code("mdat") ? &data
                                                           : nullptr;
    if (part) {
      if (*part) throw Unusable("a part of it is there twice");
      *part = Part{place, box.size};
    }
    place += box.size;
  }
  if (!kind || !index || !data) throw Unusable("it is not complete");
  if (index->size > kLargestIndex) throw Unusable("its index is too large");

  // The index moves in front of the data, whose place depends on the index's size; that does not depend on
  // the places in it.
  const Buffer old = readAt(descriptor, index->place, index->size);
  Changes changes{options};
  changes.begin = data->place;
  changes.end = data->place + data->size;
  changes.wide = fileSize + 2 * index->size + 64 > UINT32_MAX;
  Buffer moved;
  copyBox(old, changes, moved);
  if (changes.frames != frames)
    throw Unusable("it has " + std::to_string(changes.frames) + " frames instead of " +
                   std::to_string(frames));
  changes.shift = int64_t(kind->size + moved.size()) - int64_t(data->place);
  moved.clear();
  copyBox(old, changes, moved);

  copyPart(descriptor, *kind, out);
  out.write(moved.data(), moved.size());
  copyPart(descriptor, *data, out);
}

}  // namespace

std::string rearrangeMp4(int descriptor, const FilmOptions& options, uint64_t frames, WholeFile& out) {
  try {
    rearrange(descriptor, options, frames, out);
    return "";
  } catch (const std::exception& exception) {
    return exception.what();
  }
}

}  // namespace scumble::film

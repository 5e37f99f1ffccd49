// compare_pictures A.png B.png: prints how different two pictures look, in FLIP: the mean, that of the worst
// tile, the worst pixel. compare_pictures A.exr B.exr [FAR]: for numbers that nobody looks at. Prints the
// share of pixels that differ in the channel where most do, and that channel's name; two numbers differ when
// they are more than FAR (a hundredth) of 1 + their size apart. Other channels or sizes differ everywhere.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "film/compare.h"

namespace {

using namespace scumble;

std::map<std::string, std::vector<float>> channelsOf(const char* path) {
  Imf::InputFile file(path);
  const Imath::Box2i window = file.header().dataWindow();
  const size_t width = size_t(window.max.x - window.min.x + 1),
               height = size_t(window.max.y - window.min.y + 1);
  std::map<std::string, std::vector<float>> channels;
  Imf::FrameBuffer frame;
  const Imf::ChannelList& list = file.header().channels();
  for (auto i = list.begin(); i != list.end(); ++i) {
    std::vector<float>& values = channels[i.name()];
    values.resize(width * height);
    frame.insert(i.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return channels;
}

bool differ(float a, float b, float far) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return false;
  return !(std::abs(a - b) <= far * (1 + std::abs(a)));
}

int compareNumbers(const char* fileA, const char* fileB, float far) {
  const auto a = channelsOf(fileA), b = channelsOf(fileB);
  double most = 0;
  std::string worst = "-";
  const auto found = [&](double share, const std::string& name) {
    if (share > most) most = share, worst = name;
  };
  for (const auto& [name, values] : b)
    if (!a.contains(name)) found(1, name);
  for (const auto& [name, values] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second.size() != values.size()) {
      found(1, name);
      continue;
    }
    size_t count = 0;
    for (size_t i = 0; i < values.size(); ++i) count += differ(values[i], other->second[i], far);
    found(double(count) / double(values.size()), name);
  }
  std::printf("%.6f %s\n", most, worst.c_str());
  return 0;
}

int compareLooks(const char* fileA, const char* fileB) {
  const Result<Image> a = readPng(fileA), b = readPng(fileB);
  for (const Result<Image>* picture : {&a, &b})
    if (!picture->ok()) {
      std::fprintf(stderr, "%s\n", picture->error().message().c_str());
      return 3;
    }
  const film::Difference difference = film::comparePictures(*a, *b);
  std::printf("%.6f %.6f %.6f\n", difference.mean, difference.tile, difference.max);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: compare_pictures A B [FAR]\n");
    return 2;
  }
  try {
    if (!std::string(argv[1]).ends_with(".exr")) return compareLooks(argv[1], argv[2]);
    return compareNumbers(argv[1], argv[2], argc > 3 ? std::stof(argv[3]) : 0.01f);
  } catch (const std::exception& error) {  // OpenEXR throws
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}

// compare_pictures A.png B.png: prints how different two pictures look, as mean and largest FLIP.
#include <cstdio>

#include "film/compare.h"

int main(int argc, char** argv) {
  using namespace scumble;
  if (argc != 3) {
    std::fprintf(stderr, "usage: compare_pictures A.png B.png\n");
    return 2;
  }
  const Result<Image> a = readPng(argv[1]), b = readPng(argv[2]);
  for (const Result<Image>* picture : {&a, &b})
    if (!picture->ok()) {
      std::fprintf(stderr, "%s\n", picture->error().message().c_str());
      return 3;
    }
  const film::Difference difference = film::comparePictures(*a, *b);
  std::printf("%.6f %.6f\n", difference.mean, difference.max);
  return 0;
}

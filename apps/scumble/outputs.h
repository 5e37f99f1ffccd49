// Where pictures go: the names of the files, and which layers go into which.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output_format.h"
#include "scumble/drawing.h"
#include "scumble/film.h"
#include "scumble/renderer.h"
#include "stereo_layout.h"

namespace scumble::app {

// Where the first #### of a file's name begins and ends; both at its end where there is none.
std::pair<size_t, size_t> numberIn(const std::string& path);
bool isNumbered(const std::string& path);
// A path with that replaced by the number, zero-padded; without them, as it is.
std::string numbered(const std::string& path, int number);
// "3..5, 9": whole numbers that grow, as ranges.
std::string rangesOf(const std::vector<int>& numbers);

struct OutputPlan {
  std::string path;  // as given, or made from the scene's name
  const OutputFormat* format = nullptr;
  std::optional<int> quality;            // default: the format's
  const StereoLayout* layout = nullptr;  // null: one view
  double fps = 24;                       // of films and sequences
  FilmProjection projection = FilmProjection::flat;
  uint32_t width = 0, height = 0;  // of one view
  std::vector<std::string> aovs;
  bool half = false;  // EXR: layers that 16 bits are enough for
  ExrOptions exr;
  SvgOptions svg;

  // Fails with usage for a name whose ending is not known, and for what a layout cannot be.
  static Result<OutputPlan> make(const std::string& given, const std::string& sceneFile,
                                 const StereoLayout* layout, bool hasFrames, const RenderOptions& options);
  size_t viewCount() const { return layout ? 2 : 1; }

  // The path of frame `number`: #### is replaced by the number, zero-padded.
  std::string framePath(std::optional<int> number) const;
  OutputKind kind() const { return format->kind; }
  bool isSequence() const { return isNumbered(path); }

  // The files of a frame's picture: one, or one an eye.
  std::vector<std::string> picturePaths(const std::string& framePath) const;
  // All files that a frame writes: those, then AOVs that are files of their own.
  std::vector<std::string> files(const std::string& framePath) const;
  // Whether every file of this frame is there, whole, and of the right size.
  bool isThere(const std::string& framePath) const;

  // Writes the picture and its AOVs: layers of an EXR, or beside another picture as NAME.AOV.exr. The picture
  // comes last: where it is, the others are. `number`: of the frame.
  Status write(const Frame& frame, const std::string& framePath, int number) const;

 private:
  friend class FilmOutput;
  bool asFiles() const { return layout && layout->isSeparate; }
  bool isFileOfItsOwn(const std::string& aov) const;
  bool isHalf(const std::string& layer) const { return half && !Renderer::needsFloat(layer); }
  Status writeLayers(const Frame& frame, const std::string& path,
                     const std::vector<ImageLayer>& layers) const;
  // What of a frame goes into one of its files: a view that has it alone, or all of them.
  struct Part {
    const Frame& frame;
    std::optional<size_t> view;
  };
  Part partOf(const Frame& frame, size_t file, int number) const;
  // Of a layer, that; `made` holds it where it has to be made.
  const Image& imageOf(const Frame::Layer& layer, const Part& part, Image& made) const;
  Status writeAovsBeside(const Part& part, const std::string& path) const;
  Status writePicture(const Part& part, const std::string& path) const;
  Status writeDrawing(const Part& part, const std::string& path) const;
  Status writeLayeredExr(const Frame& frame, size_t file, const std::string& path) const;
};

// A film, or two where each eye has its own.
class FilmOutput {
 public:
  // `resume`: goes on with what is there. Fails with usage where that is more than `asked` frames.
  static Result<FilmOutput> create(const OutputPlan& plan, bool resume, size_t asked);
  // How many frames it has, with those that were there.
  size_t frames() const { return frames_; }
  // Takes the next frame.
  Status add(const Frame& frame, int number);
  Status finish();

 private:
  OutputPlan plan_;
  std::vector<std::unique_ptr<FilmWriter>> films_;
  size_t frames_ = 0;  // in all of them: of two that were there, one may have had more
};

}  // namespace scumble::app

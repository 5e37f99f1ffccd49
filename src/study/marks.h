// Grain and strokes: what is left on areas once the areas are taken away.
#pragma once

#include "scumble/study.h"
#include "study/plane.h"

namespace scumble::study {

StudiedMarks marksOf(const LabPicture& picture);

}  // namespace scumble::study

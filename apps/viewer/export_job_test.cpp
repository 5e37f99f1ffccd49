#include "export_job.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace scumble::viewer {
namespace {

TEST(ExportJob, wordsAsAShellTakesThem) {
  EXPECT_EQ(shellText({"scumble", "render", "a b.glb", "it's", "", "--set", "x=#FFF"}),
            "scumble render 'a b.glb' 'it'\\''s' '' --set 'x=#FFF'");
}

TEST(ExportJob, howFarALineSaysThatItIs) {
  EXPECT_EQ(partOf("scumble: frame 35, 36 of 48, 1 s left"), 0.75);
  for (const char* line : {"", " of ", "scumble: warning: 3 of them", "a of 3", "5 of 3", "3 of 0"})
    EXPECT_LT(partOf(line), 0) << line;
}

TEST(ExportJob, aNameThatIsNotThereYet) {
  const TestFolder folder;
  EXPECT_EQ(freeName(folder.file("boat.glb"), "-turn", ".mp4"), folder.file("boat-turn-1.mp4"));
  folder.put("boat-1.png", "");
  folder.put("boat-2.png", "");
  EXPECT_EQ(freeName(folder.file("boat.glb"), "", ".png"), folder.file("boat-3.png"));
}

}  // namespace
}  // namespace scumble::viewer

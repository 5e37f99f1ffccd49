#include "base/color_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scumble {
namespace {

TEST(ColorText, takesDigitsShortDigitsAndNames) {
  const struct {
    const char* text;
    uint32_t color;
  } cases[] = {
      {"#EADFC8", 0xEADFC8}, {"#eadfc8", 0xEADFC8}, {"#abc", 0xAABBCC},         {"#F0a", 0xFF00AA},
      {"#000", 0},           {"navy", 0x000080},    {"aliceblue", 0xF0F8FF},    {"yellowgreen", 0x9ACD32},
      {"black", 0},          {"grey", 0x808080},    {"rebeccapurple", 0x663399}};
  for (const auto& c : cases) EXPECT_EQ(parseColor(c.text), c.color) << c.text;
  for (const char* text : {"", "#", "#12", "#12345", "#1234567", "#ggg", "# 12", "#+12", "#0x1234", "abc",
                           "Navy", "navy ", "transparent", "EADFC8"})
    EXPECT_FALSE(parseColor(text)) << text;
}

TEST(ColorText, everyNameIsAColour) {
  EXPECT_EQ(colorNames().size(), 148u);
  EXPECT_TRUE(std::is_sorted(colorNames().begin(), colorNames().end()));
  for (const std::string& name : colorNames()) EXPECT_TRUE(parseColor(name)) << name;
}

}  // namespace
}  // namespace scumble

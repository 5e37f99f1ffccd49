#include "base/numbers.h"

#include <gtest/gtest.h>

#include <clocale>

namespace scumble {
namespace {

TEST(Numbers, areReadWholeOrNotAtAll) {
  for (const auto& [text, number] : {std::pair("0.45", 0.45),
                                     {"-1e3", -1000.0},
                                     {"+2", 2.0},
                                     {".5", 0.5},
                                     {"3.", 3.0},
                                     {"1E-2", 0.01},
                                     {"-0", 0.0}})
    EXPECT_EQ(numberOf(text), std::optional(number)) << text;
  for (const char* text : {"", " 1", "1 ", "1,5", "0,45", "1.5x", "x", "+-1", "++1", "-", "+", ".", "nan",
                           "inf", "-inf", "1e999", "0x10"})
    EXPECT_FALSE(numberOf(text)) << text;
}

TEST(Numbers, atTheStartEndWhereTheyEnd) {
  const auto found = numberAtStart("1.5,2");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value, 1.5);
  EXPECT_EQ(found->length, 3u);
  EXPECT_EQ(numberAtStart("+24/7")->length, 3u);
  EXPECT_FALSE(numberAtStart(",5"));
}

}  // namespace
}  // namespace scumble

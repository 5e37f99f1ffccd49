#include "programs.h"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace scumble::app {
namespace {

// Whatever a word holds, a shell gives it to a program as it is.
TEST(Programs, wordsComeThroughAShell) {
  const std::vector<std::string> words{
      "plain",      "a b",   "",         "it's", "''",       "'",   "$HOME", "`id`", "$(id)",   "a\\b",
      "\\",         "*",     "?[a-z]",   "a;b",  "a&b|c>d<", "#no", "~",     "-n",   "--x=1 2", "\"q\"",
      "line\nline", "tab\t", "\xC3\xA4", "!x",   "{a,b}",    "a=b", "%41",   "(x)"};
  for (const std::string& word : words) {
    const auto said = outputOf({"printf", "%s", word});
    ASSERT_TRUE(said) << word;
    EXPECT_EQ(*said, word);
  }
  std::vector<std::string> call{"printf", "<%s>"};
  std::string expected;
  for (const std::string& word : words) call.push_back(word), expected += "<" + word + ">";
  EXPECT_EQ(outputOf(call).value(), expected);
  // Plain words have no quotes, so that lines can be read.
  EXPECT_EQ(shellWords({"scumble", "render", "--set", "warp.amount=0", "/a/b_c-1.glb", "a b"}),
            "scumble render --set warp.amount=0 /a/b_c-1.glb 'a b'");
}

TEST(Programs, failuresHaveANameAndACode) {
  const auto failed = outputOf({"sh", "-c", "echo some; exit 3"});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::outputNotWritten);
  EXPECT_NE(failed.error().message().find("'sh' failed with code 3"), std::string::npos);
  const auto stopped = outputOf({"sh", "-c", "kill -9 $$"});
  ASSERT_FALSE(stopped);
  EXPECT_NE(stopped.error().message().find("was stopped"), std::string::npos) << stopped.error().message();
  const auto none = outputOf({"no-such-program-anywhere"}, Complaints::hidden);
  ASSERT_FALSE(none);
  EXPECT_EQ(outputOf({"sh", "-c", "echo seen; echo unseen >&2"}, Complaints::hidden).value(), "seen\n");
}

TEST(Programs, areLookedForOnThePath) {
  EXPECT_TRUE(isOnPath("sh"));
  EXPECT_FALSE(isOnPath("no-such-program-anywhere"));
  const std::string before = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  EXPECT_FALSE(isOnPath("sh"));
  setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace scumble::app

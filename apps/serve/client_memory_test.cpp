// Spans of a client's memory: those that lie within what was shared, and all those that do not, wherever they
// begin; a client's file keeps its size.
#include "apps/serve/client_memory.h"

#include <gtest/gtest.h>

#include <string>

#include "base/test_folder.h"

namespace scumble::serve {
namespace {

using nlohmann::json;

class ServeMemory : public ::testing::Test {
 protected:
  // A file of 64 bytes, of which 48 are shared.
  static constexpr uint64_t kFile = 64, kShared = 48;
  void SetUp() override {
    putContent(path(), std::string(kFile, 'x'));
    memory.share("m", path(), kShared);
  }
  std::string path() const { return folder.file("memory"); }
  static json span(uint64_t offset, uint64_t count) {
    return {{"memory", "m"}, {"offset", offset}, {"count", count}};
  }
  // The problem; empty: none.
  template <class Ask>
  static std::string refusal(Ask ask) {
    try {
      ask();
    } catch (const Refusal& refused) {
      return refused.error.problem;
    }
    return "";
  }

  TestFolder folder;
  ClientMemory memory;
};

TEST_F(ServeMemory, spansLieWithinWhatIsShared) {
  constexpr uint64_t kMost = ClientMemory::kMostBytes;
  struct Case {
    uint64_t offset, count;
    bool lies;
  };
  for (const Case& c :
       {Case{0, 1, true}, Case{0, 12, true}, Case{0, 13, false}, Case{4, 11, true}, Case{4, 12, false},
        Case{44, 1, true}, Case{45, 1, false}, Case{47, 1, false}, Case{48, 1, false}, Case{60, 1, false},
        Case{kMost, 1, false}, Case{0, kMost / 4, false}, Case{kMost, kMost / 4, false}}) {
    const auto read = [&] { memory.read<uint32_t>(span(c.offset, c.count), "here"); };
    EXPECT_EQ(refusal(read).empty(), c.lies) << c.offset << ", " << c.count;
    const auto range = [&] { memory.rangeOf(span(c.offset, c.count), "here", 4); };
    EXPECT_EQ(refusal(range).empty(), c.lies) << c.offset << ", " << c.count;
  }
  // Offsets beyond all numbers of bytes are refused as numbers.
  for (const uint64_t much : {kMost + 1, uint64_t(1) << 60})
    EXPECT_NE(refusal([&] { memory.rangeOf(span(much, 1), "here", 4); }), "") << much;
  EXPECT_NE(refusal([&] { memory.rangeOf(span(0, kMost), "here", 4); }), "");
}

TEST_F(ServeMemory, readsWhatLiesThere) {
  putContent(path(), "0123456789abcdef" + std::string(kFile - 16, 'x'));
  const std::vector<uint8_t> got = memory.read<uint8_t>(span(10, 4), "here");
  EXPECT_EQ(std::string(got.begin(), got.end()), "abcd");
  // Where the reference gives no count, the caller does.
  EXPECT_EQ(memory.read<uint8_t>({{"memory", "m"}}, "here", 3).size(), 3u);
  EXPECT_EQ(refusal([&] {
              memory.read<uint8_t>({{"memory", "other"}}, "here", 3);
            }),
            "there is no memory 'other'");
}

TEST_F(ServeMemory, writesWithinASpanAndNowhereElse) {
  const ClientMemory::Range range = memory.rangeOf(span(8, 16), "here", 1);
  memory.write(range, 2, "abc", 3);
  memory.write(range, 15, "z", 1);
  std::string expected(kFile, 'x');
  expected.replace(10, 3, "abc"), expected[23] = 'z';
  EXPECT_EQ(contentOf(path()), expected);
  const std::string much(40, 'y');
  struct Span {
    uint64_t at, size;
  };
  for (const Span& span :
       {Span{0, 17}, Span{1, 16}, Span{15, 2}, Span{16, 1}, Span{17, 0}, Span{~uint64_t(0), 2}})
    EXPECT_NE(refusal([&] { memory.write(range, span.at, much.data(), span.size); }), "")
        << span.at << ", " << span.size;
  EXPECT_EQ(contentOf(path()), expected) << "or longer";
}

TEST_F(ServeMemory, filesThatAreTooShortAreRefused) {
  EXPECT_NE(refusal([&] { memory.share("n", path(), kFile + 1); }), "");
  EXPECT_NE(refusal([&] { memory.share("n", folder.path(), 1); }), "");
  EXPECT_NE(refusal([&] { memory.share("n", path() + "no", 1); }), "");
  EXPECT_NE(refusal([&] { memory.read<uint8_t>({{"memory", "n"}}, "here", 1); }), "");
  // Cut off later on.
  putContent(path(), "short");
  EXPECT_NE(refusal([&] { memory.read<uint8_t>(span(0, 16), "here"); }), "");
  memory.forget("m");
  EXPECT_NE(refusal([&] { memory.read<uint8_t>(span(0, 1), "here"); }), "");
}

}  // namespace
}  // namespace scumble::serve

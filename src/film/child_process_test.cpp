#include "film/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "base/test_folder.h"

namespace scumble::film {
namespace {

std::vector<std::string> shell(const std::string& script) {
  return {"sh", "-c", script};
}

TEST(ChildProcess, whatIsSentArrivesWithTheDescriptor) {
  TestFolder folder;
  putContent(folder.file("out"), "");
  const int out = open(folder.file("out").c_str(), O_WRONLY | O_CLOEXEC);
  ChildProcess child;
  ASSERT_EQ(child.start(shell("cat >/proc/self/fd/3; echo lost; echo done >&2"), {out}), 0);
  close(out);
  const std::string bytes(3 << 20, 'x');
  EXPECT_TRUE(child.send(bytes.data(), bytes.size()));
  EXPECT_TRUE(child.send("end", 3));
  EXPECT_EQ(child.finish(), "");
  EXPECT_EQ(contentOf(folder.file("out")), bytes + "end");
  EXPECT_EQ(child.said(), "done\n");
}

TEST(ChildProcess, isGivenSeveralDescriptors) {
  TestFolder folder;
  std::vector<int> files;
  for (const char* name : {"one", "two", "three"}) {
    putContent(folder.file(name), name);
    files.push_back(open(folder.file(name).c_str(), O_RDONLY | O_CLOEXEC));
  }
  ChildProcess child;
  ASSERT_EQ(child.start(shell("cat <&3; cat <&4; cat <&5"), {files[2], files[0], files[1]},
                        ChildProcess::Output::received),
            0);
  for (const int file : files) close(file);
  EXPECT_EQ(child.receiveRest(), "threeonetwo");
  EXPECT_EQ(child.finish(), "");
}

TEST(ChildProcess, whatItWritesIsReceived) {
  ChildProcess child;
  // More than pipes hold, on both of its outputs.
  ASSERT_EQ(
      child.start(shell("head -c 300000 /dev/zero | tr '\\0' a >&2; head -c 1000000 /dev/zero | tr '\\0' b"),
                  {}, ChildProcess::Output::received),
      0);
  std::string got(2'000'000, ' ');
  EXPECT_EQ(child.receive(got.data(), 7), 7u);
  EXPECT_EQ(child.receive(got.data() + 7, got.size() - 7), 999'993u);
  EXPECT_EQ(got.substr(0, 1'000'000), std::string(1'000'000, 'b'));
  EXPECT_EQ(child.receive(got.data(), 1), 0u);
  EXPECT_EQ(child.finish(), "");
}

TEST(ChildProcess, absentProgramsAreKnownAtOnce) {
  ChildProcess child;
  EXPECT_EQ(child.start({"scumble-has-no-such-program"}, {STDIN_FILENO}), ENOENT);
}

// SIGPIPE would end this process.
TEST(ChildProcess, oneThatDiesEndsTheSendingOnly) {
  const std::string bytes(4 << 20, 'x');
  ChildProcess child;
  ASSERT_EQ(child.start(shell("head -c 10 >/dev/null; echo why >&2; exit 7"), {STDIN_FILENO}), 0);
  EXPECT_FALSE(child.send(bytes.data(), bytes.size()));
  EXPECT_FALSE(child.send(bytes.data(), bytes.size()));
  EXPECT_EQ(child.finish(), "ended with code 7");
  EXPECT_EQ(child.said(), "why\n");

  ChildProcess killed;
  ASSERT_EQ(killed.start(shell("kill -KILL $$"), {STDIN_FILENO}), 0);
  EXPECT_FALSE(killed.send(bytes.data(), bytes.size()));
  EXPECT_EQ(killed.finish(), "was ended: Killed");
}

// More than a pipe holds, before it reads anything: neither waits for the other.
TEST(ChildProcess, oneThatTalksIsHeardAndKeptShort) {
  const std::string bytes(4 << 20, 'x');
  ChildProcess child;
  ASSERT_EQ(child.start(shell("head -c 1000000 /dev/zero | tr '\\0' a >&2; echo last >&2; cat >/dev/null"),
                        {STDIN_FILENO}),
            0);
  EXPECT_TRUE(child.send(bytes.data(), bytes.size()));
  EXPECT_EQ(child.finish(), "");
  EXPECT_EQ(child.said().size(), 8192u);
  EXPECT_EQ(child.said().substr(8192 - 6), "alast\n");
}

TEST(ChildProcess, isEndedWithItsOwner) {
  TestFolder folder;
  const std::string id = folder.file("id");
  {
    ChildProcess child;
    ASSERT_EQ(child.start({"sh", "-c", "echo $$ >\"$0\"; mv \"$0\" \"$0.there\"; exec sleep 1000", id},
                          {STDIN_FILENO}),
              0);
    while (!std::filesystem::exists(id + ".there")) usleep(1000);
  }
  EXPECT_EQ(kill(pid_t(std::stol(contentOf(id + ".there"))), 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

}  // namespace
}  // namespace scumble::film

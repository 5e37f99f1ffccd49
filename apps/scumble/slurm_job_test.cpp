// Tasks of a job array, run by a shell in place of Slurm: with a program that writes down how it was called.
#include "slurm_job.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "base/test_folder.h"
#include "programs.h"

namespace scumble::app {
namespace {

class SlurmJobTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!isOnPath("flock") || !isOnPath("tar")) GTEST_SKIP() << "there is no flock, or no tar";
    write("asset.txt", "an input\n");
    run("tar -C " + shellWord(folder_.file("")) + " -cf " + file("inputs.0.tar") + " asset.txt");
    // It writes a line a call, and ends with the code that is asked for, of which the first ones come true.
    write("program", "#!/bin/sh\nprintf '%s|' \"$@\" >>\"" + folder_.file("calls") + "\"\necho >>\"" +
                         folder_.file("calls") +
                         "\"\ncat asset.txt >/dev/null || exit 9\nread -r code rest <\"" +
                         folder_.file("codes") + "\"\necho \"$rest\" >\"" + folder_.file("codes") +
                         "\"\nexit \"${code:-0}\"\n");
    run("chmod +x " + file("program"));
    write("codes", "\n");
    // Nobody waits here.
    run("mkdir " + file("bin"));
    write("bin/sleep", "#!/bin/sh\n");
    run("chmod +x " + file("bin/sleep"));
  }

  std::string file(const std::string& name) { return shellWord(folder_.file(name)); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_.file(name)) << text; }
  static void run(const std::string& command) { ASSERT_EQ(system(command.c_str()), 0) << command; }

  SlurmJob job(int first, int last, int chunk) {
    SlurmJob job;
    job.name = "a shot's";
    job.folder = folder_.file("");
    job.folder.pop_back();
    job.program = folder_.file("program");
    job.inputs = "inputs.0.tar", job.inside = ".", job.stage = folder_.file("stage");
    job.call = {"render", "asset.txt", "-o", "it's here.%04d.png"};
    job.first = first, job.last = last, job.chunk = chunk;
    return job;
  }
  // Its exit code.
  int runTask(const SlurmJob& job, int task) {
    write("script", job.renderScript());
    const int status = system(("PATH=" + file("bin") + ":$PATH SLURM_ARRAY_TASK_ID=" + std::to_string(task) +
                               " SLURM_ARRAY_JOB_ID=7 bash " + file("script") + " >/dev/null 2>&1")
                                  .c_str());
    return WEXITSTATUS(status);
  }
  std::vector<std::string> calls() {
    std::ifstream in(folder_.file("calls"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  TestFolder folder_;
};

// Every frame is some task's, and no frame two tasks'.
TEST_F(SlurmJobTest, tasksDivideTheFrames) {
  struct {
    int first, last, chunk, tasks;
  } const all[] = {{0, 0, 1, 1}, {1, 10, 3, 4}, {5, 10, 3, 2}, {-4, 4, 2, 5}, {7, 9, 100, 1}};
  for (const auto& [first, last, chunk, tasks] : all) {
    const SlurmJob job = this->job(first, last, chunk);
    ASSERT_EQ(job.tasks(), tasks);
    EXPECT_NE(job.renderScript().find("#SBATCH --array=0-" + std::to_string(tasks - 1) + "\n"),
              std::string::npos);
    unsetenv("SLURM_RESTART_COUNT");
    remove(folder_.file("calls").c_str());
    for (int task = 0; task < tasks; ++task) EXPECT_EQ(runTask(job, task), 0);
    const std::vector<std::string> called = calls();
    ASSERT_EQ(called.size(), size_t(tasks));
    for (int task = 0; task < tasks; ++task) {
      const int begin = first + task * chunk, end = std::min(begin + chunk - 1, last);
      EXPECT_EQ(called[size_t(task)],
                "render|asset.txt|-o|it's here.%04d.png|--frames=" + std::to_string(begin) + ".." +
                    std::to_string(end) + "|--resume|--stats=" + job.folder + "/stats/7/" +
                    std::to_string(task) + ".0.json|");
    }
  }
}

// A lost device is tried again, three times in all; what else goes wrong is what the task ends with.
TEST_F(SlurmJobTest, lostDevicesAreTriedAgain) {
  struct {
    const char* codes;
    int code;
    size_t calls;
  } const all[] = {{"0", 0, 1},       {"4 0", 0, 2}, {"4 4 0", 0, 3},
                   {"4 4 4 0", 4, 3}, {"3 0", 3, 1}, {"4 5", 5, 2}};
  for (const auto& [codes, code, count] : all) {
    remove(folder_.file("calls").c_str());
    write("codes", std::string(codes) + "\n");
    EXPECT_EQ(runTask(job(1, 1, 1), 0), code) << codes;
    EXPECT_EQ(calls().size(), count) << codes;
  }
}

TEST_F(SlurmJobTest, linesOfSbatchAreWhatIsAsked) {
  SlurmJob job = this->job(1, 8, 2);
  const auto has = [&](const std::string& line) {
    return job.renderScript().find("#SBATCH " + line + "\n") != std::string::npos;
  };
  EXPECT_TRUE(has("--job-name=a_shot_s"));
  EXPECT_FALSE(has("--gres=gpu:1"));
  job.wantsGpu = true;
  EXPECT_TRUE(has("--gres=gpu:1"));
  job.options = {"--partition=night"};
  EXPECT_TRUE(has("--partition=night"));
  EXPECT_TRUE(has("--gres=gpu:1"));
  for (const char* own : {"--gres=gpu:a100:2", "--gpus=1"}) {
    job.options = {own};
    EXPECT_TRUE(has(own));
    EXPECT_FALSE(has("--gres=gpu:1")) << "who asks for one has asked";
  }
  job.atOnce = 3;
  EXPECT_TRUE(has("--array=0-3%3"));
  job.folder = "/a %b\"c";
  EXPECT_TRUE(has("--output=\"/a %%b\\\"c/logs/%A.%a.txt\""));
  job.films = {{"film", "a b.%04d.png"}, {"film", "c"}};
  const std::string finish = job.finishScript();
  EXPECT_NE(finish.find("--frames=1..8 --missing --quiet\n"), std::string::npos);
  EXPECT_NE(finish.find("\"$program\" film 'a b.%04d.png'\n\"$program\" film c\n"), std::string::npos);
}

}  // namespace
}  // namespace scumble::app

// `scumble render`, run as a program of its own, so that the window stays usable while a picture or a film is
// made, and what it makes is what its command makes.
#pragma once

#include <sys/types.h>

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "scumble/result.h"

namespace scumble::viewer {

// Words as a shell takes them.
std::string shellText(const std::vector<std::string>& words);

class ExportJob {
 public:
  // `words`: a command of this very program, with the program first. `whenNews`: called from another thread.
  // Throws nothing: what cannot be started has ended with a problem.
  ExportJob(const std::vector<std::string>& words, std::string file, std::function<void()> whenNews);
  ~ExportJob();  // ends it
  ExportJob(const ExportJob&) = delete;
  ExportJob& operator=(const ExportJob&) = delete;

  struct State {
    double part = 0;  // from 0 to 1
    bool isDone = false;
    std::string problem;  // empty where it has ended well
    bool operator==(const State&) const = default;
  };
  State state() const;
  const std::string& file() const { return file_; }  // that it writes
  void cancel();

 private:
  void listen(int errors);

  const std::string file_;
  const std::function<void()> whenNews_;
  mutable std::mutex mutex_;
  State state_;
  bool isCancelled_ = false;
  pid_t process_ = -1;  // while it runs
  std::thread thread_;
};

// How far a line of progress says that it is ("frame 35, 36 of 41, 1 s left"); below 0 where it is none.
double partOf(const std::string& line);

// A name beside `file` that is not there yet: its own without ending, `addition`, a number and `ending`.
std::string freeName(const std::string& file, const std::string& addition, const std::string& ending);

}  // namespace scumble::viewer

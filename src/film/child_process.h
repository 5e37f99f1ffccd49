// A program run as a child: bytes go to its standard input, or come from its standard output, and the end of
// what it says on standard error is kept.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace scumble::film {

class ChildProcess {
 public:
  static constexpr int kPassed = 3;  // the child's number of the first descriptor that it is given
  enum class Output { discarded, received };

  ChildProcess() = default;
  ~ChildProcess();  // kills it if it still runs
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // command[0] is looked for on the PATH; no shell is involved. Signals from the terminal do not reach the
  // child. `passed`: descriptors that it is given, as kPassed and the numbers after that. Returns 0 or the
  // reason why not (ENOENT: there is no such program).
  int start(const std::vector<std::string>& command, const std::vector<int>& passed,
            Output output = Output::discarded);

  // Waits until the child has taken all of it; false when it takes no more.
  bool send(const void* bytes, size_t size);

  // Waits for so many bytes of its standard output; fewer come only where that ends.
  size_t receive(void* bytes, size_t size);
  // Waits for all that is left of it.
  std::string receiveRest();

  // Ends the child's input and waits for its end. Empty if it succeeded, otherwise how it ended ("ended with
  // code 1"). A host that ignores SIGCHLD makes every end a success.
  std::string finish();

  // The last 8 KiB.
  const std::string& said() const { return said_; }

 private:
  void listen();

  pid_t process_ = -1;
  int input_ = -1;   // a socket: unlike a pipe, it can be written to without SIGPIPE
  int output_ = -1;  // its standard output, where it is received; -1 once that has ended
  int errors_ = -1;  // its standard error; -1 once that has ended
  std::string said_;
};

}  // namespace scumble::film

#include "film/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

extern char** environ;

namespace scumble::film {
namespace {

constexpr size_t kKept = 8 << 10;  // of what it says

void closeIfOpen(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

}  // namespace

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  closeIfOpen(input_);
  closeIfOpen(output_);
  closeIfOpen(errors_);
}

int ChildProcess::start(const std::vector<std::string>& command, const std::vector<int>& passed,
                        Output output) {
  // Descriptors: ours, and the child's ends of them.
  int pair[2] = {-1, -1}, stream[2] = {-1, -1}, result[2] = {-1, -1};
  int code = 0;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0 || pipe2(stream, O_CLOEXEC) != 0 ||
      (output == Output::received && pipe2(result, O_CLOEXEC) != 0))
    code = errno;
  input_ = pair[0];
  output_ = result[0];
  errors_ = stream[0];
  // Out of the way of the numbers that descriptors get in the child.
  const auto copied = [&](int descriptor) {
    const int up = fcntl(descriptor, F_DUPFD_CLOEXEC, kPassed + int(passed.size()));
    if (up < 0 && code == 0) code = errno;
    return up;
  };
  const auto moved = [&](int descriptor) {
    const int up = descriptor < 0 ? -1 : copied(descriptor);
    closeIfOpen(descriptor);
    return up;
  };
  int childInput = moved(pair[1]), childErrors = moved(stream[1]), childOutput = moved(result[1]);
  std::vector<int> childPassed;
  for (const int descriptor : passed) childPassed.push_back(copied(descriptor));

  // The child.
  if (code == 0) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, childInput, STDIN_FILENO);
    if (childOutput >= 0)
      posix_spawn_file_actions_adddup2(&actions, childOutput, STDOUT_FILENO);
    else
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, childErrors, STDERR_FILENO);
    for (size_t i = 0; i < childPassed.size(); ++i)
      posix_spawn_file_actions_adddup2(&actions, childPassed[i], kPassed + int(i));
    // A group of its own: Ctrl-C is for us, and what becomes of the child is our decision.
    sigset_t none, pipe;
    sigemptyset(&none);
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &pipe);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    code = posix_spawnp(&process_, arguments[0], &actions, &attributes, arguments.data(), environ);
    if (code != 0) process_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  closeIfOpen(childInput);
  closeIfOpen(childErrors);
  closeIfOpen(childOutput);
  for (int& descriptor : childPassed) closeIfOpen(descriptor);
  return code;
}

bool ChildProcess::send(const void* bytes, size_t size) {
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    if (input_ < 0) return false;
    // Listening too: a child that waits for us to read would never take more.
    pollfd ready[2] = {{input_, POLLOUT, 0}, {errors_, POLLIN, 0}};
    if (poll(ready, 2, -1) < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    if (ready[1].revents != 0) listen();
    if (ready[0].revents == 0) continue;
    const ssize_t sent = ::send(input_, next, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      next += sent;
      size -= size_t(sent);
    } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
      closeIfOpen(input_);
    }
  }
  return true;
}

size_t ChildProcess::receive(void* bytes, size_t size) {
  size_t received = 0;
  while (received < size && output_ >= 0) {
    // Listening too: a child that nobody hears would never write more.
    pollfd ready[2] = {{output_, POLLIN, 0}, {errors_, POLLIN, 0}};
    if (poll(ready, 2, -1) < 0) {
      if (errno == EINTR) continue;
      break;
    }
    if (ready[1].revents != 0) listen();
    if (ready[0].revents == 0) continue;
    const ssize_t count = read(output_, static_cast<char*>(bytes) + received, size - received);
    if (count > 0)
      received += size_t(count);
    else if (count == 0 || errno != EINTR)
      closeIfOpen(output_);
  }
  return received;
}

std::string ChildProcess::receiveRest() {
  std::string all;
  for (char part[1 << 16];;) {
    const size_t count = receive(part, sizeof part);
    all.append(part, count);
    if (count < sizeof part) return all;
  }
}

std::string ChildProcess::finish() {
  closeIfOpen(input_);
  closeIfOpen(output_);
  while (errors_ >= 0) listen();
  int status = 0;
  while (process_ > 0 && waitpid(process_, &status, 0) < 0)
    if (errno != EINTR) break;  // the host ignores SIGCHLD, and nobody knows how it ended
  process_ = -1;
  if (WIFSIGNALED(status)) return std::string("was ended: ") + strsignal(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "ended with code " + std::to_string(WEXITSTATUS(status));
  return "";
}

// Takes what the child has said; waits for it if there is nothing yet.
void ChildProcess::listen() {
  char bytes[1024];
  const ssize_t count = read(errors_, bytes, sizeof bytes);
  if (count < 0 && errno == EINTR) return;
  if (count <= 0) return closeIfOpen(errors_);
  said_.append(bytes, size_t(count));
  if (said_.size() > kKept) said_.erase(0, said_.size() - kKept);
}

}  // namespace scumble::film

#include "programs.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace scumble::app {

std::string shellWord(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789@%+=:,./_-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shellWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + shellWord(word);
  return text;
}

bool isOnPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

Result<std::string> outputOf(const std::vector<std::string>& words, Complaints complaints) {
  const auto failed = [&](const std::string& problem) {
    return Error{ErrorKind::outputNotWritten, "", 0, "", "'" + words.front() + "' " + problem,
                 "see what it says above"};
  };
  std::fflush(nullptr);
  FILE* pipe = popen(
      ("exec " + shellWords(words) + (complaints == Complaints::hidden ? " 2>/dev/null" : "")).c_str(), "r");
  if (!pipe) return failed("cannot be run");
  std::string text;
  char buffer[4096];
  while (const size_t size = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, size);
  const int status = pclose(pipe);
  if (status == -1 || !WIFEXITED(status)) return failed("was stopped");
  if (WEXITSTATUS(status) != 0) return failed("failed with code " + std::to_string(WEXITSTATUS(status)));
  return text;
}

}  // namespace scumble::app

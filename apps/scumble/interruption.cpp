#include "interruption.h"

#include <csignal>
#include <initializer_list>

namespace scumble::app {

namespace {

volatile std::sig_atomic_t signalThatCame = 0;

void note(int signal) {
  signalThatCame = signal;
  // A second signal ends the program.
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  signalThatCame = 0;
  // A shell's background jobs ignore Ctrl-C, and go on ignoring it.
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, note) == SIG_IGN) std::signal(signal, SIG_IGN);
}

Interruption::~Interruption() {
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool Interruption::came() {
  return signalThatCame != 0;
}

int Interruption::exitCode() {
  return signalThatCame == 0 ? 0 : 128 + signalThatCame;
}

const char* Interruption::name() {
  return signalThatCame == SIGTERM ? "SIGTERM" : "Ctrl-C";
}

}  // namespace scumble::app

// A Slurm job array that draws a sequence of frames: its scripts, as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scumble::app {

// All paths are absolute, and the same on all nodes.
struct SlurmJob {
  std::string name;     // of the job, e.g. "shot"
  std::string folder;   // where its scripts, inputs, logs and reports are
  std::string program;  // scumble
  // What is read, packed; each node unpacks it once into a folder of this name.
  std::string inputs;  // e.g. "inputs.0123456789abcdef.tar"
  std::string inside;  // the folder in it where calls are made
  std::string stage;   // where nodes keep copies; empty: $TMPDIR, or /tmp
  std::vector<std::string>
      call;                   // `render` with its options, but for frames; its inputs as seen from `inside`
  int first = 0, last = 0;    // frames
  int chunk = 1;              // frames a task
  std::optional<int> atOnce;  // tasks that run at a time, at most
  bool wantsGpu = false;
  std::vector<std::string> options;             // of sbatch, as they are
  std::vector<std::vector<std::string>> films;  // calls that make them

  int frames() const { return last - first + 1; }
  int tasks() const { return (frames() + chunk - 1) / chunk; }

  // The array: a task draws its frames, those that are not there, whole.
  std::string renderScript() const;
  // What runs after it, however that ended: names frames that are missing, or makes the films.
  std::string finishScript() const;
  // Submits both.
  std::string submitScript() const;

 private:
  std::string head(const std::string& what, const std::string& log) const;
  std::string staging() const;
  bool asksForGpu() const;
};

}  // namespace scumble::app

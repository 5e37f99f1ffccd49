#include "slurm_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "programs.h"

namespace scumble::app {

namespace {

// A log's name in a line of sbatch's, in which percent signs stand for numbers.
std::string logIn(const std::string& folder, const std::string& name) {
  std::string text = "\"";
  for (const char c : folder) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
    if (c == '%') text += c;
  }
  return text + "/logs/" + name + ".txt\"";
}

std::string plainName(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return name;
}

}  // namespace

std::string SlurmJob::head(const std::string& what, const std::string& log) const {
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# Made by `scumble farm slurm`.\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --output={}\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --requeue\n",
      plainName(name) + what, logIn(folder, log));
  for (const std::string& option : options) text += "#SBATCH " + option + "\n";
  return text;
}

// A lock is held while one task of a node unpacks; if it is killed, the next one begins anew. Children must
// not inherit it: one that outlives its task would keep the others waiting.
std::string SlurmJob::staging() const {
  return fmt::format(R"bash(set -euo pipefail
folder={}
program={}
inputs={}
inside={}

# What is read, once on each node.
stage={}/scumble-$UID
(umask 077 && mkdir -p -- "$stage")
[ -O "$stage" ] || {{ echo "$stage belongs to somebody else; give another place with --stage" >&2; exit 5; }}
here=$stage/${{inputs%.tar}}
exec 9>"$stage/lock"
flock 9
# Copies of others that nobody has used for a week.
find "$stage" -mindepth 1 -maxdepth 1 -name 'inputs.*' ! -name "${{inputs%.tar}}" -mtime +7 -exec rm -rf -- {{}} + || true
if [ ! -d "$here" ]; then
  rm -rf -- "$here.part"
  mkdir -- "$here.part"
  tar -xf "$folder/$inputs" -C "$here.part"
  mv -- "$here.part" "$here"
fi
touch -- "$here"
exec 9>&-
mkdir -p -- "$here/$inside"
cd -- "$here/$inside"
# Compiled pipelines are the node's: a thousand nodes would write to one home.
export XDG_CACHE_HOME=$stage/cache
)bash",
                     shellWord(folder), shellWord(program), shellWord(inputs), shellWord(inside),
                     stage.empty() ? "${TMPDIR:-/tmp}" : shellWord(stage));
}

// Who asks for a kind of GPU by an option of their own has asked.
bool SlurmJob::asksForGpu() const {
  return wantsGpu && std::none_of(options.begin(), options.end(), [](const std::string& option) {
           return option.starts_with("--gres") || option.starts_with("--gpus");
         });
}

std::string SlurmJob::renderScript() const {
  return head("", "%A.%a") + (asksForGpu() ? "#SBATCH --gres=gpu:1\n" : "") +
         fmt::format("#SBATCH --array=0-{}{}\n", tasks() - 1, atOnce ? "%" + std::to_string(*atOnce) : "") +
         staging() +
         fmt::format(R"bash(
begin=$(({} + SLURM_ARRAY_TASK_ID * {}))
end=$((begin + {}))
[ "$end" -le {} ] || end={}
reports=$folder/stats/$SLURM_ARRAY_JOB_ID
mkdir -p -- "$reports"
echo "frames $begin..$end on ${{SLURMD_NODENAME:-$(hostname)}}, $(date +%FT%T)"
# A device that is lost, or still full of what an earlier job has left, may be there again.
for try in 1 2 3; do
  code=0
  "$program" {} \
    --frames="$begin..$end" --resume --stats="$reports/$SLURM_ARRAY_TASK_ID.${{SLURM_RESTART_COUNT:-0}}.json" || code=$?
  [ "$code" -eq 4 ] && [ "$try" -lt 3 ] || break
  sleep 20
done
exit "$code"
)bash",
                     first, chunk, chunk - 1, last, last, shellWords(call));
}

std::string SlurmJob::finishScript() const {
  std::string text = head("-finish", "%j.finish") + staging() +
                     fmt::format(R"bash(
# A task that was killed has left no report, and one that found nothing to draw names no device.
devices=$({{ cat "$folder/stats/$1"/*.json 2>/dev/null || true; }} | sed -n 's/^ *"device": "\(.*\)",*$/\1/p' | sort | uniq -c)
[ -z "$devices" ] || printf 'tasks, and what drew them:\n%s\n' "$devices"
[ "$(grep -c . <<<"$devices")" -lt 2 ] || echo "warning: devices round differently; draw a film with one kind" >&2
"$program" {} --frames={}..{} --missing --quiet
echo "all {} frames are there, whole"
)bash",
                                 shellWords(call), first, last, frames());
  for (const std::vector<std::string>& film : films)
    text += fmt::format("\"$program\" {}\n", shellWords(film));
  return text;
}

std::string SlurmJob::submitScript() const {
  return fmt::format(R"bash(#!/bin/bash
# Made by `scumble farm slurm`.
set -euo pipefail
folder={}
render=$(sbatch --parsable "$folder/render.sbatch")
render=${{render%%;*}}
finish=$(sbatch --parsable --dependency="afterany:$render" "$folder/finish.sbatch" "$render") || {{
  scancel "$render"
  exit 1
}}
echo "job $render draws {} frames in {} tasks; job ${{finish%%;*}} then looks whether all are there"
)bash",
                     shellWord(folder), frames(), tasks());
}

}  // namespace scumble::app

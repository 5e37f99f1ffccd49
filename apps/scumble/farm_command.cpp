// scumble farm: frames for engines that hand work to many machines.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "commands.h"
#include "frame_loop.h"
#include "packed_inputs.h"
#include "programs.h"
#include "render_arguments.h"
#include "report.h"
#include "slurm_job.h"

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

struct FarmArguments {
  RenderArguments render;
  std::vector<const CLI::Option*> renderOptions;
  std::string film, folder, program, stage, gpu = "auto";
  std::optional<int> chunk, atOnce;
  std::vector<std::string> sbatch;
  bool submit = false, dryRun = false;
};

// What a cluster says of itself.
struct Cluster {
  int mostTasks = 1001;  // of an array: MaxArraySize, and what Slurm has for usual
  std::optional<int> nodes;
  bool hasGpus = false;
};

// Nothing where there is none, or where its controller does not answer.
std::optional<Cluster> clusterHere() {
  constexpr const char* kPatience = "10";  // seconds; Slurm's programs wait for minutes
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"timeout", kPatience});
    return outputOf(words, Complaints::hidden);
  };
  if (!isOnPath("scontrol") || !isOnPath("sinfo")) return std::nullopt;
  const Result<std::string> nodes = ask({"sinfo", "--noheader", "--format=%D %G"});
  const Result<std::string> config = nodes ? ask({"scontrol", "show", "config"}) : nodes;
  if (!config) return std::nullopt;
  Cluster cluster;
  std::istringstream resources(*nodes), settings(*config);
  int count = 0;
  for (std::string each; resources >> count >> each;) {
    cluster.nodes = cluster.nodes.value_or(0) + count;
    cluster.hasGpus = cluster.hasGpus || each.starts_with("gpu") || each.find(",gpu") != std::string::npos;
  }
  for (std::string line; std::getline(settings, line);)
    if (line.starts_with("MaxArraySize"))
      cluster.mostTasks = std::max(1, std::atoi(line.c_str() + line.find('=') + 1));
  return cluster;
}

// Seconds on this machine.
struct FrameTime {
  double start, frame;
  std::string device;
};

// Of its first two frames.
Result<FrameTime> timeFrames(RenderPlan plan) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin = Clock::now();
  const Result<std::unique_ptr<Renderer>> renderer = rendererFor(plan);
  if (!renderer) return renderer.error();
  std::vector<double> times = plan.times();
  times.resize(2, times.front());
  double seconds[2];
  Progress none(2, true);
  for (int i = 0; i < 2; ++i) {
    const Status status = drawFrames(plan, **renderer, {times[size_t(i)]}, none,
                                     [](size_t, const Frame&) { return Status(Done{}); });
    if (!status) return status.error();
    seconds[i] = std::chrono::duration<double>(Clock::now() - begin).count();
    begin = Clock::now();
  }
  return FrameTime{std::max(seconds[0] - seconds[1], 0.0), seconds[1], (*renderer)->gpu().name};
}

// Ten minutes of work a task, less where that would leave nodes idle, more where starting would take more
// than a tenth.
int usualChunk(const FrameTime& time, int frames, const Cluster& cluster) {
  constexpr double kTask = 600, kMostStart = 0.1, kTasksANode = 2;
  double chunk = kTask / time.frame;
  if (cluster.nodes.value_or(0) > 0)
    chunk = std::min(chunk, std::ceil(frames / (kTasksANode * *cluster.nodes)));
  chunk = std::max(chunk, std::ceil(time.start / (kMostStart * time.frame)));
  return int(std::clamp(chunk, 1.0, double(frames)));
}

constexpr int kUntimedChunk = 25;

Result<int> chunkFor(const FarmArguments& args, const RenderPlan& plan, const Cluster& cluster) {
  const int frames = int(plan.numbers.size()), least = (frames + cluster.mostTasks - 1) / cluster.mostTasks;
  int chunk = args.chunk.value_or(kUntimedChunk);
  if (chunk < 1) return usage("--chunk " + std::to_string(chunk) + " is out of range", "give frames a task");
  if (!args.chunk) {
    const Result<FrameTime> time = timeFrames(plan);
    if (time) {
      chunk = usualChunk(*time, frames, cluster);
      std::puts(fmt::format("a frame takes {:.3f} s here ({}), and starting {:.1f} s", time->frame,
                            time->device, time->start)
                    .c_str());
    } else if (time.error().kind == ErrorKind::noUsableGpu) {
      std::printf("no frame can be timed here (%s): --chunk says how many a task draws\n",
                  time.error().message().c_str());
    } else {
      return time.error();
    }
  } else if (chunk < least) {
    warn({"--chunk " + std::to_string(chunk) + " would make more tasks than this cluster's arrays hold (" +
          std::to_string(cluster.mostTasks) + "): it is " + std::to_string(least)});
  }
  return std::min(std::max(chunk, least), frames);
}

// "shots/boat.####.exr" is "boat".
std::string nameOf(const std::string& output) {
  std::string name = fs::path(output).stem().string();
  name.erase(std::remove(name.begin(), name.end(), '#'), name.end());
  while (!name.empty() && std::string("._- ").find(name.back()) != std::string::npos) name.pop_back();
  return name.empty() ? "frames" : name;
}

// The call as nodes make it: what was given, but for files, which have other names there.
std::vector<std::string> callOf(const FarmArguments& args, const RenderPlan& plan, const PackedInputs& inputs,
                                const std::string& output) {
  const std::vector<std::string> elsewhere{"SCENE", "--output", "--frames", "--look", "--background"};
  std::vector<std::string> call{"render"};
  for (const CLI::Option* option : args.renderOptions) {
    const std::string name =
        option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames()[0];
    if (option->count() == 0 || std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end())
      continue;
    for (const std::string& value : option->results())
      call.push_back(option->get_expected_max() == 0 || value.empty() || value == "{}" ? name
                                                                                       : name + "=" + value);
  }
  const std::string look = plan.args.look.lookFor(plan.args.scene.files[0]);
  call.push_back("--look=" + (isLookFile(look) ? inputs.fromInside(look) : look));
  if (!plan.args.background.empty()) {
    const std::string file = plan.background.file();
    call.push_back("--background=" + (file.empty() ? plan.args.background : inputs.fromInside(file)));
  }
  call.push_back("--output=" + output);
  for (const std::string& file : plan.args.scene.files) call.push_back(inputs.fromInside(file));
  return call;
}

// One film, or one an eye.
Result<std::vector<std::vector<std::string>>> filmCalls(const FarmArguments& args, const RenderPlan& plan,
                                                        const std::string& output) {
  std::vector<std::vector<std::string>> calls;
  if (args.film.empty()) return calls;
  const Result<const OutputFormat*> format = formatOf(args.film);
  if (!format) return format.error();
  if ((*format)->kind != OutputKind::film || isNumbered(args.film))
    return usage("'" + args.film + "' is no film", "name it like shot.mp4, .webm or .gif");
  if (plan.output.kind() == OutputKind::drawing)
    return usage("a film is of pictures, and '" + plan.output.path + "' are drawings", "leave --film out");
  OutputPlan film = plan.output;
  film.path = fs::absolute(args.film).lexically_normal().string();
  const std::vector<std::string> from = plan.output.picturePaths(output), to = film.picturePaths(film.path);
  OutputFiles files(plan.inputs());
  for (size_t i = 0; i < from.size(); ++i) {
    if (const Status status = files.add(to[i], "--film"); !status) return status.error();
    std::vector<std::string> call{"film", "--frames=" + std::to_string(plan.numbers.front()) + ".." +
                                              std::to_string(plan.numbers.back())};
    call.push_back(fmt::format("--fps={}", plan.args.fps));
    if (plan.output.layout) call.push_back(std::string("--stereo=") + plan.output.layout->name);
    if (plan.args.kind) call.push_back(std::string("--panorama=") + plan.args.kind->name);
    call.push_back("--output=" + to[i]);
    call.push_back(from[i]);
    calls.push_back(std::move(call));
  }
  return calls;
}

Status checkWords(const FarmArguments& args, const SlurmJob& job) {
  for (const std::string& option : args.sbatch)
    if (!option.starts_with("-") || option.find('\n') != std::string::npos)
      return usage("--sbatch '" + option + "' is no option of sbatch",
                   "write it like --sbatch=--partition=gpu");
  // A line of a script holds it, in which Slurm takes a backslash for an order.
  if (job.folder.find_first_of("\n\\") != std::string::npos)
    return usage("the folder '" + job.folder + "' has a backslash or several lines in its name",
                 "give another one with --folder");
  // Tasks run in a folder of the node.
  if (!args.stage.empty() && !args.stage.starts_with('/'))
    return usage("--stage " + args.stage + " is no absolute path", "write it like /scratch");
  if (args.program.find('/') != std::string::npos && !args.program.starts_with('/'))
    return usage("--program " + args.program + " is no absolute path",
                 "write it like /opt/scumble/bin/scumble");
  if (args.gpu != "auto" && args.gpu != "yes" && args.gpu != "no")
    return usage("--gpu " + args.gpu + " is unknown", "use auto, yes or no");
  if (args.atOnce && *args.atOnce < 1)
    return usage("--at-once " + std::to_string(*args.atOnce) + " is out of range", "give tasks, 1 or more");
  return Done{};
}

Status write(SlurmJob& job, const PackedInputs& inputs) {
  const fs::path folder = job.folder;
  std::error_code problem;
  fs::create_directories(folder / "logs", problem);
  if (problem)
    return Error{ErrorKind::outputNotWritten, job.folder, 0, "", problem.message(),
                 "choose another --folder"};
  const Result<std::string> packed = inputs.pack(job.folder);
  if (!packed) return packed.error();
  job.inputs = *packed;
  for (const auto& [name, text] : {std::pair{"render.sbatch", job.renderScript()},
                                   {"finish.sbatch", job.finishScript()},
                                   {"submit", job.submitScript()}})
    if (const Status status = writeText((folder / name).string(), text); !status) return status.error();
  return Done{};
}

int run(const FarmArguments& args) {
  Result<RenderPlan> plan = planRender(args.render);
  if (!plan) return fail(plan.error());
  if (!plan->output.isSequence())
    return failUsage("'" + plan->output.path + "' is not a sequence of frames, which are what is handed out",
                     "name it like shot.####.exr, and give --film shot.mp4 for a film of them");
  const std::string output = fs::absolute(plan->output.path).lexically_normal().string();
  const Result<PackedInputs> inputs = PackedInputs::of(plan->inputs());
  if (!inputs) return fail(inputs.error());
  SlurmJob job;
  job.name = nameOf(output);
  job.folder =
      fs::absolute(args.folder.empty() ? (fs::path(output).parent_path() / (job.name + ".farm")).string()
                                       : args.folder)
          .lexically_normal()
          .string();
  if (const Status status = checkWords(args, job); !status) return fail(status.error());
  std::error_code ignored;
  job.program = args.program.empty() ? fs::canonical("/proc/self/exe", ignored).string() : args.program;
  job.inputs = "inputs.SUM.tar";
  job.inside = inputs->inside();
  job.stage = args.stage;
  job.first = plan->numbers.front(), job.last = plan->numbers.back();
  job.atOnce = args.atOnce;
  job.options = args.sbatch;
  Result<std::vector<std::vector<std::string>>> films = filmCalls(args, *plan, output);
  if (!films) return fail(films.error());
  job.films = std::move(films).value();
  job.call = callOf(args, *plan, *inputs, output);

  const std::optional<Cluster> found = clusterHere();
  const Cluster cluster = found.value_or(Cluster());
  if (!found)
    std::printf(
        "no cluster of Slurm answers here: an array is taken to hold %d tasks, and no GPU is asked for "
        "unless --gpu says so\n",
        cluster.mostTasks);
  job.wantsGpu = args.gpu == "yes" || (args.gpu == "auto" && cluster.hasGpus);
  // Without it a node whose GPU does not work would draw on its processor, and a little differently.
  if (job.wantsGpu && !args.render.isGiven("--device")) job.call.insert(job.call.begin() + 1, "--device=gpu");
  // Where frames will be drawn by GPUs, a processor's time says nothing.
  RenderPlan timed = *plan;
  if (job.wantsGpu && timed.args.picture.device.empty()) timed.args.picture.device = "gpu";
  const Result<int> chunk = chunkFor(args, timed, cluster);
  if (!chunk) return fail(chunk.error());
  job.chunk = *chunk;

  std::puts(fmt::format("frames: {} ({}..{}), {} a task; tasks: {}; files that are read: {}, {:.1f} MB",
                        job.frames(), job.first, job.last, job.chunk, job.tasks(), inputs->files().size(),
                        double(inputs->bytes()) / 1e6)
                .c_str());
  if (args.dryRun) {
    for (const std::string& file : inputs->files()) std::printf("  %s\n", file.c_str());
    std::printf("\n== %s/render.sbatch\n%s\n== %s/finish.sbatch\n%s\n== %s/submit\n%s", job.folder.c_str(),
                job.renderScript().c_str(), job.folder.c_str(), job.finishScript().c_str(),
                job.folder.c_str(), job.submitScript().c_str());
    return kDone;
  }
  if (const Status status = write(job, *inputs); !status) return fail(status.error());
  const std::vector<std::string> submit{"bash", job.folder + "/submit"};
  if (!args.submit) {
    std::printf("to submit them: %s\n", shellWords(submit).c_str());
    return kDone;
  }
  if (!isOnPath("sbatch"))
    return fail({ErrorKind::outputNotWritten, "", 0, "", "there is no sbatch on the PATH",
                 "submit on a machine of the cluster: " + shellWords(submit)});
  const Result<std::string> said = outputOf(submit);
  if (!said) return fail(said.error());
  std::fputs(said->c_str(), stdout);
  return kDone;
}

void addSlurm(CLI::App& farm, int& exitCode) {
  auto args = std::make_shared<FarmArguments>();
  CLI::App* command = farm.add_subcommand(
      "slurm",
      "A job array of Slurm that draws a sequence of frames, and a job that looks whether all are there");
  args->render.addTo(*command);
  args->renderOptions = std::as_const(*command).get_options();
  command->add_flag("--quiet", args->render.quiet, "No warnings");
  const std::string group = "Of the farm";
  const auto add = [&](const char* name, auto& value, const std::string& what) {
    return command->add_option(name, value, what)->group(group);
  };
  add("--film", args->film, "Make this film of the frames at the end: .mp4, .webm or .gif");
  add("--chunk", args->chunk,
      "Frames a task (default: from two frames that are timed here; ten minutes of work, less where nodes "
      "would "
      "be idle, more where starting would take more than a tenth)");
  add("--at-once", args->atOnce, "Tasks that run at a time, at most");
  add("--gpu", args->gpu, "Ask for one GPU a task; auto: where the cluster says that it has some")
      ->type_name("auto|yes|no")
      ->capture_default_str();
  add("--sbatch", args->sbatch, "An option of sbatch as it is, e.g. --sbatch=--partition=night; repeatable")
      ->allow_extra_args(false);
  add("--folder", args->folder,
      "Where scripts, packed inputs, logs and reports go (default: beside the frames, NAME.farm). All nodes "
      "see it, "
      "and where the frames go");
  add("--program", args->program, "scumble on the nodes (default: this one, by its path here)");
  add("--stage", args->stage,
      "A folder of each node for its copy of what is read (default: $TMPDIR there, or /tmp)");
  command->add_flag("--submit", args->submit, "Hand it to Slurm")->group(group);
  command->add_flag("--dry-run", args->dryRun, "Show all of it, write nothing")->group(group);
  command->footer(
      "Example: scumble farm slurm boat.glb --frames 0..239 -o shots/boat.####.exr --film boat.mp4 --submit");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace

void addFarm(CLI::App& program, int& exitCode) {
  CLI::App* farm =
      program.add_subcommand("farm", "Films on many machines: jobs for engines that hand out work");
  farm->require_subcommand(0, 1);
  addSlurm(*farm, exitCode);
  farm->callback([farm, &exitCode] {
    if (farm->get_subcommands().empty())
      exitCode = failUsage("nothing says for which engine", "write `scumble farm slurm`");
  });
  farm->footer("Example: scumble farm slurm boat.glb --frames 0..239 -o shots/boat.####.exr --dry-run");
}

}  // namespace scumble::app

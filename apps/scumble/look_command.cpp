// scumble look: a look from a picture of a painting.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "../viewer/knob_text.h"
#include "commands.h"
#include "json_option.h"
#include "options.h"
#include "output_files.h"
#include "report.h"
#include "scumble/study.h"

namespace scumble::app {

namespace {

using nlohmann::json;

struct LookFromPicture {
  std::string picture, out;
  JsonOption json;
  bool quiet = false;
};

json toJson(const ColorFamily& family) {
  return {{"share", family.share},
          {"lightness", family.lightness},
          {"chroma", family.chroma},
          {"hue", family.hue},
          {"agreement", family.agreement}};
}

json toJson(const PictureStudy& study) {
  json palette = json::array();
  for (const PaletteColor& color : study.palette)
    palette.push_back({{"color", viewer::hexOf(color.color)}, {"share", color.share}});
  return {{"width", study.width},
          {"height", study.height},
          {"value",
           {{"darkest", study.darkest},
            {"median", study.median},
            {"lightest", study.lightest},
            {"division", study.division}}},
          {"light", toJson(study.light)},
          {"dark", toJson(study.dark)},
          {"chroma", study.chroma},
          {"palette", palette},
          {"fewness", study.fewness},
          {"above", viewer::hexOf(study.above)},
          {"horizon", viewer::hexOf(study.horizon)},
          {"below", viewer::hexOf(study.below)},
          {"lines",
           {{"onBorders", study.lines.onBorders},
            {"offBorders", study.lines.offBorders},
            {"isDrawn", study.lines.isDrawn},
            {"thin", study.lines.thin},
            {"thick", study.lines.thick},
            {"color", viewer::hexOf(study.lines.color)}}},
          {"borders",
           {{"counted", study.borders.counted},
            {"raggedness", study.borders.raggedness},
            {"width", study.borders.width}}},
          {"marks",
           {{"grain", study.marks.grain},
            {"contrast", study.marks.contrast},
            {"width", study.marks.width},
            {"direction", study.marks.direction}}},
          {"isOnPaper", study.isOnPaper}};
}

std::string summaryOf(const PictureStudy& study, const std::string& out) {
  std::string text = fmt::format("{}: {} colour{}, values from {:.2f} to {:.2f}", out, study.palette.size(),
                                 study.palette.size() == 1 ? "" : "s", study.darkest, study.lightest);
  text += study.lines.isDrawn
              ? fmt::format(", lines of {:.1f} to {:.1f} px", study.lines.thin, study.lines.thick)
              : ", no lines";
  if (study.borders.counted > 0) text += fmt::format(", edges ragged by {:.1f} px", study.borders.raggedness);
  return text + (study.isOnPaper ? ", on bare paper" : "");
}

int run(const LookFromPicture& args) {
  const std::string out =
      args.out.empty() ? std::filesystem::path(args.picture).stem().string() + ".found.json" : args.out;
  if (endingOf(out) != ".json")
    return failUsage("a look cannot go into '" + out + "'", "name it like painting.json");
  OutputFiles files({args.picture});
  if (const Status status = files.add(out, "-o"); !status) return fail(status.error());
  if (const Status status = files.add(args.json.file(), "--json"); !status) return fail(status.error());
  const Result<Image> picture =
      endingOf(args.picture) == ".exr" ? readExr(args.picture) : readPicture(args.picture);
  if (!picture) return fail(picture.error());
  Result<PictureStudy> study = studyPicture(*picture);
  if (!study) {
    Error error = study.error();
    error.kind = ErrorKind::unusableFile, error.file = args.picture;
    return fail(error);
  }
  const std::string text = lookTextOf(*study, std::filesystem::path(args.picture).filename().string());
  if (const Status status = writeText(out, text); !status) return fail(status.error());
  if (const Status status = args.json.give(toJson(*study)); !status) return fail(status.error());
  if (args.quiet || args.json.isPrinted()) return kDone;
  std::puts(summaryOf(*study, out).c_str());
  return kDone;
}

}  // namespace

void addLook(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<LookFromPicture>();
  CLI::App* command = program.add_subcommand("look", "A look from a picture of a painting");
  command->add_option("PICTURE", args->picture, "A PNG, JPEG, WebP or EXR")->required();
  command
      ->add_option("-o", args->out,
                   "Where the look is written (default: the picture's name + .found.json, here)")
      ->type_name("LOOK.json");
  args->json.addTo(*command);
  command->add_flag("--quiet", args->quiet, "Print nothing");
  command->footer(
      "Example: scumble look painting.jpg -o mine.json && scumble render boat.glb --look mine.json");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app

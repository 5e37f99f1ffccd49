#include "server.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace scumble::serve {

using nlohmann::json;

namespace {

// The picture's name among AOVs: the library's is empty.
constexpr const char* kPicture = "picture";
const std::vector<std::string> kFormats = {"float32", "float16", "srgb8"};

// As knobs take it.
std::string textOf(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string all;
  for (const json& item : value) all += (all.empty() ? "" : ",") + item.dump();
  return all;
}

size_t bytesOf(PixelFormat format) {
  return format == PixelFormat::float32 ? 4 : format == PixelFormat::half ? 2 : 1;
}

const void* dataOf(const Image& image) {
  if (image.format == PixelFormat::half) return image.halves.data();
  if (image.format == PixelFormat::srgb8) return image.codes.data();
  return image.pixels.data();
}

// A part of each picture, in pixels from its upper left corner.
struct Region {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

std::optional<Region> regionOf(Members& request, const RenderOptions& options) {
  const auto given = request.numbers("region", 4);
  if (!given) return std::nullopt;
  for (const double number : *given)
    if (!(number >= 0 && number <= 16384 && number == std::floor(number)))
      refuse(request.place("region"), "it is not of whole pixels", "give x, y, width and height");
  const Region region = {uint32_t((*given)[0]), uint32_t((*given)[1]), uint32_t((*given)[2]),
                         uint32_t((*given)[3])};
  if (region.width == 0 || region.height == 0 || region.x + region.width > options.width ||
      region.y + region.height > options.height)
    refuse(request.place("region"), "it does not lie within the picture", "give x, y, width and height");
  return region;
}

View viewOf(const json& given, const std::string& where, const ServedScene& scene) {
  Members members(given, where);
  members.require("worldToEye"), members.require("eyeToClip");
  View view;
  setWorldToEye(view, *members.matrix("worldToEye"));
  view.eyeToClip = *members.matrix("eyeToClip");
  if (const auto node = members.text("node")) view.node = int(scene.nodeOf(*node, members.place("node")));
  view.isLevel = members.flag("isLevel").value_or(false);
  members.end();
  return view;
}

std::vector<View> listedViews(const json& list, const std::string& where, const ServedScene& scene) {
  std::vector<View> views;
  for (size_t i = 0; i < list.size(); ++i)
    views.push_back(viewOf(list[i], where + "[" + std::to_string(i) + "]", scene));
  return views;
}

Viewpoint viewpointOf(const json& given, const std::string& where, Stereo& stereo, float& ipd) {
  Members members(given, where);
  Viewpoint viewpoint;
  viewpoint.frame = members.text("frame").value_or("");
  if (const auto angles = members.numbers("orbit", 2))
    viewpoint.orbit = true, viewpoint.azimuth = (*angles)[0], viewpoint.elevation = (*angles)[1];
  const auto number = [&](const char* name) {
    const auto value = members.number(name);
    return value ? std::optional<float>(float(*value)) : std::nullopt;
  };
  viewpoint.distance = number("distance");
  viewpoint.eye = members.vector("eye");
  viewpoint.target = members.vector("target");
  viewpoint.roll = number("roll");
  viewpoint.verticalFov = number("fov");
  stereo = members.flag("stereo").value_or(false) ? Stereo::stereo : Stereo::mono;
  ipd = number("ipd").value_or(ipd);
  members.end();
  return viewpoint;
}

json statsOf(const FrameStats& stats) {
  return {{"gpuMilliseconds", stats.gpuMilliseconds},
          {"cpuMilliseconds", stats.cpuMilliseconds},
          {"pipelines", stats.pipelines},
          {"writtenPrimitives", stats.writtenPrimitives},
          {"writtenTextures", stats.writtenTextures},
          {"writtenMaterials", stats.writtenMaterials},
          {"uploadedBytes", stats.uploadedBytes},
          {"triangles", stats.triangles},
          {"deviceBytes", stats.deviceBytes}};
}

}  // namespace

json Server::greeting() const {
  json aovs = json::array();
  for (const std::string& name : Renderer::aovNames())
    aovs.push_back({{"name", name},
                    {"needsFloat", Renderer::needsFloat(name)},
                    {"hasSizeOfItsOwn", Renderer::hasSizeOfItsOwn(name)}});
  const GpuInfo gpu = renderer_->gpu();
  return {{"scumble", version_},  {"protocol", kProtocol}, {"device", gpu.name},
          {"driver", gpu.driver}, {"isCpu", gpu.isCpu},    {"maxViews", Renderer::kMaxViews},
          {"aovs", aovs}};
}

json Server::edit(Members& request) {
  const json& edits = request.list("edits");
  request.end();
  for (size_t i = 0; i < edits.size(); ++i) {
    try {
      scene_.edit(edits[i], "edits[" + std::to_string(i) + "]", memory_);
    } catch (Refusal& refusal) {
      // Numbers in a list tell people little.
      if (edits[i].is_object() && edits[i].contains("key") && edits[i]["key"].is_string())
        refusal.error.problem = "'" + edits[i]["key"].get<std::string>() + "': " + refusal.error.problem;
      throw;
    }
  }
  return scene_.counts();
}

json Server::setLook(Members& request) {
  const json* given = request.find("look");
  const std::string file = request.text("file").value_or("look.json");
  request.end();
  Look look;
  if (given && given->is_string())
    look = valueOf(Look::load(given->get<std::string>()), "look");
  else if (given)
    look = valueOf(Look::fromJson(given->dump(), file), "look");
  look_ = look;
  return {{"description", look_.description()}, {"files", look_.files()}, {"warnings", look_.warnings()}};
}

json Server::setKnobs(Members& request) {
  const json& knobs = request.require("knobs");
  if (!knobs.is_object()) refuse("knobs", "this is no object", "give values by paths");
  request.end();
  Look look = look_;  // all of them or none
  for (const auto& [path, value] : knobs.items()) {
    const std::string where = "knobs." + path;
    valueOf(value.is_null() ? look.unset(path) : look.set(path, textOf(value)), where);
  }
  look_ = look;
  return json::object();
}

std::vector<View> Server::viewsOf(Members& request, const Scene& scene, double time,
                                  const RenderOptions& options) const {
  const json* viewpoint = request.find("viewpoint");
  const json& list = request.list("views");
  if (!viewpoint == list.empty())
    refuse("views", "a frame is seen from views, or from a viewpoint", "give one of the two");
  if (!viewpoint) return listedViews(list, "views", scene_);
  Stereo stereo = Stereo::mono;
  float ipd = 0.063f;
  const Viewpoint from = viewpointOf(*viewpoint, "viewpoint", stereo, ipd);
  return valueOf(
      makeViews(scene, from, float(options.width) / float(options.height), stereo, ipd, look_, time),
      "viewpoint");
}

json Server::render(Members& request, const Progress& progress) {
  constexpr uint64_t kMostSide = 16384;
  RenderOptions options;
  if (const auto size = request.numbers("size", 2)) {
    for (const float side : *size)
      if (!(side >= 1 && side <= float(kMostSide)) || side != std::floor(side))
        refuse("size", "a picture cannot be of this size", "give width and height, 1 to 16384");
    options.width = uint32_t((*size)[0]), options.height = uint32_t((*size)[1]);
  }
  const double time = request.number("time").value_or(0);
  options.samples = uint32_t(request.whole("samples", 4).value_or(options.samples));
  options.seed = uint32_t(request.whole("seed", ~uint32_t(0)).value_or(0));
  options.transparent = request.flag("transparent").value_or(false);
  options.aovs = request.texts("aovs").value_or(std::vector<std::string>());
  if (const json* formats = request.find("formats")) {
    Members members(*formats, "formats");
    for (const auto& [name, value] : formats->items())
      if (!value.is_string())
        refuse(members.place(name), "this is no text", "write it in quotes");
      else
        options.formats[name == kPicture ? "" : name] = PixelFormat(*members.word(name, kFormats));
  }
  const std::optional<Region> region = regionOf(request, options);
  const Scene scene = valueOf(scene_.scene(), "");
  const std::vector<View> views = viewsOf(request, scene, time, options);
  if (const json* previous = request.find("previous")) {
    Members members(*previous, "previous");
    options.previousTime = members.number("time");
    options.previousViews = listedViews(members.list("views"), "previous.views", scene_);
    if (members.flag("remembered").value_or(false)) {
      if (remembered_.empty()) refuse("previous.remembered", "no scene is remembered", "do remember first");
      options.previousScene = remembered_;
    }
    members.end();
  }
  const ClientMemory::Range range = memory_.rangeOf(request.require("into"), "into", 1);
  request.end();

  options.progress = progress;
  const int messages = renderer_->validationMessages();
  const Frame frame = valueOf(renderer_->render(scene, look_, time, views, options), "");
  if (renderer_->validationMessages() > messages)
    throw Refusal{
        {ErrorKind::internal, "", 0, "", "the validation layers have spoken", "please report this"}};

  // A region is one of the picture: what has a size of its own comes whole.
  struct Part {
    const Image& image;
    Region region;
    uint64_t pixel, offset;  // bytes
  };
  json layers = json::array();
  std::vector<Part> parts;
  uint64_t bytes = 0;
  for (const Frame::Layer& layer : frame.layers)
    for (size_t v = 0; v < layer.views.size(); ++v) {
      const Image& image = layer.views[v];
      const bool isPart = region && image.width == options.width && image.height == options.height;
      const Part part = {image, isPart ? *region : Region{0, 0, image.width, image.height},
                         image.channels.size() * bytesOf(image.format), bytes};
      bytes += part.pixel * part.region.width * part.region.height;
      layers.push_back({{"name", layer.name.empty() ? kPicture : layer.name},
                        {"view", v},
                        {"width", part.region.width},
                        {"height", part.region.height},
                        {"channels", image.channels},
                        {"format", kFormats[size_t(image.format)]},
                        {"isColor", image.isColor},
                        {"offset", range.offset + part.offset}});
      parts.push_back(part);
    }
  if (bytes > range.bytes)
    refuse(
        "into.count",
        "the pictures take " + std::to_string(bytes) + " bytes, and there are " + std::to_string(range.bytes),
        "share more");
  for (const Part& part : parts) {
    const uint64_t row = part.pixel * part.region.width, rowOfImage = part.pixel * part.image.width;
    const char* from = static_cast<const char*>(dataOf(part.image)) + part.region.y * rowOfImage +
                       part.region.x * part.pixel;
    for (uint32_t y = 0; y < part.region.height; ++y)
      memory_.write(range, part.offset + y * row, from + y * rowOfImage, row);
  }
  json done = {
      {"layers", layers}, {"bytes", bytes}, {"warnings", scene.warnings()}, {"stats", statsOf(frame.stats)}};
  if (!frame.objects.empty()) done["objects"] = frame.objects;
  if (!frame.materials.empty()) done["materials"] = frame.materials;
  return done;
}

json Server::answer(Members& request, int64_t id, const Requests& requests, Answers& answers) {
  const std::string verb = request.requireText("do");
  if (verb == "share") {
    const std::string name = request.requireText("memory"), file = request.requireText("file");
    const uint64_t bytes = request.requireWhole("bytes", ClientMemory::kMostBytes);
    request.end();
    memory_.share(name, file, bytes);
    return json::object();
  }
  if (verb == "forget") {
    const std::string name = request.requireText("memory");
    request.end();
    memory_.forget(name);
    return json::object();
  }
  if (verb == "edit") return edit(request);
  if (verb == "clear") {
    request.end();
    scene_.clear();
    remembered_ = Scene();
    return scene_.counts();
  }
  if (verb == "look") return setLook(request);
  if (verb == "set") return setKnobs(request);
  if (verb == "remember") {
    request.end();
    remembered_ = valueOf(scene_.scene(), "");
    return json::object();
  }
  if (verb == "render") {
    double told = 0;
    return render(request, [&](double part) {
      if (part >= told + 0.02) {
        answers.send({{"id", id}, {"progress", part}});
        told = part;
      }
      return !requests.isCancelled(id);
    });
  }
  refuse("do", "'" + verb + "' cannot be done",
         "there is " +
             listed({"share", "forget", "edit", "clear", "look", "set", "remember", "render", "cancel"}));
}

Status Server::run(int in, int out) {
  Answers answers(out);
  Requests requests(answers);
  answers.send(greeting());
  std::thread reader([&] { requests.read(in); });
  while (const auto taken = requests.take()) {
    const json& id = taken->at("id");
    const auto number = id.get<int64_t>();
    json reply = {{"id", number}};
    try {
      Members request(*taken, "");
      request.find("id");
      if (requests.isCancelled(number))
        throw Refusal{{ErrorKind::cancelled, "", 0, "", "the request was cancelled", ""}};
      reply["done"] = answer(request, number, requests, answers);
    } catch (const Refusal& refusal) {
      reply["error"] = toJson(refusal.error);
    } catch (const std::bad_alloc&) {
      reply["error"] = toJson({ErrorKind::usage, "", 0, "", "there is not enough memory", "use less"});
    } catch (const std::exception& error) {
      reply["error"] = toJson({ErrorKind::internal, "", 0, "", error.what(), "please report this"});
    }
    requests.done(number);
    answers.send(reply);
  }
  reader.join();
  if (answers.isLost())
    return Error{ErrorKind::outputNotWritten, "", 0, "", "nobody reads the answers", "check where they go"};
  return Done{};
}

}  // namespace scumble::serve

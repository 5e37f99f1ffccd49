// The C face: handles around what the C++ headers have. No exception passes.
#include <algorithm>
#include <cstring>
#include <exception>
#include <new>

#include "scumble/image.h"
#include "scumble/renderer.h"
#include "scumble/scumble.h"

using namespace scumble;

struct scumble_scene {
  Scene scene;
};
struct scumble_look {
  Look look;
};
struct scumble_renderer {
  std::unique_ptr<Renderer> renderer;
  std::string device;
};
struct scumble_frame {
  Frame frame;
};

namespace {

thread_local std::string lastError;

scumble_status fail(const Error& error) {
  lastError = error.message();
  return scumble_status(int(error.kind) + 1);
}
scumble_status misuse(const std::string& problem) {
  return fail({ErrorKind::usage, "", 0, "", problem, "see scumble.h"});
}
std::nullptr_t nothing(const Error& error) {
  fail(error);
  return nullptr;
}

// Runs `call`, whose result is given; what it throws becomes an error.
template <class Call>
auto guarded(Call call) -> decltype(call()) {
  Error error{ErrorKind::internal, "", 0, "", "something unexpected happened", "please report it"};
  try {
    return call();
  } catch (const std::bad_alloc&) {
    error.problem = "there is not enough memory", error.advice = "";
  } catch (const std::exception& thrown) {
    error.problem = thrown.what();
  }
  const scumble_status status = fail(error);
  if constexpr (std::is_pointer_v<decltype(call())>)
    return nullptr;
  else
    return status;
}

std::string textOf(const char* text) {
  return text ? text : "";
}

View toView(const scumble_view& view) {
  View result;
  std::memcpy(&result.worldToEye, view.world_to_eye, sizeof(view.world_to_eye));
  std::memcpy(&result.eyeToClip, view.eye_to_clip, sizeof(view.eye_to_clip));
  result.node = view.node;
  result.size = {view.width, view.height};
  result.rig = view.rig;
  return result;
}

scumble_view toView(const View& view) {
  scumble_view result{};
  std::memcpy(result.world_to_eye, &view.worldToEye, sizeof(result.world_to_eye));
  std::memcpy(result.eye_to_clip, &view.eyeToClip, sizeof(result.eye_to_clip));
  result.node = view.node;
  result.width = view.size.x, result.height = view.size.y;
  result.rig = view.rig;
  return result;
}

// What render and prepare are given. Fails with usage for null where something must be.
struct Call {
  std::vector<View> views;
  RenderOptions options;
};
Result<Call> callOf(const scumble_renderer* renderer, const scumble_scene* scene, const scumble_look* look,
                    const scumble_view* views, size_t count, const scumble_options* options) {
  const Error null{ErrorKind::usage, "", 0, "", "renderer, scene, look, views or options are null",
                   "see scumble.h"};
  if (!renderer || !scene || !look || !views || !options || (options->aov_count > 0 && !options->aovs))
    return null;
  Call call;
  for (size_t i = 0; i < std::min(count, size_t(Renderer::kMaxViews) + 1); ++i)
    call.views.push_back(toView(views[i]));
  call.options.width = options->width, call.options.height = options->height;
  call.options.samples = options->samples;
  call.options.seed = options->seed;
  call.options.transparent = options->transparent != 0;
  for (size_t i = 0; i < options->aov_count; ++i) {
    if (!options->aovs[i]) return null;
    call.options.aovs.emplace_back(options->aovs[i]);
  }
  if (options->format < SCUMBLE_FLOAT32 || options->format > SCUMBLE_SRGB8)
    return Error{ErrorKind::usage, "", 0, "", "the format is none", "see scumble_format"};
  call.options.formats[""] = PixelFormat(options->format);
  return call;
}

const Image* imageOf(const scumble_frame* frame, size_t layer, size_t view) {
  if (!frame || layer >= frame->frame.layers.size() || view >= frame->frame.layers[layer].views.size())
    return nullptr;
  return &frame->frame.layers[layer].views[view];
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

const char* scumble_error(void) {
  return lastError.c_str();
}

const char* scumble_version(void) {
  return SCUMBLE_VERSION_STRING;
}

scumble_scene* scumble_scene_load(const char* path) {
  return guarded([&]() -> scumble_scene* {
    Result<Scene> scene = Scene::load(textOf(path));
    if (!scene) return nothing(scene.error());
    return new scumble_scene{std::move(scene).value()};
  });
}

scumble_scene* scumble_scene_from_memory(const void* bytes, size_t size, const char* name,
                                         const char* folder) {
  return guarded([&]() -> scumble_scene* {
    if (!bytes && size > 0) return misuse("the bytes are null"), nullptr;
    Result<Scene> scene = Scene::loadFromMemory(bytes, size, textOf(name), textOf(folder));
    if (!scene) return nothing(scene.error());
    return new scumble_scene{std::move(scene).value()};
  });
}

void scumble_scene_free(scumble_scene* scene) {
  delete scene;
}

scumble_look* scumble_look_create(void) {
  return guarded([]() -> scumble_look* { return new scumble_look; });
}

scumble_look* scumble_look_load(const char* name_or_file) {
  return guarded([&]() -> scumble_look* {
    Result<Look> look = Look::load(textOf(name_or_file));
    if (!look) return nothing(look.error());
    return new scumble_look{std::move(look).value()};
  });
}

scumble_look* scumble_look_from_json(const char* text, const char* name) {
  return guarded([&]() -> scumble_look* {
    Result<Look> look = Look::fromJson(textOf(text), textOf(name));
    if (!look) return nothing(look.error());
    return new scumble_look{std::move(look).value()};
  });
}

scumble_status scumble_look_set(scumble_look* look, const char* path, const char* value) {
  return guarded([&] {
    if (!look || !path || !value) return misuse("look, path or value are null");
    const Status status = look->look.set(path, value);
    return status ? SCUMBLE_OK : fail(status.error());
  });
}

void scumble_look_free(scumble_look* look) {
  delete look;
}

void scumble_viewpoint_default(scumble_viewpoint* viewpoint) {
  if (viewpoint) *viewpoint = {};
}

scumble_status scumble_make_views(const scumble_scene* scene, const scumble_look* look,
                                  const scumble_viewpoint* viewpoint, float aspect, int32_t stereo, float ipd,
                                  double time, scumble_view* views, size_t* count) {
  return guarded([&] {
    if (!scene || !look || !viewpoint || !views || !count)
      return misuse("scene, look, viewpoint, views or count are null");
    Viewpoint from;
    from.camera = textOf(viewpoint->camera);
    from.orbit = viewpoint->has_orbit != 0;
    from.azimuth = viewpoint->azimuth, from.elevation = viewpoint->elevation;
    if (viewpoint->distance != 0) from.distance = viewpoint->distance;
    if (viewpoint->has_eye) {
      const float *eye = viewpoint->eye, *target = viewpoint->target;
      from.eye = glm::vec3(eye[0], eye[1], eye[2]);
      from.target = glm::vec3(target[0], target[1], target[2]);
    }
    if (viewpoint->vertical_fov != 0) from.verticalFov = viewpoint->vertical_fov;
    const Result<std::vector<View>> made =
        makeViews(scene->scene, from, aspect, stereo ? Stereo::stereo : Stereo::mono, ipd, look->look, time);
    if (!made) return fail(made.error());
    for (size_t i = 0; i < made->size(); ++i) views[i] = toView((*made)[i]);
    *count = made->size();
    return SCUMBLE_OK;
  });
}

scumble_renderer* scumble_renderer_create(const char* device, const char* cache_folder, int32_t validation) {
  return guarded([&]() -> scumble_renderer* {
    RendererOptions options;
    options.device = textOf(device);
    options.cacheFolder = textOf(cache_folder);
    options.validation = validation != 0;
    Result<std::unique_ptr<Renderer>> made = Renderer::create(options);
    if (!made) return nothing(made.error());
    auto handle = std::make_unique<scumble_renderer>();
    handle->renderer = std::move(made).value();
    handle->device = handle->renderer->gpu().name;
    return handle.release();
  });
}

void scumble_renderer_free(scumble_renderer* renderer) {
  delete renderer;
}

const char* scumble_renderer_device(const scumble_renderer* renderer) {
  return renderer ? renderer->device.c_str() : nullptr;
}

int32_t scumble_renderer_messages(const scumble_renderer* renderer) {
  return renderer ? renderer->renderer->validationMessages() : 0;
}

void scumble_options_default(scumble_options* options) {
  if (!options) return;
  const RenderOptions defaults;
  *options = {};
  options->width = defaults.width, options->height = defaults.height;
  options->samples = defaults.samples;
}

scumble_frame* scumble_render(scumble_renderer* renderer, const scumble_scene* scene,
                              const scumble_look* look, double time, const scumble_view* views,
                              size_t view_count, const scumble_options* options) {
  return guarded([&]() -> scumble_frame* {
    const Result<Call> call = callOf(renderer, scene, look, views, view_count, options);
    if (!call) return nothing(call.error());
    Result<Frame> frame =
        renderer->renderer->render(scene->scene, look->look, time, call->views, call->options);
    if (!frame) return nothing(frame.error());
    return new scumble_frame{std::move(frame).value()};
  });
}

scumble_status scumble_prepare(scumble_renderer* renderer, const scumble_scene* scene,
                               const scumble_look* look, const scumble_view* views, size_t view_count,
                               const scumble_options* options) {
  return guarded([&] {
    const Result<Call> call = callOf(renderer, scene, look, views, view_count, options);
    if (!call) return fail(call.error());
    const Status status = renderer->renderer->prepare(scene->scene, look->look, call->views, call->options);
    return status ? SCUMBLE_OK : fail(status.error());
  });
}

size_t scumble_frame_layers(const scumble_frame* frame) {
  return frame ? frame->frame.layers.size() : 0;
}

const char* scumble_frame_layer_name(const scumble_frame* frame, size_t layer) {
  return layer < scumble_frame_layers(frame) ? frame->frame.layers[layer].name.c_str() : nullptr;
}

size_t scumble_frame_views(const scumble_frame* frame, size_t layer) {
  return layer < scumble_frame_layers(frame) ? frame->frame.layers[layer].views.size() : 0;
}

scumble_status scumble_frame_image(const scumble_frame* frame, size_t layer, size_t view,
                                   scumble_image* image) {
  return guarded([&] {
    const Image* const found = imageOf(frame, layer, view);
    if (!found || !image) return misuse("the frame has no such layer or view");
    *image = {found->width,
              found->height,
              uint32_t(found->channels.size()),
              scumble_format(found->format),
              nullptr,
              0};
    const auto point = [&](const auto& numbers) {
      image->data = numbers.data();
      image->bytes = numbers.size() * sizeof(numbers[0]);
    };
    if (found->format == PixelFormat::float32) point(found->pixels);
    if (found->format == PixelFormat::half) point(found->halves);
    if (found->format == PixelFormat::srgb8) point(found->codes);
    return SCUMBLE_OK;
  });
}

void scumble_frame_free(scumble_frame* frame) {
  delete frame;
}

scumble_status scumble_frame_write(const scumble_frame* frame, size_t layer, size_t view, const char* path) {
  return guarded([&] {
    const Image* const image = imageOf(frame, layer, view);
    if (!image || !path) return misuse("the frame has no such layer or view, or the path is null");
    const std::string file = path;
    const auto outcome = [&](const Status& status) { return status ? SCUMBLE_OK : fail(status.error()); };
    if (endsWith(file, ".png")) return outcome(writePng(file, *image));
    if (endsWith(file, ".jpg")) return outcome(writeJpeg(file, *image));
    if (endsWith(file, ".webp")) return outcome(writeWebp(file, *image));
    if (endsWith(file, ".exr")) return outcome(writeExr(file, {{"", "", image}}));
    return misuse("'" + file + "' ends in none of .png, .jpg, .webp and .exr");
  });
}

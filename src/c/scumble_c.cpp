// The C face: handles around what the C++ headers have. No exception passes.
#include <algorithm>
#include <cstring>
#include <exception>
#include <glm/gtc/type_ptr.hpp>
#include <new>

#include "scumble/check.h"
#include "scumble/image.h"
#include "scumble/panorama.h"
#include "scumble/renderer.h"
#include "scumble/scene_editor.h"
#include "scumble/scumble.h"

using namespace scumble;

struct scumble_scene {
  Scene scene;
};
struct scumble_editor {
  SceneEditor editor;
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
thread_local scumble_status lastStatus = SCUMBLE_OK;

scumble_status fail(const Error& error) {
  lastError = error.message();
  return lastStatus = scumble_status(int(error.kind) + 1);
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

Progress toProgress(scumble_progress progress, void* user) {
  if (!progress) return {};
  return [=](double part) { return progress(user, part) != 0; };
}

scumble_status statusOf(const Status& status) {
  return status ? SCUMBLE_OK : fail(status.error());
}

template <class Id>
int32_t idOf(const Result<Id>& result) {
  if (result) return int32_t(*result);
  fail(result.error());
  return -1;
}

// What is added, or set where there is an id.
template <class Id>
int32_t idOf(Id id, const Status& status) {
  if (status) return int32_t(id);
  fail(status.error());
  return -1;
}

// As guarded(), for calls that give ids.
template <class Call>
int32_t guardedId(Call call) {
  int32_t id = -1;
  guarded([&] {
    id = call();
    return SCUMBLE_OK;
  });
  return id;
}

// An array of vectors, given by their numbers; null: none.
template <class Vector>
std::span<const Vector> listOf(const void* numbers, size_t count) {
  return {static_cast<const Vector*>(numbers), numbers ? count : 0};
}

glm::mat4 toMatrix(const float* numbers) {
  return glm::make_mat4(numbers);
}

// Option structs begin with their size as the caller was compiled with it, which may be another one than
// ours: no more of them is read or filled than both know.
constexpr size_t kLargestOptions = 4096;
template <class Options>
bool hasSize(const Options* options) {
  return options && options->size >= 2 * sizeof(size_t) && options->size <= kLargestOptions;
}
constexpr const char* kNoSize = "options are null, or their size is not set";

template <class Options>
scumble_status fill(Options* options, Options defaults) {
  if (!hasSize(options)) return misuse(kNoSize);
  const size_t size = options->size;
  defaults.size = size;
  std::memset(static_cast<void*>(options), 0, size);
  std::memcpy(static_cast<void*>(options), &defaults, std::min(size, sizeof(Options)));
  return SCUMBLE_OK;
}
// What is not there is as in `defaults`. Of a size that hasSize().
template <class Options>
Options taken(const Options* options, Options defaults) {
  std::memcpy(static_cast<void*>(&defaults), options, std::min(options->size, sizeof(Options)));
  return defaults;
}

scumble_material defaultMaterial() {
  scumble_material material{};
  for (float& channel : material.base_color) channel = 1;
  material.base_color_texture = material.emissive_texture = -1;
  material.alpha_cutoff = MaterialDesc().alphaCutoff;
  return material;
}
scumble_options defaultOptions() {
  const RenderOptions usual;
  scumble_options options{};
  options.width = usual.width, options.height = usual.height;
  options.samples = usual.samples;
  return options;
}
scumble_panorama defaultPanorama() {
  const Panorama usual;
  return {sizeof(scumble_panorama), scumble_panorama_kind(usual.kind), usual.ipd, usual.knobHeight,
          usual.strip};
}

View toView(const scumble_view& view) {
  View result;
  std::memcpy(&result.worldToEye, view.world_to_eye, sizeof(view.world_to_eye));
  std::memcpy(&result.eyeToClip, view.eye_to_clip, sizeof(view.eye_to_clip));
  result.node = view.node;
  result.size = {view.width, view.height};
  result.rig = view.rig;
  result.isLevel = view.is_level != 0;
  result.origin = glm::make_vec3(view.origin);
  return result;
}

scumble_view toView(const View& view) {
  scumble_view result{};
  std::memcpy(result.world_to_eye, &view.worldToEye, sizeof(result.world_to_eye));
  std::memcpy(result.eye_to_clip, &view.eyeToClip, sizeof(result.eye_to_clip));
  result.node = view.node;
  result.width = view.size.x, result.height = view.size.y;
  result.rig = view.rig;
  result.is_level = view.isLevel;
  for (int axis = 0; axis < 3; ++axis) result.origin[axis] = view.origin[axis];
  return result;
}

// What render and prepare are given. Fails with usage for null where something must be.
struct Call {
  std::vector<View> views;
  RenderOptions options;
};
Result<Call> callOf(const scumble_renderer* renderer, const scumble_scene* scene, const scumble_look* look,
                    const scumble_view* views, size_t count, const scumble_options* given) {
  const Error null{ErrorKind::usage,
                   "",
                   0,
                   "",
                   "renderer, scene, look, views or options are null, or the options' size is not set",
                   "see scumble.h"};
  if (!renderer || !scene || !look || !views || !hasSize(given)) return null;
  const scumble_options all = taken(given, defaultOptions()), *const options = &all;
  if (options->aov_count > 0 && !options->aovs) return null;
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
  call.options.progress = toProgress(options->progress, options->progress_user);
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

scumble_status scumble_error_status(void) {
  return lastStatus;
}

const char* scumble_version(void) {
  return SCUMBLE_VERSION_STRING;
}

scumble_scene* scumble_scene_load(const char* path, scumble_progress progress, void* user) {
  return guarded([&]() -> scumble_scene* {
    SceneOptions options;
    options.progress = toProgress(progress, user);
    Result<Scene> scene = Scene::load(textOf(path), options);
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

// -- Editors

scumble_editor* scumble_editor_create(const scumble_scene* scene) {
  return guarded([&]() -> scumble_editor* {
    return new scumble_editor{scene ? SceneEditor(scene->scene) : SceneEditor()};
  });
}

void scumble_editor_free(scumble_editor* editor) {
  delete editor;
}

scumble_scene* scumble_editor_scene(scumble_editor* editor) {
  return guarded([&]() -> scumble_scene* {
    if (!editor) return misuse("the editor is null"), nullptr;
    Result<Scene> scene = editor->editor.scene();
    if (!scene) return nothing(scene.error());
    return new scumble_scene{std::move(scene).value()};
  });
}

int32_t scumble_editor_texture(scumble_editor* editor, int32_t id, const char* name, uint32_t width,
                               uint32_t height, const uint8_t* rgba) {
  return guardedId([&]() -> int32_t {
    if (!editor || !rgba) return misuse("editor or pixels are null"), -1;
    // Sizes out of range are refused before a byte is read.
    const TextureDesc texture{textOf(name), width, height, {rgba, size_t(4) * width * height}};
    if (id < 0) return idOf(editor->editor.addTexture(texture));
    return idOf(TextureId(id), editor->editor.setTexture(TextureId(id), texture));
  });
}

scumble_status scumble_material_default(scumble_material* material) {
  return fill(material, defaultMaterial());
}

int32_t scumble_editor_material(scumble_editor* editor, int32_t id, const scumble_material* given) {
  return guardedId([&]() -> int32_t {
    if (!editor || !hasSize(given)) return misuse("editor or material are null, or its size is not set"), -1;
    const scumble_material all = taken(given, defaultMaterial()), *const material = &all;
    if (material->alpha < 0 || material->alpha > 2) return misuse("the alpha mode is none of 0, 1 and 2"), -1;
    const auto three = [](const float* numbers) { return glm::vec3(numbers[0], numbers[1], numbers[2]); };
    MaterialDesc desc;
    desc.name = textOf(material->name);
    desc.baseColor = glm::vec4(three(material->base_color), material->base_color[3]);
    desc.baseColorTexture.texture = TextureId(material->base_color_texture);
    desc.emissive = three(material->emissive);
    desc.emissiveTexture.texture = TextureId(material->emissive_texture);
    desc.alpha = MaterialDesc::Alpha(material->alpha);
    desc.alphaCutoff = material->alpha_cutoff;
    desc.doubleSided = material->double_sided != 0;
    desc.unlit = material->unlit != 0;
    if (material->has_shadowed_color) desc.shadowedColor = three(material->shadowed_color);
    if (id < 0) return idOf(editor->editor.addMaterial(desc));
    return idOf(MaterialId(id), editor->editor.setMaterial(MaterialId(id), desc));
  });
}

int32_t scumble_editor_find_material(const scumble_editor* editor, const char* name) {
  return guardedId([&]() -> int32_t {
    if (!editor) return -1;
    const std::optional<MaterialId> found = editor->editor.findMaterial(textOf(name));
    return found ? int32_t(*found) : -1;
  });
}

int32_t scumble_editor_mesh(scumble_editor* editor, int32_t id, const scumble_mesh_part* parts,
                            size_t part_count) {
  return guardedId([&]() -> int32_t {
    if (!editor || (!parts && part_count > 0)) return misuse("editor or parts are null"), -1;
    std::vector<MeshPart> mesh;
    for (size_t i = 0; i < part_count; ++i) {
      const scumble_mesh_part& given = parts[i];
      if ((!given.positions && given.vertex_count > 0) || (!given.indices && given.index_count > 0))
        return misuse("positions or indices are null"), -1;
      const size_t count = given.vertex_count;
      MeshPart part;
      part.positions = listOf<glm::vec3>(given.positions, count);
      part.indices = {given.indices, given.index_count};
      part.normals = listOf<glm::vec3>(given.normals, count);
      part.uv0 = listOf<glm::vec2>(given.uv0, count);
      part.uv1 = listOf<glm::vec2>(given.uv1, count);
      part.colors = listOf<glm::u8vec4>(given.colors, count);
      part.material = MaterialId(given.material);
      mesh.push_back(part);
    }
    if (id < 0) return idOf(editor->editor.addMesh(mesh));
    return idOf(MeshId(id), editor->editor.setMesh(MeshId(id), mesh));
  });
}

int32_t scumble_editor_add_node(scumble_editor* editor, const char* name, int32_t parent,
                                const float transform[16], int32_t mesh) {
  return guardedId([&]() -> int32_t {
    if (!editor || !transform) return misuse("editor or transform are null"), -1;
    return idOf(editor->editor.addNode({textOf(name), NodeId(parent), toMatrix(transform), MeshId(mesh)}));
  });
}

int32_t scumble_editor_find_node(const scumble_editor* editor, const char* name) {
  return guardedId([&]() -> int32_t { return editor ? int32_t(editor->editor.findNode(textOf(name))) : -1; });
}

scumble_status scumble_editor_set_transform(scumble_editor* editor, int32_t node, const float transform[16]) {
  return guarded([&] {
    if (!editor || !transform) return misuse("editor or transform are null");
    return statusOf(editor->editor.setTransform(NodeId(node), toMatrix(transform)));
  });
}

scumble_status scumble_editor_set_visible(scumble_editor* editor, int32_t node, int32_t visible) {
  return guarded([&] {
    if (!editor) return misuse("the editor is null");
    return statusOf(editor->editor.setVisible(NodeId(node), visible != 0));
  });
}

scumble_status scumble_editor_set_instances(scumble_editor* editor, int32_t node, const float* transforms,
                                            size_t count) {
  return guarded([&] {
    if (!editor || (!transforms && count > 0)) return misuse("editor or transforms are null");
    std::vector<glm::mat4> matrices;
    for (size_t i = 0; i < count; ++i) matrices.push_back(toMatrix(transforms + 16 * i));
    return statusOf(editor->editor.setInstances(NodeId(node), matrices));
  });
}

// -- Looks

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
    return statusOf(look->look.set(path, std::string(value)));
  });
}

scumble_status scumble_look_set_numbers(scumble_look* look, const char* path, const double* numbers,
                                        size_t count) {
  return guarded([&] {
    if (!look || !path || !numbers) return misuse("look, path or numbers are null");
    if (count != 1 && count != 3) return misuse("there are neither one number nor three");
    if (count == 3) return statusOf(look->look.set(path, glm::vec3(numbers[0], numbers[1], numbers[2])));
    const Status asNumber = look->look.set(path, numbers[0]);
    const bool mayBeToggle = !asNumber && (numbers[0] == 0 || numbers[0] == 1);
    if (mayBeToggle && look->look.set(path, numbers[0] == 1)) return SCUMBLE_OK;
    return statusOf(asNumber);
  });
}

scumble_status scumble_look_unset(scumble_look* look, const char* path) {
  return guarded([&] {
    if (!look || !path) return misuse("look or path are null");
    return statusOf(look->look.unset(path));
  });
}

scumble_status scumble_look_get(const scumble_look* look, const char* path, double time,
                                scumble_value* value) {
  return guarded([&] {
    if (!look || !path || !value) return misuse("look, path or value are null");
    static thread_local std::string text;
    const Result<KnobValue> got = look->look.get(path, time);
    if (!got) return fail(got.error());
    *value = {};
    if (const auto* const three = std::get_if<glm::vec3>(&*got)) {
      value->count = 3;
      for (int c = 0; c < 3; ++c) value->numbers[c] = double((*three)[c]);
    } else if (const auto* const word = std::get_if<std::string>(&*got)) {
      text = *word;
      value->text = text.c_str();
    } else {
      value->count = 1;
      value->numbers[0] = std::holds_alternative<bool>(*got)  ? double(std::get<bool>(*got))
                          : std::holds_alternative<int>(*got) ? double(std::get<int>(*got))
                                                              : std::get<double>(*got);
    }
    return SCUMBLE_OK;
  });
}

scumble_status scumble_check(const scumble_scene* scene, const scumble_look* look, int32_t is_for_scene,
                             scumble_finding finding, void* user) {
  return guarded([&] {
    if (!scene || !look || !finding) return misuse("scene, look or finding are null");
    for (const Finding& one : check(scene->scene, look->look, is_for_scene != 0))
      finding(user, one.setting.c_str(), one.problem.c_str());
    return SCUMBLE_OK;
  });
}

void scumble_look_free(scumble_look* look) {
  delete look;
}

scumble_status scumble_viewpoint_default(scumble_viewpoint* viewpoint) {
  return fill(viewpoint, scumble_viewpoint{});
}

scumble_status scumble_make_views(const scumble_scene* scene, const scumble_look* look,
                                  const scumble_viewpoint* given, float aspect, int32_t stereo, float ipd,
                                  double time, scumble_view* views, size_t* count) {
  return guarded([&] {
    if (!scene || !look || !hasSize(given) || !views || !count)
      return misuse("scene, look, viewpoint, views or count are null, or the viewpoint's size is not set");
    const scumble_viewpoint all = taken(given, scumble_viewpoint{}), *const viewpoint = &all;
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

scumble_status scumble_renderer_options_default(scumble_renderer_options* options) {
  return fill(options, scumble_renderer_options{});
}

scumble_renderer* scumble_renderer_create(const scumble_renderer_options* caller) {
  return guarded([&]() -> scumble_renderer* {
    RendererOptions options;
    if (caller) {
      if (!hasSize(caller)) return misuse(kNoSize), nullptr;
      const scumble_renderer_options all = taken(caller, scumble_renderer_options{}), *const given = &all;
      options.device = textOf(given->device);
      options.cacheFolder = textOf(given->cache_folder);
      options.validation = given->validation != 0;
      if (given->log)
        options.log = [log = given->log, user = given->log_user](LogLevel level, const std::string& text) {
          log(user, int32_t(level), text.c_str());
        };
    }
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

scumble_status scumble_options_default(scumble_options* options) {
  return fill(options, defaultOptions());
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
    return statusOf(renderer->renderer->prepare(scene->scene, look->look, call->views, call->options));
  });
}

scumble_status scumble_panorama_default(scumble_panorama* panorama) {
  return fill(panorama, defaultPanorama());
}

scumble_frame* scumble_render_panorama(scumble_renderer* renderer, const scumble_scene* scene,
                                       const scumble_look* look, double time, const scumble_view* from,
                                       const scumble_panorama* given, const scumble_options* options) {
  return guarded([&]() -> scumble_frame* {
    const Result<Call> call = callOf(renderer, scene, look, from, 1, options);
    if (!call) return nothing(call.error());
    if (!hasSize(given)) return misuse("the panorama is null, or its size is not set"), nullptr;
    const scumble_panorama all = taken(given, defaultPanorama()), *const panorama = &all;
    if (panorama->kind < SCUMBLE_VR180 || panorama->kind > SCUMBLE_MONO360)
      return misuse("the panorama is of no kind"), nullptr;
    const Panorama wanted{PanoramaKind(panorama->kind), panorama->ipd, panorama->knob_height,
                          panorama->strip};
    Result<Frame> frame = renderPanorama(*renderer->renderer, scene->scene, look->look, time,
                                         call->views.front(), wanted, call->options);
    if (!frame) return nothing(frame.error());
    return new scumble_frame{std::move(frame).value()};
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
    if (endsWith(file, ".png")) return statusOf(writePng(file, *image));
    if (endsWith(file, ".jpg")) return statusOf(writeJpeg(file, *image));
    if (endsWith(file, ".webp")) return statusOf(writeWebp(file, *image));
    if (endsWith(file, ".exr")) return statusOf(writeExr(file, {{"", "", image}}));
    return misuse("'" + file + "' ends in none of .png, .jpg, .webp and .exr");
  });
}

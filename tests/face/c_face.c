/* c_face SCENE OUTPUT.png: draws a frame of two views through the C face, checks what comes back, and writes
   the left one. Exit code 1, with a line, where something is wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scumble/scumble.h"

#define CHECK(condition)                                                                \
  do {                                                                                  \
    if (!(condition)) {                                                                 \
      fprintf(stderr, "c_face.c:%d: %s (%s)\n", __LINE__, #condition, scumble_error()); \
      return 1;                                                                         \
    }                                                                                   \
  } while (0)

static int32_t stop_at_once(void* user, double part) {
  ++*(int*)user;
  return part > 2;
}
static void count_finding(void* user, const char* setting, const char* problem) {
  *(int*)user += strcmp(setting, "materials.Nobody") == 0 && strlen(problem) > 0;
}
static void count_message(void* user, int32_t level, const char* text) {
  *(int*)user += level == 0 && strlen(text) > 0;
}

/* As callers have them that were compiled against a header with fewer members, or with more. */
typedef struct old_options {
  size_t size;
  uint32_t width, height, samples, seed;
} old_options;
typedef struct new_options {
  scumble_options known;
  uint64_t later[4];
} new_options;
static int old_callers(scumble_renderer* renderer, const scumble_scene* scene, const scumble_look* look,
                       const scumble_view* views) {
  struct {
    old_options options;
    unsigned char beyond[256];
  } old;
  memset(&old, 0xAB, sizeof old);
  old.options.size = sizeof old.options;
  if (scumble_options_default((scumble_options*)&old.options) != SCUMBLE_OK) return 0;
  for (size_t i = 0; i < sizeof old.beyond; ++i)
    if (old.beyond[i] != 0xAB) return 0;
  if (old.options.size != sizeof old.options || old.options.width != 1280 || old.options.samples != 4) return 0;
  old.options.width = 32, old.options.height = 18, old.options.samples = 1;
  /* What lies beyond would be a progress callback and names of AOVs. */
  scumble_frame* frame = scumble_render(renderer, scene, look, 0, views, 1, (const scumble_options*)&old.options);
  scumble_image picture;
  if (!frame || scumble_frame_layers(frame) != 1 ||
      scumble_frame_image(frame, 0, 0, &picture) != SCUMBLE_OK || picture.width != 32)
    return 0;
  scumble_frame_free(frame);
  new_options newer;
  memset(&newer, 0xAB, sizeof newer);
  newer.known.size = sizeof newer;
  if (scumble_options_default(&newer.known) != SCUMBLE_OK || newer.known.size != sizeof newer ||
      newer.known.width != 1280 || newer.later[0] != 0 || newer.later[3] != 0)
    return 0;
  scumble_options unset;
  memset(&unset, 0, sizeof unset);
  scumble_viewpoint huge;
  huge.size = (size_t)-1;
  return scumble_options_default(&unset) == SCUMBLE_USAGE && scumble_viewpoint_default(&huge) == SCUMBLE_USAGE &&
         scumble_panorama_default(NULL) == SCUMBLE_USAGE &&
         scumble_render(renderer, scene, look, 0, views, 1, &unset) == NULL;
}

/* A tower of two boxes, made by hand; its upper one is moved, and hidden. */
static int edit(void) {
  const float corners[] = {-1, 0, 0, 1, 0, 0, 0, 2, 0};
  const uint32_t indices[] = {0, 1, 2};
  const uint8_t pixel[] = {200, 40, 30, 255};
  float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  scumble_editor* editor = scumble_editor_create(NULL);
  CHECK(editor != NULL);
  scumble_material material = {sizeof material};
  CHECK(scumble_material_default(&material) == SCUMBLE_OK);
  material.name = "Red";
  material.base_color_texture = scumble_editor_texture(editor, -1, "red", 1, 1, pixel);
  CHECK(material.base_color_texture == 0);
  CHECK(scumble_editor_texture(editor, 0, "red", 1, 1, pixel) == 0);
  CHECK(scumble_editor_texture(editor, -1, "red", 0, 1, pixel) == -1);
  const int32_t red = scumble_editor_material(editor, -1, &material);
  CHECK(red == 1 && scumble_editor_find_material(editor, "Red") == 1);
  CHECK(scumble_editor_find_material(editor, "Blue") == -1);
  CHECK(scumble_editor_material(editor, red, &material) == red);
  CHECK(scumble_editor_material(editor, 7, &material) == -1);
  scumble_mesh_part part = {0};
  CHECK(scumble_editor_mesh(editor, -1, &part, 1) == -1);
  part.vertex_count = part.index_count = 3;
  CHECK(scumble_editor_mesh(editor, -1, &part, 1) == -1);
  part.positions = corners, part.indices = indices, part.material = red;
  const int32_t mesh = scumble_editor_mesh(editor, -1, &part, 1);
  CHECK(mesh == 0 && scumble_editor_mesh(editor, mesh, &part, 1) == mesh);
  const int32_t lower = scumble_editor_add_node(editor, "Lower", -1, matrix, mesh);
  matrix[13] = 2;
  CHECK(scumble_editor_add_node(editor, "Upper", lower, matrix, mesh) == 1);
  CHECK(scumble_editor_find_node(editor, "Lower/Upper") == 1);
  CHECK(scumble_editor_add_node(editor, "Lost", 5, matrix, mesh) == -1);
  CHECK(scumble_editor_set_transform(editor, 1, matrix) == SCUMBLE_OK);
  CHECK(scumble_editor_set_transform(editor, 2, matrix) == SCUMBLE_USAGE);
  CHECK(scumble_editor_set_instances(editor, 1, matrix, 1) == SCUMBLE_OK);
  CHECK(scumble_editor_set_visible(editor, 1, 0) == SCUMBLE_OK);
  scumble_scene* scene = scumble_editor_scene(editor);
  CHECK(scene != NULL);
  scumble_editor* again = scumble_editor_create(scene);
  CHECK(scumble_editor_find_node(again, "Upper") == 1);
  scumble_editor_free(again), scumble_editor_free(editor), scumble_editor_free(NULL),
      scumble_scene_free(scene);
  return 0;
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  CHECK(strcmp(scumble_version(), SCUMBLE_VERSION_STRING) == 0);
  CHECK(strcmp(scumble_error(), "") == 0);

  /* Errors are values with a text. */
  CHECK(scumble_scene_load("no/such.glb", NULL, NULL) == NULL);
  CHECK(strstr(scumble_error(), "no/such.glb") != NULL);
  CHECK(scumble_scene_load(NULL, NULL, NULL) == NULL);
  CHECK(scumble_scene_from_memory("{", 1, "mine.gltf", NULL) == NULL);
  CHECK(strstr(scumble_error(), "mine.gltf") != NULL);
  CHECK(scumble_look_load("no-such-look") == NULL);
  scumble_scene_free(NULL), scumble_look_free(NULL), scumble_frame_free(NULL), scumble_renderer_free(NULL);

  int calls = 0;
  CHECK(scumble_scene_load(argv[1], stop_at_once, &calls) == NULL && calls == 1);
  CHECK(strstr(scumble_error(), "cancelled") != NULL && scumble_error_status() == SCUMBLE_CANCELLED);
  if (edit() != 0) return 1;
  scumble_scene* scene = scumble_scene_load(argv[1], NULL, NULL);
  CHECK(scene != NULL);
  scumble_look* look = scumble_look_create();
  CHECK(look != NULL);
  CHECK(scumble_look_set(look, "shadow.threshold", "0.45") == SCUMBLE_OK);
  CHECK(scumble_look_set(look, "shadow.treshold", "0.45") == SCUMBLE_USAGE);
  CHECK(strstr(scumble_error(), "threshold") != NULL);
  CHECK(scumble_look_set(look, NULL, "1") == SCUMBLE_USAGE);
  scumble_value value;
  CHECK(scumble_look_get(look, "shadow.threshold", 0, &value) == SCUMBLE_OK);
  CHECK(value.count == 1 && value.numbers[0] == 0.45 && value.text == NULL);
  const double number = 0.7, color[] = {0.25, 0.5, 1}, yes = 1;
  CHECK(scumble_look_set_numbers(look, "shadow.threshold", &number, 1) == SCUMBLE_OK);
  CHECK(scumble_look_get(look, "shadow.threshold", 0, &value) == SCUMBLE_OK && value.numbers[0] == 0.7);
  CHECK(scumble_look_unset(look, "shadow.threshold") == SCUMBLE_OK);
  CHECK(scumble_look_get(look, "shadow.threshold", 0, &value) == SCUMBLE_OK && value.numbers[0] != 0.7);
  CHECK(scumble_look_set_numbers(look, "ground.tint", color, 3) == SCUMBLE_OK);
  CHECK(scumble_look_get(look, "ground.tint", 0, &value) == SCUMBLE_OK);
  CHECK(value.count == 3 && value.numbers[0] == 0.25 && value.numbers[2] == 1);
  CHECK(scumble_look_unset(look, "ground.tint") == SCUMBLE_OK);
  CHECK(scumble_look_set_numbers(look, "shadow.threshold", color, 2) == SCUMBLE_USAGE);
  CHECK(scumble_look_set_numbers(look, "materials.Nobody.final.ripple", &yes, 1) == SCUMBLE_USAGE);
  CHECK(scumble_look_set_numbers(look, "materials.No*.shadowMap.cast", &yes, 1) == SCUMBLE_OK);
  CHECK(scumble_look_set_numbers(look, "materials.No*.shadowMap.cast", &number, 1) == SCUMBLE_USAGE);
  CHECK(scumble_look_unset(look, "materials.No*.shadowMap.cast") == SCUMBLE_OK);
  CHECK(scumble_look_get(look, "final.ripple", 0, &value) == SCUMBLE_OK && value.count == 0 && value.text);
  CHECK(scumble_look_set(look, "materials.Nobody.warp.amount", "2") == SCUMBLE_OK);
  int findings = 0;
  CHECK(scumble_check(scene, look, 0, count_finding, &findings) == SCUMBLE_OK && findings == 1);
  CHECK(scumble_look_unset(look, "materials.Nobody.warp.amount") == SCUMBLE_OK);
  CHECK(scumble_look_set(look, "shadow.threshold", "0.45") == SCUMBLE_OK);

  scumble_viewpoint viewpoint = {sizeof viewpoint};
  CHECK(scumble_viewpoint_default(&viewpoint) == SCUMBLE_OK);
  viewpoint.camera = "Hero";
  scumble_view views[2];
  size_t count = 0;
  CHECK(scumble_make_views(scene, look, &viewpoint, 96.0f / 54.0f, 1, 0.4f, 0.5, views, &count) ==
        SCUMBLE_OK);
  CHECK(count == 2);
  viewpoint.camera = "Nobody";
  CHECK(scumble_make_views(scene, look, &viewpoint, 1, 0, 0, 0, views, &count) == SCUMBLE_USAGE);

  int messages = 0;
  scumble_renderer_options how = {sizeof how};
  CHECK(scumble_renderer_options_default(&how) == SCUMBLE_OK);
  how.validation = 1, how.log = count_message, how.log_user = &messages;
  scumble_renderer* renderer = scumble_renderer_create(&how);
  CHECK(renderer != NULL && messages == 1);
  CHECK(strlen(scumble_renderer_device(renderer)) > 0);
  scumble_options options = {sizeof options};
  CHECK(scumble_options_default(&options) == SCUMBLE_OK);
  CHECK(options.width == 1280 && options.samples == 4);
  CHECK(old_callers(renderer, scene, look, views));
  options.width = 96, options.height = 54, options.format = SCUMBLE_SRGB8;
  const char* aovs[] = {"depth", "shadow-map"};
  options.aovs = aovs, options.aov_count = 2;
  CHECK(scumble_prepare(renderer, scene, look, views, 2, &options) == SCUMBLE_OK);
  calls = 0;
  options.progress = stop_at_once, options.progress_user = &calls;
  CHECK(scumble_render(renderer, scene, look, 0.5, views, 2, &options) == NULL && calls == 1);
  CHECK(scumble_prepare(renderer, scene, look, views, 2, &options) == SCUMBLE_CANCELLED);
  options.progress = NULL;
  scumble_frame* frame = scumble_render(renderer, scene, look, 0.5, views, 2, &options);
  CHECK(frame != NULL);
  CHECK(scumble_frame_layers(frame) == 3);
  CHECK(strcmp(scumble_frame_layer_name(frame, 0), "") == 0);
  CHECK(strcmp(scumble_frame_layer_name(frame, 2), "shadow-map") == 0);
  CHECK(scumble_frame_layer_name(frame, 3) == NULL);
  CHECK(scumble_frame_views(frame, 1) == 2 && scumble_frame_views(frame, 2) == 1);

  scumble_image picture, depth;
  CHECK(scumble_frame_image(frame, 0, 1, &picture) == SCUMBLE_OK);
  CHECK(picture.width == 96 && picture.height == 54 && picture.channels == 4);
  CHECK(picture.format == SCUMBLE_SRGB8 && picture.bytes == 96 * 54 * 4);
  const unsigned char* codes = (const unsigned char*)picture.data;
  int least = 255, most = 0;
  for (size_t i = 0; i < picture.bytes; ++i) {
    if (i % 4 == 3) CHECK(codes[i] == 255);
    if (codes[i] < least) least = codes[i];
    if (i % 4 != 3 && codes[i] > most) most = codes[i];
  }
  CHECK(most - least > 80);
  CHECK(scumble_frame_image(frame, 1, 0, &depth) == SCUMBLE_OK);
  CHECK(depth.format == SCUMBLE_FLOAT32 && depth.channels == 1 && depth.bytes == 96 * 54 * sizeof(float));
  int there = 0;
  for (size_t i = 0; i < 96 * 54; ++i) there += isfinite(((const float*)depth.data)[i]) != 0;
  CHECK(there > 500);
  CHECK(scumble_frame_image(frame, 0, 2, &picture) == SCUMBLE_USAGE);
  CHECK(scumble_frame_write(frame, 0, 0, argv[2]) == SCUMBLE_OK);
  CHECK(scumble_frame_write(frame, 0, 0, "x.bmp") == SCUMBLE_USAGE);
  CHECK(scumble_frame_write(frame, 0, 0, "no/such/folder/x.png") == SCUMBLE_OUTPUT_NOT_WRITTEN);
  scumble_frame_free(frame);

  aovs[0] = "dept";
  CHECK(scumble_render(renderer, scene, look, 0, views, 2, &options) == NULL);
  CHECK(strstr(scumble_error(), "depth") != NULL);
  CHECK(scumble_render(renderer, scene, look, 0, views, 7, &options) == NULL);
  CHECK(scumble_render(renderer, NULL, look, 0, views, 2, &options) == NULL);

  scumble_panorama around = {sizeof around};
  CHECK(scumble_panorama_default(&around) == SCUMBLE_OK);
  CHECK(around.kind == SCUMBLE_VR180 && around.ipd > 0.06f && around.ipd < 0.07f);
  around.kind = SCUMBLE_MONO360;
  options.width = 64, options.height = 32, options.samples = 1;
  aovs[0] = "depth";
  frame = scumble_render_panorama(renderer, scene, look, 0, views, &around, &options);
  CHECK(frame != NULL);
  CHECK(scumble_frame_views(frame, 0) == 1 && scumble_frame_views(frame, 1) == 1);
  CHECK(scumble_frame_image(frame, 0, 0, &picture) == SCUMBLE_OK);
  CHECK(picture.width == 64 && picture.height == 32 && picture.format == SCUMBLE_SRGB8);
  scumble_frame_free(frame);
  around.kind = SCUMBLE_VR180;
  CHECK(scumble_render_panorama(renderer, scene, look, 0, views, &around, &options) == NULL);
  CHECK(strstr(scumble_error(), "aspect") != NULL);
  CHECK(scumble_render_panorama(renderer, scene, look, 0, views, NULL, &options) == NULL);
  CHECK(scumble_renderer_messages(renderer) == 0);
  /* In any order: what a renderer needs of a scene it keeps. */
  scumble_scene_free(scene);
  scumble_renderer_free(renderer);
  scumble_look_free(look);
  return 0;
}

/* c_face SCENE OUTPUT.png: draws a frame of two views through the C face, checks what comes back, and writes the
   left one. Exit code 1, with a line, where something is wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scumble/scumble.h"

#define CHECK(condition)                                                                          \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      fprintf(stderr, "c_face.c:%d: %s (%s)\n", __LINE__, #condition, scumble_error());           \
      return 1;                                                                                   \
    }                                                                                             \
  } while (0)

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  CHECK(strcmp(scumble_version(), SCUMBLE_VERSION_STRING) == 0);
  CHECK(strcmp(scumble_error(), "") == 0);

  /* Errors are values with a text. */
  CHECK(scumble_scene_load("no/such.glb") == NULL);
  CHECK(strstr(scumble_error(), "no/such.glb") != NULL);
  CHECK(scumble_scene_load(NULL) == NULL);
  CHECK(scumble_scene_from_memory("{", 1, "mine.gltf", NULL) == NULL);
  CHECK(strstr(scumble_error(), "mine.gltf") != NULL);
  CHECK(scumble_look_load("no-such-look") == NULL);
  scumble_scene_free(NULL), scumble_look_free(NULL), scumble_frame_free(NULL), scumble_renderer_free(NULL);

  scumble_scene* scene = scumble_scene_load(argv[1]);
  CHECK(scene != NULL);
  scumble_look* look = scumble_look_create();
  CHECK(look != NULL);
  CHECK(scumble_look_set(look, "shadow.threshold", "0.45") == SCUMBLE_OK);
  CHECK(scumble_look_set(look, "shadow.treshold", "0.45") == SCUMBLE_USAGE);
  CHECK(strstr(scumble_error(), "threshold") != NULL);
  CHECK(scumble_look_set(look, NULL, "1") == SCUMBLE_USAGE);

  scumble_viewpoint viewpoint;
  scumble_viewpoint_default(&viewpoint);
  viewpoint.camera = "Hero";
  scumble_view views[2];
  size_t count = 0;
  CHECK(scumble_make_views(scene, look, &viewpoint, 96.0f / 54.0f, 1, 0.4f, 0.5, views, &count) == SCUMBLE_OK);
  CHECK(count == 2);
  viewpoint.camera = "Nobody";
  CHECK(scumble_make_views(scene, look, &viewpoint, 1, 0, 0, 0, views, &count) == SCUMBLE_USAGE);

  scumble_renderer* renderer = scumble_renderer_create(NULL, NULL, 1);
  CHECK(renderer != NULL);
  CHECK(strlen(scumble_renderer_device(renderer)) > 0);
  scumble_options options;
  scumble_options_default(&options);
  CHECK(options.width == 1280 && options.samples == 4);
  options.width = 96, options.height = 54, options.format = SCUMBLE_SRGB8;
  const char* aovs[] = {"depth", "shadow-map"};
  options.aovs = aovs, options.aov_count = 2;
  CHECK(scumble_prepare(renderer, scene, look, views, 2, &options) == SCUMBLE_OK);
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
  CHECK(scumble_renderer_messages(renderer) == 0);
  /* In any order: what a renderer needs of a scene it keeps. */
  scumble_scene_free(scene);
  scumble_renderer_free(renderer);
  scumble_look_free(look);
  return 0;
}

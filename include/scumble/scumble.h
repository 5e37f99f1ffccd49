/* scumble for C, and for every language that can call C: opaque handles, numbers and text. It does what the
   C++ headers beside it do, which say more about each part.

   A function that can fail gives null or a status that is not SCUMBLE_OK; scumble_error() then says why, in
   one line. Text is UTF-8. Nothing throws, and nothing here keeps a pointer that it was given beyond the
   call, but for a renderer's log.

   Threads: scenes and looks may be used from several threads at once as long as nobody changes them; a
   renderer from one thread at a time (another one meanwhile is refused with SCUMBLE_USAGE). Each handle is
   freed once, by its own function, which takes null and does nothing then. */
#ifndef SCUMBLE_H
#define SCUMBLE_H

#include <stddef.h>
#include <stdint.h>

#include "scumble/export.h"
#include "scumble/version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As ErrorKind of result.h. */
typedef enum scumble_status {
  SCUMBLE_OK = 0,
  SCUMBLE_INTERNAL = 1,
  SCUMBLE_USAGE = 2,
  SCUMBLE_UNUSABLE_FILE = 3,
  SCUMBLE_NO_USABLE_GPU = 4,
  SCUMBLE_OUTPUT_NOT_WRITTEN = 5,
  SCUMBLE_CANCELLED = 6
} scumble_status;

/* Why the last call of this thread that failed did so: "FILE:LINE (JSON path): what is wrong; what to do".
   Empty before the first one. Valid until the next call that fails on this thread. */
SCUMBLE_API const char* scumble_error(void);
/* What kind of failure that was, also of calls that give null; SCUMBLE_OK before the first one. */
SCUMBLE_API scumble_status scumble_error_status(void);
/* The library's own version, which may differ from SCUMBLE_VERSION_STRING: "0.1.0". */
SCUMBLE_API const char* scumble_version(void);

/* Called now and then with the part that is done, 0 to 1; returns 0 to stop, and the call fails with
   SCUMBLE_CANCELLED. From one thread at a time, not always the caller's (progress.h). */
typedef int32_t (*scumble_progress)(void* user, double part);

/* -- Scenes (scene.h) */

typedef struct scumble_scene scumble_scene;

/* Reads .gltf, .glb, or a world (.json). `progress` may be null. */
SCUMBLE_API scumble_scene* scumble_scene_load(const char* path, scumble_progress progress, void* user);
/* The same from memory; with `folder` null or empty no file is opened. `name`: what messages call it. */
SCUMBLE_API scumble_scene* scumble_scene_from_memory(const void* bytes, size_t size, const char* name,
                                                     const char* folder);
SCUMBLE_API void scumble_scene_free(scumble_scene* scene);

/* -- Scenes from arrays, and scenes that change (scene_editor.h) */

typedef struct scumble_editor scumble_editor;

/* Of a scene that is to be changed; null: of nothing. One thread at a time uses an editor. */
SCUMBLE_API scumble_editor* scumble_editor_create(const scumble_scene* scene);
SCUMBLE_API void scumble_editor_free(scumble_editor* editor);
/* The scene as it is now, to be freed by scumble_scene_free(); it stays as it is. */
SCUMBLE_API scumble_scene* scumble_editor_scene(scumble_editor* editor);

/* What is added gets a number from 0 on, its id; -1: it failed. Instead of adding, `id` sets what has that
   number; -1 adds. Material 0 is always there. */

/* Four bytes a pixel, sRGB, straight alpha, row 0 at the top. */
SCUMBLE_API int32_t scumble_editor_texture(scumble_editor* editor, int32_t id, const char* name,
                                           uint32_t width, uint32_t height, const uint8_t* rgba);

/* Set `size`, then start from scumble_material_default; the C++ header has more. */
typedef struct scumble_material {
  size_t size;                                     /* sizeof of this struct, set by who calls */
  const char* name;                                /* by which looks know it */
  float base_color[4];                             /* linear; a factor on the texture */
  int32_t base_color_texture;                      /* -1: none */
  float emissive[3];                               /* linear; a factor on the texture */
  int32_t emissive_texture;                        /* -1: none */
  int32_t alpha;                                   /* 0 opaque, 1 masked, 2 blended */
  float alpha_cutoff;                              /* of masked ones */
  int32_t double_sided, unlit, has_shadowed_color; /* 0 or 1 */
  float shadowed_color[3];                         /* linear */
} scumble_material;
SCUMBLE_API scumble_status scumble_material_default(scumble_material* material);
SCUMBLE_API int32_t scumble_editor_material(scumble_editor* editor, int32_t id,
                                            const scumble_material* material);
/* The first of this name; -1: there is none. */
SCUMBLE_API int32_t scumble_editor_find_material(const scumble_editor* editor, const char* name);

/* Triangles with one material. Arrays have an entry a vertex, or are null but for the positions; indices are
   three a triangle, or null: vertices as they come. */
typedef struct scumble_mesh_part {
  size_t vertex_count, index_count;
  const float* positions; /* 3 each, metres */
  const uint32_t* indices;
  const float* normals;   /* 3 each */
  const float *uv0, *uv1; /* 2 each */
  const uint8_t* colors;  /* 4 each, linear */
  int32_t material;
} scumble_mesh_part;
SCUMBLE_API int32_t scumble_editor_mesh(scumble_editor* editor, int32_t id, const scumble_mesh_part* parts,
                                        size_t part_count);

/* `parent` and `mesh`: -1, none; `transform`: column-major, to the parent's space. */
SCUMBLE_API int32_t scumble_editor_add_node(scumble_editor* editor, const char* name, int32_t parent,
                                            const float transform[16], int32_t mesh);
/* The first of this name, "boat/Deck" for one below another; -1: there is none. */
SCUMBLE_API int32_t scumble_editor_find_node(const scumble_editor* editor, const char* name);
SCUMBLE_API scumble_status scumble_editor_set_transform(scumble_editor* editor, int32_t node,
                                                        const float transform[16]);
/* 0: neither it nor what is below it is drawn. */
SCUMBLE_API scumble_status scumble_editor_set_visible(scumble_editor* editor, int32_t node, int32_t visible);
/* So many matrices; none: its mesh is drawn once. */
SCUMBLE_API scumble_status scumble_editor_set_instances(scumble_editor* editor, int32_t node,
                                                        const float* transforms, size_t count);

/* -- Looks (look.h) */

typedef struct scumble_look scumble_look;

/* All defaults. */
SCUMBLE_API scumble_look* scumble_look_create(void);
/* A look that ships, by its name, or a JSON file. */
SCUMBLE_API scumble_look* scumble_look_load(const char* name_or_file);
/* `name`: what messages call it; pictures that it names are looked for beside it. */
SCUMBLE_API scumble_look* scumble_look_from_json(const char* text, const char* name);
/* Sets one knob, e.g. "shadow.threshold" to "0.4", or to a track as looks have it,
   "{\"keys\": [[0, 0.4], [2, 0.6]]}"; wins over what the look says. */
SCUMBLE_API scumble_status scumble_look_set(scumble_look* look, const char* path, const char* value);
/* The same with one number (numbers, integers; toggles as 0 or 1) or three (colours, linear; vectors). */
SCUMBLE_API scumble_status scumble_look_set_numbers(scumble_look* look, const char* path,
                                                    const double* numbers, size_t count);
/* Takes back what was set by this path. */
SCUMBLE_API scumble_status scumble_look_unset(scumble_look* look, const char* path);
/* What holds at a time: one number or three, or a word (count 0), whose text is valid until this thread asks
   again. */
typedef struct scumble_value {
  size_t count;
  double numbers[3];
  const char* text; /* null where there are numbers */
} scumble_value;
SCUMBLE_API scumble_status scumble_look_get(const scumble_look* look, const char* path, double time,
                                            scumble_value* value);
/* What the look says to no effect in a scene (check.h), one call each: the setting, and what is wrong.
   `is_for_scene`: the look's file is meant for this scene alone. */
typedef void (*scumble_finding)(void* user, const char* setting, const char* problem);
SCUMBLE_API scumble_status scumble_check(const scumble_scene* scene, const scumble_look* look,
                                         int32_t is_for_scene, scumble_finding finding, void* user);
SCUMBLE_API void scumble_look_free(scumble_look* look);

/* -- Views (view.h) */

/* One eye. Matrices are column-major, for column vectors; eye to clip space in Vulkan's convention with
   reversed depth. */
typedef struct scumble_view {
  float world_to_eye[16], eye_to_clip[16];
  int32_t node;           /* of the scene, that it rides on; -1: none */
  uint32_t width, height; /* pixels; 0, 0: as the options say */
  int32_t rig;            /* whose eye it is */
  int32_t is_level;       /* 1: it does not tilt with its node */
  double origin[3];       /* the place in the world from which world_to_eye counts, metres */
} scumble_view;

/* Where the camera stands. Set `size`, then start from scumble_viewpoint_default. */
typedef struct scumble_viewpoint {
  size_t size;              /* sizeof of this struct, set by who calls */
  const char* camera;       /* of the scene, by name or number; null: as look and scene say */
  int32_t has_orbit;        /* else azimuth and elevation mean nothing */
  float azimuth, elevation; /* degrees */
  float distance;           /* in scene radii; 0: everything is in the frame */
  int32_t has_eye;          /* else eye and target mean nothing */
  float eye[3], target[3];  /* metres */
  float vertical_fov;       /* degrees; 0: as look and scene say */
} scumble_viewpoint;
SCUMBLE_API scumble_status scumble_viewpoint_default(scumble_viewpoint* viewpoint);

/* One view (stereo 0), or the left and the right one (stereo 1), `ipd` metres apart, at a time in seconds.
   `views` has room for two; `count` gets how many there are. */
SCUMBLE_API scumble_status scumble_make_views(const scumble_scene* scene, const scumble_look* look,
                                              const scumble_viewpoint* viewpoint, float aspect,
                                              int32_t stereo, float ipd, double time, scumble_view* views,
                                              size_t* count);

/* -- Rendering (renderer.h) */

typedef struct scumble_renderer scumble_renderer;
typedef struct scumble_frame scumble_frame;

/* `level`: 0 information, 1 warning, 2 error (log.h). From any thread; several may call at once. */
typedef void (*scumble_log)(void* user, int32_t level, const char* text);

/* Set `size`, then start from scumble_renderer_options_default. */
typedef struct scumble_renderer_options {
  size_t size;              /* sizeof of this struct, set by who calls */
  const char* device;       /* part of a name, a number, "cpu", "gpu" (any other), or null: the best */
  const char* cache_folder; /* where compiled pipelines are kept; null: nowhere */
  int32_t validation;       /* Vulkan's validation layers watch */
  scumble_log log;          /* null: their messages go to stderr, and others nowhere */
  void* log_user;           /* given to `log` as long as the renderer is */
} scumble_renderer_options;
SCUMBLE_API scumble_status scumble_renderer_options_default(scumble_renderer_options* options);
/* `options` null: the defaults. */
SCUMBLE_API scumble_renderer* scumble_renderer_create(const scumble_renderer_options* options);
SCUMBLE_API void scumble_renderer_free(scumble_renderer* renderer);
/* The device's name; valid as long as the renderer. */
SCUMBLE_API const char* scumble_renderer_device(const scumble_renderer* renderer);
/* Of the validation layers, since the start. */
SCUMBLE_API int32_t scumble_renderer_messages(const scumble_renderer* renderer);

/* As PixelFormat of image.h. */
typedef enum scumble_format { SCUMBLE_FLOAT32 = 0, SCUMBLE_HALF = 1, SCUMBLE_SRGB8 = 2 } scumble_format;

/* Set `size`, then start from scumble_options_default. */
typedef struct scumble_options {
  size_t size;            /* sizeof of this struct, set by who calls */
  uint32_t width, height; /* pixels, 1 to 16384 */
  uint32_t samples;       /* 1 or 4 */
  uint32_t seed;
  int32_t transparent;     /* leave the background out */
  scumble_format format;   /* of the picture; AOVs are 32-bit floats */
  const char* const* aovs; /* so many names of passes' outputs, beside the picture */
  size_t aov_count;
  scumble_progress progress; /* may be null */
  void* progress_user;
} scumble_options;
SCUMBLE_API scumble_status scumble_options_default(scumble_options* options);

/* Renders one frame of up to six views at a time in seconds. The same call gives the same bytes. */
SCUMBLE_API scumble_frame* scumble_render(scumble_renderer* renderer, const scumble_scene* scene,
                                          const scumble_look* look, double time, const scumble_view* views,
                                          size_t view_count, const scumble_options* options);
/* Compiles what frames of these views and options need, so that none compiles anything while they run. */
SCUMBLE_API scumble_status scumble_prepare(scumble_renderer* renderer, const scumble_scene* scene,
                                           const scumble_look* look, const scumble_view* views,
                                           size_t view_count, const scumble_options* options);

/* Pictures all around (panorama.h): of both eyes, the half that lies ahead; of both, all around; of one. */
typedef enum scumble_panorama_kind {
  SCUMBLE_VR180 = 0,
  SCUMBLE_ODS = 1,
  SCUMBLE_MONO360 = 2
} scumble_panorama_kind;
/* Set `size`, then start from scumble_panorama_default. */
typedef struct scumble_panorama {
  size_t size; /* sizeof of this struct, set by who calls */
  scumble_panorama_kind kind;
  float ipd;         /* metres between the eyes */
  float knob_height; /* degrees that stand for a picture's height where knobs count by that */
  float strip;       /* degrees for which an eye keeps its place */
} scumble_panorama;
SCUMBLE_API scumble_status scumble_panorama_default(scumble_panorama* panorama);
/* One panorama from where a camera is, level: a view for each eye, of the options' size each, which is square
   for SCUMBLE_VR180 and else twice as wide as high. */
SCUMBLE_API scumble_frame* scumble_render_panorama(scumble_renderer* renderer, const scumble_scene* scene,
                                                   const scumble_look* look, double time,
                                                   const scumble_view* from, const scumble_panorama* panorama,
                                                   const scumble_options* options);

/* Pixels in memory: rows from top to bottom without gaps, channels interleaved: height x width x channels
   numbers, as numpy has them. Colours are linear (sRGB codes in 8 bit), alpha is straight. */
typedef struct scumble_image {
  uint32_t width, height, channels;
  scumble_format format;
  const void* data;
  size_t bytes;
} scumble_image;

/* Layers: the picture, with an empty name, then the AOVs as they were asked for. */
SCUMBLE_API size_t scumble_frame_layers(const scumble_frame* frame);
/* Null where there is no such layer. */
SCUMBLE_API const char* scumble_frame_layer_name(const scumble_frame* frame, size_t layer);
/* How many views a layer has: one for all where it is drawn once. */
SCUMBLE_API size_t scumble_frame_views(const scumble_frame* frame, size_t layer);
/* The pixels belong to the frame, and are there as long as it is. */
SCUMBLE_API scumble_status scumble_frame_image(const scumble_frame* frame, size_t layer, size_t view,
                                               scumble_image* image);
SCUMBLE_API void scumble_frame_free(scumble_frame* frame);

/* Writes one image of a frame as PNG, JPEG, WebP or EXR, by the name's end. */
SCUMBLE_API scumble_status scumble_frame_write(const scumble_frame* frame, size_t layer, size_t view,
                                               const char* path);

#ifdef __cplusplus
}
#endif

#endif

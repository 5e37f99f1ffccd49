// Included once for each .params file, with PARAMS_STRUCT (the struct's name), PARAMS_FILE (quoted) and
// PARAMS_PATH (quoted) defined, and PARAMS_TARGETS as the set of what they may be set for. Defines the struct
// and its table of rows:
//
//   #define PARAMS_STRUCT BlurParams
//   #define PARAMS_FILE "passes/blur/blur.params"
//   #define PARAMS_PATH "blur"
//   #define PARAMS_TARGETS kScene | kMaterials
//   #include "look/define_params.h"
//
// No include guard: it is a template.

struct PARAMS_STRUCT {
  using toggle = ::scumble::look::Toggle;
  using choice = ::scumble::look::Choice;
  using srgb = ::scumble::look::Color;
  using picture = ::scumble::look::Picture;
  using triple = ::scumble::look::Triple;
  using name = ::scumble::look::Name;

#define PARAM(type, name, defaultValue, min, max, unit, meaning) type name = defaultValue;
#include PARAMS_FILE
#undef PARAM

  static const ::scumble::look::ParamBlock& block();
};

inline const ::scumble::look::ParamBlock& PARAMS_STRUCT::block() {
  using enum ::scumble::look::Target;
  static const ::scumble::look::ParamBlock table{PARAMS_PATH,
                                                 PARAMS_TARGETS,
                                                 {
#define PARAM(type, name, defaultValue, min, max, unit, meaning)                                   \
  {#name,   ::scumble::look::kindOf<type>(), double(defaultValue), double(min), double(max), unit, \
   meaning, offsetof(PARAMS_STRUCT, name)},
#include PARAMS_FILE
#undef PARAM
                                                 },
                                                 sizeof(PARAMS_STRUCT)};
  return table;
}

#undef PARAMS_STRUCT
#undef PARAMS_FILE
#undef PARAMS_PATH
#undef PARAMS_TARGETS

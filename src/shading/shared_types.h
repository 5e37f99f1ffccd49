// Types that C++ and GLSL share: a *.shared.h file includes this, declares its structs between SHARED_BEGIN
// and SHARED_END, and is laid out the same on both sides (GLSL uses scalar layout; no bool).
#ifndef SCUMBLE_SHARED_TYPES_H
#define SCUMBLE_SHARED_TYPES_H
#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

namespace scumble::shared {
using glm::ivec2;
using glm::ivec4;
using glm::mat3;
using glm::mat4;
using glm::max;
using glm::smoothstep;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
}  // namespace scumble::shared
#define SHARED_BEGIN namespace scumble::shared {
#define SHARED_END }
// Before functions that both compile.
#define SHARED_FUNCTION inline

#else

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FUNCTION

// A .params file within the braces of a struct gives its members. (C++ has the struct from
// look/define_params.h.)
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#define toggle uint
#define choice int
#define srgb vec3
#define picture int
#define triple vec3

#endif
#endif

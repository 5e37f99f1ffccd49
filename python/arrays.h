// numpy's arrays as the library's pictures, vectors and matrices, and back. Everything is checked: what does
// not fit raises UsageError.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scumble/image.h"

namespace scumble_python {

namespace py = pybind11;

// Height by width by channels, row 0 at the top; float32, float16 or uint8 as the picture's format. The array
// owns the picture's memory: nothing is copied.
py::array toArray(scumble::Image image);
// Pictures of several views as one array, views by height by width by channels; of one, without the first
// axis. Several are copied once. All have one size.
py::array toArray(std::vector<scumble::Image> views);

// Height by width, or by width by 1, 3 or 4 channels: uint8 (sRGB's codes) or any kind of float (linear).
scumble::Image toImage(const py::object& pixels, const std::string& what);
// The same, linear in any case.
scumble::Image toLinearImage(const py::object& pixels, const std::string& what);

// 4 by 4, as mathematics writes it: the last column is where things are moved to.
glm::dmat4 toMatrix(const py::handle& array, const std::string& what);
py::array toArray(const glm::dmat4& matrix);
glm::mat3 toMatrix3(const py::handle& array, const std::string& what);  // likewise
glm::dvec3 toVec3(const py::handle& numbers, const std::string& what);

// Rows of vectors, kept alive with the array that they lie in.
template <class Vector>
struct Rows {
  py::array array;
  std::span<const Vector> span;
};
// None: no rows.
using Vec2Rows = Rows<glm::vec2>;
using Vec3Rows = Rows<glm::vec3>;
Vec2Rows toVec2s(const py::object& numbers, const std::string& what);
Vec3Rows toVec3s(const py::object& numbers, const std::string& what);
Rows<float> toFloats(const py::object& numbers, const std::string& what);
// Whole numbers from 0 on, of any shape.
Rows<uint32_t> toIndices(const py::object& numbers, const std::string& what);
// n by 3 or 4: uint8, or floats from 0 to 1.
Rows<glm::u8vec4> toColors(const py::object& numbers, const std::string& what);
// n by 4 by 4.
std::vector<glm::mat4> toMatrices(const py::object& numbers, const std::string& what);

}  // namespace scumble_python

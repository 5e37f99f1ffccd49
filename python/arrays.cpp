#include "arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "calls.h"

using namespace scumble;

namespace scumble_python {
namespace {

std::string shapeOf(const py::array& array) {
  return py::str(array.attr("shape"));
}

py::dtype dtypeOf(PixelFormat format) {
  return py::dtype(format == PixelFormat::half    ? "float16"
                   : format == PixelFormat::srgb8 ? "uint8"
                                                  : "float32");
}
const void* dataOf(const Image& image) {
  switch (image.format) {
    case PixelFormat::half:
      return image.halves.data();
    case PixelFormat::srgb8:
      return image.codes.data();
    case PixelFormat::float32:
      break;
  }
  return image.pixels.data();
}

// Any object that numpy takes for numbers, in rows without gaps.
py::array numbersOf(const py::object& numbers, const std::string& what) {
  if (py::hasattr(numbers, "mask")) raiseUsage(what + " have a mask", "fill it: array.filled(0)");
  py::array array = py::array::ensure(numbers, py::array::c_style);
  if (!array || std::string("iuf").find(array.dtype().kind()) == std::string::npos) {
    raiseUsage(what + " are no numbers", "give an array of numbers");
  }
  return array;
}

template <class T>
py::array_t<T> converted(const py::array& array, const std::string& what) {
  auto result = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!result) {
    raiseUsage(what + " cannot be made numbers of the kind that is needed");
  }
  return result;
}

template <class Vector>
Rows<Vector> toFloatRows(const py::object& numbers, const std::string& what, int columns) {
  if (numbers.is_none()) return {};
  const py::array array = numbersOf(numbers, what);
  if (columns == 1 ? array.ndim() != 1 : array.ndim() != 2 || array.shape(1) != columns)
    raiseUsage(what + " have the shape " + shapeOf(array),
               columns == 1 ? "give one number a vertex" : "give n rows of " + std::to_string(columns));
  const py::array_t<float> floats = converted<float>(array, what);
  return {floats, {reinterpret_cast<const Vector*>(floats.data()), size_t(floats.shape(0))}};
}

template <class Matrix, int kSide>
Matrix toSquare(const py::handle& numbers, const std::string& what) {
  const py::array array = numbersOf(py::reinterpret_borrow<py::object>(numbers), what);
  if (array.ndim() != 2 || array.shape(0) != kSide || array.shape(1) != kSide)
    raiseUsage(what + " has the shape " + shapeOf(array),
               "give a matrix of " + std::to_string(kSide) + " by " + std::to_string(kSide));
  const py::array_t<double> rows = converted<double>(array, what);
  Matrix matrix;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      matrix[column][row] = typename Matrix::value_type(*rows.data(row, column));
  return matrix;
}

}  // namespace

py::array toArray(Image image) {
  auto owned = std::make_unique<Image>(std::move(image));
  const Image& kept = *owned;
  const py::capsule owner(owned.release(), [](void* pointer) { delete static_cast<Image*>(pointer); });
  return py::array(dtypeOf(kept.format), {size_t(kept.height), size_t(kept.width), kept.channels.size()},
                   dataOf(kept), owner);
}

py::array toArray(std::vector<Image> views) {
  if (views.size() == 1) return toArray(std::move(views.front()));
  const Image& first = views.front();
  for (const Image& view : views)
    if (view.width != first.width || view.height != first.height)
      raiseUsage("views of several sizes are no one array", "draw them one after the other");
  py::array result(dtypeOf(first.format),
                   {views.size(), size_t(first.height), size_t(first.width), first.channels.size()});
  const size_t bytes = size_t(result.nbytes()) / views.size();
  for (size_t i = 0; i < views.size(); ++i)
    std::memcpy(static_cast<char*>(result.mutable_data()) + i * bytes, dataOf(views[i]), bytes);
  return result;
}

Image toImage(const py::object& pixels, const std::string& what) {
  const py::array array = numbersOf(pixels, what);
  const auto ndim = array.ndim();
  const py::ssize_t channels = ndim == 3 ? array.shape(2) : 1;
  if ((ndim != 2 && ndim != 3) || (channels != 1 && channels != 3 && channels != 4))
    raiseUsage(what + " has the shape " + shapeOf(array), "give height by width by 3 (RGB) or 4 (RGBA)");
  if (array.shape(0) < 1 || array.shape(1) < 1 || array.shape(0) > 65535 || array.shape(1) > 65535)
    raiseUsage(what + " has the shape " + shapeOf(array), "sides are from 1 to 65535 pixels");
  Image image{.width = uint32_t(array.shape(1)), .height = uint32_t(array.shape(0)), .isColor = true};
  const char* const names[] = {"R", "G", "B", "A"};
  // One channel is grey.
  image.channels.assign(names, names + (channels == 1 ? 3 : channels));
  const size_t count = size_t(image.width) * image.height * image.channels.size();
  const auto copy = [&](auto& out, const auto* in) {
    out.resize(count);
    if (channels == 1)
      for (size_t i = 0; i < count; ++i) out[i] = in[i / 3];
    else
      std::copy_n(in, count, out.begin());
  };
  if (array.dtype().kind() == 'u' && array.itemsize() == 1) {
    image.format = PixelFormat::srgb8;
    copy(image.codes, converted<uint8_t>(array, what).data());
  } else if (array.dtype().kind() == 'f') {
    copy(image.pixels, converted<float>(array, what).data());
  } else {
    raiseUsage(what + " has numbers of the kind " + std::string(py::str(array.dtype())),
               "give uint8 (sRGB) or floats (linear)");
  }
  return image;
}

Image toLinearImage(const py::object& pixels, const std::string& what) {
  Image image = toImage(pixels, what);
  if (image.format != PixelFormat::srgb8) return image;
  std::array<float, 256> linear;  // IEC 61966-2-1
  for (size_t code = 0; code < linear.size(); ++code) {
    const float value = float(code) / 255;
    linear[code] = value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
  }
  image.pixels.resize(image.codes.size());
  for (size_t i = 0; i < image.codes.size(); ++i)
    image.pixels[i] = i % image.channels.size() == 3 ? float(image.codes[i]) / 255 : linear[image.codes[i]];
  image.codes = {};
  image.format = PixelFormat::float32;
  return image;
}

glm::dmat4 toMatrix(const py::handle& numbers, const std::string& what) {
  return toSquare<glm::dmat4, 4>(numbers, what);
}
glm::mat3 toMatrix3(const py::handle& numbers, const std::string& what) {
  return toSquare<glm::mat3, 3>(numbers, what);
}

py::array toArray(const glm::dmat4& matrix) {
  py::array_t<double> rows({4, 4});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) *rows.mutable_data(row, column) = matrix[column][row];
  return rows;
}

glm::dvec3 toVec3(const py::handle& numbers, const std::string& what) {
  const py::array array = numbersOf(py::reinterpret_borrow<py::object>(numbers), what);
  if (array.ndim() != 1 || array.shape(0) != 3)
    raiseUsage(what + " has the shape " + shapeOf(array), "give three numbers");
  const py::array_t<double> values = converted<double>(array, what);
  return {*values.data(0), *values.data(1), *values.data(2)};
}

Vec2Rows toVec2s(const py::object& numbers, const std::string& what) {
  return toFloatRows<glm::vec2>(numbers, what, 2);
}
Vec3Rows toVec3s(const py::object& numbers, const std::string& what) {
  return toFloatRows<glm::vec3>(numbers, what, 3);
}
Rows<float> toFloats(const py::object& numbers, const std::string& what) {
  return toFloatRows<float>(numbers, what, 1);
}

Rows<uint32_t> toIndices(const py::object& numbers, const std::string& what) {
  if (numbers.is_none()) return {};
  const py::array array = numbersOf(numbers, what);
  if (array.size() == 0) return {};
  if (std::string("iu").find(array.dtype().kind()) == std::string::npos)
    raiseUsage(what + " have numbers of the kind " + std::string(py::str(array.dtype())),
               "give whole numbers");
  const py::object least = array.attr("min")(), most = array.attr("max")();
  if (least < py::int_(0) || most > py::int_(std::numeric_limits<uint32_t>::max()))
    raiseUsage(what + " go from " + std::string(py::str(least)) + " to " + std::string(py::str(most)),
               "they count from 0 to 4294967295");
  const py::array_t<uint32_t> values = converted<uint32_t>(array, what);
  return {values, {values.data(), size_t(values.size())}};
}

Rows<glm::u8vec4> toColors(const py::object& numbers, const std::string& what) {
  if (numbers.is_none()) return {};
  const py::array array = numbersOf(numbers, what);
  if (array.ndim() != 2 || (array.shape(1) != 3 && array.shape(1) != 4))
    raiseUsage(what + " have the shape " + shapeOf(array), "give n rows of 3 (RGB) or 4 (RGBA)");
  const bool areCodes = array.dtype().kind() == 'u' && array.itemsize() == 1;
  if (!areCodes && array.dtype().kind() != 'f')
    raiseUsage(what + " have numbers of the kind " + std::string(py::str(array.dtype())),
               "give uint8, or floats from 0 to 1");
  const py::array_t<float> values = converted<float>(array, what);
  py::array_t<uint8_t> codes({array.shape(0), py::ssize_t(4)});
  for (py::ssize_t row = 0; row < array.shape(0); ++row)
    for (py::ssize_t column = 0; column < 4; ++column) {
      float value = column < array.shape(1) ? *values.data(row, column) : areCodes ? 255.0f : 1.0f;
      if (!areCodes && !(value >= 0 && value <= 1))
        raiseUsage(what + " hold " + std::to_string(value), "floats are from 0 to 1");
      *codes.mutable_data(row, column) = uint8_t(areCodes ? value : value * 255 + 0.5f);
    }
  return {codes, {reinterpret_cast<const glm::u8vec4*>(codes.data()), size_t(codes.shape(0))}};
}

std::vector<glm::mat4> toMatrices(const py::object& numbers, const std::string& what) {
  std::vector<glm::mat4> matrices;
  if (!py::isinstance<py::iterable>(numbers)) refuse(numbers, what, "n matrices of 4 by 4");
  for (const py::handle matrix : py::reinterpret_borrow<py::iterable>(numbers))
    matrices.emplace_back(toMatrix(matrix, what));
  return matrices;
}

}  // namespace scumble_python

// Builds one mesh out of faces, grids, sweeps, lofts and lathes. Every vertex gets a normal and a UV in
// metres times kTexelDensity, because the renderer's brush texture follows the gradients of the UVs: a
// stretched unwrap would show as stretched brush strokes.
#pragma once

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>

#include "mesh_kit/mesh.h"

namespace meshkit {

// UV units a metre.
constexpr float kTexelDensity = 0.5f;
constexpr float kPi = 3.14159265358979f;

enum class Shading { flat, smooth };

// Rows of points, all of one length; row-major.
struct Grid {
  size_t rows = 0, columns = 0;
  std::vector<glm::vec3> points;
  Grid(size_t rowCount, size_t columnCount)
      : rows(rowCount), columns(columnCount), points(rowCount * columnCount) {}
  glm::vec3& at(size_t row, size_t column) { return points[row * columns + column]; }
  const glm::vec3& at(size_t row, size_t column) const { return points[row * columns + column]; }
};

// How a grid becomes triangles. Faces look towards d/d(column) x d/d(row).
struct GridOptions {
  Shading shading = Shading::flat;
  bool closed = false;  // the last column joins the first
  bool flip = false;    // look to the other side
  // UVs are unrolled by arc length, which suits tubes and bands; sheets whose cells differ much in size are
  // better projected along an axis.
  glm::vec3 projectAlong{0.0f};
  // The material of a cell; the builder's current one where there is none.
  std::function<int(size_t row, size_t column)> cellMaterial;
};

struct LoftOptions {
  Shading shading = Shading::flat;
  bool capStart = true, capEnd = true;
};

class MeshBuilder {
 public:
  explicit MeshBuilder(std::string name) { mesh_.name = std::move(name); }

  // What follows is of this material, and placed by this matrix.
  void setMaterial(int material) { material_ = material; }
  void setTransform(const glm::mat4& transform) { transform_ = transform; }
  const glm::mat4& transform() const { return transform_; }
  // What follows is bound to joints, by the place of each vertex.
  void setBinding(std::function<Binding(glm::vec3 place)> binding) {
    binding_ = std::move(binding);
    mesh_.bound = true;
  }

  // Flat faces, counter-clockwise seen from the front.
  void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c);
  void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
  // A flat polygon that every point can see from its centre.
  void polygon(std::span<const glm::vec3> points);

  void grid(const Grid& grid, const GridOptions& options = {});

  // Closed rings of equally many points, one after the other; rings run counter-clockwise seen from the end
  // that the loft goes to.
  void loft(const std::vector<std::vector<glm::vec3>>& rings, const LoftOptions& options = {});

  // A round bar along a curve; one radius for all points or one each.
  void tube(const std::vector<glm::vec3>& path, const std::vector<float>& radii, int sides,
            Shading shading = Shading::smooth);
  // The same with a rectangular section; `up` fixes how it lies.
  void bar(const std::vector<glm::vec3>& path, float width, float height, glm::vec3 up);

  // (radius, height) pairs from bottom to top, turned around +Y.
  void lathe(const std::vector<glm::vec2>& profile, int sides, Shading shading = Shading::flat);

  // `taper` shrinks the top (+Y) face.
  void box(glm::vec3 center, glm::vec3 size, float taper = 1.0f);
  // A closed outline in the plane of +X and +Y (counter-clockwise seen from +Z), from z0 to z1.
  void extrude(std::span<const glm::vec2> outline, float z0, float z1);

  // Triangles with shared vertices; `faceMaterial` as in GridOptions, by normal and centre of the face.
  void indexed(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& faces, Shading shading,
               const std::function<int(glm::vec3 normal, glm::vec3 center)>& faceMaterial = {});

  Mesh take() { return std::move(mesh_); }

 private:
  Primitive& primitive(int material);
  void emit(int material, glm::vec3 a, glm::vec3 b, glm::vec3 c);
  void addVertex(Primitive& primitive, glm::vec3 place, glm::vec3 normal, glm::vec2 uv);

  Mesh mesh_;
  int material_ = 0;
  glm::mat4 transform_{1.0f};
  std::function<Binding(glm::vec3 place)> binding_;
};

// Points of a ring: an ellipse in the plane of `right` and `front` around `center`; squareness 1 is an
// ellipse, smaller is boxier.
std::vector<glm::vec3> ellipseRing(glm::vec3 center, glm::vec3 right, glm::vec3 front, int sides,
                                   float squareness = 1.0f);

// A smooth curve through the points (Catmull-Rom), `steps` pieces between two of them.
std::vector<glm::vec3> smoothCurve(const std::vector<glm::vec3>& points, int steps);

// A rope that hangs between two points, `sag` metres below the straight line in its middle.
std::vector<glm::vec3> hangingRope(glm::vec3 from, glm::vec3 to, float sag, int pieces);

// The unit icosphere, each face split into 4^levels.
void icosphere(int levels, std::vector<glm::vec3>& points, std::vector<glm::uvec3>& faces);

}  // namespace meshkit

#include "gltf/add_points.h"

#include <limits>

#include "base/srgb.h"
#include "gltf/gaussians.h"
#include "gltf/rewrite.h"

namespace scumble::gltf {

namespace {

// A node that shows them, at the root of the file's scene.
void addCloud(Rewrite& file, const std::string& name, const std::vector<Gaussian>& gaussians,
              const glm::dvec3& origin) {
  AttributeWriter positions("POSITION", kFloatType, "VEC3", 12), colors("COLOR_0", kFloatType, "VEC4", 16),
      rotations("KHR_gaussian_splatting:ROTATION", kFloatType, "VEC4", 16),
      scales("KHR_gaussian_splatting:SCALE", kFloatType, "VEC3", 12),
      opacities("KHR_gaussian_splatting:OPACITY", kFloatType, "SCALAR", 4),
      harmonics("KHR_gaussian_splatting:SH_DEGREE_0_COEF_0", kFloatType, "VEC3", 12);
  glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
  for (const Gaussian& g : gaussians) {
    low = glm::min(low, g.position), high = glm::max(high, g.position);
    positions.put(g.position);
    colors.put(glm::vec4(g.color, g.opacity));
    rotations.put(glm::vec4(g.rotation.x, g.rotation.y, g.rotation.z, g.rotation.w));
    scales.put(g.deviations);
    opacities.put(g.opacity);
    glm::vec3 harmonic;
    for (int c = 0; c < 3; ++c) harmonic[c] = float((srgbFromLinear(double(g.color[c])) - 0.5) / kHarmonic);
    harmonics.put(harmonic);
  }
  Json primitive = {{"mode", 0},
                    {"attributes", Json::object()},
                    {"extensions",
                     {{kGaussianSplatting,
                       {{"kernel", "ellipse"},
                        {"colorSpace", "srgb_rec709_display"},
                        {"sortingMethod", "cameraDistance"},
                        {"projection", "perspective"}}}}}};
  Json& accessor = positions.addTo(file, primitive, gaussians.size());
  accessor["min"] = {low.x, low.y, low.z}, accessor["max"] = {high.x, high.y, high.z};
  for (AttributeWriter* const attribute : {&colors, &rotations, &scales, &opacities, &harmonics})
    attribute->addTo(file, primitive, gaussians.size());
  for (const AttributeWriter* const attribute :
       {&positions, &colors, &rotations, &scales, &opacities, &harmonics})
    attribute->finish(file);
  const size_t mesh = file.add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
  const size_t node = file.add("nodes", nodeAt(origin, name, mesh));
  Json& root = file.root();
  const size_t scene = root.value("scene", size_t(0));
  if (root.contains("scenes") && scene < root["scenes"].size()) {
    root["scenes"][scene]["nodes"].push_back(node);
  } else {
    // A file without scenes shows all of its nodes.
    std::vector<bool> isChild(root["nodes"].size());
    for (const Json& parent : root["nodes"])
      for (const Json& child : parent.value("children", Json::array())) isChild[child.get<size_t>()] = true;
    Json roots = Json::array();
    for (size_t n = 0; n < isChild.size(); ++n)
      if (!isChild[n]) roots.push_back(n);
    root["scenes"] = Json::array({{{"nodes", roots}}}), root["scene"] = 0;
  }
  file.useExtension(kGaussianSplatting);
}

}  // namespace

std::vector<uint8_t> withGaussians(const std::string& path, const SceneOptions& options,
                                   const std::vector<Gaussian>& gaussians, const glm::dvec3& origin,
                                   ImportWarnings& warnings) {
  Rewrite file(path, options, warnings);
  file.dropStrokes();
  file.root().erase("animations");
  addCloud(file, "painting", gaussians, origin);
  return file.glb("ask for fewer splats");
}

std::vector<uint8_t> gaussiansAlone(const std::string& name, const std::vector<Gaussian>& gaussians,
                                    const glm::dvec3& origin) {
  Rewrite file(Json{{"asset", {{"version", "2.0"}}}});
  addCloud(file, name, gaussians, origin);
  return file.glb("ask for fewer splats");
}

}  // namespace scumble::gltf

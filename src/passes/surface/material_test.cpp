// What a material's values come from, against glTF's own words in double precision: factor, texture and
// vertex colour, coordinates and samplers, alpha, what emits; and where marks may act.
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kWallWidth = 64, kWallHeight = 48;
constexpr double kRootStep = 1.0 / 255;

// Texels of different colours, linear, each a square of 8 bits of sRGB, so that nothing is rounded.
glm::dvec3 linearOf(int r, int g, int b) {
  const auto one = [](int byte) {
    const double code = byte / 255.0;
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
  };
  return {one(r), one(g), one(b)};
}
const glm::dvec3 kTexels[] = {linearOf(240, 40, 90), linearOf(60, 200, 130), linearOf(100, 110, 250),
                              linearOf(220, 180, 30)};

Image twoByTwo(float alpha = 1) {
  Image image{2, 2, {"R", "G", "B", "A"}, {}};
  for (const glm::dvec3& c : kTexels)
    image.pixels.insert(image.pixels.end(), {float(c.r), float(c.g), float(c.b), alpha});
  return image;
}

// The texel that a coordinate falls on where textures repeat.
glm::dvec3 repeated(double u, double v) {
  const auto at = [](double t) { return int(std::floor((t - std::floor(t)) * 2)); };
  return kTexels[at(v) * 2 + at(u)];
}

class MaterialTest : public BothEyes {
 protected:
  // Unlit, since that is to look as its author painted it: lit and shadowed are the colour itself.
  static Json unlitTextured(int texture) {
    Json json = TestScene::unlit("Wall", {1, 1, 1, 1});
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
    return json;
  }
  static TestMesh wall(const glm::vec2& uvs = {1, 1}) {
    return gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1, uvs);
  }
  // A place on the wall by shares of its width and height.
  static glm::dvec3 place(double s, double t) { return {2 * s - 1, 2 * t - 1, 0}; }

  struct Shown {
    Frame frame;
    std::vector<View> views;
    glm::dvec4 at(const char* name, size_t view, const glm::dvec3& place) const {
      const glm::ivec2 pixel(pixelOf(views[view], place, kWallWidth, kWallHeight));
      return texel(aov(frame, name, view), pixel.x, pixel.y);
    }
  };
  static Shown shown(const TestScene& s, const Knobs& knobs = {}) {
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 3.5f}}, kWallWidth, kWallHeight, GetParam());
    Knobs all{{"surface.simplify", "0"}};
    all.insert(all.end(), knobs.begin(), knobs.end());
    return {draw(scene, quietLook(all), views,
                 sized(kWallWidth, kWallHeight, {"lit", "shadowed", "shadow", "id"})),
            views};
  }
  static void expectRoots(const glm::dvec4& got, const glm::dvec3& expected, double roots = 1) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(std::sqrt(got[c]), std::sqrt(std::min(expected[c], 1.0)), roots * kRootStep)
          << "channel " << c;
  }
};
INSTANTIATE_BOTH_EYES(MaterialTest);

// Factor times texture times vertex colour, and what the second texture emits at coordinates of its own.
TEST_P(MaterialTest, colorsAndWhatEmitsAreProducts) {
  TestScene s;
  const int texture = s.texture(twoByTwo());
  Json json = unlitTextured(texture);
  json["pbrMetallicRoughness"]["baseColorFactor"] = {0.6, 0.3, 0.9, 1};
  json["emissiveFactor"] = {0.1, 0.3, 0.05};
  json["emissiveTexture"] = {{"index", texture}, {"texCoord", 1}};
  TestMesh mesh = wall();
  mesh.colors.assign(4, {1, 0.4f, 0.2f, 1});  // 255, 102, 51
  s.add(mesh, s.material(json));
  // The second set of coordinates is that of a wall which stands aside: turned over along u.
  TestMesh aside = gridMesh({9, 9, 0}, {1, 0, 0}, {0, 1, 0});
  for (glm::vec2& uv : aside.uvs) uv.x = 1 - uv.x;
  s.add(aside, -1);
  Json& meshes = s.json()["meshes"];
  meshes[0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
      meshes[1]["primitives"][0]["attributes"]["TEXCOORD_0"];
  const double lens = 0.8, glow = 0.1;
  const Shown seen =
      shown(s, {{"surface.lens", std::to_string(lens)}, {"surface.glow", std::to_string(glow)}});
  for (size_t v = 0; v < viewCount(); ++v)
    for (int i = 0; i < 4; ++i) {
      const double u = i % 2 ? 0.75 : 0.25, t = i / 2 ? 0.75 : 0.25;
      const glm::dvec3 emits = glm::dvec3(0.1, 0.3, 0.05) * repeated(1 - u, t);
      const glm::dvec3 expected =
          glm::dvec3(0.6, 0.3, 0.9) * repeated(u, t) * glm::dvec3(1, 0.4, 0.2) + emits;
      expectRoots(seen.at("lit", v, place(u, t)), expected);
      expectRoots(seen.at("shadowed", v, place(u, t)), expected);
      const glm::dvec4 shadow = seen.at("shadow", v, place(u, t));
      EXPECT_EQ(shadow.x, 1);
      EXPECT_NEAR(shadow.y, lens * glm::dot(emits, glm::dvec3(0.2126, 0.7152, 0.0722)) + glow,
                  0.51 * kRootStep);
      EXPECT_EQ(shadow.z, 0) << "no marks on what is unlit";
    }
}

// KHR_texture_transform: T R S, counter-clockwise where v points down.
TEST_P(MaterialTest, texturesAreTransformed) {
  TestScene s;
  Json json = unlitTextured(s.texture(twoByTwo()));
  const double turn = 0.5, offset[] = {0.2, 0.35}, scale[] = {1.5, 0.8};
  json["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", offset}, {"rotation", turn}, {"scale", scale}};
  s.json()["extensionsUsed"].push_back("KHR_texture_transform");
  s.add(wall({2, 2}), s.material(json));
  const Shown seen = shown(s);
  size_t count = 0;
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 1; y < 16; ++y)
      for (int x = 1; x < 16; ++x) {
        // Where the pixel's own middle is on the wall.
        const glm::dvec2 pixel =
            glm::floor(pixelOf(seen.views[v], place(x / 16.0, y / 16.0), kWallWidth, kWallHeight));
        const Ray ray = pixelRay(seen.views[v], int(pixel.x), int(pixel.y), kWallWidth, kWallHeight);
        const glm::dvec3 at = ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
        const double su = scale[0] * (at.x + 1), sv = scale[1] * (at.y + 1);
        const double u = offset[0] + std::cos(turn) * su + std::sin(turn) * sv,
                     w = offset[1] - std::sin(turn) * su + std::cos(turn) * sv;
        const auto isNearEdge = [](double t) { return std::abs(2 * t - std::round(2 * t)) < 0.01; };
        if (isNearEdge(u) || isNearEdge(w)) continue;
        ++count;
        expectRoots(seen.at("lit", v, at), repeated(u, w));
      }
  EXPECT_GT(count, 150u * viewCount());
}

// Wrapping along each axis, interpolation, and mip levels where the sampler asks for them.
TEST_P(MaterialTest, samplersAreTheFiles) {
  const auto wallWith = [](const Json& sampler) {
    TestScene s;
    Json json = unlitTextured(s.texture(twoByTwo()));
    s.json()["samplers"][0] = sampler;
    TestMesh mesh = wall({3, 3});
    for (glm::vec2& uv : mesh.uvs) uv -= 1.0f;  // from -1 to 2
    s.add(mesh, s.material(json));
    return s;
  };
  const auto clamped = [](double t) { return int(t * 2 < 1 ? 0 : 1); };
  const auto mirrored = [](double t) { return int(std::floor(std::abs(t - 2 * std::round(0.5 * t)) * 2)); };
  for (const bool turned : {false, true}) {
    const Shown seen = shown(wallWith({{"magFilter", 9728},
                                       {"minFilter", 9728},
                                       {"wrapS", turned ? 33648 : 33071},
                                       {"wrapT", turned ? 33071 : 33648}}));
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) {
          const double u = -0.75 + 0.5 * x, t = -0.75 + 0.5 * y;
          const int i = turned ? mirrored(u) : clamped(u), j = turned ? clamped(t) : mirrored(t);
          expectRoots(seen.at("lit", v, place((x + 0.5) / 6, (y + 0.5) / 6)), kTexels[2 * j + i]);
        }
  }
  // Between four texels: their mean where the sampler interpolates. Far down its levels: the mean everywhere.
  const glm::dvec3 mean = 0.25 * (kTexels[0] + kTexels[1] + kTexels[2] + kTexels[3]);
  const Knobs coarse{{"surface.simplify", "8"}};
  const Shown linear = shown(wallWith({{"magFilter", 9729}, {"minFilter", 9729}}), coarse);
  const Shown levels = shown(wallWith({{"magFilter", 9729}, {"minFilter", 9987}}), coarse);
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::dvec3 middle = place(0.5, 0.5), texel = place(0.5 - 0.25 / 3, 0.5 - 0.25 / 3);
    // A pixel is a sixth of a texel wide, and may lie by half of that beside the place both ways.
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(linear.at("lit", v, middle)[c], mean[c], 0.16);
      EXPECT_NEAR(linear.at("lit", v, texel)[c], kTexels[0][c], 0.16);
    }
    // A small picture leaves out less: nearly all the way down.
    expectRoots(levels.at("lit", v, texel), mean, 14);
  }
}

// What is as opaque as the cutoff is there; opaque materials have no alpha; vertices' alpha counts.
TEST_P(MaterialTest, alphaAtItsCutoffAndWithoutOne) {
  struct Case {
    const char* mode;
    double factor, texture, vertex, cutoff;
    bool isThere;
  };
  for (const Case& c : {Case{"MASK", 0.5, 1, 1, 0.5, true}, Case{"MASK", 0.75, 1, 1, 0.75, true},
                        Case{"MASK", 1, 1, 0.2, 0.5, false}, Case{"MASK", 0.6, 0.6, 1, 0.5, false},
                        Case{"MASK", 0.8, 1, 1, 0.9, false}, Case{"OPAQUE", 0.3, 0.2, 0.4, 0.5, true}}) {
    TestScene s;
    Json json = unlitTextured(s.texture(twoByTwo(float(c.texture))));
    json["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, c.factor};
    json["alphaMode"] = c.mode;
    if (c.mode[0] == 'M') json["alphaCutoff"] = c.cutoff;
    TestMesh mesh = wall();
    mesh.colors.assign(4, {1, 1, 1, float(c.vertex)});
    s.add(mesh, s.material(json));
    // A scene of which nothing is seen is warned of.
    s.add(gridMesh({50, 0, 0}, {1, 0, 0}, {0, 1, 0}), s.material(TestScene::colored("Aside", {1, 1, 1, 1})));
    const Shown seen = shown(s);
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_EQ(seen.at("lit", v, place(0.3, 0.3)).w, c.isThere) << c.mode << ", cutoff " << c.cutoff;
      EXPECT_EQ(seen.at("id", v, place(0.3, 0.3)).x, c.isThere) << c.mode << ", cutoff " << c.cutoff;
    }
  }
}

// Blue of the shadow channels: as oblique as the light is, where it arrives, as much as the knob says.
TEST_P(MaterialTest, marksActWhereLightArrivesObliquely) {
  TestScene s;
  // A floor that is round, and a plane one in which marks have no place.
  TestMesh floor = gridMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 48);
  const float bend = glm::radians(20.0f);  // a metre
  for (size_t i = 0; i < floor.positions.size(); ++i) {
    const float angle = bend * floor.positions[i].x;
    floor.normals[i] = {std::sin(angle), std::cos(angle), 0};
    floor.positions[i].x = std::sin(angle) / bend;
    floor.positions[i].y = (std::cos(angle) - 1) / bend;
  }
  s.add(floor, s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
  s.add(gridMesh({-7.9f, 0, 2}, {6, 0, 0}, {0, 0, -4}),
        s.material(TestScene::colored("Plane", {0.5f, 0.5f, 0.5f, 1})));
  s.add(boxMesh({-1.2f, -0.4f, -0.6f}, {-0.8f, 0.3f, 0.6f}),
        s.material(TestScene::colored("Box", {0.5f, 0.5f, 0.5f, 1})));
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-1, 0.5, 0));
  s.light(glm::vec3(toLight));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 3, 3}}, kWallWidth, kWallHeight, GetParam());
  const double width = 0.9, amount = 0.6;
  const Frame frame = draw(scene,
                           quietLook({{"light.terminator", "0.1"},
                                      {"surface.indication", std::to_string(amount)},
                                      {"surface.indicationWidth", std::to_string(width)}}),
                           views, sized(kWallWidth, kWallHeight, {"shadow", "id", "position", "normal"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t reached = 0, kept = 0, plane = 0;
    for (int y = 0; y < kWallHeight; ++y)
      for (int x = 0; x < kWallWidth; ++x) {
        if (texel(aov(frame, "id", v), x, y).x == 2) {
          EXPECT_EQ(texel(aov(frame, "shadow", v), x, y).z, 0);
          ++plane;
        }
        if (texel(aov(frame, "id", v), x, y).x != 1) continue;
        // The box's shadow is a metre long; its edges may be either.
        const glm::dvec4 p = texel(aov(frame, "position", v), x, y),
                         got = texel(aov(frame, "shadow", v), x, y);
        const bool isDark = p.x > -0.7 && p.x < -0.35 && std::abs(p.z) < 0.4;
        const double lambert = glm::dot(glm::dvec3(texel(aov(frame, "normal", v), x, y)), toLight);
        const double wanted = amount * (1 - std::abs(lambert - 0.1) / width);
        const bool isLit =
            (p.x > 0.4 || p.x < -1.4 || std::abs(p.z) > 0.8) && lambert > 0.15 && lambert < 0.65;
        if (isDark) {
          EXPECT_EQ(got.z, 0);
          ++kept;
        }
        if (isLit) {
          EXPECT_NEAR(got.z, wanted, 0.51 * kRootStep + 3e-3);
          ++reached;
        }
      }
    EXPECT_GT(reached, 300u);
    EXPECT_GT(kept, 20u);
    EXPECT_GT(plane, 20u);
  }
}

}  // namespace
}  // namespace scumble::passes

// What changes of a scene cost the CPU: from the change to the point at which a frame of the changed scene
// could be drawn, beside building the whole scene on the device anew in the same run; and until that frame is
// submitted.
//
//   edits_bench [--objects 10000] [--runs 15] [--device NAME] [--json FILE]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "report/report.h"
#include "scumble/renderer.h"
#include "scumble/scene_editor.h"

using namespace scumble;

namespace {

template <class T>
T take(Result<T> result) {
  return bench::take("edits_bench", std::move(result));
}

// A sphere of 16 x 8 cells, as a mesh of its own.
struct Ball {
  std::vector<glm::vec3> positions, normals;
  std::vector<uint32_t> indices;
  explicit Ball(float radius, uint32_t around = 16) {
    const uint32_t down = around / 2;
    for (uint32_t y = 0; y <= down; ++y)
      for (uint32_t x = 0; x < around; ++x) {
        const float a = 6.2831853f * float(x) / float(around), b = 3.1415927f * float(y) / float(down);
        normals.emplace_back(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
        positions.push_back(radius * normals.back());
      }
    for (uint32_t y = 0; y < down; ++y)
      for (uint32_t x = 0; x < around; ++x) {
        const uint32_t a = y * around + x, b = y * around + (x + 1) % around;
        indices.insert(indices.end(), {a, b, a + around, b, b + around, a + around});
      }
  }
  std::vector<MeshPart> parts(MaterialId material) const {
    return {{.positions = positions, .indices = indices, .normals = normals, .material = material}};
  }
};

}  // namespace

int main(int argc, char** argv) try {
  int objects = 10000, runs = 15;
  std::string json;
  RendererOptions rendererOptions;
  CLI::App app("Milliseconds of changes of a scene, beside building it anew");
  app.add_option("--objects", objects, "how many, of a hundred meshes")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  app.add_option("--runs", runs, "how often each")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--device", rendererOptions.device, "part of a name, a number, or cpu");
  app.add_option("--json", json, "also write the numbers here");
  CLI11_PARSE(app, argc, argv);

  // A field of balls, in rows.
  SceneEditor editor;
  std::vector<uint8_t> pixels(size_t(256) * 256 * 4, 255);
  const TextureId texture = take(editor.addTexture({"skin", 256, 256, pixels}));
  MaterialDesc painted{.name = "Painted"};
  painted.baseColorTexture.texture = texture;
  const MaterialId material = take(editor.addMaterial(painted));
  std::vector<MeshId> meshes;
  for (int m = 0; m < 100; ++m)
    meshes.push_back(take(editor.addMesh(Ball(0.3f + 0.001f * float(m)).parts(material))));
  std::vector<NodeId> nodes;
  const int side = int(std::ceil(std::sqrt(double(objects))));
  const auto placeOf = [&](int i) {
    return glm::translate(glm::mat4(1.0f), glm::vec3(glm::ivec3(i % side, 0, i / side)));
  };
  for (int i = 0; i < objects; ++i)
    nodes.push_back(take(editor.addNode({.transform = placeOf(i), .mesh = meshes[size_t(i % 100)]})));

  const std::unique_ptr<Renderer> renderer = take(Renderer::create(rendererOptions));
  RenderOptions options;
  options.width = 64, options.height = 36, options.samples = 1;
  std::vector<View> views = take(makeViews(take(editor.scene()), {}, 16.0f / 9));
  const auto milliseconds = [](auto since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
  };
  // From the change until the scene is on the device, and from there until its frame is on its way.
  struct Cost {
    double change, frame;  // ms
  };
  const auto timeOf = [&](const std::function<void()>& change, const std::function<Scene()>& scene) {
    const auto start = std::chrono::steady_clock::now();
    change();
    const Scene changed = scene();
    const double before = milliseconds(start);
    const FrameStats stats = take(renderer->render(changed, Look(), 0, views, options)).stats;
    return Cost{before + stats.uploadMilliseconds, stats.setupMilliseconds + stats.cpuMilliseconds};
  };
  const auto present = [&] { return take(editor.scene()); };
  const auto done = [](const Status& status) { take(Result<Done>(status)); };
  timeOf([] {}, present);

  struct Case {
    const char* name;
    std::function<void(int run)> change;
    std::vector<Cost> costs{};
  };
  const int middle = objects / 2;
  const MeshId one = take(editor.addMesh(Ball(0.4f).parts(material))),
               other = take(editor.addMesh(Ball(0.4f).parts(material)));
  done(editor.setMesh(nodes[size_t(middle)], one));
  done(editor.setMesh(nodes[size_t(middle) + 3], other));
  std::vector<Case> cases = {
      {"nothing, seen from elsewhere",
       [&](int run) {
         for (View& view : views)
           view.worldToEye = glm::translate(view.worldToEye, {run % 2 ? 0.1f : -0.1f, 0, 0});
       }},
      {"one transform",
       [&](int run) {
         done(editor.setTransform(nodes[size_t(middle + 1)],
                                  glm::translate(placeOf(middle + 1), {0, 0.01f * float(run + 1), 0})));
       }},
      {"every transform",
       [&](int run) {
         for (int i = 0; i < objects; ++i)
           done(editor.setTransform(nodes[size_t(i)],
                                    glm::translate(placeOf(i), {0, 0.001f * float((run + i) % 50), 0})));
       }},
      {"one hidden or shown",
       [&](int run) { done(editor.setVisible(nodes[size_t(middle + 2)], run % 2 == 1)); }},
      {"a material's colour",
       [&](int run) {
         painted.baseColor.g = 1 - 0.01f * float(run % 50);
         done(editor.setMaterial(material, painted));
       }},
      {"a texture, 256 x 256",
       [&](int run) {
         pixels[0] = uint8_t(run);
         done(editor.setTexture(texture, {"skin", 256, 256, pixels}));
       }},
      {"a mesh, of the same size",
       [&](int run) { done(editor.setMesh(one, Ball(0.4f + 0.001f * float(run % 50)).parts(material))); }},
      {"a mesh, of another size",
       [&](int run) { done(editor.setMesh(other, Ball(0.4f, 18 + 2 * uint32_t(run % 2)).parts(material))); }},
  };
  std::vector<Cost> whole;
  for (int run = 0; run < runs; ++run) {
    for (Case& each : cases) each.costs.push_back(timeOf([&] { each.change(run); }, present));
    // A scene that nobody has seen.
    Scene fresh = take(SceneEditor(take(editor.scene())).scene());
    const auto newOne = [&] { return fresh; };
    whole.push_back(timeOf([] {}, newOne));
    timeOf([] {}, present);
  }

  const GpuInfo gpu = renderer->gpu();
  std::printf("%s, %d objects, medians of %d\n%-40s %10s %12s %10s\n", gpu.name.c_str(), objects, runs, "",
              "ms", "of the whole", "frame, ms");
  nlohmann::ordered_json report{
      {"device", gpu.name}, {"driver", gpu.driver}, {"objects", objects}, {"runs", runs}};
  const auto row = [&](const char* name, const std::vector<Cost>& costs) {
    std::vector<double> changes, ratios, frames;
    for (size_t i = 0; i < costs.size(); ++i) {
      changes.push_back(costs[i].change);
      ratios.push_back(costs[i].change / whole[i].change);
      frames.push_back(costs[i].frame);
    }
    std::printf("%-40s %10.2f %12.3f %10.2f\n", name, bench::median(changes), bench::median(ratios),
                bench::median(frames));
    report["cases"].push_back({{"name", name},
                               {"milliseconds", bench::median(changes)},
                               {"ratio", bench::median(ratios)},
                               {"frameMilliseconds", bench::median(frames)}});
  };
  for (const Case& each : cases) row(each.name, each.costs);
  row("the whole scene anew", whole);
  return bench::give("edits_bench", json, report);
} catch (const std::exception& error) {
  std::fprintf(stderr, "edits_bench: error: %s\n", error.what());
  return 1;
}

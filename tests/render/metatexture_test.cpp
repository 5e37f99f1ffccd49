// The shader src/shading/metatexture.glsl by itself, on the GPU, against its reference in double precision,
// and for every property that FORMULAS 1, 2, 5 and 6 ask for. What passes make of it is tested with them.
#include "frame/metatexture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "base/nested_marks.h"
#include "shaders/metatexture_probe_comp.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;
using frame::MetaTexture;

// Mirror the structs of metatexture_probe.comp.
struct Query {
  glm::vec2 uv{0.0f}, dSdu{1, 0}, dSdv{0, 1}, wraps{0.0f}, pixel{0.0f};
  float alpha = 1;
};
struct Answer {
  glm::vec4 value, histogram;
  glm::vec2 exponent;
  float q, variance, skewBlend;
  glm::vec2 psi[2];
};

class MetaTextureTest : public ::testing::Test {
 protected:
  struct Gpu {
    std::unique_ptr<gpu::Device> device;
    std::optional<gpu::Samplers> samplers;
    std::optional<world::ExampleTextures> examples;
  };
  static Gpu& gpuOfTests() {
    static Gpu* made = [] {
      auto gpu = new Gpu;
      gpu::DeviceOptions options;
      options.validation = true;
      options.choice = testDevice();
      gpu->device = std::move(gpu::Device::create(options)).value();
      gpu->samplers.emplace(*gpu->device);
      gpu->examples.emplace(*gpu->device);
      return gpu;
    }();
    return *made;
  }
  void TearDown() override { EXPECT_EQ(gpuOfTests().device->validationMessages(), 0); }

  static std::vector<Answer> ask(const MetaTexture& meta, const std::vector<Query>& queries,
                                 look::Picture example = 0, bool specialised = false,
                                 const look::LookData& look = {}) {
    Gpu& g = gpuOfTests();
    const world::ExampleTexture& texture = meta.contrast == frame::kContrastHistogram
                                               ? g.examples->getWithTwin(look, example)
                                               : g.examples->get(look, example);
    const frame::MetaTextureUse use{meta, &texture};
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    gpu::SetLayout layout(*g.device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStage},
                                      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStage},
                                      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStage},
                                      {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kStage},
                                      {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kStage}});
    gpu::DescriptorSets sets(*g.device, layout);
    gpu::Buffer uniforms(*g.device, sizeof(frame::MetaTextureUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                         gpu::MemoryKind::upload);
    gpu::Buffer in(*g.device, queries.size() * sizeof(Query), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   gpu::MemoryKind::upload);
    gpu::Buffer out(*g.device, queries.size() * sizeof(Answer), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                    gpu::MemoryKind::readback);
    const frame::MetaTextureUniforms data = meta.uniforms();
    std::memcpy(uniforms.mapped(), &data, sizeof(data));
    std::memcpy(in.mapped(), queries.data(), queries.size() * sizeof(Query));
    sets.writeBuffer(0, 0, uniforms.handle());
    sets.writeBuffer(0, 1, in.handle());
    sets.writeBuffer(0, 2, out.handle());
    sets.writeTexture(0, 3, use.image().view(), g.samplers->get(use.sampler()));
    sets.writeTexture(0, 4, use.inverse().view(), g.samplers->get(world::ExampleTextures::kInverseSampler));
    gpu::ComputePipelineDesc desc;
    desc.shader = {shaders::metatexture_probe_comp};
    desc.constants = {specialised ? meta.features() : ~0u};
    desc.sets = {layout.handle()};
    const gpu::Pipeline pipeline(*g.device, desc);
    g.device->runOnce([&](VkCommandBuffer commands) {
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, sets[0]);
      vkCmdDispatch(commands, uint32_t(queries.size() + 63) / 64, 1, 1);
      gpu::memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                         VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                         VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<Answer> answers(queries.size());
    std::memcpy(answers.data(), out.mapped(), answers.size() * sizeof(Answer));
    return answers;
  }

  static MetaTextureReference reference(const MetaTexture& m, int example = 0) {
    MetaTextureReference r;
    r.texture.pixels = builtInExample(example);
    r.mean = m.mean;
    r.size = m.size.x, r.base = m.base, r.levelRotation = m.levelRotation, r.blend = m.blend, r.skip = m.skip;
    r.skewLevels = int(m.skewLevels);
    r.skew = m.skew == 0   ? MetaTextureReference::off
             : m.skew == 1 ? MetaTextureReference::approximate
                           : MetaTextureReference::exact;
    r.contour = m.orient != 0, r.contrast = m.contrast != 0, r.nested = m.nested != 0;
    r.shift = m.shift;
    return r;
  }

  // From gradients, per pixel, to tangents, pixels per unit.
  static void setGradients(Query& query, const glm::dvec2& gradU, const glm::dvec2& gradV) {
    const double det = gradU.x * gradV.y - gradU.y * gradV.x;
    query.dSdu = glm::dvec2(gradV.y, -gradV.x) / det;
    query.dSdv = glm::dvec2(-gradU.y, gradU.x) / det;
  }
  // As floats have them.
  static void gradientsOf(const Query& query, glm::dvec2& gradU, glm::dvec2& gradV) {
    const glm::dvec2 a(query.dSdu), b(query.dSdv);
    const double det = a.x * b.y - a.y * b.x;
    gradU = glm::dvec2(b.y, -b.x) / det, gradV = glm::dvec2(-a.y, a.x) / det;
  }

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  glm::dvec2 direction() {
    const double angle = number(0, glm::two_pi<double>());
    return {std::cos(angle), std::sin(angle)};
  }
  // A mapping of about the scale at which one copy is one unit of uv, over a few octaves, at least a little
  // askew.
  Query randomQuery(double octaves = 3) {
    Query query;
    query.uv = {number(-2, 3), number(-2, 3)};
    const glm::dvec2 u = direction();
    const double angle = number(0.15, glm::pi<double>() - 0.15) * (number(0, 1) < 0.5 ? -1 : 1);
    const glm::dvec2 v(std::cos(angle) * u.x - std::sin(angle) * u.y,
                       std::sin(angle) * u.x + std::cos(angle) * u.y);
    setGradients(query, u / 256.0 * std::exp2(number(-octaves, octaves)),
                 v / 256.0 * std::exp2(number(-octaves, octaves)));
    query.alpha = float(number(1, 1.6));
    return query;
  }

  std::mt19937 random_{7};
};

TEST_F(MetaTextureTest, equalsItsReference) {
  for (int round = 0; round < 40; ++round) {
    MetaTexture m;
    m.mean = glm::vec4(0.5f, 0.5f, 0.5f, 1);
    m.contrast = round % 3 != 0;
    m.skew = round % 3;
    m.skewLevels = float(1 + round % 7);
    const double bases[] = {2, 3, std::sqrt(2), glm::golden_ratio<double>(), 1.3, 5};
    m.base = float(bases[round % 6]);
    m.levelRotation = round % 4 == 1 ? float(number(-3, 3)) : 0.0f;
    m.blend = round % 5 == 1 ? 0.4f : 1.0f;
    m.skip = round % 2 ? 0.1f : 0.0f;
    m.orient = round % 4 == 2;
    m.nested = round % 8 >= 6;
    m.shift = {float(number(0, 1)), float(number(0, 1))};
    const bool specialised = m.base == 2 && m.levelRotation == 0 && m.orient == 0 && m.skip == 0;
    std::vector<Query> queries(512);
    for (Query& query : queries) {
      query = randomQuery();
      query.wraps = glm::vec2(round % 2, (round / 2) % 2);
    }
    const MetaTextureReference expected = reference(m);
    const std::vector<Answer> answers = ask(m, queries, 0, specialised);
    Difference values(0.03), exponents(2e-3), variances(4e-3), skews(1e-4);
    for (size_t i = 0; i < queries.size(); ++i) {
      glm::dvec2 gradU, gradV;
      gradientsOf(queries[i], gradU, gradV);
      const auto e = expected.at(queries[i].uv, gradU, gradV, queries[i].alpha, glm::bvec2(queries[i].wraps));
      for (int c = 0; c < 3; ++c) values.add(answers[i].value[c], e.value[c]);
      exponents.add(answers[i].exponent.x, e.exponent.x), exponents.add(answers[i].exponent.y, e.exponent.y);
      variances.add(answers[i].variance, e.variance);
      skews.add(answers[i].q, e.q);
    }
    // Filters count in steps of 1 / 256, floats of coordinates are a few thousandths of a texel.
    // SwiftShader's exp2 and log2 are coarser than most (found: 0.06 and 0.0074).
    EXPECT_LE(values.beyondPart(), rastersFinely() ? 0.01 : 0.1) << round << ": " << values.text();
    EXPECT_LT(values.mean(), rastersFinely() ? 4e-3 : 0.01) << round << ": " << values.text();
    EXPECT_LE(exponents.beyondPart(), 0.01) << round << ": " << exponents.text();
    EXPECT_LE(variances.beyondPart(), 0.01) << round << ": " << variances.text();
    EXPECT_EQ(skews.beyond, 0u) << round << ": " << skews.text();
  }
}

// FORMULAS 1 and 6: continuous under any continuous change of the gradients, for every base and angle; and
// across the levels of skew (FORMULAS 5).
TEST_F(MetaTextureTest, continuousWhereExponentsAreWholeForEveryBase) {
  for (const double base : {2.0, 3.0, std::sqrt(2.0), glm::golden_ratio<double>()})
    for (const double degrees : {0.0, 30.0, 137.5})
      for (const int skew : {0, 1, 2})
        for (const bool contrast : {false, true}) {
          MetaTexture m;
          m.base = float(base), m.levelRotation = float(glm::radians(degrees)), m.skew = skew,
          m.contrast = contrast;
          // The gradient of u grows and that of v shrinks, while the angle between them changes: through six
          // whole numbers each and all levels of skew.
          constexpr int kSteps = 4000;
          const double octaves = 3 * std::log2(base);
          const glm::dvec2 from = direction();
          std::vector<Query> queries(kSteps);
          const glm::vec2 uv(float(number(0, 1)), float(number(0, 1)));
          for (int i = 0; i < kSteps; ++i) {
            const double t = double(i) / kSteps, angle = glm::mix(0.35, 2.8, t);
            const glm::dvec2 v(std::cos(angle) * from.x - std::sin(angle) * from.y,
                               std::sin(angle) * from.x + std::cos(angle) * from.y);
            queries[size_t(i)].uv = uv;
            setGradients(queries[size_t(i)], from / 256.0 * std::exp2(octaves * (2 * t - 1)),
                         v / 256.0 * std::exp2(octaves * (1 - 2 * t)));
          }
          const std::vector<Answer> answers = ask(m, queries);
          // An exponent moves by 6 / 4000 a step, a blend by at most 1.5 of that; copies differ by up to 1,
          // contrast at most doubles it in each of three axes. A jump would be tens of times larger.
          double most = 0, path = 0;
          for (size_t i = 1; i < answers.size(); ++i)
            for (int c = 0; c < 3; ++c) {
              const double step = std::abs(answers[i].value[c] - answers[i - 1].value[c]);
              most = std::max(most, step), path += step;
            }
          EXPECT_LT(most, 0.05) << "base " << base << ", " << degrees << " degrees, skew " << skew;
          EXPECT_GT(path, 0.5) << "it does change";
        }
}

// FORMULAS 2: the same contrast at every zoom, and the texture's own.
TEST_F(MetaTextureTest, contrastIsTheTexturesOwn) {
  const auto deviationAt = [&](const MetaTexture& m, double octave, bool turned) {
    std::vector<Query> queries(20000);
    for (Query& query : queries) {
      query.uv = {number(0, 64), number(0, 64)};
      const double grad = std::exp2(octave) / 256;
      setGradients(query, {grad, 0}, glm::dvec2(turned ? 0.6 * grad : 0.0, 0.8 * grad));
    }
    double sum = 0, squares = 0;
    for (const Answer& answer : ask(m, queries))
      for (int c = 0; c < 2; ++c) sum += answer.value[c], squares += answer.value[c] * answer.value[c];
    const double n = 2.0 * double(queries.size());
    return std::sqrt(squares / n - sum * sum / n / n);
  };
  const double own = deviationOf(builtInExample(0))[0];
  for (const bool askew : {false, true}) {
    MetaTexture m;
    m.skew = askew ? 2 : 0;
    double least = 1e9, most = 0, leastWithout = 1e9;
    for (int i = 0; i < 8; ++i) {
      m.contrast = 1;
      const double with = deviationAt(m, i / 8.0, askew);
      m.contrast = 0;
      leastWithout = std::min(leastWithout, deviationAt(m, i / 8.0, askew));
      least = std::min(least, with), most = std::max(most, with);
    }
    // Filtering between texels takes a tenth; 40,000 numbers of a few thousand features are known to two
    // percent.
    EXPECT_LT(most / least, 1.08) << least << " to " << most;
    EXPECT_NEAR(0.5 * (least + most), own, 0.12 * own);
    EXPECT_LT(leastWithout, 0.7 * least) << "blending alone takes much of it away";
  }
}

// Heitz and Neyret: a texture of two values keeps them, where blending alone makes grey.
TEST_F(MetaTextureTest, histogramOfATextureOfTwoValues) {
  look::LookData look;
  auto picture = std::make_shared<look::LookPicture>();
  picture->pixels = {64, 64, std::vector<uint8_t>(64 * 64 * 4, 255)};
  for (size_t i = 0; i < 64 * 64; ++i) {
    const bool ink = (i % 64) / 4 % 2 == (i / 64) / 8 % 4 / 2;
    for (size_t c = 0; c < 3; ++c) picture->pixels.rgba[4 * i + c] = ink ? 40 : 220;
  }
  look.pictures.push_back(picture);
  const world::ExampleTexture& example = gpuOfTests().examples->get(look, look::Picture(-1));
  EXPECT_GT(example.statistics.distanceToGaussian.x, 0.3f);
  frame::WarpMetaTextureParams params;
  params.size = 64;
  params.example = look::Picture(-1);
  MetaTexture m =
      frame::metaTextureUse(params, 0b0111, look, *gpuOfTests().examples, 1, glm::vec2(0.0f)).meta;
  EXPECT_EQ(m.contrast, frame::kContrastHistogram) << "chosen by itself";
  std::vector<Query> queries(8000);
  for (Query& query : queries) {
    query = randomQuery();
    query.uv = {number(0, 16), number(0, 16)};
    query.alpha = 4;  // one copy is 64 pixels
  }
  const auto shareOfGrey = [&](bool histogram) {
    size_t grey = 0;
    for (const Answer& answer : ask(m, queries, look::Picture(-1), false, look)) {
      const double v = histogram ? answer.histogram.x : answer.value.x;
      grey += v > 80 / 255.0 && v < 180 / 255.0;
    }
    return double(grey) / double(queries.size());
  };
  const double kept = shareOfGrey(true);
  m.contrast = frame::kContrastVariance, m.mean = example.statistics.mean;
  const double blended = shareOfGrey(false);
  EXPECT_LT(kept, 0.2);
  EXPECT_GT(blended, 1.8 * kept);
}

// FORMULAS 5: at a level the two gradients are perpendicular; between levels the copies together are nearer
// to that than the original, at every sample.
TEST_F(MetaTextureTest, skewIsLessenedEverywhere) {
  for (const int kind : {1, 2}) {
    MetaTexture m;
    m.skew = kind, m.skewLevels = 8;
    std::vector<Query> queries(4000);
    for (Query& query : queries) query = randomQuery(1.0);
    const std::vector<Answer> answers = ask(m, queries);
    size_t much = 0;
    double residual = 0;
    for (size_t i = 0; i < queries.size(); ++i) {
      glm::dvec2 u, v;
      gradientsOf(queries[i], u, v);
      const auto askew = [](const glm::dvec2& a, const glm::dvec2& b) {
        return std::abs(glm::dot(a, b)) / glm::length(a) / glm::length(b);
      };
      const double before = askew(u, v);
      double after = 0;
      for (int k = 0; k < 2; ++k) {
        const glm::dvec2 p(answers[i].psi[k]);
        const double share = k == 0 ? 1 - answers[i].skewBlend : answers[i].skewBlend;
        after += share * askew(p.x * u + p.y * v, p.y * u + p.x * v);
      }
      // Within half a level of none there is little to take out.
      if (std::abs(answers[i].q) > 0.6 / 8) {
        EXPECT_LT(after, before + 1e-6) << "q " << answers[i].q;
        ++much;
      }
      if (before < 0.6) residual = std::max(residual, after);
    }
    EXPECT_GT(much, 2000u);
    // A level is an eighth; the flatter the two lie to each other, the more of the angle that is.
    if (kind == 2) {
      EXPECT_LT(residual, 0.25);
    }
  }
  // Exactly at a level nothing remains.
  MetaTexture m;
  m.skew = 2, m.skewLevels = 4;
  for (const double q : {-0.75, -0.5, -0.25, 0.25, 0.5, 0.75}) {
    Query query;
    const double ratio = 1.4, cosine = -q * (1 + ratio * ratio) / (2 * ratio);
    setGradients(query, glm::dvec2(1, 0) / 256.0,
                 ratio / 256.0 * glm::dvec2(cosine, std::sqrt(1 - cosine * cosine)));
    const Answer answer = ask(m, {query})[0];
    glm::dvec2 u, v;
    gradientsOf(query, u, v);
    EXPECT_NEAR(answer.q, q, 1e-4);
    const glm::dvec2 p(answer.skewBlend < 0.5f ? answer.psi[0] : answer.psi[1]);
    const glm::dvec2 a = p.x * u + p.y * v, b = p.y * u + p.x * v;
    EXPECT_NEAR(glm::dot(a, b) / glm::length(a) / glm::length(b), 0, 2e-3);
  }
}

// Exact skew as knobs have it by default, two levels: for gradients of one length g whose cosine is -q, the
// two nearest levels are 0 and +-1/2, the share of the latter is the cubic blend of 2 |q|, and its transform
// by 15 degrees has gradients of length g sqrt(1 - |q| / 2).
TEST_F(MetaTextureTest, smallSkewByTwoLevels) {
  const MetaTexture m =
      frame::metaTextureUse({}, 0b0011, {}, *gpuOfTests().examples, 1, glm::vec2(0.0f)).meta;
  ASSERT_EQ(m.skewLevels, 2);
  ASSERT_EQ(m.size.x, 256);
  std::vector<double> qs;
  for (const double q : {1e-3, 0.01, 0.03, 0.1, 0.2, 0.25, 0.3, 0.4, 0.49}) qs.insert(qs.end(), {q, -q});
  std::vector<Query> queries;
  for (const double q : qs) {
    Query query;
    query.uv = {0.3f, 0.6f};
    setGradients(query, glm::dvec2(1, 0) / 200.0, glm::dvec2(-q, std::sqrt(1 - q * q)) / 200.0);
    queries.push_back(query);
  }
  const std::vector<Answer> answers = ask(m, queries);
  for (size_t i = 0; i < qs.size(); ++i) {
    const double q = qs[i], t = 2 * std::abs(q), share = t * t * (3 - 2 * t);
    EXPECT_NEAR(answers[i].q, q, 1e-5);
    // Levels ascend: the one at 0 is the second where q is negative.
    const glm::dvec2 none(1, 0), whole(0.9659258263, (q < 0 ? -1 : 1) * 0.2588190451);
    const int at = q < 0 ? 0 : 1;
    EXPECT_LT(glm::length(glm::dvec2(answers[i].psi[at]) - whole), 1e-5) << q;
    EXPECT_LT(glm::length(glm::dvec2(answers[i].psi[1 - at]) - none), 1e-6) << q;
    EXPECT_NEAR(at == 1 ? answers[i].skewBlend : 1 - answers[i].skewBlend, share, 2e-5) << q;
    const double exponent = -std::log2(256 / 200.0) - 0.5 * share * std::log2(1 - 0.5 * std::abs(q));
    EXPECT_NEAR(answers[i].exponent.x, exponent, 2e-5) << q;
    EXPECT_NEAR(answers[i].exponent.y, exponent, 2e-5) << q;
    // The shares of both levels and of the scales in each, for both axes.
    const auto squares = [](double e) {
      const double f = e - std::floor(e), b = f * f * (3 - 2 * f);
      return (b * b + (1 - b) * (1 - b)) * (b * b + (1 - b) * (1 - b));
    };
    const double straight = -std::log2(256 / 200.0),
                 skewed = straight - 0.5 * std::log2(1 - 0.5 * std::abs(q));
    EXPECT_NEAR(answers[i].variance,
                (1 - share) * (1 - share) * squares(straight) + share * share * squares(skewed), 1e-4)
        << q;
  }
}

// Where a mapping closes on itself both sides agree, at every scale, base, rotation and skew.
TEST_F(MetaTextureTest, wrapsWithoutASeam) {
  for (const double base : {2.0, 3.0, 1.5})
    for (const double degrees : {0.0, 40.0})
      for (const int skew : {0, 2})
        for (const bool closed : {true, false}) {
          MetaTexture m;
          m.base = float(base), m.levelRotation = float(glm::radians(degrees)), m.skew = skew;
          std::vector<Query> queries;
          for (int i = 0; i < 300; ++i) {
            Query query = randomQuery(4);
            const float v = query.uv.y;
            query.wraps = {closed, 0};
            for (const float u : {1e-5f, 1 - 1e-5f}) queries.push_back(query), queries.back().uv = {u, v};
          }
          const std::vector<Answer> answers = ask(m, queries);
          double most = 0;
          for (size_t i = 0; i < answers.size(); i += 2)
            for (int c = 0; c < 3; ++c)
              most = std::max<double>(most, std::abs(answers[i].value[c] - answers[i + 1].value[c]));
          if (closed)
            EXPECT_LT(most, 0.1) << base << ", " << degrees << ", " << skew;
          else
            EXPECT_GT(most, 0.3) << "an open mapping has a seam";
        }
}

// Degenerate mappings and mappings without any extent, of any mode: numbers all the same.
TEST_F(MetaTextureTest, finiteForAnything) {
  const float extremes[] = {0.0f, -0.0f, 1e-30f, -1e-12f, 1e-3f, 1, -256, 1e6f, 1e15f, -1e30f};
  std::vector<Query> queries;
  for (const float a : extremes)
    for (const float b : extremes)
      for (const float c : extremes) {
        Query query;
        query.uv = {c, b}, query.dSdu = {a, b}, query.dSdv = {c, a}, query.pixel = {100, 200};
        queries.push_back(query);
        query.dSdv = query.dSdu, query.wraps = {1, 1};
        queries.push_back(query);
      }
  for (const int mode : {0, 1, 2, 3})
    for (const int skew : {0, 1, 2}) {
      MetaTexture m;
      m.mode = mode, m.skew = mode == 0 ? skew : 0, m.orient = 1, m.contrast = 1;
      for (const Answer& answer : ask(m, queries))
        for (int c = 0; c < 4; ++c)
          ASSERT_TRUE(std::isfinite(answer.value[c]) && std::isfinite(answer.variance));
    }
}

// Section 3.5: the texture's horizontal lies along v where u is foreshortened, along u where it is not.
TEST_F(MetaTextureTest, orientationShowsTheContour) {
  MetaTexture m;
  m.orient = 1, m.contrast = 0;
  const RepeatingTexture texture{builtInExample(1)};
  for (const bool foreshortened : {false, true}) {
    std::vector<Query> queries(200);
    for (Query& query : queries) {
      query.uv = {number(0, 1), number(0, 1)};
      setGradients(query, {(foreshortened ? 4.0 : 1.0) / 256, 0}, {0, 1.0 / 256});
    }
    const std::vector<Answer> answers = ask(m, queries, 1);
    Difference difference(0.03);
    for (size_t i = 0; i < queries.size(); ++i) {
      // Exponents are whole: one copy, that starts where copies of its level do.
      const glm::dvec2 level(foreshortened ? -2 : 0, 0),
          at = glm::dvec2(queries[i].uv) * glm::exp2(level) + 0.618034 * level;
      difference.add(answers[i].value.x, texture.sample(foreshortened ? glm::dvec2(at.y, at.x) : at).x);
    }
    EXPECT_EQ(difference.beyond, 0u) << difference.text();
  }
}

// A zoom by four octaves, along u, along v and both: where there is a mark there is one ever after. Of copies
// that begin anywhere most are lost.
TEST_F(MetaTextureTest, nestedMarksAreNeverLost) {
  constexpr int kExample = 5, kSteps = 33;
  const std::vector<glm::dvec2> places = nestedPlaces();
  const glm::dvec2 along[] = {{1, 0}, {0, 1}, {1, 1}};
  for (const bool nested : {true, false}) {
    MetaTexture m;
    m.mean = meanOf(builtInExample(kExample));
    m.contrast = frame::kContrastVariance;
    m.nested = nested;
    m.shift = {0.3137f, 0.7241f};
    std::vector<Query> queries;
    for (const glm::dvec2& place : places)
      for (const glm::dvec2& way : along)
        for (int step = 0; step < kSteps; ++step) {
          Query& query = queries.emplace_back();
          query.uv = place - glm::dvec2(m.shift);
          const double octaves = 4.0 * step / (kSteps - 1);
          setGradients(query, glm::dvec2(std::exp2(-octaves * way.x) / 256, 0),
                       glm::dvec2(0, std::exp2(-octaves * way.y) / 256));
        }
    const std::vector<Answer> answers = ask(m, queries, kExample);
    size_t lost = 0;
    for (size_t i = 0; i < answers.size(); i += kSteps)
      lost += std::any_of(answers.begin() + std::ptrdiff_t(i), answers.begin() + std::ptrdiff_t(i) + kSteps,
                          [](const Answer& answer) { return answer.value.b < 0.47f; });
    if (nested)
      EXPECT_EQ(lost, 0u);
    else
      EXPECT_GT(lost, answers.size() / kSteps / 2);
  }
}

// The rivals are what they are said to be.
TEST_F(MetaTextureTest, rivals) {
  const RepeatingTexture texture{builtInExample(0)};
  MetaTexture m;
  m.size = glm::vec2(128), m.tiles = 3, m.contrast = 0;
  std::vector<Query> queries(200);
  for (Query& query : queries) {
    query = randomQuery(0);
    query.pixel = {number(0, 640), number(0, 360)};
    setGradients(query, {1.0 / 1024, 0}, {0, 1.0 / 1024});  // magnified: no mip levels
  }
  Difference object(0.03), screen(0.03);
  m.mode = 1;
  const std::vector<Answer> mapped = ask(m, queries);
  m.mode = 2;
  const std::vector<Answer> shower = ask(m, queries);
  for (size_t i = 0; i < queries.size(); ++i) {
    object.add(mapped[i].value.x, texture.sample(glm::dvec2(queries[i].uv) * 3.0).x);
    screen.add(shower[i].value.x, texture.sample(glm::dvec2(queries[i].pixel) / 128.0).x);
  }
  EXPECT_EQ(object.beyond, 0u) << object.text();
  EXPECT_EQ(screen.beyond, 0u) << screen.text();

  // Summed octaves: continuous where one octave takes the place of the next, and with less contrast than the
  // texture.
  m.mode = 3;
  std::vector<Query> sweep(2000);
  for (size_t i = 0; i < sweep.size(); ++i) {
    sweep[i].uv = {0.3f, 0.7f};
    const double grad = std::exp2(4 * double(i) / double(sweep.size())) / 256;
    setGradients(sweep[i], {grad, 0}, {0, grad});
  }
  const std::vector<Answer> octaves = ask(m, sweep);
  double most = 0;
  for (size_t i = 1; i < octaves.size(); ++i)
    most = std::max<double>(most, std::abs(octaves[i].value.x - octaves[i - 1].value.x));
  EXPECT_LT(most, 0.01);
}

}  // namespace
}  // namespace scumble

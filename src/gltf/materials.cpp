#include <algorithm>
#include <cmath>

#include "base/color_text.h"
#include "gltf/import.h"
#include "scene/texels.h"

namespace scumble::gltf {

namespace {

constexpr const char* kPaintExtra = "scumble_paint";

float linearOf(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

Wrap wrapOf(const JsonView& sampler, const char* key) {
  switch (sampler.count(key, 10497)) {
    case 33071:
      return Wrap::clampToEdge;
    case 33648:
      return Wrap::mirroredRepeat;
    case 10497:
      return Wrap::repeat;
    default:
      sampler.failAt(key, "is not a known wrapping mode");
  }
}

Sampler readSampler(const JsonView& json) {
  Sampler sampler;
  sampler.wrapU = wrapOf(json, "wrapS");
  sampler.wrapV = wrapOf(json, "wrapT");
  const uint64_t magnify = json.count("magFilter", 9729), minify = json.count("minFilter", 9987);
  sampler.nearest = magnify == 9728;
  sampler.mipmaps = minify != 9728 && minify != 9729;
  return sampler;
}

// The image that a texture shows: its plain source where we can read that, else what an extension names.
int64_t imageOf(const JsonView& texture, size_t images) {
  for (const char* name :
       {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    const bool usable = std::string_view(name) == "EXT_texture_webp";
    if (!usable && texture.has("source")) continue;
    if (const JsonView extension = texture.extension(name))
      return extension.requiredIndex("source", images, "image");
  }
  return texture.requiredIndex("source", images, "image");
}

class MaterialReader {
 public:
  MaterialReader(const Import& import, SceneData& scene) : import_(import), scene_(scene) {}

  // `number`: in the file.
  Material read(const JsonView& json, size_t number) {
    Material m;
    m.metallic = 1.0f;  // the specification's default, where a material is given
    m.name = json.text("name");
    m.doubleSided = json.flag("doubleSided", false);
    m.alphaCutoff = std::max(json.number("alphaCutoff", 0.5f), 0.0f);  // above 1 all is cut away
    const std::string alphaMode = json.text("alphaMode", "OPAQUE");
    if (alphaMode == "MASK")
      m.alphaMode = AlphaMode::mask;
    else if (alphaMode == "BLEND")
      m.alphaMode = AlphaMode::blend;
    else if (alphaMode != "OPAQUE")
      import_.warnings.add(json.pathOf("alphaMode"), "an unknown alpha mode means OPAQUE");

    if (const JsonView pbr = json.object("pbrMetallicRoughness")) {
      pbr.numbers("baseColorFactor", &m.baseColor.x, 4);
      m.metallic = std::clamp(pbr.number("metallicFactor", 1.0f), 0.0f, 1.0f);
      m.roughness = std::clamp(pbr.number("roughnessFactor", 1.0f), 0.0f, 1.0f);
      m.baseColorTexture = textureUse(pbr, "baseColorTexture");
    }
    json.numbers("emissiveFactor", &m.emissive.x, 3);
    m.emissiveTexture = textureUse(json, "emissiveTexture");

    const JsonView extensions = json.object("extensions");
    if (extensions) readExtensions(extensions, m);
    m.outline = outlineOf(extensions, number);
    m.baseColor = glm::clamp(m.baseColor, glm::vec4(0.0f), glm::vec4(1.0f));
    m.emissive = glm::clamp(m.emissive, glm::vec3(0.0f), glm::vec3(1e6f));
    readExtras(json, m);
    return m;
  }

  const OutlineTextures& outlines() const { return outlines_; }

 private:
  void readExtensions(const JsonView& extensions, Material& m) {
    m.unlit = extensions.has("KHR_materials_unlit");
    if (const JsonView strength = extensions.object("KHR_materials_emissive_strength"))
      m.emissive *= std::max(0.0f, strength.number("emissiveStrength", 1.0f));
    if (const JsonView specular = extensions.object("KHR_materials_pbrSpecularGlossiness")) {
      m.baseColor = glm::vec4(1.0f);
      specular.numbers("diffuseFactor", &m.baseColor.x, 4);
      m.baseColorTexture = textureUse(specular, "diffuseTexture");
      m.metallic = 0.0f;
      m.roughness = 1.0f - std::clamp(specular.number("glossinessFactor", 1.0f), 0.0f, 1.0f);
    }
  }

  std::optional<Outline> outlineOf(const JsonView& extensions, size_t number) {
    try {
      if (extensions)
        if (const JsonView mtoon = extensions.object("VRMC_materials_mtoon")) return outlineOfVrm1(mtoon);
      // VRM 0 has it beside the materials.
      if (const JsonView vrm = import_.document.root().extension("VRM"))
        if (const JsonView all = vrm.list("materialProperties"); all && number < all.size())
          if (const JsonView mtoon = all.at(number); mtoon.text("shader") == "VRM/MToon")
            return outlineOfVrm0(mtoon);
    } catch (const ImportFailure& failure) {
      import_.warnings.add(failure.error.jsonPath,
                           "a material's outline is ignored: " + failure.error.problem);
    }
    return std::nullopt;
  }

  static Outline bounded(Outline outline) {
    outline.width = std::clamp(outline.width, 0.0f, 1000.0f);
    outline.color = glm::clamp(outline.color, glm::vec3(0.0f), glm::vec3(1.0f));
    outline.lightingMix = std::clamp(outline.lightingMix, 0.0f, 1.0f);
    return outline;
  }
  Outline outlineOfVrm1(const JsonView& mtoon) {
    Outline outline;
    const std::string mode = mtoon.text("outlineWidthMode", "none");
    if (mode == "screenCoordinates") outline.unit = Outline::Unit::pictureHeights;
    if (mode != "none") outline.width = mtoon.number("outlineWidthFactor", 0.0f);
    mtoon.numbers("outlineColorFactor", &outline.color.x, 3);
    outline.lightingMix = mtoon.number("outlineLightingMixFactor", 1.0f);
    outlines_[scene_.materials.size()] = {textureUse(mtoon, "outlineWidthMultiplyTexture"), 1};
    return bounded(outline);
  }
  // Centimetres, or percent of half the picture's height; colours in sRGB; textures by their numbers.
  Outline outlineOfVrm0(const JsonView& mtoon) {
    Outline outline;
    const JsonView numbers = mtoon.object("floatProperties"), vectors = mtoon.object("vectorProperties");
    const float mode = numbers ? numbers.number("_OutlineWidthMode", 0.0f) : 0.0f;
    const bool isOnScreen = mode == 2.0f;
    if (isOnScreen) outline.unit = Outline::Unit::pictureHeights;
    if (mode == 1.0f || isOnScreen)
      outline.width = numbers.number("_OutlineWidth", 0.5f) * (isOnScreen ? 0.005f : 0.01f);
    glm::vec4 color(0.0f, 0.0f, 0.0f, 1.0f);
    if (vectors) vectors.numbers("_OutlineColor", &color.x, 4);
    for (int c = 0; c < 3; ++c) outline.color[c] = linearOf(std::clamp(color[c], 0.0f, 1.0f));
    const bool isMixed = numbers && numbers.number("_OutlineColorMode", 0.0f) == 1.0f;
    outline.lightingMix = isMixed ? numbers.number("_OutlineLightingMix", 1.0f) : 0.0f;
    try {
      if (const JsonView used = mtoon.object("textureProperties"))
        if (const int64_t texture =
                used.index("_OutlineWidthTexture", import_.document.list("textures").size(), "texture");
            texture >= 0)
          outlines_[scene_.materials.size()] = {textureOf(texture), 0};
    } catch (const ImportFailure& failure) {
      import_.warnings.add(failure.error.jsonPath,
                           "a texture of an outline's widths is ignored: " + failure.error.problem);
    }
    return bounded(outline);
  }

  // A texture of the file, as it is without what a material adds.
  TextureUse textureOf(int64_t number) {
    TextureUse use;
    const JsonView texture = import_.document.list("textures").at(static_cast<size_t>(number));
    const JsonView samplers = import_.document.list("samplers");
    if (const int64_t sampler = texture.index("sampler", samplers.size(), "sampler"); sampler >= 0)
      use.sampler = readSampler(samplers.at(sampler));
    use.image = imageNumber(imageOf(texture, import_.document.list("images").size()));
    return use;
  }

  TextureUse textureUse(const JsonView& parent, const char* key) {
    TextureUse use;
    const JsonView info = parent.object(key);
    if (!info) return use;
    try {
      use = textureOf(info.requiredIndex("index", import_.document.list("textures").size(), "texture"));
      uint64_t uvSet = info.count("texCoord", 0);
      if (const JsonView transform = info.extension("KHR_texture_transform")) {
        uvSet = transform.count("texCoord", uvSet);
        use.transform = transformOf(transform);
      }
      if (uvSet > 1) {
        import_.warnings.add(info.path(), "texture coordinates beyond TEXCOORD_1 are replaced by TEXCOORD_0");
        uvSet = 0;
      }
      use.uvSet = static_cast<int>(uvSet);
    } catch (const ImportFailure& failure) {
      import_.warnings.add(failure.error.jsonPath,
                           "a texture is drawn as a magenta checker: " + failure.error.problem);
      use.image = imageNumber(-1);
    }
    return use;
  }

  static glm::mat3 transformOf(const JsonView& json) {
    glm::vec2 offset(0.0f), scale(1.0f);
    json.numbers("offset", &offset.x, 2);
    json.numbers("scale", &scale.x, 2);
    const float rotation = json.number("rotation", 0.0f), c = std::cos(rotation), s = std::sin(rotation);
    // Translation * rotation * scale, in columns; the extension turns counter-clockwise with v downwards.
    return glm::mat3(c * scale.x, -s * scale.x, 0.0f, s * scale.y, c * scale.y, 0.0f, offset.x, offset.y,
                     1.0f);
  }

  // Our number of the file's image; -1 stands for one that is missing. TextureImage::name holds the file's
  // number until readImages fills it in.
  int imageNumber(int64_t fileImage) {
    const auto [entry, isNew] = imageMap_.emplace(fileImage, static_cast<int>(scene_.images.size()));
    if (isNew) scene_.images.emplace_back().own().name = std::to_string(fileImage);
    return entry->second;
  }

  void readExtras(const JsonView& json, Material& m) {
    const auto extras = json.json().find("extras");
    if (extras == json.json().end() || !extras->is_object()) return;
    if (const auto found = extras->find("scumble_shadowed"); found != extras->end())
      m.shadowedColor = colorOf(*found, json.pathOf("extras.scumble_shadowed"));
    m.paint = paintLayerOf(json);
    if (!m.paint && extras->contains(kPaintExtra))
      import_.warnings.add(
          json.pathOf(std::string("extras.") + kPaintExtra),
          "a layer of paint is ignored: it needs alphaMode BLEND, and as far as it fades numbers "
          "with 0 <= fadeEnd < fadeStart <= 1");
    for (const auto& [key, use] : {std::pair("scumble_lit_texture", &m.litTexture),
                                   std::pair("scumble_shadowed_texture", &m.shadowedTexture)})
      if (const auto found = extras->find(key); found != extras->end())
        *use = namedTexture(*found, json.pathOf(std::string("extras.") + key));
  }

  std::optional<glm::vec3> colorOf(const Json& json, const std::string& path) {
    glm::vec3 srgb(-1.0f);
    if (json.is_string()) {
      if (const std::optional<uint32_t> color = parseColor(json.get<std::string>()))
        for (int i = 0; i < 3; ++i) srgb[i] = static_cast<float>(*color >> (16 - 8 * i) & 0xFF) / 255.0f;
    } else if (json.is_array() && json.size() == 3) {
      for (int i = 0; i < 3; ++i)
        if (json[i].is_number()) srgb[i] = static_cast<float>(json[i].get<double>());
    }
    for (int i = 0; i < 3; ++i)
      if (!(srgb[i] >= 0.0f && srgb[i] <= 1.0f)) {
        import_.warnings.add(path,
                             "a shadowed colour is ignored: it is neither a colour like \"#RRGGBB\" nor "
                             "three numbers in [0, 1]");
        return std::nullopt;
      }
    return glm::vec3(linearOf(srgb.x), linearOf(srgb.y), linearOf(srgb.z));
  }

  // A texture that extras name: {"index": 3}, or what modelling programs can write as a property: the number
  // alone, or the name of an image.
  TextureUse namedTexture(const Json& json, const std::string& path) {
    TextureUse use;
    const JsonView textures = import_.document.list("textures"), images = import_.document.list("images");
    const Json* index = json.is_object() && json.contains("index") ? &json["index"] : &json;
    try {
      if (json.is_string()) {
        const std::string& name = json.get_ref<const std::string&>();
        for (size_t i = 0; i < images.size() && use.image < 0; ++i)
          if (isNamed(images.at(i), name)) use.image = imageNumber(static_cast<int64_t>(i));
        if (use.image >= 0) return use;
      } else if (index->is_number()) {
        const double number = index->get<double>();
        if (number >= 0 && number < static_cast<double>(textures.size()) && number == std::floor(number))
          return textureOf(static_cast<int64_t>(number));
      }
    } catch (const ImportFailure&) {
    }
    import_.warnings.add(path, "a texture for light or shadow is ignored: it names no texture of the file");
    return TextureUse();
  }

  // By its name, or by that of its file.
  static bool isNamed(const JsonView& image, const std::string& name) {
    if (name.empty()) return false;
    const auto uri = image.json().find("uri");
    return image.text("name") == name ||
           (uri != image.json().end() && uri->is_string() && uri->get_ref<const std::string&>() == name);
  }

  const Import& import_;
  SceneData& scene_;
  std::map<int64_t, int> imageMap_;
  OutlineTextures outlines_;
};

}  // namespace

std::optional<PaintLayer> paintLayerOf(const JsonView& material) {
  const Json& json = material.json();
  const auto extras = json.find("extras"), mode = json.find("alphaMode");
  if (extras == json.end() || !extras->is_object() || !extras->contains(kPaintExtra)) return std::nullopt;
  const Json& paint = (*extras)[kPaintExtra];
  if (!paint.is_object() || mode == json.end() || *mode != "BLEND") return std::nullopt;
  PaintLayer layer;
  for (const auto& [key, value] :
       {std::pair("fadeStart", &layer.fadeStart), std::pair("fadeEnd", &layer.fadeEnd)}) {
    if (!paint.contains(key)) continue;
    if (!paint[key].is_number()) return std::nullopt;
    layer.fades = true;
    *value = paint[key].get<float>();
  }
  if (!(layer.fadeEnd >= 0 && layer.fadeEnd < layer.fadeStart && layer.fadeStart <= 1)) return std::nullopt;
  return layer;
}

OutlineTextures readMaterials(const Import& import, SceneData& scene) {
  const JsonView list = import.document.list("materials");
  std::vector<bool> used(list.size() + 1, false);
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) used[primitive.material] = true;

  scene.materials.resize(1);
  scene.materials[0].metallic = 1.0f;
  // One that nothing uses keeps its place, but its textures are not looked at.
  MaterialReader reader(import, scene);
  for (size_t i = 0; i < list.size(); ++i) {
    Material material;
    try {
      if (used[i + 1])
        material = reader.read(list.at(i), i);
      else
        material.name = list.at(i).text("name");
    } catch (const ImportFailure& failure) {
      import.warnings.add(failure.error.jsonPath,
                          "a material is replaced by the default one: " + failure.error.problem);
      material = scene.materials[0];
    }
    scene.materials.push_back(std::move(material));
  }
  return reader.outlines();
}

void readOutlineWidths(const OutlineTextures& textures, SceneData& scene) {
  for (Shared<Mesh>& mesh : scene.meshes)
    for (size_t i = 0; i < mesh->primitives.size(); ++i) {
      const auto found = textures.find(size_t(mesh->primitives[i].material));
      if (found == textures.end() || found->second.use.image < 0) continue;
      const auto& [use, channel] = found->second;
      const TextureImage& image = scene.images[size_t(use.image)];
      if (image.standIn) continue;
      Primitive& primitive = mesh.own().primitives[i];
      for (const glm::vec2& uv : coordinatesOf(primitive, use))
        primitive.outlineWidths.push_back(float(texelAt(image, use, uv)[channel]));
    }
}

}  // namespace scumble::gltf

#include "sketch/brushes.h"

#include <algorithm>
#include <iterator>

namespace scumble::sketch {

namespace {

using enum scene::Brush;

struct Entry {
  std::string_view key;
  KnownBrush brush;
};

// Those that their programs draw as plain ribbons and tubes are plain here, those with a texture of hairs
// have bristles, and what glows there is light.
constexpr Entry kTilt[] = {
    {"02ffb866-7fb2-4d15-b761-1012cefb1360", {"Embers", spatter, 1, 1}},
    {"0d3889f3-3ede-470c-8af4-de4813306126", {"DoubleTaperedMarker", plain, 0.1f, 1}},
    {"0eb4db27-3f82-408d-b5a1-19ebd7d5b711", {"Stars", spatter, 1, 1}},
    {"0f0ff7b2-a677-45eb-a7d6-0cd7206f4816", {"ChromaticWave", light, 0.3f, 1}},
    {"1161af82-50cf-47db-9706-0c3576d43c43", {"CoarseBristles", bristles, 0.1f, 1}},
    {"2241cd32-8ba2-48a5-9ee7-2caef7e9ed62", {"Light", light, 0.1f, 1}},
    {"2d35bcf0-e4d8-452c-97b1-3311be063130", {"Flat", plain, 0.2f, 1}},
    {"2f212815-f4d3-c1a4-681a-feeaf9c6dc37", {"Icing", plain, 0.3f, 1}},
    {"4391385a-cf83-4396-9e33-31e4e4930b27", {"Wire", plain, 1, 1}},
    {"4391385a-df73-4396-9e33-31e4e4930b27", {"Toon", plain, 0.1f, 1}},
    {"4391aaaa-df73-4396-9e33-31e4e4930b27", {"Disco", plain, 1, 1}},
    {"429ed64a-4e97-4466-84d3-145a861ef684", {"Marker", plain, 0.2f, 1}},
    {"4465b5ef-3605-bec4-2b3e-6b04508ddb6b", {"Gouache", bristles, 0.2f, 1}},
    {"492b36ff-b337-436a-ba5f-1e87ee86747e", {"Drafting", plain, 0.2f, 0.3f}},
    {"6a1cf9f9-032c-45ec-9b1d-a6680bee30f7", {"Dots", spatter, 0.6f, 1}},
    {"6a1cf9f9-032c-45ec-9b6e-a6680bee32e9", {"HyperGrid", light, 0.6f, 1}},
    {"700f3aa8-9a7c-2384-8b8a-ea028905dd8c", {"CelVinyl", plain, 0.1f, 1}},
    {"70d79cca-b159-4f35-990c-f02193947fe8", {"Smoke", wash, 0.6f, 1}},
    {"759f1ebd-20cd-4720-8d41-234e0da63716", {"Paper", plain, 0.1f, 1}},
    {"79168f10-6961-464a-8be1-57ed364c5600", {"CoarseBristles", bristles, 0.1f, 1}},
    {"7a1c8107-50c5-4b70-9a39-421576d6617e", {"Splatter", spatter, 0.6f, 1}},
    {"89d104cd-d012-426b-b5b3-bbaee63ac43c", {"Bubbles", spatter, 0.6f, 1}},
    {"accb32f5-4509-454f-93f8-1df3fd31df1b", {"SoftHighlighter", light, 0.2f, 1}},
    {"ad1ad437-76e2-450d-a23a-e17f8310b960", {"Rainbow", light, 0.3f, 1}},
    {"b2ffef01-eaaa-4ab5-aa64-95a2c4f5dbc6", {"NeonPulse", light, 0.3f, 1}},
    {"b67c0e81-ce6d-40a8-aeb0-ef036b081aa3", {"WetPaint", bristles, 0.1f, 1}},
    {"c0012095-3ffd-4040-8ee1-fc180d346eaa", {"Ink", bristles, 0.1f, 1}},
    {"c515dad7-4393-4681-81ad-162ef052241b", {"OilPaint", bristles, 0.1f, 1}},
    {"cb92b597-94ca-4255-b017-0e3f42f12f9e", {"Fire", light, 0.3f, 1}},
    {"cf019139-d41c-4eb0-a1d0-5cf54b0a42f3", {"Highlighter", light, 0.2f, 1}},
    {"d0262945-853c-4481-9cbd-88586bed93cb", {"DuctTape", plain, 0.2f, 1}},
    {"d229d335-c334-495a-a801-660ac8a87360", {"VelvetInk", light, 0.3f, 1}},
    {"d902ed8b-d0d1-476c-a8de-878a79e3a34c", {"Snow", spatter, 0.6f, 1}},
    {"d90c6ad8-af0f-4b54-b422-e0f92abe1b3c", {"TaperedMarker", plain, 0.1f, 1}},
    {"ea19de07-d0c0-4484-9198-18489a3c1487", {"Leaves", spatter, 0.6f, 1}},
    {"f1114e2e-eb8d-4fde-915a-6e653b54e9f5", {"Paper", plain, 0.1f, 1}},
    {"f5c336cf-5108-4b40-ade9-c687504385ab", {"Ink", bristles, 0.1f, 1}},
    {"f6e85de3-6dcc-4e7f-87fd-cee8c3d25d51", {"Electricity", light, 0.3f, 1}},
    {"f72ec0e7-a844-4e38-82e3-140c44772699", {"OilPaint", bristles, 0.1f, 1}},
    {"fde6e778-0f7a-e584-38d6-89d44cee59f6", {"Charcoal", bristles, 0.1f, 1}},
};

constexpr Entry kApainter[] = {
    {"flat", {"flat", plain, 0, 1}},
    {"smooth", {"smooth", plain, 0, 1}},
    {"squared-textured", {"squared-textured", bristles, 0, 1}},
    {"line-gradient", {"line-gradient", wash, 0, 1}},
    {"silky-flat", {"silky-flat", plain, 0, 1}},
    {"silky-textured", {"silky-textured", bristles, 0, 1}},
    {"lines1", {"lines1", bristles, 0, 1}},
    {"lines2", {"lines2", bristles, 0, 1}},
    {"lines3", {"lines3", bristles, 0, 1}},
    {"lines4", {"lines4", bristles, 0, 1}},
    {"lines5", {"lines5", bristles, 0, 1}},
    {"line-grunge1", {"line-grunge1", bristles, 0, 1}},
    {"line-grunge2", {"line-grunge2", bristles, 0, 1}},
    {"line-grunge3", {"line-grunge3", bristles, 0, 1}},
    {"dots", {"dots", spatter, 0, 1}},
    {"squares", {"squares", spatter, 0, 1}},
    {"column", {"column", plain, 0, 1}},
    {"gear1", {"gear1", spatter, 0, 1}},
    {"grunge1", {"grunge1", spatter, 0, 1}},
    {"grunge2", {"grunge2", spatter, 0, 1}},
    {"grunge3", {"grunge3", spatter, 0, 1}},
    {"grunge4", {"grunge4", spatter, 0, 1}},
    {"grunge5", {"grunge5", spatter, 0, 1}},
    {"leaf1", {"leaf1", spatter, 0, 1}},
    {"leaf2", {"leaf2", spatter, 0, 1}},
    {"leaf3", {"leaf3", spatter, 0, 1}},
    {"fur1", {"fur1", bristles, 0, 1}},
    {"fur2", {"fur2", bristles, 0, 1}},
    {"grass", {"grass", bristles, 0, 1}},
    {"grass1", {"grass1", bristles, 0, 1}},
    {"bush", {"bush", spatter, 0, 1}},
    {"star", {"star", spatter, 0, 1}},
    {"snow1", {"snow1", spatter, 0, 1}},
    {"snow2", {"snow2", spatter, 0, 1}},
    {"spheres", {"spheres", spatter, 0, 1}},
    {"cubes", {"cubes", spatter, 0, 1}},
    {"rainbow", {"rainbow", light, 0, 1}},
    {"single-sphere", {"single-sphere", plain, 0, 1}},
};

template <size_t N>
std::optional<KnownBrush> find(const Entry (&entries)[N], std::string_view key) {
  const auto found =
      std::find_if(std::begin(entries), std::end(entries), [&](const Entry& e) { return e.key == key; });
  return found == std::end(entries) ? std::nullopt : std::optional(found->brush);
}

}  // namespace

std::optional<KnownBrush> tiltBrush(std::string_view guid) {
  return find(kTilt, guid);
}

std::optional<KnownBrush> apainterBrush(std::string_view name) {
  return find(kApainter, name);
}

void tellBrushes(const std::vector<UsedBrush>& used, scene::Painting& painting,
                 scene::ImportWarnings& warnings) {
  constexpr size_t kMostNamed = 4, kLongest = 60;
  std::string unknown;
  size_t count = 0;
  for (const UsedBrush& brush : used) {
    painting.brushes.push_back(brush.name);
    if (brush.isKnown) continue;
    if (count < kMostNamed) unknown += (count > 0 ? ", " : "") + brush.name.substr(0, kLongest);
    ++count;
  }
  if (count > kMostNamed) unknown += " and " + std::to_string(count - kMostNamed) + " more";
  if (count > 0)
    warnings.add("brushes", (count > 1 ? "brushes that are not known are taken for plain ones: "
                                       : "a brush that is not known is taken for a plain one: ") +
                                unknown);
}

}  // namespace scumble::sketch

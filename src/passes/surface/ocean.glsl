// The painterly ocean (paper 000, section 6.1): a dithering pattern by MetaTexture is an index into the bathic map, foam
// lies on up-wind faces, and the sky is mirrored in hand-cut shapes.
layout(set = 2, binding = 7, scalar) uniform OceanBlock { OceanPaint ocean; };
layout(set = 2, binding = 8) uniform sampler2D bathicMap;
layout(set = 2, binding = 9) uniform sampler2D skyMap;
layout(set = 2, binding = 10) uniform sampler2D nextBathicMap;
layout(set = 2, binding = 11) uniform sampler2D nextSkyMap;
layout(set = 2, binding = 12) uniform sampler2D foamMap;

const float kWaterPerPattern = 10.0;  // metres

vec3 graded(vec3 color, float saturation, vec3 overlay, float amount) {
  float gray = dot(color, vec3(0.2126, 0.7152, 0.0722));
  return mix(max(mix(vec3(gray), color, saturation), 0.0), overlay, amount);
}

vec3 bathic(float depth, float illumination) {
  vec2 at = vec2(depth, illumination);
  vec3 color = texture(bathicMap, at).rgb;
  if (ocean.next > 0.0) color = mix(color, texture(nextBathicMap, at).rgb, ocean.next);
  return graded(color, ocean.saturation, ocean.overlay, ocean.overlayAmount);
}

// Equations 27 to 30: the texture's three patterns in turn.
float liveTexture(vec3 t, vec2 place) {
  float phase = ocean.phase + ocean.liveSpread * dot(place, vec2(0.8, 0.6));
  float wave = dot(t, vec3(0.707, 0.0, -0.707)) * cos(phase) + dot(t, vec3(-0.408, 0.816, -0.408)) * sin(phase);
  return clamp(0.5 + wave, 0.0, 1.0);
}

// `wave`: height in deviations, Jacobian, and how far the face is turned against the wind.
void paintOcean(vec2 uv, vec3 wave, vec3 world, vec3 normal, float fadeEnd, out vec3 lit, out vec3 shadowed) {
  vec2 dSdu, dSdv;
  surfaceTangents(painted.tangents, inTangentU, inTangentV, inPoint, uv, viewIndex(), dSdu, dSdv);
  MetaTextureChoice chosen = metaTextureChoose(painted.meta, dSdu, dSdv, 1.0);
  vec4 value = metaTextureSample(painted.meta, chosen, paintedExample, uv, vec2(0.0), gl_FragCoord.xy);
  if (painted.meta.contrast == 2) value = metaTextureHistogram(paintedInverse, value);

  // Both eyes mirror the same sky: what is hand-cut must not rival.
  vec3 eye = kViewCount > 1 ? 0.5 * (frame.views[0].eye + frame.views[1].eye) : frame.views[0].eye;
  vec3 toEye = eye - world;
  float distance = length(toEye);
  toEye /= distance;
  float stroke = liveTexture(value.rgb, uv * kWaterPerPattern);
  stroke = mix(stroke, 0.5, 0.8 * smoothstep(0.5 * fadeEnd, 3.0 * fadeEnd, distance));

  float depth = 0.42 + 0.14 * clamp(wave.x, -2.0, 2.0) + ocean.dither * (stroke - 0.5);
  float shift = ocean.lightDither * (stroke - 0.5);
  lit = bathic(depth, 0.8 + shift);
  shadowed = bathic(depth, 0.15 + shift);

  vec3 ray = reflect(-toEye, normal);
  float elevation = asin(clamp(abs(ray.y), 0.0, 1.0)) * 0.6366198;
  vec2 sun = frame.toLight.xz, across = ray.xz;
  float azimuth = 0.5 - 0.5 * dot(across, sun) * inversesqrt(max(dot(across, across) * dot(sun, sun), 1e-12));
  vec4 sky = texture(skyMap, vec2(azimuth, elevation));
  if (ocean.next > 0.0) sky = mix(sky, texture(nextSkyMap, vec2(azimuth, elevation)), ocean.next);
  sky.rgb = graded(sky.rgb, ocean.skySaturation, ocean.skyOverlay, ocean.skyOverlayAmount);
  float reflected = ocean.reflection * sky.a;
  float shown = clamp((reflected - 0.5 + 0.9 * (stroke - 0.5)) * 4.0 + 0.5, 0.0, 1.0);
  shown *= min(10.0 * reflected, 1.0);  // not even the strongest stroke mirrors what is not there
  lit = mix(lit, sky.rgb, shown);
  shadowed = mix(shadowed, mix(shadowed, sky.rgb, 0.5), shown);
  lit = sqrt(lit), shadowed = sqrt(shadowed);

  float drawn = clamp((ocean.foamStart - wave.y) * 2.5, 0.0, 1.0);
  float cover = ocean.foam * 1.6 * drawn * (0.35 + 0.65 * clamp(wave.z, 0.0, 1.0));
  float hole = metaTextureSample(painted.meta, chosen, foamMap, uv, vec2(0.0), gl_FragCoord.xy).r;
  float foam = clamp((cover - hole) * 40.0, 0.0, 1.0) * step(1e-4, cover);
  lit = mix(lit, ocean.foamLit, foam);
  shadowed = mix(shadowed, ocean.foamShadowed, foam);
}

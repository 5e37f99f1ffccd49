// The water's surface at any place: waves between the mesh's points, and what decorations add (paper 000, section
// 6.2). Includers declare the buffer of `OceanField field; OceanPoint points[];` first.
//
// All that a decoration does is a function of the place alone. Its own mesh and the ocean's, which is pushed down below
// it, are painted by the same function; so where the one ends, and where it has holes, nothing shows.
#ifndef SCUMBLE_WATER_GLSL
#define SCUMBLE_WATER_GLSL

OceanPoint oceanPoint(ivec2 at) {
  // By a quotient: what % gives for negative numbers is undefined in Vulkan, and differs in fact.
  at -= at / field.grid * field.grid;
  at += field.grid * ivec2(lessThan(at, ivec2(0)));
  return points[at.y * field.grid + at.x];
}

// On the triangles that the ocean's finest mesh has (features/ocean/waves/surface.h).
OceanPoint wavesAt(vec2 place) {
  vec2 at = (place + field.within) / field.cell;
  ivec2 corner = ivec2(floor(at)) + field.travelled;
  vec2 f = fract(at);
  OceanPoint a = oceanPoint(corner), d = oceanPoint(corner + 1),
             b = oceanPoint(corner + (f.x > f.y ? ivec2(1, 0) : ivec2(0, 1)));
  vec3 share = vec3(1.0 - max(f.x, f.y), abs(f.x - f.y), min(f.x, f.y));
  OceanPoint point;
  point.displacement = share.x * a.displacement + share.y * b.displacement + share.z * d.displacement;
  point.jacobian = share.x * a.jacobian + share.y * b.jacobian + share.z * d.jacobian;
  point.normal = normalize(share.x * a.normal + share.y * b.normal + share.z * d.normal);
  return point;
}

// How much of the waves there is at a distance from their middle.
float wavesWhole(float away) {
  return 1.0 - smoothstep(field.fadeStart, field.fadeEnd, away);
}

struct Decorated {
  vec3 displacement;  // beside the waves', metres
  float crest;        // counts in the colours like a wave so many reliefs high
  float cover;        // of foam, before it is eroded
  float calm;         // how far strokes are suppressed, from 0 to 1
  float outside;      // metres to the nearest place at which there is anything; below 0 there is
  float room;         // how far the mesh is pushed down for meshes of the scene, in parts of the whole
};

// The decoration in question, where it lies: a copy would take all of its points along.
#define OF field.decorations[index]

// A wake's half widths at a distance behind the bow: of its arms' middle, and of the arms.
float wakeArm(int index, float behind) {
  float s = max(behind, 0.0);
  return OF.halfBeam * sqrt(min(s / (0.5 * OF.hull), 1.0)) + OF.spread * s;
}
float wakeThickness(int index, float behind) {
  return 0.16 * OF.halfBeam + 0.04 * max(behind, 0.0);
}
float wakeHalfWidth(int index, float behind) {
  return wakeArm(index, behind) + 2.0 * wakeThickness(index, behind);
}

Decorated wakeAt(int index, vec2 place) {
  float across = 1e9, s = 0.0, amount = 0.0, age = 0.0;
  int count = OF.count;
  vec4 b = OF.points[0];
  for (int i = 0; i + 1 < count; ++i) {
    vec4 a = b;
    b = OF.points[i + 1];
    vec2 way = b.xy - a.xy;
    float f = dot(place - a.xy, way) / max(dot(way, way), 1e-12);
    if (i > 0) f = max(f, 0.0);
    if (i + 2 < count) f = min(f, 1.0);
    float there = length(place - a.xy - f * way);
    if (there < across)
      across = there, s = mix(a.z, b.z, f), amount = mix(a.w, b.w, clamp(f, 0.0, 1.0)),
      age = clamp((float(i) + f) / float(count - 1), 0.0, 1.0);
  }
  float arm = wakeArm(index, s), thickness = wakeThickness(index, s), full = wakeHalfWidth(index, s);
  float x = (across - arm) / thickness;
  float onArm = exp(-x * x);
  float begins = smoothstep(-0.3 * OF.halfBeam, 0.3 * OF.halfBeam, s);
  float fade = amount * begins * (1.0 - smoothstep(0.45, 1.0, age));
  float astern = smoothstep(0.75 * OF.hull, 1.05 * OF.hull, s);
  float churned = astern * (1.0 - smoothstep(0.25, 1.0, across / (0.9 * OF.halfBeam + 0.04 * max(s - OF.hull, 0.0))));
  // Along the hull, and less of it the further back: a wedge that ends as the arm leaves the stern.
  float beside = (1.0 - smoothstep(0.2 * OF.hull, 1.5 * OF.hull, s)) * (1.0 - smoothstep(arm, arm + thickness, across));

  Decorated w;
  float lifts = onArm * (exp(-max(s, 0.0) / (1.2 * OF.hull)) + exp(-9.0 * s * s / (OF.hull * OF.hull)));
  w.displacement = vec3(0.0, fade * OF.height * OF.rise * (lifts - 0.3 * churned * exp(-4.0 * age)), 0.0);
  w.crest = fade * (0.9 * onArm + 0.3 * churned * exp(-2.0 * age));
  w.cover = fade * OF.foam * max(max(1.15 * onArm * exp(-2.2 * age), 0.95 * churned * exp(-2.6 * age)), 0.95 * beside);
  w.calm = amount * begins * (1.0 - smoothstep(0.6, 1.0, age)) * (1.0 - smoothstep(arm, full, across));
  w.outside = max(max(across - full, -0.4 * OF.halfBeam - s), s - OF.points[OF.count - 1].z);
  w.room = 0.0;
  return w;
}

// Rings that run outward and stay behind: height from -1 to 1, and how much of it there is.
vec2 ringsAt(float away, float front, float crests, float between) {
  float behind = (front - away) / between;  // in rings
  float there = smoothstep(-0.5, 0.5, behind) * (1.0 - smoothstep(crests - 1.5, crests - 0.5, behind));
  return vec2(cos(6.2831853 * behind), there * smoothstep(0.0, 0.5 * between, away));
}

// All within the foremost ring: what else there is to be seen of the water would move another way.
float calmAt(float away, float front, float between, float age) {
  return smoothstep(0.0, 0.08, age) * (1.0 - smoothstep(0.75, 1.0, age)) *
         (1.0 - smoothstep(front, front + 0.5 * between, away));
}

Decorated ripplesAt(int index, vec2 place) {
  Decorated w = Decorated(vec3(0.0), 0.0, 0.0, 0.0, 1e9, 0.0);
  float between = OF.radius / (2.0 * OF.crests + 1.0);
  for (int i = 0; i < OF.count; ++i) {
    vec4 from = OF.points[i];
    float age = from.z / OF.lasts, front = OF.radius * age, away = length(place - from.xy);
    vec2 rings = ringsAt(away, front, OF.crests, between);
    float fade = smoothstep(0.0, 0.08, age) * (1.0 - age) * rings.y;
    w.displacement.y += fade * OF.height * 0.09 * between * rings.x;
    w.crest += 2.4 * fade * rings.x;
    w.cover = max(w.cover, 0.85 * OF.foam * fade * pow(max(rings.x, 0.0), 3.0));
    w.calm = max(w.calm, calmAt(away, front, between, age));
    w.outside = min(w.outside, away - front - 0.5 * between);
  }
  return w;
}

Decorated splashAt(int index, vec2 place) {
  Decorated w = Decorated(vec3(0.0), 0.0, 0.0, 0.0, 1e9, 0.0);
  float highest = 0.45 * OF.radius * OF.height;
  float falls = 2.0 * sqrt(2.0 * max(highest, 0.02 * OF.radius) / 9.81);  // seconds from the water to the water
  for (int i = 0; i < OF.count; ++i) {
    vec4 from = OF.points[i];
    vec2 apart = place - from.xy;
    float away = length(apart), age = from.z / OF.lasts, flight = min(from.z / falls, 1.0);
    // The crown: thin, jagged, leaning outward.
    float ring = OF.radius * mix(0.35, 0.9, flight), thin = 0.08 * OF.radius;
    float x = (away - ring) / thin, onCrown = exp(-x * x), turn = atan(apart.y, apart.x) + 6.2831853 * from.w;
    float jags = 0.5 + 0.3 * sin(11.0 * turn + 1.5 * sin(3.0 * turn)) + 0.2 * sin(17.0 * turn + 2.0);
    float up = 4.0 * flight * (1.0 - flight);
    float rises = highest * up * onCrown * jags;
    w.displacement.y += rises;
    w.displacement.xz += away > 1e-6 ? apart / away * 0.3 * rises : vec2(0.0);
    // What falls back whitens the water, and sends rings away.
    float whitened = 1.0 - smoothstep(0.1, 1.0, away / (OF.radius * mix(0.55, 1.2, flight)));
    float fade = 1.0 - smoothstep(0.0, 0.7, age);
    w.cover = max(w.cover, OF.foam * max(smoothstep(0.0, 0.3, up) * onCrown * (1.25 - 0.7 * jags),
                                        0.9 * smoothstep(0.0, 0.1, flight) * whitened * fade));
    float between = 0.3 * OF.radius, since = max(age - 0.5 * falls / OF.lasts, 0.0);
    float front = OF.radius * (0.6 + 1.4 * since);
    vec2 rings = ringsAt(away, front, OF.crests, between);
    float still = smoothstep(0.0, 0.05, since) * (1.0 - age) * (1.0 - age) * rings.y;
    w.displacement.y += still * OF.height * 0.08 * between * rings.x;
    w.crest += 2.0 * still * rings.x + up * onCrown;
    w.cover = max(w.cover, 0.6 * OF.foam * still * pow(max(rings.x, 0.0), 4.0));
    w.calm = max(w.calm, calmAt(away, max(front, OF.radius), between, age));
    w.outside = min(w.outside, away - max(front + 0.5 * between, 1.3 * OF.radius));
  }
  return w;
}

// What all decorations add at a place. Loops where one would write `if`, since CPU drivers execute both sides of those.
Decorated decoratedAt(vec2 place) {
  Decorated all = Decorated(vec3(0.0), 0.0, 0.0, 0.0, 1e9, 0.0);
  for (int index = 0; index < field.decorationCount; ++index) {
    bool isNear = OF.count > 0 && length(place - OF.center) <= OF.reach + 4.0 * field.cell;
    for (; isNear; isNear = false) {
      Decorated one = all;
      for (bool isWake = OF.kind == kWake; isWake; isWake = false) one = wakeAt(index, place);
      for (bool isRipples = OF.kind == kRipples; isRipples; isRipples = false) one = ripplesAt(index, place);
      for (bool isSplash = OF.kind == kSplash; isSplash; isSplash = false) one = splashAt(index, place);
      all.displacement += OF.amount * one.displacement;
      all.crest += OF.amount * one.crest;
      all.cover = max(all.cover, OF.amount * one.cover);
      all.calm = max(all.calm, OF.amount * one.calm);
      all.outside = min(all.outside, one.outside);
    }
  }
  all.cover = max(1.04 * all.cover - 0.04, 0.0);  // nothing where there is next to nothing
  // Strokes go before a mesh of the scene begins; its water sinks within, so that none is missing beside it.
  for (int i = 0; i < field.zoneCount; ++i) {
    WaterZone zone = field.zones[i];
    vec2 from = place - zone.center;
    vec2 within = zone.halves - abs(vec2(dot(from, zone.along), dot(from, vec2(-zone.along.y, zone.along.x))));
    float inside = min(within.x, within.y), least = min(zone.halves.x, zone.halves.y);
    all.calm = max(all.calm, zone.calm * smoothstep(-min(least, field.cell), 0.0, inside));
    all.room = max(all.room, zone.room * smoothstep(0.0, min(0.6 * least, 1.5 * field.cell), inside));
  }
  return all;
}

// How far the ocean's own mesh is pushed down: whole wherever one of its triangles may reach below a decoration.
float pushedDown(Decorated here) {
  return field.push * max(1.0 - smoothstep(1.5, 2.5, here.outside / field.cell), here.room);
}

// How far hulls take water down whose surface is there: metres from the middle of calm water.
float takenDown(vec3 surface) {
  float down = 0.0;
  for (int index = 0; index < field.basinCount; ++index) {
    bool isNear = length(surface.xz - field.basins[index].center) < field.basins[index].reach;
    for (; isNear; isNear = false) {
      float limit = 1e9;
      for (int i = 0; i < field.basins[index].count; ++i) {
        vec3 rim = field.basins[index].rim[i];
        limit = min(limit, rim.y + kBasinSlope * max(length(surface.xz - rim.xz) - field.basins[index].margin, 0.0));
      }
      down = max(down, clamp(surface.y - limit, 0.0, field.basins[index].most));
    }
  }
  return down;
}

// From a decoration's mesh to its place. Of a wake: how far along it, from 0 to 1, and across, from -1 to 1; of the
// others the same in polar coordinates, outward and around. The outer part of the mesh lies where nothing is drawn.
vec2 decorationPlace(int index, vec2 local) {
  if (OF.count == 0) return OF.center;
  const float kInner = 0.85;
  float margin = 3.0 * field.cell, part = abs(OF.kind == kWake ? local.y : local.x);
  float inner = min(part / kInner, 1.0), outer = max(part - kInner, 0.0) / (1.0 - kInner) * margin;
  if (OF.kind != kWake) {
    float turn = 3.14159265 * local.y;
    return OF.center + (inner * OF.reach + outer) * vec2(cos(turn), sin(turn));
  }
  float s = mix(-0.4 * OF.halfBeam - margin, OF.points[OF.count - 1].z + margin, pow(local.x, 1.4));
  float across = sign(local.y) * (inner * wakeHalfWidth(index, s) + outer);
  vec2 place = OF.center;
  for (int i = 0; i + 1 < OF.count; ++i) {
    vec4 a = OF.points[i], b = OF.points[i + 1];
    vec2 way = b.xy - a.xy;
    if ((i == 0 || s >= a.z) && (i + 2 == OF.count || s < b.z)) {
      vec2 on = a.xy + (s - a.z) / max(b.z - a.z, 1e-6) * way;
      place = on + across * vec2(-way.y, way.x) / max(length(way), 1e-6);
    }
  }
  return place;
}
#undef OF
#endif

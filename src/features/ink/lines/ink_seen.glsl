// How full a line is at a place on its edge, by the depths beside it, and which of its pixels something nearer covers.
#ifndef SCUMBLE_INK_SEEN_GLSL
#define SCUMBLE_INK_SEEN_GLSL
#include "../../../shading/frame.glsl"
#include "../fullness.shared.h"

layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;

// An edge on the screen.
struct InkSpine {
  vec4 ends;     // pixels
  vec2 depths;   // depth-buffer values at both
  vec2 outward;  // away from the form
  vec4 slopes;   // as LineRecord has them
  vec2 turn, reach;
  bool isOutline;
  uint seen;  // as LineRecord has it
};

// What is seen so many pixels beyond an edge, or before it where that is below 0: how far away it is, and inkBefore().
vec2 besideAt(float away, InkSpine s, vec2 spine, float distance, float pixel, int view) {
  vec2 slope = away > 0.0 ? s.slopes.zw : s.slopes.xy, place = spine + away * s.outward;
  float parallel = VIEW_FIELD(orthographic, view);
  vec2 at = floor(clamp(place, vec2(0.0), frame.imageSize - 1.0));
  float seen = eyeDepth(texelFetch(depth, ivec3(at, view), 0).r, view);
  float expected = inkLinear(inkLinear(distance, parallel) + dot(slope, at + ink.depthAt - spine), parallel);
  return vec2(seen, inkBefore(distance, expected, seen, pixel, abs(away)));
}

// How a line is seen at a place on its edge.
struct LineSeen {
  float fullness;  // a factor on its width
  float hidden;    // whether something hides it there, from 0 to 1
};
LineSeen lineSeenOnce(InkSpine s, float t, float size, float radius, int view) {
  vec2 place = mix(s.ends.xy, s.ends.zw, t);
  InkPlace p;
  float end = eyeDepth(mix(s.depths.x, s.depths.y, clamp(t, 0.0, 1.0)), view);
  p.pixel = metresOfPixel(end, view);
  p.distance = inkNoFurther(eyeDepth(inkDepthAlong(s.depths.x, s.depths.y, t), view), end, t, p.pixel);
  vec2 beyond = besideAt(kInkBeyond, s, place, p.distance, p.pixel, view),
       farther = besideAt(kInkFarBeyond, s, place, p.distance, p.pixel, view),
       before = besideAt(-kInkBefore, s, place, p.distance, p.pixel, view),
       inside = besideAt(-kInkFarBefore, s, place, p.distance, p.pixel, view);
  p.beyond = max(beyond.x, farther.x);
  p.radius = radius;
  p.turn = s.turn;
  p.reach = inkReach(t, s.reach, size);
  p.isOutline = s.isOutline ? 1u : 0u;
  p.hidden = inkHidden(vec2(beyond.y, farther.y), vec2(before.y, inside.y), p.isOutline);
  LineSeen seen;
  seen.hidden = smoothstep(1.0, 2.0, p.hidden);
  seen.fullness = inkSeen(t, s.seen) * inkFullness(p, frame.sceneRadius, ink.fade, ink.outer);
  return seen;
}

// The mean of three places. `t`: along it, 0 to 1; `radius`: of the line, pixels.
LineSeen lineSeenAt(InkSpine s, float t, float radius, int view) {
  float size = max(distance(s.ends.xy, s.ends.zw), 1e-3);
  LineSeen mean = LineSeen(0.0, 0.0);
  for (int i = -1; i <= 1; ++i) {
    LineSeen one = lineSeenOnce(s, t + float(i) * kInkMeanOver / size, size, radius, view);
    mean.fullness += one.fullness / 3.0, mean.hidden += one.hidden / 3.0;
  }
  return mean;
}

// By how much a place on the screen is nearer than one of an edge, pixels, as what they measure there.
float riseAt(vec2 place, vec2 spine, float distance, float pixel, int view, out float away) {
  vec2 at = floor(clamp(place, vec2(0.0), frame.imageSize - 1.0));
  away = max(length(at + ink.depthAt - spine), 0.5);
  return (distance - eyeDepth(texelFetch(depth, ivec3(at, view), 0).r, view)) / pixel;
}

// What lies around a place on an edge in one direction: whether something covers a line there.
//
// What is no nearer than where the edge's own surface leads to is that, or what it goes over into. And what rises from the edge
// towards the eye covers nothing of it: a round form before its outline at first more than later on, the ground before a box
// evenly, a hollow's sides slowly at first. It is at the edge itself, or ends there; and of what stands before the edge either is
// not so, or it is about as near everywhere.
const float kNearPlace = 1.5, kFarPlace = 3.0;  // pixels from the edge, at least
struct InkCover {
  vec2 spine, direction, slope;
  float distance, pixel;
  float near, nearAway;
  bool begins;
};
InkCover coverTowards(InkSpine s, vec2 spine, vec2 direction, float distance, int view) {
  InkCover c;
  c.spine = spine, c.direction = direction, c.slope = dot(direction, s.outward) > 0.0 ? s.slopes.zw : s.slopes.xy;
  c.distance = distance, c.pixel = metresOfPixel(distance, view);
  float onAway, oppositeAway;
  c.near = riseAt(spine + kNearPlace * direction, spine, distance, c.pixel, view, c.nearAway);
  float opposite = riseAt(spine - kNearPlace * direction, spine, distance, c.pixel, view, oppositeAway);
  float on = riseAt(spine, spine, distance, c.pixel, view, onAway);
  c.begins = opposite < 2.0 * kInkTolerance || on < 2.0 * kInkTolerance + 1.2 * c.near * onAway / c.nearAway;
  return c;
}
// Whether that is so of a place in the direction, from 0 to 1; `radius`: of the line, pixels.
float coveredAt(InkCover c, vec2 place, float radius, int view) {
  float away, far = riseAt(place, c.spine, c.distance, c.pixel, view, away);
  float covered = smoothstep(1.0, 2.0, far / (2.0 * max(radius, 1.0)));
  if (covered <= 0.0) return 0.0;
  float parallel = VIEW_FIELD(orthographic, view);
  // Within the pixel as well.
  float leads = dot(c.slope, place - c.spine) + mix(0.7, -0.7, parallel) * length(c.slope);
  float own = inkLinear(inkLinear(c.distance, parallel) + leads, parallel);
  if (far < 1.1 * (c.distance - own) / c.pixel + 2.0 * kInkTolerance) return 0.0;
  if (away < kFarPlace) far = riseAt(c.spine + kFarPlace * c.direction, c.spine, c.distance, c.pixel, view, away);
  float times = away / c.nearAway, rise = max(c.near, 0.0);
  bool rises = far > 1.05 * rise * sqrt(sqrt(times)) && far < 1.3 * rise * times * times + kInkTolerance;
  return c.begins && rises ? 0.0 : covered;
}

// How far something that covers the line is away beside it, at most `most` pixels.
float spaceBeside(InkCover c, float most, float radius, int view) {
  float step = max(1.0, most / 8.0), space = 0.5;
  for (; space < most; space += step)
    if (coveredAt(c, c.spine + (space + 0.5 * step) * c.direction, radius, view) > 0.5) return space;
  return most;
}
#endif

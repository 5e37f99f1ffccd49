// The palette's colour that is nearest to another one. Whoever includes it has kColors, and defines PALETTE, an array of
// at least as many.
vec3 nearestColor(vec3 lab) {
  vec3 nearest = PALETTE[0];
  float least = dot(lab - nearest, lab - nearest);
  for (int i = 1; i < kColors; ++i) {
    vec3 away = lab - PALETTE[i];
    float squared = dot(away, away);
    nearest = squared < least ? PALETTE[i] : nearest;
    least = min(squared, least);
  }
  return nearest;
}

// The same with edges that are no stairs: over a part of the way to the next one, both are mixed.
vec3 nearestColorSoftly(vec3 lab) {
  const float kPart = 0.02;
  vec3 nearest = PALETTE[0], second = nearest;
  float least = 1e9, more = 1e9;
  for (int i = 0; i < kColors; ++i) {
    float away = distance(lab, PALETTE[i]);
    // The last one may be there several times.
    bool isNearer = away < least, isSecond = !isNearer && away > least && away < more;
    second = isNearer ? nearest : isSecond ? PALETTE[i] : second;
    more = isNearer ? least : isSecond ? away : more;
    nearest = isNearer ? PALETTE[i] : nearest;
    least = min(least, away);
  }
  float part = least / max(least + more, 1e-6);
  return mix(nearest, second, 0.5 * smoothstep(0.5 - kPart, 0.5, part));
}

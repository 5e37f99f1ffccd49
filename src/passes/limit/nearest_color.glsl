// The palette's colour that is nearest to another one. Whoever includes it has `u.colors` and kColors.
vec3 nearestColor(vec3 lab) {
  vec3 nearest = u.colors[0];
  float least = dot(lab - nearest, lab - nearest);
  for (int i = 1; i < kColors; ++i) {
    vec3 away = lab - u.colors[i];
    float squared = dot(away, away);
    nearest = squared < least ? u.colors[i] : nearest;
    least = min(squared, least);
  }
  return nearest;
}

// shading.glsl — How a surface looks in the light of a lamp over the viewer's shoulder.

// Of the triangle itself, in the view, towards the viewer. `shape_position` is the position in the view without
// the mesh's own place there, which would leave no digits for differences far away.
vec3 flat_normal(vec3 shape_position, vec3 view_position) {
  vec3 right = dFdx(shape_position), down = dFdy(shape_position);
  float unit = max(length(right), length(down));
  if (unit == 0) return vec3(0, 0, 1);
  vec3 across = cross(right / unit, down / unit);
  float size = length(across);
  vec3 normal = size > 0 ? across / size : vec3(0, 0, 1);
  return dot(normal, view_position) > 0 ? -normal : normal;
}

// `mean_normal` is the mean of the normals around a corner: the shorter, the sharper the edges there, where the
// triangle's own normal counts.
vec3 shaded_normal(vec3 shape_position, vec3 view_position, vec3 mean_normal) {
  vec3 own = flat_normal(shape_position, view_position);
  float size = length(mean_normal);
  float smoothness = smoothstep(0.8, 0.92, size);
  if (smoothness == 0) return own;
  vec3 mean = mean_normal / size;
  return normalize(mix(own, dot(mean, own) < 0 ? -mean : mean, smoothness));
}

// 1 where the surface faces the lamp.
float shade(vec3 normal) {
  const vec3 to_lamp = normalize(vec3(0.3, 0.45, 1));
  return 0.35 + 0.65 * max(0, dot(normal, to_lamp));
}

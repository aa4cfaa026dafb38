// What the passes of the denoiser share: neighbours on the sphere, likeness of two pixels (render/filter/filter_simd.h).

/// Columns from a row's pixels to their neighbours `step` rows away.
int StepX(int y, int step) {
  if (camera.separable == 0) return step;
  const int most = max(1, int(camera.width) / 8);
  return min(most, int(floor(min(1e6, float(step) * camera.row_tables.v[camera.height + uint(y)]) + 0.5)));
}

/// How many pixels of the row are as wide as one is high.
int PixelsAcross(int y) {
  if (camera.separable == 0) return 1;
  return max(1, int(floor(min(camera.row_tables.v[camera.height + uint(y)], float(camera.width) / 4.0) + 0.5)));
}

/// Index of the pixel (dx, dy) from a pixel, over poles and seam; -1 = none.
int PixelAt(int x, int y, int dx, int dy) {
  const int w = int(camera.width), h = int(camera.height);
  int row = y + dy, column = x + dx;
  if (camera.separable == 0) return row < 0 || row >= h || column < 0 || column >= w ? -1 : row * w + column;
  if (row < 0 || row >= h) {
    row = row < 0 ? -1 - row : 2 * h - 1 - row;
    if (row < 0 || row >= h) return -1;
    column += w / 2;
  }
  return row * w + (column + 2 * w) % w;
}

/// What a pixel compares its neighbours with.
struct Center {
  uint id;
  vec3 g, normal;
  float base, plane, inverse_thickness;
};

Center MakeCenter(uint i, float loose, float step) {
  Center c;
  c.id = GetWord(kId, i);
  if (Get(kRange, i) == 0.0) c.id = kNoSurface;
  const vec3 p = Get3(kPlace, i);
  c.g = Get3(kShadingNormal, i);
  c.plane = dot(c.g, p);
  const float sharpness = lerp1(kFilterLooseNormal / 8.0, kFilterNormal / 8.0, (1.0 - loose) * (1.0 - loose));
  c.normal = c.g * sharpness;
  c.base = 1.0 - sharpness;
  // Over the distance.
  const float thickness = (1.0 + (kFilterLoosePlane - 1.0) * loose) * (camera.cone_angle * (1.0 + kFilterSlope * step));
  c.inverse_thickness = (1.0 / 16.0) / max(dot(p, p) * (thickness * thickness), kFilterThinnest);
  return c;
}

/// 1 - x / 8 of geometry alone.
float Likeness(Center c, uint i) {
  const float away = dot(c.g, Get3(kPlace, i)) - c.plane;
  return c.base + dot(c.normal, Get3(kShadingNormal, i)) - away * away * c.inverse_thickness;
}

float Power8(float t) {
  t = max(t, 0.0);
  t = t * t;
  t = t * t;
  return t * t;
}

/// Whether a pixel shows the surface of `c`.
bool SameSurface(Center c, uint i) { return GetWord(kId, i) == c.id && Get(kRange, i) != 0.0; }

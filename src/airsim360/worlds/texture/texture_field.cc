#include "airsim360/worlds/texture/texture_field.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_synth.h"

namespace airsim360::internal {
namespace {

float Quintic(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// About normal with mean 0 and standard deviation 1.
float HashNormal(uint32_t a, uint32_t b) { return 2 * (HashUnit(a, b, 1) + HashUnit(a, b, 2) + HashUnit(a, b, 3) - 1.5f); }

// Adds one octave of gradient noise. Along a row the noise between two lattice columns is a blend of two
// straight lines, whose coefficients depend on the row alone: few operations a texel.
void AddOctave(Field& out, uint32_t seed, int cells_x, int cells_y, float amplitude) {
  const int n = out.size;
  const auto columns = static_cast<size_t>(cells_x) + 1;
  std::vector<int> cell(n);
  std::vector<float> t(n), weight(n);
  for (int x = 0; x < n; ++x) {
    const float u = (static_cast<float>(x) + 0.5f) * static_cast<float>(cells_x) / static_cast<float>(n);
    cell[x] = std::min(cells_x - 1, static_cast<int>(u));
    t[x] = u - static_cast<float>(cell[x]);
    weight[x] = Quintic(t[x]);
  }
  std::vector<float> gx(columns * (static_cast<size_t>(cells_y) + 1)), gy(gx.size());
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      const float angle = 2 * kPiF * HashUnit(seed, static_cast<uint32_t>(i % cells_x), static_cast<uint32_t>(j % cells_y));
      gx[static_cast<size_t>(j) * columns + i] = std::cos(angle);
      gy[static_cast<size_t>(j) * columns + i] = std::sin(angle);
    }
  }
  std::vector<float> slope(columns), offset(columns);
  for (int y = 0; y < n; ++y) {
    const float v = (static_cast<float>(y) + 0.5f) * static_cast<float>(cells_y) / static_cast<float>(n);
    const int j = std::min(cells_y - 1, static_cast<int>(v));
    const float s = v - static_cast<float>(j), w = Quintic(s);
    const float *low_x = &gx[static_cast<size_t>(j) * columns], *low_y = &gy[static_cast<size_t>(j) * columns];
    const float *high_x = low_x + columns, *high_y = low_y + columns;
    for (size_t i = 0; i < columns; ++i) {
      slope[i] = amplitude * Mix(low_x[i], high_x[i], w);
      offset[i] = amplitude * Mix(low_y[i] * s, high_y[i] * (s - 1), w);
    }
    float* row = &out.values[static_cast<size_t>(y) * static_cast<size_t>(n)];
    for (int x = 0; x < n; ++x) {
      const int i = cell[x];
      const float left = slope[i] * t[x] + offset[i], right = slope[i + 1] * (t[x] - 1) + offset[i + 1];
      row[x] += left + weight[x] * (right - left);
    }
  }
}

// Sliding mean of 2 r + 1 texels along rows.
void BoxRows(const Field& from, Field& to, int r) {
  const int n = from.size;
  const float scale = 1.0f / static_cast<float>(2 * r + 1);
  for (int y = 0; y < n; ++y) {
    double sum = 0;
    for (int x = -r; x <= r; ++x) sum += from.At(x, y);
    for (int x = 0; x < n; ++x) {
      to.values[from.Index(x, y)] = static_cast<float>(sum) * scale;
      sum += from.At(x + r + 1, y) - from.At(x - r, y);
    }
  }
}

void BoxColumns(const Field& from, Field& to, int r) {
  const int n = from.size;
  const float scale = 1.0f / static_cast<float>(2 * r + 1);
  std::vector<double> sum(n, 0.0);
  for (int y = -r; y <= r; ++y) {
    for (int x = 0; x < n; ++x) sum[x] += from.At(x, y);
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      to.values[from.Index(x, y)] = static_cast<float>(sum[x]) * scale;
      sum[x] += from.At(x, y + r + 1) - from.At(x, y - r);
    }
  }
}

// One stone: faces around a centre, a rotation, a foot.
struct Stone {
  float x, y, radius, foot, tilt_x, tilt_y;
  float face_x[6], face_y[6], axis_x, axis_y, narrow;
  uint32_t id;
};

Stone MakeStone(int size, float scale, const StoneOptions& o, uint32_t seed, uint32_t k) {
  const auto h = [&](uint32_t c) { return HashUnit(seed, k, c); };
  Stone s;
  const float metres = o.smallest * std::pow(o.largest / o.smallest, std::pow(h(1), 1.3f));
  s.radius = metres * scale;
  s.x = h(2) * static_cast<float>(size);
  s.y = h(3) * static_cast<float>(size);
  s.foot = Mix(o.lowest, o.highest, h(4));
  s.tilt_x = o.tilt * HashNormal(seed, 4 * k + 1);
  s.tilt_y = o.tilt * HashNormal(seed, 4 * k + 2);
  const float turn = 2 * kPiF * h(5);
  for (uint32_t i = 0; i < 6; ++i) {
    const float a = turn + (static_cast<float>(i) + 0.7f * (h(10 + i) - 0.5f)) * (kPiF / 3);
    const float reach = 1 / (s.radius * (0.62f + 0.38f * h(20 + i)));
    s.face_x[i] = std::cos(a) * reach;
    s.face_y[i] = std::sin(a) * reach;
  }
  s.axis_x = std::cos(turn) / s.radius;
  s.axis_y = std::sin(turn) / s.radius;
  s.narrow = 1 / (0.7f + 0.3f * h(6));
  s.id = static_cast<uint32_t>(k * 2 + 1);
  return s;
}

void DropStone(StoneField& out, const Stone& s, float scale, const StoneOptions& o) {
  const int x0 = static_cast<int>(std::floor(s.x - s.radius)), x1 = static_cast<int>(std::ceil(s.x + s.radius));
  const int y0 = static_cast<int>(std::floor(s.y - s.radius)), y1 = static_cast<int>(std::ceil(s.y + s.radius));
  const float rise = s.radius / scale * o.relief;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x) - s.x, dy = static_cast<float>(y) - s.y;
      float faces = 0;
      for (int k = 0; k < 6; ++k) faces = std::max(faces, dx * s.face_x[k] + dy * s.face_y[k]);
      const float ex = dx * s.axis_x + dy * s.axis_y, ey = (dy * s.axis_x - dx * s.axis_y) * s.narrow;
      const float d = Mix(std::sqrt(ex * ex + ey * ey), faces, o.angular);
      if (d >= 1) continue;
      const float profile = o.angular > 0.4f ? 1 - d * d * d * d : 1 - d * d;
      const float h = s.foot + rise * profile + (s.tilt_x * dx + s.tilt_y * dy) / scale;
      const size_t i = out.height.Index(x, y);
      if (h <= out.height[i]) continue;
      out.height[i] = h;
      out.id[i] = s.id;
      out.rim[i] = d;
    }
  }
}

// Distance to one straight piece, kept where it is less than what is there.
void AddSegment(Field& distance, float ax, float ay, float bx, float by, float reach) {
  const float ex = bx - ax, ey = by - ay, inverse = 1 / std::max(1e-6f, ex * ex + ey * ey);
  const int x0 = static_cast<int>(std::floor(std::min(ax, bx) - reach)), x1 = static_cast<int>(std::ceil(std::max(ax, bx) + reach));
  const int y0 = static_cast<int>(std::floor(std::min(ay, by) - reach)), y1 = static_cast<int>(std::ceil(std::max(ay, by) + reach));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x) - ax, dy = static_cast<float>(y) - ay;
      const float t = std::clamp((dx * ex + dy * ey) * inverse, 0.0f, 1.0f);
      float& d = distance[distance.Index(x, y)];
      d = std::min(d, std::hypot(dx - t * ex, dy - t * ey));
    }
  }
}

}  // namespace

Field FractalField(int size, uint32_t seed, int cells_x, int cells_y, int octaves, float gain) {
  Field out(size);
  float amplitude = 1;
  for (int k = 0; k < octaves && std::max(cells_x, cells_y) <= size / 2; ++k) {
    AddOctave(out, seed * 31u + static_cast<uint32_t>(k), cells_x, cells_y, amplitude);
    cells_x *= 2;
    cells_y *= 2;
    amplitude *= gain;
  }
  Normalize(out);
  return out;
}

Field WhiteField(int size, uint32_t seed) {
  Field out(size);
  for (size_t i = 0; i < out.count(); ++i) out[i] = 2 * HashUnit(static_cast<uint32_t>(i), seed) - 1;
  return out;
}

void Normalize(Field& field) {
  double sum = 0, squares = 0;
  for (float v : field.values) sum += v, squares += static_cast<double>(v) * v;
  const auto n = static_cast<double>(field.count());
  const double mean = sum / n, sd = std::sqrt(std::max(1e-18, squares / n - mean * mean));
  for (float& v : field.values) v = static_cast<float>((v - mean) / sd);
}

Field Blurred(const Field& field, float radius) {
  const int r = std::clamp(static_cast<int>(radius * 0.7f + 0.5f), 1, field.size / 2 - 1);
  Field a = field, b(field.size);
  for (int pass = 0; pass < 2; ++pass) {
    BoxRows(a, b, r);
    BoxColumns(b, a, r);
  }
  return a;
}

CellPattern::CellPattern(int columns, int rows, float jitter, uint32_t seed, float shift) : columns_(columns), rows_(rows), seed_(seed) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto k = static_cast<uint32_t>(j * columns + i);
      x_.push_back(0.5f + jitter * (HashUnit(seed, k, 1) - 0.5f) + (j % 2 != 0 ? shift : 0));
      y_.push_back(0.5f + jitter * (HashUnit(seed, k, 2) - 0.5f));
    }
  }
}

CellPattern::Cell CellPattern::At(float u, float v) const {
  const float x = u * static_cast<float>(columns_), y = v * static_cast<float>(rows_);
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const auto wrap = [](int i, int n) { return (i % n + n) % n; };
  // The nine neighbours hold the nearest point, and for the jitters used here the nearest border too.
  float dx[9], dy[9], best = 1e9f;
  uint32_t id[9];
  int nearest = 0;
  for (int k = 0; k < 9; ++k) {
    const int i = ix + k % 3 - 1, j = iy + k / 3 - 1;
    id[k] = static_cast<uint32_t>(wrap(j, rows_) * columns_ + wrap(i, columns_));
    dx[k] = static_cast<float>(i) + x_[id[k]] - x;
    dy[k] = static_cast<float>(j) + y_[id[k]] - y;
    const float d = dx[k] * dx[k] + dy[k] * dy[k];
    if (d < best) best = d, nearest = k;
  }
  float edge = 1e9f;
  for (int k = 0; k < 9; ++k) {
    if (k == nearest) continue;
    const float ex = dx[k] - dx[nearest], ey = dy[k] - dy[nearest], length = std::sqrt(ex * ex + ey * ey);
    edge = std::min(edge, 0.5f * ((dx[k] + dx[nearest]) * ex + (dy[k] + dy[nearest]) * ey) / std::max(length, 1e-6f));
  }
  return {std::sqrt(best), edge, -dx[nearest], -dy[nearest], id[nearest] * 2654435761u + seed_};
}

StoneField DropStones(int size, float tile, float floor, const StoneOptions& options, uint32_t seed) {
  StoneField out{Field(size, floor), std::vector<uint32_t>(static_cast<size_t>(size) * size, 0), Field(size, 1)};
  const float scale = static_cast<float>(size) / tile;
  const double wanted = static_cast<double>(options.cover) * tile * tile;
  double area = 0;
  for (uint32_t k = 0; area < wanted; ++k) {
    const Stone stone = MakeStone(size, scale, options, seed, k);
    const double r = stone.radius / scale;
    area += 0.75 * kPiF * r * r;
    DropStone(out, stone, scale, options);
  }
  return out;
}

Field DripField(int size, float tile, float per_square_metre, float widest, float longest, uint32_t seed) {
  Field out(size);
  const float scale = static_cast<float>(size) / tile;
  const auto count = static_cast<uint32_t>(per_square_metre * tile * tile);
  for (uint32_t k = 0; k < count; ++k) {
    const auto h = [&](uint32_t c) { return HashUnit(seed, k, c); };
    const float width = Mix(0.15f, 1.0f, h(1) * h(1)) * widest * scale, length = Mix(0.2f, 1.0f, h(2)) * longest * scale;
    float x = h(3) * static_cast<float>(size), sway = 0;
    const float y0 = h(4) * static_cast<float>(size), strength = 0.3f + 0.7f * h(5);
    for (int q = 0; q < static_cast<int>(length); ++q) {
      const float f = static_cast<float>(q) / length, w = width * (0.6f + 0.5f * f);
      sway = 0.97f * sway + 0.03f * HashNormal(seed + k, static_cast<uint32_t>(q));
      x += 0.5f * sway;
      const float fade = strength * Step(0.0f, 0.18f, f) * (1 - f) * (1 - f);
      for (int i = static_cast<int>(x - 2.5f * w); i <= static_cast<int>(x + 2.5f * w) + 1; ++i) {
        const float d = (static_cast<float>(i) - x) / w;
        out[out.Index(i, static_cast<int>(y0) + q)] += fade * std::exp(-d * d);
      }
    }
  }
  Normalize(out);
  return out;
}

void Stamp(const Field& grid, float x, float y, float radius, const std::function<void(size_t, float)>& paint) {
  for (int j = static_cast<int>(std::floor(y - radius)); j <= static_cast<int>(std::ceil(y + radius)); ++j) {
    for (int i = static_cast<int>(std::floor(x - radius)); i <= static_cast<int>(std::ceil(x + radius)); ++i) {
      const float d = std::hypot(static_cast<float>(i) - x, static_cast<float>(j) - y) / radius;
      if (d < 1) paint(grid.Index(i, j), d);
    }
  }
}

Field LineField(int size, float tile, int count, float wander, float reach, uint32_t seed) {
  const float scale = static_cast<float>(size) / tile;
  Field out(size, reach * scale);
  constexpr int kSteps = 96;
  for (int line = 0; line < count; ++line) {
    // A random walk along one axis; its drift is taken back so that it closes at the border.
    const auto key = seed + static_cast<uint32_t>(line) * 977u;
    float path[kSteps + 1] = {}, drift = 0;
    for (int k = 1; k <= kSteps; ++k) {
      drift = 0.82f * drift + wander * HashNormal(key, static_cast<uint32_t>(k));
      path[k] = path[k - 1] + drift * static_cast<float>(size) / kSteps;
    }
    const float start = HashUnit(key, 3) * static_cast<float>(size);
    for (int k = 0; k < kSteps; ++k) {
      const float f0 = static_cast<float>(k) / kSteps, f1 = static_cast<float>(k + 1) / kSteps;
      const float a0 = f0 * static_cast<float>(size), a1 = f1 * static_cast<float>(size);
      const float b0 = start + path[k] - path[kSteps] * f0, b1 = start + path[k + 1] - path[kSteps] * f1;
      if (line % 2 == 0) {
        AddSegment(out, b0, a0, b1, a1, reach * scale);
      } else {
        AddSegment(out, a0, b0, a1, b1, reach * scale);
      }
    }
  }
  for (float& d : out.values) d /= scale;
  return out;
}

}  // namespace airsim360::internal

#include "airsim360/planning/clearance_field.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

constexpr int kReach = 24;    // voxels up to which distances are measured
constexpr double kSteps = 4;  // of a bound in a voxel
constexpr int64_t kMaxVoxels = int64_t{1} << 28;
constexpr double kMargin = 1e-4;  // voxels by which triangles are thickened, against rounding

}  // namespace

bool ClearanceField::Find(Vec3d p, int (&cell)[3]) const {
  if (!box_.Contains(p)) return false;
  for (int i = 0; i < 3; ++i) cell[i] = std::min(static_cast<int>((p[i] - box_.min[i]) / voxel_), size_[i] - 1);
  return true;
}

double ClearanceField::At(int x, int y, int z) const {
  const uint8_t cell = cells_[Index(x, y, z)];
  return cell == 0 ? 0 : (cell - 1) * (voxel_ / kSteps);
}

double ClearanceField::At(Vec3d p) const {
  int c[3];
  return Find(p, c) ? At(c[0], c[1], c[2]) : 0;
}

bool ClearanceField::Occupied(Vec3d p) const {
  int c[3];
  return Find(p, c) && Occupied(c[0], c[1], c[2]);
}

Vec3d ClearanceField::Center(int x, int y, int z) const { return box_.min + Vec3d{x + 0.5, y + 0.5, z + 0.5} * voxel_; }

double ClearanceField::TopOfColumn(int x, int y) const {
  for (int z = size_[2]; z-- > 0;) {
    if (Occupied(x, y, z)) return box_.min.z + (z + 1) * voxel_;
  }
  return box_.min.z;
}

double ClearanceField::BottomOfColumn(int x, int y) const {
  for (int z = 0; z < size_[2]; ++z) {
    if (Occupied(x, y, z)) return box_.min.z + z * voxel_;
  }
  return box_.min.z;
}

ClearanceFieldBuilder::ClearanceFieldBuilder(const Box3d& box, double voxel) {
  const Vec3d extent = box.max - box.min;
  if (!(voxel > 0) || !(extent.x > 0 && extent.y > 0 && extent.z > 0) ||
      !(extent.x * extent.y * extent.z / (voxel * voxel * voxel) < static_cast<double>(kMaxVoxels)))
    throw InputError("clearance field: the box must have a size, and at most 2^28 voxels");
  int64_t voxels = 1;
  for (int i = 0; i < 3; ++i) {
    field_.size_[i] = std::max(1, static_cast<int>(std::ceil(extent[i] / voxel - 1e-9)));
    voxels *= field_.size_[i];
  }
  if (voxels > kMaxVoxels) throw InputError("clearance field: more than 2^28 voxels");
  field_.voxel_ = voxel;
  field_.box_.min = box.min;
  for (int i = 0; i < 3; ++i) field_.box_.max[i] = box.min[i] + field_.size_[i] * voxel;
  field_.cells_.assign(static_cast<size_t>(voxels), 1);
}

namespace {

// A triangle in units of voxels with its axes in another order: w is the one that its normal is nearest to.
struct Turned {
  int u, v, w;
  Vec3d p[3];
  double slope_u, slope_v;  // of the plane: w = p[0].w + slope_u du + slope_v dv
};

Turned TurnToNormal(Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d n = Cross(b - a, c - a);
  Turned t{0, 1, 2, {a, b, c}, 0, 0};
  if (std::fabs(n.x) >= std::fabs(n.y) && std::fabs(n.x) >= std::fabs(n.z)) {
    t.u = 1, t.v = 2, t.w = 0;
  } else if (std::fabs(n.y) >= std::fabs(n.z)) {
    t.u = 2, t.v = 0, t.w = 1;
  }
  if (n[t.w] != 0) {
    t.slope_u = -n[t.u] / n[t.w];
    t.slope_v = -n[t.v] / n[t.w];
  }
  return t;
}

// True unless an edge of the triangle, seen along w, has the square [u, u + 1] x [v, v + 1] wholly outside.
bool MayTouchSquare(const Turned& t, double u, double v) {
  const double turn = (t.p[1][t.u] - t.p[0][t.u]) * (t.p[2][t.v] - t.p[0][t.v]) - (t.p[1][t.v] - t.p[0][t.v]) * (t.p[2][t.u] - t.p[0][t.u]);
  const double sign = turn >= 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = t.p[i], b = t.p[(i + 1) % 3];
    const double nu = -(b[t.v] - a[t.v]) * sign, nv = (b[t.u] - a[t.u]) * sign;
    // The corner of the square farthest inwards.
    const double corner_u = u + (nu > 0 ? 1 + kMargin : -kMargin), corner_v = v + (nv > 0 ? 1 + kMargin : -kMargin);
    if (nu * (corner_u - a[t.u]) + nv * (corner_v - a[t.v]) < 0) return false;
  }
  return true;
}

}  // namespace

void ClearanceFieldBuilder::Add(Vec3d a, Vec3d b, Vec3d c) {
  // To voxels; the part of the grid that the triangle's box covers.
  const double scale = 1 / field_.voxel_;
  a = (a - field_.box_.min) * scale, b = (b - field_.box_.min) * scale, c = (c - field_.box_.min) * scale;
  const Vec3d low = Min(a, Min(b, c)), high = Max(a, Max(b, c));
  int first[3], last[3];
  for (int i = 0; i < 3; ++i) {
    if (!(high[i] >= -kMargin && low[i] <= field_.size_[i] + kMargin)) return;  // outside, or not a number
    first[i] = static_cast<int>(std::max(0.0, std::floor(low[i] - kMargin)));
    last[i] = static_cast<int>(std::min(field_.size_[i] - 1.0, std::floor(high[i] + kMargin)));
    if (first[i] > last[i]) return;
  }
  const auto mark = [&](int x, int y, int z) {
    std::atomic_ref<uint8_t>(field_.cells_[field_.Index(x, y, z)]).store(0, std::memory_order_relaxed);
  };
  if (first[0] == last[0] && first[1] == last[1] && first[2] == last[2]) return mark(first[0], first[1], first[2]);

  // For every square under it, the voxels between the least and greatest height of its plane there.
  const Turned t = TurnToNormal(a, b, c);
  for (int u = first[t.u]; u <= last[t.u]; ++u) {
    for (int v = first[t.v]; v <= last[t.v]; ++v) {
      if (!MayTouchSquare(t, u, v)) continue;
      const double middle = t.p[0][t.w] + t.slope_u * (u + 0.5 - t.p[0][t.u]) + t.slope_v * (v + 0.5 - t.p[0][t.v]);
      const double half = 0.5 * (std::fabs(t.slope_u) + std::fabs(t.slope_v)) + kMargin;
      const int from = std::max(first[t.w], static_cast<int>(std::floor(std::max(middle - half, -1.0))));
      const int to = std::min(last[t.w], static_cast<int>(std::floor(std::min(middle + half, 1e9))));
      int cell[3];
      cell[t.u] = u, cell[t.v] = v;
      for (cell[t.w] = from; cell[t.w] <= to; ++cell[t.w]) mark(cell[0], cell[1], cell[2]);
    }
  }
}

void ClearanceFieldBuilder::Add(const Box3d& box) {
  const double scale = 1 / field_.voxel_;
  const Vec3d low = (box.min - field_.box_.min) * scale, high = (box.max - field_.box_.min) * scale;
  int first[3], last[3];
  for (int i = 0; i < 3; ++i) {
    if (!(high[i] >= -kMargin && low[i] <= field_.size_[i] + kMargin)) return;
    first[i] = static_cast<int>(std::max(0.0, std::floor(low[i] - kMargin)));
    last[i] = static_cast<int>(std::min(field_.size_[i] - 1.0, std::floor(high[i] + kMargin)));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x)
        std::atomic_ref<uint8_t>(field_.cells_[field_.Index(x, y, z)]).store(0, std::memory_order_relaxed);
    }
  }
}

namespace {

constexpr int16_t kFarSquared = kReach * kReach;

// out = min(out, in + add), element by element.
void TakeMin(const int16_t* in, int16_t add, int16_t* out, int n) {
  for (int i = 0; i < n; ++i) {
    const auto sum = static_cast<int16_t>(in[i] + add);
    out[i] = sum < out[i] ? sum : out[i];
  }
}

// Rows of voxels and, for each, whether something is within reach: in open air most have nothing.
struct Rows {
  std::vector<int16_t> squared_gaps;
  std::vector<uint8_t> near;
};

// Squared gaps across `lines` rows that are `stride` apart: row `at`, the one of number `line`, gets the least of all rows within
// reach plus their squared gap (voxels between them).
void CombineRows(const Rows& in, Rows& out, size_t at, int line, int lines, size_t stride, int n) {
  int16_t* to = &out.squared_gaps[at * n];
  std::fill(to, to + n, kFarSquared);
  for (int d = std::max(-kReach, -line); d <= std::min(kReach, lines - 1 - line); ++d) {
    const size_t other = at + stride * d;
    if (in.near[other] == 0) continue;
    out.near[at] = 1;
    const int gap = std::max(std::abs(d) - 1, 0);
    TakeMin(&in.squared_gaps[other * n], static_cast<int16_t>(gap * gap), to, n);
  }
}

// Squared gap to the nearest occupied cell of one row; whether there is one.
bool MeasureRow(const uint8_t* cells, int16_t* out, int n) {
  const auto squared_gap = [](int distance) {
    const int gap = std::min(std::max(distance - 1, 0), kReach);
    return static_cast<int16_t>(gap * gap);
  };
  int last = -2 * kReach;
  for (int x = 0; x < n; ++x) {
    if (cells[x] == 0) last = x;
    out[x] = squared_gap(x - last);
  }
  last = n + 2 * kReach;
  for (int x = n; x-- > 0;) {
    if (cells[x] == 0) last = x;
    out[x] = std::min(out[x], squared_gap(last - x));
  }
  return last < n;
}

}  // namespace

ClearanceField ClearanceFieldBuilder::Build() {
  const int nx = field_.size_[0], ny = field_.size_[1], nz = field_.size_[2];
  const auto rows = static_cast<size_t>(ny) * static_cast<size_t>(nz);
  Rows first{std::vector<int16_t>(field_.cells_.size()), std::vector<uint8_t>(rows)}, second = first;
  ParallelFor(nz, [&](int64_t z) {
    const size_t slice = static_cast<size_t>(z) * ny;
    for (size_t row = slice; row < slice + ny; ++row)
      first.near[row] = MeasureRow(&field_.cells_[row * nx], &first.squared_gaps[row * nx], nx);
    for (int y = 0; y < ny; ++y) CombineRows(first, second, slice + y, y, ny, 1, nx);
  });
  std::ranges::fill(first.near, 0);
  uint8_t bounds[kFarSquared + 1];
  for (int i = 0; i <= kFarSquared; ++i) bounds[i] = static_cast<uint8_t>(1 + std::floor(kSteps * std::sqrt(i) + 1e-9));
  ParallelFor(ny, [&](int64_t y) {
    for (int z = 0; z < nz; ++z) {
      const size_t row = static_cast<size_t>(z) * ny + static_cast<size_t>(y);
      CombineRows(second, first, row, z, nz, static_cast<size_t>(ny), nx);
      for (size_t at = row * nx; at < (row + 1) * nx; ++at)
        if (field_.cells_[at] != 0) field_.cells_[at] = bounds[first.squared_gaps[at]];
    }
  });
  return std::move(field_);
}

}  // namespace airsim360

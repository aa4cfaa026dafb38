#include "airsim360/render/frame/camera_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr double kAxisStep = 0x1p-32;
constexpr size_t kMostTablePixels = size_t{1} << 24;
constexpr int64_t kStepsPerColumn = int64_t{1} << 24;

int Padded(int n) { return (n + kTileSize - 1) / kTileSize * kTileSize; }

// sin and cos of 2 pi numerator / denominator, reduced to an octant in integers: tables built of them are
// symmetric bit for bit.
void SinCosOfTurn(int64_t numerator, int64_t denominator, double& sine, double& cosine) {
  int64_t n = numerator % denominator;
  if (n < 0) n += denominator;
  const bool below = 2 * n > denominator;  // lower half circle
  if (below) n = denominator - n;
  const bool left = 4 * n > denominator;  // second quadrant
  if (left)
    n = denominator - 2 * n;  // now in units of half steps
  else
    n = 2 * n;
  const bool steep = 4 * n > denominator;  // beyond 45 degrees
  if (steep)
    n = denominator - 2 * n;  // quarter steps
  else
    n = 2 * n;
  const double angle = kTau * static_cast<double>(n) / (4.0 * static_cast<double>(denominator));
  sine = steep ? std::cos(angle) : std::sin(angle);
  cosine = steep ? std::sin(angle) : std::cos(angle);
  if (left) cosine = -cosine;
  if (below) sine = -sine;
}

// Frame with the given down axis that depends on this axis alone: its forward axis is the part of +X (or +Y)
// across it.
Mat3d CanonicalFrame(Vec3d down) {
  const Vec3d reference = std::abs(down.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d forward = Normalized(reference - down * Dot(down, reference));
  return Mat3d::FromColumns(Cross(down, forward), down, forward);
}

double Rounded(double x) { return std::round(x / kAxisStep) * kAxisStep; }

}  // namespace

void CameraRays::Update(const Camera& camera, const Mat3d& R_WC) {
  const int width = Width(camera), height = Height(camera);
  if (width <= 0 || height <= 0) {
    throw InputError("camera of " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
  }
  const auto* erp = std::get_if<Equirectangular>(&camera);
  if (camera != camera_) {
    field_ = RayField{};
    field_.width = width;
    field_.height = height;
    if (erp != nullptr)
      MakeSeparable(*erp);
    else
      UseTable(camera);
    camera_ = camera;
  }
  column_shift_ = 0;
  R0_ = R_WC;
  if (erp != nullptr) TurnSeparable(R_WC);
  for (int i = 0; i < 9; ++i) field_.R[i] = R0_.m[i / 3][i % 3];
}

void CameraRays::MakeSeparable(const Equirectangular& camera) {
  const int columns = Padded(camera.width), rows = Padded(camera.height);
  field_.separable = true;
  cone_angle_ = std::numbers::pi / camera.height;
  sin_theta_.resize(columns);
  cos_theta_.resize(columns);
  sin_phi_.resize(rows);
  cos_phi_.resize(rows);
  for (int x = 0; x < columns; ++x) {
    SinCosOfTurn(2 * int64_t{x} + 1 - camera.width, 2 * int64_t{camera.width}, sin_theta_[x], cos_theta_[x]);
  }
  for (int y = 0; y < rows; ++y) {
    SinCosOfTurn(camera.height - 2 * int64_t{y} - 1, 4 * int64_t{camera.height}, sin_phi_[y], cos_phi_[y]);
  }
  columns_.resize(3 * static_cast<size_t>(columns));
  rows_.resize(4 * static_cast<size_t>(rows));
}

void CameraRays::TurnSeparable(const Mat3d& R_WC) {
  // Whole columns of the turn about the camera's own vertical axis, and what is left of it.
  const Vec3d axis = R_WC.column(1);
  const Mat3d canonical = CanonicalFrame(Normalized(Vec3d{Rounded(axis.x), Rounded(axis.y), Rounded(axis.z)}));
  const Vec3d forward = canonical.transpose() * R_WC.column(2);
  const double columns = std::atan2(forward.x, forward.z) / kTau * field_.width;
  const int64_t turn = int64_t{field_.width} * kStepsPerColumn;
  const int64_t steps = (std::llround(columns * kStepsPerColumn) % turn + turn) % turn;
  column_shift_ = static_cast<int>(steps / kStepsPerColumn);
  const double rest = static_cast<double>(steps % kStepsPerColumn) / kStepsPerColumn * kTau / field_.width;
  R0_ = canonical * RotationY(rest);

  // dir_W = cos(phi) (sin(theta) right + cos(theta) forward) - sin(phi) down.
  const size_t n = sin_theta_.size(), m = sin_phi_.size();
  for (size_t x = 0; x < n; ++x) {
    const Vec3d h = R0_.column(0) * sin_theta_[x] + R0_.column(2) * cos_theta_[x];
    columns_[x] = h.x;
    columns_[n + x] = h.y;
    columns_[2 * n + x] = h.z;
  }
  for (size_t y = 0; y < m; ++y) {
    const Vec3d v = R0_.column(1) * -sin_phi_[y];
    rows_[y] = cos_phi_[y];
    rows_[m + y] = v.x;
    rows_[2 * m + y] = v.y;
    rows_[3 * m + y] = v.z;
  }
  field_.column_x = columns_.data();
  field_.column_y = columns_.data() + n;
  field_.column_z = columns_.data() + 2 * n;
  field_.row_scale = rows_.data();
  field_.row_x = rows_.data() + m;
  field_.row_y = rows_.data() + 2 * m;
  field_.row_z = rows_.data() + 3 * m;
}

std::shared_ptr<const CameraRays::Table> CameraRays::MakeTable(const Camera& camera) {
  const int width = Width(camera), height = Height(camera), stride = Padded(width);
  const size_t n = static_cast<size_t>(stride) * Padded(height);
  auto table = std::make_shared<Table>();
  table->camera = camera;
  table->rays.assign(3 * n, 0);
  std::fill(table->rays.begin() + static_cast<std::ptrdiff_t>(2 * n), table->rays.end(), 1.0f);
  table->has_ray.assign(n, 0);
  ParallelFor(height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const std::optional<Vec3d> ray = PixelToRay(camera, {x + 0.5, y + 0.5});
      if (!ray) continue;
      const size_t i = static_cast<size_t>(y) * stride + x;
      table->rays[i] = static_cast<float>(ray->x);
      table->rays[n + i] = static_cast<float>(ray->y);
      table->rays[2 * n + i] = static_cast<float>(ray->z);
      table->has_ray[i] = -1;
    }
  });

  // Two neighbours at the image centre.
  const Vec2d center{width / 2.0, height / 2.0};
  const auto a = PixelToRay(camera, center), b = PixelToRay(camera, center + Vec2d{0, 1});
  table->cone_angle = a && b ? std::atan2(Norm(Cross(*a, *b)), Dot(*a, *b)) : std::numbers::pi / height;
  return table;
}

void CameraRays::UseTable(const Camera& camera) {
  const auto found = std::ranges::find_if(tables_, [&](const auto& table) { return table->camera == camera; });
  if (found != tables_.end()) {
    std::rotate(found, found + 1, tables_.end());
  } else {
    tables_.push_back(MakeTable(camera));
    size_t pixels = 0;
    for (const auto& table : tables_) pixels += table->has_ray.size();
    while (pixels > kMostTablePixels && tables_.size() > 1) {
      pixels -= tables_.front()->has_ray.size();
      tables_.erase(tables_.begin());
    }
  }
  const Table& table = *tables_.back();
  const size_t n = table.has_ray.size();
  field_.ray_x = table.rays.data();
  field_.ray_y = table.rays.data() + n;
  field_.ray_z = table.rays.data() + 2 * n;
  field_.has_ray = table.has_ray.data();
  field_.stride = Padded(field_.width);
  cone_angle_ = table.cone_angle;
}

PixelOffset CameraRays::MakeOffset(double dx, double dy) const {
  const double theta = kTau * dx / field_.width, phi = -std::numbers::pi * dy / field_.height;
  return {dx, dy, std::sin(theta), std::cos(theta), std::sin(phi), std::cos(phi)};
}

bool CameraRays::Direction(int column, int row, const PixelOffset& offset, Vec3d& direction_W) const {
  if (!field_.separable) {
    const std::optional<Vec3d> ray = PixelToRay(camera_, {column + 0.5 + offset.dx, row + 0.5 + offset.dy});
    if (ray) direction_W = R0_ * *ray;
    return ray.has_value();
  }
  // Angles of the pixel centre plus small ones.
  const auto [dx, dy, sa, ca, sb, cb] = offset;
  const double st = sin_theta_[column] * ca + cos_theta_[column] * sa;
  const double ct = cos_theta_[column] * ca - sin_theta_[column] * sa;
  const double sp = sin_phi_[row] * cb + cos_phi_[row] * sb;
  const double cp = cos_phi_[row] * cb - sin_phi_[row] * sb;
  direction_W = R0_ * Vec3d{cp * st, -sp, cp * ct};
  return true;
}

}  // namespace airsim360::internal

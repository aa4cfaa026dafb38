#include "airsim360/render/reference/path_lights.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr float kTau = 6.28318531f;
constexpr float kSunRadius = 0.004625f;  // radians; as in light_kernel.cc
// Cells of equal solid angle, azimuth by sine of elevation; fine enough to set clouds apart.
constexpr int kAcross = 256, kUp = 128;
constexpr float kCellsPerAngle = kAcross * kUp / (2 * kTau);

Vec3f DirectionIn(float x, float y) {
  const float z = 2 * y - 1, s = std::sqrt(std::max(0.0f, 1 - z * z));
  return {s * std::cos(kTau * x), s * std::sin(kTau * x), z};
}

// Turns weights into what of them lies up to and in each, of 1; returns their sum.
float Accumulate(const float* weights, int count, float* cumulative) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += weights[i];
  double part = 0;
  for (int i = 0; i < count; ++i) cumulative[i] = static_cast<float>((part += weights[i]) / sum);
  cumulative[count - 1] = 1;
  return static_cast<float>(sum);
}

// The interval that u falls in, and where in it, [0, 1).
int Find(const float* cumulative, int count, float u, float& inside) {
  const int k =
      std::min(static_cast<int>(std::upper_bound(cumulative, cumulative + count, u) - cumulative), count - 1);
  const float low = k > 0 ? cumulative[k - 1] : 0;
  inside = std::clamp((u - low) / std::max(cumulative[k] - low, 1e-12f), 0.0f, 0.99999994f);
  return k;
}

}  // namespace

PathLights::PathLights(const ShadeView& view, const Sky* sky)
    : to_sun_{view.to_sun[0], view.to_sun[1], view.to_sun[2]},
      sun_radiance_{view.sun_radiance[0], view.sun_radiance[1], view.sun_radiance[2]} {
  if (sky == nullptr) return;
  // As in surface_kernel.cc, a sun just below the horizon shines, a lower one does not.
  has_sun_ = to_sun_.z > -0.02f && sun_radiance_.y > 0;
  const Vec3f reference = std::fabs(to_sun_.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0};
  sun_right_ = Normalized(Cross(reference, to_sun_));
  sun_up_ = Cross(to_sun_, sun_right_);

  density_.resize(kAcross * kUp);
  cumulative_.resize(kAcross * kUp);
  std::vector<float> rows(kUp);
  for (int i = 0; i < kAcross * kUp; ++i) {
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec3f c =
          sky->Radiance(DirectionIn((static_cast<float>(i % kAcross) + (k % 2 ? 0.75f : 0.25f)) / kAcross,
                                    (static_cast<float>(i / kAcross) + (k / 2 ? 0.75f : 0.25f)) / kUp));
      sum += 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
    }
    density_[i] = sum;
  }
  // No direction may be left out.
  double total = 0;
  for (float d : density_) total += d;
  const float least = static_cast<float>(0.02 * total / (kAcross * kUp)) + 1e-12f;
  for (float& d : density_) d += least;
  for (int y = 0; y < kUp; ++y)
    rows[y] = Accumulate(&density_[y * kAcross], kAcross, &cumulative_[y * kAcross]);
  rows_.resize(kUp);
  const float sum = Accumulate(rows.data(), kUp, rows_.data());
  for (float& d : density_) d *= kCellsPerAngle / sum;
}

Vec3f PathLights::SampleSun(Vec2f u) const {
  // The chord to the disc's centre squared is even over solid angle.
  const float chord = kSunRadius * std::sqrt(u.x), turn = kTau * u.y;
  const float side = chord * std::sqrt(1 - 0.25f * chord * chord);
  return Normalized(to_sun_ * (1 - 0.5f * chord * chord) + sun_right_ * (side * std::cos(turn)) +
                    sun_up_ * (side * std::sin(turn)));
}

float PathLights::SunPdf(Vec3f d) const {
  const Vec3f off = d - to_sun_;
  return has_sun_ && Dot(off, off) < kSunRadius * kSunRadius ? 2 / (kTau * kSunRadius * kSunRadius) : 0.0f;
}

Vec3f PathLights::SunRadiance(Vec3f d) const {
  const Vec3f off = d - to_sun_;
  const float x2 = Dot(off, off) / (kSunRadius * kSunRadius);
  if (!has_sun_ || x2 >= 1) return {};
  return sun_radiance_ * (1.25f * (0.4f + 0.6f * std::sqrt(1 - x2)));
}

Vec3f PathLights::SampleSky(Vec2f u) const {
  float x = 0, y = 0;
  const int row = Find(rows_.data(), kUp, u.y, y);
  const int column = Find(&cumulative_[row * kAcross], kAcross, u.x, x);
  return DirectionIn((static_cast<float>(column) + x) / kAcross, (static_cast<float>(row) + y) / kUp);
}

float PathLights::SkyPdf(Vec3f d) const {
  if (density_.empty()) return 0;
  const float turn = std::atan2(d.y, d.x) / kTau;
  const int x = std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * kAcross), 0, kAcross - 1);
  const int y = std::clamp(static_cast<int>((0.5f + 0.5f * d.z) * kUp), 0, kUp - 1);
  return density_[y * kAcross + x];
}

}  // namespace airsim360::internal

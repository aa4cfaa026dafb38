#include "airsim360/render/sky/atmosphere.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

// Bruneton & Neyret (2008) for Rayleigh in the sRGB primaries; the aerosol follows Angstrom's law
// with exponent 1.3.
constexpr float kGroundRadius = 6360e3f, kTopRadius = 6440e3f, kEyeHeight = 60.0f;
constexpr Vec3f kRayleigh{5.802e-6f, 13.558e-6f, 33.1e-6f};
// Ozone's Chappuis band is strongest at 600 nm: in the broad red of a display it takes a little more than in
// the green (at 680 nm, as often used, dusk would turn purple).
constexpr Vec3f kOzone{2.10e-6f, 1.90e-6f, 0.18e-6f};
constexpr Vec3f kAngstrom{0.78f, 1.0f, 1.30f};
constexpr float kAerosolAlbedo = 0.94f, kAsymmetry = 0.76f;
constexpr Vec3f kGroundAlbedo{0.22f, 0.22f, 0.20f};

Vec3f Exp(Vec3f a) { return {scalar::exp_approx(a.x), scalar::exp_approx(a.y), scalar::exp_approx(a.z)}; }

float RayleighPhase(float mu) { return 3.0f / (16.0f * kPiF) * (1.0f + mu * mu); }

// Cornette-Shanks.
float AerosolPhase(float mu) {
  constexpr float g = kAsymmetry, g2 = g * g;
  const float d = 1.0f + g2 - 2.0f * g * mu;
  return 3.0f / (8.0f * kPiF) * (1.0f - g2) * (1.0f + mu * mu) / ((2.0f + g2) * d * std::sqrt(d));
}

// Distance along a ray from p (planet frame) to the sphere of radius r: the far crossing, or the near one; <
// 0 = none.
float SphereDistance(Vec3f p, Vec3f d, float r, bool far) {
  const double b = Dot(VecCast<double>(p), VecCast<double>(d));
  const double c = Dot(VecCast<double>(p), VecCast<double>(p)) - static_cast<double>(r) * r;
  const double q = b * b - c;
  if (q < 0) return -1;
  return static_cast<float>(far ? -b + std::sqrt(q) : -b - std::sqrt(q));
}

float HeightOf(Vec3f p) { return std::max(0.0f, static_cast<float>(Norm(VecCast<double>(p)) - kGroundRadius)); }

// Heights of the tables: quadratic, finer near the ground.
constexpr float kTableTop = 60e3f;
float TableHeight(int i, int count) {
  const float t = static_cast<float>(i) / static_cast<float>(count - 1);
  return t * t * kTableTop;
}

// Cosine of the sun's distance from the zenith where its centre sets, seen from this height.
float HorizonCosine(float height) {
  const float r = kGroundRadius / (kGroundRadius + height);
  return -std::sqrt(std::max(0.0f, 1 - r * r));
}

// Columns of the two tables: finer towards the horizon.
constexpr int kHeights = 48, kSuns = 96, kMultipleHeights = 20, kMultipleSuns = 32;
float SunOfColumn(int i, float horizon) {
  const float t = static_cast<float>(i) / (kSuns - 1);
  return horizon + t * t * (1 - horizon);
}
float MultipleSunOfColumn(int i) {
  const float t = 2 * static_cast<float>(i) / (kMultipleSuns - 1) - 1;
  return t * std::fabs(t);
}

Vec3f Interpolate(const std::vector<Vec3f>& table, int width, int height, float x, float y) {
  x = std::clamp(x, 0.0f, static_cast<float>(width) - 1.001f);
  y = std::clamp(y, 0.0f, static_cast<float>(height) - 1.001f);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  const Vec3f* t = &table[static_cast<size_t>(j) * width + i];
  return (t[0] * (1 - fx) + t[1] * fx) * (1 - fy) + (t[width] * (1 - fx) + t[width + 1] * fx) * fy;
}

float HeightRow(float height, int count) { return std::sqrt(std::min(height, kTableTop) / kTableTop) * static_cast<float>(count - 1); }

Vec3f AtHeight(float height) { return {0, 0, kGroundRadius + height}; }

}  // namespace

// Aerosol optical depth at 550 nm from Linke's turbidity, a linear fit over clean to hazy continental air.
ClearAir::ClearAir(double turbidity)
    : rayleigh(kRayleigh), aerosol(kAngstrom * (static_cast<float>(std::max(0.02, 0.035 + 0.075 * (turbidity - 2.0))) / kAerosolHeight)) {}

Atmosphere::Atmosphere(Vec3f to_sun, double turbidity)
    : to_sun_(to_sun), air_(turbidity), sun_transmittance_(kHeights * kSuns), multiple_(kMultipleHeights * kMultipleSuns) {
  TabulateSun();
  TabulateMultiple();
}

Atmosphere Atmosphere::WithSun(Vec3f to_sun) const {
  Atmosphere other = *this;
  other.to_sun_ = to_sun;
  return other;
}

// The sun through the air, from every height.
void Atmosphere::TabulateSun() {
  ParallelFor(kHeights, [&](int64_t row) {
    const float height = TableHeight(static_cast<int>(row), kHeights), horizon = HorizonCosine(height);
    for (int i = 0; i < kSuns; ++i) {
      // Just above the horizon, so that rounding does not put the ground before it.
      const float mu = std::min(1.0f, SunOfColumn(i, horizon) + 1e-5f);
      const Vec3f to_sun{std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu};
      sun_transmittance_[row * kSuns + i] = Exp(-OpticalDepth(AtHeight(height), to_sun));
    }
  });
}

// All orders above the first: second order averaged over directions, times the geometric series of its own
// transfer.
void Atmosphere::TabulateMultiple() {
  constexpr int kPolar = 8, kAround = 8;
  ParallelFor(kMultipleHeights, [&](int64_t row) {
    const Vec3f p = AtHeight(TableHeight(static_cast<int>(row), kMultipleHeights) + 10.0f);
    for (int i = 0; i < kMultipleSuns; ++i) {
      const float mu = MultipleSunOfColumn(i);
      const Vec3f to_sun{std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu};
      Vec3f second{}, factor{};
      for (int k = 0; k < kPolar * kAround; ++k) {
        const float z = (static_cast<float>(k / kAround) + 0.5f) / kPolar * 2.0f - 1.0f;
        const float angle = (static_cast<float>(k % kAround) + 0.5f) / kAround * 2.0f * kPiF;
        const float s = std::sqrt(1.0f - z * z);
        Vec3f f{};
        second += Scattered(p, {s * std::cos(angle), s * std::sin(angle), z}, to_sun, true, &f);
        factor += f;
      }
      const float scale = 1.0f / (kPolar * kAround);
      for (int c = 0; c < 3; ++c) multiple_[row * kMultipleSuns + i][c] = second[c] * scale / (1.0f - factor[c] * scale);
    }
  });
}

Atmosphere::Medium Atmosphere::At(float height) const {
  const float r = scalar::exp_approx(-height / kRayleighHeight), a = scalar::exp_approx(-height / kAerosolHeight);
  const float o = std::max(0.0f, 1.0f - std::fabs(height - 25e3f) / 15e3f);
  return {air_.rayleigh * r, air_.aerosol * (kAerosolAlbedo * a), air_.rayleigh * r + air_.aerosol * a + kOzone * o};
}

Vec3f Atmosphere::OpticalDepth(Vec3f p, Vec3f direction) const {
  if (SphereDistance(p, direction, kGroundRadius - 100, false) > 0) return {1e3f, 1e3f, 1e3f};
  const float length = SphereDistance(p, direction, kTopRadius, true);
  constexpr int kSteps = 40;
  Vec3f depth{};
  for (int i = 0; i < kSteps; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kSteps;
    const float ds = length * 2.0f * u / kSteps;
    depth += At(HeightOf(p + direction * (length * u * u))).extinction * ds;
  }
  return depth;
}

// Zero below the horizon of that height; the disc's width is spread over the set.
Vec3f Atmosphere::SunTransmittance(float height, float mu) const {
  constexpr float kRadius = 0.0047f;
  const float horizon = HorizonCosine(height);
  const float seen = std::clamp(0.5f + (mu - horizon) / (2 * kRadius), 0.0f, 1.0f);
  if (seen <= 0) return {};
  const float t = std::sqrt(std::max(0.0f, mu - horizon) / (1 - horizon));
  return Interpolate(sun_transmittance_, kSuns, kHeights, t * (kSuns - 1), HeightRow(height, kHeights)) * seen;
}

Vec3f Atmosphere::MultipleAt(float height, float mu) const {
  const float t = std::copysign(std::sqrt(std::min(1.0f, std::fabs(mu))), mu);
  return Interpolate(multiple_, kMultipleSuns, kMultipleHeights, (t + 1) * 0.5f * (kMultipleSuns - 1), HeightRow(height, kMultipleHeights));
}

Vec3f Atmosphere::SunIrradiance(float height) const { return SunTransmittance(height, to_sun_.z) * kSolarIrradiance; }

// In-scattered radiance along a ray. With `isotropic` phase functions, and then `multiple_factor` gets the
// share of unit ambient radiance that comes back; otherwise true phase functions and the table of higher
// orders.
Vec3f Atmosphere::Scattered(Vec3f p, Vec3f direction, Vec3f to_sun, bool isotropic, Vec3f* multiple_factor) const {
  const float ground = SphereDistance(p, direction, kGroundRadius, false);
  const float length = ground > 0 ? ground : SphereDistance(p, direction, kTopRadius, true);
  const float mu = Dot(direction, to_sun);
  const float phase_r = isotropic ? 0.25f / kPiF : RayleighPhase(mu), phase_a = isotropic ? 0.25f / kPiF : AerosolPhase(mu);
  const int steps = isotropic ? 20 : 48;
  Vec3f light{}, through{1, 1, 1}, factor{};
  for (int i = 0; i < steps; ++i) {
    // Steps grow quadratically; the source is constant within one and its attenuation integrated exactly.
    const float u0 = static_cast<float>(i) / steps, u1 = static_cast<float>(i + 1) / steps;
    const float ds = length * (u1 * u1 - u0 * u0);
    const Vec3f q = p + direction * (length * 0.5f * (u0 * u0 + u1 * u1));
    const float height = HeightOf(q), sun = Dot(q, to_sun) / Norm(q);
    const Medium medium = At(height);
    const Vec3f scattering = medium.rayleigh + medium.aerosol;
    Vec3f source = (medium.rayleigh * phase_r + medium.aerosol * phase_a) * SunTransmittance(height, sun) * kSolarIrradiance;
    if (!isotropic) source += scattering * MultipleAt(height, sun);
    const Vec3f step = Exp(medium.extinction * -ds);
    for (int c = 0; c < 3; ++c) {
      const float weight = through[c] * (1.0f - step[c]) / std::max(medium.extinction[c], 1e-12f);
      light[c] += source[c] * weight;
      factor[c] += scattering[c] * weight;
    }
    through = through * step;
  }
  if (isotropic && ground > 0) {
    const Vec3f q = p + direction * ground;
    const float sun = Dot(q, to_sun) / Norm(q);
    light += through * kGroundAlbedo * SunTransmittance(0, sun) * kSolarIrradiance * (std::max(0.0f, sun) / kPiF);
  }
  if (multiple_factor) *multiple_factor = factor;
  return light;
}

Vec3f Atmosphere::Radiance(Vec3f direction) const {
  direction = Normalized(Vec3f{direction.x, direction.y, std::max(direction.z, 0.002f)});
  return Scattered(AtHeight(kEyeHeight), direction, to_sun_, false, nullptr);
}

}  // namespace airsim360::internal

#include "airsim360/render/reference/path_lights.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {

PathLights::PathLights(const Shader::Impl& parts) : sky_(parts.sky ? &*parts.sky : nullptr), lamps_(parts.lights) {
  if (sky_ == nullptr) return;
  if (parts.enclosure) portals_ = Portals(*parts.built, *parts.enclosure);
  to_sun_ = sky_->to_sun();
  sun_radiance_ = sky_->sun_radiance();
  // As in surface_kernel.cc, a sun just below the horizon shines, a lower one does not.
  has_sun_ = to_sun_.z > -0.02f && sun_radiance_.y > 0;
  const Vec3f reference = std::fabs(to_sun_.z) < kUpright ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0};
  sun_right_ = Normalized(Cross(reference, to_sun_));
  sun_up_ = Cross(to_sun_, sun_right_);
}

LightRay PathLights::SampleSun(Vec3f p, Vec2f u) const {
  // The chord to the disc's centre squared is even over solid angle.
  const float chord = SUN_RADIUS * std::sqrt(u.x), turn = kTauF * u.y;
  const float side = chord * std::sqrt(1 - 0.25f * chord * chord);
  const Vec3f d =
      Normalized(to_sun_ * (1 - 0.5f * chord * chord) + sun_right_ * (side * std::cos(turn)) + sun_up_ * (side * std::sin(turn)));
  return {d, SunRadiance(p, d), SunPdf(d), INFINITY};
}

float PathLights::SunPdf(Vec3f d) const {
  const Vec3f off = d - to_sun_;
  return has_sun_ && Dot(off, off) < SUN_RADIUS * SUN_RADIUS ? 2 / (kTauF * SUN_RADIUS * SUN_RADIUS) : 0.0f;
}

Vec3f PathLights::SunRadiance(Vec3f p, Vec3f d) const {
  const Vec3f off = d - to_sun_;
  const float x2 = Dot(off, off) / (SUN_RADIUS * SUN_RADIUS);
  if (!has_sun_ || x2 >= 1) return {};
  return sun_radiance_ * (SUN_LIMB_GAIN * scalar::sun_limb(x2) * sky_->CloudShadow(p));
}

LightRay PathLights::SampleSky(Vec2f u) const {
  const SkySample sample = sky_->Sample(u);
  return {sample.direction, {1, 1, 1}, sample.pdf, INFINITY};
}

LightRay PathLights::SampleSky(Vec3f p, Vec2f u) const {
  const float share = portals_.Share(p);
  if (share == 0) return SampleSky(u);
  const Vec3f d = u.x < share ? portals_.Sample(p, {u.x / share, u.y}) : SampleSky({(u.x - share) / (1 - share), u.y}).direction;
  return {d, {1, 1, 1}, SkyPdf(p, d), INFINITY};
}

float PathLights::SkyPdf(Vec3f p, Vec3f d) const {
  const float share = portals_.Share(p);
  return share == 0 ? SkyPdf(d) : (1 - share) * SkyPdf(d) + share * portals_.Pdf(p, d);
}

LightRay PathLights::SampleLamp(Vec3f p, Vec3f normal, Vec3f u) const {
  const LightSample sample = lamps_.Sample(p, normal, u);
  const Vec3f way = sample.p - p;
  const float distance = Norm(way);
  const Vec3f d = way * (1 / std::max(distance, kLampDistance));
  const float cosine = -Dot(sample.normal, d);
  if (!(sample.pdf > 0) || cosine < kLampGrazing) return {{0, 0, 1}, {}, 0, 0};
  return {d, sample.radiance, sample.pdf * distance * distance / cosine, distance};
}

float PathLights::LampPdf(Vec3f p, Vec3f normal, uint32_t instance, uint32_t triangle, float distance, float cos_lamp) const {
  return lamps_.Pdf(p, normal, instance, triangle) * distance * distance / std::max(cos_lamp, kLampGrazing);
}

}  // namespace airsim360::internal

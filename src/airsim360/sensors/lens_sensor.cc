// The sensors of real360: what their light becomes, and the seam.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/sensors/lens.h"

namespace airsim360::internal {
namespace {

/// Approximately normal with variance 1: the sum of four uniform numbers (Irwin-Hall), at most 3.46.
float NormalOfBits(uint64_t bits) {
  const auto part = [&](int k) { return static_cast<float>((bits >> (16 * k)) & 0xffff); };
  return ((part(0) + part(1) + part(2) + part(3)) * (1.0f / 65536) - 2) * 1.7320508f;
}

Rgb32f Bilinear(const Image<Rgb32f>& image, Vec2d at) {
  const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5);
  const auto u = static_cast<float>(at.x - 0.5 - fx), v = static_cast<float>(at.y - 0.5 - fy);
  const auto read = [&](int dx, int dy) {
    return image(std::clamp(static_cast<int>(fx) + dx, 0, image.width() - 1), std::clamp(static_cast<int>(fy) + dy, 0, image.height() - 1));
  };
  const Rgb32f a = read(0, 0), b = read(1, 0), c = read(0, 1), d = read(1, 1);
  const auto mix = [&](float p, float q, float r, float s) { return (p * (1 - u) + q * u) * (1 - v) + (r * (1 - u) + s * u) * v; };
  return {mix(a.r, b.r, c.r, d.r), mix(a.g, b.g, c.g, d.g), mix(a.b, b.b, c.b, d.b)};
}

}  // namespace

Fisheye SensorCamera(const Real360& lens, const Equirectangular& target) {
  const int size = static_cast<int>(std::lround(lens.fov_deg / 180 * target.height));
  return Fisheye::Equidistant(size, size, lens.fov_deg * kDegree);
}

RigidTransform SensorPose(const Real360& lens, bool rear) {
  const double half = 0.5 * lens.baseline;
  return rear ? RigidTransform{RotationY(std::numbers::pi), {0, 0, -half}} : RigidTransform{{}, {0, 0, half}};
}

void ExposeSensor(const Real360& lens, const Fisheye& camera, bool rear, uint64_t seed, uint64_t frame, Image<Rgb32f>& light) {
  const double gain = rear ? std::exp2(lens.mismatch_ev) : 1;
  const uint64_t key = RngStream(seed, "real360", 2 * frame + (rear ? 1 : 0)).Bits();
  ParallelFor(light.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width(); ++x) {
      const double theta = std::hypot(x + 0.5 - camera.cx, y + 0.5 - camera.cy) / camera.fx;
      const double rim = theta / camera.max_theta;
      const double scale = rim < 1 ? gain * (1 - lens.vignetting * rim * rim) : 0;
      const uint64_t pixel = 3 * (static_cast<uint64_t>(y) * static_cast<uint64_t>(light.width()) + static_cast<uint64_t>(x));
      const auto expose = [&](float value, uint64_t channel) {
        const double signal = value * scale;
        const auto sigma = static_cast<float>(std::sqrt(NoiseVariance(lens, signal)));
        return static_cast<float>(signal) + sigma * NormalOfBits(MixBits(key + pixel + channel));
      };
      const Rgb32f c = light(x, y);
      light(x, y) = {expose(c.r, 0), expose(c.g, 1), expose(c.b, 2)};
    }
  });
}

Image<Rgb32f> StitchSensors(const Real360& lens, const Fisheye& camera, const Image<Rgb32f>& front, const Image<Rgb32f>& rear,
                            const Equirectangular& target) {
  const Camera sensor = camera;
  // Where a sensor sees a direction of its own frame, each colour magnified a little differently.
  const auto look = [&](const Image<Rgb32f>& image, Vec3d d) -> Rgb32f {
    const Vec2d at = RayToPixel(sensor, d).value_or(Vec2d{camera.cx, camera.cy});
    if (lens.fringe == 0) return Bilinear(image, at);
    const Vec2d off = (at - Vec2d{camera.cx, camera.cy}) * lens.fringe;
    return {Bilinear(image, at + off).r, Bilinear(image, at).g, Bilinear(image, at - off).b};
  };
  const double blend = lens.blend_deg * kDegree;
  Image<Rgb32f> result(target.width, target.height);
  ParallelFor(target.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < target.width; ++x) {
      const Vec3d d = *PixelToRay(target, {x + 0.5, y + 0.5});
      const double from_front = std::acos(std::clamp(d.z, -1.0, 1.0));
      const double t = std::clamp((from_front - std::numbers::pi / 2) / blend + 0.5, 0.0, 1.0);
      const auto w = static_cast<float>(t * t * (3 - 2 * t));
      Rgb32f c;
      if (w < 1) c = look(front, d);
      if (w > 0) {
        const Rgb32f b = look(rear, {-d.x, d.y, -d.z});
        c = w < 1 ? Rgb32f{c.r + (b.r - c.r) * w, c.g + (b.g - c.g) * w, c.b + (b.b - c.b) * w} : b;
      }
      result(x, y) = c;
    }
  });
  return result;
}

}  // namespace airsim360::internal

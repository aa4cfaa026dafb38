#include "airsim360/render/sky/sky_picture.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kDegrees = kPiF / 180, kBrightest = 65504;

// The picture with its orientation.
class Picture {
 public:
  explicit Picture(const Environment& environment)
      : pixels_(environment.hdri->pixels),
        turn_(static_cast<float>(environment.hdri_yaw_deg) * kDegrees),
        scale_(static_cast<float>(environment.hdri_scale)) {
    for (Rgb32f& p : pixels_.pixels()) {
      for (float* c : {&p.r, &p.g, &p.b}) *c = std::isfinite(*c) ? std::clamp(*c, 0.0f, kBrightest) * scale_ : 0.0f;
    }
  }
  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }
  Vec3f At(int x, int y) const {
    const Rgb32f p = pixels_(x, y);
    return {p.r, p.g, p.b};
  }
  void Set(int x, int y, Vec3f c) { pixels_(x, y) = {c.x, c.y, c.z}; }
  Vec3f Direction(int x, int y) const {
    const float compass = 2 * kPiF * ((static_cast<float>(x) + 0.5f) / static_cast<float>(width()) - 0.5f) + turn_;
    return DirectionOf(kPiF / 2 - compass, kPiF * (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(height())));
  }
  float SolidAngle(int y) const {
    const float step = kPiF / static_cast<float>(height()), top = kPiF / 2 - static_cast<float>(y) * step;
    return (std::sin(top) - std::sin(top - step)) * 2 * kPiF / static_cast<float>(width());
  }
  // Bilinear.
  Vec3f Look(float azimuth, float elevation) const {
    const float compass = kPiF / 2 - azimuth - turn_;
    float x = (compass / (2 * kPiF) + 0.5f) * static_cast<float>(width()) - 0.5f;
    x -= std::floor(x / static_cast<float>(width())) * static_cast<float>(width());
    const float y = std::clamp((0.5f - elevation / kPiF) * static_cast<float>(height()) - 0.5f, 0.0f, static_cast<float>(height() - 1));
    const int x0 = std::min(static_cast<int>(x), width() - 1), x1 = (x0 + 1) % width();
    const int y0 = static_cast<int>(y), y1 = std::min(y0 + 1, height() - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return (At(x0, y0) * (1 - fx) + At(x1, y0) * fx) * (1 - fy) + (At(x0, y1) * (1 - fx) + At(x1, y1) * fx) * fy;
  }

 private:
  Image<Rgb32f> pixels_;
  float turn_, scale_;
};

// Calls visit(x, y, direction, solid angle) for the pixels within `radius` of a direction.
template <class Visit>
void Around(const Picture& picture, Vec3f center, float radius, const Visit& visit) {
  const float least = std::cos(radius);
  for (int y = 0; y < picture.height(); ++y) {
    const float elevation = kPiF * (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.height()));
    if (std::fabs(elevation - std::asin(std::clamp(center.z, -1.0f, 1.0f))) > radius) continue;
    for (int x = 0; x < picture.width(); ++x) {
      const Vec3f d = picture.Direction(x, y);
      if (Dot(d, center) >= least) visit(x, y, d, picture.SolidAngle(y));
    }
  }
}

struct Overview {
  Vec3f peak;                    // direction of the brightest pixel above the horizon
  float brightest = 0, all = 0;  // its luminance; light of the upper hemisphere
  float mean = 0;
};

Overview Survey(const Picture& picture) {
  Overview view;
  for (int y = 0; y < (picture.height() + 1) / 2; ++y) {
    const float weight = picture.SolidAngle(y);
    for (int x = 0; x < picture.width(); ++x) {
      const float light = Luminance(picture.At(x, y));
      view.all += light * weight;
      if (light > view.brightest) view.brightest = light, view.peak = picture.Direction(x, y);
    }
  }
  view.mean = view.all / (2 * kPiF);
  return view;
}

// Mean of a ring about a direction.
Vec3f MeanOfRing(const Picture& picture, Vec3f center, float inner, float outer) {
  Vec3f sum{};
  float weight = 0;
  Around(picture, center, outer, [&](int x, int y, Vec3f d, float solid_angle) {
    if (Dot(d, center) > std::cos(inner)) return;
    sum += picture.At(x, y) * solid_angle;
    weight += solid_angle;
  });
  return weight > 0 ? sum * (1 / weight) : Vec3f{};
}

PictureSun TakeSun(Picture& picture) {
  constexpr float kReach = 3 * kDegrees, kGlare = 1.5f * kDegrees;
  const Overview view = Survey(picture);
  if (view.brightest < 40 * view.mean || view.peak.z < 0.02f) return {};
  // Light beyond the surroundings, near and in all.
  const Vec3f around = MeanOfRing(picture, view.peak, 6 * kDegrees, 9 * kDegrees);
  Vec3f middle{};
  float near = 0, wide = 0;
  Around(picture, view.peak, 2 * kReach, [&](int x, int y, Vec3f d, float solid_angle) {
    const Vec3f more = Max(picture.At(x, y) - around, Vec3f{}) * solid_angle;
    wide += Luminance(more);
    if (Dot(d, view.peak) < std::cos(kReach)) return;
    near += Luminance(more);
    middle += d * Luminance(more);
  });
  if (near < 0.8f * wide || near < 0.1f * view.all) return {};
  // What is taken out goes on as bright as the sky just outside, so that no disc shows. Within the glare of the
  // camera's lens that also covers the dark pixels with which sharpening rims the sun.
  const Vec3f center = Normalized(middle), rim = MeanOfRing(picture, center, kReach, 1.2f * kReach);
  Vec3f taken{};
  Around(picture, center, kReach, [&](int x, int y, Vec3f d, float solid_angle) {
    const Vec3f c = picture.At(x, y);
    const bool glare = Dot(d, center) > std::cos(kGlare);
    const Vec3f left = glare ? rim : Vec3f{std::min(c.x, rim.x), std::min(c.y, rim.y), std::min(c.z, rim.z)};
    taken += (c - left) * solid_angle;
    picture.Set(x, y, left);
  });
  return {center, Max(taken, Vec3f{})};
}

SkyTable Resample(const Picture& picture, float side) {
  SkyTable table = MakeTable(2048, 512, false);
  const int fine = std::clamp((picture.width() + 2047) / 2048, 2, 6);
  ParallelFor(table.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    const float low = table.ElevationOfRow(std::max(y - 1, 0)), high = table.ElevationOfRow(std::min(y + 1, table.height - 1));
    for (int x = 0; x < table.width; ++x) {
      Vec3f sum{};
      for (int k = 0; k < fine * fine; ++k) {
        const float u = (static_cast<float>(k % fine) + 0.5f) / static_cast<float>(fine),
                    v = (static_cast<float>(k / fine) + 0.5f) / static_cast<float>(fine);
        sum += picture.Look((static_cast<float>(x) + u) * 2 * kPiF / static_cast<float>(table.width),
                            side * (low + (high - low) * (0.25f + 0.5f * v)));
      }
      table.SetTexel(x, y, sum * (1 / static_cast<float>(fine * fine)));
    }
  });
  return table;
}

}  // namespace

SplitPicture SplitSkyPicture(const Environment& environment) {
  Picture picture(environment);
  SplitPicture split;
  split.sun = TakeSun(picture);
  split.above = Resample(picture, 1);
  split.below = Resample(picture, -1);
  return split;
}

}  // namespace airsim360::internal

// The moon as the sky shows it: size, light, phase.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shared/shading_kernels.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr double kRadius = 0.265 * M_PI / 180;  // 31.8 arc minutes across: the mean of the moon's 29.4 to 33.5

struct Disc {
  double irradiance = 0, area = 0;  // of what is brighter than the sky beside it; share of the disc
  double towards_sun = 0;           // mean place along the direction to the sun in the sky, in radii
  double outside = 0;               // of the light beyond the radius
};

// Looks at the sky about the moon in steps of a fortieth of its radius.
Disc Look(double phase) {
  Environment night;
  night.sun_elevation_deg = -25, night.sun_azimuth_deg = 330, night.cloud_cover = night.cirrus_cover = 0;
  night.moon_phase = phase;
  const Sky sky(night);
  EXPECT_TRUE(sky.is_moon());
  SceneBuilder builder("empty");
  builder.AddSky();
  const std::shared_ptr<const Scene> scene = builder.Build();
  const SurfaceTables tables(*scene);
  const ShadeView view = MakeShadeView(*scene, tables, &sky, nullptr, &night);
  const Vec3f to = sky.to_sun(), right = Normalized(Cross(to, {0, 0, 1})), up = Cross(right, to);
  const Vec3f side = Normalized(sky.moon_light() + to * Dot(sky.moon_light(), to) * -1.0f);
  constexpr int kSteps = 60;
  const double step = kRadius / 40;
  auto rays = std::make_unique<RaySet>();
  auto with = std::make_unique<LightSet>(), without = std::make_unique<LightSet>();
  *rays = {};
  Disc disc;
  for (int y = -kSteps; y < kSteps; ++y) {
    rays->count = 2 * kSteps;
    for (int x = 0; x < 2 * kSteps; ++x) {
      const Vec3f d =
          Normalized(to + (right * static_cast<float>(x - kSteps + 0.5) + up * static_cast<float>(y + 0.5)) * static_cast<float>(step));
      rays->dx[x] = d.x, rays->dy[x] = d.y, rays->dz[x] = d.z;
    }
    AIRSIM360_SELECT_KERNEL(LookUpSky)(view, *rays, true, *with);
    AIRSIM360_SELECT_KERNEL(LookUpSky)(view, *rays, false, *without);
    for (int x = 0; x < 2 * kSteps; ++x) {
      const double light = with->g[x] - without->g[x];
      if (!(light > 0)) continue;
      const double u = (x - kSteps + 0.5) / 40, v = (y + 0.5) / 40;
      disc.irradiance += light * step * step;
      disc.area += 1 / (1600 * M_PI);
      disc.towards_sun += light * step * step * (u * Dot(right, side) + v * Dot(up, side));
      if (u * u + v * v > 1.03) disc.outside += light * step * step;
    }
  }
  EXPECT_NEAR(disc.irradiance / sky.sun_irradiance().y, 1, 0.03) << phase;
  disc.towards_sun /= disc.irradiance;
  return disc;
}

TEST(Moon, FullItIsHalfADegreeAcrossAndBringsItsIlluminance) {
  const Disc full = Look(1);
  EXPECT_NEAR(full.area, 1, 0.02);
  EXPECT_LT(full.outside, 0.01 * full.irradiance);
  EXPECT_NEAR(full.towards_sun, 0, 0.1);
}

TEST(Moon, ShowsItsLitShareOnTheSideOfTheSun) {
  for (const double phase : {0.25, 0.5, 0.75}) {
    const Disc disc = Look(phase);
    EXPECT_NEAR(disc.area, phase, 0.03);
    EXPECT_GT(disc.towards_sun, 0.1);
  }
}

TEST(Moon, IsAsBrightAtItsLimbAsInItsMiddleButForItsSeas) {
  const Vec3f to{1, 0, 0}, light{-1, 0, 0};
  EXPECT_NEAR(scalar::moon_face({0, 0.05f, -0.9f}, to, light), 1, 1e-3);
  EXPECT_NEAR(scalar::moon_face({0, 0.1f, 0.02f}, to, light), 1, 0.05);
  EXPECT_LT(scalar::moon_face({0, 0.30f, 0.50f}, to, light), 0.7f);  // Imbrium, left of the middle and up
  EXPECT_EQ(scalar::moon_face({0, 1.01f, 0}, to, light), 0);
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/render/shading/shade_view.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

SkyTableView ViewOf(const SkyTable& table) {
  return {table.texels.data(), static_cast<float>(table.width), static_cast<float>(table.height), table.stride()};
}

// What lies on the surfaces, and how many rooms are lit.
void PutWeather(const Environment& environment, const Sky* sky, ShadeView& view) {
  const auto share = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
  view.wetness = share(environment.wetness);
  view.snow = share(environment.snow_depth);
  view.rain = share(environment.rain_mm_h / 8);  // heavy rain: 8 mm/h and more
  if (sky) view.open_sky = Dot(sky->Irradiance({0, 0, 1}), {0.2126f, 0.7152f, 0.0722f});
  // Rooms in use by day and in the evening; 150 to 500 lx under lamps, sunlight being 133 klx or 20 units.
  view.lit_rooms = environment.lamps_on() ? 0.45f : environment.lamps == Lamps::kOff ? 0.0f : 0.12f;
  view.evening = environment.lamps_on() ? 1.0f : 0.0f;
  view.lamplight = 500.0f / 133300.0f * 20.0f / 3.14159265f;
}

// What moon_face is to be multiplied with for a mean of 1 over the disc.
float MoonGain(Vec3f to_moon, Vec3f light) {
  constexpr int kCells = 128;
  const Vec3f right = Normalized(Cross(to_moon, std::fabs(to_moon.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0})), up = Cross(right, to_moon);
  double sum = 0;
  int count = 0;
  for (int k = 0; k < kCells * kCells; ++k) {
    const float x = 2 * (static_cast<float>(k % kCells) + 0.5f) / kCells - 1, y = 2 * (static_cast<float>(k / kCells) + 0.5f) / kCells - 1;
    if (x * x + y * y >= 1) continue;
    sum += scalar::moon_face(right * x + up * y, to_moon, light);
    ++count;
  }
  return static_cast<float>(count / std::max(sum, 1e-3));
}

}  // namespace

ShadeView MakeShadeView(const Scene& scene, const SurfaceTables& tables, const Sky* sky, const LightProbes* probes,
                        const Environment* environment) {
  ShadeView view{};
  view.triangles = tables.triangles.data();
  view.instances = tables.instances.data();
  view.materials = tables.materials.data();
  view.textures = tables.textures.data();
  view.mean_colors = tables.mean_colors.empty() ? nullptr : &tables.mean_colors[0].x;
  view.mean_emissions = tables.mean_emissions.empty() ? nullptr : &tables.mean_emissions[0].x;
  view.glows = tables.glows.empty() ? nullptr : &tables.glows[0].x;
  view.panes = tables.panes.data();
  view.colors = tables.colors.empty() ? nullptr : tables.colors.data();
  view.macro_texture = 1;
  PutWeather(environment ? *environment : scene.environment, sky, view);
  view.ground_z = scene.bounds.empty() ? 0.0f : scene.bounds.min.z;
  if (probes) view.probes = probes->view();
  if (!sky) {
    Put(view.mean_ambient, scene.interior_light);
    return view;
  }
  view.has_sky = 1;
  view.sky = ViewOf(sky->table());
  for (int i = 0; i < Sky::kBlurLevels; ++i) view.blurred[i] = ViewOf(sky->blurred(i));
  Put(view.to_sun, sky->to_sun());
  Put(view.sun_irradiance, sky->sun_irradiance());
  Put(view.sun_radiance, sky->sun_radiance());
  view.sun_seen = sky->sun_seen();
  if (sky->is_moon()) {
    Put(view.moon_light, sky->moon_light());
    view.moon_gain = MoonGain(sky->to_sun(), sky->moon_light());
  }
  view.air = sky->air();
  view.cloud_shadow = sky->cloud_shadow().view();
  if (sky->below().height > 0) view.sky_below = ViewOf(sky->below());
  Put(view.ground, sky->ground_radiance());
  for (int k = 0; k < 27; ++k) view.sky_irradiance[k] = sky->irradiance_sh()[k / 3][k % 3];
  return view;
}

}  // namespace airsim360::internal

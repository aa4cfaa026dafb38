// Lamps that move: what they light where they are, and no longer where they were.
#include "airsim360/render/lights/moving_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal {
namespace {

constexpr float kLensArea = 0.02f, kLensRadiance = 50, kSharpness = 30, kLensHeight = 0.7f;

Mesh Plate(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A road, a wall of 4 m by 3 m in the plane y = 60, and vehicles that are a lens of 0.2 m x 0.1 m each, looking along -Y of their
// mesh, and begin far away.
struct Road {
  SceneBuilder builder{"road"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const RayTracer> built, tracer;
  std::unique_ptr<DynamicTracer> dynamic;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<LightTable> lights;
  std::unique_ptr<LampGrid> grid;
  MovingLamps moving;
  std::vector<LampRecord> still;
  Environment environment;
  ShadeView view{};

  uint32_t Add(Mesh mesh, const Material& material, const AffineTransform& X_WM = {}) {
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), X_WM, entity});
    return count++;
  }
  explicit Road(int vehicles, bool night = true) {
    environment.lamps = night ? Lamps::kOn : Lamps::kOff;
    Add(Plate({-150, -150, 0}, {150, -150, 0}, {150, 150, 0}, {-150, 150, 0}), {});
    Add(Plate({-2, 60, 0}, {2, 60, 0}, {2, 60, 3}, {-2, 60, 3}), {});
    Material lens;
    lens.base_color = {};
    lens.emission = {kLensRadiance, kLensRadiance, kLensRadiance};
    lens.beam = kSharpness;
    lens.lamp = true;
    const Mesh quad = Plate({-0.1f, 0, -0.05f}, {0.1f, 0, -0.05f}, {0.1f, 0, 0.05f}, {-0.1f, 0, 0.05f});
    for (int k = 0; k < vehicles; ++k) Add(quad, lens, PlaceUpright(Home(k), 0));
    built = tracer = std::make_shared<const RayTracer>(builder.Build());
    dynamic = std::make_unique<DynamicTracer>(built);
    tables = std::make_unique<SurfaceTables>(tracer->scene(), environment.lamps_on());
    lights = std::make_unique<LightTable>(tracer->scene(), *tables, environment);
    grid = std::make_unique<LampGrid>(*tracer, *lights, 0.0f);
    Show({});
  }
  static Vec3f Home(int vehicle) { return {-120, -120 + 2 * static_cast<float>(vehicle), kLensHeight}; }
  // Vehicles from the first on, where they are now; hidden where `visible` is false.
  void Show(const std::vector<AffineTransform>& places, bool visible = true, float daylight = 0) {
    auto state = std::make_shared<SceneState>();
    for (uint32_t k = 0; k < places.size(); ++k) state->moved.push_back({2 + k, places[k], !visible});
    tracer = dynamic->At(state);
    tables->Apply(tracer->scene(), tracer->moved(), tracer->deformed());
    const std::vector<MovedInstance> away = AwayFromHome(*tracer);
    std::vector<uint32_t> instances;
    for (const MovedInstance& m : away) instances.push_back(m.instance);
    view.lamps = grid->ViewWithout(instances, still);
    moving.Follow(*tracer, *tables, environment, away, daylight);
    view.moving_lamps = moving.view();
  }
  // Irradiance at a point.
  float Light(Vec3f p, Vec3f normal, int rays = 2) const {
    auto set = std::make_unique<RaySet>();
    auto s = std::make_unique<SurfaceSet>();
    auto wanted = std::make_unique<LampRays>();
    *set = {};
    *s = {};
    set->count = 1;
    s->px[0] = p.x, s->py[0] = p.y, s->pz[0] = p.z;
    s->nx[0] = s->gx[0] = normal.x, s->ny[0] = s->gy[0] = normal.y, s->nz[0] = s->gz[0] = normal.z;
    s->roughness[0] = 1;
    set->dx[0] = -normal.x, set->dy[0] = -normal.y, set->dz[0] = -normal.z;
    set->distance[0] = 5;
    if (view.lamps.lamps != nullptr) {
      AIRSIM360_SELECT_KERNEL(LightByLamps)(view, *set, rays, nullptr, *s, *wanted);
      TraceLamps(*tracer, *tables, *set, *wanted, rays, *s);
    }
    if (view.moving_lamps.lamps != nullptr && AIRSIM360_SELECT_KERNEL(LightByMovingLamps)(view, *set, rays, *s, *wanted))
      TraceLamps(*tracer, *tables, *set, *wanted, rays, *s);
    return s->lamp_g[0];
  }

 private:
  uint32_t count = 0;
};

// cd per unit of solid angle towards w, of a lens that looks along `front`.
double Candela(Vec3f front, Vec3f w) {
  const Vec3f axis = Normalized(front + Vec3f{0, 0, kBeamDrop});
  const double spread = 1 + kSharpness * (1 - Dot(axis, w)), cut = 0.06 + 0.94 * std::clamp(0.45 - 10 * w.z, 0.0, 1.0);
  return kLensRadiance * kLensArea * std::max(0.0f, Dot(front, w)) * cut / (spread * spread);
}

TEST(MovingLamps, LightTheRoadAheadByTheSquareOfTheDistanceAndTheCosineAndAreCutOffAboveTheHorizon) {
  Road road(1);
  for (const float turn : {0.0f, 1.1f}) {
    const Vec3f lens{12, -7, kLensHeight}, front{std::sin(turn), -std::cos(turn), 0}, left{std::cos(turn), std::sin(turn), 0};
    road.Show({PlaceUpright(lens, turn)});
    ASSERT_EQ(road.moving.lamps(), 1u);
    // On the road, where the beam's axis meets it and nearer and farther; to the side.
    for (const Vec3f ahead : {front * 4, front * (kLensHeight / -kBeamDrop), front * 30, front * 9 + left * 3}) {
      const Vec3f p{lens.x + ahead.x, lens.y + ahead.y, 0}, to = p - lens, w = Normalized(to);
      EXPECT_NEAR(road.Light(p, {0, 0, 1}) / (Candela(front, w) / Dot(to, to) * -w.z), 1, 0.01) << Norm(to) << " m, turned " << turn;
    }
    // What stands before it, below and above the cut-off: a sixteenth is scattered there.
    for (const float rise : {-0.5f, 2.0f}) {
      const Vec3f to = front * 10 + Vec3f{0, 0, rise}, w = Normalized(to);
      EXPECT_NEAR(road.Light(lens + to, -front) / (Candela(front, w) / Dot(to, to) * Dot(front, w)), 1, 0.01) << rise;
    }
    EXPECT_LT(road.Light(lens + front * 10 + Vec3f{0, 0, 2}, -front), 0.1f * road.Light(lens + front * 10 + Vec3f{0, 0, -0.5f}, -front));
    // Behind it, and beyond where head lamps count.
    EXPECT_EQ(road.Light({lens.x - 4 * front.x, lens.y - 4 * front.y, 0}, {0, 0, 1}), 0);
    EXPECT_EQ(road.Light(lens + front * 90, -front), 0);
  }
}

TEST(MovingLamps, LeaveThePlaceTheyWereBuiltInDarkAndLightItAgainWhenTheyAreBack) {
  Road road(1);
  const Vec3f home = Road::Home(0), before = home + Vec3f{0, -6, -kLensHeight};
  const float light = road.Light(before, {0, 0, 1});
  EXPECT_GT(light, 0);
  EXPECT_EQ(road.moving.lamps(), 0u);
  road.Show({PlaceUpright({12, -7, kLensHeight}, 0)});
  EXPECT_EQ(road.Light(before, {0, 0, 1}), 0);
  road.Show({PlaceUpright({12, -7, kLensHeight}, 0)}, false);
  EXPECT_EQ(road.Light(before, {0, 0, 1}), 0);
  EXPECT_EQ(road.moving.lamps(), 0u);
  road.Show({PlaceUpright(home, 0)});
  EXPECT_EQ(road.Light(before, {0, 0, 1}), light);
}

TEST(MovingLamps, AreHiddenByAWall) {
  Road road(2);
  const float turn = kPiF;  // towards +Y
  road.Show({PlaceUpright({0, 50, kLensHeight}, turn), PlaceUpright({0.9f, 50, kLensHeight}, turn)});
  EXPECT_EQ(road.moving.lamps(), 2u);
  EXPECT_GT(road.Light({0, 57, 0}, {0, 0, 1}), 0);
  EXPECT_GT(road.Light({0, 59.9f, 1}, {0, -1, 0}), 0);
  // What the columns guessed is taken back, up to rounding.
  EXPECT_NEAR(road.Light({0, 61, 0}, {0, 0, 1}), 0, 1e-8f);
  EXPECT_NEAR(road.Light({0, 66, 0.5f}, {0, -1, 0}), 0, 1e-8f);
  // Beside the wall.
  EXPECT_GT(road.Light({6, 66, 0}, {0, 0, 1}), 0);
}

TEST(MovingLamps, FarBeyondTheWorldLightNobodyAndTakeNoRoom) {
  Road road(2);
  for (const float far : {2e6f, 1e30f, -3e38f}) {
    road.Show({PlaceUpright({far, 0, kLensHeight}, 0), PlaceUpright({0, 0, kLensHeight}, 0)});
    EXPECT_EQ(road.moving.lamps(), 1u) << far;
  }
}

TEST(MovingLamps, AreNothingByDay) {
  Road off(1, false);
  off.Show({PlaceUpright({12, -7, kLensHeight}, 0)});
  EXPECT_EQ(off.view.moving_lamps.lamps, nullptr);
  Road on(1);
  on.Show({PlaceUpright({12, -7, kLensHeight}, 0)}, true, 1e4f);
  EXPECT_EQ(on.view.moving_lamps.lamps, nullptr);
}

TEST(MovingLamps, AColumnKeepsTheStrongestAndAnyNumberOfThreadsGivesTheSameBytesWhateverWasShownBefore) {
  const auto fill = [](float x) {
    std::vector<AffineTransform> places;
    for (int k = 0; k < 40; ++k)
      places.push_back(PlaceUpright({x + 3 * static_cast<float>(k % 4), 5 * static_cast<float>(k) - 100, kLensHeight},
                                    0.1f * static_cast<float>(k % 3)));
    return places;
  };
  const auto bytes = [](const LampView& v) {
    std::vector<uint8_t> all;
    const auto add = [&](const void* data, size_t size) {
      all.insert(all.end(), static_cast<const uint8_t*>(data), static_cast<const uint8_t*>(data) + size);
    };
    const auto places = static_cast<size_t>(v.nx) * static_cast<size_t>(v.ny);
    add(v.cell_of, places * sizeof(uint32_t));
    add(v.cells, (1 + size_t{*std::max_element(v.cell_of, v.cell_of + places)}) * sizeof(LampCell));
    add(v.lamps, 40 * sizeof(LampRecord));
    return all;
  };
  Road road(40);
  road.Show(fill(30));
  road.Show(fill(0));
  const auto many = bytes(road.view.moving_lamps);
  // Of forty in a row the strongest are those near by.
  const LampView& v = road.view.moving_lamps;
  const auto x = static_cast<int>((5 - v.origin_x) * v.cells_per_metre), y = static_cast<int>((-70 - v.origin_y) * v.cells_per_metre);
  const LampCell& column = v.cells[v.cell_of[y * v.nx + x]];
  ASSERT_EQ(column.header & 255, static_cast<uint32_t>(LampCell::kLamps));
  for (int k = 0; k < LampCell::kLamps; ++k) EXPECT_LT(v.lamps[column.lamp[k] & 0xffffffu].center[1], 10);
  const ThreadLimit one(1);
  Road fresh(40);
  fresh.Show(fill(0));
  EXPECT_TRUE(bytes(fresh.view.moving_lamps) == many);
}

}  // namespace
}  // namespace airsim360::internal

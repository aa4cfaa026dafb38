#include "airsim360/routes/world_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/planning/routes/point_to_point.h"
#include "airsim360/routes/road_route.h"

namespace airsim360 {
namespace {

Mesh Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) { return {"quad", {a, b, c, d}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}}; }

// A small leaf-like mesh of many small triangles, used often, turned and scaled.
std::shared_ptr<const Scene> Grove() {
  RngStream rng(1, "grove");
  const auto u = [&](double low, double high) { return static_cast<float>(rng.Uniform(low, high)); };
  SceneBuilder builder("grove");
  const EntityId ground = builder.AddEntity("ground", builder.tree().At("ground/road"));
  const EntityId tree = builder.AddEntity("tree", builder.tree().At("vegetation/tree"));
  builder.AddInstance({builder.AddMesh(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0})), {}, ground});
  Mesh leaves{"leaves", {}, {}, {}, {}, {}};
  for (uint32_t i = 0; i < 400; ++i) {
    const Vec3f p{u(-1, 1), u(-1, 1), u(0, 3)};
    for (int k = 0; k < 3; ++k) leaves.positions.push_back(p + Vec3f{u(-0.1, 0.1), u(-0.1, 0.1), u(-0.1, 0.1)});
    leaves.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  leaves.positions.insert(leaves.positions.end(), {{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 3}});
  leaves.triangles.push_back({1200, 1201, 1202});
  const MeshId mesh = builder.AddMesh(leaves);
  for (int i = 0; i < 25; ++i) builder.AddInstance({mesh, PlaceUpright({u(-25, 25), u(-25, 25), 0}, u(0, 6), u(0.4, 2)), tree});
  builder.SetSpawn({0, 0, 9});
  builder.AddSky();
  return builder.Build();
}

TEST(MapScene, IsNeverAboveTheExactDistanceAndNearItWhereThingsAreSmall) {
  const auto scene = Grove();
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const Box3d box{{-30, -30, -1}, {30, 30, 12}};
  const auto map = MapScene(*scene, box, 0.5);
  RngStream rng(2, "points");
  double gap = 0;
  int near = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d p{rng.Uniform(-29, 29), rng.Uniform(-29, 29), rng.Uniform(0, 11)};
    const double exact = tracer->Clearance(VecCast<float>(p), 20);
    EXPECT_LE(map->At(p), exact + 1e-4);
    if (exact < 6) {
      gap += exact - map->At(p);
      ++near;
    }
  }
  EXPECT_LT(gap / near, 2 * 0.5 * std::sqrt(3.0));
}

TEST(WorldClearance, LowerBoundsAreBoundsAndExactWhereTheMapIsNotEnough) {
  const auto scene = Grove();
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const WorldClearance world(tracer, MapScene(*scene, {{-30, -30, -1}, {30, 30, 12}}, 0.5));
  RngStream rng(3, "points");
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p{rng.Uniform(-29, 29), rng.Uniform(-29, 29), rng.Uniform(0, 11)};
    const double exact = tracer->Clearance(VecCast<float>(p), 20);
    const double bound = world.LowerBound(p, 1.2, 5);
    EXPECT_LE(bound, exact + 1e-5);
    if (bound < 1.2) {
      EXPECT_NEAR(bound, std::min(exact, 5.0), 1e-3);
    }
    EXPECT_LE(world.Clearance(p, 20), exact + 1e-5);
  }
}

double DistanceToSegment(Vec3d p, Vec3d a, Vec3d b) {
  const double length2 = Dot(b - a, b - a), along = Dot(p - a, b - a);
  return Norm(p - a - (b - a) * (length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0));
}

// By the triangle's plane if the foot of p is inside, else by its edges: nothing that Embree does.
double DistanceToTriangle(Vec3d p, const std::array<Vec3d, 3>& t) {
  const Vec3d n = Cross(t[1] - t[0], t[2] - t[0]);
  bool inside = Dot(n, n) > 0;
  double distance = 1e9;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3d a = t[i], b = t[(i + 1) % 3];
    inside &= Dot(Cross(n, b - a), p - a) >= 0;
    distance = std::min(distance, DistanceToSegment(p, a, b));
  }
  return inside ? std::fabs(Dot(p - t[0], n)) / Norm(n) : distance;
}

TEST(WorldClearance, CertifiedFlightsKeepTheirDistanceFromEveryTriangle) {
  const auto scene = Grove();
  std::vector<std::array<Vec3d, 3>> triangles;
  for (const Instance& instance : scene->instances) {
    const Mesh& mesh = scene->meshes[instance.mesh];
    for (const Vec3u t : mesh.triangles) {
      triangles.push_back({VecCast<double>(instance.X_WM * mesh.positions[t.x]), VecCast<double>(instance.X_WM * mesh.positions[t.y]),
                           VecCast<double>(instance.X_WM * mesh.positions[t.z])});
    }
  }
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const Box3d box = FlightBox(*tracer);
  const WorldClearance surfaces(tracer, MapScene(*scene, box, 0.5));
  const BoundedClearance world(surfaces, box);
  constexpr double kRadius = 0.4;
  const FlightOptions options{.limits = {.speed = 6, .acceleration = 4}, .allocation = {}, .radius = kRadius};
  double least = 1e9;
  for (const double y : {-20.0, -7.0, 6.0, 19.0}) {
    const CertifiedFlight flight = FlyFree({{-27, y, 1.2}, {27, -0.7 * y, 1.5}}, world, options);
    ASSERT_TRUE(flight.certificate.certified);
    const PolynomialTrajectory& path = flight.flight.trajectory;
    constexpr int kSamples = 300;
    for (int i = 0; i <= kSamples; ++i) {
      const Vec3d p = path.At(path.duration() * i / kSamples).p;
      double distance = 1e9;
      for (const auto& triangle : triangles) distance = std::min(distance, DistanceToTriangle(p, triangle));
      EXPECT_GE(distance, kRadius);
      least = std::min(least, distance);
    }
  }
  EXPECT_LT(least, kRadius + 0.3);  // they did fly among the leaves
}

TEST(FlightBox, IsTheRoomInsideAndOverTheGroundOutside) {
  const RayTracer room(LoadWorld({.world = "box_room"}));
  const Box3d box = FlightBox(room);
  EXPECT_NEAR(box.min.x, -5, 1e-5);
  EXPECT_NEAR(box.max.z, 6, 1e-5);
  const RayTracer grove(Grove());
  const Box3d outside = FlightBox(grove, 30);
  EXPECT_LE(outside.min.x, -30);
  EXPECT_GT(outside.max.z, 30);
}

TEST(CheckAboveGround, RefusesPlacesBelowIt) {
  const RayTracer grove(Grove());
  EXPECT_NO_THROW(CheckAboveGround(grove, {3, 4, 5}, "waypoint 1"));
  EXPECT_THROW(CheckAboveGround(grove, {3, 4, -5}, "waypoint 1"), InputError);
  EXPECT_THROW(CheckAboveGround(grove, {300, 4, 5}, "waypoint 1"), InputError);
}

TEST(RoadRoute, FollowsTheMiddleOfAnAngleAtItsHeight) {
  SceneBuilder builder("roads");
  const EntityId lawn = builder.AddEntity("lawn", builder.tree().At("ground/grass"));
  const EntityId road = builder.AddEntity("road", builder.tree().At("ground/road"));
  builder.AddInstance({builder.AddMesh(Quad({-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0})), {}, lawn});
  builder.AddInstance({builder.AddMesh(Quad({-50, -5, 0.05f}, {5, -5, 0.05f}, {5, 5, 0.05f}, {-50, 5, 0.05f})), {}, road});
  builder.AddInstance({builder.AddMesh(Quad({-5, -5, 0.06f}, {5, -5, 0.06f}, {5, 50, 0.06f}, {-5, 50, 0.06f})), {}, road});
  builder.AddSky();
  const RayTracer tracer(builder.Build());
  const std::vector<Vec3d> route = RoadRoute(tracer, {.height = 6});
  double length = 0;
  for (size_t i = 0; i < route.size(); ++i) {
    EXPECT_NEAR(route[i].z, 6.05, 0.02);
    if (i > 0) length += Norm(route[i] - route[i - 1]);
    // On the road everywhere, also between the corners.
    for (int k = 0; i > 0 && k <= 20; ++k) {
      const Vec3d p = route[i - 1] + (route[i] - route[i - 1]) * (k / 20.0);
      EXPECT_TRUE((p.x > -51 && p.x < 6 && std::fabs(p.y) < 6) || (p.y > -6 && p.y < 51 && std::fabs(p.x) < 6));
    }
  }
  EXPECT_GT(length, 85);
  EXPECT_LT(length, 115);
}

TEST(RoadRoute, NeedsARoad) {
  const RayTracer room(LoadWorld({.world = "box_room"}));
  EXPECT_THROW(RoadRoute(room, {}), InputError);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/flight/mesh/drone_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/design.h"

namespace airsim360 {
namespace {

std::vector<DroneModel> Models() {
  return {CatalogModel("crazyflie"), CatalogModel("agilicious"), CatalogModel("octo"), DroneFromPrompt("a coaxial 8 kg drone").model};
}

TEST(DroneBody, EveryPartIsAClosedSurfaceTurnedOutwards) {
  for (const DroneModel& model : Models()) {
    for (const bool discs : {false, true}) {
      const DroneBody body = MakeDroneBody(model, {3, discs});
      for (const DronePart& part : body.parts) {
        // Each edge is walked once each way; the signed volume is positive.
        std::map<std::pair<uint32_t, uint32_t>, int> edges;
        double volume = 0;
        for (uint32_t t = part.first; t < part.first + part.count; ++t) {
          const Vec3u v = body.triangles[t];
          for (const auto& [a, b] : {std::pair{v.x, v.y}, {v.y, v.z}, {v.z, v.x}}) ++edges[{a, b}];
          volume +=
              Dot(VecCast<double>(body.positions[v.x]), Cross(VecCast<double>(body.positions[v.y]), VecCast<double>(body.positions[v.z])));
        }
        EXPECT_GT(volume, 0) << model.name << " " << part.name;
        for (const auto& [edge, count] : edges) {
          EXPECT_EQ(count, 1);
          EXPECT_EQ((edges.count({edge.second, edge.first})), 1u) << part.name;
        }
      }
    }
  }
}

TEST(DroneBody, PartsShareOutAllTrianglesAndEveryRotorHasAPropeller) {
  for (const DroneModel& model : Models()) {
    const DroneBody body = MakeDroneBody(model);
    uint32_t next = 0;
    std::vector<int> propellers(model.rotors.size());
    for (const DronePart& part : body.parts) {
      EXPECT_EQ(part.first, next);
      next += part.count;
      if (part.rotor >= 0) ++propellers[static_cast<size_t>(part.rotor)];
    }
    EXPECT_EQ(next, body.triangles.size());
    for (const int count : propellers) EXPECT_EQ(count, 1);
  }
}

TEST(DroneBody, StaysInsideTheBoxOfTheDrone) {
  for (const DroneModel& model : Models()) {
    for (const Vec3f p : MakeDroneBody(model, {2, true}).positions) {
      EXPECT_LE(std::abs(p.x), 1.01 * model.half_size_B.x + 1e-6) << model.name;
      EXPECT_LE(std::abs(p.y), 1.01 * model.half_size_B.y + 1e-6) << model.name;
      EXPECT_LE(std::abs(p.z), 1.01 * model.half_size_B.z + 1e-6) << model.name;
    }
  }
}

TEST(DroneBody, PropellersReachAsFarAsTheirRotors) {
  const DroneModel model = CatalogModel("agilicious");
  const DroneBody body = MakeDroneBody(model);
  for (const DronePart& part : body.parts) {
    if (part.rotor < 0) continue;
    double reach = 0;
    for (uint32_t t = part.first; t < part.first + part.count; ++t) {
      const Vec3d p = VecCast<double>(body.positions[body.triangles[t].x]) - model.rotors[part.rotor].p_B;
      reach = std::max(reach, std::hypot(p.x, p.y));
    }
    EXPECT_NEAR(reach, 0.065, 0.004);
  }
}

}  // namespace
}  // namespace airsim360

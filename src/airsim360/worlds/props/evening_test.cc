#include "airsim360/worlds/props/evening.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "airsim360/scene/luminance.h"
#include "airsim360/worlds/props/props.h"

namespace airsim360::internal {
namespace {

// Candela straight ahead (-1) or behind (+1) of all that throws a beam there.
float Candela(const Model& model, float side) {
  float sum = 0;
  for (const MeshPart& part : model.mesh.parts) {
    const Material& m = model.materials[part.material];
    if (m.beam * side >= 0 || std::fabs(m.beam) < 1) continue;
    EXPECT_TRUE(m.lamp);
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = model.mesh.triangles[k];
      const Vec3f a = model.mesh.positions[t.x];
      const float area = 0.5f * Cross(model.mesh.positions[t.y] - a, model.mesh.positions[t.z] - a).y * side;
      if (area > 0) sum += area * Luminance(m.emission) / kNit;
    }
  }
  return sum;
}

TEST(Evening, EveryVehicleOfOursHasTwoLowBeamsAndTwoTailLamps) {
  for (const PropKind& kind : PropKinds()) {
    if (kind.name != "car" && kind.name != "taxi" && kind.name != "van" && kind.name != "bus") continue;
    for (uint32_t variant = 0; variant < static_cast<uint32_t>(kind.variants); ++variant) {
      const Model model = MakeProp(kind, variant, 1, nullptr);
      EXPECT_NEAR(Candela(model, -1), 10000, 100) << kind.name << " " << variant;
      EXPECT_NEAR(Candela(model, 1), 12, 0.5) << kind.name << " " << variant;
    }
  }
}

TEST(Evening, LensesKeepTheirPlaceAndTheirLookByDay) {
  const PropKind& kind = FindPropKind("car");
  const Model before = kind.make(0, 1);
  Model after = before;
  AddVehicleLamps(after);
  const auto pieces = [](const Model& model) {
    std::multiset<std::array<float, 12>> all;
    for (const MeshPart& part : model.mesh.parts) {
      const Material& m = model.materials[part.material];
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        const Vec3u t = model.mesh.triangles[k];
        std::array<float, 12> piece{m.base_color.x, m.base_color.y, m.roughness};
        int at = 3;
        for (const uint32_t corner : {t.x, t.y, t.z})
          for (int i = 0; i < 3; ++i) piece[static_cast<size_t>(at++)] = model.mesh.positions[corner][i];
        all.insert(piece);
      }
    }
    return all;
  };
  EXPECT_EQ(pieces(before), pieces(after));
  EXPECT_EQ(before.mesh.positions, after.mesh.positions);
  EXPECT_GT(after.mesh.parts.size(), before.mesh.parts.size());
}

TEST(Evening, CarsInTrafficShineAndParkedOnesRest) {
  int driving = 0, parked = 0;
  std::set<float> hues;
  for (int i = 0; i < 1000; ++i) {
    const Vec3f p{7.3f * static_cast<float>(i % 37), 11.1f * static_cast<float>(i / 37), 0};
    driving += EveningGlow("car", "vehicle/car", p, Engine::kOn) != Vec3f{};
    parked += EveningGlow("car", "vehicle/car", p, Engine::kOff) != Vec3f{};
    EXPECT_EQ(EveningGlow("car", "vehicle/car", p, Engine::kOn), EveningGlow("car", "vehicle/car", p, Engine::kOn));
    const Vec3f lamp = EveningGlow("street_light", "furniture/lighting/street_light", p, Engine::kOff);
    if (lamp != Vec3f{}) hues.insert(std::round(100 * lamp.z / lamp.x));
  }
  EXPECT_GT(driving, 940);
  EXPECT_GT(parked, 20);
  EXPECT_LT(parked, 70);
  EXPECT_EQ(hues.size(), 3u);  // sodium, warm and neutral LED
  EXPECT_EQ(EveningGlow("trash_can", "furniture/bin", {}, Engine::kOff), (Vec3f{1, 1, 1}));
}

}  // namespace
}  // namespace airsim360::internal

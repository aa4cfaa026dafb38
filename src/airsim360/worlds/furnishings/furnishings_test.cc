#include "airsim360/worlds/furnishings/furnishings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/scene/luminance.h"

namespace airsim360 {
namespace {

Model Make(std::string_view kind, uint32_t variant) { return MakeProp(FindPropKind(kind), variant, 7, nullptr); }
uint32_t Variants(std::string_view kind) { return static_cast<uint32_t>(FindPropKind(kind).variants); }

// Highest surface over (x, y), -1 where there is none: by barycentric coordinates in plan.
float TopAt(const Mesh& mesh, float x, float y) {
  float top = -1;
  for (const Vec3u& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (std::abs(area) < 1e-10f) continue;
    const float v = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
    const float w = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) top = std::max(top, a.z + v * (b.z - a.z) + w * (c.z - a.z));
  }
  return top;
}

// Flux of all lamps in it as Lambertian emitters: pi times luminance times area.
float Lumens(const Model& model) {
  double sum = 0;
  for (const MeshPart& part : model.mesh.parts) {
    const Material& m = model.materials[part.material];
    if (m.emission == Vec3f{} || m.emission_texture != kNoTexture) continue;
    double area = 0;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = model.mesh.triangles[k];
      area +=
          0.5 * Norm(Cross(model.mesh.positions[t.y] - model.mesh.positions[t.x], model.mesh.positions[t.z] - model.mesh.positions[t.x]));
    }
    sum += std::numbers::pi * area * Luminance(m.emission) / kNit;
  }
  return static_cast<float>(sum);
}

struct Range {
  const char* kind;
  float x, y, low, high;
};
// Where a person sits, works, lies or walks, and how high that is by EN 1729, 1335, 527, 1116, 33, 31 and Neufert.
constexpr Range kHeights[] = {
    {"dining_chair_home", 0, -0.08f, 0.43f, 0.50f},
    {"office_chair", 0, -0.10f, 0.40f, 0.52f},
    {"sofa_2", 0.34f, -0.20f, 0.40f, 0.50f},
    {"sofa_3", 0.55f, -0.20f, 0.40f, 0.50f},
    {"armchair", 0, -0.15f, 0.38f, 0.50f},
    {"sofa_lounge", 0.2f, -0.20f, 0.40f, 0.48f},
    {"bench_mall", 0.5f, 0.05f, 0.40f, 0.48f},
    {"bed_double", 0.45f, -0.2f, 0.45f, 0.65f},
    {"bed_single", 0.2f, -0.2f, 0.45f, 0.65f},
    {"desk_office", 0.1f, -0.30f, 0.72f, 0.76f},
    {"meeting_table", 0.1f, -0.30f, 0.72f, 0.76f},
    {"dining_table_home", 0.3f, -0.2f, 0.72f, 0.76f},
    {"coffee_table", 0.05f, -0.25f, 0.35f, 0.46f},
    {"kitchen_counter", -0.1f, -0.2f, 0.88f, 0.92f},
    {"kitchen_sink_counter", 0.5f, 0.25f, 0.88f, 0.92f},
    {"nightstand", 0.1f, 0, 0.45f, 0.60f},
    {"pallet", 0.5f, 0.35f, 0.14f, 1.2f},
};

TEST(Furnishings, AreAtTheHeightsOfStandards) {
  for (const Range& r : kHeights) {
    for (uint32_t v = 0; v < Variants(r.kind); ++v) {
      const float top = TopAt(Make(r.kind, v).mesh, r.x, r.y);
      EXPECT_GE(top, r.low) << r.kind << " " << v;
      EXPECT_LE(top, r.high) << r.kind << " " << v;
    }
  }
}

struct Size {
  const char* kind;
  uint32_t variant;
  Vec3f size;       // metres
  float tolerance;  // of each side: handles, crowns, feet
};
constexpr Size kSizes[] = {
    {"desk_office", 0, {1.60f, 0.80f, 0.74f}, 0.02f},
    {"desk_office", 1, {1.80f, 0.80f, 0.73f}, 0.02f},
    {"kitchen_counter", 0, {1.20f, 0.60f, 1.25f}, 0.06f},
    {"fridge", 0, {0.60f, 0.65f, 1.86f}, 0.03f},
    {"washing_machine", 0, {0.60f, 0.60f, 0.85f}, 0.03f},
    {"bathtub", 0, {1.70f, 0.75f, 0.67f}, 0.03f},
    {"shower", 0, {0.90f, 0.90f, 2.11f}, 0.04f},
    {"pallet", 0, {1.20f, 0.80f, 0.144f}, 0.001f},
    {"rack_bay", 0, {2.95f, 1.20f, 8.0f}, 0.10f},
    {"rack_bay", 1, {2.95f, 1.20f, 10.0f}, 0.10f},
    {"drum", 0, {0.59f, 0.59f, 0.88f}, 0.01f},
    {"ceiling_panel", 0, {0.60f, 0.60f, 0.012f}, 0.005f},
    {"tube_light", 0, {1.50f, 0.10f, 0.10f}, 0.01f},
    {"switch_plate", 0, {0.081f, 0.015f, 0.081f}, 0.003f},
    {"escalator", 0, {1.56f, 11.6f, 5.8f}, 0.05f},
    {"wheel_stop", 0, {1.80f, 0.15f, 0.105f}, 0.01f},
    {"television", 1, {1.23f, 0.22f, 0.75f}, 0.02f},
    {"shop_shelf", 0, {1.28f, 0.95f, 1.62f}, 0.02f},
};

TEST(Furnishings, HaveTheSizesOfCatalogues) {
  for (const Size& s : kSizes) {
    const Vec3f size = Make(s.kind, s.variant).mesh.Bounds().size();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(size[i], s.size[i], s.tolerance) << s.kind << " " << s.variant << ", side " << i;
  }
}

TEST(Furnishings, LieWhereTheirMountSays) {
  for (const Furnishing& f : Furnishings()) {
    for (uint32_t v = 0; v < Variants(f.kind); ++v) {
      const Box3f box = Make(f.kind, v).mesh.Bounds();
      EXPECT_TRUE(f.kind == "escalator" || box.min.z >= -0.035f)
          << f.kind << " " << v << ": " << box.min.z;  // tilted feet and cushions at most
      if (f.mount == Mount::kWall) {
        EXPECT_LE(box.max.y, 0.005f) << f.kind << " " << v;
        EXPECT_GE(box.max.y, -0.03f) << f.kind << " " << v;
      } else {
        // Nothing is far from the z axis: a wall or table may take it by the middle of its box.
        const float reach = std::max(box.size().x, box.size().y);
        EXPECT_LE(std::abs(box.center().x), 0.15f * reach + 0.05f) << f.kind << " " << v;
        EXPECT_LE(std::abs(box.center().y), 0.28f * reach + 0.05f) << f.kind << " " << v;
      }
      EXPECT_EQ(f.mount == Mount::kWall || f.sill == 0, true) << f.kind;
    }
  }
}

TEST(Furnishings, OnTheCeilingHaveTheHeightTheyAreHungBy) {
  // Whoever hangs them subtracts the height of the variant from that of the ceiling: it must not depend on the seed.
  for (const Furnishing& f : Furnishings()) {
    if (f.mount != Mount::kCeiling) continue;
    for (uint32_t v = 0; v < Variants(f.kind); ++v)
      EXPECT_EQ(MakeProp(FindPropKind(f.kind), v, 1, nullptr).mesh.Bounds().max.z, FurnishingBox(f.kind, v).max.z) << f.kind;
  }
}

TEST(Furnishings, SendOutTheFluxOfTheirDataSheets) {
  const struct {
    const char* kind;
    uint32_t variant;
    float lumens;
  } lamps[] = {{"ceiling_panel", 0, 3600}, {"ceiling_panel", 1, 3600},  {"tube_light", 0, 5000},     {"tube_light", 1, 5000},
               {"tube_light", 2, 5000},    {"high_bay_lamp", 0, 20000}, {"high_bay_lamp", 1, 20000}, {"downlight", 0, 900},
               {"downlight", 3, 900},      {"floor_lamp", 0, 1055},     {"floor_lamp", 2, 806},      {"table_lamp", 0, 470},
               {"pendant_lamp", 1, 1055},  {"pendant_lamp", 2, 1521}};
  for (const auto& lamp : lamps)
    EXPECT_NEAR(Lumens(Make(lamp.kind, lamp.variant)) / lamp.lumens, 1, 0.04) << lamp.kind << " " << lamp.variant;
}

TEST(Furnishings, ThatBurnByNightAreThoseOfHomes) {
  std::set<std::string> evening;
  for (const Furnishing& f : Furnishings())
    for (uint32_t v = 0; v < Variants(f.kind); ++v)
      for (const Material& m : Make(f.kind, v).materials)
        if (m.emission != Vec3f{} && m.lamp && !FindPropKind(f.kind).category.starts_with("vehicle/"))
          evening.insert(std::string(f.kind) + " " + std::to_string(v));
  const std::set<std::string> homes = {"downlight 2",    "downlight 3",    "floor_lamp 0",   "floor_lamp 1",   "floor_lamp 2",
                                       "pendant_lamp 0", "pendant_lamp 1", "pendant_lamp 2", "pendant_lamp 3", "table_lamp 0",
                                       "table_lamp 1",   "table_lamp 2",   "table_lamp 3"};
  EXPECT_EQ(evening, homes);
}

TEST(Furnishings, LampsShineDownwardsFromCeilings) {
  for (const char* kind : {"ceiling_panel", "downlight", "high_bay_lamp"}) {
    const Model model = Make(kind, 0);
    for (const MeshPart& part : model.mesh.parts) {
      if (model.materials[part.material].emission == Vec3f{}) continue;
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        const Vec3u t = model.mesh.triangles[k];
        EXPECT_LT(Cross(model.mesh.positions[t.y] - model.mesh.positions[t.x], model.mesh.positions[t.z] - model.mesh.positions[t.x]).z, 0)
            << kind;
      }
    }
  }
}

TEST(Furnishings, StepsOfAnEscalatorRiseAtThirtyDegrees) {
  // EN 115-1: at most 0.24 m high, at least 0.38 deep; its upper plate lies at the rise.
  for (uint32_t v = 0; v < Variants("escalator"); ++v) {
    const Mesh mesh = Make("escalator", v).mesh;
    const Box3f box = mesh.Bounds();
    const float rise = v == 1 ? 5.0f : 4.5f;
    EXPECT_NEAR(TopAt(mesh, 0, box.max.y - 0.2f), rise, 0.01f);
    EXPECT_NEAR(TopAt(mesh, 0, box.min.y + 0.2f), 0, 0.01f);
    float last = TopAt(mesh, 0, -2), largest = 0, gain = 0;
    for (float y = -2 + 0.4f; y < 2.01f; y += 0.4f) {
      const float z = TopAt(mesh, 0, y);
      largest = std::max(largest, z - last);
      gain += z - last;
      last = z;
    }
    EXPECT_LE(largest, 0.2401f);
    EXPECT_NEAR(std::atan2(gain, 4.0f) * 180 / std::numbers::pi, 30, 1.0);
  }
}

TEST(Furnishings, ReflectAsMaterialsOfRoomsDo) {
  for (const Furnishing& f : Furnishings())
    for (const Material& m : Make(f.kind, 0).materials) {
      EXPECT_GE(m.roughness, 0.02f) << f.kind << ", " << m.name;
      EXPECT_LE(std::max({m.base_color.x, m.base_color.y, m.base_color.z}), 1.0f) << f.kind << ", " << m.name;
      EXPECT_GE(std::min({m.base_color.x, m.base_color.y, m.base_color.z}), 0.0f) << f.kind << ", " << m.name;
      // Through foliage that lets more than 0.4 pass, the renderers draw leaves that vary in colour.
      if (m.kind != SurfaceKind::kFoliage || m.name == "leaf house leaf") continue;
      EXPECT_LE(m.transmission, 0.4f) << f.kind << ", " << m.name;
    }
}

TEST(Furnishings, AreTheSameWithAnyNumberOfThreads) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    SceneBuilder builder("furnished");
    PropShelf shelf(builder, nullptr, 3);
    for (const char* kind : {"bed_double", "rack_bay", "rug", "shop_shelf", "monitor", "picture_frame"}) shelf.Place(kind, {});
    return builder.Build();
  };
  const auto one = build(1), many = build(0);
  ASSERT_EQ(one->meshes.size(), many->meshes.size());
  for (size_t i = 0; i < one->meshes.size(); ++i) {
    EXPECT_EQ(one->meshes[i].positions, many->meshes[i].positions);
    EXPECT_EQ(one->meshes[i].triangles, many->meshes[i].triangles);
  }
  ASSERT_EQ(one->textures.size(), many->textures.size());
  for (size_t i = 0; i < one->textures.size(); ++i)
    EXPECT_EQ(one->textures[i].levels[0], many->textures[i].levels[0]) << one->textures[i].name;
}

TEST(Furnishings, UnknownNameIsAnInputErrorWithTheNearest) {
  try {
    FindFurnishing("bed_dubble");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bed_double"), std::string::npos) << error.what();
  }
}

TEST(Furnishings, TogetherStayWithinTheTrianglesOfABuilding) {
  size_t sum = 0;
  for (const Furnishing& f : Furnishings()) sum += Variants(f.kind) * FindPropKind(f.kind).max_triangles;
  EXPECT_LE(sum, 1'500'000u);
}

TEST(Furnishings, AreKindsOfPropsSortedByName) {
  const auto all = Furnishings();
  ASSERT_GE(all.size(), 95u);
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(FindPropKind(all[i].kind).name, all[i].kind);
    EXPECT_TRUE(i == 0 || all[i - 1].kind < all[i].kind) << all[i].kind;
  }
}

}  // namespace
}  // namespace airsim360

// Where props stand: footprints against sampled and exact overlap, occupancy against brute force, and the
// ground that every kind of prop takes.
#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360 {
namespace {

using namespace internal;

float Uniform(RngStream& rng, double a, double b) { return static_cast<float>(rng.Uniform(a, b)); }

Footprint RandomFootprint(RngStream& rng, double reach) {
  return {{Uniform(rng, -reach, reach), Uniform(rng, -reach, reach)}, {Uniform(rng, 0.05, 4), Uniform(rng, 0.05, 2)}, Uniform(rng, -7, 7)};
}

std::vector<Vec2f> CornersOf(const Footprint& f) {
  const Vec2f x{std::cos(f.yaw), std::sin(f.yaw)}, y{-x.y, x.x};
  std::vector<Vec2f> corners;
  for (const auto& [i, k] : {std::pair{-1.0f, -1.0f}, {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(f.center + x * (i * f.half.x) + y * (k * f.half.y));
  return corners;
}

// The area that two convex outlines share: one clipped by the other's edges (Sutherland and Hodgman).
double SharedArea(std::vector<Vec2f> subject, const std::vector<Vec2f>& clip) {
  for (size_t e = 0; e < clip.size() && !subject.empty(); ++e) {
    const Vec2f a = clip[e], v = clip[(e + 1) % clip.size()] - a;
    const auto side = [&](Vec2f p) { return v.x * (p.y - a.y) - v.y * (p.x - a.x); };
    std::vector<Vec2f> kept;
    for (size_t i = 0; i < subject.size(); ++i) {
      const Vec2f p = subject[i], q = subject[(i + 1) % subject.size()];
      const float sp = side(p), sq = side(q);
      if (sp >= 0) kept.push_back(p);
      if ((sp < 0) != (sq < 0)) kept.push_back(p + (q - p) * (sp / (sp - sq)));
    }
    subject = std::move(kept);
  }
  return subject.size() < 3 ? 0 : Shoelace(subject);
}

class EverySeedOfPlaces : public testing::TestWithParam<int> {
 protected:
  RngStream rng{static_cast<uint64_t>(GetParam()), "places"};
};

INSTANTIATE_TEST_SUITE_P(Placing, EverySeedOfPlaces, testing::Range(0, 8));

TEST_P(EverySeedOfPlaces, RectanglesOverlapWhereTheyShareArea) {
  int both = 0;
  for (int i = 0; i < 3000; ++i) {
    const Footprint a = RandomFootprint(rng, 4), b = RandomFootprint(rng, 4);
    const double shared = SharedArea(CornersOf(a), CornersOf(b));
    EXPECT_EQ(a.Overlaps(b), b.Overlaps(a));
    if (shared > 1e-4) {
      EXPECT_TRUE(a.Overlaps(b)) << shared;
    }
    if (shared == 0) {
      // Touching by rounding apart.
      Footprint smaller = a;
      smaller.half = a.half - Vec2f{1e-3f, 1e-3f};
      EXPECT_FALSE(smaller.Overlaps(b));
    }
    both += shared > 1e-4;
  }
  EXPECT_GT(both, 400);
  EXPECT_LT(both, 2600);
}

TEST_P(EverySeedOfPlaces, ARectangleHoldsThePointsOnItsSideOfAllEdges) {
  for (int i = 0; i < 2000; ++i) {
    const Footprint f = RandomFootprint(rng, 3);
    const Vec2f p{Uniform(rng, -6, 6), Uniform(rng, -6, 6)};
    const std::vector<Vec2f> corners = CornersOf(f);
    float least = 1e9f;
    for (size_t e = 0; e < 4; ++e) {
      const Vec2f v = corners[(e + 1) % 4] - corners[e], w = p - corners[e];
      least = std::min(least, (v.x * w.y - v.y * w.x) / std::hypot(v.x, v.y));
    }
    if (std::abs(least) > 1e-4f) {
      EXPECT_EQ(f.Contains(p), least > 0);
    }
  }
}

TEST_P(EverySeedOfPlaces, OccupancyAnswersAsALookAtAllOfThem) {
  Occupancy occupancy;
  std::vector<Footprint> all;
  int free_places = 0;
  for (int i = 0; i < 1500; ++i) {
    const Footprint f = RandomFootprint(rng, 60);
    const bool free = std::none_of(all.begin(), all.end(), [&](const Footprint& other) { return other.Overlaps(f); });
    ASSERT_EQ(occupancy.IsFree(f), free) << i;
    if (!free && i % 7) continue;  // some are put in each other all the same
    occupancy.Add(f);
    all.push_back(f);
    free_places += free;
  }
  EXPECT_EQ(occupancy.size(), all.size());
  EXPECT_GT(free_places, 150);
}

TEST_P(EverySeedOfPlaces, ThePlacerTakesEveryPlaceOnceAndKeepsOffReservedOnes) {
  SceneBuilder builder("placer");
  PropShelf shelf(builder, nullptr, 1);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, static_cast<uint64_t>(GetParam()));
  const Footprint reserved{{10, 0}, {5, 3}, 0.4f};
  placer.Reserve(reserved);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const char* kind = std::array{"trash_can", "fire_hydrant", "bench_wood", "car_pillar"}[static_cast<size_t>(i % 4)];
    const Vec3f p{Uniform(rng, -14, 14), Uniform(rng, -14, 14), 0.5f};
    refused += !placer.Try(kind, p, Uniform(rng, 0, 6.28));
  }
  const auto& placed = placer.placements();
  EXPECT_EQ(placed.size() + static_cast<size_t>(refused), 300u);
  EXPECT_GT(refused, 20);
  for (size_t i = 0; i < placed.size(); ++i) {
    EXPECT_FALSE(placed[i].footprint.Overlaps(reserved));
    for (size_t k = 0; k < i; ++k) EXPECT_FALSE(placed[i].footprint.Overlaps(placed[k].footprint));
  }
  const auto scene = builder.Build();
  EXPECT_EQ(scene->entities.size(), placed.size());
  for (const Placement& p : placed) {
    EXPECT_TRUE(scene->entity(p.entity).name.starts_with(p.kind));
    EXPECT_TRUE(scene->entity(p.entity).bounds.Contains({p.p_W.x, p.p_W.y, scene->entity(p.entity).bounds.center().z}));
  }
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const PropKind& kind : PropKinds()) names.emplace_back(kind.name);
  return names;
}

class EveryPropOnTheGround : public testing::TestWithParam<std::string> {
 protected:
  const PropKind& kind() const { return FindPropKind(GetParam()); }
  // Those that take long to grow or to paint; of them one individual is asked.
  bool dear() const { return kind().max_triangles > 6000 || GetParam().starts_with("mural") || GetParam().starts_with("billboard"); }
  int individuals() const { return dear() ? 1 : kind().variants; }
  Model Make(int variant, uint64_t seed) const { return MakeProp(kind(), static_cast<uint32_t>(variant), seed, nullptr); }
};

INSTANTIATE_TEST_SUITE_P(Placing, EveryPropOnTheGround, testing::ValuesIn(Names()), [](const auto& info) { return info.param; });

// What touches the ground lies in the circle that the kind asks for, corners a quarter beyond it at most,
// wherever its crown or sign reaches. Blades and leaves are of the ground that they lie on; a flag may hang
// down beside its pole.
TEST_P(EveryPropOnTheGround, StandsWithinItsRadiusOfMaterialsThatNatureHas) {
  const bool free = kind().footprint_radius <= 0.1f || GetParam().starts_with("us_flag");
  for (int v = 0; v < individuals(); ++v) {
    const Model model = Make(v, 7);
    float farthest = 0;
    for (Vec3f p : model.mesh.positions)
      if (p.z > -0.02f && p.z < 0.1f) farthest = std::max(farthest, std::hypot(p.x, p.y));
    EXPECT_LE(farthest, free ? 1 : 1.25f * kind().footprint_radius) << "variant " << v;
    for (const Material& m : model.materials) {
      EXPECT_FALSE(m.name.empty());
      EXPECT_GE(std::min({m.base_color.x, m.base_color.y, m.base_color.z}), 0) << m.name;
      // Pictures are darker than the colour that they are multiplied by.
      const float most = std::max({m.base_color.x, m.base_color.y, m.base_color.z});
      EXPECT_LE(most, m.base_color_texture == kNoTexture ? 1 : 5) << m.name;
      EXPECT_GE(std::min(m.roughness, m.metallic), 0) << m.name;
      EXPECT_LE(std::max(m.roughness, m.metallic), 1) << m.name;
    }
  }
}

// The rectangle that it occupies is no larger than its circle's square, turns and grows with it.
TEST_P(EveryPropOnTheGround, ItsFootprintTurnsAndGrowsWithIt) {
  const Footprint plain = FootprintOf(GetParam(), {3, 4}, 0), turned = FootprintOf(GetParam(), {3, 4}, 1.1f, 2);
  EXPECT_GT(plain.half.x, 0.03f);
  EXPECT_GT(plain.half.y, 0.03f);
  EXPECT_EQ(plain.center, (Vec2f{3, 4}));
  EXPECT_FLOAT_EQ(turned.half.x, 2 * plain.half.x);
  EXPECT_FLOAT_EQ(turned.half.y, 2 * plain.half.y);
  EXPECT_FLOAT_EQ(turned.yaw, 1.1f);
}

// All individuals of any seed keep what the row promises, not those of one seed alone.
TEST_P(EveryPropOnTheGround, KeepsItsPromisesForAnotherSeed) {
  for (int v = 0; v < individuals(); ++v) {
    const Model model = Make(v, 4242);
    const Box3f box = model.mesh.Bounds();
    EXPECT_EQ(FaultOf(model.mesh, false), "") << "variant " << v;
    EXPECT_LE(model.mesh.triangles.size(), kind().max_triangles) << "variant " << v;
    EXPECT_GE(box.min.z, -0.301f) << "variant " << v;
    EXPECT_GE(box.max.z, kind().min_height) << "variant " << v;
    EXPECT_LE(box.max.z, kind().max_height) << "variant " << v;
  }
}

// Of props that are quick to make: all go the same way through the shelf.
TEST_P(EveryPropOnTheGround, StandsWhereItIsPutTurnedAndScaled) {
  if (dear()) return;
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 7);
  const EntityId plain = shelf.Place(GetParam(), {}), put = shelf.Place(GetParam(), {100, -50, 3}, 1.5707963f, 0, 1.5f);
  const auto scene = builder.Build();
  const Box3f a = scene->entity(plain).bounds, b = scene->entity(put).bounds;
  // A quarter turn takes x to y and y to -x.
  const float slack = 1e-3f + 1e-4f * Norm(a.size());
  EXPECT_NEAR(b.min.x, 100 - 1.5f * a.max.y, slack);
  EXPECT_NEAR(b.max.x, 100 - 1.5f * a.min.y, slack);
  EXPECT_NEAR(b.min.y, -50 + 1.5f * a.min.x, slack);
  EXPECT_NEAR(b.max.y, -50 + 1.5f * a.max.x, slack);
  EXPECT_NEAR(b.min.z, 3 + 1.5f * a.min.z, slack);
  EXPECT_NEAR(b.max.z, 3 + 1.5f * a.max.z, slack);
}

}  // namespace
}  // namespace airsim360

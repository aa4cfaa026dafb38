// Old stones and wooden works: ruins, arches, windmills, porches.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
namespace {}  // namespace

// A fluted shaft on a base, with a capital where it is whole.
void TownFinisher::Column(Vec2d p, double radius, double height, bool whole) {
  Start("column", "construction/column", p, {0, 1}, -0.1);
  mesh_.SetMaterial(scene_.surfaces[Surface::kLimestone]);
  const auto r = static_cast<float>(radius), h = static_cast<float>(height);
  mesh_.Box({-1.5f * r, -1.5f * r, 0}, {1.5f * r, 1.5f * r, 0.35f});
  mesh_.Tube({0, 0, 0.35f}, {0, 0, 0.55f}, 1.35f * r, 1.1f * r, 20, false, true);
  mesh_.Tube({0, 0, 0.5f}, {0, 0, h}, r, 0.86f * r, 18, false, true);
  for (int i = 0; i < 16; ++i) {  // fillets between flutes
    const float a = kTauF * static_cast<float>(i) / 16;
    const Vec3f out{std::cos(a), std::sin(a), 0};
    mesh_.Beam(out * (1.0f * r) + Vec3f{0, 0, 0.55f}, out * (0.87f * r) + Vec3f{0, 0, h - 0.1f}, 0.06f);
  }
  if (!whole) return;
  mesh_.Tube({0, 0, h}, {0, 0, h + 0.5f}, 0.9f * r, 1.35f * r, 20, false, false);
  mesh_.Box({-1.5f * r, -1.5f * r, h + 0.5f}, {1.5f * r, 1.5f * r, h + 0.75f});
}

// Two rows of a temple's columns, some broken, part of the beam over them, fallen drums, low walls.
void TownFinisher::Ruin(const TownSpot& spot) {
  const double half = spot.size, radius = 0.48, height = 7;
  const int along = std::max(3, static_cast<int>(half / 1.8));
  for (int side : {1, -1}) {
    bool before = false;
    Vec2d last{};
    for (int i = 0; i < along; ++i) {
      const Vec2d p = spot.p + Vec2d{-half * 0.8 + 1.6 * half * i / (along - 1), side * half * 0.42};
      const bool whole = rng_.Chance(0.55), gone = rng_.Chance(0.14);
      if (!gone) Column(p, radius, whole ? height : rng_.Uniform(1.2, 4.8), whole);
      if (whole && before && !gone) {
        Start("architrave", "construction/wall", (p + last) * 0.5, {0, 1}, height + 0.62);
        mesh_.SetMaterial(scene_.surfaces[Surface::kLimestone]);
        const auto reach = static_cast<float>(std::hypot(p.x - last.x, p.y - last.y) / 2 + 0.6);
        mesh_.Box({-reach, -0.55f, 0}, {reach, 0.55f, 0.75f});
      }
      before = whole && !gone;
      last = p;
    }
  }
  // The steps below it, and what fell.
  Start("stylobate", "construction/stairs", spot.p, {0, 1}, -0.15);
  mesh_.SetMaterial(scene_.surfaces[Surface::kLimestone]);
  const auto h = static_cast<float>(half * 0.92), w = static_cast<float>(half * 0.55);
  mesh_.Box({-h, -w, 0}, {h, w, 0.22f});
  for (int i = 0; i < 9; ++i) {
    const Vec2d p = spot.p + Vec2d{rng_.Uniform(-half, half), rng_.Uniform(-half, half)};
    Start("fallen drum", "nature/rock", p, {rng_.Uniform(-1, 1), rng_.Uniform(-1, 1) + 0.01}, 0.05);
    mesh_.SetMaterial(scene_.surfaces[Surface::kLimestone]);
    mesh_.Tube({-0.5f, 0, 0.42f}, {static_cast<float>(rng_.Uniform(0.2, 0.7)), 0, 0.42f}, 0.45f, 0.45f, 16);
  }
  // Walls of old bricks around a corner of the site, their tops broken.
  mesh_.SetTransform({});
  for (int arm = 0; arm < 2; ++arm) {
    const EntityId wall = scene_.builder.AddEntity("old wall", scene_.builder.tree().At("construction/wall"));
    mesh_.SetEntity(wall);
    mesh_.SetMaterial(scene_.surfaces[Surface::kBrickYellow]);
    for (int i = 0; i < 9; ++i) {
      const double s = -half + 1.5 * i, top = std::max(0.5, 3.4 + 1.3 * std::sin(1.3 * i + arm) - 0.28 * i);
      const Vec2d a = arm == 0 ? spot.p + Vec2d{s, half} : spot.p + Vec2d{-half, half - 1.5 * i - 1.5},
                  b = arm == 0 ? a + Vec2d{1.5, 0.8} : a + Vec2d{0.8, 1.5};
      const float z = At((a + b) * 0.5, -0.4).z;
      mesh_.Box({static_cast<float>(a.x), static_cast<float>(a.y), z},
                {static_cast<float>(b.x), static_cast<float>(b.y), z + 0.4f + static_cast<float>(top)});
    }
  }
}

// A round arch over a lane, from wall to wall, with a band of wall above.
void TownFinisher::Arch(const TownSpot& spot) {
  Start("arch", "construction/building/part", spot.p, spot.front);
  const auto half = static_cast<float>(spot.size / 2 + 0.35), clear = static_cast<float>(std::min(spot.size / 2 - 0.25, 2.6));
  const float spring = 2.9f, depth = 1.1f, top = spring + clear + 1.0f;
  mesh_.SetMaterial(scene_.surfaces[spec_.style == TownStyle::kOchre         ? Surface::kStuccoOchre
                                    : spec_.style == TownStyle::kWhitewashed ? Surface::kStuccoWhite
                                                                             : Surface::kLimestone]);
  const int n = 14;
  const auto point = [&](int i) {
    const float a = kTauF / 2 * static_cast<float>(i) / static_cast<float>(n);
    return Vec2f{-clear * std::cos(a), spring + clear * std::sin(a)};
  };
  for (float y : {-depth, depth}) {
    const bool front = y < 0;
    const auto quad = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) { front ? mesh_.Quad(a, b, c, d) : mesh_.Quad(b, a, d, c); };
    quad({-half, y, -0.5f}, {-clear, y, -0.5f}, {-clear, y, top}, {-half, y, top});
    quad({clear, y, -0.5f}, {half, y, -0.5f}, {half, y, top}, {clear, y, top});
    for (int i = 0; i < n; ++i) {
      const Vec2f a = point(i), b = point(i + 1);
      quad({a.x, y, a.y}, {b.x, y, b.y}, {b.x, y, top}, {a.x, y, top});
    }
  }
  // The vault, its sides, the top with a coping.
  for (int i = 0; i < n; ++i) {
    const Vec2f a = point(i), b = point(i + 1);
    mesh_.Quad({b.x, -depth, b.y}, {a.x, -depth, a.y}, {a.x, depth, a.y}, {b.x, depth, b.y});
  }
  mesh_.Quad({-clear, -depth, -0.5f}, {-clear, depth, -0.5f}, {-clear, depth, spring}, {-clear, -depth, spring});
  mesh_.Quad({clear, depth, -0.5f}, {clear, -depth, -0.5f}, {clear, -depth, spring}, {clear, depth, spring});
  mesh_.SetMaterial(scene_.surfaces[Surface::kRoofTile]);
  mesh_.Box({-half, -depth - 0.12f, top}, {half, depth + 0.12f, top + 0.14f});
}

// A tower mill: a whitewashed cone, a cap of shingles, four sails.
void TownFinisher::Windmill(const TownSpot& spot) {
  Start("windmill", "construction/windmill", spot.p, spot.front, -0.3);
  const auto h = static_cast<float>(spot.size);
  mesh_.SetMaterial(scene_.surfaces[Surface::kStuccoWhite]);
  mesh_.Tube({0, 0, 0}, {0, 0, h}, 3.6f, 2.5f, 28, false, true);
  mesh_.SetMaterial(scene_.surfaces[Surface::kDoorWood]);
  mesh_.Box({-0.55f, -3.75f, 0.3f}, {0.55f, -3.3f, 2.5f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kGlassDark]);
  for (float z : {4.0f, 7.0f}) mesh_.Box({-0.4f, -3.6f + 0.11f * z, z}, {0.4f, -3.0f + 0.11f * z, z + 0.8f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kRoofSlate]);
  mesh_.Tube({0, 0, h}, {0, 0, h + 2.6f}, 2.8f, 0.15f, 24, true, true);
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  const Vec3f hub{0, -3.3f, h + 0.7f};
  mesh_.Tube({0, 0, h + 0.7f}, hub, 0.22f, 0.22f, 12);
  const auto turn = static_cast<float>(rng_.Uniform(0.2, 1.2));
  for (int i = 0; i < 4; ++i) {
    const float a = turn + kTauF / 4 * static_cast<float>(i);
    const Vec3f out{std::cos(a), 0, std::sin(a)}, side{-std::sin(a), 0, std::cos(a)};
    mesh_.Beam(hub, hub + out * 8.2f, 0.2f);
    for (int k = 0; k <= 12; ++k)
      mesh_.Beam(hub + out * (1.6f + 0.55f * static_cast<float>(k)), hub + out * (1.6f + 0.55f * static_cast<float>(k)) + side * 1.7f,
                 0.06f);
    for (float s : {0.85f, 1.7f}) mesh_.Beam(hub + out * 1.6f + side * s, hub + out * 8.2f + side * s, 0.06f);
  }
}

// A deck before a cabin, its roof on posts, a bench, firewood.
void TownFinisher::Porch(const TownSpot& spot) {
  const double width = std::min(spot.size - 1, 6.0);
  Start("porch", "construction/bridge", spot.p, spot.front);
  const auto half = static_cast<float>(width / 2);
  const float deep = 2.1f, deck = 0.28f;
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  mesh_.Box({-half, -deep, -0.7f}, {half, -0.02f, deck});
  Start("porch roof", "construction/building/part", spot.p, spot.front);
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  for (float x : {-half + 0.1f, -half / 3, half / 3, half - 0.1f}) mesh_.Beam({x, -deep + 0.12f, deck}, {x, -deep + 0.12f, 2.35f}, 0.14f);
  for (float x : {-half + 0.1f, half / 3}) mesh_.Beam({x, -deep + 0.12f, 1.15f}, {x + 2 * half / 3 - 0.1f, -deep + 0.12f, 1.15f}, 0.08f);
  mesh_.SetMaterial(scene_.surfaces[Surface::kRoofSlate]);
  mesh_.Quad({-half - 0.25f, -deep - 0.3f, 2.36f}, {half + 0.25f, -deep - 0.3f, 2.36f}, {half + 0.25f, 0, 2.78f},
             {-half - 0.25f, 0, 2.78f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  mesh_.Quad({-half - 0.25f, 0, 2.70f}, {half + 0.25f, 0, 2.70f}, {half + 0.25f, -deep - 0.3f, 2.28f},
             {-half - 0.25f, -deep - 0.3f, 2.28f});
  mesh_.Quad({-half - 0.25f, -deep - 0.3f, 2.28f}, {half + 0.25f, -deep - 0.3f, 2.28f}, {half + 0.25f, -deep - 0.3f, 2.36f},
             {-half - 0.25f, -deep - 0.3f, 2.36f});
  const Vec2d side{-spot.front.y, spot.front.x};
  scene_.Put("bench", "bench_wood", At(spot.p + spot.front * 0.6 + side * (width * 0.28), 0.28),
             static_cast<double>(FacingYaw(ToFloat(spot.front))), 1, rng_.Index(3));
  // Firewood beside the house.
  const Vec2d pile = spot.p + side * (spot.size / 2 + 1.3) - spot.front * 2.0;
  if (InHouse(pile, 0.9)) return;
  Start("firewood", "furniture/misc", pile, spot.front, -0.05);
  mesh_.SetMaterial(scene_.surfaces[Surface::kFrameWood]);
  for (int row = 0; row < 7; ++row)
    for (int i = 0; i < 8; ++i) {
      const float x = -0.9f + 0.25f * static_cast<float>(i) + (row % 2 ? 0.12f : 0.0f), z = 0.12f + 0.2f * static_cast<float>(row);
      mesh_.Tube({x, -0.35f, z}, {x, 0.35f, z}, 0.11f, 0.11f, 7);
    }
}

}  // namespace airsim360::internal

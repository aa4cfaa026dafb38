#include "airsim360/worlds/city_park/layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/city_park/noise.h"

namespace airsim360::internal::park {
namespace {

constexpr Vec2f kMainRoad[] = {{-700, 140}, {-420, 62}, {-230, 6}, {-110, -15}, {-45, -13}, {0, -3.2f}, {27, 11},
                               {44, 31},    {62, 58},   {92, 90},  {150, 122},  {240, 150}, {400, 240}, {700, 330}};
// Side roads from their junctions outwards; the first point is replaced by one on the main road.
constexpr Vec2f kEastRoad[] = {{118, 106}, {137, 80}, {168, 40}, {190, -20}, {180, -110}, {230, -240}, {330, -420}, {420, -620}};
constexpr Vec2f kWestRoad[] = {{-262, 14}, {-268, -20}, {-280, -70}, {-240, -160}, {-250, -280}, {-150, -430}, {-160, -640}};
constexpr Vec2f kNorthRoad[] = {{232, 147}, {222, 180}, {190, 240}, {200, 330}, {140, 430}, {150, 620}};

constexpr Vec2f kLakePath[] = {{-11, -2}, {-13.5f, 8}, {-14, 18},  {-22, 32},  {-16, 46},  {6, 54},   {14, 72},
                               {6, 110},  {-30, 128},  {-80, 124}, {-120, 90}, {-150, 40}, {-160, -4}};
constexpr Vec2f kHillPath[] = {{14, -6}, {30, -12}, {52, -14}, {74, -22}, {96, -50}, {140, -70}, {182, -66}};
constexpr Vec2f kNorthPath[] = {{8, 106}, {50, 150}, {60, 220}, {10, 290}, {-90, 300}, {-190, 240}, {-230, 150}, {-196, 20}};
constexpr Vec2f kSouthPath[] = {{-46, -20}, {-60, -60}, {-30, -120}, {40, -160}, {110, -150}, {140, -72}};
constexpr Vec2f kFarPath[] = {{-32, -124}, {-90, -190}, {-160, -210}, {-238, -190}};
constexpr Vec2f kBluffPath[] = {{40, -162}, {60, -240}, {20, -330}, {-80, -380}, {-170, -400}};
constexpr Vec2f kMeadowPath[] = {{10, 292}, {60, 350}, {140, 380}};

float Bump(Vec2f p, float x, float y, float radius) {
  const float dx = (p.x - x) / radius, dy = (p.y - y) / radius;
  return std::exp(-(dx * dx + dy * dy));
}

// A side road starts on the middle of the main road.
std::vector<Vec2f> FromMain(const Curve& main, std::span<const Vec2f> road, Junction& junction) {
  const Curve::Nearest at = main.Find(road[0]);
  std::vector<Vec2f> control(road.begin(), road.end());
  control[0] = main.At(at.s);
  junction = {at.s, main.Find(road[1]).side > 0};
  return control;
}

}  // namespace

Layout::Layout() : main_(kMainRoad, 0.8f) {
  for (std::span<const Vec2f> road :
       {std::span<const Vec2f>(kEastRoad), std::span<const Vec2f>(kWestRoad), std::span<const Vec2f>(kNorthRoad)}) {
    Junction junction;
    const std::vector<Vec2f> control = FromMain(main_, road, junction);
    sides_.emplace_back(control, 0.8f);
    junctions_.push_back(junction);
  }
  for (std::span<const Vec2f> path :
       {std::span<const Vec2f>(kLakePath), std::span<const Vec2f>(kHillPath), std::span<const Vec2f>(kNorthPath),
        std::span<const Vec2f>(kSouthPath), std::span<const Vec2f>(kFarPath), std::span<const Vec2f>(kBluffPath),
        std::span<const Vec2f>(kMeadowPath)})
    paths_.emplace_back(path, 1.0f);
  Survey();
}

float Layout::FarField::LowerBound(Vec2f p) const {
  const int x = static_cast<int>(std::floor(p.x / kCell)) + kHalf, y = static_cast<int>(std::floor(p.y / kCell)) + kHalf;
  if (x < 0 || y < 0 || x >= 2 * kHalf || y >= 2 * kHalf) return 0;
  return value[static_cast<size_t>(y * 2 * kHalf + x)] - kReach;
}

void Layout::Survey() {
  constexpr int n = 2 * FarField::kHalf;
  std::vector<float> roads(n * n), paths(n * n);
  ParallelFor(n, [&](int64_t y) {
    for (int x = 0; x < n; ++x) {
      const Vec2f p{(static_cast<float>(x - FarField::kHalf) + 0.5f) * FarField::kCell,
                    (static_cast<float>(y - FarField::kHalf) + 0.5f) * FarField::kCell};
      roads[static_cast<size_t>(y) * n + static_cast<size_t>(x)] = ExactBeyondRoad(p);
      paths[static_cast<size_t>(y) * n + static_cast<size_t>(x)] = ExactPathDistance(p, 1e9f);
    }
  });
  roads_far_.value = std::move(roads);
  paths_far_.value = std::move(paths);
}

float Layout::BeyondRoad(Vec2f p) const {
  // Beyond the field no road is near.
  if (std::max(std::abs(p.x), std::abs(p.y)) > FarField::kHalf * FarField::kCell) return 200;
  const float bound = roads_far_.LowerBound(p);
  return bound > 40 ? bound : ExactBeyondRoad(p);
}

float Layout::PathDistance(Vec2f p, float limit) const { return paths_far_.LowerBound(p) > limit ? limit : ExactPathDistance(p, limit); }

float Layout::ExactBeyondRoad(Vec2f p) const {
  float beyond = main_.Distance(p) - (kMainHalf + kVergeEnd);
  for (const Curve& side : sides_) {
    const float limit = beyond + kSideHalf + kVergeEnd;
    if (limit > 0) beyond = std::min(beyond, side.Distance(p, limit) - (kSideHalf + kVergeEnd));
  }
  return beyond;
}

float Layout::ExactPathDistance(Vec2f p, float limit) const {
  float best = limit;
  for (const Curve& path : paths_) best = path.Distance(p, best);
  return best;
}

float Layout::Lake(Vec2f p) const {
  const float dx = p.x - kLakeCenter.x, dy = p.y - kLakeCenter.y;
  const float plain = std::hypot(dx / kLakeRx, dy / kLakeRy);
  if (plain > 2.7f) return plain;
  const float a = std::atan2(dy, dx);
  return plain * (1 + 0.10f * std::sin(a * 3 + 1) + 0.05f * std::sin(a * 7));
}

float Layout::Island(Vec2f p) const {
  const float a = std::atan2(p.y - 88, p.x + 60);
  return Ramp(9.0f, 3.5f, std::hypot((p.x + 60) / 1.25f, p.y - 88) * (1 + 0.12f * std::sin(3 * a + 2)));
}

float Layout::Base(Vec2f p) const {
  return (Noise(p.x / 420 + 7, p.y / 420, 91) - Noise(7, 0, 91)) * 7 * Ramp(20, 220, std::hypot(p.x, p.y));
}

float Layout::Hills(Vec2f p) const {
  const float r = std::hypot(p.x, p.y);
  // Rolling ground, four hills that frame the view from the spawn, then the country and far ridges.
  float h = (Fractal(p.x / 95 + 3, p.y / 95, 4, 21) - 0.40f) * 9 * Ramp(15, 60, r);
  h += 7.5f * Bump(p, 62, -36, 26) + 7 * Bump(p, -70, -52, 30) + 1.5f * Bump(p, 5, 44, 20) + 5 * Bump(p, 120, 30, 30);
  if (r > 220) h += (Fractal(p.x / 900, p.y / 900, 4, 33) - 0.42f) * 90 * Ramp(220, 900, r);
  if (r > 1100) h += 150 * Ramp(1100, 3000, r) * std::clamp(Fractal(p.x / 1300 + 5, p.y / 1300, 3, 35) - 0.25f, 0.0f, 1.0f);
  return h + (Noise(p.x / 7, p.y / 7, 5) - 0.5f) * 0.25f + (Noise(p.x / 1.9f, p.y / 1.9f, 6) - 0.5f) * 0.05f;
}

float Layout::Ground(Vec2f p, float beyond) const {
  const float base = Base(p);
  float h = base + Hills(p) * Ramp(0, 34, beyond);
  // The lake's basin, its banks, and the island in it.
  const float lake = Lake(p);
  if (lake < 2.2f) {
    h = Mix(h, kLakeZ + 0.25f, Ramp(1.9f, 0.95f, lake)) - 1.6f * Ramp(1.06f, 0.7f, lake);
    h += Island(p) * 2.5f;
  }
  // Lawns lie a hand above the carriageway; under pavements the ground dips out of the way.
  if (beyond >= 1.5f) return h + 0.14f;
  const float edge = base + Mix(-0.25f, 0.14f, Ramp(-0.35f, 0.1f, beyond));
  return Mix(edge, h + 0.14f, Ramp(0.1f, 1.5f, beyond));
}

Vec3f Layout::Normal(Vec2f p) const {
  constexpr float e = 0.3f;
  const float h = Ground(p);
  return Normalized(Vec3f{h - Ground({p.x + e, p.y}), h - Ground({p.x, p.y + e}), e});
}

float Layout::PathBed(Vec2f p) const { return 0.07f * Ramp(kPathHalf + 0.15f, kPathHalf - 0.35f, PathDistance(p, kPathHalf + 1)); }

float Layout::Forest(Vec2f p) const {
  return Ramp(0.46f, 0.62f, Fractal(p.x / 60, p.y / 60, 3, 81)) * Ramp(30, 60, std::hypot(p.x, p.y - 30));
}

float Layout::Clover(Vec2f p) const { return Ramp(0.58f, 0.70f, Fractal(p.x / 5 + 40, p.y / 5, 3, 47)); }
float Layout::Dry(Vec2f p) const { return Ramp(0.58f, 0.74f, Fractal(p.x / 8 + 9, p.y / 8, 4, 49)); }

Vec3f Layout::LawnCoarse(Vec2f p) const {
  const float wide = Fractal(p.x / 23, p.y / 23, 4, 41), narrow = Fractal(p.x / 3.1f, p.y / 3.1f, 3, 43);
  Vec3f c = Mix(Vec3f{0.097f, 0.136f, 0.027f}, Vec3f{0.141f, 0.172f, 0.037f}, Ramp(0.3f, 0.72f, 0.6f * wide + 0.4f * narrow));
  c = Mix(c, Vec3f{0.084f, 0.138f, 0.031f}, 0.40f * Clover(p));
  return Mix(c, Vec3f{0.235f, 0.205f, 0.085f}, 0.45f * Dry(p));
}

Vec3f Layout::Lawn(Vec2f p) const { return LawnCoarse(p) * (0.72f + 0.56f * Fractal(p.x / 0.55f, p.y / 0.55f, 2, 45)); }

Vec3f Layout::Soil(Vec2f p, float fine_detail) const {
  const float f = fine_detail > 0 ? Mix(0.5f, Fractal(p.x * 4, p.y * 4, 2, 31), fine_detail) : 0.5f;
  return Vec3f{0.115f, 0.085f, 0.055f} * (0.6f + 0.8f * f);
}

}  // namespace airsim360::internal::park

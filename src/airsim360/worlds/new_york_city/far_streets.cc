// Streets beyond the detailed ring of new_york_city, to the end of the far blocks: a sheet of asphalt, paint, cars and
// trees for each stretch between two crossings, so that the canyons that are seen from the core do not end in a desert.
#include <array>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/new_york_city/far_city.h"

namespace airsim360::internal {
namespace {

constexpr float kLift = 0.012f, kZebra = 3.2f, kCurb = 7;  // kCurb: paint ends so far before a crossing's kerb line

// A straight piece of far street: s along it from its middle line's lower end, d to the left of it.
struct FarStretch {
  float center, half_width, s0, s1;
  bool along_x;
  GroundRect Cut(float a, float b, float d0, float d1) const {
    return along_x ? GroundRect{a, center + d0, b, center + d1} : GroundRect{center - d1, a, center - d0, b};
  }
  Vec3f At(float s, float d) const { return along_x ? Vec3f{s, center + d, kFarGroundZ} : Vec3f{center - d, s, kFarGroundZ}; }
};

void PaintWhiteLines(District& d, const FarStretch& street, bool avenue) {
  const float hw = street.half_width, s0 = street.s0 + kCurb, s1 = street.s1 - kCurb;
  d.ground.Begin("far markings", "ground/lane_marking", Surface::kPaintWhite);
  d.ground.Rect(street.Cut(s0, s1, -0.07f, 0.07f), kFarGroundZ + kLift);
  for (float side : {-1.0f, 1.0f})
    for (float lane : {3.7f, 7.2f})
      for (float s = s0 + 2; avenue && s + 3 < s1; s += 9)
        d.ground.Rect(street.Cut(s, s + 3, side * lane - 0.07f, side * lane + 0.07f), kFarGroundZ + kLift);
  d.ground.Begin("far crosswalk", "ground/crosswalk", Surface::kPaintWhite);
  for (float s : {street.s0 + 0.9f, street.s1 - 0.9f - kZebra})
    for (float line : {s, s + kZebra - 0.25f}) d.ground.Rect(street.Cut(line, line + 0.25f, 0.7f - hw, hw - 0.7f), kFarGroundZ + kLift);
}

void PaintStretch(District& d, const FarStretch& street, bool avenue) {
  if (d.plan.paint == RoadPaint::kWhiteLines) return PaintWhiteLines(d, street, avenue);
  const float hw = street.half_width, s0 = street.s0 + kCurb, s1 = street.s1 - kCurb;
  d.ground.Begin("far markings", "ground/lane_marking", Surface::kPaintYellow);
  for (float at : {-0.2f, 0.1f}) d.ground.Rect(street.Cut(s0, s1, at, at + 0.1f), kFarGroundZ + kLift);
  d.ground.Use(Surface::kPaintWhite);
  for (float side : {-1.0f, 1.0f}) {
    const float bay = side * (hw - 2.35f);
    d.ground.Rect(street.Cut(s0, s1, bay - 0.06f, bay + 0.06f), kFarGroundZ + kLift);
    for (float lane : {3.7f, 7.2f})
      for (float s = s0 + 2; avenue && s + 3 < s1; s += 9)
        d.ground.Rect(street.Cut(s, s + 3, side * lane - 0.07f, side * lane + 0.07f), kFarGroundZ + kLift);
  }
  d.ground.Begin("far crosswalk", "ground/crosswalk", Surface::kPaintWhite);
  for (float s : {street.s0 + 0.9f, street.s1 - 0.9f - kZebra})
    for (float across = 0.7f - hw; across < hw - 0.9f; across += 1.3f)
      d.ground.Rect(street.Cut(s, s + kZebra, across, across + 0.6f), kFarGroundZ + kLift);
}

void ParkAndDrive(District& d, const FarStretch& street, bool avenue, double traffic, RngStream& rng) {
  const auto uniform = [&](double a, double b) { return static_cast<float>(rng.Uniform(a, b)); };
  const Vec2f forward = street.along_x ? Vec2f{1, 0} : Vec2f{0, 1};
  for (float side : {-1.0f, 1.0f}) {
    const float yaw = FacingYaw(forward * -side), s0 = street.s0 + kCurb + 3, s1 = street.s1 - kCurb - 3;
    for (float s = s0; s < s1; s += 6.2f)
      if (rng.Chance(0.6 * traffic))
        d.placer.Try(rng.Chance(0.85) ? "car" : "van", street.At(s + uniform(-0.3, 0.3), side * (street.half_width - 1.25f)), yaw);
    for (float lane : avenue ? std::vector<float>{2.0f, 5.45f} : std::vector<float>{2.1f}) {
      for (float s = s0 + uniform(0, 25); s < s1 && traffic > 0.05; s += uniform(9, 38) / static_cast<float>(traffic)) {
        const double pick = rng.Uniform();
        d.placer.Drive(pick < 0.4 ? "taxi" : pick < 0.9 ? "car" : "van", street.At(s, side * lane + uniform(-0.2, 0.2)), yaw);
      }
    }
  }
}

void PlantStretch(District& d, const FarStretch& street, double trees, RngStream& rng) {
  for (float side : {-1.0f, 1.0f}) {
    for (float s = street.s0 + 6; s < street.s1 - 6; s += 13) {
      if (!rng.Chance(0.6 * trees)) continue;
      Vec3f p = street.At(s + static_cast<float>(rng.Uniform(-1, 1)), side * (street.half_width + 1.3f));
      p.z = kFarPavementZ - 0.02f;
      d.placer.Try("tree_narrowleaf", p, static_cast<float>(rng.Uniform(0, 6.28)), static_cast<float>(rng.Uniform(0.65, 0.9)), {1, 1, 1},
                   rng.Index(3));
    }
  }
}

// All stretches of one line of the grid outside `ring`, crossing by crossing.
void LayFarLine(District& d, const StreetLine& line, bool along_x, const GroundRect& ring, const Density& density) {
  const float pitch = along_x ? kFarPitchX : kFarPitchY, other = along_x ? 13 : 6.5f;
  const float low = along_x ? ring.x0 : ring.y0, high = along_x ? ring.x1 : ring.y1;
  const bool avenue = !along_x;
  const int n = static_cast<int>(kFarCityEdge / pitch);
  for (int i = -n; i < n; ++i) {
    const FarStretch street{line.center, line.half_width, pitch * static_cast<float>(i) + other, pitch * static_cast<float>(i + 1) - other,
                            along_x};
    const float middle = (street.s0 + street.s1) / 2;
    if (middle > low && middle < high) continue;
    RngStream rng(d.seed, along_x ? "far street" : "far avenue",
                  static_cast<uint64_t>((i + 64) * 4096) + static_cast<uint64_t>(std::lround(line.center) + 2048));
    static constexpr std::array kTones{Surface::kAsphalt, Surface::kAsphaltOld, Surface::kAsphaltPatch};
    d.ground.Begin("far road", "ground/road", kTones[rng.Index(kTones.size())]);
    d.ground.Rect(street.Cut(street.s0, street.s1, -line.half_width, line.half_width), kFarGroundZ + 0.004f);
    PaintStretch(d, street, avenue);
    ParkAndDrive(d, street, avenue, density.traffic, rng);
    PlantStretch(d, street, density.trees, rng);
  }
}

}  // namespace

void LayFarStreets(District& d, const GroundRect& ring, const Density& density) {
  for (const StreetLine& line : d.plan.north_south) LayFarLine(d, line, false, ring, density);
  for (const StreetLine& line : d.plan.east_west) LayFarLine(d, line, true, ring, density);
}

}  // namespace airsim360::internal

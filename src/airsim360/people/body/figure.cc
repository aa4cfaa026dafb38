// The procedural body: levels of detail, props, and what they hang on.
#include "airsim360/people/body/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace internal {

int FigureContext::Around(int fine) const {
  constexpr double kShare[] = {1.0, 0.55, 0.28, 0.16};
  return std::max(level >= 3 ? 4 : 5, static_cast<int>(std::lround(fine * kShare[level])));
}

std::vector<LoftRing> Thinned(std::vector<LoftRing> rings, int level) {
  if (level < 2 || rings.size() < 4) return rings;
  std::vector<LoftRing> kept;
  const size_t stride = level == 2 ? 2 : 3;
  for (size_t k = 0; k + 1 < rings.size(); k += stride) kept.push_back(rings[k]);
  kept.push_back(rings.back());
  return kept;
}

namespace {

// A stroller before the person: its handle is where the hands are.
void AddStroller(double H, uint32_t dark, uint32_t metal, uint32_t color, LoftMesh& mesh) {
  mesh.BeginProp(Prop::kStroller, kRootInfluence);
  const double k = std::clamp(H / 1.7, 0.8, 1.1), handle = 1.0 * k;
  mesh.Bar({0.46, 0.24, handle}, {0.46, -0.24, handle}, 0.018, 0.018, 8, dark);
  for (const double y : {0.24, -0.24}) {
    mesh.Bar({0.46, y, handle}, {1.10, y, 0.16}, 0.012, 0.012, 6, metal);
    mesh.Bar({0.62, y, 0.13}, {0.88, y, 0.48}, 0.012, 0.012, 6, metal);
    for (const auto& [x, radius] : {std::pair{0.62, 0.13}, {1.12, 0.09}}) {
      mesh.Bar({x, y - 0.022, radius}, {x, y + 0.022, radius}, radius, radius, 18, dark);
      mesh.Bar({x, y - 0.027, radius}, {x, y + 0.027, radius}, 0.6 * radius, 0.6 * radius, 10, metal);
    }
  }
  mesh.Box({0.86, 0, 0.24}, {0.20, 0.18, 0.05}, RotationY(0.0), dark);
  // The seat, from the foot rest over the knees to the back; then the hood above it, open to the front.
  std::vector<LoftRing> seat, hood;
  for (const auto& [x, z] : {std::pair{1.13, 0.30}, {1.07, 0.44}, {0.97, 0.49}, {0.80, 0.48}, {0.70, 0.60}, {0.63, 0.78}, {0.60, 0.88}})
    seat.push_back({{x, 0, z}, 0.19, 0.05, 0.05, 3.5, {}, -1});
  mesh.Loft(seat,
            {.material = color, .segments = 12, .steps = 1, .u = {0, 1, 0}, .v = {std::sqrt(0.5), 0, std::sqrt(0.5)}, .cap_first = true});
  for (const auto& [x, half, up, down] : {std::array{0.49, 0.06, 0.05, 0.06},
                                          {0.52, 0.15, 0.13, 0.14},
                                          {0.59, 0.20, 0.19, 0.20},
                                          {0.70, 0.215, 0.22, 0.12},
                                          {0.82, 0.21, 0.22, 0.05},
                                          {0.88, 0.205, 0.20, 0.02}})
    hood.push_back({{x, 0, 0.84}, half, up, down, 2.3, {}, -1});
  mesh.Loft(hood, {.material = color, .segments = 16, .steps = 1, .u = {0, 1, 0}, .v = {0, 0, 1}, .cap_first = true, .cap_last = false});
}

}  // namespace

void AddProps(const std::array<Vec3d, kJointCount>& q, double H, uint32_t first_material, LoftMesh& mesh) {
  const uint32_t dark = first_material, metal = first_material + 1, color = first_material + 2;
  const Vec3d wrist = q[At(Joint::kRightWrist)];
  const Vec3d d = Normalized(q[At(Joint::kRightFingers1)] - wrist), x{1, 0, 0}, palm = Normalized(Cross(x, d));
  const Mat3d hand = Mat3d::FromColumns(d, palm, Cross(d, palm));
  const Vec3d n = palm.z < 0 ? palm : -palm;  // palms face down at rest

  // A phone of 15 x 7 cm in the right palm.
  mesh.BeginProp(Prop::kPhone, static_cast<uint8_t>(Joint::kRightWrist));
  mesh.Box(wrist + d * (0.060 * H) + n * (0.017 * H), {0.075, 0.005, 0.036}, hand, dark);
  // A bag that hangs from the right hand.
  mesh.BeginProp(Prop::kBag, static_cast<uint8_t>(Joint::kRightWrist));
  const Vec3d grip = wrist + d * (0.062 * H) + n * (0.012 * H);
  mesh.Box(grip + d * 0.27, {0.15, 0.055, 0.17}, hand, color);
  mesh.Bar(grip + x * 0.05, grip + d * 0.13 + x * 0.10, 0.006, 0.006, 6, dark);
  mesh.Bar(grip - x * 0.05, grip + d * 0.13 - x * 0.10, 0.006, 0.006, 6, dark);
  mesh.Bar(grip + x * 0.05, grip - x * 0.05, 0.008, 0.008, 6, dark);
  // An umbrella whose stick passes through the fist along the thumb.
  mesh.BeginProp(Prop::kUmbrella, static_cast<uint8_t>(Joint::kRightWrist));
  mesh.Bar(grip - x * 0.12, grip + x * 0.72, 0.008, 0.006, 6, dark);
  std::vector<LoftRing> canopy;
  for (const auto& [t, r] : {std::pair{0.52, 0.50}, {0.60, 0.44}, {0.68, 0.27}, {0.71, 0.02}})
    canopy.push_back({grip + x * t, r, r, r, 2, {}, -1});
  mesh.Loft(canopy, {.material = color, .segments = 16, .steps = 1, .u = d, .v = palm, .cap_first = true});

  AddStroller(H, dark, metal, color, mesh);
}

}  // namespace internal

std::shared_ptr<const Body> MakeProceduralBody(const BodySpec& spec, int finest_level) {
  if (!(spec.stature >= 0.9 && spec.stature <= 2.3) || !(spec.age >= 2 && spec.age <= 110))
    throw InputError("a body of " + std::to_string(spec.stature) + " m and " + std::to_string(spec.age) +
                     " years: stature must be 0.9 to 2.3 m, age 2 to 110 years");
  using namespace internal;
  auto body = std::make_shared<Body>();
  body->spec = spec;
  body->character = "procedural";
  const Proportions p = ProportionsOf(spec);
  const Wardrobe wear = DrawWardrobe(spec);
  body->outfit = wear.name;
  body->p_PJ = RestJoints(p);
  FinishSkeleton(*body);
  body->size.radius = 0.155 * spec.stature / 1.0 * (0.9 + 0.1 * p.girth);
  body->sockets = ProceduralSockets(*body, p);
  PaintBody(wear, spec, *body);
  body->levels.resize(static_cast<size_t>(std::clamp(finest_level, 0, kBodyLevels - 1)));
  for (int level = static_cast<int>(body->levels.size()); level < kBodyLevels; ++level) {
    LoftMesh mesh;
    const FigureContext context{*body, p, wear, level};
    AddTrunk(context, mesh);
    AddLegs(context, mesh);
    AddArms(context, mesh);
    AddHead(context, mesh);
    AddProps(body->p_PJ, spec.stature, kPropDark, mesh);
    body->levels.push_back(mesh.Finish("person"));
  }
  return body;
}

}  // namespace airsim360

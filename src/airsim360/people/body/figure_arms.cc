// Arms and hands of a procedural person.
#include <algorithm>
#include <cmath>

#include "airsim360/people/body/figure.h"

namespace airsim360::internal {
namespace {

struct Side {
  Joint clavicle, shoulder, elbow, wrist, thumb1, thumb2, fingers1, fingers2;
};
constexpr Side kLeft{Joint::kLeftClavicle, Joint::kLeftShoulder, Joint::kLeftElbow,    Joint::kLeftWrist,
                     Joint::kLeftThumb1,   Joint::kLeftThumb2,   Joint::kLeftFingers1, Joint::kLeftFingers2};
constexpr Side kRight{Joint::kRightClavicle, Joint::kRightShoulder, Joint::kRightElbow,    Joint::kRightWrist,
                      Joint::kRightThumb1,   Joint::kRightThumb2,   Joint::kRightFingers1, Joint::kRightFingers2};

// One layer of an arm between two positions along shoulder (0), elbow (1), wrist (2).
void AddArmLayer(const FigureContext& f, const Side& s, double from, double to, double cloth, uint32_t material, LoftMesh& mesh) {
  const double H = f.H(), g = 0.5 + 0.5 * f.p.girth, slim = f.p.female ? 0.90 : 1;
  const Vec3d a = f.joint(s.shoulder), b = f.joint(s.elbow), c = f.joint(s.wrist), d = Normalized(b - a);
  // Position, radius across (in the plane of the palm), radius before and behind.
  const double rows[][3] = {{-0.36, 0.010, 0.016}, {-0.18, 0.019, 0.029}, {0.0, 0.026, 0.034},   {0.18, 0.029, 0.035},
                            {0.45, 0.0285, 0.032}, {0.75, 0.026, 0.028},  {1.0, 0.0235, 0.025},  {1.22, 0.024, 0.026},
                            {1.5, 0.021, 0.0225},  {1.8, 0.0155, 0.018},  {2.03, 0.0125, 0.0165}};
  std::vector<LoftRing> rings;
  for (const auto& row : rows) {
    const double t = row[0];
    if (t < from - 1e-9 || t > to + 1e-9) continue;
    // Inside the trunk the sleeve goes towards the spine, not on along the arm.
    const Vec3d inwards = Normalized(Vec3d{0, -a.y, -0.35 * std::abs(a.y)}) * Norm(b - a);
    const Vec3d q = t < 0 ? a - inwards * t : t < 1 ? a + (b - a) * t : b + (c - b) * (t - 1);
    Influences bones = MixBones(Bone(s.clavicle), Bone(s.shoulder), std::clamp((t + 0.22) / 0.40, 0.0, 1.0));
    bones = MixBones(bones, Bone(s.elbow), std::clamp((t - 0.86) / 0.28, 0.0, 1.0));
    // A third of the turn of the hand is taken by the forearm.
    bones = MixBones(bones, Bone(s.wrist), t < 1.94 ? 0.3 * std::clamp((t - 1.5) / 0.45, 0.0, 1.0) : 0.6);
    const double across = row[1] * g * slim + cloth, deep = row[2] * g * slim + cloth;
    rings.push_back({q, across * H, deep * H, deep * H, 2, bones, -1});
  }
  const Vec3d v{1, 0, 0};
  mesh.Loft(Thinned(rings, f.level), {.material = material,
                                      .segments = f.Around(20),
                                      .steps = f.Steps(3),
                                      .u = Normalized(Cross(d, v)),
                                      .v = v,
                                      .cap_first = true,
                                      .cap_last = true,
                                      .uv_metres = 0.45});
}

void AddFinger(const FigureContext& f, Vec3d base, Vec3d d, Vec3d n, double length, double radius, Joint first, Joint second, int segments,
               LoftMesh& mesh) {
  std::vector<LoftRing> rings;
  for (const auto& [t, r, w] :
       {std::tuple{-0.1, 1.0, 0.0}, {0.25, 1.0, 0.0}, {0.45, 1.0, 0.5}, {0.6, 0.95, 1.0}, {0.85, 0.85, 1.0}, {1.0, 0.4, 1.0}})
    rings.push_back({base + d * (t * length), r * radius, r * radius, r * radius, 2, MixBones(Bone(first), Bone(second), w), -1});
  mesh.Loft(Thinned(rings, f.level), {.material = kSkinMaterial, .segments = segments, .steps = 1, .u = Normalized(Cross(d, n)), .v = n});
}

void AddThumb(const FigureContext& f, const Side& s, Vec3d d, Vec3d u, int segments, LoftMesh& mesh) {
  const double H = f.H();
  const Vec3d base = f.joint(s.thumb1) - d * (0.006 * H), tip = f.joint(s.thumb2) + (f.joint(s.thumb2) - f.joint(s.thumb1)) * 0.8;
  const Vec3d along = Normalized(tip - base);
  AddFinger(f, base, along, Normalized(Cross(along, u)), Norm(tip - base), 0.0075 * H, s.thumb1, s.thumb2, segments, mesh);
}

void AddHand(const FigureContext& f, const Side& s, LoftMesh& mesh) {
  const double H = f.H();
  const Vec3d w = f.joint(s.wrist), d = Normalized(f.joint(s.fingers1) - w), v{1, 0, 0}, u = Normalized(Cross(d, v));
  // The palm: wide along +X (where the thumb is), thin across.
  std::vector<LoftRing> palm;
  for (const auto& [t, wide, thin, bone] : {std::tuple{-0.008, 0.0150, 0.0115, 0.0},
                                            {0.012, 0.0180, 0.0115, 0.0},
                                            {0.034, 0.0225, 0.0105, 0.0},
                                            {0.052, 0.0220, 0.0090, 0.5},
                                            {0.058, 0.018, 0.006, 1.0}})
    palm.push_back({w + d * (t * H), thin * H, wide * H, wide * H, 2.4, MixBones(Bone(s.wrist), Bone(s.fingers1), bone), -1});
  mesh.Loft(Thinned(palm, f.level),
            {.material = kSkinMaterial, .segments = f.Around(16), .steps = f.Steps(2), .u = u, .v = v, .cap_first = false});
  if (f.level >= 2) {
    std::vector<LoftRing> mitten;
    for (const auto& [t, wide, k] : {std::tuple{0.05, 0.021, 0.0}, {0.078, 0.019, 0.5}, {0.106, 0.010, 1.0}})
      mitten.push_back({w + d * (t * H), 0.0065 * H, wide * H, wide * H, 2.4, MixBones(Bone(s.fingers1), Bone(s.fingers2), k), -1});
    mesh.Loft(mitten, {.material = kSkinMaterial, .segments = f.level == 2 ? 6 : 4, .steps = 1, .u = u, .v = v});
    if (f.level == 2) AddThumb(f, s, d, u, 4, mesh);
    return;
  }
  // Fingers, index first, and the thumb.
  const double places[][2] = {{0.0160, 0.050}, {0.0054, 0.056}, {-0.0054, 0.053}, {-0.0158, 0.043}};
  for (const auto& place : places)
    AddFinger(f, w + d * (0.052 * H) + v * (place[0] * H), d, v, place[1] * H, 0.0056 * H, s.fingers1, s.fingers2, f.Around(9), mesh);
  AddThumb(f, s, d, u, f.Around(9), mesh);
}

}  // namespace

void AddArms(const FigureContext& f, LoftMesh& mesh) {
  for (const Side& s : {kLeft, kRight}) {
    const Top top = f.wear.top;
    const double end = top == Top::kTShirt ? 0.75 : top == Top::kVest ? -0.16 : 2.03;
    const double cloth = top == Top::kJacket ? 0.009 : top == Top::kPullover ? 0.006 : top == Top::kShirt ? 0.0045 : 0.0045;
    if (top == Top::kVest)
      AddArmLayer(f, s, -0.36, 2.03, 0, kSkinMaterial, mesh);
    else
      AddArmLayer(f, s, -0.36, end, cloth, kTopMaterial, mesh);
    if (top == Top::kTShirt) AddArmLayer(f, s, 0.18, 2.03, 0, kSkinMaterial, mesh);
    AddHand(f, s, mesh);
  }
}

}  // namespace airsim360::internal

// Trunk and legs of a procedural person: shirt, jacket, skirt, trousers, shoes.
#include <algorithm>
#include <cmath>

#include "airsim360/people/body/figure.h"

namespace airsim360::internal {
namespace {

// Weights along the spine at height z: hat functions, each bone reaching 3 % of stature into the next.
Influences Spine(const FigureContext& f, double z) {
  constexpr Joint kChain[] = {Joint::kPelvis, Joint::kSpine1, Joint::kSpine2, Joint::kSpine3, Joint::kNeck};
  Influences bones = Bone(Joint::kPelvis);
  for (size_t k = 1; k < std::size(kChain); ++k) {
    const double reach = 0.03 * f.H(), z_joint = f.joint(kChain[k]).z;
    const double t = std::clamp((z - z_joint) / (2 * reach) + 0.5, 0.0, 1.0);
    bones = MixBones(bones, Bone(kChain[k]), t);
  }
  return bones;
}

// Cloth and flesh below the hips follow the thighs, by side.
void FollowThighs(const FigureContext& f, LoftVertex& v, double share) {
  const double side = std::clamp(v.p.y / (0.10 * f.H()) + 0.5, 0.0, 1.0);
  const Influences legs = MixBones(Bone(Joint::kRightHip), Bone(Joint::kLeftHip), side);
  v.bones = MixBones(v.bones, legs, share);
}

LoftRing TrunkRing(const FigureContext& f, double z, double half, double front, double back) {
  const double H = f.H(), g = f.p.girth;
  return {{-0.004 * H, 0, z}, half * H * g, front * H * g, back * H * g, 2.4, Spine(f, z), -1};
}

void AddShirt(const FigureContext& f, LoftMesh& mesh) {
  const Proportions& p = f.p;
  const double H = p.stature, hip = p.hip * H, trunk = (p.shoulder - p.hip) * H, k = p.adult * (p.female ? 1 : 0);
  const double wide = p.shoulder_half / 0.113, belly = 0.028 * p.belly;
  const double loose = f.wear.top == Top::kJacket ? 0.008 : f.wear.top == Top::kPullover ? 0.005 : 0.002;
  std::vector<LoftRing> rings;
  const auto ring = [&](double share, double half, double front, double back) {
    rings.push_back(TrunkRing(f, hip + share * trunk, half + loose, front + loose, back + loose));
  };
  const double long_cut = f.wear.coat ? -0.52 : f.wear.top == Top::kJacket ? -0.16 : -0.06;
  if (f.wear.coat) ring(long_cut, 0.112, 0.082, 0.084);
  ring(std::max(long_cut, -0.16), 0.104 + 0.004 * k, 0.073, 0.079);
  ring(0.06, 0.101 + 0.005 * k, 0.067 + 0.6 * belly, 0.072);
  ring(0.22, 0.093, 0.063 + belly, 0.063);
  ring(0.37, 0.087 - 0.010 * k, 0.060 + belly, 0.054 - 0.003 * k);
  ring(0.55, 0.091 - 0.008 * k, 0.063 + 0.5 * belly + 0.008 * k, 0.056);
  ring(0.70, 0.096 - 0.008 * k, 0.067 + 0.014 * k, 0.062);
  ring(0.84, 0.099 * wide, 0.062 + 0.003 * k, 0.063);
  ring(0.95, 0.097 * wide, 0.050, 0.056);
  ring(1.01, 0.078 * wide, 0.040, 0.046);
  ring(1.055, 0.050, 0.035, 0.039);
  ring(1.085, 0.0375, 0.033, 0.035);
  const double armpit = hip + 0.80 * trunk;
  LoftStyle style{.material = kTopMaterial, .segments = f.Around(40), .steps = f.Steps(3), .uv_metres = 0.45};
  style.cap_first = true;
  style.deform = [&](LoftVertex& v) {
    if (v.p.z < hip + 0.02 * H) FollowThighs(f, v, std::clamp((hip + 0.02 * H - v.p.z) / (0.10 * H), 0.0, 0.85));
    // Beside the neck the cloth follows the collar bones.
    const double out = std::clamp((std::abs(v.p.y) - 0.03 * H) / (0.05 * H), 0.0, 1.0);
    const double up = std::clamp((v.p.z - armpit) / (0.05 * H), 0.0, 1.0);
    v.bones = MixBones(v.bones, Bone(v.p.y > 0 ? Joint::kLeftClavicle : Joint::kRightClavicle), 0.75 * out * up);
  };
  mesh.Loft(Thinned(rings, f.level), style);

  // A jacket is open over a light shirt: a wedge on the chest.
  if (f.wear.top == Top::kJacket && f.level < 2) {
    std::vector<LoftRing> wedge;
    for (const auto& [share, half, front] : {std::tuple{0.50, 0.006, 0.079 + 0.5 * belly + 0.008 * k},
                                             {0.75, 0.016, 0.078 + 0.012 * k},
                                             {0.95, 0.026, 0.061},
                                             {1.08, 0.030, 0.042}})
      wedge.push_back({{-0.004 * H, 0, hip + share * trunk}, half * H, front * H * p.girth, 0, 2, Spine(f, hip + share * trunk), -1});
    mesh.Loft(wedge, {.material = kSkinMaterial, .segments = 10, .steps = 2, .cap_last = false});
  }
}

void AddSkirt(const FigureContext& f, LoftMesh& mesh) {
  const Proportions& p = f.p;
  const double H = p.stature, hip = p.hip * H, hem = 0.30 * hip / 0.53 * (f.wear.bottom == Bottom::kDress ? 0.95 : 1.05);
  std::vector<LoftRing> rings;
  for (const auto& [z, half, front, back] : {std::tuple{hem, 0.135, 0.108, 0.112},
                                             {0.42 * hip + 0.58 * hem, 0.122, 0.094, 0.098},
                                             {0.75 * hip + 0.25 * hem, 0.112, 0.080, 0.086},
                                             {hip, 0.104, 0.068, 0.074},
                                             {hip + 0.06 * H, 0.092, 0.060, 0.060}})
    rings.push_back(TrunkRing(f, z, half, front, back));
  LoftStyle style{.material = kBottomMaterial, .segments = f.Around(36), .steps = f.Steps(3), .cap_last = false, .uv_metres = 0.45};
  style.deform = [&](LoftVertex& v) {
    FollowThighs(f, v, std::clamp((hip + 0.03 * H - v.p.z) / (0.16 * H), 0.0, 0.92));
    // Folds.
    if (f.level < 2) {
      const double depth = 0.006 * H * std::clamp((hip - v.p.z) / (0.2 * H), 0.0, 1.0);
      v.p += Vec3d{std::cos(v.theta), std::sin(v.theta), 0} * (depth * std::sin(9 * v.theta));
    }
  };
  mesh.Loft(Thinned(rings, f.level), style);
}

// Flesh between trunk and legs, in the colour of the trousers.
void AddSeat(const FigureContext& f, LoftMesh& mesh) {
  const double H = f.H(), hip = f.p.hip * H, k = f.p.female ? 0.004 : 0;
  std::vector<LoftRing> rings;
  for (const auto& [z, half, front, back] : {std::tuple{-0.062, 0.040, 0.026, 0.034},
                                             {-0.045, 0.075, 0.048, 0.056},
                                             {-0.015, 0.095 + k, 0.060, 0.070},
                                             {0.02, 0.098 + k, 0.062, 0.070},
                                             {0.05, 0.092, 0.061, 0.062},
                                             {0.075, 0.086, 0.058, 0.056}})
    rings.push_back(TrunkRing(f, hip + z * H, half, front, back));
  LoftStyle style{.material = kBottomMaterial, .segments = f.Around(32), .steps = f.Steps(2), .cap_first = true, .uv_metres = 0.45};
  style.deform = [&](LoftVertex& v) { FollowThighs(f, v, std::clamp((hip - v.p.z) / (0.10 * H), 0.0, 0.5)); };
  mesh.Loft(rings, style);
}

// One layer of a leg from position `from` (0 hip, 1 knee) to the height `bottom` (share of stature); radii grow by
// `cloth`.
void AddLegLayer(const FigureContext& f, bool left, double bottom, double cloth, double flare, uint32_t material, double from,
                 LoftMesh& mesh) {
  const double H = f.H(), g = f.p.girth, k = f.p.female ? 0.002 : 0;
  const Joint hip = left ? Joint::kLeftHip : Joint::kRightHip, knee = left ? Joint::kLeftKnee : Joint::kRightKnee;
  const Joint ankle = left ? Joint::kLeftAnkle : Joint::kRightAnkle;
  const Vec3d a = f.joint(hip), b = f.joint(knee), c = f.joint(ankle);
  // Position along hip (0), knee (1), ankle (2); half width, front, back; shares of stature.
  const double rows[][4] = {{-0.06, 0.046, 0.052, 0.054}, {0.10, 0.051, 0.056, 0.062}, {0.28, 0.050 + k, 0.055, 0.056},
                            {0.55, 0.043, 0.049, 0.046},  {0.82, 0.036, 0.040, 0.036}, {1.0, 0.033, 0.036, 0.033},
                            {1.18, 0.031, 0.031, 0.037},  {1.38, 0.030, 0.027, 0.041}, {1.62, 0.025, 0.023, 0.032},
                            {1.85, 0.019, 0.020, 0.024},  {2.02, 0.019, 0.021, 0.023}};
  std::vector<LoftRing> rings;
  for (const auto& row : rows) {
    const double t = row[0];
    if (t < from) continue;
    const Vec3d q = t < 1 ? a + (b - a) * t : b + (c - b) * (t - 1);
    if (q.z < bottom * H && rings.size() > 3) break;
    // Hip to thigh over the upper fifth, knee and ankle over short ways.
    Influences bones = MixBones(Bone(Joint::kPelvis), Bone(hip), std::clamp((t + 0.12) / 0.30, 0.0, 1.0));
    bones = MixBones(bones, Bone(knee), std::clamp((t - 0.88) / 0.24, 0.0, 1.0));
    bones = MixBones(bones, Bone(ankle), 0.6 * std::clamp((t - 1.9) / 0.12, 0.0, 1.0));
    const double open = flare * std::clamp(t - 1, 0.0, 1.0), w = cloth + open;
    rings.push_back({q, (row[1] * g + w) * H, (row[2] * g + w) * H, (row[3] * g + w) * H, 2.1, bones, -1});
  }
  LoftStyle style{.material = material, .segments = f.Around(26), .steps = f.Steps(3), .cap_last = true, .uv_metres = 0.45};
  mesh.Loft(Thinned(rings, f.level), style);
}

void AddShoe(const FigureContext& f, bool left, LoftMesh& mesh) {
  const double H = f.H(), y = f.joint(left ? Joint::kLeftAnkle : Joint::kRightAnkle).y, side = left ? 1 : -1;
  const Joint ankle = left ? Joint::kLeftAnkle : Joint::kRightAnkle, toes = left ? Joint::kLeftToes : Joint::kRightToes;
  // x, half width, height, shift outwards.
  const double rows[][4] = {{-0.044, 0.010, 0.022, 0},     {-0.038, 0.018, 0.042, 0},      {-0.015, 0.0215, 0.052, 0},
                            {0.012, 0.0220, 0.050, 0},     {0.040, 0.0245, 0.039, 0.001},  {0.068, 0.0275, 0.030, 0.002},
                            {0.092, 0.0255, 0.024, 0.001}, {0.108, 0.0180, 0.019, -0.001}, {0.115, 0.006, 0.012, -0.002}};
  for (const bool sole : {false, true}) {
    if (sole && f.level > 1) continue;
    std::vector<LoftRing> rings;
    for (const auto& row : rows) {
      const Influences bones = MixBones(Bone(ankle), Bone(toes), std::clamp((row[0] - 0.052) / 0.03, 0.0, 1.0));
      const double height = sole ? 0.010 : row[2], grow = sole ? 0.0015 : 0;
      rings.push_back({{row[0] * H, y + side * row[3] * H, 0.5 * height * H},
                       (row[1] + grow) * H,
                       0.5 * height * H,
                       0.5 * height * H,
                       sole ? 4.0 : 2.8,
                       bones,
                       -1});
    }
    mesh.Loft(Thinned(rings, f.level), {.material = sole ? kSoleMaterial : kShoeMaterial,
                                        .segments = f.Around(20),
                                        .steps = f.Steps(2),
                                        .u = {0, 1, 0},
                                        .v = {0, 0, 1},
                                        .cap_first = true});
  }
}

}  // namespace

void AddTrunk(const FigureContext& f, LoftMesh& mesh) {
  AddShirt(f, mesh);
  const bool skirt = f.wear.bottom == Bottom::kSkirt || f.wear.bottom == Bottom::kDress;
  if (skirt) AddSkirt(f, mesh);
  if (!skirt || f.level < 2) AddSeat(f, mesh);
}

void AddLegs(const FigureContext& f, LoftMesh& mesh) {
  for (const bool left : {true, false}) {
    const Bottom b = f.wear.bottom;
    if (b == Bottom::kTrousers || b == Bottom::kJeans) {
      AddLegLayer(f, left, 0.028, 0.005, b == Bottom::kTrousers ? 0.008 : 0.003, kBottomMaterial, -1, mesh);
    } else {
      AddLegLayer(f, left, 0.0, 0, 0, kSkinMaterial, 0.2, mesh);  // the rest is under cloth
      if (b == Bottom::kShorts) AddLegLayer(f, left, 0.33 * f.p.hip / 0.53, 0.008, 0, kBottomMaterial, -1, mesh);
    }
    AddShoe(f, left, mesh);
  }
}

}  // namespace airsim360::internal

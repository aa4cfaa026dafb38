// Head, face and hair of a procedural person.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/people/body/figure.h"

namespace airsim360::internal {
namespace {

// Slices of the head from chin (0) to top (1), in units of the head's height: height, front, back, half width.
constexpr double kHead[][4] = {{-0.03, 0.28, 0.05, 0.08},   {-0.01, 0.37, 0.10, 0.15},  {0.05, 0.445, 0.14, 0.215},
                               {0.14, 0.465, 0.20, 0.265},  {0.24, 0.47, 0.265, 0.295}, {0.36, 0.475, 0.315, 0.318},
                               {0.48, 0.472, 0.345, 0.332}, {0.58, 0.492, 0.36, 0.340}, {0.70, 0.482, 0.36, 0.338},
                               {0.81, 0.425, 0.325, 0.300}, {0.90, 0.325, 0.25, 0.235}, {0.96, 0.21, 0.16, 0.155},
                               {0.995, 0.06, 0.05, 0.05}};

double Bump(double x, double center, double reach) {
  const double t = std::max(0.0, 1 - std::abs(x - center) / reach);
  return t * t * (3 - 2 * t);
}

// How far hair stands off the head at an angle from the front and a height; negative = no hair.
double HairThickness(Hair style, double theta, double z, uint64_t) {
  const double a = std::abs(theta) / std::numbers::pi;  // 0 front, 1 back
  double line = 0, thick = 0.045;
  switch (style) {
    case Hair::kCropped:
      line = a < 0.25 ? 0.80 - 0.3 * a : a < 0.45 ? 0.70 - 1.6 * (a - 0.25) : 0.38 - 0.45 * (a - 0.45);
      thick = 0.018;
      break;
    case Hair::kBald:
      line = a < 0.42 ? 2 : 0.52 - 0.5 * (a - 0.42);
      thick = z > 0.70 ? -0.02 : 0.022;
      break;
    case Hair::kCap:
      line = a < 0.3 ? 0.68 : 0.68 - 0.25 * (a - 0.3);
      thick = 0.05;
      break;
    case Hair::kShort:
      line = a < 0.22 ? 0.78 - 0.35 * a : a < 0.45 ? 0.70 - 1.8 * (a - 0.22) : 0.28 - 0.35 * (a - 0.45);
      thick = 0.04 + 0.03 * Bump(z, 0.95, 0.3);
      break;
    case Hair::kBun:
      line = a < 0.22 ? 0.77 - 0.35 * a : a < 0.45 ? 0.69 - 1.6 * (a - 0.22) : 0.32 - 0.35 * (a - 0.45);
      thick = 0.03;
      break;
    case Hair::kBob:
      line = a < 0.2 ? 0.76 - 0.2 * a : a < 0.32 ? 0.72 - 5.5 * (a - 0.2) : 0.02;
      thick = 0.06 + 0.06 * Bump(z, 0.2, 0.4) * (a > 0.3);
      break;
    case Hair::kLong:
      line = a < 0.2 ? 0.77 - 0.2 * a : a < 0.34 ? 0.73 - 6 * (a - 0.2) : -0.6;
      thick = 0.06;
      break;
  }
  const double over = (z - line) / 0.06;
  return over > 1 ? thick : -0.03 + (thick + 0.03) * std::clamp(over, 0.0, 1.0);
}

void AddNeck(const FigureContext& f, LoftMesh& mesh) {
  const Proportions& p = f.p;
  const double H = p.stature;
  const Vec3d low = f.joint(Joint::kNeck), top = f.joint(Joint::kHead);
  const double r = (p.female || p.adult < 0.7 ? 0.0275 : 0.0325) * H;
  const LoftRing neck[] = {
      {low + Vec3d{-0.004 * H, 0, -0.020 * H}, 1.25 * r, 1.1 * r, 1.2 * r, 2, MixBones(Bone(Joint::kSpine3), Bone(Joint::kNeck), 0.6), -1},
      {low + (top - low) * 0.45, r, r, 1.05 * r, 2, Bone(Joint::kNeck), -1},
      {top + Vec3d{0.004 * H, 0, 0.020 * H}, r, r, r, 2, Bone(Joint::kHead), -1}};
  mesh.Loft(neck, {.material = kSkinMaterial, .segments = f.Around(20), .steps = f.Steps(3), .cap_last = false});
}

/// Measures of the head: its height, the height of the chin, how narrow it is.
struct HeadSize {
  double h, chin, narrow;
};

// The head with brow, nose and lips pulled out of it.
void AddFace(const FigureContext& f, const HeadSize& size, LoftMesh& mesh) {
  const auto [h, chin, narrow] = size;
  std::vector<LoftRing> rings;
  for (const auto& row : kHead)
    rings.push_back(
        {{0, 0, chin + row[0] * h}, row[3] * h * narrow, row[1] * h, row[2] * h, 2.15, Bone(Joint::kHead), std::clamp(row[0], 0.0, 1.0)});
  LoftStyle style{.material = kFaceMaterial, .segments = f.Around(40), .steps = f.Steps(3), .cap_first = true};
  style.deform = [&f, h = h, chin = chin](LoftVertex& v) {
    if (v.p.x < 0.2 * h || f.level > 2) return;
    const double y = v.p.y / h, z = (v.p.z - chin) / h;
    const double bridge = z < 0.36 ? Bump(z, 0.36, 0.07) : std::max(0.0, 1 - (z - 0.36) / 0.22);
    v.p.x += h * (0.125 * bridge * Bump(y, 0, 0.035 + 0.05 * bridge) + 0.022 * Bump(z, 0.205, 0.05) * Bump(y, 0, 0.14) -
                  0.022 * Bump(z, 0.50, 0.07) * Bump(std::abs(y), 0.14, 0.10) + 0.02 * Bump(z, 0.03, 0.09) * Bump(y, 0, 0.13));
  };
  mesh.Loft(Thinned(rings, f.level), style);
  if (f.level < 2) {
    for (const double side : {1.0, -1.0})
      mesh.Ellipsoid({-0.01 * h, side * 0.335 * h * narrow, chin + 0.43 * h}, {0.075 * h, 0.022 * h, 0.13 * h}, Joint::kHead, kSkinMaterial,
                     f.Around(12));
  }
}

// Hair: the slices of the head, pushed out where hair grows and under the skin elsewhere. Long hair hangs down.
std::vector<LoftRing> HairRings(Hair hair, const HeadSize& size) {
  const auto [h, chin, narrow] = size;
  std::vector<LoftRing> cover;
  if (hair == Hair::kLong) {
    for (const auto& [z, back, half, front] :
         {std::tuple{-0.50, 0.36, 0.26, -0.20}, {-0.30, 0.38, 0.34, -0.12}, {-0.12, 0.36, 0.34, -0.06}}) {
      const Influences low_bone = MixBones(Bone(Joint::kHead), Bone(Joint::kSpine3), z < -0.4 ? 0.55 : z < -0.2 ? 0.35 : 0.15);
      cover.push_back({{0, 0, chin + z * h}, half * h, front * h, back * h, 2.3, low_bone, -1});
    }
  }
  for (const auto& row : kHead) {
    if (row[0] < 0.0) continue;
    const bool hangs = (hair == Hair::kLong || hair == Hair::kBob) && row[0] < 0.40;
    cover.push_back({{0, 0, chin + row[0] * h},
                     (hangs ? std::max(row[3], 0.31) : row[3]) * h * narrow,
                     (hangs ? 0.02 : row[1]) * h,
                     (hangs ? std::max(row[2], 0.33) : row[2]) * h,
                     2.15,
                     Bone(Joint::kHead),
                     -1});
  }
  return cover;
}

void AddHair(const FigureContext& f, const HeadSize& size, LoftMesh& mesh) {
  const double h = size.h, chin = size.chin;
  const Hair hair = f.wear.hair;
  LoftStyle strands{.material = kHairMaterial, .segments = f.Around(40), .steps = f.Steps(3), .cap_first = hair == Hair::kLong};
  strands.deform = [&](LoftVertex& v) {
    const double z = (v.p.z - chin) / h;
    const double rough = f.level < 2 ? 0.012 * std::sin(17 * v.theta + 9 * z) * std::sin(5 * v.theta) : 0;
    const double t = HairThickness(hair, v.theta, z, 0);
    const Vec3d middle{0.06 * h, 0, chin + (z > 0.55 ? 0.55 : z) * h};
    v.p += Normalized(v.p - middle) * (h * (t + (t > 0 && hair != Hair::kCap && hair != Hair::kCropped ? rough : 0)));
  };
  mesh.Loft(Thinned(HairRings(hair, size), f.level), strands);
  if (hair == Hair::kBun && f.level < 3)
    mesh.Ellipsoid({-0.42 * h, 0, chin + 0.72 * h}, {0.16 * h, 0.17 * h, 0.17 * h}, Joint::kHead, kHairMaterial, f.Around(16));
  if (hair == Hair::kCap && f.level < 3) {
    const Influences bone = Bone(Joint::kHead);
    const LoftRing peak[] = {{{0.36 * h, 0, chin + 0.715 * h}, 0.30 * h, 0.02 * h, 0.02 * h, 2.6, bone, -1},
                             {{0.60 * h, 0, chin + 0.70 * h}, 0.25 * h, 0.015 * h, 0.015 * h, 2.6, bone, -1},
                             {{0.76 * h, 0, chin + 0.67 * h}, 0.14 * h, 0.01 * h, 0.01 * h, 2.6, bone, -1}};
    mesh.Loft(peak, {.material = kHairMaterial, .segments = f.Around(18), .steps = 2, .u = {0, 1, 0}, .v = {0, 0, 1}});
  }
}

}  // namespace

void AddHead(const FigureContext& f, LoftMesh& mesh) {
  const double h = f.p.head * f.p.stature;
  const HeadSize size{h, f.p.stature - h, f.p.female ? 0.96 : 1};
  AddNeck(f, mesh);
  AddFace(f, size, mesh);
  AddHair(f, size, mesh);
}

}  // namespace airsim360::internal

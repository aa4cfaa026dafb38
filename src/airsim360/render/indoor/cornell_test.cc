// The light of rooms against radiosity: patches that see each other by Lambert's polygon formula, solved in double precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "airsim360/math/angles.h"
#include "airsim360/render/indoor/test_rooms.h"

namespace airsim360 {
namespace {

using internal::Surfel;
using test::RoomScene, test::SolvedRoom;
constexpr int kFaces = 6, kSide = 16, kPatches = kSide * kSide;

// The Cornell box without its blocks and with its front closed, in tenths of its size: 5.528 wide, 5.592 deep, 5.488 high, with the
// lamp of 1.30 by 1.05 under the ceiling (www.graphics.cornell.edu/online/box/data.html), white at the front, too.
constexpr Vec3f kSize{5.528f, 5.592f, 5.488f};
constexpr float kLampX[2] = {2.13f, 3.43f}, kLampY[2] = {2.27f, 3.32f}, kLampZ = kSize.z - 0.004f;
constexpr Vec3f kWhite{0.73f, 0.71f, 0.68f}, kRed{0.63f, 0.065f, 0.05f}, kGreen{0.14f, 0.45f, 0.091f}, kGlow{18, 12, 5};
const Vec3f kPaint[kFaces] = {kRed, kGreen, kWhite, kWhite, kWhite, kWhite};  // -x +x -y +y -z +z

struct Patch {
  Vec3d corner[4], middle, normal;
  int face = 0;
  bool lamp = false;
  double area() const { return Norm(Cross(corner[1] - corner[0], corner[3] - corner[0])); }
};

Patch MakePatch(int face, double a0, double a1, double b0, double b1, double height) {
  const int axis = face / 2;
  Patch patch;
  patch.face = face;
  patch.normal[axis] = face % 2 ? -1 : 1;
  const double a[4] = {a0, a1, a1, a0}, b[4] = {b0, b0, b1, b1};
  for (int k = 0; k < 4; ++k) {
    patch.corner[k][axis] = height, patch.corner[k][(axis + 1) % 3] = a[k], patch.corner[k][(axis + 2) % 3] = b[k];
    patch.middle += patch.corner[k] * 0.25;
  }
  return patch;
}

std::vector<Patch> Patches() {
  std::vector<Patch> patches;
  for (int face = 0; face < kFaces; ++face) {
    const int axis = face / 2;
    const double a = static_cast<double>(kSize[(axis + 1) % 3]) / kSide, b = static_cast<double>(kSize[(axis + 2) % 3]) / kSide;
    for (int k = 0; k < kPatches; ++k) {
      const int i = k % kSide, j = k / kSide;
      patches.push_back(MakePatch(face, i * a, (i + 1) * a, j * b, (j + 1) * b, face % 2 ? static_cast<double>(kSize[axis]) : 0));
    }
  }
  patches.push_back(MakePatch(5, static_cast<double>(kLampX[0]), static_cast<double>(kLampX[1]), static_cast<double>(kLampY[0]),
                              static_cast<double>(kLampY[1]), static_cast<double>(kLampZ)));
  patches.back().lamp = true;
  return patches;
}

// Share of the light of a small face at p that goes to a polygon, all of which lies before both (Lambert 1760).
double FormFactor(Vec3d p, Vec3d n, const Patch& to) {
  Vec3d sum;
  for (int k = 0; k < 4; ++k) {
    const Vec3d a = Normalized(to.corner[k] - p), b = Normalized(to.corner[(k + 1) % 4] - p), c = Cross(a, b);
    const double s = Norm(c);
    if (s > 1e-12) sum += c * (std::atan2(s, Dot(a, b)) / s);
  }
  return std::fabs(Dot(sum, n)) / (2 * kPi);
}

// Mean irradiance of each face in one colour.
std::array<double, kFaces> Radiosity(const std::vector<Patch>& patches, const std::array<double, kFaces>& albedo, double of_lamp,
                                     double glow) {
  const size_t count = patches.size();
  const auto faces_lamp = [](const Patch& p) { return p.face == 5 && !p.lamp; };
  std::vector<double> share(count * count);
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < count; ++j) {
      if (patches[i].face == patches[j].face) continue;
      share[i * count + j] = FormFactor(patches[i].middle, patches[i].normal, patches[j]);
    }
  // What of the ceiling the lamp hides.
  const size_t lamp = count - 1;
  std::vector<double> open(count, 1);
  for (size_t j = 0; j < count; ++j) {
    if (!faces_lamp(patches[j])) continue;
    double covered = 0;
    for (int k = 0; k < 64; ++k) {
      const Vec3d p = patches[j].corner[0] + (patches[j].corner[1] - patches[j].corner[0]) * ((k % 8 + 0.5) / 8) +
                      (patches[j].corner[3] - patches[j].corner[0]) * ((k / 8 + 0.5) / 8);
      covered += p.x > static_cast<double>(kLampX[0]) && p.x < static_cast<double>(kLampX[1]) && p.y > static_cast<double>(kLampY[0]) &&
                 p.y < static_cast<double>(kLampY[1]);
    }
    open[j] = 1 - covered / 64;
  }
  std::vector<double> sent(count), got(count);
  for (int step = 0; step < 60; ++step) {
    for (size_t i = 0; i < count; ++i)
      sent[i] = got[i] * (i == lamp ? of_lamp : albedo[static_cast<size_t>(patches[i].face)]) + (i == lamp ? kPi * glow : 0);
    for (size_t i = 0; i < count; ++i) {
      got[i] = 0;
      for (size_t j = 0; j < count; ++j) got[i] += share[i * count + j] * open[j] * sent[j];
    }
  }
  std::array<double, kFaces> mean{}, area{};
  for (size_t i = 0; i < lamp; ++i) {
    const double a = patches[i].area() * open[i];
    mean[static_cast<size_t>(patches[i].face)] += got[i] * a, area[static_cast<size_t>(patches[i].face)] += a;
  }
  for (size_t f = 0; f < kFaces; ++f) mean[f] /= area[f];
  return mean;
}

TEST(LightSolver, CornellBoxHasTheLightOfItsRadiosity) {
  RoomScene room("cornell");
  const Vec3f corner[2] = {{0, 0, 0}, kSize};
  MaterialId paint[kFaces];
  for (int f = 0; f < kFaces; ++f) {
    paint[f] = room.Paint(kPaint[f]);
    room.Box(corner[0], corner[1], paint[f], true, 63u & ~(1u << f));
  }
  room.Quad({kLampX[0], kLampY[0], kLampZ}, {kLampX[0], kLampY[1], kLampZ}, {kLampX[1], kLampY[1], kLampZ}, {kLampX[1], kLampY[0], kLampZ},
            room.Paint({0.78f, 0.78f, 0.78f}, kGlow));
  const SolvedRoom solved(room.Build(), {.cell = 0.28f, .lamp_rays = 64, .fine = false});
  const auto& surfels = solved.solver.coarse().surfels();
  std::array<Vec3d, kFaces> mean{};
  std::array<double, kFaces> area{};
  for (size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    if (Dot(s.n, kSize * 0.5f - s.p) <= 0 || s.albedo.x > 0.74f) continue;  // outer sides; the lamp
    const int axis = std::fabs(s.n.x) > 0.5f ? 0 : std::fabs(s.n.y) > 0.5f ? 1 : 2;
    const auto f = static_cast<size_t>(2 * axis + (s.n[axis] < 0));
    mean[f] += VecCast<double>(solved.solver.coarse_light().light[i]) * static_cast<double>(s.area), area[f] += static_cast<double>(s.area);
  }
  const internal::Reflectance reflectance(solved.tables);
  const std::vector<Patch> patches = Patches();
  for (int c = 0; c < 3; ++c) {
    std::array<double, kFaces> albedo{};
    for (size_t f = 0; f < kFaces; ++f) albedo[f] = static_cast<double>(reflectance.Of(paint[f], kPaint[f])[c]);
    const auto expected =
        Radiosity(patches, albedo, static_cast<double>(reflectance.Of(paint[0], {0.78f, 0.78f, 0.78f})[c]), static_cast<double>(kGlow[c]));
    for (size_t f = 0; f < kFaces; ++f)
      EXPECT_NEAR(mean[f][c] / area[f], expected[f], 0.01 * expected[f]) << "face " << f << ", colour " << c;
  }
}

}  // namespace
}  // namespace airsim360

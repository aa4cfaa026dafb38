// Fountains.
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

Material Water() {
  Material m;
  m.name = "water";
  m.kind = SurfaceKind::kWater;
  m.base_color = {0.085f, 0.095f, 0.082f};  // shallow, over stone with algae
  m.roughness = 0.05f;
  return m;
}

// A drop: an octahedron stretched along the vertical.
void AddDrop(MeshBuilder& mesh, Vec3f c, float r) {
  const Vec3f up = c + Vec3f{0, 0, 1.5f * r}, down = c - Vec3f{0, 0, 1.5f * r};
  const Vec3f ring[4] = {c + Vec3f{r, 0, 0}, c + Vec3f{0, r, 0}, c - Vec3f{r, 0, 0}, c - Vec3f{0, r, 0}};
  for (int k = 0; k < 4; ++k) {
    mesh.Triangle(ring[k], ring[(k + 1) % 4], up);
    mesh.Triangle(ring[(k + 1) % 4], ring[k], down);
  }
}

// Water along a parabola in the vertical plane of `azimuth`: a thread that breaks up into drops. `from` and
// `speed` have their horizontal part in x; the flight lasts one unit of time.
void AddJet(PropBuilder& b, float azimuth, Vec3f from, Vec3f speed, float gravity, RngStream& random) {
  b.Place(Turn(0, 0, azimuth * 360 / kTauF));
  const auto at = [&](float t) { return from + speed * t - Vec3f{0, 0, gravity * t * t}; };
  std::vector<Vec3f> thread;
  std::vector<float> radii;
  for (int k = 0; k <= 6; ++k) {
    const float t = 0.42f * static_cast<float>(k) / 6;
    thread.push_back(at(t));
    radii.push_back(0.008f - 0.0009f * static_cast<float>(k));
  }
  b.Bar(thread, radii, 5);
  for (int k = 0; k < 70; ++k) {
    const float t = 0.30f + 0.70f * (static_cast<float>(k) + static_cast<float>(random.Uniform())) / 70, spread = 0.03f * t * t;
    const Vec3f stray{spread * static_cast<float>(random.Normal()), spread * static_cast<float>(random.Normal()),
                      spread * static_cast<float>(random.Normal())};
    AddDrop(b.mesh(), at(t) + stray, static_cast<float>(random.Uniform(0.004, 0.011)));
  }
  b.Place({});
}

// Round stone basin, a bowl on a baluster, two water surfaces, arching jets that thin out.
Model MakeFountain(uint32_t, uint64_t seed) {
  PropBuilder b("fountain");
  b.Use(Stone({0.46f, 0.43f, 0.38f}, 0.8f), ConcreteTexture());
  const Vec2f basin[] = {{2.75f, -0.1f}, {2.75f, 0.10f}, {2.62f, 0.13f}, {2.55f, 0.18f}, {2.55f, 0.40f}, {2.62f, 0.44f}, {2.68f, 0.47f},
                         {2.68f, 0.53f}, {2.64f, 0.56f}, {2.30f, 0.56f}, {2.26f, 0.53f}, {2.26f, 0.12f}, {0.55f, 0.10f}};
  b.Lathe(basin, 72);
  const Vec2f column[] = {{0.55f, 0.10f}, {0.55f, 0.55f}, {0.48f, 0.60f}, {0.26f, 0.66f}, {0.20f, 0.80f}, {0.26f, 0.98f},
                          {0.30f, 1.08f}, {0.22f, 1.18f}, {0.20f, 1.24f}, {0.45f, 1.30f}, {0.85f, 1.42f}, {1.02f, 1.55f},
                          {1.05f, 1.58f}, {1.04f, 1.60f}, {0.98f, 1.60f}, {0.92f, 1.54f}, {0.20f, 1.44f}};
  b.Lathe(column, 48);
  const Vec2f upper[] = {{0.20f, 1.44f}, {0.14f, 1.60f}, {0.10f, 1.80f}, {0.13f, 1.92f}, {0.24f, 1.98f}, {0.40f, 2.06f},
                         {0.42f, 2.10f}, {0.38f, 2.10f}, {0.06f, 2.04f}, {0.05f, 2.18f}, {0, 2.20f}};
  b.Lathe(upper, 32);
  b.Use(Water());
  const auto disc = [&](float inner, float outer, float z) {
    const Vec2f profile[] = {{outer, z}, {inner, z}};
    b.Lathe(profile, 64);
  };
  disc(0.50f, 2.27f, 0.44f);
  disc(0.12f, 0.955f, 1.565f);
  // Jets: from the rim of the bowl outwards, and a plume on top.
  Material spray = Plastic({0.72f, 0.75f, 0.76f}, 0.15f);
  spray.name = "spray";
  b.Use(spray);
  RngStream random(seed, "fountain");
  for (int i = 0; i < 12; ++i) AddJet(b, kTauF * static_cast<float>(i) / 12, {1.0f, 0, 1.57f}, {0.85f, 0, 0.95f}, 2.09f, random);
  for (int i = 0; i < 10; ++i) AddJet(b, kTauF * static_cast<float>(i) / 10, {0.01f, 0, 2.19f}, {0.55f, 0, 1.7f}, 2.32f, random);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> FountainKinds() { return {{"fountain", "construction/fountain", 1, MakeFountain, 2.9f, 2.2f, 2.7f, 20000}}; }

}  // namespace airsim360::internal

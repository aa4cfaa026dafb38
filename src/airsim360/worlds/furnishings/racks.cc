// Cartons, pallets and pallet racks. EN 13698-1 pallets 120 x 80 cm, 14.4 high; racks after FEM 10.2.02 for bays of three
// pallets: 2.7 m clear between uprights, 1.1 m deep.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/small_parts.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

constexpr float kPalletHeight = 0.144f;

// Pallet of 1.2 m along X by 0.8 m: five top boards, three stringer boards, nine blocks, three bottom boards.
void Pallet(PropBuilder& b, const AffineTransform& X) {
  b.Place(X);
  UseRoughBoards(b, Grain::kAlongX);
  constexpr std::array<float, 5> y = {-0.40f, -0.2075f, -0.0725f, 0.1075f, 0.255f}, wide = {0.145f, 0.10f, 0.145f, 0.10f, 0.145f};
  for (size_t i = 0; i < y.size(); ++i) b.mesh().Box({-0.6f, y[i], 0.122f}, {0.6f, y[i] + wide[i], kPalletHeight});
  for (const auto& [y0, y1] : {std::pair{-0.40f, -0.30f}, std::pair{-0.0725f, 0.0725f}, std::pair{0.30f, 0.40f}})
    b.mesh().Box({-0.6f, y0, 0}, {0.6f, y1, 0.022f});
  UseRoughBoards(b);
  for (float x : {-0.6f, -0.0725f, 0.455f}) {
    b.mesh().Box({x, -0.4f, 0.1f}, {x + 0.145f, 0.4f, 0.122f});
    for (const auto& [y0, y1] : {std::pair{-0.40f, -0.30f}, std::pair{-0.0725f, 0.0725f}, std::pair{0.30f, 0.40f}})
      b.mesh().Box({x, y0, 0.022f}, {x + 0.145f, y1, 0.1f}, MeshBuilder::kAllSides & ~(MeshBuilder::kTop | MeshBuilder::kBottom));
  }
  b.Place({});
}

Material Film() {
  Material m = ClearGlass({0.90f, 0.93f, 0.95f});
  m.name = "stretch film";
  m.transmission = 0.8f;
  m.roughness = 0.2f;
  return m;
}

// Goods on a pallet's footprint: layers of cartons, shrink-wrapped or not, sacks, or drums.
enum class Goods { kCartonsBegun, kCartons, kWrapped, kSacks, kCrate };
void Load(PropBuilder& b, const AffineTransform& X, float height, Goods goods, uint64_t seed) {
  RngStream rng(seed, "load");
  if (goods <= Goods::kWrapped) {
    const int nx = 2 + static_cast<int>(rng.Index(2)), ny = 2, layers = std::max(1, static_cast<int>(height / Random(rng, 0.26f, 0.42f)));
    const float h = height / static_cast<float>(layers), wx = 1.2f / static_cast<float>(nx), wy = 0.8f / static_cast<float>(ny);
    for (int l = 0; l < layers; ++l)
      for (int i = 0; i < nx * ny; ++i) {
        if (l == layers - 1 && goods == Goods::kCartonsBegun && rng.Chance(0.3)) continue;  // a layer begun
        const Vec3f at{-0.6f + wx * (static_cast<float>(i % nx) + 0.5f), -0.4f + wy * (static_cast<float>(i / nx) + 0.5f),
                       h * static_cast<float>(l)};
        Carton(b, X * Turn(0, 0, Random(rng, -1.2f, 1.2f), at), {wx - 0.008f, wy - 0.008f, h - 0.002f}, rng.Bits());
      }
    if (goods == Goods::kWrapped) {
      b.Place(X);
      b.Use(Film());
      b.mesh().Box({-0.606f, -0.406f, -0.05f}, {0.606f, 0.406f, height + 0.004f},
                   MeshBuilder::kFront | MeshBuilder::kBack | MeshBuilder::kLeft | MeshBuilder::kRight);
      b.Place({});
    }
  } else if (goods == Goods::kSacks) {  // sacks, crosswise by turns
    const Vec3f tone = rng.Chance(0.5) ? Vec3f{0.62f, 0.58f, 0.48f} : Vec3f{0.55f, 0.57f, 0.58f};
    const int layers = std::max(1, static_cast<int>(height / 0.14f));
    for (int l = 0; l < layers; ++l)
      for (int i = 0; i < 4; ++i) {
        const float x = i % 2 ? 0.30f : -0.30f, y = i / 2 ? 0.20f : -0.20f, z = 0.14f * static_cast<float>(l);
        UseLinen(b, tone);
        b.Place(X * Turn(0, 0, Random(rng, -3, 3), {x, y, z}));
        SoftBox(b, {-0.29f, -0.19f, 0}, {0.29f, 0.19f, 0.15f},
                {.round = 0.06f, .crown = 0.012f, .fold = 0.010f, .seed = rng.Bits(), .cells = 5});
      }
    b.Place({});
  } else {  // one crate of boards
    b.Place(X);
    UseRoughBoards(b, Grain::kAlongX);
    const int boards = std::max(3, static_cast<int>(height / 0.13f));
    for (int i = 0; i < boards; ++i) {
      const float z0 = height * static_cast<float>(i) / static_cast<float>(boards), z1 = z0 + height / static_cast<float>(boards) - 0.012f;
      b.mesh().Box({-0.58f, -0.38f, z0}, {0.58f, 0.38f, z1});
    }
    b.mesh().Box({-0.57f, -0.37f, 0}, {0.57f, 0.37f, height - 0.01f});
    UseRoughBoards(b);
    for (float x : {-0.55f, 0.0f, 0.47f})
      for (float s : {-1.0f, 1.0f}) b.mesh().Box({x, s * 0.39f - 0.011f, 0}, {x + 0.09f, s * 0.39f + 0.011f, height});
    b.Place({});
  }
}

Model MakeBoxSmall(uint32_t variant, uint64_t seed) {
  PropBuilder b("box_small");
  const Vec3f sizes[4] = {{0.30f, 0.22f, 0.20f}, {0.38f, 0.28f, 0.16f}, {0.25f, 0.25f, 0.25f}, {0.33f, 0.24f, 0.28f}};
  Carton(b, {}, sizes[variant], seed);
  if (variant == 3) {  // flaps open
    UseCardboard(b, 0.9f);
    const Vec3f s = sizes[3] * 0.5f;
    const float z = sizes[3].z + 0.0015f;
    for (float side : {-1.0f, 1.0f}) {
      const Vec3f p[4] = {
          {-s.x, side * s.y, z}, {s.x, side * s.y, z}, {s.x, side * (s.y + 0.10f), z + 0.05f}, {-s.x, side * (s.y + 0.10f), z + 0.05f}};
      b.mesh().Quad(p[0], p[1], p[2], p[3]);
      b.mesh().Quad(p[3], p[2], p[1], p[0]);
    }
  }
  return b.Finish();
}

Model MakeBoxLarge(uint32_t variant, uint64_t seed) {
  PropBuilder b("box_large");
  const Vec3f sizes[4] = {{0.60f, 0.40f, 0.40f}, {0.80f, 0.60f, 0.55f}, {0.60f, 0.60f, 0.60f}, {0.55f, 0.40f, 0.35f}};
  if (variant == 3) {  // two, one on the other
    Carton(b, Turn(0, 0, 4), sizes[3], seed);
    Carton(b, Turn(0, 0, -11, {0.02f, 0.01f, sizes[3].z + 0.0015f}), sizes[3] * 0.85f, seed + 1);
  } else {
    Carton(b, {}, sizes[variant], seed);
  }
  return b.Finish();
}

// One; three or eight in a pile.
Model MakePallet(uint32_t variant, uint64_t seed) {
  PropBuilder b("pallet");
  RngStream rng(seed, "pallets");
  const int count = std::array{1, 3, 8}[variant];
  for (int i = 0; i < count; ++i)
    Pallet(b,
           Turn(0, 0, i ? Random(rng, -2.0f, 2.0f) : 0, {i ? Random(rng, -0.015f, 0.015f) : 0, 0, kPalletHeight * static_cast<float>(i)}));
  return b.Finish();
}

Model MakePalletStack(uint32_t variant, uint64_t seed) {
  PropBuilder b("pallet_stack");
  Pallet(b, {});
  constexpr std::array<Goods, 4> goods = {Goods::kCartonsBegun, Goods::kWrapped, Goods::kSacks, Goods::kCartons};
  Load(b, Move({0, 0, kPalletHeight + 0.001f}), std::array{1.0f, 1.45f, 0.75f, 1.25f}[variant], goods[variant], seed);
  return b.Finish();
}

void Upright(PropBuilder& b, float x, float depth, float height) {
  UseCoatedSteel(b, {0.03f, 0.10f, 0.30f});
  for (float y : {-depth / 2, depth / 2 - 0.08f}) {
    b.mesh().Box({x - 0.05f, y, 0.008f}, {x + 0.05f, y + 0.08f, height});
    // Slots in rows are dark.
    b.mesh().Box({x - 0.075f, y - 0.02f, 0}, {x + 0.075f, y + 0.10f, 0.008f});
  }
  const int braces = static_cast<int>(height / 0.9f);
  for (int i = 0; i < braces; ++i) {
    const float z0 = 0.15f + (height - 0.3f) * static_cast<float>(i) / static_cast<float>(braces),
                z1 = 0.15f + (height - 0.3f) * static_cast<float>(i + 1) / static_cast<float>(braces);
    const float a = i % 2 ? depth / 2 - 0.04f : -depth / 2 + 0.04f;
    b.mesh().Beam({x, a, z0}, {x, -a, z1}, 0.035f);
  }
  b.Use(Plastic({0.01f, 0.01f, 0.012f}, 0.8f));
  for (float z = 0.3f; z < height - 0.1f; z += 0.30f)
    for (float dx : {-0.022f, 0.022f})
      b.mesh().Box({x + dx - 0.008f, -depth / 2 - 0.0008f, z}, {x + dx + 0.008f, -depth / 2 + 0.001f, z + 0.05f}, MeshBuilder::kFront);
}

// One bay with the upright on its left and right (their middles 2.8 m apart: neighbours share them): beams in pairs,
// pallets with loads two deep in a few places empty.
Model MakeRackBay(uint32_t variant, uint64_t seed) {
  PropBuilder b("rack_bay");
  RngStream rng(seed, "rack");
  const int levels = std::array{4, 5, 5, 4}[variant];
  const float half = 1.40f, depth = 1.10f, height = std::array{8.0f, 10.0f, 9.0f, 8.5f}[variant];
  for (float s : {-1.0f, 1.0f}) Upright(b, s * half, depth, height);
  const float pitch = (height - 0.3f) / static_cast<float>(levels);
  for (int l = 0; l <= levels - 1; ++l) {
    const float z = pitch * static_cast<float>(l);
    if (l > 0) {
      UseCoatedSteel(b, {0.62f, 0.20f, 0.02f});
      for (float y : {-depth / 2 + 0.01f, depth / 2 - 0.06f}) {
        b.mesh().Box({-half + 0.05f, y, z - 0.12f}, {half - 0.05f, y + 0.05f, z});
        for (float s : {-1.0f, 1.0f})
          b.mesh().Box({s * (half - 0.07f) - 0.022f, y - 0.012f, z - 0.17f}, {s * (half - 0.07f) + 0.022f, y + 0.06f, z + 0.03f});
      }
      b.Use(Stone({0.74f, 0.73f, 0.70f}, 0.9f));  // labels of the places
      for (int i = 0; i < 3; ++i)
        b.mesh().Box({-0.95f + 0.87f * static_cast<float>(i), -depth / 2 + 0.008f, z - 0.09f},
                     {-0.81f + 0.87f * static_cast<float>(i), -depth / 2 + 0.011f, z - 0.03f}, MeshBuilder::kFront);
    }
    for (int i = 0; i < 3; ++i) {
      if (rng.Chance(0.16)) continue;
      const float x = -0.89f + 0.89f * static_cast<float>(i) + Random(rng, -0.02f, 0.02f);
      const AffineTransform X = Turn(0, 0, 90 + Random(rng, -1.5f, 1.5f), {x, Random(rng, -0.03f, 0.03f), z});
      Pallet(b, X);
      constexpr std::array<Goods, 10> often = {Goods::kCartonsBegun, Goods::kCartonsBegun, Goods::kCartons, Goods::kCartons,
                                               Goods::kCartons,      Goods::kWrapped,      Goods::kWrapped, Goods::kWrapped,
                                               Goods::kSacks,        Goods::kCrate};
      const Goods goods = often[rng.Index(10)];
      Load(b, X * Move({0, 0, kPalletHeight + 0.001f}), std::min(pitch - 0.50f, Random(rng, 0.5f, 1.35f)), goods, rng.Bits());
    }
  }
  return b.Finish();
}

}  // namespace

FurnishingRows RackRows() {
  return {{{"box_small", "furniture/box", 4, MakeBoxSmall, 0.25f, 0.14f, 0.36f, 100}},
          {{"box_large", "furniture/box", 4, MakeBoxLarge, 0.5f, 0.34f, 0.68f, 100}},
          {{"pallet", "furniture/pallet", 3, MakePallet, 0.75f, 0.14f, 1.2f, 2500}},
          {{"pallet_stack", "furniture/box", 4, MakePalletStack, 0.75f, 0.7f, 1.75f, 13000}},
          {{"rack_bay", "furniture/rack", 4, MakeRackBay, 1.6f, 7.9f, 10.1f, 40000}}};
}

}  // namespace airsim360::internal

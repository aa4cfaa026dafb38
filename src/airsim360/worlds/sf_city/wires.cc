// What hangs over the streets, and the rails of the cable cars.
#include <algorithm>
#include <cmath>
#include <optional>

#include "airsim360/base/random.h"
#include "airsim360/worlds/sf_city/city.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360::internal {
namespace {

constexpr float kWire = 0.013f;

// A wire that sags between two points of W.
void Hang(MeshBuilder& mesh, Vec3f a, Vec3f b, float sag, float radius = kWire) {
  constexpr int kParts = 8;
  Vec3f before = a;
  for (int i = 1; i <= kParts; ++i) {
    const float t = static_cast<float>(i) / kParts;
    const Vec3f at = a + (b - a) * t - Vec3f{0, 0, 4 * sag * t * (1 - t)};
    mesh.Tube(before, at, radius, radius, 4, false, false);
    before = at;
  }
}

// Wires of two poles: four on each of two cross-arms.
void HangBetweenPoles(MeshBuilder& mesh, const AffineTransform& a, const AffineTransform& b, float sag) {
  for (float z : {9.48f, 10.18f})
    for (float x : {-1.05f, -0.55f, 0.55f, 1.05f}) {
      const Vec3f p = a * Vec3f{x, -0.125f, z}, q = b * Vec3f{x, -0.125f, z};
      Hang(mesh, p, q, sag);
    }
  // A thick cable of telephones lower down.
  Hang(mesh, a * Vec3f{0.14f, 0, 7.0f}, b * Vec3f{0.14f, 0, 7.0f}, 1.3f * sag, 0.028f);
}

}  // namespace

void HangSfWires(District& d, const Hills& hills) {
  const SlopeLay lay(hills);
  MeshBuilder mesh;
  mesh.SetMaterial(d.surfaces[Surface::kIronBlack]);
  const CategoryId mast = d.builder.tree().At("construction/mast"), wire = d.builder.tree().At("furniture/utility/wire");
  // Along the southern pavements of the hills' streets.
  for (const Block& block : d.plan.blocks) {
    if (block.kind != BlockKind::kBuilt || QuarterOf(block) != Quarter::kHouses) continue;
    for (int k : {0, 3}) {
      const BlockSide side = SideOf(block, k);
      std::optional<AffineTransform> before;
      EntityId wires = kNoEntity;
      for (float s = 13; s < side.length - 10; s += (side.length - 26) / 3 - 0.01f) {
        std::optional<Vec2f> at;
        for (float shift : {0.0f, 1.2f, -1.2f, 2.4f}) {
          const Vec2f p = side.At(s + shift, 0.5f);
          if (at || !d.placer.Try("utility_pole", {p.x, p.y, 0}, FacingYaw(side.along))) continue;
          at = p;
        }
        if (!at) continue;
        const AffineTransform pole = lay("utility_pole", PlaceUpright({at->x, at->y, 0}, FacingYaw(side.along)));
        if (before) {
          if (wires == kNoEntity) wires = d.builder.AddEntity("overhead wires", wire);
          mesh.SetEntity(wires);
          HangBetweenPoles(mesh, *before, pole, 0.45f);
        }
        // A drop to the house across the pavement.
        if (wires != kNoEntity) {
          const Vec2f house = side.At(s + 4, block.pavement + kSetback - 0.1f);
          Hang(mesh, pole * Vec3f{0, -0.12f, 9.2f}, hills.drape().At({house.x, house.y, 7.2f}), 0.25f);
        }
        before = pole;
      }
    }
  }
  // Trolley wires over the cross avenue, on span wires between masts at both kerbs.
  const StreetLine& line = d.plan.east_west[4];
  const float x0 = d.plan.north_south[1].center + 8, x1 = d.plan.north_south[7].center - 8;
  mesh.SetEntity(d.builder.AddEntity("trolley wires", wire));
  constexpr float kPitch = 30.5f, kHeight = 6.1f;
  const auto point = [&](float x, float y, float z) { return hills.drape().At({x, y, z}); };
  for (float x = x0; x + kPitch <= x1; x += kPitch) {
    for (float y : {-5.75f, -5.15f, 5.15f, 5.75f}) Hang(mesh, point(x, y, kHeight), point(x + kPitch, y, kHeight), 0.05f);
  }
  for (float x = x0; x <= x1; x += kPitch) {
    const float kerb = line.half_width + 0.45f;
    Hang(mesh, point(x, -kerb, 6.9f), point(x, kerb, 6.9f), 0.75f, 0.009f);
    for (float side : {-1.0f, 1.0f}) {
      mesh.SetEntity(d.builder.AddEntity("trolley mast", mast));
      mesh.Tube(point(x, side * kerb, -0.2f), point(x, side * kerb, 7.2f), 0.11f, 0.075f, 10, false, true);
      d.placer.Reserve({{x, side * kerb}, {0.25f, 0.25f}, 0});
    }
    mesh.SetEntity(d.builder.AddEntity("span wire", wire));
  }
  d.builder.AddInstance({d.builder.AddMesh(mesh.Finish("overhead wires")), {}, kNoEntity});
}

void LayCableCarLine(District& d, const Hills&) {
  const StreetLine& line = d.plan.north_south[2];
  const float from = d.plan.east_west[1].center + 14, to = d.plan.east_west[7].center - 14;
  // Height of the road at (offset from the centre line, y), over crossings that of their fans.
  std::vector<std::pair<float, Fan>> fans;
  for (const StreetLine& crossing : d.plan.east_west) fans.emplace_back(crossing.half_width + 6.0f, FanOf(line, crossing));
  const auto height = [&](float offset, float y) {
    for (const auto& [half, fan] : fans)
      if (std::abs(y - fan.middle.y) < half) return fan.Height({line.center + offset, y});
    return CarriagewayHeight(line, offset);
  };
  for (float track : {-1.65f, 1.65f}) {
    d.ground.Begin("cable car track", "ground/rail", Surface::kAsphaltPale);
    const auto strip = [&](float a, float b, float lift) {
      for (float y = from; y < to; y += 1) {
        const auto at = [&](float offset, float v) { return Vec3f{line.center + offset, v, height(offset, v) + lift}; };
        d.ground.Quad(at(track + a, y), at(track + b, y), at(track + b, y + 1), at(track + a, y + 1));
      }
    };
    strip(-0.75f, 0, 0.010f);
    strip(0, 0.75f, 0.010f);
    d.ground.Use(Surface::kIron);
    for (float rail : {-0.533f, 0.533f}) strip(rail - 0.035f, rail + 0.035f, 0.015f);
    strip(-0.025f, 0.025f, 0.016f);
  }
  RngStream rng(d.seed, "cable cars");
  for (int i = 0; i < 4; ++i) {
    const float y = from + (to - from) * (0.12f + 0.25f * static_cast<float>(i)), side = i % 2 ? 1.0f : -1.0f;
    const float track = side * 1.65f;
    d.placer.Reserve({{line.center + track, y}, {1.3f, 4.4f}, 0});
    d.placer.shelf().Place("cable_car", {line.center + track, y, height(track, y) + 0.016f}, FacingYaw({0, side}),
                           static_cast<uint32_t>(i));
  }
}

}  // namespace airsim360::internal

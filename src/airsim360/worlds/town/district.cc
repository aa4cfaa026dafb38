#include "airsim360/worlds/town/district.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"

namespace airsim360::internal {

EntityId PlaceNamed(District& d, std::string name, std::string_view kind, Vec3f p, float yaw, uint32_t variant, float scale, Vec3f tint) {
  const EntityId entity = d.builder.AddEntity(std::move(name), d.builder.tree().At(FindPropKind(kind).category));
  d.placer.shelf().PlaceAs(entity, kind, PlaceUpright(p, yaw, scale), variant, tint);
  return entity;
}

float FacingYaw(Vec2f direction) { return std::atan2(direction.x, -direction.y); }

void PlaceRun(District& d, std::string_view kind, Vec2f a, Vec2f b, float z, std::string_view post) {
  const Vec2f v = b - a;
  const float length = std::hypot(v.x, v.y), yaw = std::atan2(v.y, v.x);
  const int panels = std::max(1, static_cast<int>(std::lround(length / 2)));
  const PropKind& row = FindPropKind(kind);
  const EntityId run = d.builder.AddEntity(std::string(kind) + " run", d.builder.tree().At(row.category));
  for (int i = 0; i < panels; ++i) {
    const Vec2f at = a + v * ((static_cast<float>(i) + 0.5f) / static_cast<float>(panels));
    AffineTransform X = PlaceUpright({at.x, at.y, z}, yaw);
    const float stretch = length / (2 * static_cast<float>(panels));
    for (auto& r : X.A.m) r[0] *= stretch;
    d.placer.shelf().PlaceAs(run, kind, X, d.placer.rng().Index(static_cast<uint32_t>(row.variants)));
  }
  d.placer.Reserve({(a + b) * 0.5f, {length / 2, 0.1f}, yaw});
  if (post.empty()) return;
  for (int i = 0; i <= panels; ++i) {
    const Vec2f at = a + v * (static_cast<float>(i) / static_cast<float>(panels));
    d.placer.Put(post, {at.x, at.y, z}, yaw, 1, {1, 1, 1}, 0u);
  }
}

void LayTreePit(Ground& ground, Vec2f at, float z) {
  const GroundRect outer{at.x - 0.8f, at.y - 0.8f, at.x + 0.8f, at.y + 0.8f}, inner = outer.Inset(0.12f);
  ground.Begin("tree pit", "ground/terrain/landscape", Surface::kKerb);
  // A frame two centimetres high, soil a little lower.
  const float top = z + 0.02f, soil = z + 0.012f;
  ground.Rect({outer.x0, outer.y0, outer.x1, inner.y0}, top);
  ground.Rect({outer.x0, inner.y1, outer.x1, outer.y1}, top);
  ground.Rect({outer.x0, inner.y0, inner.x0, inner.y1}, top);
  ground.Rect({inner.x1, inner.y0, outer.x1, inner.y1}, top);
  ground.mesh().Walls(outer.Outline(), z, top);
  ground.Use(Surface::kSoil);
  ground.Rect(inner, soil);
}

bool InPolygon(const std::vector<Vec2f>& outline, Vec2f p) {
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2f a = outline[i], b = outline[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

float EdgeDistance(const std::vector<Vec2f>& outline, Vec2f p) {
  float best = 1e9f;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], v = outline[(i + 1) % outline.size()] - a, w = p - a;
    const float t = std::clamp((w.x * v.x + w.y * v.y) / std::max(v.x * v.x + v.y * v.y, 1e-9f), 0.0f, 1.0f);
    best = std::min(best, std::hypot(w.x - v.x * t, w.y - v.y * t));
  }
  return best;
}

namespace {

// Tone of mown grass: wanders over some ten metres.
Vec3f LawnTone(Vec2f p, RngStream& rng) {
  const float wide = std::sin(0.31f * p.x + 1.7f * std::sin(0.17f * p.y)) + std::sin(0.23f * p.y + 1.3f * std::sin(0.29f * p.x));
  const float tone = 1.12f + 0.07f * wide + static_cast<float>(rng.Uniform(-0.03, 0.03)), dry = 1 + 0.05f * wide;
  return {0.95f * tone * dry, tone, tone * 0.9f};
}

}  // namespace

// Tiles where they fit, patches along the edges.
void LayMownGrass(PropShelf& shelf, EntityId lawn, const GroundRect& box, float z, RngStream& rng,
                  const std::function<float(Vec2f)>& inset) {
  constexpr float kPitch = kLawnTile / 2;
  for (float y = box.y0; y < box.y1; y += kLawnTile) {
    for (float x = box.x0; x < box.x1; x += kLawnTile) {
      const GroundRect cell{x, y, x + kLawnTile, y + kLawnTile};
      const std::vector<Vec2f> corners = cell.Outline();
      const bool whole =
          inset(cell.center()) > kLawnTile / 2 && std::all_of(corners.begin(), corners.end(), [&](Vec2f p) { return inset(p) > 0; });
      if (whole) {
        const Vec2f p = cell.center();
        const float quarter = 1.5707963f * static_cast<float>(rng.Index(4));
        shelf.PlaceAs(lawn, "lawn_tile", PlaceUpright({p.x, p.y, z}, quarter), rng.Index(4), LawnTone(p, rng));
        continue;
      }
      for (int k = 0; k < 4; ++k) {
        const Vec2f p{x + kPitch * (static_cast<float>(k % 2) + static_cast<float>(rng.Uniform())),
                      y + kPitch * (static_cast<float>(k / 2) + static_cast<float>(rng.Uniform()))};
        if (inset(p) < 0.3f) continue;
        const auto turn = static_cast<float>(rng.Uniform(0, 6.283));
        shelf.PlaceAs(lawn, "lawn_patch", PlaceUpright({p.x, p.y, z}, turn), rng.Index(3), LawnTone(p, rng));
      }
    }
  }
}

void GrowGrass(District& d, EntityId lawn, const std::vector<Vec2f>& outline, float z, float per_m2) {
  GroundRect box{1e9f, 1e9f, -1e9f, -1e9f};
  for (Vec2f p : outline) box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  RngStream rng(d.seed, "grass", lawn);
  if (per_m2 >= 2)
    LayMownGrass(d.placer.shelf(), lawn, box, z, rng,
                 [&](Vec2f p) { return (InPolygon(outline, p) ? 1.0f : -1.0f) * EdgeDistance(outline, p); });
  const auto tufts = static_cast<int>(box.area() * (per_m2 >= 2 ? 0.7f : per_m2));
  for (int i = 0; i < tufts; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(box.x0, box.x1)), static_cast<float>(rng.Uniform(box.y0, box.y1))};
    const auto yaw = static_cast<float>(rng.Uniform(0, 6.283)), scale = static_cast<float>(rng.Uniform(0.7, 1.35));
    const auto variant = static_cast<uint32_t>(rng.Index(16));
    const auto tone = static_cast<float>(rng.Uniform(0.8, 1.15));
    if (!InPolygon(outline, p) || EdgeDistance(outline, p) < 0.25f) continue;
    d.placer.shelf().PlaceAs(lawn, "grass_tuft", PlaceUpright({p.x, p.y, z}, yaw, scale), variant, {tone, tone, tone * 0.9f});
  }
}

void DropLeaves(District& d, EntityId ground, Vec2f at, float radius, int count, float z) {
  RngStream& rng = d.placer.rng();
  for (int i = 0; i < count; ++i) {
    const double a = rng.Uniform(0, 6.283), r = radius * std::sqrt(rng.Uniform());
    const Vec2f p{at.x + static_cast<float>(r * std::cos(a)), at.y + static_cast<float>(r * std::sin(a))};
    d.placer.shelf().PlaceAs(ground, "leaf_litter", PlaceUpright({p.x, p.y, z}, static_cast<float>(rng.Uniform(0, 6.283))), rng.Index(16));
  }
}

}  // namespace airsim360::internal

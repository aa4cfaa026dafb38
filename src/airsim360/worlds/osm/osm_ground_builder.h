// Lays pieces of ground so that every spot belongs to one entity.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/worlds/osm/osm_scene.h"

namespace airsim360::internal {

inline constexpr double kRoadDrop = 0.13, kWaterDrop = 0.28;  ///< metres below the ground

/// A piece of ground of one entity.
struct GroundPiece {
  Patches patches;
  EntityId entity = kNoEntity;
  std::string id;  // of the map, without what people call it
  Surface surface = Surface::kLawn;
  bool sunk = false;  // a carriageway or water: lies lower than its neighbours
};

class GroundBuilder {
 public:
  explicit GroundBuilder(OsmScene& scene) : scene_(scene) {
    const OsmBox e = GroundBox(scene.data);
    clip_ = {{{{e.x0, e.y0}, {e.x1, e.y0}, {e.x1, e.y1}, {e.x0, e.y1}}, {}}};
  }

  // Lays what of an area is still free, as a new entity. Returns kNoEntity where nothing is. `cell`: as of Cover.
  EntityId Lay(const std::string& name, std::string_view category, Surface surface, const Patches& area, double z,
               const GroundUv& uv = PlainUv, bool sunk = false, double cell = 100) {
    if (area.empty()) return kNoEntity;
    Patches free = Intersect(area, clip_);
    if (free.empty()) return kNoEntity;
    Bounds2d box;
    for (const Patch& patch : free)
      for (Vec2d p : patch.outer) box.Add(p);
    Patches taken;
    for (uint32_t i : index_.Find(box))
      for (const Patch& patch : pieces_[i].patches)
        if (BoundsOf(patch.outer).Overlaps(box)) taken.push_back(patch);
    if (!taken.empty()) free = Subtract(free, taken);
    if (free.empty()) return kNoEntity;
    const EntityId entity = scene_.builder.AddEntity(name, scene_.builder.tree().Add(category, false));
    mesh_.SetEntity(entity);
    mesh_.SetMaterial(scene_.surfaces[surface]);
    Cover(free, z, uv, cell);
    index_.Add(box, static_cast<uint32_t>(pieces_.size()));
    pieces_.push_back({std::move(free), entity, name.substr(0, name.find(' ')), surface, sunk});
    return entity;
  }
  const GroundPiece& last() const { return pieces_.back(); }
  const std::vector<GroundPiece>& pieces() const { return pieces_; }
  MeshBuilder& mesh() { return mesh_; }
  const Patches& clip() const { return clip_; }

  // Pieces of one surface around the focus.
  std::vector<std::pair<EntityId, Patches>> Near(Surface surface) const {
    std::vector<std::pair<EntityId, Patches>> found;
    for (const GroundPiece& piece : pieces_) {
      if (piece.surface != surface) continue;
      Patches near;
      for (const Patch& patch : piece.patches) {
        const Bounds2d box = BoundsOf(patch.outer);
        const Vec2d f = scene_.focus;
        if (box.Overlaps({{f.x - kLawnReach, f.y - kLawnReach}, {f.x + kLawnReach, f.y + kLawnReach}})) near.push_back(patch);
      }
      if (!near.empty()) found.emplace_back(piece.entity, std::move(near));
    }
    return found;
  }

  // The piece at p, null where none is.
  const GroundPiece* At(Vec2d p) const {
    for (uint32_t i : index_.Find(p))
      for (const Patch& patch : pieces_[i].patches)
        if (Inside(patch, p)) return &pieces_[i];
    return nullptr;
  }

  // Is there another sunken piece at p?
  bool Sunk(Vec2d p, size_t except) const {
    for (uint32_t i : index_.Find(p)) {
      if (i == except || !pieces_[i].sunk) continue;
      for (const Patch& patch : pieces_[i].patches)
        if (Inside(patch, p)) return true;
    }
    return false;
  }

  // The step up around piece `i`: its side, and a stone of `width` on top (0 = none).
  void Rim(size_t i, double low, double width) {
    const Patches patches = pieces_[i].patches;
    for (const Patch& patch : patches) {
      RimOf(patch.outer, i, low, width);
      for (const Ring& hole : patch.holes) RimOf(hole, i, low, width);
    }
  }

  void Finish(const std::string& name) {
    if (mesh_.empty()) return;
    scene_.builder.AddInstance({scene_.builder.AddMesh(mesh_.Finish(name)), {}, kNoEntity});
  }

  // Triangles at `z` over the ground; in squares of `cell` metres where the outline has many corners.
  void Cover(const Patches& patches, double z, const GroundUv& uv, double cell = 100) {
    for (const Patch& patch : patches) {
      size_t corners = patch.outer.size();
      for (const Ring& hole : patch.holes) corners += hole.size();
      const Bounds2d box = BoundsOf(patch.outer);
      const bool small = box.max.x - box.min.x < cell * 1.6 && box.max.y - box.min.y < cell * 1.6;
      if (small || corners < 400) {
        CoverOne(patch, z, uv);
        continue;
      }
      // Columns first, then the squares of each.
      const Patches whole{patch};
      for (double x = std::floor(box.min.x / cell) * cell; x < box.max.x; x += cell) {
        const Patches column =
            Intersect(whole, Patches{{{{x, box.min.y - 1}, {x + cell, box.min.y - 1}, {x + cell, box.max.y + 1}, {x, box.max.y + 1}}, {}}});
        for (double y = std::floor(box.min.y / cell) * cell; y < box.max.y; y += cell) {
          const Patches square{{{{x - 1, y}, {x + cell + 1, y}, {x + cell + 1, y + cell}, {x - 1, y + cell}}, {}}};
          for (const Patch& part : Intersect(column, square)) CoverOne(part, z, uv);
        }
      }
    }
  }

 private:
  void CoverOne(const Patch& patch, double z, const GroundUv& uv) {
    std::vector<Vec2d> points = patch.outer;
    for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
    const std::vector<uint32_t> t = Triangulate(patch);
    for (size_t i = 0; i + 2 < t.size(); i += 3) {
      scene_.Drape(mesh_, points[t[i]], points[t[i + 1]], points[t[i + 2]], z, uv);
    }
  }

  void RimOf(const Ring& ring, size_t self, double low, double width) {
    float u = 0;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2d a = ring[i], b = ring[(i + 1) % ring.size()], v = b - a;
      const double length = std::hypot(v.x, v.y);
      if (length < 1e-3) continue;
      const Vec2d out{v.y / length, -v.x / length}, middle = (a + b) * 0.5;
      const float next = u + static_cast<float>(length);
      const Patch& area = clip_[0];
      const bool edge = !Inside(area, middle + out * 0.05);
      if (!edge && !Sunk(middle + out * 0.03, self)) {
        const std::vector<Vec2d> points = scene_.relief.Split(a, b);
        for (size_t k = 0; k + 1 < points.size(); ++k) RimStep(points[k], points[k + 1], a, u, out, low, width);
      }
      u = next;
    }
  }

  // One straight piece of a rim whose side begins at `start`, where the texture has `u0`.
  void RimStep(Vec2d a, Vec2d b, Vec2d start, float u0, Vec2d out, double low, double width) {
    const float u = u0 + static_cast<float>(std::hypot(a.x - start.x, a.y - start.y)),
                next = u0 + static_cast<float>(std::hypot(b.x - start.x, b.y - start.y));
    mesh_.QuadUv(scene_.On(b, -low - 0.03), scene_.On(a, -low - 0.03), scene_.On(a, 0.004), scene_.On(b, 0.004),
                 {next, static_cast<float>(low)}, {u, static_cast<float>(low)}, {u, 0}, {next, 0});
    if (width <= 0) return;
    const Vec2d p = a + out * width, q = b + out * width;
    if (scene_.relief.flat()) {
      mesh_.QuadUv(scene_.On(p, 0.004), scene_.On(q, 0.004), scene_.On(b, 0.004), scene_.On(a, 0.004), {u, 0.15f}, {next, 0.15f}, {next, 0},
                   {u, 0});
      return;
    }
    const auto uv = [&](Vec2d at) {
      const Vec2d along{-out.y, out.x}, d = at - a;
      return Vec2f{u + static_cast<float>(d.x * along.x + d.y * along.y), static_cast<float>(d.x * out.x + d.y * out.y)};
    };
    scene_.Drape(mesh_, p, q, b, 0.004, uv);
    scene_.Drape(mesh_, p, b, a, 0.004, uv);
  }

  OsmScene& scene_;
  Patches clip_;
  MeshBuilder mesh_;
  std::vector<GroundPiece> pieces_;
  BoxIndex index_;
};

}  // namespace airsim360::internal

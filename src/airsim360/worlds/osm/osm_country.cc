// What lies around the extract of a map.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/data/line_index.h"
#include "airsim360/worlds/osm/osm_country.h"

namespace airsim360::internal {
namespace {

constexpr double kUnderlay = 0.6;

// How much of the ground's relief is left `d` metres outside the map: it fades to the plain.
double Fade(double d) { return std::clamp((3000 - d) / 2700, 0.0, 1.0); }

// A place `d` metres outside the extent, share s along the side.
Vec2d EdgePoint(const OsmBox& e, double d, int side, double s) {
  const auto corner = [&](int i) { return Vec2d{i == 0 || i == 3 ? e.x0 - d : e.x1 + d, i < 2 ? e.y0 - d : e.y1 + d}; };
  const Vec2d a = corner(side), b = corner((side + 1) % 4);
  return a + (b - a) * s;
}

// Where on the edge a place outside of it lies behind: the side, and the share of its length.
std::pair<int, double> BehindOf(const OsmBox& ground, Vec2d p) {
  const double out[4] = {ground.y0 - p.y, p.x - ground.x1, p.y - ground.y1, ground.x0 - p.x};
  const auto side = static_cast<int>(std::max_element(out, out + 4) - out);
  const double d = std::max(out[side], 0.0), w = ground.width() + 2 * d, h = ground.depth() + 2 * d;
  const double x = (p.x - ground.x0 + d) / w, y = (p.y - ground.y0 + d) / h;
  return {side, side == 0 ? x : side == 1 ? y : side == 2 ? 1 - x : 1 - y};
}

// The shares of each side's length that the sea has, in order and apart.
std::vector<std::pair<double, double>> SeaOn(const OsmScene& scene, const OsmBox& ground, int side) {
  std::vector<std::pair<double, double>> wet;
  const auto on = [&](Vec2d p) {
    return std::abs(side == 0 ? p.y - ground.y0 : side == 1 ? p.x - ground.x1 : side == 2 ? p.y - ground.y1 : p.x - ground.x0) < 0.003;
  };
  const auto share = [&](Vec2d p) {
    const double x = (p.x - ground.x0) / ground.width(), y = (p.y - ground.y0) / ground.depth();
    return std::clamp(side == 0 ? x : side == 1 ? y : side == 2 ? 1 - x : 1 - y, 0.0, 1.0);
  };
  for (const Patch& patch : scene.sea)
    for (size_t i = 0; i < patch.outer.size(); ++i) {
      const Vec2d a = patch.outer[i], b = patch.outer[(i + 1) % patch.outer.size()];
      if (!on(a) || !on(b)) continue;
      const double s = share(a), t = share(b);
      if (std::abs(s - t) * (ground.width() + ground.depth()) > 0.01) wet.emplace_back(std::min(s, t), std::max(s, t));
    }
  std::sort(wet.begin(), wet.end());
  std::vector<std::pair<double, double>> apart;
  for (const auto& piece : wet) {
    if (!apart.empty() && piece.first <= apart.back().second + 1e-9)
      apart.back().second = std::max(apart.back().second, piece.second);
    else
      apart.push_back(piece);
  }
  for (auto& piece : apart) {
    if (piece.first < 1e-6) piece.first = 0;
    if (piece.second > 1 - 1e-6) piece.second = 1;
  }
  return apart;
}

// Does a park, a wood, a field or water of a hectare and more reach the edge here?
bool OpenAt(const GroundBuilder& ground, Vec2d p) {
  const GroundPiece* piece = ground.At(p);
  const bool area = piece && (piece->id.starts_with("way/") || piece->id.starts_with("relation/"));
  if (!area || (piece->surface != Surface::kLawn && piece->surface != Surface::kForestFloor && piece->surface != Surface::kSoil &&
                piece->surface != Surface::kWater))
    return false;
  return Area(piece->patches) >= 1e4;
}

// Frames of quads around the map between two distances; the inner and outer border match in places and heights.
class CountryBuilder {
 public:
  CountryBuilder(OsmScene& scene, GroundBuilder& ground, const std::vector<EdgeStretch>& edge, EntityId sea)
      : scene_(scene),
        ground_(ground),
        mesh_(ground.mesh()),
        edge_(edge),
        sea_(sea),
        country_(scene.builder.AddEntity("country", scene.builder.tree().At("ground/terrain/landscape"))) {
    // The plain far away is at the height of the sea.
    std::vector<double> levels;
    if (!scene.relief.flat())
      for (const EdgeStretch& stretch : edge)
        for (int i = 0; i < 20 && stretch.beyond == Beyond::kSea; ++i)
          levels.push_back(
              scene.relief.At(EdgePoint(scene.data.extent, kClip, stretch.side, stretch.s0 + (stretch.s1 - stretch.s0) * (i + 0.5) / 20)));
    if (levels.empty()) return;
    std::nth_element(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2), levels.end());
    level_ = levels[levels.size() / 2];
  }

  void Frame(double inner, double outer, int parts, bool town) {
    const OsmBox& e = scene_.data.extent;
    for (const EdgeStretch& stretch : edge_) {
      std::vector<double> stops{stretch.s0};
      for (int n = 1; n < parts; ++n)
        if (const double s = static_cast<double>(n) / parts; s > stretch.s0 && s < stretch.s1) stops.push_back(s);
      stops.push_back(stretch.s1);
      Use(stretch.beyond, town);
      for (size_t n = 0; n + 1 < stops.size(); ++n) {
        const Vec2d a = EdgePoint(e, inner, stretch.side, stops[n]), b = EdgePoint(e, inner, stretch.side, stops[n + 1]);
        const Vec2d c = EdgePoint(e, outer, stretch.side, stops[n + 1]), d = EdgePoint(e, outer, stretch.side, stops[n]);
        const double lift = LiftOf(stretch.beyond);
        mesh_.QuadUv(At(d, outer, lift), At(c, outer, lift), At(b, inner, lift), At(a, inner, lift), PlainUv(d), PlainUv(c), PlainUv(b),
                     PlainUv(a));
      }
    }
    Cliffs(inner, outer);
  }

  // On the ground itself between two distances, as fine as it is.
  void Drape(double inner, double outer, bool town) {
    const OsmBox& e = scene_.data.extent;
    for (const EdgeStretch& stretch : edge_) {
      const auto at = [&](double d, double s) { return EdgePoint(e, d, stretch.side, s); };
      Use(stretch.beyond, town);
      ground_.Cover(Patches{{{at(inner, stretch.s0), at(outer, stretch.s0), at(outer, stretch.s1), at(inner, stretch.s1)}, {}}},
                    LiftOf(stretch.beyond), PlainUv);
    }
    for (double d = inner; d < outer; d += 10) Cliffs(d, std::min(d + 10, outer));
  }

  bool sea() const {
    return std::any_of(edge_.begin(), edge_.end(), [](const EdgeStretch& stretch) { return stretch.beyond == Beyond::kSea; });
  }
  void Use(Beyond beyond, bool town) {
    mesh_.SetEntity(beyond == Beyond::kSea ? sea_ : country_);
    mesh_.SetMaterial(scene_.surfaces[beyond == Beyond::kSea            ? Surface::kWater
                                      : town && beyond == Beyond::kTown ? Surface::kFarRoof
                                                                        : Surface::kPlain]);
  }

 private:
  static double LiftOf(Beyond beyond) { return beyond == Beyond::kSea ? -kWaterDrop : -0.02; }
  Vec3f At(Vec2d p, double d, double lift) const {
    if (scene_.relief.flat()) return scene_.On(p, lift);
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(level_ + (scene_.relief.At(p) - level_) * Fade(d) + lift)};
  }

  // The sides of the country where the sea begins.
  void Cliffs(double inner, double outer) {
    const OsmBox& e = scene_.data.extent;
    for (size_t i = 0; i < edge_.size(); ++i) {
      const EdgeStretch &one = edge_[i], &next = edge_[(i + 1) % edge_.size()];
      if ((one.beyond == Beyond::kSea) == (next.beyond == Beyond::kSea)) continue;
      const Vec2d a = EdgePoint(e, inner, one.side, one.s1), b = EdgePoint(e, outer, one.side, one.s1);
      mesh_.SetEntity(country_);
      mesh_.SetMaterial(scene_.surfaces[Surface::kSoil]);
      mesh_.Quad(At(a, inner, -kWaterDrop - 0.03), At(b, outer, -kWaterDrop - 0.03), At(b, outer, -0.02), At(a, inner, -0.02));
    }
  }

  OsmScene& scene_;
  GroundBuilder& ground_;
  MeshBuilder& mesh_;
  const std::vector<EdgeStretch>& edge_;
  EntityId sea_, country_;
  double level_ = 0;
};

}  // namespace

std::vector<EdgeStretch> EdgeOf(const OsmScene& scene, const GroundBuilder& ground, bool town) {
  constexpr double kStep = 25, kInside = 34;  // metres: between samples, of samples from the edge
  const OsmBox box = GroundBox(scene.data);
  std::vector<EdgeStretch> edge;
  const auto add = [&](int side, double s0, double s1, Beyond beyond) {
    if (s1 <= s0) return;
    if (!edge.empty() && edge.back().side == side && edge.back().beyond == beyond)
      edge.back().s1 = s1;
    else
      edge.push_back({side, s0, s1, beyond});
  };
  for (int side = 0; side < 4; ++side) {
    const double length = side % 2 ? box.depth() : box.width();
    const auto land = [&](double s0, double s1) {
      if (!town || s1 <= s0) return add(side, s0, s1, Beyond::kTown);
      const int steps = std::max(1, static_cast<int>((s1 - s0) * length / kStep));
      for (int n = 0; n < steps; ++n) {
        const auto at = [&](double part) { return n + part == 0 ? s0 : n + part >= steps ? s1 : s0 + (s1 - s0) * (n + part) / steps; };
        const bool open = OpenAt(ground, EdgePoint(scene.data.extent, kClip - kInside, side, at(0.5)));
        add(side, at(0), at(1), open ? Beyond::kOpen : Beyond::kTown);
      }
    };
    double from = 0;
    for (const auto& wet : SeaOn(scene, box, side)) {
      land(from, wet.first);
      add(side, wet.first, wet.second, Beyond::kSea);
      from = wet.second;
    }
    land(from, 1);
  }
  return edge;
}

Beyond BeyondAt(const std::vector<EdgeStretch>& edge, const OsmBox& ground, Vec2d p) {
  const auto [side, s] = BehindOf(ground, p);
  for (const EdgeStretch& stretch : edge)
    if (stretch.side == side && s >= stretch.s0 && s <= stretch.s1) return stretch.beyond;
  return Beyond::kTown;
}

void LayCountry(OsmScene& scene, GroundBuilder& ground, const std::vector<EdgeStretch>& edge, bool town, EntityId sea) {
  const OsmBox& e = scene.data.extent;
  CountryBuilder country(scene, ground, edge, sea);
  double inner = kClip;
  if (scene.relief.flat()) {
    for (double outer : {90.0, 300.0, 900.0, 2500.0, 7000.0, 16000.0}) {
      country.Frame(inner, outer, 1, town && outer < 1000);
      inner = outer;
    }
  } else {
    // On the ground itself to 90 m, then in frames that widen, as fine along as across.
    const auto box = [&](double d) { return Ring{{e.x0 - d, e.y0 - d}, {e.x1 + d, e.y0 - d}, {e.x1 + d, e.y1 + d}, {e.x0 - d, e.y1 + d}}; };
    inner = 84;
    if (country.sea()) {
      country.Drape(kClip, inner, town);
    } else {
      country.Use(Beyond::kTown, town);
      ground.Cover(Subtract(Patches{{box(90), {}}}, Patches{{box(kClip), {}}}), -0.02, PlainUv);
    }
    const double side = std::max(e.width(), e.depth()) + 180;
    for (double outer = 110; inner < 16000; outer = std::min(outer * 1.25, 16000.0)) {
      country.Frame(inner, outer, std::clamp(static_cast<int>(side / 25), 1, 400), town && outer < 1000);
      inner = outer;
    }
  }
  ground.mesh().SetEntity(scene.builder.AddEntity("subsoil", scene.builder.tree().At("ground/dirt")));
  ground.mesh().SetMaterial(scene.surfaces[Surface::kSoil]);
  ground.Cover(ground.clip(), -kUnderlay, PlainUv);
}

namespace {

// Does the town go on under all of a block?
bool TownUnder(const std::vector<EdgeStretch>& edge, const OsmBox& ground, Vec2d low, Vec2d high) {
  for (double x : {low.x, (low.x + high.x) / 2, high.x})
    for (double y : {low.y, (low.y + high.y) / 2, high.y})
      if (!ground.Contains({x, y}) && BeyondAt(edge, ground, {x, y}) != Beyond::kTown) return false;
  return true;
}

}  // namespace

void RaiseBackdrop(OsmScene& scene, MeshBuilder& mesh, const std::vector<OsmBuilding>& buildings, const std::vector<EdgeStretch>& edge) {
  std::vector<double> heights;
  for (const OsmBuilding& building : buildings)
    if (!building.orphan && building.height > 3) heights.push_back(building.height);
  if (heights.size() < 20) return;
  std::sort(heights.begin(), heights.end());
  const OsmBox& e = scene.data.extent;
  SemanticTree& tree = scene.builder.tree();
  const CategoryId category = tree.At("construction/building/backdrop");
  // Mapped houses that stand outside the extract keep their ground.
  LineIndex mapped;
  for (const OsmBuilding& building : buildings)
    for (const Patch& patch : building.outline) mapped.AddRing(patch.outer, 0);
  constexpr double kReach = 1300, kPitchX = 78, kPitchY = 52, kStreet = 14;
  static constexpr Surface kWalls[] = {Surface::kFarWalls0, Surface::kFarWalls1, Surface::kFarWalls0, Surface::kFarWalls2};
  RngStream rng(scene.options.seed, "backdrop");
  for (double y = e.y0 - kReach; y < e.y1 + kReach; y += kPitchY) {
    for (double x = e.x0 - kReach; x < e.x1 + kReach; x += kPitchX) {
      const double out = std::max({e.x0 - kClip - x - kPitchX, x - e.x1 - kClip, e.y0 - kClip - y - kPitchY, y - e.y1 - kClip});
      const bool keep = rng.Chance(1.05 - out / kReach);
      if (out < 4 || out > kReach || !keep || !TownUnder(edge, GroundBox(scene.data), {x, y}, {x + kPitchX, y + kPitchY})) continue;
      EntityId entity = kNoEntity;
      for (int i = 0; i < 4; ++i) {
        // Houses wall to wall along the block, each with its height.
        const double w = (kPitchX - kStreet) / 4, x0 = x + w * i, depth = kPitchY - kStreet - rng.Uniform(0, 12);
        const double h = heights[rng.Index(static_cast<uint32_t>(heights.size() * 97 / 100) + 1)];
        const Surface wall = kWalls[rng.Index(4)];
        if (mapped.Find({x0 + w / 2, y + depth / 2}, 30).owner != UINT32_MAX) continue;
        if (entity == kNoEntity) entity = scene.builder.AddEntity("backdrop block", category);
        const double z = scene.relief.At({x0, y}) * Fade(out + kClip);
        const std::vector<Vec2f> outline{ToFloat({x0, y}), ToFloat({x0 + w, y}), ToFloat({x0 + w, y + depth}), ToFloat({x0, y + depth})};
        mesh.SetTransform({});
        mesh.SetEntity(entity);
        mesh.SetMaterial(scene.surfaces[wall]);
        mesh.Walls(outline, static_cast<float>(z - 4), static_cast<float>(z + h));
        mesh.SetMaterial(scene.surfaces[Surface::kFarRoof]);
        mesh.Polygon(outline, static_cast<float>(z + h));
      }
    }
  }
}

}  // namespace airsim360::internal

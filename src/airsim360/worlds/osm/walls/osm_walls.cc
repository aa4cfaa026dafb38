// Walls of the buildings of a map: the facade grammar of the procedural towns, stretched to the tagged height.
#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/buildings/osm_facade.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/osm_streets.h"
#include "airsim360/worlds/osm/walls/osm_stacking.h"

namespace airsim360::internal {
namespace {

constexpr double kSetBack = 0.16;  // of dressed walls from the outline
constexpr double kChunk = 120;     // metres of one merged mesh

// How one volume is dressed.
struct Look {
  BuildingPlan plan;  // style, palette, floors, seed
  Surfaces surfaces;  // with its own wall colour
  Surface wall = Surface::kStuccoWhite;
  float stretch = 1;
  bool plain = false;  // no windows
};

bool IsAny(std::string_view value, std::initializer_list<std::string_view> choices) {
  return std::find(choices.begin(), choices.end(), value) != choices.end();
}

}  // namespace

Vec3f WeatheredPaint(Vec3f colour, uint64_t seed) {
  RngStream rng(seed, "weathered");
  const float grey = 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z, fade = static_cast<float>(rng.Uniform(0.0, 0.5)),
              light = static_cast<float>(rng.Uniform(0.78, 1.1)), warm = static_cast<float>(rng.Uniform(-0.05, 0.05));
  const auto mix = [&](float c, float tint) { return std::clamp((c + (grey - c) * fade) * light * tint, 0.02f, 0.85f); };
  return {mix(colour.x, 1 + warm), mix(colour.y, 1), mix(colour.z, 1 - warm)};
}

FacadeStyle PickFacadeStyle(const OsmTags& tags, std::string_view material, int floors, bool europe, RngStream& rng) {
  using Style = FacadeStyle;
  const auto one = [&](std::initializer_list<Style> list) { return *(list.begin() + rng.Index(static_cast<uint32_t>(list.size()))); };
  if (material == "glass" || material == "mirror") return Style::kCurtainWall;
  if (material == "metal" || material == "steel") return floors > 5 ? Style::kCurtainWall : Style::kRibbon;
  if (material == "brick" || material == "bricks") return floors > 2 && rng.Chance(0.4) ? Style::kBrickLoft : Style::kBrickWalkUp;
  if (material == "concrete") return Style::kConcreteGrid;
  if (IsAny(material, {"stone", "sandstone", "limestone", "marble", "granite"})) return Style::kClassicStone;
  if (IsAny(material, {"plaster", "stucco", "render", "adobe"})) return Style::kStuccoShutters;
  const std::string_view kind = tags.Get("building");
  if (IsAny(kind, {"church", "cathedral", "chapel", "public", "civic", "museum", "government", "university"})) return Style::kClassicStone;
  if (IsAny(kind, {"industrial", "warehouse", "manufacture"})) return one({Style::kBrickLoft, Style::kRibbon, Style::kConcreteGrid});
  if (IsAny(kind, {"office", "commercial"}))
    return floors > 8 ? one({Style::kCurtainWall, Style::kRibbon, Style::kConcreteGrid})
                      : one({Style::kClassicStone, Style::kRibbon, Style::kBrickLoft});
  if (IsAny(kind, {"house", "detached", "terrace", "semidetached_house", "bungalow"}))
    return europe ? one({Style::kStuccoShutters, Style::kBrickWalkUp}) : one({Style::kBrickWalkUp, Style::kStuccoShutters});
  if (floors > 14) return one({Style::kCurtainWall, Style::kRibbon, Style::kConcreteGrid, Style::kClassicStone});
  if (floors > 7) return one({Style::kClassicStone, Style::kBrickLoft, Style::kConcreteGrid, Style::kBrickWalkUp});
  if (europe) return one({Style::kStuccoShutters, Style::kClassicStone, Style::kClassicStone, Style::kBrickWalkUp, Style::kStuccoShutters});
  return one(
      {Style::kBrickWalkUp, Style::kBrickWalkUp, Style::kBrickWalkUp, Style::kBrickLoft, Style::kClassicStone, Style::kStuccoShutters});
}

namespace {

// A wall surface in the building's own colour.
MaterialId Coloured(OsmScene& scene, Surface wall, Vec3f colour, std::string_view material) {
  const auto& s = scene.surfaces;
  if (material == "brick" || material == "bricks" || (wall >= Surface::kBrickRed && wall <= Surface::kBrickWhite))
    return scene.tints.Get(s[Surface::kBrickWhite], colour, 0.52f);
  if (material == "metal" || material == "steel") return scene.tints.Get(s[Surface::kMetal], colour, 0.42f, 0.3f);
  // Gold leaf and the like: saturated yellow on something that is no house wall.
  if (wall >= Surface::kLimestone && wall <= Surface::kGranite) return scene.tints.Get(s[Surface::kLimestone], colour, 0.5f);
  if (wall == Surface::kConcrete || wall == Surface::kConcreteWarm) return scene.tints.Get(s[Surface::kConcrete], colour, 0.48f);
  return scene.tints.Get(s[Surface::kStuccoWhite], colour, 0.5f);
}

double LongestEdge(const Patches& patches) {
  double longest = 0;
  for (const Patch& patch : patches)
    for (size_t i = 0; i < patch.outer.size(); ++i) {
      const Vec2d v = patch.outer[(i + 1) % patch.outer.size()] - patch.outer[i];
      longest = std::max(longest, std::hypot(v.x, v.y));
    }
  return longest;
}

// Is this a thing rather than a house: a monument, a mast, a tank?
bool HasNoWindows(const OsmBuilding& building, const OsmVolume& volume) {
  const OsmTags &tags = *building.tags, &own = *volume.tags;
  const double height = volume.top - volume.bottom, area = Area(volume.footprint);
  if (own.Has("historic") || own.Has("man_made") || tags.Is("historic", "monument") || tags.Is("historic", "memorial")) return true;
  if (own.Is("building:part", "column") || own.Is("window", "no") || own.Is("building", "silo")) return true;
  if (height < 2.3 || area < 9) return true;
  if (volume.bottom > 0.3 && area < 60) return true;
  return LongestEdge(volume.footprint) < 2.2 && area < 150;
}

Look LookOf(OsmScene& scene, const OsmBuilding& building, const OsmVolume& volume) {
  Look look;
  look.surfaces = scene.surfaces;
  RngStream rng(scene.options.seed, building.id);
  look.plan.seed = rng.Bits();
  const auto tag = [&](const char* key) {
    const std::string_view own = volume.tags->Get(key);
    return own.empty() ? building.tags->Get(key) : own;
  };
  const std::string_view material = tag("building:material");
  const double walls = volume.top - volume.bottom - volume.roof_height;
  look.plain = HasNoWindows(building, volume);
  const MapWall* own_wall = scene.dress ? scene.dress->FindWall(material) : nullptr;
  look.plan.style =
      own_wall ? own_wall->style : PickFacadeStyle(*building.tags, material, static_cast<int>(walls / 3.3), scene.europe, rng);
  look.plan.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(look.plan.style).palettes)));
  // The storeys that need the least stretching; the roof's parapet is not the facade's affair.
  look.plan.roof = RoofKind::kHipTile;
  const StyleMetrics& metrics = MetricsOf(look.plan.style);
  const double storeys = (walls - static_cast<double>(metrics.ground_height)) / static_cast<double>(metrics.floor_height);
  look.plan.floors = std::max(0, static_cast<int>(std::lround(storeys)));
  look.stretch = static_cast<float>(walls / static_cast<double>(look.plan.height()));
  const std::string_view kind = building.tags->Get("building");
  look.plan.shops = volume.bottom < 0.5 && !IsAny(kind, {"house", "detached", "terrace", "semidetached_house", "church", "cathedral",
                                                         "chapel", "school", "garage", "garages", "shed", "industrial"});
  // Colour.
  const Dress dress = DressOf(look.plan);
  look.wall = dress.wall;
  if (look.plain && !ParseOsmColour(tag("building:colour")))
    look.wall = material.empty() || material == "stone" ? Surface::kLimestone : dress.wall;
  if (const auto colour = ParseOsmColour(tag("building:colour"))) {
    const bool gold = look.plain && colour->x > 0.7f && colour->z < 0.1f;
    const MaterialId own = gold ? scene.tints.Get(scene.surfaces[Surface::kMetal], *colour, 0.42f, 0.9f, 0.35f)
                                : Coloured(scene, look.wall, scene.dress ? WeatheredPaint(*colour, look.plan.seed) : *colour, material);
    look.surfaces = look.surfaces.With(look.wall, own)
                        .With(dress.party, own)
                        .With(dress.far, scene.tints.Get(scene.surfaces[Surface::kFarWalls1], *colour, 0.4f));
  }
  if (own_wall) {
    const auto colour = ParseOsmColour(tag("building:colour"));
    const MaterialId own =
        colour ? scene.tints.Get(own_wall->material, scene.dress ? WeatheredPaint(*colour, look.plan.seed) : *colour, own_wall->mean)
               : own_wall->material;
    look.surfaces = look.surfaces.With(look.wall, own).With(dress.party, own);
  }
  return look;
}

enum class Front { kParty, kStreet, kRear };

struct EdgeFacts {
  Front front = Front::kRear;
  float hidden = 0;  // metres over the volume's bottom up to which a neighbour covers it
  bool shops = false;
};

EdgeFacts FactsOf(const Neighbours& near, const OsmVolume& self, Vec2d a, Vec2d b) {
  EdgeFacts facts;
  const Vec2d v = b - a;
  const double length = std::max(std::hypot(v.x, v.y), 1e-9);
  const Vec2d out{v.y / length, -v.x / length}, middle = (a + b) * 0.5;
  const auto covered = [&](Vec2d p) {
    double top = 0;
    for (uint32_t i : near.boxes.Find(p)) {
      const OsmVolume& other = *near.volumes[i].volume;
      if (&other == &self || other.canopy || other.bottom > self.bottom + 0.6) continue;
      for (const Patch& patch : other.footprint)
        if (Inside(patch, p)) top = std::max(top, other.top - other.roof_height);
    }
    return top;
  };
  // Three places along the edge: what all of them have is hidden.
  double hidden = 1e9;
  for (double t : {0.12, 0.5, 0.88}) hidden = std::min(hidden, covered(a + v * t + out * 0.45));
  if (hidden > self.bottom + 0.5) {
    facts.front = Front::kParty;
    facts.hidden = static_cast<float>(hidden - self.bottom);
    return facts;
  }
  // A street within reach, and no building between.
  const LineIndex::Near road = near.roads.Find(middle + out * 6.0, 22);
  if (road.owner == UINT32_MAX) return facts;
  const Vec2d to = road.point - middle;
  if (to.x * out.x + to.y * out.y < 0.5 * std::hypot(to.x, to.y)) return facts;
  for (double t = 2; t < std::min(12.0, std::hypot(to.x, to.y) - 3); t += 2.5)
    if (covered(middle + out * t) > 1) return facts;
  facts.front = Front::kStreet;
  const int rank = near.graph->segments[road.owner].rank;
  facts.shops = rank >= 1 && rank <= 3;
  facts.shops = facts.shops || near.shops.Find(middle, 14).owner != UINT32_MAX;
  return facts;
}

// Bare wall of one edge, in the volume's colour; u runs on along the outline.
void PlainWall(MeshBuilder& mesh, Vec2f a, Vec2f b, float z0, float z1, float u) {
  const float w = std::hypot(b.x - a.x, b.y - a.y);
  mesh.QuadUv({a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1}, {u, -z0}, {u + w, -z0}, {u + w, -z1}, {u, -z1});
}

// The outline with each edge moved inwards by its own distance.
std::vector<Vec2f> SetBack(const Ring& ring, const std::vector<double>& back) {
  const size_t n = ring.size();
  std::vector<Vec2f> moved;
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (i + n - 1) % n;
    const Vec2d p = ring[i], before = ring[k], after = ring[(i + 1) % n];
    const auto inward = [](Vec2d a, Vec2d b) {
      const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-9);
      return Vec2d{-(b.y - a.y) / length, (b.x - a.x) / length};
    };
    // Where the two moved edges meet: n0 q = d0, n1 q = d1 from the corner.
    const Vec2d n0 = inward(before, p), n1 = inward(p, after);
    const double det = n0.x * n1.y - n0.y * n1.x;
    Vec2d q = (n0 * back[k] + n1 * back[i]) * 0.5;
    if (std::abs(det) > 0.15) q = {(back[k] * n1.y - back[i] * n0.y) / det, (n0.x * back[i] - n1.x * back[k]) / det};
    moved.push_back(ToFloat(p + q));
  }
  return moved;
}

}  // namespace

void BuildLowWall(MeshBuilder& mesh, const Surfaces& surfaces, const Dress& dress, Vec2f a, Vec2f b, float base, float height,
                  EntityId entity, RngStream& rng) {
  FacadePen pen(mesh, surfaces);
  pen.SetScale(base, 1, 0.6f);
  pen.SetWall(a, b);
  pen.UseEntity(entity);
  const float length = pen.length();
  const int bays = std::max(1, static_cast<int>(std::lround(length / 3.0f)));
  const float w = length / static_cast<float>(bays), head = std::min(height - 0.25f, 2.15f);
  for (int i = 0; i < bays; ++i) {
    const float x0 = w * static_cast<float>(i), m = x0 + w / 2;
    if (length < 1.8f || (i + 2) % 3 == 0) {
      pen.Use(dress.wall);
      pen.Front(x0, x0 + w, 0, height, 0);
    } else {
      const bool door = i % 3 == 0;
      SimpleOpening(pen, dress, x0, x0 + w, 0, height, m - (door ? 0.5f : 0.6f), m + (door ? 0.5f : 0.6f), door ? 0.05f : 0.95f, head,
                    0.12f, rng);
    }
  }
  mesh.SetTransform({});
}

namespace {

class WallBuilder {
 public:
  WallBuilder(OsmScene& scene, const Neighbours& near, MeshBuilder& mesh, MeshId balcony, MeshId window_box)
      : scene_(scene), near_(near), mesh_(mesh), balcony_(balcony), window_box_(window_box) {}

  void Build(const OsmVolume& volume, const Look& look, double ground, EntityId entity) {
    const double base = ground + volume.bottom, walls = volume.top - volume.bottom - volume.roof_height;
    // Down into the ground where it slopes, so that nothing stands in the air.
    const double foot = volume.bottom < 0.3 && !scene_.relief.flat() ? 3 : 0;
    for (const Patch& patch : volume.footprint) {
      BuildRing(volume, look, patch.outer, {base, walls, foot, entity});
      for (const Ring& hole : patch.holes) BuildRing(volume, look, hole, {base, walls, foot, entity});
      if (volume.bottom > 0.05) Underside(patch, base, look, entity);
    }
  }

 private:
  void Underside(const Patch& patch, double base, const Look& look, EntityId entity) {
    mesh_.SetEntity(entity);
    mesh_.SetMaterial(look.surfaces[look.wall]);
    std::vector<Vec2d> points = patch.outer;
    for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
    const std::vector<uint32_t> t = Triangulate(patch);
    const auto at = [&](uint32_t i) {
      return Vec3f{static_cast<float>(points[i].x), static_cast<float>(points[i].y), static_cast<float>(base)};
    };
    const auto uv = [&](uint32_t i) { return ToFloat(points[i]); };
    for (size_t i = 0; i + 2 < t.size(); i += 3) mesh_.Triangle(at(t[i]), at(t[i + 2]), at(t[i + 1]), uv(t[i]), uv(t[i + 2]), uv(t[i + 1]));
  }

  /// Heights of the walls of a ring (metres): where they begin, how high they are, how far they go on into the ground.
  struct Walls {
    double base, height, foot;
    EntityId entity;
  };
  enum class Kind { kParty, kPlain, kLow, kDressed };
  struct Edge {
    Kind kind = Kind::kParty;
    EdgeFacts facts;
    FacadeDetail detail = FacadeDetail::kSimple;
  };

  // What an edge is; dressed walls get their entries of the plan.
  Edge Classify(const OsmVolume& volume, const Look& look, const Ring& ring, size_t i, float height, BuildingPlan& plan) const {
    const Vec2d a = ring[i], b = ring[(i + 1) % ring.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y), far = scene_.Far((a + b) * 0.5);
    Edge edge;
    if (!look.plain && length > 0.02) edge.facts = FactsOf(near_, volume, a, b);
    const bool distant = far > kSimpleDetail, street = edge.facts.front == Front::kStreet;
    if (edge.facts.front == Front::kParty) {
      edge.kind = Kind::kParty;
    } else if (look.plain || length < 2.2 || (distant && height < 5)) {
      edge.kind = Kind::kPlain;
    } else if (height < 4.4f || look.stretch < 0.72f) {
      edge.kind = Kind::kLow;
    } else {
      edge.kind = Kind::kDressed;
      plan.edges[i] = street ? EdgeKind::kStreet : EdgeKind::kRear;
      plan.party_height[i] = 0;
      plan.shops = plan.shops && (!street || edge.facts.shops);
      edge.detail = distant ? FacadeDetail::kFlat : far > kFullDetail || !street ? FacadeDetail::kSimple : FacadeDetail::kFull;
    }
    return edge;
  }

  void BuildRing(const OsmVolume& volume, const Look& look, const Ring& ring, const Walls& walls) {
    if (walls.height < 0.02) return;
    const size_t n = ring.size();
    Look own = look;
    own.plan.edges.assign(n, EdgeKind::kParty);
    own.plan.party_height.assign(n, 1e6f);  // left as it is, BuildFacades draws nothing there
    own.plan.canopies = false;              // nothing leaves the outline
    own.plan.cornice = 0.45f;
    std::vector<Edge> edges(n);
    std::vector<FacadeDetail> detail(n);
    std::vector<double> back(n, 0.0);  // dressed walls stand back a hand's breadth, so that sills and courses stay in the outline
    for (size_t i = 0; i < n; ++i) {
      edges[i] = Classify(volume, look, ring, i, static_cast<float>(walls.height), own.plan);
      detail[i] = edges[i].detail;
      if (edges[i].kind == Kind::kDressed) back[i] = kSetBack;
    }
    own.plan.outline = SetBack(ring, back);
    float u = 0;
    for (size_t i = 0; i < n; ++i) u = BuildEdge(own, ring, edges[i], i, walls, u);
    FacadeContext context{scene_.builder, own.surfaces, mesh_, balcony_, window_box_};
    context.base = static_cast<float>(walls.base);
    context.stretch = look.stretch;
    context.reach = 0.6f;
    if (!scene_.relief.flat()) context.fall = [&](Vec2f p) { return static_cast<float>(walls.base - scene_.relief.At({p.x, p.y})); };
    context.next_sign = static_cast<int>(look.plan.seed % kSignCount);
    BuildFacades(context, own.plan, walls.entity, detail);
  }

  // All of an edge but a dressed wall; u is where its texture begins. Returns where that of the next does.
  float BuildEdge(Look& own, const Ring& ring, const Edge& edge, size_t i, const Walls& walls, float u) {
    const auto z0 = static_cast<float>(walls.base), z1 = static_cast<float>(walls.base + walls.height),
               height = static_cast<float>(walls.height);
    const Vec2f a = own.plan.outline[i], b = own.plan.outline[(i + 1) % ring.size()];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const bool distant = scene_.Far(ring[i]) > kSimpleDetail;
    mesh_.SetTransform({});
    mesh_.SetEntity(walls.entity);
    if (walls.foot > 0) {
      mesh_.SetMaterial(own.surfaces[Surface::kConcrete]);
      PlainWall(mesh_, a, b, static_cast<float>(walls.base - walls.foot), z0, u);
    }
    if (edge.kind == Kind::kParty) {
      const float hidden = std::min(edge.facts.hidden, height);
      if (height - hidden > 3.5f && length > 3 && !distant) {
        own.plan.party_height[i] = hidden / own.stretch;
      } else if (height - hidden > 0.01f) {
        mesh_.SetMaterial(own.surfaces[DressOf(own.plan).party]);
        PlainWall(mesh_, a, b, z0 + hidden, z1, u);
      }
    } else if (edge.kind == Kind::kPlain) {
      const bool pictured = !own.plain && height > 4.5f && Perimeter(ring) > 25;
      mesh_.SetMaterial(own.surfaces[pictured ? DressOf(own.plan).far : own.wall]);
      PlainWall(mesh_, a, b, z0, z1, u);
    } else if (edge.kind == Kind::kLow) {
      RngStream rng(own.plan.seed, "low wall", i);
      BuildLowWall(mesh_, own.surfaces, DressOf(own.plan), a, b, z0, height, walls.entity, rng);
    }
    return u + length;
  }

  static double Perimeter(const Ring& ring) {
    double sum = 0;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2d v = ring[(i + 1) % ring.size()] - ring[i];
      sum += std::hypot(v.x, v.y);
    }
    return sum;
  }

  OsmScene& scene_;
  const Neighbours& near_;
  MeshBuilder& mesh_;
  MeshId balcony_, window_box_;
};

// A roof on posts.
void BuildCanopy(OsmScene& scene, MeshBuilder& mesh, const OsmVolume& volume, double base, EntityId entity) {
  const auto top = static_cast<float>(base + volume.top - volume.roof_height), low = std::max(top - 0.25f, static_cast<float>(base));
  mesh.SetTransform({});
  mesh.SetEntity(entity);
  for (const Patch& patch : volume.footprint) {
    std::vector<Vec2f> outline;
    for (Vec2d p : patch.outer) outline.push_back(ToFloat(p));
    mesh.SetMaterial(scene.surfaces[Surface::kTrimWhite]);
    mesh.Walls(outline, low, top);
    mesh.Polygon(outline, low, false);
    if (volume.bottom > 0.3) continue;
    mesh.SetMaterial(scene.surfaces[Surface::kMetal]);
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()];
      const float length = std::hypot(b.x - a.x, b.y - a.y);
      if (length < 1.5f) continue;
      const Vec2f in = Vec2f{-(b.y - a.y), b.x - a.x} * (0.3f / length), p = a + (b - a) * (0.4f / length) + in;
      mesh.Tube({p.x, p.y, static_cast<float>(base)}, {p.x, p.y, low}, 0.09f, 0.09f, 8, false, false);
    }
  }
}

// Machines on a deck, as entities of their own.
void Clutter(OsmScene& scene, const OsmVolume& volume, double base, uint64_t seed) {
  if (volume.roof != OsmRoof::kFlat || volume.top - volume.bottom < 6) return;
  for (const Patch& patch : volume.footprint) {
    const double area = Area(patch);
    if (area < 45 || scene.Far(patch.outer[0]) > kSimpleDetail) continue;
    RngStream rng(seed, "deck");
    const Bounds2d box = BoundsOf(patch.outer);
    const double deck = base + LowestRoof(volume);
    Occupancy taken;
    const auto scatter = [&](const char* kind, int count, float scale) {
      const float r = FindPropKind(kind).footprint_radius * scale;
      for (int tries = 0; count > 0 && tries < 40; ++tries) {
        const Vec2d p{rng.Uniform(box.min.x, box.max.x), rng.Uniform(box.min.y, box.max.y)};
        const Footprint place{ToFloat(p), {r, r}, 0};
        bool clear = Inside(patch, p) && DistanceToRing(patch.outer, p) > static_cast<double>(r) + 0.5 && taken.IsFree(place);
        for (const Ring& hole : patch.holes) clear = clear && DistanceToRing(hole, p) > static_cast<double>(r) + 0.5;
        if (!clear) continue;
        taken.Add(place);
        scene.Put(volume.id + "/" + kind, kind, {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(deck)},
                  rng.Uniform(0, 6.28), scale, rng.Index(8));
        --count;
      }
    };
    if (area > 90 && rng.Chance(scene.europe ? 0.02 : 0.16)) scatter("water_tank", 1, 1);
    scatter("ac_unit", std::min(6, static_cast<int>(area / 90)) + (rng.Chance(0.6) ? 1 : 0), 1);
    scatter("roof_vent", std::min(6, 1 + static_cast<int>(area / 80)), 1);
    if (rng.Chance(0.35)) scatter("antenna", 1, 1);
  }
}

}  // namespace

std::vector<EntityId> BuildOsmBuildings(OsmScene& scene, const std::vector<OsmBuilding>& buildings, const Neighbours& near) {
  const MeshId balcony = AddBalconyMesh(scene.builder, scene.surfaces), window_box = AddWindowBoxMesh(scene.builder, scene.surfaces);
  SemanticTree& tree = scene.builder.tree();
  const CategoryId walls_are = tree.At("construction/building"), roofs_are = tree.At("construction/building/roof");
  std::map<std::pair<int, int>, MeshBuilder> chunks;
  std::vector<EntityId> entities;
  for (size_t i = 0; i < buildings.size(); ++i) {
    const OsmBuilding& building = buildings[i];
    const CategoryId category = building.orphan ? tree.At("construction/building/part") : walls_are;
    const EntityId entity = scene.builder.AddEntity(building.id + (building.name.empty() ? "" : " " + building.name), category);
    entities.push_back(entity);
    for (const OsmVolume& volume : building.volumes) {
      if (volume.footprint.empty()) continue;
      const Vec2d at = volume.footprint[0].outer[0];
      MeshBuilder& mesh = chunks[{static_cast<int>(std::floor(at.x / kChunk)), static_cast<int>(std::floor(at.y / kChunk))}];
      const Look look = LookOf(scene, building, volume);
      const double ground = GroundUnder(scene, near, volume);
      const EntityId roof = scene.builder.AddEntity(volume.id + "/roof", roofs_are);
      if (volume.canopy)
        BuildCanopy(scene, mesh, volume, ground, entity);
      else
        WallBuilder(scene, near, mesh, balcony, window_box).Build(volume, look, ground, entity);
      CloseOnSupports(mesh, near, volume, ground, look.surfaces[look.wall], entity);
      BuildOsmRoof(mesh, volume, ground, entity, roof, look.surfaces[look.wall], RoofCover(scene, volume, *building.tags, look.plan.seed));
      if (!look.plain && !volume.canopy) Clutter(scene, volume, ground, look.plan.seed);
    }
  }
  for (auto& chunk : chunks) {
    if (chunk.second.empty()) continue;
    scene.builder.AddInstance({scene.builder.AddMesh(chunk.second.Finish("buildings " + std::to_string(chunk.first.first) + "," +
                                                                         std::to_string(chunk.first.second))),
                               {},
                               kNoEntity});
  }
  return entities;
}

}  // namespace airsim360::internal

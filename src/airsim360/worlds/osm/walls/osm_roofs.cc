// Roof shapes over any outline. Ridged roofs are the lower envelope of planes over the outline's main
// direction, cut to the outline; pointed and round ones are rings drawn together over its middle.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/osm/walls/osm_stacking.h"

namespace airsim360::internal {
namespace {

// z = c + gx x + gy y over the eaves.
struct Plane {
  double c = 0, gx = 0, gy = 0;
  double At(Vec2d p) const { return c + gx * p.x + gy * p.y; }
};

// The frame of a roof: along its ridge, across, and how far it reaches.
struct Frame {
  Vec2d along{1, 0}, across{0, 1};
  double u0 = 1e18, u1 = -1e18, v0 = 1e18, v1 = -1e18;
};

Frame FrameOf(const OsmVolume& volume) {
  Frame frame;
  double longest = -1;
  for (const Patch& patch : volume.footprint)
    for (size_t i = 0; i < patch.outer.size(); ++i) {
      const Vec2d v = patch.outer[(i + 1) % patch.outer.size()] - patch.outer[i];
      const double length = std::hypot(v.x, v.y);
      if (length > longest) {
        longest = length;
        frame.along = v * (1 / std::max(length, 1e-9));
      }
    }
  const auto measure = [&] {
    frame.across = {-frame.along.y, frame.along.x};
    frame.u0 = frame.v0 = 1e18;
    frame.u1 = frame.v1 = -1e18;
    for (const Patch& patch : volume.footprint)
      for (Vec2d p : patch.outer) {
        const double u = p.x * frame.along.x + p.y * frame.along.y, v = p.x * frame.across.x + p.y * frame.across.y;
        frame.u0 = std::min(frame.u0, u);
        frame.u1 = std::max(frame.u1, u);
        frame.v0 = std::min(frame.v0, v);
        frame.v1 = std::max(frame.v1, v);
      }
  };
  measure();
  // The ridge runs along the longer side unless the map says otherwise.
  const OsmTags& tags = *volume.tags;
  bool turn = frame.u1 - frame.u0 < frame.v1 - frame.v0;
  if (tags.Is("roof:orientation", "across")) turn = !turn;
  if (turn) {
    frame.along = frame.across;
    measure();
  }
  // The compass direction that a slope faces.
  if (const auto facing = ParseOsmNumber(tags.Get("roof:direction"), -360, 720)) {
    const double a = *facing * M_PI / 180;
    frame.along = {std::cos(a), -std::sin(a)};
    measure();
    if (frame.across.x * std::sin(a) + frame.across.y * std::cos(a) > 0) {
      frame.along = frame.along * -1.0;
      measure();
    }
  }
  return frame;
}

// Planes through lines: 0 at a distance `from` inside an edge of the frame, growing by `slope` a metre inwards.
class Planes {
 public:
  explicit Planes(const Frame& frame) : f_(frame) {}
  // side 0: low v, 1: high v, 2: low u, 3: high u.
  void Add(int side, double height, double slope) {
    const Vec2d n = side < 2 ? f_.across : f_.along;
    const double edge = side == 0 ? f_.v0 : side == 1 ? f_.v1 : side == 2 ? f_.u0 : f_.u1;
    const double sign = side % 2 == 0 ? 1 : -1;
    list_.push_back({height - sign * slope * edge, sign * slope * n.x, sign * slope * n.y});
  }
  std::vector<Plane> Take() { return std::move(list_); }

 private:
  const Frame& f_;
  std::vector<Plane> list_;
};

std::vector<Plane> PlanesOf(const OsmVolume& volume, const Frame& f) {
  Planes planes(f);
  const double h = volume.roof_height, w = std::max((f.v1 - f.v0) / 2, 0.05), l = std::max((f.u1 - f.u0) / 2, 0.05);
  switch (volume.roof) {
    case OsmRoof::kSkillion:
    case OsmRoof::kSawtooth:
      planes.Add(0, 0, h / (2 * w));
      break;
    case OsmRoof::kSaltbox:
      planes.Add(0, 0, h / (1.3 * w));
      planes.Add(1, 0, h / (0.7 * w));
      break;
    case OsmRoof::kGambrel:
    case OsmRoof::kMansard:
      for (int side = 0; side < (volume.roof == OsmRoof::kMansard ? 4 : 2); ++side) {
        planes.Add(side, 0, 0.65 * h / (0.3 * w));
        planes.Add(side, 0.65 * h - 0.3 * w * (0.35 * h / (0.7 * w)), 0.35 * h / (0.7 * w));
      }
      break;
    case OsmRoof::kRound:
      for (int i = 0; i < 8; ++i) {
        // Tangents of a half ellipse, of which the two in the middle meet at the height of the roof.
        const double a = (i + 0.5) * M_PI / 8, x = w * (1 - std::cos(a)), r = h * std::sin(3.5 * M_PI / 8);
        const double z = r * std::sin(a), slope = r * std::cos(a) / (w * std::sin(a));
        planes.Add(0, z - slope * x, slope);
      }
      break;
    case OsmRoof::kHipped:
    case OsmRoof::kHalfHipped: {
      const double run = std::min(w, l);
      planes.Add(0, 0, h / w);
      planes.Add(1, 0, h / w);
      const double start = volume.roof == OsmRoof::kHalfHipped ? 0.5 * h : 0;
      planes.Add(2, start, h / run);
      planes.Add(3, start, h / run);
      break;
    }
    default:
      planes.Add(0, 0, h / w);
      planes.Add(1, 0, h / w);
  }
  return planes.Take();
}

// The convex area where plane i is the lowest.
Ring Reign(const std::vector<Plane>& planes, size_t i, const Bounds2d& box) {
  Ring area{{box.min.x - 1, box.min.y - 1}, {box.max.x + 1, box.min.y - 1}, {box.max.x + 1, box.max.y + 1}, {box.min.x - 1, box.max.y + 1}};
  for (size_t k = 0; k < planes.size() && area.size() >= 3; ++k) {
    if (k == i) continue;
    const auto over = [&](Vec2d p) { return planes[i].At(p) - planes[k].At(p); };
    Ring cut;
    for (size_t n = 0; n < area.size(); ++n) {
      const Vec2d a = area[n], b = area[(n + 1) % area.size()];
      const double da = over(a), db = over(b);
      if (da <= 0) cut.push_back(a);
      if ((da < 0 && db > 0) || (da > 0 && db < 0)) cut.push_back(a + (b - a) * (da / (da - db)));
    }
    area = std::move(cut);
  }
  return area;
}

void CoverPlane(MeshBuilder& mesh, const Patches& patches, const Plane& plane, double eaves, Vec2d zero) {
  const double g = std::hypot(plane.gx, plane.gy);
  const Vec2d down = g > 1e-9 ? Vec2d{-plane.gx / g, -plane.gy / g} : Vec2d{0, -1}, along{-down.y, down.x};
  const double steep = std::sqrt(1 + g * g);
  const auto point = [&](Vec2d p) {
    return Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(eaves + plane.At(p))};
  };
  const auto uv = [&](Vec2d p) {
    const Vec2d d = p - zero;
    return Vec2f{static_cast<float>(d.x * along.x + d.y * along.y), static_cast<float>((d.x * down.x + d.y * down.y) * steep)};
  };
  for (const Patch& patch : patches) {
    std::vector<Vec2d> points = patch.outer;
    for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
    const std::vector<uint32_t> triangles = Triangulate(patch);
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
      const Vec2d a = points[triangles[i]], b = points[triangles[i + 1]], c = points[triangles[i + 2]];
      mesh.Triangle(point(a), point(b), point(c), uv(a), uv(b), uv(c));
    }
  }
}

// Walls between the eaves and the planes, along every edge.
void GableWalls(MeshBuilder& mesh, const Patches& footprint, const std::vector<Plane>& planes, double eaves) {
  const auto height = [&](Vec2d p) {
    double z = 1e18;
    for (const Plane& plane : planes) z = std::min(z, plane.At(p));
    return std::max(z, 0.0);
  };
  const auto wall = [&](Vec2d a, Vec2d b) {
    // Where the lowest plane changes along the edge.
    std::vector<double> stops{0, 1};
    for (size_t i = 0; i < planes.size(); ++i)
      for (size_t k = i + 1; k < planes.size(); ++k) {
        const double da = planes[i].At(a) - planes[k].At(a), db = planes[i].At(b) - planes[k].At(b);
        if ((da < 0) != (db < 0)) stops.push_back(da / (da - db));
      }
    std::sort(stops.begin(), stops.end());
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (size_t i = 0; i + 1 < stops.size(); ++i) {
      const double s0 = stops[i], s1 = stops[i + 1];
      if (s1 - s0 < 1e-6) continue;
      const Vec2d p = a + (b - a) * s0, q = a + (b - a) * s1;
      const double zp = height(p), zq = height(q);
      if (zp < 0.02 && zq < 0.02) continue;
      const auto at = [&](Vec2d c, double z) {
        return Vec3f{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(eaves + z)};
      };
      const auto up = static_cast<float>(s0 * length), uq = static_cast<float>(s1 * length), e = static_cast<float>(eaves);
      const auto fp = static_cast<float>(zp), fq = static_cast<float>(zq);
      if (zq > 0.001) mesh.Triangle(at(p, 0), at(q, 0), at(q, zq), {up, -e}, {uq, -e}, {uq, -e - fq});
      if (zp > 0.001) mesh.Triangle(at(p, 0), at(q, zq), at(p, zp), {up, -e}, {uq, -e - fq}, {up, -e - fp});
    }
  };
  for (const Patch& patch : footprint) {
    const auto ring = [&](const Ring& r) {
      for (size_t i = 0; i < r.size(); ++i) wall(r[i], r[(i + 1) % r.size()]);
    };
    ring(patch.outer);
    for (const Ring& hole : patch.holes) ring(hole);
  }
}

// Rings of the outline drawn together over its middle: share of the outline and of the height, from the eaves up.
void Turned(MeshBuilder& mesh, const Ring& outline, double eaves, double height, const std::vector<std::pair<double, double>>& profile) {
  Vec2d middle{0, 0};
  double twice = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2d a = outline[i] - outline[0], b = outline[(i + 1) % outline.size()] - outline[0];
    const double cross = a.x * b.y - b.x * a.y;
    twice += cross;
    middle = middle + (a + b) * (cross / 3);
  }
  middle = outline[0] + (std::abs(twice) > 1e-9 ? middle * (1 / twice) : Vec2d{0, 0});
  const auto at = [&](size_t i, std::pair<double, double> step) {
    const Vec2d p = middle + (outline[i % outline.size()] - middle) * step.first;
    return Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(eaves + height * step.second)};
  };
  double v = 0;
  for (size_t k = 0; k + 1 < profile.size(); ++k) {
    double u = 0;
    const double rise = std::hypot((profile[k + 1].second - profile[k].second) * height, 0.5);
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vec2d edge = outline[(i + 1) % outline.size()] - outline[i];
      const double next = u + std::hypot(edge.x, edge.y);
      const Vec3f a = at(i, profile[k]), b = at(i + 1, profile[k]), c = at(i + 1, profile[k + 1]), d = at(i, profile[k + 1]);
      const auto fu = static_cast<float>(u), fn = static_cast<float>(next), fv = static_cast<float>(-v), ft = static_cast<float>(-v - rise);
      if (profile[k + 1].first > 1e-6)
        mesh.QuadUv(a, b, c, d, {fu, fv}, {fn, fv}, {fn, ft}, {fu, ft});
      else
        mesh.Triangle(a, b, d, {fu, fv}, {fn, fv}, {(fu + fn) / 2, ft});
      u = next;
    }
    v += rise;
  }
}

std::vector<std::pair<double, double>> ProfileOf(OsmRoof roof) {
  std::vector<std::pair<double, double>> profile;
  if (roof == OsmRoof::kDome) {
    for (int i = 0; i <= 8; ++i) profile.emplace_back(i == 8 ? 0 : std::cos(i * M_PI / 16), std::sin(i * M_PI / 16));
  } else if (roof == OsmRoof::kOnion) {
    profile = {{1, 0}, {1.0, 0.1}, {0.98, 0.3}, {0.86, 0.45}, {0.62, 0.58}, {0.34, 0.7}, {0.16, 0.82}, {0.06, 0.93}, {0, 1}};
  } else {
    profile = {{1, 0}, {0, 1}};
  }
  return profile;
}

// A deck with a rim: parapet, coping, the rim's inner side.
void FlatRoof(MeshBuilder& mesh, const OsmVolume& volume, double base, EntityId walls, EntityId roof, MaterialId wall, MaterialId cover) {
  const double top = base + volume.top, deck = base + LowestRoof(volume), thick = 0.3;
  Patches inner;
  if (deck < top) {
    Patches bands;
    for (const Patch& patch : volume.footprint) {
      const auto band = [&](const Ring& ring) {
        Ring line = ring;
        line.push_back(ring[0]);
        line.push_back(ring[1]);
        const Patches around = Band(line, thick, 0);
        bands.insert(bands.end(), around.begin(), around.end());
      };
      band(patch.outer);
      for (const Ring& hole : patch.holes) band(hole);
    }
    inner = Subtract(volume.footprint, bands);
  }
  mesh.SetTransform({});
  mesh.SetEntity(roof);
  mesh.SetMaterial(cover);
  CoverPlane(mesh, inner.empty() ? volume.footprint : inner, {}, inner.empty() ? top : deck, {0, 0});
  if (inner.empty()) return;
  mesh.SetMaterial(wall);
  CoverPlane(mesh, Subtract(volume.footprint, inner), {}, top, {0, 0});
  mesh.SetEntity(walls);
  const auto inward = [&](const Ring& ring) {
    // The rim's side towards the deck.
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2f b = ToFloat(ring[i]), a = ToFloat(ring[(i + 1) % ring.size()]);
      const auto z0 = static_cast<float>(deck), z1 = static_cast<float>(top);
      mesh.Quad({a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1});
    }
  };
  for (const Patch& patch : inner) {
    inward(patch.outer);
    for (const Ring& hole : patch.holes) inward(hole);
  }
}

}  // namespace

void BuildOsmRoof(MeshBuilder& mesh, const OsmVolume& volume, double base, EntityId walls, EntityId roof, MaterialId wall,
                  MaterialId cover) {
  if (volume.roof == OsmRoof::kFlat || volume.roof_height < 0.05) {
    FlatRoof(mesh, volume, base, walls, roof, wall, cover);
    return;
  }
  const double eaves = base + volume.top - volume.roof_height;
  mesh.SetTransform({});
  mesh.SetEntity(roof);
  mesh.SetMaterial(cover);
  const bool turned = volume.roof == OsmRoof::kPyramidal || volume.roof == OsmRoof::kCone || volume.roof == OsmRoof::kDome ||
                      volume.roof == OsmRoof::kOnion;
  if (turned) {
    for (const Patch& patch : volume.footprint) Turned(mesh, patch.outer, eaves, volume.roof_height, ProfileOf(volume.roof));
    return;
  }
  const Frame frame = FrameOf(volume);
  const std::vector<Plane> planes = PlanesOf(volume, frame);
  Bounds2d box;
  for (const Patch& patch : volume.footprint)
    for (Vec2d p : patch.outer) box.Add(p);
  for (size_t i = 0; i < planes.size(); ++i) {
    const Ring reign = Reign(planes, i, box);
    if (reign.size() < 3) continue;
    CoverPlane(mesh, planes.size() == 1 ? volume.footprint : Intersect(volume.footprint, Patches{{reign, {}}}), planes[i], eaves, box.min);
  }
  mesh.SetEntity(walls);
  mesh.SetMaterial(wall);
  GableWalls(mesh, volume.footprint, planes, eaves);
}

MaterialId RoofCover(OsmScene& scene, const OsmVolume& volume, const OsmTags& building, uint64_t seed) {
  const auto tag = [&](const char* key) {
    const std::string_view own = volume.tags->Get(key);
    return own.empty() ? building.Get(key) : own;
  };
  const std::string_view material = tag("roof:material");
  const std::optional<Vec3f> colour = ParseOsmColour(tag("roof:colour"));
  const bool flat = volume.roof == OsmRoof::kFlat;
  Surface base =
      flat ? (seed % 5 < 3 ? Surface::kRoofGravel : Surface::kRoofBitumen) : (seed % 3 == 0 ? Surface::kRoofSlate : Surface::kRoofTile);
  float mean = flat ? 0.15f : 0.2f;
  if (material == "roof_tiles" || material == "tile" || material == "tiles") base = Surface::kRoofTile, mean = 0.2f;
  if (material == "slate") base = Surface::kRoofSlate, mean = 0.05f;
  if (material == "concrete" || material == "stone") base = Surface::kConcrete, mean = 0.45f;
  if (material == "gravel") base = Surface::kRoofGravel, mean = 0.18f;
  if (material == "tar_paper" || material == "asphalt" || material == "bitumen") base = Surface::kRoofBitumen, mean = 0.12f;
  if (material == "grass") return scene.surfaces[Surface::kLawn];
  if (material == "glass") return scene.surfaces[Surface::kGlassBlue];
  if (material == "metal" || material == "copper" || material == "zinc" || material == "tin" || material == "lead") {
    if (material == "copper" && !colour) return scene.tints.Get(scene.surfaces[Surface::kMetal], {0.24f, 0.40f, 0.33f}, 0.42f, 0.2f);
    return colour ? scene.tints.Get(scene.surfaces[Surface::kMetal], *colour, 0.42f, 0.3f) : scene.surfaces[Surface::kMetal];
  }
  if (!colour) return scene.surfaces[base];
  // Tiles and slates have a hue of their own; a colour goes on plain concrete better.
  if (!flat && material.empty()) return scene.tints.Get(scene.surfaces[Surface::kRoofSlate], *colour, 0.06f);
  if (flat && material.empty()) base = Surface::kRoofGravel, mean = 0.18f;
  return scene.tints.Get(scene.surfaces[base], *colour, mean);
}

}  // namespace airsim360::internal

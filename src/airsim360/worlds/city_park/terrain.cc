// The ground: an adaptive mesh over a quadtree. Every cell is a fan around its middle through all corners
// that lie on its border, so that cells of any sizes meet without gaps.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/city_park/park.h"

namespace airsim360::internal::park {
namespace {

// Lattice units of 0.25 m, so that the middles of cells of 0.5 m are lattice points too.
constexpr float kUnit = 0.25f;
constexpr int kRoot = 65536;  // 16,384 m

struct Cell {
  int x, y, size;  // lower left corner and width
  Vec2f middle() const {
    return Vec2f{static_cast<float>(x) + 0.5f * static_cast<float>(size), static_cast<float>(y) + 0.5f * static_cast<float>(size)} * kUnit;
  }
};

uint64_t KeyOf(int x, int y) { return static_cast<uint64_t>(static_cast<uint32_t>(x)) << 32 | static_cast<uint32_t>(y); }

// Width in metres that cells around p should have; `size` is that of the cell that asks.
float WantedSize(const Layout& layout, Vec2f p, float size) {
  const float r = std::hypot(p.x, p.y), half = 0.71f * size;
  const float nearest = std::max(0.0f, r - half);
  float wanted = nearest < 48 ? 1 : nearest < 150 ? 2 : nearest < 560 ? 4 : nearest < 1500 ? 16 : nearest < 4500 ? 64 : 128;
  if (nearest > 760) return wanted;
  const float lake = layout.Lake(p);
  if (std::abs(lake - 1.02f) * kLakeRy * 0.8f < 3.5f + half)
    wanted = std::min(wanted, 0.5f);
  else if (lake < 1.6f + half / kLakeRy)
    wanted = std::min(wanted, 2.0f);
  if (size > wanted && std::abs(layout.BeyondRoad(p) - 0.4f) < 1.6f + half)
    wanted = std::min(wanted, nearest < 150 ? 1.0f : nearest < 560 ? 2.0f : 4.0f);
  if (size > wanted && nearest < 560 && layout.PathDistance(p, 3 + half) < kPathHalf + 0.9f + half) wanted = std::min(wanted, 1.0f);
  return wanted;
}

void Subdivide(const Layout& layout, const Cell& cell, std::vector<Cell>& leaves) {
  const float size = static_cast<float>(cell.size) * kUnit;
  if (size <= 0.5f || size <= WantedSize(layout, cell.middle(), size)) {
    leaves.push_back(cell);
    return;
  }
  const int h = cell.size / 2;
  for (int k = 0; k < 4; ++k) Subdivide(layout, {cell.x + (k & 1) * h, cell.y + (k >> 1) * h, h}, leaves);
}

// Corners of cells and their heights.
class Lattice {
 public:
  explicit Lattice(const std::vector<Cell>& leaves) {
    for (const Cell& c : leaves) {
      for (int k = 0; k < 4; ++k) Add(c.x + (k & 1) * c.size, c.y + (k >> 1) * c.size);
      Add(c.x + c.size / 2, c.y + c.size / 2);
    }
  }
  void Raise(const Layout& layout) {
    constexpr int64_t kBlock = 4096;
    const auto n = static_cast<int64_t>(points_.size());
    ParallelFor((n + kBlock - 1) / kBlock, [&](int64_t block) {
      for (int64_t i = block * kBlock; i < std::min(n, (block + 1) * kBlock); ++i) {
        Vec3f& p = points_[static_cast<size_t>(i)];
        p.z = layout.Ground({p.x, p.y}) - layout.PathBed({p.x, p.y});
      }
    });
  }
  bool Has(int x, int y) const { return index_.contains(KeyOf(x, y)); }
  uint32_t At(int x, int y) const { return index_.at(KeyOf(x, y)); }
  const std::vector<Vec3f>& points() const { return points_; }

 private:
  void Add(int x, int y) {
    if (index_.try_emplace(KeyOf(x, y), static_cast<uint32_t>(points_.size())).second)
      points_.push_back({static_cast<float>(x) * kUnit, static_cast<float>(y) * kUnit, 0});
  }
  std::unordered_map<uint64_t, uint32_t> index_;  // looked up by key only, never iterated
  std::vector<Vec3f> points_;
};

// All lattice points on the border from a (included) to b (excluded).
void AddBorder(const Lattice& lattice, int ax, int ay, int bx, int by, std::vector<uint32_t>& border) {
  const int mx = (ax + bx) / 2, my = (ay + by) / 2;
  const bool fine = std::abs(bx - ax) + std::abs(by - ay) > 2 && lattice.Has(mx, my);
  if (!fine) {
    border.push_back(lattice.At(ax, ay));
    return;
  }
  AddBorder(lattice, ax, ay, mx, my, border);
  AddBorder(lattice, mx, my, bx, by, border);
}

size_t LevelOf(const Cell& cell) {
  const Vec2f m = cell.middle();
  const float reach = std::max(std::abs(m.x), std::abs(m.y));
  return reach < kGroundSquares[0] ? 0 : reach < kGroundSquares[1] ? 1 : 2;
}

/// Triangles by (level, entity), and at every point of the lattice the sum of the normals of all triangles around it.
struct Triangulation {
  std::map<std::pair<size_t, EntityId>, std::vector<Vec3u>> parts;
  std::vector<Vec3f> normals;
};

Triangulation TriangulateCells(const Park& park, const std::vector<Cell>& leaves, Lattice& lattice) {
  const std::vector<Vec3f>& points = lattice.points();
  Triangulation out;
  out.normals.resize(points.size());
  std::vector<uint32_t> border;
  for (const Cell& c : leaves) {
    border.clear();
    const int x1 = c.x + c.size, y1 = c.y + c.size;
    AddBorder(lattice, c.x, c.y, x1, c.y, border);
    AddBorder(lattice, x1, c.y, x1, y1, border);
    AddBorder(lattice, x1, y1, c.x, y1, border);
    AddBorder(lattice, c.x, y1, c.x, c.y, border);
    const uint32_t middle = lattice.At(c.x + c.size / 2, c.y + c.size / 2);
    auto& triangles = out.parts[{LevelOf(c), park.lawns.At(c.middle())}];
    for (size_t i = 0; i < border.size(); ++i) {
      const uint32_t a = border[i], b = border[(i + 1) % border.size()];
      triangles.push_back({middle, a, b});
      const Vec3f n = Cross(points[a] - points[middle], points[b] - points[middle]);
      for (uint32_t k : {middle, a, b}) out.normals[k] += n;
    }
  }
  return out;
}

// The vertices have the uv of the level's picture.
Mesh MeshOfLevel(const Park& park, size_t level, const std::vector<Vec3f>& points, const Triangulation& ground) {
  Mesh mesh;
  mesh.name = "terrain " + std::to_string(level);
  std::vector<uint32_t> index(points.size(), 0xffffffffu);
  const float half = kGroundSquares[level];
  for (const auto& [key, triangles] : ground.parts) {
    if (key.first != level) continue;
    mesh.parts.push_back(
        {static_cast<uint32_t>(mesh.triangles.size()), static_cast<uint32_t>(triangles.size()), park.materials.ground[level], key.second});
    for (Vec3u t : triangles) {
      for (uint32_t* k : {&t.x, &t.y, &t.z}) {
        uint32_t& to = index[*k];
        if (to == 0xffffffffu) {
          to = static_cast<uint32_t>(mesh.positions.size());
          const Vec3f p = points[*k];
          mesh.positions.push_back(p);
          mesh.normals.push_back(Normalized(ground.normals[*k]));
          mesh.uvs.push_back({0.5f + 0.5f * p.x / half, 0.5f - 0.5f * p.y / half});
        }
        *k = to;
      }
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace

size_t LayTerrain(Park& park) {
  std::vector<Cell> leaves;
  Subdivide(park.layout, {-kRoot / 2, -kRoot / 2, kRoot}, leaves);
  Lattice lattice(leaves);
  lattice.Raise(park.layout);
  const Triangulation ground = TriangulateCells(park, leaves, lattice);
  size_t total = 0;
  for (size_t level = 0; level < kGroundSquares.size(); ++level) {
    Mesh mesh = MeshOfLevel(park, level, lattice.points(), ground);
    total += mesh.triangles.size();
    if (mesh.triangles.empty()) continue;
    park.builder.AddInstance({park.builder.AddMesh(std::move(mesh)), {}, kNoEntity});
  }
  return total;
}

}  // namespace airsim360::internal::park

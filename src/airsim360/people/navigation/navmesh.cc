#include "airsim360/people/navigation/navmesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/archive.h"
#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/people/navigation/crossings.h"
#include "airsim360/people/navigation/ground_height.h"
#include "airsim360/people/navigation/polygon2d.h"
#include "airsim360/people/navigation/recast_mesh.h"

namespace airsim360 {

using internal::NavGraph;
using internal::NavPolygon;

struct NavMesh::Impl {
  NavGraph graph;
  std::unique_ptr<internal::RecastMesh> recast;
  internal::GroundHeights heights;
  internal::OpenShares shares;
  std::vector<Crossing> crossings;
  internal::BucketGrid crossing_grid;
  Box3f bounds;

  /// What follows from the rest.
  void Finish();
};

namespace {

// Worlds larger than that get a mesh around their spawn or middle, unless more of them is asked for.
constexpr double kLargest = 400;
constexpr double kMaxArea = 1500.0 * 1500;        // square metres: of a town some two and a half minutes of a processor
constexpr double kStepUp = 0.4, kStepDown = 0.6;  // metres: from where someone stands to where a foot may come

internal::TileGrid GridOf(const Scene& scene, const NavMeshOptions& options) {
  const Box3f box = NavMeshRegion(scene, options);
  // A whole number of cells a tile.
  internal::TileGrid grid;
  grid.edge = std::max(1.0, std::round(options.tile / options.cell)) * options.cell;
  grid.x0 = std::floor(box.min.x / options.cell) * options.cell;
  grid.y0 = std::floor(box.min.y / options.cell) * options.cell;
  grid.columns = std::max(1, static_cast<int>(std::ceil((box.max.x - grid.x0) / grid.edge)));
  grid.rows = std::max(1, static_cast<int>(std::ceil((box.max.y - grid.y0) / grid.edge)));
  return grid;
}

// Everything that the mesh depends on: the scene's key leaves out labels that were changed since.
CacheKey KeyOf(const Scene& scene, const internal::TileGrid& grid, const NavMeshOptions& options) {
  CacheKey key("navmesh", 2);
  key.AddProgram().Add(scene.cache_key);
  for (const double value :
       {options.cell, options.person_radius, options.person_height, options.step_height, options.steepest_deg, options.tile})
    key.Add(value);
  key.Add(grid.x0).Add(grid.y0).Add(grid.edge).Add(grid.columns).Add(grid.rows);
  std::string categories;
  for (const Entity& entity : scene.entities) categories += scene.tree[entity.category].path + '\n';
  return key.Add(categories);
}

}  // namespace

Box3f NavMeshRegion(const Scene& scene, const NavMeshOptions& options) {
  if (scene.bounds.empty()) throw InputError("people need ground to walk on: the world '" + scene.name + "' is empty");
  Box3f box = options.region.value_or(scene.bounds);
  if (!options.region) {
    const Vec3f middle = scene.spawn.value_or(box.center());
    const auto half = static_cast<float>(kLargest / 2);
    for (int k = 0; k < 2; ++k) {
      if (box.size()[k] <= kLargest) continue;
      const float at = std::clamp(middle[k], box.min[k] + half, box.max[k] - half);
      box.min[k] = at - half;
      box.max[k] = at + half;
    }
  }
  box.min = Max(box.min, scene.bounds.min);
  box.max = Min(box.max, scene.bounds.max);
  if (box.min.x >= box.max.x || box.min.y >= box.max.y)
    throw InputError("people need ground to walk on: the region lies outside the world '" + scene.name + "'");
  const Vec3f size = box.size();
  if (static_cast<double>(size.x) * size.y > kMaxArea) {
    char text[160];
    std::snprintf(text, sizeof(text), "people would walk over %.0f m x %.0f m of the world; %.2f km2 is the most that they can", size.x,
                  size.y, kMaxArea / 1e6);
    throw InputError(text);
  }
  return box;
}

NavMesh::NavMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
NavMesh::~NavMesh() = default;

std::shared_ptr<const NavMesh> NavMesh::Build(const Scene& scene, const NavMeshOptions& options) {
  return Build(scene, options, DiskCache::OfUser());
}

std::shared_ptr<const NavMesh> NavMesh::Build(const Scene& scene, const NavMeshOptions& options, const DiskCache& cache) {
  const internal::TileGrid grid = GridOf(scene, options);
  const bool keeps = !scene.cache_key.empty() && !cache.folder().empty();
  const CacheKey key = KeyOf(scene, grid, options);
  std::unique_ptr<Impl> impl;
  if (keeps)
    if (const auto kept = cache.Load(key)) impl = FromArchive(scene, grid, options, kept->bytes());
  if (!impl) {
    Bytes archive;
    impl = BuildAnew(scene, grid, options, keeps ? &archive : nullptr);
    if (keeps) cache.Store(key, archive);
  }
  impl->Finish();
  return std::shared_ptr<const NavMesh>(new NavMesh(std::move(impl)));
}

void NavMesh::Impl::Finish() {
  for (const NavPolygon& polygon : graph.polygons)
    for (int i = 0; i < polygon.corners; ++i) bounds.Add(VecCast<float>(Vec3d{polygon.corner[i].x, polygon.corner[i].y, polygon.z[i]}));
  crossing_grid = internal::BucketGrid(graph.min, graph.max, 6);
  for (uint32_t i = 0; i < crossings.size(); ++i) {
    Vec2d low = crossings[i].outline[0], high = low;
    for (const Vec2d p : crossings[i].outline) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    crossing_grid.Add(i, low, high);
  }
  crossing_grid.Finish();
}

std::unique_ptr<NavMesh::Impl> NavMesh::BuildAnew(const Scene& scene, const internal::TileGrid& grid, const NavMeshOptions& options,
                                                  Bytes* archive) {
  auto impl = std::make_unique<Impl>();
  const double margin = (std::ceil(options.person_radius / options.cell) + 6) * options.cell;
  const internal::GroundSource source(scene, grid, margin);
  impl->crossings = internal::FindCrossings(scene);
  impl->recast = std::make_unique<internal::RecastMesh>(grid, options);

  // Tiles side by side; only those at work hold their triangles.
  std::vector<std::vector<internal::GroundTriangle>> ground(static_cast<size_t>(grid.count()));
  ParallelFor(grid.count(), [&](int64_t tile) {
    std::vector<internal::GroundTriangle> obstacles;
    std::vector<internal::GroundTriangle>& below = ground[static_cast<size_t>(tile)];
    source.Gather(static_cast<int>(tile), options.person_height + 0.3, below, obstacles);
    impl->recast->BuildTile(static_cast<int>(tile), {below, obstacles, impl->crossings});
  });
  ArchiveWriter writer;
  for (int tile = 0; archive && tile < grid.count(); ++tile) writer(impl->recast->TileBytes(tile));
  impl->graph = impl->recast->Join();
  if (impl->graph.polygons.empty()) throw InputError("people need ground to walk on: the world '" + scene.name + "' has none");

  // Heights and open space over what came out.
  for (std::vector<internal::GroundTriangle>& triangles : ground) {
    impl->heights.Add(triangles);
    triangles = {};
  }
  impl->heights.Finish(impl->graph.min, impl->graph.max);
  impl->shares.Build(impl->graph, options.person_radius);
  if (!archive) return impl;
  impl->heights.Visit(writer);
  impl->shares.Visit(writer);
  *archive = writer.Take();
  return impl;
}

std::unique_ptr<NavMesh::Impl> NavMesh::FromArchive(const Scene& scene, const internal::TileGrid& grid, const NavMeshOptions& options,
                                                    std::span<const std::byte> bytes) {
  try {
    auto impl = std::make_unique<Impl>();
    ArchiveReader reader(bytes);
    impl->crossings = internal::FindCrossings(scene);
    impl->recast = std::make_unique<internal::RecastMesh>(grid, options);
    for (int tile = 0; tile < grid.count(); ++tile) {
      std::vector<std::byte> tile_bytes;
      reader(tile_bytes);
      impl->recast->SetTile(tile, tile_bytes);
    }
    impl->graph = impl->recast->Join();
    impl->heights.Visit(reader);
    impl->shares.Visit(reader);
    if (reader.done() && !impl->graph.polygons.empty()) return impl;
  } catch (const InputError&) {  // built anew
  }
  return nullptr;
}

NavPoint NavMesh::Nearest(Vec3d p_W, double reach) const {
  NavPoint point = impl_->graph.Nearest(p_W, reach);
  if (point.valid()) point.p_W.z = impl_->heights.At(point.p_W.x, point.p_W.y, point.p_W.z, 2);
  return point;
}

NavPoint NavMesh::Move(const NavPoint& start, Vec2d target) const {
  NavPoint end = impl_->graph.Walk(start.polygon, {start.p_W.x, start.p_W.y}, target, true, nullptr);
  end.p_W.z = GroundHeight(end.p_W.x, end.p_W.y, start.p_W.z);
  return end;
}

NavPoint NavMesh::Along(const NavPoint& start, Vec2d target) const {
  NavPoint end = impl_->graph.Walk(start.polygon, {start.p_W.x, start.p_W.y}, target, false, nullptr);
  end.p_W.z = GroundHeight(end.p_W.x, end.p_W.y, start.p_W.z);
  return end;
}

bool NavMesh::Straight(const NavPoint& start, Vec2d target) const {
  bool stopped = false;
  const NavPoint end = impl_->graph.Walk(start.polygon, {start.p_W.x, start.p_W.y}, target, false, &stopped);
  return !stopped && std::abs(end.p_W.x - target.x) + std::abs(end.p_W.y - target.y) < 1e-6;
}

NavPath NavMesh::FindPath(const NavPoint& start, const NavPoint& goal) const {
  return impl_->recast->FindPath(impl_->graph.polygons[start.polygon].reference, start.p_W, impl_->graph.polygons[goal.polygon].reference,
                                 goal.p_W);
}

uint32_t NavMesh::Component(const NavPoint& point) const { return impl_->graph.polygons[point.polygon].component; }
GroundKind NavMesh::Kind(const NavPoint& point) const { return impl_->graph.polygons[point.polygon].kind; }

int NavMesh::CrossingAt(Vec2d p) const {
  for (const uint32_t i : impl_->crossing_grid.At(p))
    if (InPolygon(impl_->crossings[i].outline, p)) return static_cast<int>(i);
  return -1;
}

double NavMesh::GroundHeight(double x, double y, double z) const { return impl_->heights.StepAt(x, y, z, kStepUp, kStepDown); }
double NavMesh::OpenShare(Vec2d p) const { return impl_->shares.At(p); }
std::span<const uint32_t> NavMesh::WallsNear(Vec2d p) const { return impl_->graph.wall_grid.At(p); }

NavArea NavMesh::AreaOf(std::span<const Vec2d> outline, uint32_t kinds) const {
  std::vector<NavArea> areas = AreasOf(outline, kinds, 0);
  if (!areas.empty()) return std::move(areas.front());
  NavArea none;
  none.outline.assign(outline.begin(), outline.end());
  return none;
}

std::vector<NavArea> NavMesh::AreasOf(std::span<const Vec2d> outline, uint32_t kinds, double least) const {
  // Square metres inside the outline by the connected part they belong to.
  std::vector<double> inside(impl_->graph.components, 0), share(impl_->graph.polygons.size(), 0);
  for (uint32_t i = 0; i < impl_->graph.polygons.size(); ++i) {
    const NavPolygon& polygon = impl_->graph.polygons[i];
    if (!(kinds >> static_cast<int>(polygon.kind) & 1)) continue;
    share[i] = outline.empty() ? polygon.area : internal::ClippedArea(outline, std::span(polygon.corner, polygon.corners));
    inside[polygon.component] += share[i];
  }
  std::vector<uint32_t> order;
  for (uint32_t c = 0; c < inside.size(); ++c)
    if (inside[c] >= least) order.push_back(c);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return inside[a] > inside[b]; });
  if (least <= 0 && order.size() > 1) order.resize(1);
  std::vector<NavArea> areas;
  for (const uint32_t component : order) {
    NavArea& area = areas.emplace_back();
    area.outline.assign(outline.begin(), outline.end());
    area.component = component;
    area.square_metres = inside[component];
    double sum = 0;
    for (uint32_t i = 0; i < impl_->graph.polygons.size(); ++i) {
      if (impl_->graph.polygons[i].component != component || share[i] < 1e-4) continue;
      area.polygons.push_back(i);
      area.cumulative.push_back(sum += share[i]);
    }
  }
  return areas;
}

NavPoint NavMesh::Pick(const NavArea& area, RngStream& rng) const {
  NavPoint point;
  for (int attempt = 0; attempt < 64; ++attempt) {
    // A polygon by its share, then a triangle of its fan, then a place in it; inside the outline or again.
    const double u = rng.Uniform() * area.cumulative.back();
    const auto at = std::upper_bound(area.cumulative.begin(), area.cumulative.end() - 1, u) - area.cumulative.begin();
    const uint32_t index = area.polygons[static_cast<size_t>(at)];
    const NavPolygon& polygon = impl_->graph.polygons[index];
    const Vec2d p = internal::PointInFan(std::span(polygon.corner, polygon.corners), rng);
    point = {index, {p.x, p.y, 0}};
    if (area.outline.empty() || InPolygon(area.outline, p)) break;
  }
  const Vec2d p{point.p_W.x, point.p_W.y};
  if (!area.outline.empty() && !InPolygon(area.outline, p)) return {};
  point.p_W.z = impl_->heights.At(p.x, p.y, impl_->graph.HeightIn(point.polygon, p), 2);
  return point;
}

std::span<const NavMesh::Crossing> NavMesh::crossings() const { return impl_->crossings; }
std::span<const NavWall> NavMesh::walls() const { return impl_->graph.walls; }
Box3f NavMesh::bounds() const { return impl_->bounds; }
size_t NavMesh::polygon_count() const { return impl_->graph.polygons.size(); }

std::vector<Vec3d> NavMesh::PolygonOutline(uint32_t index) const {
  const NavPolygon& polygon = impl_->graph.polygons[index];
  std::vector<Vec3d> outline;
  for (int i = 0; i < polygon.corners; ++i) outline.push_back({polygon.corner[i].x, polygon.corner[i].y, polygon.z[i]});
  return outline;
}

size_t NavMesh::memory_bytes() const {
  const NavGraph& graph = impl_->graph;
  return impl_->recast->memory_bytes() + impl_->heights.memory_bytes() + impl_->shares.memory_bytes() +
         graph.polygons.size() * sizeof(NavPolygon) + graph.portals.size() * sizeof(internal::NavPortal) +
         graph.walls.size() * sizeof(NavWall) + graph.polygon_grid.memory_bytes() + graph.wall_grid.memory_bytes();
}

}  // namespace airsim360

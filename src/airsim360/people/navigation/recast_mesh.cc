#include "airsim360/people/navigation/recast_mesh.h"

#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/DetourNavMeshQuery.h>
#include <recastnavigation/Recast.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>

#include "airsim360/base/error.h"
#include "airsim360/people/navigation/tile_regions.h"

namespace airsim360::internal {
namespace {

// Recast is y up: W (x, y, z) <-> (x, z, -y).
struct Point3 {
  float v[3];
};
Point3 ToRecast(Vec3d p) { return {{static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y)}}; }
Vec3d FromRecast(const float* v) { return {v[0], -v[2], v[1]}; }

constexpr float kCellHeight = 0.05f;
constexpr int kLeastCells = 64, kMergedCells = 400;  // of a region
constexpr int kSplinter = 9;                         // cells: less of a region is left at the edge of a tile
constexpr int kMaxPathPolygons = 8192, kMaxCorners = 1024;
// Detour counts the nodes of a search in 16 bits, and a town of a kilometre has three times as many polygons: a long way is
// made of several searches, each from where the one before got to.
constexpr int kMaxSearches = 8;
constexpr double kPassing = 0.2;  // metres: half of what the middles of two people who pass need

template <class T, void (*Free)(T*)>
struct Freer {
  void operator()(T* pointer) const { Free(pointer); }
};
using Heightfield = std::unique_ptr<rcHeightfield, Freer<rcHeightfield, rcFreeHeightField>>;
using Compact = std::unique_ptr<rcCompactHeightfield, Freer<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using Contours = std::unique_ptr<rcContourSet, Freer<rcContourSet, rcFreeContourSet>>;
using PolyMesh = std::unique_ptr<rcPolyMesh, Freer<rcPolyMesh, rcFreePolyMesh>>;
using Mesh = std::unique_ptr<dtNavMesh, Freer<dtNavMesh, dtFreeNavMesh>>;
using Query = std::unique_ptr<dtNavMeshQuery, Freer<dtNavMeshQuery, dtFreeNavMeshQuery>>;

dtQueryFilter Filter() {
  dtQueryFilter filter;
  for (int kind = 0; kind < static_cast<int>(GroundKind::kCount); ++kind)
    filter.setAreaCost(kind, static_cast<float>(GroundCost(static_cast<GroundKind>(kind))));
  return filter;
}

}  // namespace

struct RecastMesh::Impl {
  TileGrid grid;
  NavMeshOptions options;
  struct TileData {
    unsigned char* bytes = nullptr;
    int size = 0;
  };
  std::vector<TileData> tiles;
  Mesh mesh;
  std::vector<uint32_t> references;  // Detour's, by polygon of the graph; the graph's own are its indices
  dtQueryFilter filter = Filter();
  mutable std::mutex mutex;
  mutable std::vector<Query> queries;  // idle ones
  size_t bytes = 0;

  ~Impl() {
    for (const TileData& tile : tiles) dtFree(tile.bytes);
  }
  // Detour counts rows along its z, which is -y.
  int DetourRow(int row) const { return grid.rows - 1 - row; }
};

RecastMesh::RecastMesh(const TileGrid& grid, const NavMeshOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->grid = grid;
  impl_->options = options;
  impl_->tiles.resize(static_cast<size_t>(grid.count()));
}
RecastMesh::~RecastMesh() = default;

namespace {

/// One tile from spans to polygons.
class TileBuilder {
 public:
  TileBuilder(const TileGrid& grid, const NavMeshOptions& options, int tile) : options_(options), context_(false) {
    cell_ = static_cast<float>(options.cell);
    climb_ = static_cast<int>(std::floor(options.step_height / kCellHeight));
    height_ = static_cast<int>(std::ceil(options.person_height / kCellHeight));
    radius_ = static_cast<int>(std::ceil(options.person_radius / options.cell - 1e-6));
    border_ = radius_ + 5;  // what CloseNarrowWays looks at counts
    cells_ = static_cast<int>(std::lround(grid.edge / options.cell));
    x0_ = grid.x0 + (tile % grid.columns) * grid.edge;
    y0_ = grid.y0 + (tile / grid.columns) * grid.edge;
    edge_ = grid.edge;
  }

  /// False: nothing to walk on.
  bool Run(const TileInput& input) { return Raster(input) && Shape(input) && Polygons(); }
  const rcPolyMesh& mesh() const { return *mesh_; }
  float cell() const { return cell_; }

 private:
  bool Raster(const TileInput& input) {
    float low = 1e9f, high = -1e9f;
    for (const GroundTriangle& triangle : input.ground)
      for (const Vec3f& p : triangle.p) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
      }
    if (input.ground.empty()) return false;
    const float around = static_cast<float>(border_) * cell_;
    const float x0 = static_cast<float>(x0_), z0 = static_cast<float>(-(y0_ + edge_)), edge = static_cast<float>(edge_);
    min_ = {{x0 - around, low - 1, z0 - around}};
    max_ = {{x0 + edge + around, high + 3, z0 + edge + around}};
    solid_.reset(rcAllocHeightfield());
    const int n = cells_ + 2 * border_;
    if (!rcCreateHeightfield(&context_, *solid_, n, n, min_.v, max_.v, cell_, kCellHeight)) throw std::bad_alloc();

    // What is too steep is no ground; what stands on the ground higher than a book is an obstacle.
    const float flattest = static_cast<float>(std::cos(options_.steepest_deg * 3.14159265358979 / 180));
    const auto raster = [&](const GroundTriangle& triangle, int merge) {
      Point3 p[3];
      for (int k = 0; k < 3; ++k) p[k] = ToRecast(VecCast<double>(triangle.p[k]));
      const Vec3f normal = Normalized(airsim360::Cross(triangle.p[1] - triangle.p[0], triangle.p[2] - triangle.p[0]));
      const bool flat = std::abs(normal.z) >= flattest;
      rcRasterizeTriangle(&context_, p[0].v, p[1].v, p[2].v, flat ? static_cast<unsigned char>(triangle.kind) : RC_NULL_AREA, *solid_,
                          merge);
    };
    for (const GroundTriangle& triangle : input.ground) raster(triangle, climb_);
    for (const GroundTriangle& triangle : input.obstacles) raster(triangle, 1);
    return true;
  }

  bool Shape(const TileInput& input) {
    rcFilterLedgeSpans(&context_, height_, climb_, *solid_);
    rcFilterWalkableLowHeightSpans(&context_, height_, *solid_);
    compact_.reset(rcAllocCompactHeightfield());
    if (!rcBuildCompactHeightfield(&context_, height_, climb_, *solid_, *compact_)) return false;
    solid_.reset();
    for (const NavMesh::Crossing& crossing : input.crossings) {
      std::vector<float> outline;
      for (const Vec2d& p : crossing.outline) {
        const Point3 q = ToRecast({p.x, p.y, 0});
        outline.insert(outline.end(), q.v, q.v + 3);
      }
      rcMarkConvexPolyArea(&context_, outline.data(), static_cast<int>(crossing.outline.size()), min_.v[1], max_.v[1],
                           static_cast<unsigned char>(GroundKind::kCrossing), *compact_);
    }
    if (!rcErodeWalkableArea(&context_, radius_, *compact_) || !CloseNarrowWays()) return false;
    JoinSpecks(kLeastCells, *compact_);
    if (!rcBuildDistanceField(&context_, *compact_) || !rcBuildRegions(&context_, *compact_, border_, kLeastCells, kMergedCells))
      return false;
    TakeInStrays(kSplinter, *compact_);
    PartCorners(*compact_);
    return true;
  }

  // Outdoors, ways in which two people cannot pass each other are none: they would stand head on for ever. What
  // is left after taking kPassing from all sides and giving it back stays; doors of houses stay in any case.
  bool CloseNarrowWays() {
    const std::vector<unsigned char> before(compact_->areas, compact_->areas + compact_->spanCount);
    const int passing = static_cast<int>(std::lround(kPassing / cell_));
    if (!rcErodeWalkableArea(&context_, passing, *compact_)) return false;
    std::vector<unsigned char> now(compact_->areas, compact_->areas + compact_->spanCount), next;
    for (int pass = 0; pass < passing; ++pass) {
      next = now;
      for (int y = 0; y < compact_->height; ++y)
        for (int x = 0; x < compact_->width; ++x) Widen(x, y, before, now, next);
      now.swap(next);
    }
    for (size_t i = 0; i < before.size(); ++i) {
      const auto kind = static_cast<GroundKind>(before[i]);
      const bool indoors = kind == GroundKind::kFloor || kind == GroundKind::kStairs;
      compact_->areas[i] = indoors || now[i] != RC_NULL_AREA ? before[i] : RC_NULL_AREA;
    }
    return true;
  }
  void Widen(int x, int y, const std::vector<unsigned char>& before, const std::vector<unsigned char>& now,
             std::vector<unsigned char>& next) const {
    const rcCompactCell& cell = compact_->cells[x + y * compact_->width];
    for (size_t i = cell.index; i < size_t{cell.index} + cell.count; ++i) {
      if (now[i] != RC_NULL_AREA || before[i] == RC_NULL_AREA) continue;
      // Beside it or, around a corner, beside that.
      for (int side = 0; side < 4 && next[i] == RC_NULL_AREA; ++side) {
        const int beside = Beside(x, y, static_cast<int>(i), side);
        if (beside < 0) continue;
        const int bx = x + rcGetDirOffsetX(side), by = y + rcGetDirOffsetY(side);
        const int around = Beside(bx, by, beside, (side + 1) & 3);
        if (now[static_cast<size_t>(beside)] != RC_NULL_AREA || (around >= 0 && now[static_cast<size_t>(around)] != RC_NULL_AREA))
          next[i] = before[i];
      }
    }
  }
  /// Span on a side of a span; -1: none.
  int Beside(int x, int y, int span, int side) const {
    const int connection = rcGetCon(compact_->spans[span], side);
    if (connection == RC_NOT_CONNECTED) return -1;
    const int bx = x + rcGetDirOffsetX(side), by = y + rcGetDirOffsetY(side);
    return static_cast<int>(compact_->cells[bx + by * compact_->width].index) + connection;
  }

  bool Polygons() {
    Contours contours(rcAllocContourSet());
    const int longest = static_cast<int>(12 / cell_);
    if (!rcBuildContours(&context_, *compact_, 0.8f, longest, *contours)) return false;
    compact_.reset();
    mesh_.reset(rcAllocPolyMesh());
    if (!rcBuildPolyMesh(&context_, *contours, kMaxPolygonCorners, *mesh_)) return false;
    for (int i = 0; i < mesh_->npolys; ++i) mesh_->flags[i] = 1;
    return mesh_->npolys > 0 && mesh_->nverts >= 3;
  }

  const NavMeshOptions& options_;
  rcContext context_;
  float cell_;
  int climb_, height_, radius_, border_, cells_;
  double x0_, y0_, edge_;
  Point3 min_{}, max_{};
  Heightfield solid_;
  Compact compact_;
  PolyMesh mesh_;
};

using PolygonNumbers = std::map<dtPolyRef, uint32_t>;

/// Corners counter-clockwise; true if Detour has them the other way round.
bool SetCorners(const dtMeshTile& tile, const dtPoly& poly, NavPolygon& polygon) {
  const int n = polygon.corners = poly.vertCount;
  for (int i = 0; i < n; ++i) {
    const Vec3d p = FromRecast(&tile.verts[poly.verts[i] * 3]);
    polygon.corner[i] = {p.x, p.y};
    polygon.z[i] = static_cast<float>(p.z);
  }
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2d a = polygon.corner[i], b = polygon.corner[(i + 1) % n];
    area += a.x * b.y - a.y * b.x;
  }
  if (area >= 0) return false;
  std::reverse(polygon.corner, polygon.corner + n);
  std::reverse(polygon.z, polygon.z + n);
  return true;
}

/// The openings to neighbours, in the order of the edges and along each.
void AddPortals(const dtMeshTile& tile, const dtPoly& poly, const PolygonNumbers& index, bool turned, NavPolygon& polygon,
                std::vector<NavPortal>& portals) {
  const int n = polygon.corners;
  std::vector<NavPortal> of_edge[kMaxPolygonCorners];
  for (unsigned k = poly.firstLink; k != DT_NULL_LINK; k = tile.links[k].next) {
    const dtLink& link = tile.links[k];
    const auto found = index.find(link.ref);
    if (found == index.end()) continue;
    float t0 = 0, t1 = 1;
    if (link.side != 0xff) {
      t0 = static_cast<float>(link.bmin) / 255;
      t1 = static_cast<float>(link.bmax) / 255;
    }
    int edge = link.edge;
    if (turned) {
      // Corner i was n - 1 - i; the edge from it goes back along the old edge n - 2 - i.
      edge = (2 * n - 2 - edge) % n;
      const float kept = t0;
      t0 = 1 - t1;
      t1 = 1 - kept;
    }
    of_edge[edge].push_back({found->second, t0, t1});
  }
  for (int i = 0; i < n; ++i) {
    std::sort(of_edge[i].begin(), of_edge[i].end(),
              [](const NavPortal& a, const NavPortal& b) { return a.t0 != b.t0 ? a.t0 < b.t0 : a.neighbour < b.neighbour; });
    polygon.first_portal[i] = static_cast<uint32_t>(portals.size());
    portals.insert(portals.end(), of_edge[i].begin(), of_edge[i].end());
  }
  for (int i = n; i <= kMaxPolygonCorners; ++i) polygon.first_portal[i] = static_cast<uint32_t>(portals.size());
}

}  // namespace

void RecastMesh::BuildTile(int tile, const TileInput& input) {
  const TileGrid& grid = impl_->grid;
  TileBuilder builder(grid, impl_->options, tile);
  if (!builder.Run(input)) return;
  const rcPolyMesh& mesh = builder.mesh();
  dtNavMeshCreateParams params;
  std::memset(&params, 0, sizeof(params));
  params.verts = mesh.verts;
  params.vertCount = mesh.nverts;
  params.polys = mesh.polys;
  params.polyAreas = mesh.areas;
  params.polyFlags = mesh.flags;
  params.polyCount = mesh.npolys;
  params.nvp = mesh.nvp;
  params.tileX = tile % grid.columns;
  params.tileY = impl_->DetourRow(tile / grid.columns);
  std::copy_n(mesh.bmin, 3, params.bmin);
  std::copy_n(mesh.bmax, 3, params.bmax);
  params.walkableHeight = static_cast<float>(impl_->options.person_height);
  params.walkableRadius = static_cast<float>(impl_->options.person_radius);
  params.walkableClimb = static_cast<float>(impl_->options.step_height);
  params.cs = builder.cell();
  params.ch = kCellHeight;
  Impl::TileData& data = impl_->tiles[static_cast<size_t>(tile)];
  if (!dtCreateNavMeshData(&params, &data.bytes, &data.size)) data = {};
}

std::vector<std::byte> RecastMesh::TileBytes(int tile) const {
  const Impl::TileData& data = impl_->tiles[static_cast<size_t>(tile)];
  const auto* first = reinterpret_cast<const std::byte*>(data.bytes);
  return {first, first + data.size};
}

void RecastMesh::SetTile(int tile, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (bytes.size() < sizeof(dtMeshHeader)) throw InputError("a tile of the navigation mesh is cut off");
  Impl::TileData& data = impl_->tiles[static_cast<size_t>(tile)];
  data.size = static_cast<int>(bytes.size());
  data.bytes = static_cast<unsigned char*>(dtAlloc(data.size, DT_ALLOC_PERM));
  if (!data.bytes) throw std::bad_alloc();
  std::memcpy(data.bytes, bytes.data(), bytes.size());
}

void RecastMesh::AddTiles() {
  // Detour's 32-bit references hold 22 bits of tile and polygon.
  const TileGrid& grid = impl_->grid;
  dtNavMeshParams params;
  std::memset(&params, 0, sizeof(params));
  const int tile_bits = std::min<int>(14, std::bit_width(static_cast<unsigned>(grid.count() - 1)));
  params.orig[0] = static_cast<float>(grid.x0);
  params.orig[2] = static_cast<float>(-(grid.y0 + grid.rows * grid.edge));
  params.tileWidth = params.tileHeight = static_cast<float>(grid.edge);
  params.maxTiles = 1 << tile_bits;
  params.maxPolys = 1 << (22 - tile_bits);
  impl_->mesh.reset(dtAllocNavMesh());
  if (dtStatusFailed(impl_->mesh->init(&params))) throw InputError("the world is too large for a navigation mesh");
  for (Impl::TileData& tile : impl_->tiles) {
    if (!tile.bytes) continue;
    const auto* header = reinterpret_cast<const dtMeshHeader*>(tile.bytes);
    if (header->polyCount >= params.maxPolys) throw InputError("the ground is too broken up for a navigation mesh");
    impl_->bytes += static_cast<size_t>(tile.size);
    if (dtStatusSucceed(impl_->mesh->addTile(tile.bytes, tile.size, DT_TILE_FREE_DATA, 0, nullptr))) tile = {};
  }
}

NavGraph RecastMesh::Join() {
  AddTiles();
  const dtNavMesh& mesh = *impl_->mesh;
  const auto each = [&](const auto& visit) {
    for (int t = 0; t < mesh.getMaxTiles(); ++t) {
      const dtMeshTile* tile = mesh.getTile(t);
      if (!tile->header) continue;
      for (int p = 0; p < tile->header->polyCount; ++p) visit(*tile, tile->polys[p], mesh.getPolyRefBase(tile) | static_cast<dtPolyRef>(p));
    }
  };
  // Number the polygons in the order of the tiles.
  PolygonNumbers index;
  each([&](const dtMeshTile&, const dtPoly&, dtPolyRef ref) {
    index.emplace(ref, static_cast<uint32_t>(impl_->references.size()));
    impl_->references.push_back(ref);
  });
  NavGraph graph;
  each([&](const dtMeshTile& tile, const dtPoly& poly, dtPolyRef ref) {
    NavPolygon polygon;
    polygon.reference = index[ref];
    polygon.kind = static_cast<GroundKind>(poly.getArea());
    const bool turned = SetCorners(tile, poly, polygon);
    AddPortals(tile, poly, index, turned, polygon, graph.portals);
    graph.polygons.push_back(polygon);
  });
  if (!graph.polygons.empty()) graph.Finish();
  return graph;
}

namespace {

/// Polygons from start to goal, or to the nearest that can be reached.
std::vector<dtPolyRef> Corridor(const dtNavMeshQuery& query, const dtQueryFilter& filter, dtPolyRef start, dtPolyRef goal, const float* a,
                                const float* b) {
  std::vector<dtPolyRef> corridor, leg(kMaxPathPolygons);
  Point3 from{{a[0], a[1], a[2]}};
  for (int search = 0; search < kMaxSearches; ++search) {
    int count = 0;
    const dtStatus status = query.findPath(start, goal, from.v, b, &filter, leg.data(), &count, kMaxPathPolygons);
    if (dtStatusFailed(status) || count == 0) break;
    // Each leg begins where the last one ends; what leads into a dead end and out again is left out.
    for (int k = 0; k < count; ++k) {
      if (search > 0) corridor.erase(std::find(corridor.begin(), corridor.end(), leg[static_cast<size_t>(k)]), corridor.end());
      corridor.push_back(leg[static_cast<size_t>(k)]);
    }
    if (corridor.back() == goal || corridor.back() == start || !dtStatusDetail(status, DT_OUT_OF_NODES)) break;
    start = corridor.back();
    Point3 on = from;
    query.closestPointOnPoly(start, from.v, on.v, nullptr);
    from = on;
  }
  return corridor;
}

}  // namespace

NavPath RecastMesh::FindPath(uint32_t from, Vec3d start, uint32_t to, Vec3d goal) const {
  // A searcher of one's own while this runs.
  Query query;
  {
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->queries.empty()) {
      query = std::move(impl_->queries.back());
      impl_->queries.pop_back();
    }
  }
  if (!query) {
    query.reset(dtAllocNavMeshQuery());
    const int nodes = static_cast<int>(
        std::clamp<size_t>(impl_->references.size() * 2, 64, static_cast<size_t>(std::clamp(impl_->options.search_nodes, 64, 65535))));
    if (dtStatusFailed(query->init(impl_->mesh.get(), nodes))) throw std::bad_alloc();
  }

  // Polygons along the way, then the taut string through them.
  NavPath path;
  const Point3 a = ToRecast(start), b = ToRecast(goal);
  const dtPolyRef start_ref = impl_->references[from], goal_ref = impl_->references[to];
  const std::vector<dtPolyRef> corridor = Corridor(*query, impl_->filter, start_ref, goal_ref, a.v, b.v);
  if (!corridor.empty()) {
    path.complete = corridor.back() == goal_ref;
    Point3 end = b;
    if (!path.complete) query->closestPointOnPoly(corridor.back(), b.v, end.v, nullptr);
    std::vector<float> corners(3 * kMaxCorners);
    int corner_count = 0;
    query->findStraightPath(a.v, end.v, corridor.data(), static_cast<int>(corridor.size()), corners.data(), nullptr, nullptr, &corner_count,
                            kMaxCorners);
    for (int i = 0; i < corner_count; ++i) path.corners.push_back(FromRecast(&corners[static_cast<size_t>(3 * i)]));
    if (path.complete && !path.corners.empty() && corner_count < kMaxCorners) path.corners.back() = goal;
    for (size_t i = 1; i < path.corners.size(); ++i) path.length += Norm(path.corners[i] - path.corners[i - 1]);
  }
  const std::lock_guard lock(impl_->mutex);
  impl_->queries.push_back(std::move(query));
  return path;
}

size_t RecastMesh::memory_bytes() const { return impl_->bytes + impl_->references.size() * sizeof(uint32_t); }

}  // namespace airsim360::internal

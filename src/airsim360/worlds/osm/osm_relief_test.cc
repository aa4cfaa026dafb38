// The ground of a map from heights: what is unknown, and that everything laid on it lies on it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/worlds/osm/data/osm_data.h"
#include "airsim360/worlds/osm/osm_relief.h"

namespace airsim360::internal {
namespace {

constexpr const char* kReliefFixture = "data/osm/crossing.osm";

// Rolling ground of 8 m around 52 N 5 E, cells of 0.0002 degrees (14 x 22 m).
HeightGrid Hills() {
  HeightGrid grid{150, 150, 4.985, 52.015, 0.0002, 0.0002, {}};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.heights.push_back(static_cast<float>(40 + 4 * std::sin(column * 0.6) * std::cos(row * 0.9)));
  return grid;
}

TEST(FillUnknown, HolesTakeTheHeightsAroundThemAndTheRestStays) {
  constexpr int kSide = 33;
  std::vector<float> plane;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) plane.push_back(50 + 0.5f * static_cast<float>(x));
  std::vector<float> heights = plane;
  for (int y = 10; y < 15; ++y)
    for (int x = 20; x < 25; ++x) heights[static_cast<size_t>(y * kSide + x)] = std::numeric_limits<float>::quiet_NaN();
  FillUnknown(heights, kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto i = static_cast<size_t>(y * kSide + x);
      const bool hole = y >= 10 && y < 15 && x >= 20 && x < 25;
      EXPECT_NEAR(heights[i], plane[i], hole ? 2.0 : 0.0) << x << " " << y;
    }
}

TEST(Relief, UnknownCellsAreNoPits) {
  HeightGrid grid = Hills();
  for (int row = 70; row < 80; ++row)
    for (int column = 70; column < 80; ++column)
      grid.heights[static_cast<size_t>(row * grid.columns + column)] = std::numeric_limits<float>::quiet_NaN();
  const Relief relief(grid, {52, 5, 0}, 1e6);
  for (double x = -200; x <= 200; x += 20) EXPECT_LT(std::abs(relief.At({x, 0})), 9) << x;
  EXPECT_NEAR(relief.zero(), 40, 4.5);
}

TEST(Relief, FollowsTheHeightsOfTheGrid) {
  const HeightGrid grid = Hills();
  const GeoFrame frame({52, 5, 0});
  const Relief relief(grid, {52, 5, 0}, 1e5);
  for (int row = 60; row < 90; ++row)
    for (int column = 60; column < 90; ++column) {
      const Vec3d p =
          frame.ToWorld({grid.latitude_north - (row + 0.5) * grid.cell_lat, grid.longitude_west + (column + 0.5) * grid.cell_lon, 0});
      const auto height = static_cast<double>(grid.heights[static_cast<size_t>(row * grid.columns + column)]);
      // The lattice cuts the bend at a cell's middle by a quarter of a cell at most.
      EXPECT_NEAR(relief.At({p.x, p.y}) + relief.zero(), height, 0.45);
    }
}

TEST(Relief, PiecesOfASplitTriangleCoverItAndLieOnTheGround) {
  const Relief relief(Hills(), {52, 5, 0}, 1e5);
  const Vec2d a{-31.3, 4.1}, b{27.9, -12.7}, c{11.2, 44.4};
  const auto area = [](const std::vector<Vec2d>& ring) {
    double sum = 0;
    for (size_t i = 0; i < ring.size(); ++i) sum += ring[i].x * ring[(i + 1) % ring.size()].y - ring[(i + 1) % ring.size()].x * ring[i].y;
    return sum / 2;
  };
  double sum = 0;
  const auto pieces = relief.Split(a, b, c);
  EXPECT_GT(pieces.size(), 100u);
  for (const std::vector<Vec2d>& piece : pieces) {
    EXPECT_GT(area(piece), 0);
    sum += area(piece);
    Vec2d middle{};
    double height = 0;
    for (Vec2d p : piece) {
      middle = middle + p * (1.0 / static_cast<double>(piece.size()));
      height += relief.At(p) / static_cast<double>(piece.size());
    }
    EXPECT_NEAR(relief.At(middle), height, 1e-6);
  }
  EXPECT_NEAR(sum, area({a, b, c}), 1e-6);
  // And along a line.
  const std::vector<Vec2d> line = relief.Split(a, b);
  EXPECT_EQ(line.front(), a);
  EXPECT_EQ(line.back(), b);
  for (size_t i = 0; i + 1 < line.size(); ++i)
    EXPECT_NEAR(relief.At((line[i] + line[i + 1]) * 0.5), (relief.At(line[i]) + relief.At(line[i + 1])) / 2, 1e-6);
}

TEST(OsmWorld, RoadsPavementsAndMarkingsLieOnRollingGroundInTheirOrder) {
  const auto scene = BuildOsmWorld(kReliefFixture, {.heights = [](const GeoBox&) { return Hills(); }});
  const OsmData data = ReadOsm(kReliefFixture, ReadFile(kReliefFixture));
  const Relief relief(Hills(), data.origin, data.extent.width() * data.extent.depth());
  const auto lift = [&](Vec3f p) { return static_cast<double>(p.z) - relief.At({static_cast<double>(p.x), static_cast<double>(p.y)}); };
  std::map<std::string, std::pair<double, double>> lifts;  // by category: least and greatest
  for (const Instance& instance : scene->instances) {
    const Mesh& mesh = scene->meshes[instance.mesh];
    if (mesh.name != "ground") continue;
    for (const MeshPart& part : mesh.parts) {
      const EntityId id = part.entity != kNoEntity ? part.entity : instance.entity;
      const Entity& entity = scene->entities[id - 1];
      const std::string& path = scene->tree[entity.category].path;
      const bool flat = path == "ground/road" || path == "ground/sidewalk" || path == "ground/lane_marking" || path == "ground/crosswalk" ||
                        path == "ground/grass";
      if (!flat) continue;
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        const Vec3u corner = mesh.triangles[t];
        const Vec3f a = mesh.positions[corner.x], b = mesh.positions[corner.y], c = mesh.positions[corner.z];
        auto [it, fresh] = lifts.try_emplace(path, 1e9, -1e9);
        for (const Vec3f p : {a, b, c, (a + b + c) * (1.0f / 3)}) {
          it->second.first = std::min(it->second.first, lift(p));
          it->second.second = std::max(it->second.second, lift(p));
        }
      }
    }
  }
  ASSERT_TRUE(lifts.contains("ground/lane_marking") && lifts.contains("ground/crosswalk"));
  // Each at one distance from the ground, corners and middles of triangles alike: nothing pierces or floats.
  for (const auto& [path, range] : lifts) EXPECT_LT(range.second - range.first, 0.003) << path << " " << range.first << " " << range.second;
  EXPECT_GT(lifts["ground/lane_marking"].first, lifts["ground/road"].second + 0.002);
  EXPECT_NEAR(lifts["ground/sidewalk"].first, 0, 0.002);
}

}  // namespace
}  // namespace airsim360::internal

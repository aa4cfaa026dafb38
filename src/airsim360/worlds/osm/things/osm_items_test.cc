// Pieces of maps, boxes in headers, and things of maps that are easily lost, each on a small map of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/worlds/osm/buildings/osm_areas.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

OsmData Read(const TestMap& map, const std::optional<MapCut>& cut = {}) { return ReadOsm("test.osm", AsBytes(map.Text()), {}, cut); }

const Entity* Find(const Scene& scene, const std::string& name) {
  for (const Entity& entity : scene.entities)
    if (entity.name == name) return &entity;
  return nullptr;
}

std::string ErrorOf(const TestMap& map, const std::optional<MapCut>& cut = {}) {
  try {
    Read(map, cut);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OsmCut, KeepsWhatReachesIntoThePieceWhole) {
  TestMap map;
  const int inside = map.Box({0, 0}, {10, 10}, {{"building", "yes"}}), outside = map.Box({500, 0}, {510, 10}, {{"building", "yes"}});
  const int road = map.Line({{-900, 20}, {0, 20}, {900, 20}}, {{"highway", "residential"}});
  const int path = map.Line({{900, 900}, {30, 30}}, {{"highway", "path"}});
  map.Node({5, 50}, {{"natural", "tree"}});
  map.Node({300, 50}, {{"natural", "tree"}});
  const MapCut cut = CutByBox("--bbox", TestMap::Lat(-100) + "," + TestMap::Lon(-100) + "," + TestMap::Lat(100) + "," + TestMap::Lon(100));
  const OsmData data = Read(map, cut);
  EXPECT_NE(data.FindWay(inside), nullptr);
  EXPECT_EQ(data.FindWay(outside), nullptr);
  ASSERT_NE(data.FindWay(road), nullptr);
  EXPECT_EQ(data.FindWay(road)->line.size(), 3u);  // also where it leads far out
  EXPECT_NE(data.FindWay(path), nullptr);
  EXPECT_EQ(data.nodes.size(), 1u);
  EXPECT_NEAR(data.extent.width(), 200, 0.01);
  EXPECT_NEAR(data.origin.latitude_deg, 45, 1e-7);
}

TEST(OsmCut, BothOrdersOfNumbersAreTaken) {
  TestMap map;
  map.Box({0, 0}, {10, 10}, {{"building", "yes"}});
  for (const char* text : {"44.999,6.999,45.001,7.001", "6.999,44.999,7.001,45.001"})
    EXPECT_NEAR(Read(map, CutByBox("--bbox", text)).origin.latitude_deg, 45, 1e-3) << text;
  EXPECT_NE(ErrorOf(map, CutByBox("--bbox", "10,10,11,11")).find("--bbox 10,10,11,11"), std::string::npos);
  EXPECT_THROW(CutByBox("--bbox", "1,2,3"), InputError);
  EXPECT_THROW(CutByBox("--bbox", "1,2,3,4,5"), InputError);
  EXPECT_THROW(CutByBox("--bbox", "3,2,1,4"), InputError);
  EXPECT_THROW(CutByBox("--bbox", "1,2,nan,4"), InputError);
  EXPECT_THROW(CutAround("--centre", "45", "--radius", 100), InputError);
  EXPECT_THROW(CutAround("--centre", "45,7", "--radius", 9), InputError);
  EXPECT_THROW(CutAround("--centre", "45,7", "--radius", std::nan("")), InputError);
  const MapCut around = CutAround("--centre", "45,7", "--radius", 100);
  EXPECT_NEAR((around.box.north - around.box.south) * 111131.778, 200, 0.01);
  EXPECT_NEAR((around.box.east - around.box.west) * 78846.835, 200, 0.01);
}

TEST(OsmFile, AUselessHeaderBoxGivesWayToTheData) {
  TestMap map;
  map.Bounds({-7 * 78846.835, -45 * 111131.778}, {170 * 78846.835, 45 * 111131.778});  // (0, 0) to (90 N, 177 E)
  map.Box({0, 0}, {100, 50}, {{"building", "yes"}});
  const OsmData data = Read(map);
  EXPECT_NEAR(data.extent.width(), 100, 0.01);
  EXPECT_NEAR(data.extent.depth(), 50, 0.01);
  TestMap wide(40'000, 40'000);
  wide.Line({{-40'000, 0}, {40'000, 0}}, {{"highway", "primary"}});
  const std::string error = ErrorOf(wide);
  EXPECT_NE(error.find("header"), std::string::npos) << error;
  EXPECT_NE(error.find("--bbox"), std::string::npos) << error;
}

TEST(OsmItems, CamerasMachinesAndStepsAreBuilt) {
  TestMap map(100, 100);
  const int camera = map.Node({20, 20}, {{"man_made", "surveillance"}}),
            indoors = map.Node({22, 20}, {{"man_made", "surveillance"}, {"surveillance", "indoor"}});
  const int drinks = map.Node({-20, 20}, {{"amenity", "vending_machine"}, {"vending", "drinks"}}),
            tickets = map.Node({-30, 20}, {{"amenity", "vending_machine"}, {"vending", "parking_tickets"}});
  map.Line({{-60, -20}, {60, -20}}, {{"highway", "footway"}, {"width", "6"}});
  const int steps = map.Line({{-2, -20}, {2, -20}}, {{"highway", "steps"}});
  const auto scene = map.Build();
  const auto path = [&](const std::string& name) {
    return Find(*scene, name) ? scene->tree[Find(*scene, name)->category].path : std::string("nothing");
  };
  EXPECT_EQ(path("node/" + std::to_string(camera)), "furniture/utility/camera");
  EXPECT_NEAR(static_cast<double>(Find(*scene, "node/" + std::to_string(camera))->bounds.max.z), 3.68, 0.1);
  EXPECT_EQ(path("node/" + std::to_string(indoors)), "nothing");
  EXPECT_EQ(path("node/" + std::to_string(drinks)), "furniture/vending/machine");
  EXPECT_NE(path("node/" + std::to_string(tickets)).find("parking_meter"), std::string::npos);
  EXPECT_EQ(path("way/" + std::to_string(steps)), "construction/stairs");
}

// A wood's ground is a floor of needles, with plants on it near the first viewpoint; a meadow beside it is a lawn without ferns.
TEST(OsmItems, WoodsHaveAFloorWithFernsAndMeadowsDoNot) {
  const auto ferns_and_floor = [](const char* value) {
    TestMap map(80, 80);
    const int area = map.Box({-60, -60}, {60, 60}, {{value == std::string("wood") ? "natural" : "landuse", value}});
    const auto scene = map.Build();
    int ferns = 0;
    for (const Instance& instance : scene->instances) ferns += scene->meshes[instance.mesh].name.find("fern") != std::string::npos;
    const Entity* ground = Find(*scene, "way/" + std::to_string(area));
    EXPECT_NE(ground, nullptr);
    bool floor = false;
    for (const Mesh& mesh : scene->meshes)
      for (const MeshPart& part : mesh.parts) floor |= scene->materials[part.material].name == "forest floor" && part.triangle_count > 0;
    return std::pair{ferns, floor};
  };
  const auto [in_wood, floor] = ferns_and_floor("wood");
  EXPECT_GT(in_wood, 50);
  EXPECT_TRUE(floor);
  const auto [in_meadow, none] = ferns_and_floor("meadow");
  EXPECT_EQ(in_meadow, 0);
  EXPECT_FALSE(none);
}

TEST(OsmItems, MultipolygonsThatDoNotCloseAreKnown) {
  TestMap map(100, 100);
  const int open = map.Line({{0, 0}, {50, 0}, {50, 50}}, {}), closed = map.Ring({{-50, -50}, {-20, -50}, {-20, -20}}, {});
  map.Relation({{open, "outer"}}, {{"type", "multipolygon"}, {"landuse", "grass"}});
  map.Relation({{closed, "outer"}}, {{"type", "multipolygon"}, {"landuse", "grass"}});
  map.Relation({{open, "outer"}, {999, "outer"}}, {{"type", "multipolygon"}, {"landuse", "grass"}});  // cut off by the extract
  const OsmData data = Read(map);
  const std::vector<OsmArea> areas = FindAreas(data);
  ASSERT_EQ(areas.size(), 3u);
  EXPECT_TRUE(areas[0].broken);
  EXPECT_FALSE(areas[1].broken);
  EXPECT_FALSE(areas[2].broken);
}

}  // namespace
}  // namespace airsim360::internal

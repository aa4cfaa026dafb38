// The import of OpenStreetMap data against closed forms of a small hand-made map (data/osm), and against
// osmium-tool and the tags themselves on the real extracts where they are at hand (folder named by
// AIRSIM360_SHARED).
#include <bzlib.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/worlds/osm/buildings/osm_building_plans.h"
#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360::internal {
namespace {

namespace fs = std::filesystem;

const fs::path kFixture = "data/osm/crossing.osm";

OsmData Fixture() { return ReadOsm(kFixture, ReadFile(kFixture)); }

struct Built {
  std::shared_ptr<const Scene> scene;
  OsmReport report;
  const Entity* Find(const std::string& name) const {
    for (const Entity& entity : scene->entities)
      if (entity.name == name) return &entity;
    return nullptr;
  }
};
const Built& World() {
  static const Built built = [] {
    Built made;
    made.scene = BuildOsmWorld(kFixture, {}, &made.report);
    return made;
  }();
  return built;
}

std::string PackGzip(std::string_view text) {
  z_stream stream{};
  constexpr int kGzipOnly = 15 + 16, kMemory = 8;
  deflateInit2(&stream, 6, Z_DEFLATED, kGzipOnly, kMemory, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string PackBzip2(std::string_view text) {
  std::string out(text.size() + text.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(text.data()), static_cast<unsigned>(text.size()), 1, 0, 0);
  out.resize(size);
  return out;
}

std::string ErrorOf(const std::string& name, std::string_view text, const OsmLimits& limits = {}) {
  try {
    ReadOsm(name, AsBytes(text), limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// What looks up of each entity: triangles seen from above.
class Roofscape {
 public:
  explicit Roofscape(const Scene& scene) {
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = scene.meshes[instance.mesh];
      for (const MeshPart& part : mesh.parts) {
        const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
        const std::string& path = scene.tree[scene.entity(entity).category].path;
        if (!path.starts_with("construction/building")) continue;
        for (uint32_t i = 0; i < part.triangle_count; ++i) {
          const Vec3u t = mesh.triangles[part.first_triangle + i];
          Ring ring;
          for (uint32_t k : {t.x, t.y, t.z}) {
            const Vec3f p = instance.X_WM * mesh.positions[k];
            ring.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
          }
          if (SignedArea(ring) > 1e-4) triangles_[entity].push_back({ring, {}});
        }
      }
    }
  }
  Patches Of(const std::set<EntityId>& entities) const {
    Patches all;
    for (EntityId entity : entities)
      if (const auto it = triangles_.find(entity); it != triangles_.end()) all.insert(all.end(), it->second.begin(), it->second.end());
    return Unite(all);
  }

 private:
  std::map<EntityId, Patches> triangles_;
};

double Overlap(const Patches& a, const Patches& b) {
  const double both = Area(Intersect(a, b));
  return both / (Area(a) + Area(b) - both);
}

// Built against mapped outlines of all buildings with a shape: the worst overlap, over those above 12 m^2.
struct Agreement {
  double worst = 1, mean = 0;
  int count = 0;
  std::string where;
};
Agreement CompareFootprints(const OsmData& data, const Built& built) {
  const std::vector<OsmArea> areas = FindAreas(data);
  std::map<std::string, const OsmArea*> by_id;
  for (const OsmArea& area : areas) by_id[area.id] = &area;
  // Everything of a building: its own entity and the roofs of its volumes.
  std::map<std::string, std::set<EntityId>> roofs;
  const std::vector<OsmBuilding> plans = PlanOsmBuildings(data, areas);
  std::map<std::string, std::vector<EntityId>> named;
  for (const Entity& entity : built.scene->entities) {
    const size_t end = entity.name.find("/roof");
    if (end != std::string::npos) named[entity.name.substr(0, end)].push_back(entity.id);
  }
  Agreement agreement;
  const Roofscape roofscape(*built.scene);
  const size_t step = plans.size() > 600 ? 4 : 1;  // of large extracts every fourth
  for (size_t i = 0; i < plans.size(); i += step) {
    const auto it = by_id.find(plans[i].id);
    if (it == by_id.end() || plans[i].orphan || it->second->area < 12 || plans[i].outline.empty()) continue;
    std::set<EntityId> mine{built.report.buildings[i].entity};
    for (const OsmVolume& volume : plans[i].volumes)
      for (EntityId id : named[volume.id]) mine.insert(id);
    // What the map says stands there: the outline and its parts.
    Patches mapped = it->second->patches;
    for (const OsmVolume& volume : plans[i].volumes)
      if (const auto part = by_id.find(volume.id); part != by_id.end())
        mapped.insert(mapped.end(), part->second->patches.begin(), part->second->patches.end());
    const double overlap = Overlap(roofscape.Of(mine), Unite(mapped));
    agreement.mean += overlap;
    ++agreement.count;
    if (overlap < agreement.worst) {
      agreement.worst = overlap;
      agreement.where = plans[i].id;
    }
  }
  agreement.mean /= std::max(1, agreement.count);
  return agreement;
}

// Two parts, as pbzip2 and bgzip write them.
TEST(OsmFile, PackedFilesMayHaveSeveralParts) {
  const std::string text(AsText(ReadFile(kFixture)));
  const auto part = [&](size_t begin, size_t end) { return std::string_view(text).substr(begin, end - begin); };
  const size_t middle = text.size() / 2;
  const OsmData plain = Fixture();
  for (const auto& [name, pack] : {std::pair{"a.osm.gz", &PackGzip}, {"a.osm.bz2", &PackBzip2}}) {
    const std::string packed = pack(part(0, middle)) + pack(part(middle, text.size()));
    const OsmData data = ReadOsm(name, AsBytes(packed));
    EXPECT_EQ(data.ways.size(), plain.ways.size()) << name;
    EXPECT_EQ(data.nodes.size(), plain.nodes.size()) << name;
    EXPECT_EQ(ReadOsm(name, AsBytes(pack(text))).ways.size(), plain.ways.size()) << name;
    EXPECT_NE(ErrorOf(name, packed.substr(0, packed.size() - 20)).find(name), std::string::npos);
    OsmLimits small;
    small.max_bytes = text.size() / 8;
    EXPECT_NE(ErrorOf(name, packed, small), "no error");
  }
}

TEST(OsmTags, LengthsAndColoursAreReadAsMapsWriteThem) {
  EXPECT_DOUBLE_EQ(*ParseOsmLength("12", 100), 12);
  EXPECT_DOUBLE_EQ(*ParseOsmLength("12.5 m", 100), 12.5);
  EXPECT_DOUBLE_EQ(*ParseOsmLength("1,5", 100), 1.5);
  EXPECT_NEAR(*ParseOsmLength("10 ft", 100), 3.048, 1e-9);
  EXPECT_NEAR(*ParseOsmLength("5'6\"", 100), 1.6764, 1e-9);
  EXPECT_DOUBLE_EQ(*ParseOsmLength(" ~20 m", 100), 20);
  for (const char* bad : {"", "tall", "-3", "1e9", "12 km", "0", "12;14", "nan"}) EXPECT_FALSE(ParseOsmLength(bad, 1000)) << bad;
  EXPECT_NEAR(ParseOsmColour("#808080")->x, 0.2159f, 1e-3f);
  EXPECT_EQ(*ParseOsmColour("#888"), *ParseOsmColour("#888888"));
  EXPECT_TRUE(ParseOsmColour("light_grey"));
  for (const char* bad : {"", "#12", "#gggggg", "nocolour"}) EXPECT_FALSE(ParseOsmColour(bad)) << bad;
}

TEST(OsmFile, CoordinatesAreEastAndNorthOfTheMiddle) {
  const OsmData data = Fixture();
  EXPECT_NEAR(data.origin.latitude_deg, 52.0, 1e-6);
  EXPECT_NEAR(data.extent.width(), 190, 0.5);
  // Two ways to the same place: the factors of the fixture's own maker and the geodesy of the reader.
  const OsmWay* house = data.FindWay(10);
  ASSERT_NE(house, nullptr);
  EXPECT_NEAR(house->line[0].x, 15, 0.05);
  EXPECT_NEAR(house->line[0].y, 12, 0.05);
  EXPECT_TRUE(house->closed());
}

TEST(OsmFile, DamageIsAnErrorThatNamesThePlace) {
  EXPECT_NE(ErrorOf("a.osm", "<osm version='0.6'>\n<node id='1' lat='1' lon='1'></way></osm>").find("a.osm:2:"), std::string::npos);
  EXPECT_NE(ErrorOf("b.osm.pbf", "not a pbf file at all").find("b.osm.pbf"), std::string::npos);
  EXPECT_NE(ErrorOf("c.osm.gz", "neither").find("c.osm.gz"), std::string::npos);
  EXPECT_NE(ErrorOf("d.osm", "<osm version='0.6'></osm>").find("no node"), std::string::npos);
  EXPECT_NE(ErrorOf("e.png", "x").find(".osm.pbf"), std::string::npos);
  // Bounds hold before the world is built.
  const std::string text = ReadTextFile(kFixture);
  EXPECT_NE(ErrorOf("f.osm", text, {.max_nodes = 10}).find("more than 10 nodes"), std::string::npos);
  EXPECT_NE(ErrorOf("g.osm", text, {.max_ways = 3}).find("more than 3 ways"), std::string::npos);
  EXPECT_NE(ErrorOf("h.osm", text, {.max_extent = 100}).find("km"), std::string::npos);
}

TEST(OsmBuildings, EachIsAnEntityOnceWithItsHeight) {
  const Built& world = World();
  std::map<std::string, int> seen;
  std::map<std::string, double> height;
  for (const OsmBuildingReport& building : world.report.buildings) {
    ++seen[building.id];
    height[building.id] = building.height;
    EXPECT_EQ(world.scene->tree[world.scene->entity(building.entity).category].path, "construction/building") << building.id;
    EXPECT_TRUE(world.scene->entity(building.entity).name.starts_with(building.id));
  }
  EXPECT_EQ(seen.size(), 19u);
  for (const auto& entry : seen) EXPECT_EQ(entry.second, 1) << entry.first;
  EXPECT_DOUBLE_EQ(height["way/10"], 9);
  EXPECT_NEAR(height["way/11"], 12.8, 1e-9);  // four storeys of 3.2 m
  EXPECT_DOUBLE_EQ(height["relation/20"], 21.5);
  EXPECT_DOUBLE_EQ(height["way/15"], 43);  // the lantern on the tower
}

TEST(OsmBuildings, WallsAndRoofsEndAtTheTaggedHeight) {
  const Built& world = World();
  for (const auto& row : std::map<std::string, double>{{"way/10", 9}, {"relation/20", 21.5}, {"way/17", 40}, {"way/18", 43}}) {
    const Entity* roof = world.Find(row.first + "/roof");
    ASSERT_NE(roof, nullptr) << row.first;
    EXPECT_NEAR(static_cast<double>(roof->bounds.max.z), row.second, 0.12) << row.first;
  }
  for (int k = 0; k < 13; ++k) {
    const std::string id = "way/" + std::to_string(30 + k);
    const Entity *roof = world.Find(id + "/roof"), *walls = world.Find(id);
    ASSERT_TRUE(roof && walls) << id;
    const float top = std::max(roof->bounds.max.z, walls->bounds.max.z);
    EXPECT_NEAR(static_cast<double>(top), 10, 0.25) << id;  // a downpipe may end over the eaves
  }
}

TEST(OsmBuildings, FootprintsAreThoseOfTheMap) {
  const Agreement agreement = CompareFootprints(Fixture(), World());
  EXPECT_GE(agreement.worst, 0.98) << agreement.where;
  EXPECT_EQ(agreement.count, 17);  // all but the shed of 9 m^2 and the point
}

TEST(OsmBuildings, ACourtyardIsOpen) {
  const Built& world = World();
  const Patches roof = Roofscape(*world.scene).Of({world.Find("relation/20/roof")->id});
  EXPECT_NEAR(Area(roof), 1600 - 400, 6);
}

TEST(OsmGround, EverySpotOfTheExtractBelongsToOneEntity) {
  // Ground pieces tile the extract: their areas add up to it, so that nothing overlaps and nothing is open.
  const Built& world = World();
  Patches all;
  double sum = 0;
  const std::set<std::string> ground{
      "ground/road", "ground/sidewalk", "ground/path/park_walkway", "ground/terrain/landscape", "ground/pavement/modular", "water/lake",
      "ground/sand", "ground/grass"};
  for (const Instance& instance : world.scene->instances) {
    const Mesh& mesh = world.scene->meshes[instance.mesh];
    if (mesh.name != "ground") continue;
    for (const MeshPart& part : mesh.parts) {
      const Entity& entity = world.scene->entity(part.entity);
      if (!ground.contains(world.scene->tree[entity.category].path) || entity.name == "country") continue;
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        sum += static_cast<double>(Cross(b - a, c - a).z) / 2;
      }
    }
  }
  const double expected = (world.report.width + 60) * (world.report.depth + 60);
  EXPECT_NEAR(sum / expected, 1, 2e-4);
}

TEST(OsmGround, RoadsAreCutAtJunctionsAndHaveTheirNames) {
  const Built& world = World();
  EXPECT_NE(world.Find("way/1 Long Street"), nullptr);
  EXPECT_NE(world.Find("way/1/2 Long Street"), nullptr);
  EXPECT_NE(world.Find("node/101/junction"), nullptr);
  EXPECT_NE(world.Find("way/1/pavement_left"), nullptr);
  EXPECT_NE(world.Find("way/2/bike_lane"), nullptr);
  EXPECT_EQ(world.scene->tree[world.Find("way/51")->category].path, "water/lake");
  EXPECT_NE(world.Find("way/50 Small Park"), nullptr);
  // The zebra lies where the map says: 30 m south of the middle.
  const Entity* zebra = world.Find("node/106");
  ASSERT_NE(zebra, nullptr);
  EXPECT_NEAR(static_cast<double>(zebra->bounds.center().y), -30, 0.5);
}

TEST(OsmProps, EveryTreeLampAndBenchIsAnEntityInItsPlace) {
  const OsmData data = Fixture();
  const Built& world = World();
  int found = 0;
  for (const OsmNode& node : data.nodes) {
    const bool tree = node.tags.Is("natural", "tree"), lamp = node.tags.Is("highway", "street_lamp"),
               bench = node.tags.Is("amenity", "bench");
    if (!tree && !lamp && !bench) continue;
    const Entity* entity = world.Find(OsmId("node", node.id));
    ASSERT_NE(entity, nullptr) << node.id;
    const std::string& path = world.scene->tree[entity->category].path;
    EXPECT_TRUE(path.starts_with(tree ? "vegetation/tree" : lamp ? "furniture/lighting" : "furniture/seating/bench")) << path;
    const Vec3f c = entity->bounds.center();
    EXPECT_LT(std::hypot(static_cast<double>(c.x) - node.p.x, static_cast<double>(c.y) - node.p.y), 3.5) << node.id;
    ++found;
  }
  EXPECT_EQ(found, 7);
  for (const char* name : {"way/54", "way/55", "way/56", "node/226", "node/227 Church"}) EXPECT_NE(world.Find(name), nullptr) << name;
}

// What is added by rule behind houses: not in them, not on roads, and nothing of it where the user wants the map alone.
TEST(OsmProps, GardensAreFilledAroundHousesAndOnlyOnDemand) {
  const OsmData data = Fixture();
  const std::vector<OsmArea> areas = FindAreas(data);
  const std::vector<OsmBuilding> plans = PlanOsmBuildings(data, areas);
  const auto by_rule = [](const Entity& entity) {
    return (entity.name.starts_with("green ") || entity.name.starts_with("yard ")) && entity.name.find('/') != std::string::npos;
  };
  int things = 0;
  for (const Entity& entity : World().scene->entities) {
    if (!by_rule(entity) || entity.name.ends_with("/gardens")) continue;
    ++things;
    const Vec3f c = entity.bounds.center();
    for (const OsmBuilding& building : plans)
      for (const OsmVolume& volume : building.volumes)
        for (const Patch& patch : volume.footprint)
          EXPECT_FALSE(volume.bottom <= 3 && Inside(patch, {static_cast<double>(c.x), static_cast<double>(c.y)}))
              << entity.name << " in " << building.id;
  }
  EXPECT_GT(things, 50);
  const auto bare = BuildOsmWorld(kFixture, {.fill = false});
  for (const Entity& entity : bare->entities) EXPECT_FALSE(by_rule(entity)) << entity.name;
}

TEST(OsmWorld, TheSameFileGivesTheSameBytes) {
  const auto again = BuildOsmWorld(kFixture, {});
  EXPECT_EQ(ArchiveScene(*again), ArchiveScene(*World().scene));
}

TEST(OsmWorld, HeightsLiftEverythingTogether) {
  // A plane that rises 5 cm a metre to the east, as a grid of degrees.
  HeightGrid grid{21, 21, 4.99, 52.01, 0.001, 0.001, {}};
  for (int row = 0; row < 21; ++row)
    for (int column = 0; column < 21; ++column)
      grid.heights.push_back(static_cast<float>(100 + 0.05 * 68677 * ((column + 0.5) * 0.001 - 0.01)));
  const auto scene = BuildOsmWorld(kFixture, {.heights = [&](const GeoBox&) { return grid; }});
  std::map<std::string, const Entity*> named;
  for (const Entity& entity : scene->entities) named[entity.name] = &entity;
  // The lamp 10 m to the east stands 0.5 m higher, the bench 52 m to the west 2.6 m lower.
  const auto foot = [&](const char* name) { return static_cast<double>(named.at(name)->bounds.min.z); };
  const auto flat = [&](const char* name) { return static_cast<double>(World().Find(name)->bounds.min.z); };
  EXPECT_NEAR(foot("node/220") - flat("node/220"), 0.05 * 10, 0.06);
  EXPECT_NEAR(foot("node/222") - flat("node/222"), 0.05 * -52, 0.06);
  const double roof = static_cast<double>(named.at("way/10/roof")->bounds.max.z);
  EXPECT_NEAR(roof, 9 + 0.05 * 15, 0.15);  // over the lowest corner of the house
}

TEST(Patches, BooleansAndTrianglesKeepTheArea) {
  const Patch square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}, hole{{{3, 3}, {6, 3}, {6, 6}, {3, 6}}, {}};
  const Patches ring = Subtract(Patches{square}, Patches{hole});
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_NEAR(Area(ring), 91, 1e-6);
  std::vector<Vec2d> points = ring[0].outer;
  for (const Ring& inner : ring[0].holes) points.insert(points.end(), inner.begin(), inner.end());
  const std::vector<uint32_t> triangles = Triangulate(ring[0]);
  double sum = 0;
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::array<Vec2d, 3> corners{points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]]};
    EXPECT_GT(SignedArea(corners), 0);
    sum += SignedArea(corners);
  }
  EXPECT_NEAR(sum, 91, 1e-6);
  // A band around a bend: two arms and the mitre.
  const std::vector<Vec2d> line{{0, 0}, {10, 0}, {10, 10}};
  EXPECT_NEAR(Area(Band(line, 1, 1)), 40, 1e-3);  // 9x2 + 9x2 + 2x2
}

// What osmium-tool counts for a filter, by kind; nullopt where it is not installed.
std::optional<std::array<int, 3>> OsmiumCount(const fs::path& file, const std::string& filter) {
  const fs::path out = fs::temp_directory_path() / ("airsim360_osm_" + std::to_string(getpid()) + ".opl");
  const std::string command =
      "osmium tags-filter -R --no-progress '" + file.string() + "' " + filter + " -o '" + out.string() + "' --overwrite >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  std::array<int, 3> counts{};
  const std::string text = ReadTextFile(out);
  for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    counts[0] += text[at] == 'n';
    counts[1] += text[at] == 'w';
    counts[2] += text[at] == 'r';
    if (text.find('\n', at) == std::string::npos) break;
  }
  fs::remove(out);
  return counts;
}

class OsmExtracts : public testing::TestWithParam<const char*> {};

TEST_P(OsmExtracts, MeetTheBars) {
  const char* shared = std::getenv("AIRSIM360_SHARED");
  const fs::path file = fs::path(shared ? shared : "/work/shared") / "osm" / GetParam();
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not at hand (AIRSIM360_SHARED)";
  Built built;
  built.scene = BuildOsmWorld(file, {}, &built.report);
  const OsmData data = ReadOsm(file, ReadFile(file));

  // Counts as osmium's.
  std::array<int, 3> counts{};
  for (const OsmBuildingReport& building : built.report.buildings)
    if (!building.part) ++counts[building.id[0] == 'n' ? 0 : building.id[0] == 'w' ? 1 : 2];
  if (const auto expected = OsmiumCount(file, "nwr/building")) {
    EXPECT_EQ(counts, *expected);
  } else {
    std::printf("osmium-tool is not installed: counts not compared\n");
  }

  // Heights within 0.5 m of the tags, measured on the geometry.
  std::map<std::string, const Entity*> named;
  for (const Entity& entity : built.scene->entities) named[entity.name] = &entity;
  int measured = 0;
  double worst = 0;
  const std::vector<OsmArea> areas = FindAreas(data);
  const std::vector<OsmBuilding> plans = PlanOsmBuildings(data, areas);
  for (const OsmBuilding& plan : plans) {
    for (const OsmVolume& volume : plan.volumes) {
      const auto tag = ParseOsmLength(volume.tags->Get("height"), 1000);
      if (!tag || volume.footprint.empty() || (volume.id == plan.id && plan.volumes.size() > 1)) continue;
      const auto roof = named.find(volume.id + "/roof");
      ASSERT_NE(roof, named.end()) << volume.id;
      double top = static_cast<double>(roof->second->bounds.max.z);
      // A deck lies below its rim.
      if (plan.volumes.size() == 1) {
        const std::string own = plan.id + (plan.name.empty() ? "" : " " + plan.name);
        top = std::max(top, static_cast<double>(named.at(own)->bounds.max.z));
      }
      worst = std::max(worst, std::abs(top - *tag));
      EXPECT_NEAR(top, *tag, 0.5) << volume.id;
      ++measured;
    }
  }

  // Footprints, and the furniture.
  // Seen from above, everything that stands proud of a wall included (sills, window boxes).
  const Agreement agreement = CompareFootprints(data, built);
  EXPECT_GE(agreement.mean, 0.99);
  EXPECT_GE(agreement.worst, 0.98) << agreement.where;
  int things = 0;
  for (const OsmNode& node : data.nodes) {
    if (!node.tags.Is("natural", "tree") && !node.tags.Is("highway", "street_lamp") && !node.tags.Is("amenity", "bench")) continue;
    EXPECT_TRUE(named.contains(OsmId("node", node.id))) << node.id;
    ++things;
  }
  std::printf(
      "%s: buildings n %d w %d r %d; %d heights, worst %.3f m; %d footprints, worst overlap %.4f (%s), mean %.5f; %d trees, lamps, benches; %zu entities\n",
      GetParam(), counts[0], counts[1], counts[2], measured, worst, agreement.count, agreement.worst, agreement.where.c_str(),
      agreement.mean, things, built.scene->entities.size());
}

INSTANTIATE_TEST_SUITE_P(Shared, OsmExtracts, testing::Values("nyc.osm.pbf", "berlin-siegessaeule.osm.gz", "west-oakland.osm.bz2"));

}  // namespace
}  // namespace airsim360::internal

// The five buildings as scenes: how full they are, and that every pixel from inside them has a label.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"
#include "airsim360/routes/survey.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/trace/ray_tracer.h"
#include "airsim360/worlds/worlds.h"
#include "built_worlds.h"

namespace airsim360 {
namespace {

constexpr const char* kBuildings[] = {"apartment", "office", "warehouse", "mall", "car_park"};

std::vector<std::string> CategoriesOf(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Entity& entity : scene.entities) ++counts[scene.tree[entity.category].path];
  std::vector<std::string> names;
  for (const auto& entry : counts) names.push_back(entry.first);
  return names;
}

// Frames of labels at free places in the rooms.
long UnlabelledPixels(const std::shared_ptr<const Scene>& scene, const BuildingRooms& rooms, int poses) {
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kLabels});
  RngStream rng(7, "poses");
  const auto between = [&](float a, float b) { return static_cast<float>(rng.Uniform(static_cast<double>(a), static_cast<double>(b))); };
  long unlabelled = 0;
  int made = 0;
  Frame frame;
  for (int tries = 0; made < poses && tries < 4000; ++tries) {
    const RoomOutline& room = rooms.rooms[rng.Index(static_cast<uint32_t>(rooms.rooms.size()))];
    const Vec3f p{between(room.corners[0].x, room.corners[2].x), between(room.corners[0].y, room.corners[2].y),
                  between(room.floor_z, room.ceiling_z)};
    if (tracer->Clearance(p, 0.3f) < 0.3f) continue;
    ++made;
    renderer->Render(MakeRequest(Equirectangular{256, 128}, BodyPose({p.x, p.y, p.z}, 0, 0, 0) * CameraInBody(), Tier::kLabels), frame);
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 256; ++x) unlabelled += frame.semantic(x, y) == kVoid || frame.entity(x, y) == kNoEntity;
  }
  EXPECT_EQ(made, poses);
  return unlabelled;
}

const WorldInfo& InfoOf(const std::string& name) {
  for (const WorldInfo& info : ListWorlds())
    if (info.name == name) return info;
  throw std::out_of_range(name);
}

TEST(Interiors, AreFullOfThingsWithLabelsEverywhere) {
  const std::map<std::string, double> least_area = {
      {"apartment", 150}, {"office", 600}, {"warehouse", 2000}, {"mall", 3000}, {"car_park", 2500}};
  for (const char* name : kBuildings) {
    SCOPED_TRACE(name);
    const auto scene = Built(name);
    const std::vector<std::string> categories = CategoriesOf(*scene);
    EXPECT_GE(categories.size(), 25u);
    EXPECT_GE(scene->entities.size(), 400u);
    const WorldInfo& info = InfoOf(name);
    EXPECT_EQ(info.categories, categories);
    EXPECT_EQ(info.setting, "indoor");
    EXPECT_GE(info.area_m2, least_area.at(name));
    EXPECT_EQ(UnlabelledPixels(scene, *RoomsOfWorld(name, {}), 40), 0);
  }
}

TEST(Interiors, UnfurnishedOnesKeepWhatIsFixed) {
  const auto count = [](BuildingUse use, bool furnished) {
    const auto scene = BuildWorld("building", {.building = {.use = use, .furnished = furnished}});
    std::map<std::string, int> counts;
    for (const Entity& entity : scene->entities) ++counts[scene->tree[entity.category].path];
    return counts;
  };
  auto full = count(BuildingUse::kApartment, true), empty = count(BuildingUse::kApartment, false);
  for (const char* moved : {"furniture/bed", "furniture/sofa", "furniture/seating/chair", "furniture/wardrobe", "vehicle/car"}) {
    EXPECT_GT(full[moved], 0) << moved;
    EXPECT_EQ(empty[moved], 0) << moved;
  }
  for (const char* fixed : {"furniture/sink", "furniture/bathtub", "furniture/kitchen/stove", "furniture/lighting/ceiling_light"})
    EXPECT_EQ(empty[fixed], full[fixed]) << fixed;
  auto deck = count(BuildingUse::kCarPark, false);
  EXPECT_EQ(deck["vehicle/car"], 0);
  EXPECT_GT(deck["signage/traffic_sign"], 0);
}

TEST(Interiors, AreTheSameBytesFromAnyNumberOfThreads) {
  std::vector<Bytes> scenes;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    scenes.push_back(ArchiveScene(*BuildWorld("apartment", {.seed = 5})));
  }
  EXPECT_EQ(scenes[0], scenes[1]);
}

// What the plan says of a door is so: a ray through the middle of an open one meets nothing in the wall, and a closed one stops it.
TEST(Interiors, OpenDoorsCanBeLookedThroughAndClosedOnesCannot) {
  const auto scene = BuildWorld("apartment", {.seed = 1});
  const RayTracer tracer(scene);
  int open = 0, closed = 0;
  const BuildingRooms rooms = *RoomsOfWorld("apartment", {.seed = 1});
  for (const RoomDoor& door : rooms.doors) {
    if (door.kind != "door") continue;
    const Vec3f along{door.through.x, door.through.y, 0}, from = door.center - along * 0.2f;
    const auto hit = tracer.Intersect(from, along, 0.4f);
    EXPECT_EQ(hit.has_value(), door.open < 0.5) << door.id;
    if (door.open > 0.5) {
      EXPECT_GE(tracer.Clearance(door.center, 1), 0.33f) << door.id;  // a drone of 0.3 m gets through
    }
    (door.open < 0.5 ? closed : open) += 1;
  }
  EXPECT_GT(open, 0);
  EXPECT_GT(closed, 0);
}

// All along a survey of a building there is a ceiling of a room above, or the lintel of a door; and it goes from room to room.
TEST(Interiors, SurveysStayInsideAndGoFromRoomToRoom) {
  const std::map<std::string, size_t> least_rooms = {{"apartment", 7}, {"office", 3}, {"warehouse", 1}, {"mall", 15}, {"car_park", 4}};
  for (const char* name : kBuildings) {
    SCOPED_TRACE(name);
    const RayTracer tracer(Built(name));
    const BuildingRooms building = *RoomsOfWorld(name, {});
    const Route route = PlanSurvey(tracer, {.passages = building.OpenPassages()});
    std::set<uint32_t> seen;
    int inside = 0, all = 0;
    for (double t = 0; t <= route.duration(); t += 0.2) {
      const Vec3d p = route.At(t).p;
      ASSERT_TRUE(tracer.Intersect(VecCast<float>(p), {0, 0, 1}).has_value()) << p.x << ", " << p.y << ", " << p.z;
      ASSERT_GE(tracer.Clearance(VecCast<float>(p), 1), 0.12f) << p.x << ", " << p.y << ", " << p.z;
      const RoomOutline* room = building.RoomAt(p);
      if (room != nullptr) seen.insert(room->id);
      inside += room != nullptr, ++all;
    }
    EXPECT_GE(inside, all * 97 / 100);
    EXPECT_GE(seen.size(), least_rooms.at(name));
  }
}

}  // namespace
}  // namespace airsim360

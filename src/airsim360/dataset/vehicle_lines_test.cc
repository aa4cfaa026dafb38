#include "airsim360/dataset/vehicle_lines.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "airsim360/scene/road_network.h"

namespace airsim360 {
namespace {

using Json = nlohmann::json;

// Two cars on a road to the east, and a way back.
TrafficScene TwoCars() {
  SceneBuilder builder("road");
  builder.AddSky();
  builder.AddMaterial({});
  Mesh car;
  for (const float x : {-0.9f, 0.9f})
    for (const float y : {-2.2f, 2.2f})
      for (const float z : {0.0f, 1.5f}) car.positions.push_back({x, y, z});
  car.triangles = {{0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  builder.AddInstance({builder.AddMesh(car), PlaceUpright({0, 500, 0}), builder.AddEntity("car", builder.tree().At("vehicle/car"))});
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{0, 0, 0}, {300, 0, 0}}, .next = {1}},
                  {.points = {{300, 0, 0}, {300, 200, 0}, {0, 200, 0}, {0, 0, 0}}, .next = {0}}};
  builder.SetRoads(roads);
  return AddTraffic(builder.Build(), {.count = 2, .seed = 3, .warm_up = 0});
}

Flight ThreeShots(const TrafficScene& scene) {
  Flight flight;
  for (int i = 0; i < 3; ++i) flight.shots.push_back({.t_ns = i * 1'000'000'000, .body = {}, .traffic = scene.traffic->start});
  return flight;
}

std::vector<Json> Lines(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

TEST(VehicleLines, NearMissesAreOfTheFrameThatFollowsThem) {
  const TrafficScene scene = TwoCars();
  Flight flight = ThreeShots(scene);
  using Kind = RoadUser::Kind;
  const auto miss = [](int64_t t_ns, RoadUser b, double seconds) {
    return NearMiss{.a = {Kind::kVehicle, 0}, .b = b, .t_ns = t_ns, .seconds = seconds, .braking = 4, .p = {1, 2, 3}};
  };
  flight.near_misses = {miss(0, {Kind::kVehicle, 1}, 0.5), miss(1, {Kind::kDrone, 0}, 0.6), miss(1'000'000'000, {Kind::kPerson, 0}, 0.7),
                        miss(1'500'000'000, {Kind::kVehicle, 1}, 0.8), miss(2'000'000'001, {Kind::kVehicle, 1}, 0.9)};
  const std::vector<Json> lines = Lines(VehiclesJsonl(*scene.traffic, flight));
  ASSERT_EQ(lines.size(), 3u);
  std::vector<std::vector<double>> seconds;
  for (const Json& line : lines) {
    seconds.emplace_back();
    for (const Json& entry : line["near_misses"]) seconds.back().push_back(entry["time_to_collision"]);
  }
  EXPECT_EQ(seconds, (std::vector<std::vector<double>>{{0.5}, {0.6, 0.7}, {0.8}}));
  const Json& first = lines[0]["near_misses"][0];
  EXPECT_EQ(first["first"]["name"], "traffic/000");
  EXPECT_EQ(first["second"]["name"], "traffic/001");
  EXPECT_EQ(first["second"]["entity"], scene.traffic->bodies[1].entity);
  EXPECT_EQ(first["p"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(lines[1]["near_misses"][0]["second"]["name"], "drone");
}

TEST(VehicleLines, TellLaneAndPlaceOnIt) {
  const TrafficScene scene = TwoCars();
  const std::vector<Json> lines = Lines(VehiclesJsonl(*scene.traffic, ThreeShots(scene)));
  for (const Json& vehicle : lines[0]["vehicles"]) {
    const LanePoint front = scene.traffic->model.lanes.At(vehicle["lane"], vehicle["lane_position"]);
    const Json& p = vehicle["X_WB"]["p"];
    // Its middle is half its length behind the front, on a straight lane.
    EXPECT_NEAR(Norm(Vec3d{p[0], p[1], p[2]} - front.p), 2.2, 0.35);
  }
}

}  // namespace
}  // namespace airsim360

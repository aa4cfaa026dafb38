// Tables of the server, row by row: settings keys, commands, limits, object names, segmentation colours.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/coordinates/ned_commands.h"
#include "airsim360/rpc/images/segmentation_palette.h"
#include "airsim360/rpc/session/objects.h"
#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/rpc/settings/settings.h"
#include "airsim360/rpc/wire/limits.h"

namespace airsim360 {
namespace {

// A key of the settings with the text that goes around `"Key": value`.
struct SettingsKey {
  const char *name, *before, *after;
  double low, high;  // of numbers; equal = the key is no number
  const char* kind;
};

#define VEHICLE "{\"Vehicles\": {\"A\": {\"VehicleType\": \"SimpleFlight\", "
#define LIDAR VEHICLE "\"Sensors\": {\"s\": {\"SensorType\": 6,\n"
#define DISTANCE VEHICLE "\"Sensors\": {\"s\": {\"SensorType\": 5,\n"
constexpr SettingsKey kKeys[] = {
    {"ClockSpeed", "{\n", "}", 0.001, 1000, "a number"},
    {"ApiServerPort", "{\n", "}", 0, 65535, "a number"},
    {"SettingsVersion", "{\n", "}", 0, 100, "a number"},
    {"LocalHostIp", "{\n", "}", 0, 0, "a text"},
    {"SimMode", "{\n", "}", 0, 0, "a text"},
    {"X", VEHICLE "\n", "}}}", -1e7, 1e7, "a number"},
    {"Yaw", VEHICLE "\n", "}}}", -360, 360, "a number"},
    {"Roll", VEHICLE "\n", "}}}", -360, 360, "a number"},
    {"Pitch", VEHICLE "\n", "}}}", -360, 360, "a number"},
    {"AutoCreate", VEHICLE "\n", "}}}", 0, 0, "true or false"},
    {"AllowAPIAlways", VEHICLE "\n", "}}}", 0, 0, "true or false"},
    {"EnableCollisions", VEHICLE "\n", "}}}", 0, 0, "true or false"},
    {"Width", "{\"CameraDefaults\": {\"CaptureSettings\": [{\n", "}]}}", 1, 1e6, "a number"},
    {"Height", "{\"CameraDefaults\": {\"CaptureSettings\": [{\n", "}]}}", 1, 1e6, "a number"},
    {"FOV_Degrees", "{\"CameraDefaults\": {\"CaptureSettings\": [{\n", "}]}}", 0.1, 179, "a number"},
    {"Range", LIDAR, "}}}}}", 0.01, 1e9, "a number"},
    {"NumberOfChannels", LIDAR, "}}}}}", 1, 1024, "a number"},
    {"PointsPerSecond", LIDAR, "}}}}}", 1, 1e7, "a number"},
    {"MeasurementsPerCycle", LIDAR, "}}}}}", 1, 36000, "a number"},
    {"RotationsPerSecond", LIDAR, "}}}}}", 0.1, 1000, "a number"},
    {"HorizontalFOVStart", LIDAR, "}}}}}", -360, 360, "a number"},
    {"HorizontalFOVEnd", LIDAR, "}}}}}", -360, 360, "a number"},
    {"VerticalFOVUpper", LIDAR, "}}}}}", -90, 90, "a number"},
    {"VerticalFOVLower", LIDAR, "}}}}}", -90, 90, "a number"},
    {"Enabled", LIDAR, "}}}}}", 0, 0, "true or false"},
    {"MinDistance", DISTANCE, "}}}}}", 0, 1e9, "a number"},
    {"MaxDistance", DISTANCE, "}}}}}", 0.01, 1e9, "a number"},
    {"RecordInterval", "{\"Recording\": {\n", "}}", 0.001, 1e6, "a number"},
    {"RecordOnMove", "{\"Recording\": {\n", "}}", 0, 0, "true or false"},
    {"Latitude", "{\"OriginGeopoint\": {\n", "}}", -90, 90, "a number"},
    {"Longitude", "{\"OriginGeopoint\": {\n", "}}", -180, 180, "a number"},
    {"Altitude", "{\"OriginGeopoint\": {\n", "}}", -1000, 20000, "a number"},
    {"Z", "{\"Wind\": {\n", "}}", -200, 200, "a number"},
    {"WrapYaw", "{\"AirSim360\": {\n", "}}", 0, 0, "true or false"},
    {"Float32Depth", "{\"AirSim360\": {\n", "}}", 0, 0, "true or false"},
    {"CollisionInState", "{\"AirSim360\": {\n", "}}", 0, 0, "true or false"},
    {"SlowDownAtEndOfPath", "{\"AirSim360\": {\n", "}}", 0, 0, "true or false"},
    {"DepthInCentimetres", "{\"AirSim360\": {\n", "}}", 0, 0, "true or false"},
};

class EverySettingsKey : public testing::TestWithParam<size_t> {
 protected:
  const SettingsKey& key() const { return kKeys[GetParam()]; }
  // The error of `"Key": value`, "" if there is none.
  std::string ErrorOf(const std::string& value) const {
    try {
      ParseSettings(std::string(key().before) + "\"" + key().name + "\": " + value + key().after, "my.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void ExpectNamed(const std::string& error) const {
    EXPECT_TRUE(error.starts_with("my.json:2: ")) << error;
    EXPECT_NE(error.find(key().name), std::string::npos) << error;
  }
};

INSTANTIATE_TEST_SUITE_P(Settings, EverySettingsKey, testing::Range<size_t>(0, std::size(kKeys)),
                         [](const auto& info) { return kKeys[info.param].name; });

TEST_P(EverySettingsKey, OfTheWrongKindIsNamedWithItsFileAndLine) {
  const bool number = key().low < key().high, text = key().kind == std::string_view("a text");
  for (const char* value : {"7", "true", "\"seven\"", "[1]", "{}"}) {
    const bool right = (number && value[0] == '7') || (text && value[0] == '"') || (!number && !text && value[0] == 't');
    if (right) continue;
    ExpectNamed(ErrorOf(value));
    EXPECT_NE(ErrorOf(value).find(key().kind), std::string::npos) << ErrorOf(value);
  }
  EXPECT_EQ(ErrorOf("null"), "") << "not given";
}

TEST_P(EverySettingsKey, BeyondItsRangeIsNamedAndItsBoundsAreTaken) {
  if (!(key().low < key().high)) return;
  const auto text = [](double x) {
    char out[40];
    std::snprintf(out, sizeof out, "%.10g", x);
    return std::string(out);
  };
  EXPECT_EQ(ErrorOf(text(key().low)), "");
  ExpectNamed(ErrorOf(text(key().low - 0.5 - std::abs(key().low))));
  ExpectNamed(ErrorOf(text(key().high * 2 + 1)));
  ExpectNamed(ErrorOf("1e300"));
  ExpectNamed(ErrorOf("-1e300"));
  if (key().high < 1e5) {
    EXPECT_EQ(ErrorOf(text(key().high)), "");
  }
}

class EveryHeading : public testing::TestWithParam<int> {
 protected:
  double degrees() const { return GetParam(); }
  double radians() const { return GetParam() * kPi / 180; }
};

INSTANTIATE_TEST_SUITE_P(Ned, EveryHeading, testing::Range(-180, 181, 45));

// A yaw of N is a compass heading: the body's nose points to (sin, cos) of it in east and north.
TEST_P(EveryHeading, OfACommandIsTheCompassHeadingOfTheNose) {
  const YawTarget yaw = YawOf({false, static_cast<float>(degrees())});
  EXPECT_EQ(yaw.mode, YawTarget::Mode::kAngle);
  EXPECT_NEAR(std::cos(yaw.value), std::sin(radians()), 1e-6);
  EXPECT_NEAR(std::sin(yaw.value), std::cos(radians()), 1e-6);
  EXPECT_NEAR(std::remainder(SwapHeading(SwapHeading(radians())) - radians(), 2 * kPi), 0, 1e-12);
  const YawTarget rate = YawOf({true, static_cast<float>(degrees())});
  EXPECT_EQ(rate.mode, YawTarget::Mode::kRate);
  EXPECT_NEAR(rate.value, -radians(), 1e-6);
  const auto attitude = std::get<AttitudeCommand>(FrdAttitude(0.1, -0.2, radians(), false, {}, {}));
  EXPECT_NEAR(std::remainder(attitude.yaw.value - yaw.value, 2 * kPi), 0, 1e-6);
  EXPECT_EQ(attitude.roll, 0.1);
  EXPECT_EQ(attitude.pitch, -0.2);
}

TEST_P(EveryHeading, RotationsOfBodiesMountsAndObjectsComeBack) {
  for (double pitch : {-1.2, 0.0, 0.7}) {
    const Mat3d R = BodyPose({}, radians(), pitch, 0.4).R;
    const auto expect_same = [&](const Mat3d& back) {
      for (int i = 0; i < 3; ++i) EXPECT_LT(Norm(back.column(i) - R.column(i)), 1e-12);
    };
    expect_same(WorldRotation(NedRotation(R)));
    expect_same(FrdRotation(FrdRotation(R)));
    expect_same(ObjectRotation(ObjectRotation(R)));
    const Mat3d back = airsim::FromQuaternionr(airsim::ToQuaternionr(R));
    for (int i = 0; i < 3; ++i) EXPECT_LT(Norm(back.column(i) - R.column(i)), 1e-6);
    EXPECT_NEAR(NedRotation(R).determinant(), 1, 1e-12);
  }
}

TEST_P(EveryHeading, VelocitiesAndPlacesOfCommandsAreThoseOfTheWorld) {
  const Vec3d origin{10, 20, 30}, v{3 * std::cos(radians()), 3 * std::sin(radians()), -2};  // N
  const auto velocity = std::get<VelocityCommand>(NedVelocity(v, {}));
  EXPECT_LT(Norm(velocity.v - Vec3d{v.y, v.x, 2}), 1e-12);
  EXPECT_FALSE(velocity.hold_altitude);
  const auto level = std::get<VelocityCommand>(NedVelocityZ(v.x, v.y, -7, {}, origin));
  EXPECT_TRUE(level.hold_altitude);
  EXPECT_DOUBLE_EQ(level.altitude, 37);
  EXPECT_NEAR(level.v.x, v.y, 1e-12);
  const auto position = std::get<PositionCommand>(NedPosition(v, {}, origin));
  EXPECT_LT(Norm(position.p_W - (origin + Vec3d{v.y, v.x, 2})), 1e-12);
  const auto rates = std::get<RateCommand>(FrdRates(v, {false, -7}, origin));
  EXPECT_LT(Norm(rates.w_B - Vec3d{v.x, -v.y, 2}), 1e-12);
  EXPECT_EQ(rates.vertical.mode, VerticalTarget::Mode::kAltitude);
  EXPECT_DOUBLE_EQ(rates.vertical.value, 37);
}

class EverySizeOfVelocity : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Limits, EverySizeOfVelocity, testing::Values(0.0, 1.0, 999.9, 1000.0, 1000.1, 5000.0, 1e12));

TEST_P(EverySizeOfVelocity, IsTakenUpToTheFastestStateInEveryDirection) {
  for (const Vec3d way : {Vec3d{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.6, 0, -0.8}}) {
    std::string error;
    try {
      CheckVelocity("v", way * GetParam(), "m/s");
    } catch (const std::invalid_argument& caught) {
      error = caught.what();
    }
    EXPECT_EQ(error.empty(), GetParam() <= kFastestState) << error;
    EXPECT_TRUE(error.empty() || error.find("more than 1000") != std::string::npos) << error;
  }
}

TEST(Limits, AnAnswerIsTakenUpToItsBytesAndNotOneMore) {
  EXPECT_NO_THROW(CheckReplyBytes(0, "help"));
  EXPECT_NO_THROW(CheckReplyBytes(kMostReplyBytes, "help"));
  for (uint64_t bytes : {kMostReplyBytes + 1, ~uint64_t{0}}) {
    try {
      CheckReplyBytes(bytes, "ask for less");
      FAIL() << "no error";
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(std::to_string(bytes) + " bytes"), std::string::npos) << text;
      EXPECT_NE(text.find("at most 320 MiB"), std::string::npos) << text;
      EXPECT_TRUE(text.ends_with("ask for less")) << text;
    }
  }
}

TEST(Snapshot, FindsVehiclesByNameAndTheFirstByNone) {
  Snapshot snapshot;
  EXPECT_THROW(snapshot.Find(""), std::runtime_error);
  for (const char* name : {"Drone1", "Drone2", "drone1"}) {
    VehicleStatus vehicle;
    vehicle.name = name;
    snapshot.vehicles.push_back(vehicle);
  }
  EXPECT_EQ(snapshot.Find(""), 0u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(snapshot.Find(snapshot.vehicles[i].name), i);
  for (const char* name : {"Drone3", "DRONE1", " Drone1", "Drone1 "}) {
    try {
      snapshot.Find(name);
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), NoVehicleText(name));
      EXPECT_NE(NoVehicleText(name).find(name), std::string::npos);
    }
  }
  snapshot.epoch_ns = 1'000;
  snapshot.state.t_ns = 42;
  EXPECT_EQ(snapshot.time_stamp(), 1'042u);
}

// Five boxes in a row, each an entity; a merged mesh of two more.
ObjectIndex Boxes() {
  SceneBuilder builder("boxes");
  Material grey;
  builder.AddMaterial(grey);
  const auto box = [](std::vector<MeshPart> parts) {
    Mesh mesh;
    mesh.name = "box";
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 6}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    mesh.parts = std::move(parts);
    return mesh;
  };
  const MeshId one = builder.AddMesh(box({{0, 2, 0, kNoEntity}}));
  const CategoryId category = builder.tree().At("construction/building");
  for (const char* name : {"Box", "Box", "Tower", "tower_2", "Wall"}) {
    const EntityId entity = builder.AddEntity(name, category);
    builder.AddInstance({one, PlaceUpright({10.0f * static_cast<float>(entity), 0, 0}), entity});
  }
  const EntityId a = builder.AddEntity("Part A", category), b = builder.AddEntity("Part B", category);
  builder.AddInstance({builder.AddMesh(box({{0, 1, 0, a}, {1, 1, 0, b}})), {}, kNoEntity});
  return ObjectIndex(builder.Build());
}

TEST(ObjectIndex, FindsEveryEntityByItsNameAndByTheOneThatItWasGiven) {
  const ObjectIndex objects = Boxes();
  for (const Entity& entity : objects.scene().entities) {
    EXPECT_EQ(objects.Find(entity.name), entity.id);
    EXPECT_EQ(objects.NameOf(entity.id, {}), entity.name);
  }
  EXPECT_EQ(objects.Find("Box 3"), kNoEntity);
  EXPECT_EQ(objects.Find("box"), kNoEntity);
  const ObjectNames given{{objects.Find("Wall"), "Spawned"}};
  EXPECT_EQ(objects.Find("Spawned", given), objects.Find("Wall"));
  EXPECT_EQ(objects.Find("Wall", given), kNoEntity) << "the old name is gone";
  EXPECT_EQ(objects.NameOf(objects.Find("Wall"), given), "Spawned");
}

TEST(ObjectIndex, MatchesWholeNamesOfEitherCaseInTheOrderOfIds) {
  const ObjectIndex objects = Boxes();
  const auto names = [&](const char* regex, const ObjectNames& given = {}) {
    std::vector<std::string> found;
    for (EntityId id : objects.Match(regex, given)) found.push_back(objects.NameOf(id, given));
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names("box.*"), (Names{"Box", "Box 2"}));
  EXPECT_EQ(names("Box"), (Names{"Box"}));
  EXPECT_EQ(names("TOWER.*"), (Names{"Tower", "tower_2"}));
  EXPECT_EQ(names(".*").size(), 7u);
  EXPECT_EQ(names("nothing"), Names{});
  EXPECT_EQ(names("(Wall|Tower)"), (Names{"Tower", "Wall"}));
  EXPECT_EQ(names("new.*", {{objects.Find("Wall"), "New one"}}), (Names{"New one"}));
  EXPECT_THROW(objects.Match("(", {}), InputError);
}

TEST(ObjectIndex, MovesAnObjectAboutTheCentreOfItsBoxAndNotWhatIsMerged) {
  const ObjectIndex objects = Boxes();
  const EntityId tower = objects.Find("Tower");
  EXPECT_EQ(objects.InstancesOf(tower).size(), 1u);
  EXPECT_TRUE(objects.InstancesOf(objects.Find("Part A")).empty());
  EXPECT_TRUE(objects.InstancesOf(objects.Find("Part B")).empty());
  ObjectPlace place = objects.PlaceOf(tower);
  EXPECT_LT(Norm(place.X_WO.p - Vec3d{31, 2, 3}), 1e-6);
  std::vector<MovedInstance> moved;
  objects.Move(tower, place, moved);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_LT(Norm(moved[0].X_WM.p - Vec3f{30, 0, 0}), 1e-4f) << "unmoved where it is";
  place = {.X_WO = {BodyPose({}, kPi / 2, 0, 0).R, {5, 6, 7}}, .scale = {2, 1, 1}, .hidden = true};
  moved.clear();
  objects.Move(tower, place, moved);
  // The centre goes to the place; the corner (1, 2, 3) before it is twice as far along x, then turned.
  EXPECT_LT(Norm(moved[0].X_WM * Vec3f{1, 2, 3} - Vec3f{5, 6, 7}), 1e-4f);
  EXPECT_LT(Norm(moved[0].X_WM * Vec3f{2, 2, 3} - Vec3f{5, 8, 7}), 1e-4f);
  EXPECT_TRUE(moved[0].hidden);
}

TEST(Segmentation, IdsFollowFromNamesAndColoursAreDistinct) {
  EXPECT_EQ(DefaultSegmentationId(""), 5);
  EXPECT_EQ(DefaultSegmentationId("ABC 123"), 5);  // capitals and digits count for nothing
  EXPECT_EQ(DefaultSegmentationId("a"), 102);
  EXPECT_EQ(DefaultSegmentationId("zz"), (5 + 244) % 256);
  const ObjectIndex objects = Boxes();
  for (uint32_t id : InitialSegmentation(objects.scene(), "None")) EXPECT_EQ(id, 0u);
  const auto ids = InitialSegmentation(objects.scene(), "CommonObjectsRandomIDs");
  for (const Entity& entity : objects.scene().entities) EXPECT_EQ(static_cast<int>(ids[entity.id]), DefaultSegmentationId(entity.name));
  std::set<std::tuple<int, int, int>> seen;
  for (uint32_t id = 0; id < 1000; ++id) {
    const Rgb8 c = SegmentationColor(id);
    if (id < 256) {
      EXPECT_TRUE(seen.insert({c.r, c.g, c.b}).second) << id;
    } else {
      EXPECT_EQ(c.r + 256u * c.g + 65536u * c.b, id);
    }
  }
}

}  // namespace
}  // namespace airsim360

#include "airsim360/dataset/waypoint_set.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/planning/export/npz.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

struct Tower {
  Vec3d min, max;
};

std::vector<Tower> Towers() {
  std::vector<Tower> towers;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) towers.push_back({{30.0 * x + 4, 30.0 * y + 4, 0}, {30.0 * x + 16, 30.0 * y + 16, 15.0 + 5 * (x + 2)}});
  }
  return towers;
}

// Ground of 180 m with 25 towers.
std::shared_ptr<const Scene> Town() {
  SceneBuilder builder("town");
  const EntityId ground = builder.AddEntity("ground", builder.tree().At("ground/road"));
  const EntityId building = builder.AddEntity("towers", builder.tree().At("construction/building"));
  builder.AddInstance(
      {builder.AddMesh({"ground", {{-90, -90, 0}, {90, -90, 0}, {90, 90, 0}, {-90, 90, 0}}, {}, {}, {{0, 1, 2}, {0, 2, 3}}, {}}),
       {},
       ground});
  for (const Tower& t : Towers()) {
    Mesh mesh{"tower", {}, {}, {}, {}, {}};
    for (int i = 0; i < 8; ++i) {
      mesh.positions.push_back(VecCast<float>(Vec3d{i & 1 ? t.max.x : t.min.x, i & 2 ? t.max.y : t.min.y, i & 4 ? t.max.z : t.min.z}));
    }
    const uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) mesh.triangles.insert(mesh.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
    builder.AddInstance({builder.AddMesh(mesh), {}, building});
  }
  builder.SetSpawn({0, 0, 5});
  builder.AddSky();
  return builder.Build();
}

double DistanceToTown(Vec3d p) {
  double distance = p.z;
  for (const Tower& t : Towers()) distance = std::min(distance, Norm(Max(Max(t.min - p, p - t.max), Vec3d{})));
  return distance;
}

WaypointSetOptions Options(const fs::path& out, int64_t routes) {
  WaypointSetOptions options;
  options.out = out;
  options.most_routes = routes;
  options.worlds = {"city_park", "downtown_west", "sf_city"};
  options.exists = [](const std::string& name) { return name != "sf_city"; };
  options.open = [](const std::string&) { return std::make_shared<Stage>(Town()); };
  return options;
}

std::map<std::string, std::string> Files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder)] = ReadTextFile(entry.path());
  }
  return files;
}

class WaypointSet : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("airsim360_waypoint_set_" + std::to_string(::getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(WaypointSet, IsTheSameBytesForAnyThreadsShardsAndInterruptions) {
  const WaypointSetResult whole = WriteWaypointSet(Options(folder_ / "whole", 2));
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.written, 8);
  EXPECT_EQ(whole.skipped, std::vector<std::string>{"sf_city"});
  const auto expected = Files(folder_ / "whole");
  EXPECT_TRUE(expected.contains("statistics.json") && expected.contains("index.csv") && expected.contains("city_park/routes.svg"));
  {
    const ThreadLimit limit(1);
    for (int64_t shard = 0; shard < 2; ++shard) {
      WaypointSetOptions options = Options(folder_ / "shards", 2);
      options.shard = shard;
      options.shards = 2;
      EXPECT_EQ(WriteWaypointSet(options).complete, shard == 1);
    }
  }
  EXPECT_EQ(Files(folder_ / "shards"), expected);
  // What is lost is made again, the rest is left alone.
  fs::remove(folder_ / "whole/city_park/a3_v16_t0.5/part-0000.npz");
  fs::remove(folder_ / "whole/index.csv");
  EXPECT_EQ(WriteWaypointSet(Options(folder_ / "whole", 2)).written, 4);
  EXPECT_EQ(Files(folder_ / "whole"), expected);
  EXPECT_EQ(WriteWaypointSet(Options(folder_ / "whole", 2)).written, 0);
}

TEST_F(WaypointSet, EveryFlightKeepsItsLimitsItsLengthAndItsDistance) {
  WriteWaypointSet(Options(folder_, 4));
  int flights = 0;
  for (const WaypointWorld& world : WaypointWorlds()) {
    if (world.name != "city_park" && world.name != "downtown_west") continue;
    for (const KinematicSet& set : KinematicSets()) {
      std::map<std::string, NpzArray> arrays;
      for (NpzArray& array : ReadNpz(ReadTextFile(folder_ / world.name / set.name / "part-0000.npz"), "part")) arrays[array.name] = array;
      const auto& offset = arrays.at("segment_offset").values;
      const size_t powers = arrays.at("coefficients").shape.at(2);
      for (size_t row = 0; row + 1 < offset.size(); ++row, ++flights) {
        const auto first = static_cast<size_t>(offset[row]), last = static_cast<size_t>(offset[row + 1]);
        const auto& c = arrays.at("coefficients").values;
        const auto& d = arrays.at("durations").values;
        const PolynomialTrajectory path(static_cast<int>(powers) - 1, std::vector<double>(d.begin() + first, d.begin() + last),
                                        std::vector<double>(c.begin() + first * 3 * powers, c.begin() + last * 3 * powers));
        double length = 0, speed = 0, acceleration = 0, clearance = 1e9;
        constexpr int kTimes = 4000;
        TrajectoryPoint before = path.At(0);
        for (int i = 0; i <= kTimes; ++i) {
          const TrajectoryPoint point = path.At(path.duration() * i / kTimes);
          length += Norm(point.p - before.p);
          speed = std::max(speed, Norm(point.v));
          acceleration = std::max(acceleration, Norm(point.a));
          clearance = std::min(clearance, DistanceToTown(point.p));
          before = point;
        }
        EXPECT_LE(speed, set.max_speed * (1 + 1e-9));
        EXPECT_LE(acceleration, set.max_acceleration * (1 + 1e-9));
        EXPECT_GE(clearance, 0.5);
        EXPECT_GE(length, world.min_length * (1 - 1e-4));
        EXPECT_LE(length, world.max_length);
        // The samples are the polynomial, at rest at both ends.
        const auto& samples = arrays.at("samples").values;
        const auto sample = static_cast<size_t>(arrays.at("sample_offset").values[row]) + 2;
        const double* s = &samples[10 * sample];
        EXPECT_EQ(s[0], 2 * set.interval);
        EXPECT_EQ((Vec3d{s[1], s[2], s[3]}), path.At(s[0]).p);
        EXPECT_EQ((Vec3d{s[7], s[8], s[9]}), path.At(s[0]).a);
        EXPECT_LT(Norm(path.At(path.duration()).v), 1e-9);
      }
    }
  }
  EXPECT_EQ(flights, 16);
}

TEST_F(WaypointSet, RefusesAFolderOfAnotherSetAndUnknownWorlds) {
  WriteWaypointSet(Options(folder_, 1));
  WaypointSetOptions other = Options(folder_, 1);
  other.seed = 1;
  EXPECT_THROW(WriteWaypointSet(other), InputError);
  WaypointSetOptions unknown = Options(folder_, 1);
  unknown.worlds = {"atlantis"};
  EXPECT_THROW(WriteWaypointSet(unknown), InputError);
}

}  // namespace
}  // namespace airsim360

// People in datasets: records, resume, exports read back by their own rules.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "airsim360/base/file.h"
#include "airsim360/dataset/collector.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/people/person_record.h"
#include "airsim360/dataset/verify.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/sim/people/populate.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Pixels of a compressed run length text, by the rules of cocoapi's rleFrString.
std::vector<uint8_t> DecodeRle(const std::string& text, size_t size) {
  std::vector<int64_t> runs;
  for (size_t p = 0; p < text.size();) {
    int64_t x = 0;
    bool more = true;
    for (int k = 0; more; ++k) {
      const int64_t c = text[p++] - 48;
      x |= (c & 31) << (5 * k);
      more = (c & 32) != 0;
      if (!more && (c & 16) != 0) x |= -(int64_t{1} << (5 * (k + 1)));
    }
    if (runs.size() > 2) x += runs[runs.size() - 2];
    runs.push_back(x);
  }
  std::vector<uint8_t> mask;
  uint8_t value = 0;
  for (const int64_t run : runs) {
    mask.insert(mask.end(), static_cast<size_t>(run), value);
    value = !value;
  }
  mask.resize(size);
  return mask;
}

TEST(CocoRle, ComesBackByTheRulesOfCocoapi) {
  // A blob across the seam with a hole.
  Image<EntityId> entity(40, 20, 1);
  for (int y = 5; y < 15; ++y) {
    for (int x = 36; x < 45; ++x) entity(x % 40, y) = y == 9 && x == 41 ? 2 : 7;
  }
  const std::string text = CocoRle(entity, 7, {36, 5, 9, 10});
  const auto mask = DecodeRle(text, 40 * 20);
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 20; ++y) ASSERT_EQ(mask[static_cast<size_t>(x * 20 + y)], entity(x, y) == 7) << x << " " << y;
  }
}

class PeopleDatasetTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    populated_ = new PopulatedScene(Populate(LoadWorld({.world = "box_room"}), {.count = 5, .warm_up = 1, .level = 2, .seed = 4}));
    tracer_ = new std::shared_ptr<const RayTracer>(std::make_shared<const RayTracer>(populated_->scene));
  }
  PeopleDatasetTest() {
    folder_ = fs::temp_directory_path() / ("airsim360_people_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    spec_ = {};
    spec_.world = "box_room";
    spec_.width = 256;
    spec_.height = 128;
    spec_.frames = 3;
    spec_.route = "test";
    spec_.people = "5";
    spec_.crops = spec_.overlay = true;
    for (const char* format : kPeopleFormats) spec_.people_formats.push_back(format);
  }
  ~PeopleDatasetTest() override { fs::remove_all(folder_); }

  CollectResult Collected(const std::string& name) {
    // A camera that stands still while the people move, one tick a frame.
    Flight flight;
    auto people = std::make_shared<PeopleState>(*populated_->people->start);
    for (int64_t i = 0; i < spec_.frames; ++i) {
      const Kinematics body{BodyPose({0, 0, 2}, 0.8, 0, 0), {}, {}};
      flight.shots.push_back({i * kCrowdTickNs, body, std::make_shared<const PeopleState>(*people)});
      flight.trajectory.push_back({i * kCrowdTickNs, body, {}});
      TickPeople(*populated_->people, {}, *people);
    }
    const auto renderer = MakeCpuRenderer(*tracer_, {.tier = Tier::kFast});
    CollectInput input{spec_, *populated_->scene, flight, folder_ / name};
    input.people = populated_->people;
    input.tracer = *tracer_;
    return Collect(input, *renderer);
  }
  std::map<std::string, std::string> Tree(const std::string& name) const {
    std::map<std::string, std::string> tree;
    for (const std::string& file : ListFiles(folder_ / name)) tree[file] = std::string(AsText(ReadFile(folder_ / name / file)));
    return tree;
  }

  static inline PopulatedScene* populated_ = nullptr;
  static inline std::shared_ptr<const RayTracer>* tracer_ = nullptr;
  fs::path folder_;
  DatasetSpec spec_;
};

TEST_F(PeopleDatasetTest, EveryLineAgreesWithThePictures) {
  Collected("a");
  EXPECT_EQ(VerifyDataset(folder_ / "a").Damages(), 0);
  const std::string text = ReadTextFile(folder_ / "a/people.jsonl");
  int lines = 0, visible = 0, on = 0;
  ForEachLine(text, [&](const Json& line) {
    EXPECT_EQ(line["index"], lines++);
    const Image<EntityId> entity = DecodeIdPng(ReadFile(folder_ / "a/entity" / (line["stem"].get<std::string>() + ".png")), "entity");
    for (const Json& person : line["persons"]) {
      const EntityId id = person["entity_id"];
      EXPECT_EQ(populated_->people->refs.at(person["track_id"].get<size_t>() - 1).entity, id);
      const auto pixels = std::ranges::count(entity.pixels(), id);
      EXPECT_EQ(person["area"], pixels);
      ASSERT_EQ(person["keypoints"].size(), 51u);
      EXPECT_EQ(person["keypoint_state"].size(), static_cast<size_t>(kSocketCount));
      EXPECT_EQ(person["joint_q_wxyz_world"].size(), static_cast<size_t>(kJointCount));
      if (pixels == 0) continue;
      // The segmentation is the person's pixels, column by column.
      const auto mask = DecodeRle(person["segmentation"]["counts"], entity.size());
      for (int x = 0; x < 256; ++x) {
        for (int y = 0; y < 128; ++y) ASSERT_EQ(mask[static_cast<size_t>(x * 128 + y)], entity(x, y) == id);
      }
      for (size_t i = 0; i < 17; ++i) {
        if (person["keypoints"][3 * i + 2] != 2) continue;
        ++visible;
        const int x = static_cast<int>(person["keypoints"][3 * i].get<double>()),
                  y = static_cast<int>(person["keypoints"][3 * i + 1].get<double>());
        bool near = false;
        for (int k = 0; k < 9; ++k) near |= entity((x + k % 3 + 255) % 256, std::clamp(y + k / 3 - 1, 0, 127)) == id;
        on += near;
        if (!near) {
          std::printf("%s %s: keypoint %zu at %d, %d shows %u, range %s\n", person["name"].dump().c_str(),
                      person["behaviour"].dump().c_str(), i, x, y, entity(x, std::clamp(y, 0, 127)),
                      person["keypoints_sph"][i].dump().c_str());
        }
      }
      EXPECT_LE(person["visible_fraction"].get<double>(), 1);
    }
  });
  EXPECT_EQ(lines, 3);
  EXPECT_GT(visible, 20);
  // A pixel is 2.5 cm a metre away: thin limbs may miss all pixel centres. PeopleLabels has the exact bar.
  EXPECT_GE(on, 0.95 * visible) << on << " of " << visible;
}

TEST_F(PeopleDatasetTest, WhatIsMissingIsMadeAgainWithTheSameBytes) {
  Collected("whole");
  const auto whole = Tree("whole");
  for (const char* lost : {"people.jsonl", "entity/000001.png", "person_keypoints.json", "SHA256SUMS", "index.sqlite"}) {
    Collected("a");
    fs::remove(folder_ / "a" / lost);
    EXPECT_FALSE(Collected("a").already_complete) << lost;
    EXPECT_EQ(Tree("a"), whole) << lost;
  }
  EXPECT_TRUE(Collected("a").already_complete);
}

TEST_F(PeopleDatasetTest, ExportsKeepTheRulesOfTheirFormats) {
  Collected("a");
  // COCO: every annotation points to an image and is inside it.
  const Json coco = Json::parse(ReadTextFile(folder_ / "a/person_keypoints.json"));
  EXPECT_EQ(coco["images"].size(), 3u);
  ASSERT_GT(coco["annotations"].size(), 3u);
  EXPECT_EQ(coco["categories"][0]["keypoints"].size(), 17u);
  for (const Json& a : coco["annotations"]) {
    const Json& box = a["bbox"];
    EXPECT_GE(box[0].get<int>(), 0);
    EXPECT_LE(box[0].get<int>() + box[2].get<int>(), 256);
    EXPECT_GT(a["area"].get<int>(), 0);
  }
  // KITTI: fifteen columns, alpha = rotation_y - atan2(x, z).
  std::istringstream kitti(ReadTextFile(folder_ / "a/kitti/label_2/000000.txt"));
  std::string type;
  int people = 0;
  while (kitti >> type) {
    double v[14];
    for (double& x : v) ASSERT_TRUE(kitti >> x);
    EXPECT_TRUE(type == "Pedestrian" || type == "Person_sitting");
    EXPECT_NEAR(std::remainder(v[13] - std::atan2(v[10], v[12]) - v[2], 2 * std::numbers::pi), 0, 0.01);
    EXPECT_GT(v[7], 0.9);
    ++people;
  }
  EXPECT_EQ(people, 5);
  // Also where a tilted camera has the bottom of a box beside its middle.
  Json line = Json::parse(ReadTextFile(folder_ / "a/people.jsonl").substr(0, ReadTextFile(folder_ / "a/people.jsonl").find('\n')));
  for (Json& person : line["persons"]) person["box3d_cam"]["bottom"][0] = person["box3d_cam"]["bottom"][0].get<double>() + 1;
  std::istringstream tilted(internal::KittiLabels(line.dump() + "\n").front().text);
  int moved = 0;
  for (; tilted >> type; ++moved) {
    double v[14];
    for (double& x : v) ASSERT_TRUE(tilted >> x);
    EXPECT_NEAR(std::remainder(v[13] - std::atan2(v[10], v[12]) - v[2], 2 * std::numbers::pi), 0, 2e-3);
  }
  EXPECT_EQ(moved, 5);
  // nuScenes: tokens resolve, chains of annotations are as long as the instance says.
  std::map<std::string, Json> tables;
  for (const char* name : {"category", "attribute", "visibility", "instance", "sensor", "calibrated_sensor", "ego_pose", "log", "scene",
                           "sample", "sample_data", "sample_annotation", "map"})
    tables[name] = Json::parse(ReadTextFile(folder_ / "a/nuscenes/v1.0-airsim360" / (std::string(name) + ".json")));
  EXPECT_EQ(tables["sample"].size(), 3u);
  std::map<std::string, Json> annotations;
  for (const Json& a : tables["sample_annotation"]) annotations[a["token"]] = a;
  for (const Json& instance : tables["instance"]) {
    std::string token = instance["first_annotation_token"];
    int count = 0;
    for (; !token.empty(); token = annotations.at(token)["next"]) {
      EXPECT_EQ(annotations.at(token)["instance_token"], instance["token"]);
      ++count;
    }
    EXPECT_EQ(count, instance["nbr_annotations"]);
  }
  // MonoLoco: the ray of the target, and its length.
  const Json loco = Json::parse(ReadTextFile(folder_ / "a/monoloco.json"));
  const Json& train = loco["train"];
  ASSERT_EQ(train["X"].size(), train["Y"].size());
  ASSERT_GT(train["X"].size(), 3u);
  for (size_t i = 0; i < train["X"].size(); ++i) {
    EXPECT_EQ(train["X"][i].size(), 34u);
    const Json &y = train["Y"][i], &box = train["boxes_3d"][i];
    EXPECT_NEAR(y[3].get<double>(),
                std::sqrt(std::pow(box[0].get<double>(), 2) + std::pow(box[1].get<double>(), 2) + std::pow(box[2].get<double>(), 2)), 1e-6);
    // The crop looks at the person.
    EXPECT_GT(box[2].get<double>(), 0.9 * y[3].get<double>());
  }
  // Crops show their person in colour.
  int crops = 0;
  for (const std::string& file : ListFiles(folder_ / "a")) crops += file.starts_with("crops/");
  EXPECT_EQ(crops, static_cast<int>(coco["annotations"].size()));
}

}  // namespace
}  // namespace airsim360

// Training, files of networks, and files of people.
#include "airsim360/mpde/train.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/mpde/data_name.h"
#include "airsim360/mpde/evaluate.h"
#include "airsim360/mpde/table.h"
#include "airsim360/mpde/test_people.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::StickPerson;

std::vector<MpdeSet> Sticks() {
  MpdeSet set{.name = "sticks"};
  for (uint64_t i = 0; i < 40; ++i) set.shapes.push_back(StickPerson(1.35 + 0.002 * static_cast<double>(i), i));
  return {set};
}

MpdeTraining Small(uint64_t steps) {
  MpdeTraining training;
  training.network = {.hidden = 32, .stages = 1, .dropout = 0.1};
  training.steps = steps, training.batch = 128;
  return training;
}

std::vector<MpdeSample> Views(uint64_t count) {
  std::vector<MpdeSample> samples;
  for (uint64_t i = 0; i < count; ++i) {
    RngStream random(99, "test views", i);
    samples.push_back(DrawView(StickPerson(1.35 + 0.08 * random.Uniform(), i), {}, random));
  }
  return samples;
}

fs::path Scratch(const std::string& name) { return fs::temp_directory_path() / ("airsim360_mpde_" + name); }

// People of 1.35 to 1.43 m: by a stature of 1.72 m they seem a quarter farther away.
TEST(MpdeTraining, ANetworkLearnsWhatTheBaselineCannotTell) {
  MpdeModel model = TrainMpde(Sticks(), Small(800));
  const std::vector<MpdeSample> samples = Views(600);
  const MpdeReport report = Judge(Predict(model, samples), samples);
  EXPECT_LT(report.errors.distance_mae_m, report.constant_height_mae_m);
  EXPECT_LT(report.errors.angle_mae_deg, 35);  // by chance: 90
  EXPECT_GE(report.errors.angle_unwrapped_mae_deg, report.errors.angle_mae_deg);
  EXPECT_GT(report.within_spread, 0.4);
  EXPECT_LT(report.within_spread, 0.9);
  EXPECT_LT(report.distance_interval.low, report.errors.distance_mae_m);
  EXPECT_GT(report.distance_interval.high, report.errors.distance_mae_m);
}

TEST(MpdeTraining, TheWeightsDoNotDependOnTheNumberOfThreads) {
  const auto train = [](int threads) {
    const ThreadLimit limit(threads);
    return TrainMpde(Sticks(), Small(12));
  };
  const MpdeModel one = train(1), four = train(4);
  for (size_t t = 0; t < one.network.tensors().size(); ++t) EXPECT_EQ(one.network.tensors()[t].value, four.network.tensors()[t].value);
  MpdeTraining other = Small(12);
  other.seed = 1;
  EXPECT_NE(TrainMpde(Sticks(), other).network.tensors()[0].value, one.network.tensors()[0].value);
}

TEST(MpdeTraining, AdamWMovesByItsRateAndDecaysWeightsAlone) {
  // First step of Adam: every number with a gradient moves by the rate against its sign (Kingma and Ba 2015).
  Network<float> network({.inputs = 2, .hidden = 3, .stages = 0}, 1);
  std::vector<std::vector<float>> before;
  for (Tensor<float>& tensor : network.tensors()) {
    std::fill(tensor.gradient.begin(), tensor.gradient.end(), -0.7f);
    before.push_back(tensor.value);
  }
  AdamW optimiser(network);
  optimiser.Step(network, 0.01, 0.5);
  for (size_t t = 0; t < before.size(); ++t) {
    const Tensor<float>& tensor = network.tensors()[t];
    for (size_t i = 0; i < tensor.gradient.size(); ++i)
      EXPECT_NEAR(tensor.value[i], before[t][i] * (tensor.decays ? 1 - 0.01 * 0.5 : 1) + 0.01, 1e-5) << tensor.name;
    if (tensor.gradient.empty()) {
      EXPECT_EQ(tensor.value, before[t]);
    }
  }
}

TEST(MpdeTraining, SharesAreThoseOfTheBatches) {
  std::vector<MpdeSet> sets = Sticks();
  MpdeSample real;
  real.truth.distance = 1000;
  sets.push_back({.name = "real", .samples = {real}, .share = 0.25});
  const MpdeTraining training = Small(1);
  int of_real = 0;
  for (uint64_t row = 0; row < 4000; ++row) of_real += DrawSample(sets, training, 0, row).truth.distance == 1000;
  EXPECT_NEAR(of_real / 4000.0, 0.2, 0.03);
}

TEST(MpdeTraining, WhatCannotBeTrainedOnIsRefused) {
  EXPECT_THROW(TrainMpde({}, Small(1)), InputError);
  const std::vector<MpdeSet> empty = {{.name = "nobody"}};
  EXPECT_THROW(TrainMpde(empty, Small(1)), InputError);
  MpdeTraining bad = Small(1);
  bad.batch = 1;
  EXPECT_THROW(TrainMpde(Sticks(), bad), InputError);
  bad = Small(1), bad.steps = 2'000'000'000'000'000'000;
  EXPECT_THROW(TrainMpde(Sticks(), bad), InputError);
}

TEST(MpdeFile, ANetworkReadBackPredictsTheSame) {
  const fs::path file = Scratch("model.safetensors");
  MpdeModel model = TrainMpde(Sticks(), Small(5));
  model.training = "{\"why\": \"test\"}";
  WriteMpdeModel(model, file);
  MpdeModel read = ReadMpdeModel(file);
  EXPECT_EQ(read.training, model.training);
  const std::vector<MpdeSample> samples = Views(20);
  const std::vector<MpdePrediction> a = Predict(model, samples), b = Predict(read, samples);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].pose.distance, b[i].pose.distance);
  fs::remove(file);
}

TEST(MpdeFile, DamagedFilesAreRefused) {
  const fs::path file = Scratch("damaged.safetensors");
  WriteMpdeModel(TrainMpde(Sticks(), Small(1)), file);
  const std::string whole = std::string(AsText(ReadFile(file)));
  const auto refuses = [&](const std::string& bytes) {
    WriteFileAtomically(file, bytes);
    EXPECT_THROW(ReadMpdeModel(file), InputError) << bytes.substr(0, 60);
  };
  refuses("");
  refuses("1234567");
  refuses(whole.substr(0, whole.size() - 1));
  refuses(std::string(8, '\xff') + whole.substr(8));
  std::string text = whole;
  text.replace(text.find("\"hidden\":\"32\""), 13, "\"hidden\":\"99\"");
  refuses(text);
  text = whole;
  text.replace(text.find("[37,32]"), 7, "[32,37]");
  refuses(text);
  text = whole;
  const float nan = std::nanf("");
  std::memcpy(text.data() + text.size() - sizeof nan, &nan, sizeof nan);
  refuses(text);
  fs::remove(file);
}

const char* const kMonoloco =
    R"({"train": {"X": [[X1], [X2]], "Y": [[1.4, 1.5, 9.8, 10, 1.7, 0.6, 0.8, 0.6, 0.8, 0.1], [1.7, 1.5, 9.8, 10.2, 1.7, 0.6, 0.8, 0.6, -0.8, 0.1]],
  "names": ["a", "a"]}, "val": {"X": [], "Y": []}, "test": {"X": [], "Y": []}})";

std::string Monoloco(const std::string& x) {
  std::string text = kMonoloco, row = x;
  for (int i = 1; i < 34; ++i) row.append(",2");
  text.replace(text.find("X1"), 2, row);
  return text.replace(text.find("X2"), 2, row);
}

TEST(MpdeSources, MonolocosLayoutIsRead) {
  const fs::path file = Scratch("joints.json");
  WriteFileAtomically(file, Monoloco("-5"));
  const std::vector<MpdeSample> samples = ReadMonolocoFile(file, "train");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_FLOAT_EQ(samples[0].rays[0], -0.5f);
  EXPECT_FLOAT_EQ(samples[0].rays[33], 0.2f);
  EXPECT_EQ(samples[0].truth.distance, 10);
  EXPECT_NEAR(samples[0].truth.angle, std::atan2(0.6, 0.8), 1e-12);
  EXPECT_EQ(samples[0].person, samples[1].person);  // the mirrored copy
  EXPECT_EQ(ReadTrainingSets(ParseMpdeData(file.string() + "#1@0.5"), {}, 0).front().samples.size(), 2u);
  EXPECT_THROW(ReadTrainingSets(ParseMpdeData(file.string() + "#2"), {}, 0), InputError);
  EXPECT_THROW(ReadTestSamples(ParseMpdeData(file.string()), {}, 1, 0), InputError);  // nobody in val
  EXPECT_THROW(ReadMonolocoFile(file, "tset"), InputError);
  for (const char* bad : {"null", "\"a\"", "1e308", "1e999", "[2]", "2,2"}) {
    WriteFileAtomically(file, Monoloco(bad));
    EXPECT_THROW(ReadMonolocoFile(file, "train"), InputError) << bad;
  }
  for (const std::string& bad : {std::string("{"), std::string("[]"), std::string("{\"train\": 3}"), std::string(100000, '[')}) {
    WriteFileAtomically(file, bad);
    EXPECT_THROW(ReadMonolocoFile(file, "train"), InputError) << bad.substr(0, 20);
  }
  fs::remove(file);
}

// One person 10 m ahead of a level camera 1.5 m high at the origin that looks along +X: C is (-y, 1.5 - z, x) of the world.
std::string PeopleLine(bool pinhole, double fraction, int visible) {
  const PersonShape shape = StickPerson(1.8);
  std::string world, camera, pixels;
  for (size_t i = 0; i < 17; ++i) {
    const Vec3d p = shape.keypoints[i] + Vec3d{10, 0, 0}, c{-p.y, 1.5 - p.z, p.x};
    const auto triple = [](double x, double y, double z) {
      return "[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "]";
    };
    world += (i > 0 ? "," : "") + triple(p.x, p.y, p.z);
    camera += (i > 0 ? "," : "") + triple(c.x, c.y, c.z);
    const bool inside = static_cast<int>(i) < visible;
    pixels += (i > 0 ? "," : "") + std::to_string(inside ? 721 * c.x / c.z + 600 : 0) + "," +
              std::to_string(inside ? 721 * c.y / c.z + 180 : 0) + (inside ? ",2" : ",0");
  }
  return std::string(R"({"index":0,"camera":{"yaw_pitch_roll_deg":[0,-20,0])") +
         (pinhole ? R"(,"K":[[721,0,600],[0,721,180],[0,0,1]])" : "") +
         R"(},"persons":[{"track_id":3,"position_world":[10,0,0],"truncation":0,"visible_fraction":)" + std::to_string(fraction) +
         R"(,"keypoints":[)" + pixels + R"(],"keypoints_world":[)" + world + R"(],"keypoints_cam":[)" + camera +
         R"(],"box3d_world":{"center":[10,0,0.9],"yaw":0},"box3d_cam":{"center":[0,0.6,10],"rotation_y":-1.5707963}}]})" + "\n";
}

TEST(MpdeSources, PeopleOfOurPicturesAreReadAsTheirCamerasSeeThem) {
  const fs::path folder = Scratch("people");
  fs::create_directories(folder);
  const auto read = [&](const std::string& text, const PeopleFilter& filter = {}) {
    WriteFileAtomically(folder / "people.jsonl", text);
    return ReadPeopleFolder(folder, "", filter);
  };
  PeopleData data = read(PeopleLine(true, 1, 17) + PeopleLine(true, 1, 10));
  ASSERT_EQ(data.samples.size(), 2u);
  EXPECT_EQ(data.shapes.size(), 1u);  // one moment, two pictures
  EXPECT_NEAR(data.samples[0].truth.distance, std::hypot(10, 0.6), 1e-9);
  EXPECT_NEAR(data.samples[0].truth.angle, -std::numbers::pi / 2, 1e-6);  // walks away
  EXPECT_NEAR(ConstantHeightDistance(data.samples[0].rays), 10.0 * 1.72 / 1.8, 0.2);
  // Points outside the picture are where they would be.
  for (size_t i = 0; i < 34; ++i) EXPECT_NEAR(data.samples[0].rays[i], data.samples[1].rays[i], 1e-5);
  EXPECT_EQ(read(PeopleLine(true, 0.4, 17)).samples.size(), 0u);
  EXPECT_EQ(read(PeopleLine(true, 1, 7)).samples.size(), 0u);
  EXPECT_EQ(read(PeopleLine(false, 1, 17)).samples.size(), 0u);
  EXPECT_EQ(read(PeopleLine(false, 1, 17)).shapes.size(), 1u);
  EXPECT_EQ(read(PeopleLine(true, 1, 17), {.pitch_low_deg = -5, .pitch_high_deg = 5}).samples.size(), 0u);
  EXPECT_EQ(read(PeopleLine(true, 1, 17), {.pitch_low_deg = 15, .pitch_high_deg = 25}).samples.size(), 1u);
  EXPECT_THROW(read("{}\n"), InputError);
  EXPECT_THROW(read("not json\n"), InputError);
  EXPECT_THROW(ReadPeopleFolder(folder, "train", {}), InputError);  // no splits
  fs::remove_all(folder);
}

TEST(MpdeSources, NamesOfDataAreTakenApart) {
  const MpdeDataName name = ParseMpdeData("dir.d/joints.json:val#30@0.25");
  EXPECT_EQ(name.path, "dir.d/joints.json");
  EXPECT_EQ(name.split, "val");
  EXPECT_EQ(name.persons, 30u);
  EXPECT_EQ(name.share, 0.25);
  EXPECT_EQ(ParseMpdeData("a@b/people").path, "a@b/people");
  for (const char* bad : {"a@x", "a@0", "a@-1", "a@nan", "a#-3", "a#1e9", ":train", ""})
    EXPECT_THROW(ParseMpdeData(bad), InputError) << bad;
}

TEST(MpdeTable, HasThePapersRowsOnWhateverIsAtHand) {
  const fs::path folder = Scratch("table");
  for (const char* split : {"train", "test"}) {
    fs::create_directories(folder / "w" / split);
    WriteFileAtomically(folder / "w" / split / "people.jsonl", PeopleLine(true, 1, 17));
  }
  WriteFileAtomically(folder / "subsets.json", std::string(R"([{"subset":"w/train","split":"train"},{"subset":"w/test","split":"test"}])"));
  MpdeTableOptions options;
  options.people = folder.string(), options.training = Small(2), options.seeds = 2, options.test_samples = 50;
  int trained = 0;
  // All pictures look 20 degrees down: the row of level ones falls back on virtual cameras.
  const MpdeTable table = MakeMpdeTable(options, [&](const std::string&) { ++trained; });
  EXPECT_EQ(trained, 8);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_FALSE(table.base_is_real);
  const std::vector<MpdeCell>& cells = table.rows[1].cells;
  double all = 0, weight = 0;
  for (size_t i = 0; i < 4; ++i)
    all += cells[i].distance_m.mean * static_cast<double>(kMpdeTests[i].weight), weight += static_cast<double>(kMpdeTests[i].weight);
  EXPECT_NEAR(table.rows[1].all.distance_m.mean, all / weight, 1e-9);
  // A real test set is read of the split that is named: val, of which this file has nobody, unless another is.
  const fs::path real = folder / "joints.json";
  WriteFileAtomically(real, Monoloco("-5"));
  options.seeds = 1, options.real["freeman"] = real.string();
  EXPECT_THROW(MakeMpdeTable(options, [](const std::string&) {}), InputError);
  options.real["freeman"] += ":train";
  const MpdeTable with_real = MakeMpdeTable(options, [](const std::string&) {});
  EXPECT_EQ(with_real.test_is_real, (std::vector<bool>{false, false, true, false}));
  EXPECT_EQ(with_real.test_count, (std::vector<int64_t>{50, 50, 2, 1}));
  EXPECT_EQ(with_real.rows[0].cells[0].distance_m.mean, MakeMpdeTable(options, [](const std::string&) {}).rows[0].cells[0].distance_m.mean);
  options.real["kity"] = "x";
  EXPECT_THROW(MakeMpdeTable(options, [](const std::string&) {}), InputError);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace airsim360

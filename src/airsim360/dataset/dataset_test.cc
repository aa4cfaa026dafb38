#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/collector.h"
#include "airsim360/dataset/encode_extra.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/dataset/verify.h"
#include "airsim360/image/codecs.h"
#include "airsim360/scene/parts.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A folder of its own for each test, removed at its end.
class DatasetTest : public ::testing::Test {
 protected:
  DatasetTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("airsim360_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    SceneBuilder builder("open");
    builder.AddSky();
    builder.AddAttribution("Elm, by A. Author, CC-BY 4.0");
    scene_ = builder.Build();
    spec_ = {};
    spec_.world = "open";
    spec_.width = 16;
    spec_.height = 8;
    spec_.frames = 4;
    spec_.route = "test";
  }
  ~DatasetTest() override { fs::remove_all(folder_); }

  // Flies east, one shot a second, and collects with the renderer that sees only sky.
  CollectResult Collected(const std::string& name) {
    Flight flight;
    for (int64_t i = 0; i < spec_.frames; ++i) {
      const Kinematics body{BodyPose({static_cast<double>(i), 0, 2}, 0.1 * static_cast<double>(i), 0, 0), {1, 0, 0}, {}};
      flight.shots.push_back({i * 1'000'000'000, body});
      flight.trajectory.push_back({i * 1'000'000'000, body, {}});
    }
    const auto renderer = MakeNullRenderer(scene_);
    return Collect({spec_, *scene_, flight, folder_ / name}, *renderer);
  }

  // Relative path -> content of every file.
  std::map<std::string, std::string> Tree(const std::string& name) const {
    std::map<std::string, std::string> tree;
    for (const std::string& file : ListFiles(folder_ / name)) tree[file] = std::string(AsText(ReadFile(folder_ / name / file)));
    return tree;
  }

  fs::path folder_;
  std::shared_ptr<const Scene> scene_;
  DatasetSpec spec_;
};

TEST_F(DatasetTest, HoldsTheFilesOfTheLayout) {
  const CollectResult result = Collected("a");
  EXPECT_EQ(result.written, 4);
  std::vector<std::string> expected = {"README.md",    "SHA256SUMS", "contact_sheet.png", "entities.json", "frames.jsonl",
                                       "index.sqlite", "meta.json",  "panoptic.json",     "trajectory.csv"};
  for (const char* stem : {"000000", "000001", "000002", "000003"}) {
    for (const char* folder : {"rgb/", "semantic/", "entity/"}) expected.push_back(std::string(folder) + stem + ".png");
    expected.push_back(std::string("range/") + stem + ".exr");
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(ListFiles(folder_ / "a"), expected);
  EXPECT_EQ(VerifyDataset(folder_ / "a").findings.size(), 0u);
}

TEST_F(DatasetTest, FrameLinesHoldExactPosesAndHashes) {
  Collected("a");
  std::ifstream lines(folder_ / "a/frames.jsonl");
  std::string line;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    const Json frame = Json::parse(line);
    EXPECT_EQ(frame["index"], i);
    EXPECT_EQ(frame["stem"], Stem(i));
    EXPECT_EQ(frame["t_ns"], i * 1'000'000'000ll);
    EXPECT_EQ(frame["X_WC"]["p"], Json({double(i), 0.0, 2.0}));
    const Quaternion q = ToQuaternion((BodyPose({}, 0.1 * i, 0, 0) * CameraInBody()).R);
    EXPECT_EQ(frame["X_WC"]["q_wxyz"], Json({q.w, q.x, q.y, q.z}));  // bit for bit
    EXPECT_EQ(frame["pano_frame"], "body");
    EXPECT_EQ(frame["sha256"].size(), 4u);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(DatasetTest, PanopticHasOneAnnotationForEachPictureAndAreasOfAllPixels) {
  Collected("a");
  const Json panoptic = Json::parse(ReadTextFile(folder_ / "a/panoptic.json"));
  ASSERT_EQ(panoptic["images"].size(), 4u);
  ASSERT_EQ(panoptic["annotations"].size(), 4u);
  const Json& segment = panoptic["annotations"][1]["segments_info"][0];
  EXPECT_EQ(segment["area"], 16 * 8);
  EXPECT_EQ(segment["bbox"], Json({0, 0, 16, 8}));
  EXPECT_EQ(segment["bbox_wrap"], Json({0, 0, 16, 8}));
  EXPECT_EQ(segment["iscrowd"], 0);
  EXPECT_EQ(panoptic["categories"][0]["name"], "sky");
  EXPECT_EQ(panoptic["categories"][0]["isthing"], 0);
}

TEST_F(DatasetTest, ACompleteDatasetIsLeftAlone) {
  Collected("a");
  const auto before = Tree("a");
  const auto time = fs::last_write_time(folder_ / "a/frames.jsonl");
  const CollectResult again = Collected("a");
  EXPECT_TRUE(again.already_complete);
  EXPECT_EQ(again.written, 0);
  EXPECT_EQ(Tree("a"), before);
  EXPECT_EQ(fs::last_write_time(folder_ / "a/frames.jsonl"), time);
}

TEST_F(DatasetTest, AnythingMissingIsMadeAgainWithTheSameBytes) {
  Collected("whole");
  const auto whole = Tree("whole");
  for (const char* lost : {"rgb/000002.png", "entity/000000.png", "panoptic.json", "SHA256SUMS", "index.sqlite"}) {
    Collected("a");
    fs::remove(folder_ / "a" / lost);
    std::ofstream(folder_ / "a/range/000001.exr.tmp") << "half";  // what a killed run leaves
    const CollectResult result = Collected("a");
    EXPECT_FALSE(result.already_complete) << lost;
    EXPECT_EQ(Tree("a"), whole) << lost;
  }
}

TEST_F(DatasetTest, IndexDoesNotDependOnTheOrderOfFrames) {
  Collected("a");
  const auto whole = Tree("a");
  // Lose and remake frames one after the other, so that the journal sees them in another order.
  for (const char* lost : {"rgb/000000.png", "rgb/000002.png"}) {
    fs::remove(folder_ / "a" / lost);
    Collected("a");
  }
  EXPECT_EQ(Tree("a"), whole);
}

TEST_F(DatasetTest, ShardsTogetherAreTheWholeDataset) {
  Collected("whole");
  spec_.shards = 3;
  std::map<std::string, std::string> together;
  for (spec_.shard = 0; spec_.shard < 3; ++spec_.shard) {
    Collected(std::to_string(spec_.shard));
    for (const auto& [name, bytes] : Tree(std::to_string(spec_.shard))) {
      if (name.find('/') == std::string::npos) continue;
      EXPECT_TRUE(together.emplace(name, bytes).second) << name;
    }
  }
  auto whole = Tree("whole");
  std::erase_if(whole, [](const auto& file) { return file.first.find('/') == std::string::npos; });
  EXPECT_EQ(together, whole);
}

TEST_F(DatasetTest, OtherParametersInTheSameFolderAreRefusedByName) {
  Collected("a");
  const auto before = Tree("a");
  spec_.seed = 7;
  try {
    Collected("a");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("seed is 0 there, 7 here"), std::string::npos) << error.what();
  }
  EXPECT_EQ(Tree("a"), before);
}

TEST_F(DatasetTest, AFolderWithOtherFilesIsRefused) {
  fs::create_directories(folder_ / "b");
  std::ofstream(folder_ / "b/holiday.jpg") << "x";
  EXPECT_THROW(Collected("b"), InputError);
  EXPECT_EQ(ListFiles(folder_ / "b"), std::vector<std::string>{"holiday.jpg"});
}

TEST_F(DatasetTest, AFolderInUseIsRefused) {
  Collected("a");
  const FolderLock lock(folder_ / "a");
  EXPECT_THROW(Collected("a"), RuntimeError);
}

TEST_F(DatasetTest, VerifyNamesEveryDamage) {
  Collected("a");
  // Flip one bit, lose one file, add one.
  std::fstream file(folder_ / "a/range/000001.exr", std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(200);
  const char byte = static_cast<char>(file.get() ^ 1);
  file.seekp(200);
  file.put(byte);
  file.close();
  fs::remove(folder_ / "a/semantic/000003.png");
  std::ofstream(folder_ / "a/notes.txt") << "x";
  const VerifyResult result = VerifyDataset(folder_ / "a");
  ASSERT_EQ(result.findings.size(), 3u);
  EXPECT_EQ(result.findings[0].path, "notes.txt");
  EXPECT_EQ(result.findings[0].kind, Finding::Kind::kExtra);
  EXPECT_EQ(result.findings[1].path, "range/000001.exr");
  EXPECT_EQ(result.findings[1].kind, Finding::Kind::kDamaged);
  EXPECT_EQ(result.findings[2].path, "semantic/000003.png");
  EXPECT_EQ(result.findings[2].kind, Finding::Kind::kMissing);
  EXPECT_EQ(result.Damages(), 2);
}

TEST_F(DatasetTest, VerifyFindsLabelsThatDisagreeBothWays) {
  Collected("a");
  std::string text = ReadTextFile(folder_ / "a/panoptic.json");
  const size_t id = text.find("{\"id\":1,\"category_id\"");
  ASSERT_NE(id, std::string::npos);
  text.replace(id, 7, "{\"id\":9");
  WriteFileAtomically(folder_ / "a/panoptic.json", text);
  bool found = false;
  for (const Finding& finding : VerifyDataset(folder_ / "a").findings) found |= finding.kind == Finding::Kind::kLabels;
  EXPECT_TRUE(found);
}

TEST_F(DatasetTest, VerifyRefusesWhatIsNoDataset) { EXPECT_THROW(VerifyDataset(folder_), InputError); }

TEST_F(DatasetTest, CardNamesAttributionsAndClasses) {
  Collected("a");
  const std::string card = ReadTextFile(folder_ / "a/README.md");
  EXPECT_NE(card.find("Elm, by A. Author, CC-BY 4.0"), std::string::npos);
  EXPECT_NE(card.find("| `sky` | stuff | 1 | 512 | 100.000 | 100.000 |"), std::string::npos) << card;
}

TEST_F(DatasetTest, CubeCapturesAreSixPicturesOfOneFrame) {
  spec_ = {};
  spec_.command = "render";
  spec_.world = "open";
  spec_.projection = Projection::kCube;
  spec_.width = 8;
  spec_.height = 8;
  spec_.route = "pose";
  Collected("cube");
  EXPECT_TRUE(fs::exists(folder_ / "cube/rgb/000000_+x.png"));
  EXPECT_TRUE(fs::exists(folder_ / "cube/range/000000_-z.exr"));
  EXPECT_EQ(Json::parse(ReadTextFile(folder_ / "cube/panoptic.json"))["images"].size(), 6u);
  EXPECT_EQ(VerifyDataset(folder_ / "cube").Damages(), 0);
}

TEST_F(DatasetTest, ProductsOnRequestHaveTheirFilesAndFlowNamesThePoseItLeadsTo) {
  for (const ProductInfo& product : kProducts) spec_.products.*product.wanted = !product.needs_light;
  Collected("a");
  for (const ProductInfo& product : kProducts) {
    if (product.needs_light) continue;  // the null renderer has none
    for (const char* stem : {"000000", "000003"}) {
      EXPECT_TRUE(fs::exists(folder_ / "a" / product.name / (stem + std::string(product.extension)))) << product.name;
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "a" / "materials.json"));
  EXPECT_EQ(Json::parse(ReadTextFile(folder_ / "a" / "parts.json"))["2"]["name"], "door");
  EXPECT_EQ(VerifyDataset(folder_ / "a").findings.size(), 0u);

  // The pose that flow leads to is that of the next frame; after the last one the body flies on.
  std::vector<Json> lines;
  std::ifstream file(folder_ / "a" / "frames.jsonl");
  for (std::string line; std::getline(file, line);) lines.push_back(Json::parse(line));
  ASSERT_EQ(lines.size(), 4u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(lines[i]["X_WC_next"], lines[i + 1]["X_WC"]);
  EXPECT_EQ(lines[3]["X_WC_next"]["p"], Json({4.0, 0.0, 2.0}));
}

TEST(EncodeExtra, PartsTellTheGlassOfABuildingFromItsWallAndFromOtherGlass) {
  SceneBuilder builder("parts");
  const CategoryId building = builder.tree().At("construction/building"), lamp = builder.tree().At("furniture/lighting/street_light");
  Material glass, wall;
  glass.name = "glass dark";
  wall.name = "brick";
  builder.AddMaterial(glass);
  builder.AddMaterial(wall);
  const auto scene = builder.Build();
  Frame frame;
  frame.semantic = Image<CategoryId>(4, 1);
  frame.material = Image<uint16_t>(4, 1);
  for (int x = 0; x < 3; ++x) frame.semantic(x, 0) = x == 2 ? lamp : building;
  frame.material(0, 0) = frame.material(2, 0) = 1;
  frame.material(1, 0) = 2;
  const Image<uint16_t> parts = DecodeGrayPng(internal::EncodeExtra("part", frame, *scene), "part");
  EXPECT_EQ(parts(0, 0), static_cast<uint8_t>(Part::kWindow));
  EXPECT_EQ(parts(1, 0), 0);
  EXPECT_EQ(parts(2, 0), 0);
  EXPECT_EQ(parts(3, 0), 0);
}

TEST(EncodeExtra, FlowAndCoverageReadBackExactly) {
  Frame frame;
  frame.flow = Image<FlowPixel>(3, 2);
  frame.flow(2, 1) = {-1.5f, 0.25f, 17.125f, 1, {0.1f, -0.2f, 0.3f}};
  frame.coverage = Image<CoveragePixel>(3, 2);
  frame.coverage(1, 0) = {{16777215, 4, 0, 0}, {0.75f, 0.25f, 0, 0}};
  SceneBuilder builder("empty");
  const auto scene = builder.Build();
  const Bytes flow = internal::EncodeExtra("flow", frame, *scene);
  EXPECT_EQ(DecodeExrChannel(flow, "flow", "dx")(2, 1), -1.5f);
  EXPECT_EQ(DecodeExrChannel(flow, "flow", "dy")(2, 1), 0.25f);
  EXPECT_EQ(DecodeExrChannel(flow, "flow", "range")(2, 1), 17.125f);
  EXPECT_EQ(DecodeExrChannel(flow, "flow", "occluded")(2, 1), 1.0f);
  EXPECT_EQ(DecodeExrChannel(flow, "flow", "motion.Z")(2, 1), 0.3f);
  EXPECT_THROW(DecodeExrChannel(flow, "flow", "dz"), InputError);
  const Bytes coverage = internal::EncodeExtra("coverage", frame, *scene);
  EXPECT_EQ(DecodeExrChannel(coverage, "coverage", "id.0")(1, 0), 16777215.0f);
  EXPECT_EQ(DecodeExrChannel(coverage, "coverage", "share.1")(1, 0), 0.25f);
}

TEST(Version, IsThatOfTheProject) {
  const std::string cmake = ReadTextFile("CMakeLists.txt");
  EXPECT_NE(cmake.find(std::string("project(airsim360 VERSION ") + kVersion + " "), std::string::npos);
}

}  // namespace
}  // namespace airsim360

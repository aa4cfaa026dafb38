#include "airsim360/assets/labels/labels.h"

#include <gtest/gtest.h>

#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/assets/labels/label_names.h"
#include "airsim360/assets/labels/label_rules.h"
#include "airsim360/assets/labels/labelling.h"
#include "airsim360/assets/labels/words.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

TEST(Words, NamesSplitAtCaseDigitsAndMarks) {
  EXPECT_EQ(SplitWords("streetLamps_03.Left"), (std::vector<std::string>{"street", "lamp", "left"}));
  EXPECT_EQ(SplitWords("HTMLTree"), (std::vector<std::string>{"html", "tree"}));
  EXPECT_EQ(SplitWords("Leaves buses glass benches"), (std::vector<std::string>{"leaf", "bus", "glass", "bench"}));
}

std::string CategoryOf(const std::string& name) {
  const auto match = FindKeyword(name);
  return match ? std::string(match->category) : "";
}

TEST(Keywords, NamesFindTheirCategory) {
  EXPECT_EQ(CategoryOf("Citroen Old Van"), "vehicle/van");
  EXPECT_EQ(CategoryOf("Ice_cream_truck.002"), "vehicle/food_truck");
  EXPECT_EQ(CategoryOf("busStop"), "furniture/transit/bus_stop");
  EXPECT_EQ(CategoryOf("CityBus"), "vehicle/bus");
  EXPECT_EQ(CategoryOf("Ferris_Wheel"), "furniture/recreation/ferris_wheel");
  EXPECT_EQ(CategoryOf("pine-tree-17"), "vegetation/tree/conifer/pine");
  EXPECT_EQ(CategoryOf("car_wheel_FL"), "vehicle/car");
  EXPECT_EQ(CategoryOf("houseDoor"), "construction/door");
  EXPECT_EQ(CategoryOf("Cube.001"), "");
  EXPECT_EQ(CategoryOf("scarf"), "");  // "car" is inside, but no word of it
}

// Of 199 names, 94 of which tell something, one is missed ("box_A"); none is told wrongly. With every keyword of the
// same weight there were 31 false positives, one wrong category and 13 missed.
TEST(Keywords, OfNamesOfPublicModelsNoneIsToldWronglyAndFewAreMissed) {
  std::vector<std::string> wrong, missed;
  for (const LabelledName& labelled : kLabelledNames) {
    const NameKind kind = labelled.kind == 'm' ? NameKind::kMaterial : labelled.kind == 'f' ? NameKind::kFile : NameKind::kNode;
    const auto match = FindKeyword(labelled.name, kind);
    const std::string told = match ? std::string(match->category) : "", is = labelled.is;
    bool right = told.empty() && is.empty();
    for (size_t begin = 0; !is.empty() && begin <= is.size();) {
      const size_t end = std::min(is.find('|', begin), is.size());
      right |= told.starts_with(is.substr(begin, end - begin));
      begin = end + 1;
    }
    if (!right) (told.empty() ? missed : wrong).push_back(std::string(labelled.name) + ": " + told);
  }
  EXPECT_EQ(wrong, (std::vector<std::string>{}));
  EXPECT_LE(missed.size(), 1u) << missed.back();
}

TEST(Keywords, AllLeadToWellFormedCategories) {
  SemanticTree tree;
  for (const char* name : {"car", "well", "helicopter", "windmill", "wheel", "door", "leaf", "street light", "traffic light", "person"}) {
    const auto match = FindKeyword(name);
    ASSERT_TRUE(match) << name;
    EXPECT_NO_THROW(tree.At(match->category)) << name;
  }
}

TEST(Keywords, PartsBelongToTheirOwner) {
  EXPECT_EQ(CategoryOfPart("vehicle", "vehicle/car"), "vehicle/car");
  EXPECT_EQ(CategoryOfPart("construction/window", "construction/house"), "construction/window");
  EXPECT_EQ(CategoryOfPart("construction/window", "vehicle/bus"), "vehicle/bus");
  EXPECT_EQ(CategoryOfPart("vehicle", ""), "vehicle");
}

// Nodes with one triangle each: (name, parent, materials of its parts).
struct TestNode {
  std::string name;
  int parent;
  std::vector<std::string> materials;
};

ImportedFile MakeFile(const std::vector<TestNode>& nodes) {
  ImportedFile file;
  for (const TestNode& node : nodes) {
    ImportedNode out{node.name, node.parent, -1, {}};
    if (!node.materials.empty()) {
      Mesh mesh;
      for (const std::string& material : node.materials) {
        const auto base = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        mesh.parts.push_back({static_cast<uint32_t>(mesh.triangles.size()), 1, static_cast<MaterialId>(file.materials.size()), kNoEntity});
        mesh.triangles.push_back({base, base + 1, base + 2});
        file.materials.emplace_back().name = material;
      }
      mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
      out.mesh = static_cast<int32_t>(file.meshes.size());
      file.meshes.push_back(mesh);
    }
    file.nodes.push_back(out);
  }
  return file;
}

std::vector<std::string> Paths(const std::vector<TestNode>& nodes, const std::string& rules = "", const std::string& title = "file") {
  const auto scene = AssembleScene(MakeFile(nodes), ParseLabelRules("r.yaml", rules), title, "file.glb");
  std::vector<std::string> paths;
  for (const Entity& entity : scene->entities) paths.push_back(entity.name + ": " + scene->tree[entity.category].path);
  return paths;
}

using Lines = std::vector<std::string>;

TEST(Labelling, NamelessChildrenAndPartsTakeTheirAncestorsCategory) {
  EXPECT_EQ(Paths({{"Old Truck", -1, {}}, {"Cube", 0, {"m"}}, {"wheel.L", 0, {"rubber"}}, {"stone", -1, {"m"}}}),
            (Lines{"Cube: vehicle/truck", "wheel.L: vehicle/truck", "stone: nature/rock", "sky: sky"}));
}

TEST(Labelling, TheFilesNameSpeaksForNamelessNodes) {
  EXPECT_EQ(Paths({{"", -1, {"Material.001"}}}, "", "helicopter"), (Lines{"helicopter: vehicle/helicopter", "sky: sky"}));
  EXPECT_EQ(Paths({{"Sphere", -1, {"x"}}, {"tree", -1, {"x"}}, {"bench", -1, {"x"}}}, "", "car"),
            (Lines{"Sphere: object", "tree: vegetation/tree/broadleaf/generic", "bench: furniture/seating/bench", "sky: sky"}));
}

TEST(Labelling, AFilesNameOfAmbiguousWordsSpeaksForNothing) {
  for (const char* title : {"hotel-room-lotus-carpet", "PropertyTable", "zero-sized-bin-chunk", "BoxTextured"})
    EXPECT_EQ(Paths({{"", -1, {"Material.001"}}}, "", title), (Lines{std::string(title) + ": object", "sky: sky"}));
  EXPECT_EQ(Paths({{"TempleLeft", -1, {"temples"}}, {"Frames", -1, {"x"}}}, "", "SunglassesKhronos"),
            (Lines{"TempleLeft: object", "Frames: object", "sky: sky"}));
}

TEST(Labelling, PartsBelongToTheKindThatMostOfTheFileIs) {
  // A car of many meshes with a seat among them: its windows are no windows of a house.
  EXPECT_EQ(Paths({{"Lamborghini_Body", -1, {"x"}},
                   {"Lamborghini Doors", -1, {"x"}},
                   {"Seat", -1, {"x"}},
                   {"Wheel", -1, {"x"}},
                   {"WindowTransparent", -1, {"x"}}}),
            (Lines{"Lamborghini_Body: vehicle/car", "Lamborghini Doors: vehicle/car", "Seat: furniture/seating/chair", "Wheel: vehicle/car",
                   "WindowTransparent: vehicle/car", "sky: sky"}));
  // A street: the windows are those of houses.
  EXPECT_EQ(Paths({{"car", -1, {"x"}}, {"car 2", -1, {"x"}}, {"house", -1, {"x"}}, {"Window", -1, {"x"}}}).at(3),
            "Window: construction/window");
  // An engine on a bench makes no vehicle.
  EXPECT_EQ(Paths({{"engine", -1, {"x"}}}), (Lines{"engine: object", "sky: sky"}));
}

TEST(Labelling, RulesThatMatchNothingAreTold) {
  testing::internal::CaptureStderr();
  Paths({{"tree", -1, {"m"}}},
        "rules:\n  - {match: 'zzz*', category: object}\n  - {match: 'tr*', category: object}\n"
        "  - {match: 'a/b', name: x}\n  - {match: tree, name: y}\n");
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(Contains(told, {"r.yaml:2: rule 1 ('zzz*') matches nothing\n", "r.yaml:4: rule 3 ('a/b') matches nothing\n",
                              "r.yaml:5: rule 4 ('tree') matches nothing that an earlier rule has not matched"}));
  EXPECT_EQ(told.find("'tr*'"), std::string::npos);
}

TEST(Labelling, OneMeshOfManyGroundsIsSplitByMaterial) {
  EXPECT_EQ(Paths({{"Mesh", -1, {"asphalt", "grass_dry", "Material"}}}),
            (Lines{"Mesh grass_dry: ground/grass", "Mesh asphalt: ground/road", "sky: sky"}));
}

TEST(Labelling, RulesWinOverKeywordsAndTheFirstThatMatchesCounts) {
  const std::string rules = R"(
rules:
  - match: "tree*"
    category: vegetation/tree/palm
    name: palm
  - match: "*"
    category: object
)";
  EXPECT_EQ(Paths({{"Tree_1", -1, {"m"}}, {"car", -1, {"m"}}}, rules), (Lines{"palm: vegetation/tree/palm", "car: object", "sky: sky"}));
}

TEST(Labelling, MergedNodesAreOneEntityAndMaterialsCanBeSplitOff) {
  const std::string rules = R"({"rules": [
    {"match": "grass*", "category": "ground/grass", "entity": "merge"},
    {"match": "*/*/tyre", "category": "vehicle/car/wheel", "name": "wheel"}]})";
  EXPECT_EQ(Paths({{"grass 1", -1, {"m"}}, {"grass 2", -1, {"m"}}, {"car", -1, {"paint", "tyre"}}}, rules),
            (Lines{"grass: ground/grass", "car paint: vehicle/car", "wheel: vehicle/car/wheel", "sky: sky"}));
}

TEST(Labelling, NewCategoriesInheritFromTheirParents) {
  const auto scene =
      AssembleScene(MakeFile({{"a", -1, {"m"}}}), ParseLabelRules("r", "rules: [{match: a, category: ground/road/tarmac}]"), "t", "f");
  const Category& category = scene->tree[scene->entities[0].category];
  EXPECT_EQ(category.path, "ground/road/tarmac");
  EXPECT_FALSE(category.thing);
  EXPECT_EQ(category.cityscapes, 7);
}

TEST(Labelling, KeywordsCanBeTurnedOff) {
  EXPECT_EQ(Paths({{"car", -1, {"m"}}}, "keywords: false\ndefault: furniture/misc"), (Lines{"car: furniture/misc", "sky: sky"}));
}

std::string RuleError(const std::string& text) {
  try {
    Paths({{"car", -1, {"m"}}}, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LabelRules, MistakesNameLineColumnAndTheNearestChoice) {
  EXPECT_TRUE(Contains(RuleError("rule:\n  - match: a"), {"r.yaml:1:1", "'rules'"}));
  EXPECT_TRUE(Contains(RuleError("rules:\n  - match: a\n    categorie: b"), {"r.yaml:3:5", "'category'"}));
  EXPECT_TRUE(Contains(RuleError("rules:\n  - match: a\n    entity: all"), {"r.yaml:3:13", "each, merge"}));
  EXPECT_TRUE(Contains(RuleError("rules:\n  - category: object"), {"r.yaml:2:5", "no match"}));
  EXPECT_TRUE(Contains(RuleError("rules: [{match: a, category: b"), {"r.yaml:1:"}));
  EXPECT_TRUE(Contains(RuleError("rules:\n\n  - match: car\n    category: Vehicle Car"), {"r.yaml:3", "malformed category"}));
  EXPECT_TRUE(Contains(RuleError("- a\n"), {"a mapping"}));
  EXPECT_EQ(RuleError(""), "no error");
}

TEST(LabelRules, GlobsTakeLinearTime) {
  EXPECT_TRUE(MatchesGlob("Wheel?", "wheel1"));
  EXPECT_TRUE(MatchesGlob("*a*b*", "xxaYYbzz"));
  EXPECT_FALSE(MatchesGlob("a*b", "ac"));
  EXPECT_FALSE(MatchesGlob(std::string(50, '*') + "b", std::string(10000, 'a')));
}

}  // namespace
}  // namespace airsim360::internal

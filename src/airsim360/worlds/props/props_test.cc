#include "airsim360/worlds/props/props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

bool IsFinite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool SameMesh(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs && a.triangles == b.triangles;
}

bool SamePictures(const Model& a, const Model& b) {
  if (a.textures.size() != b.textures.size()) return false;
  for (size_t i = 0; i < a.textures.size(); ++i) {
    if (a.textures[i].name != b.textures[i].name || a.textures[i].levels[0] != b.textures[i].levels[0]) return false;
  }
  return true;
}

bool SameColors(const Model& a, const Model& b) {
  return std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
                    [](const Material& x, const Material& y) { return x.base_color == y.base_color && x.name == y.name; });
}

// A library with one model: a square of 2 m x 4 m x 1 m, painted "paint" and "rubber".
class OneModel : public ModelSource {
 public:
  explicit OneModel(std::string name) : name_(std::move(name)) {}
  std::optional<Model> Load(std::string_view name) const override {
    if (name != name_) return std::nullopt;
    Model model;
    model.mesh.name = name_;
    model.mesh.positions = {{-1, -2, 0}, {1, -2, 0}, {1, 2, 1}};
    model.mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
    model.mesh.parts = {{0, 1, 0, kNoEntity}, {1, 1, 1, kNoEntity}};
    model.materials.resize(2);
    model.materials[0].name = "firstcolor";
    model.materials[1].name = "rubber";
    model.attribution = "Square, Nobody, CC0-1.0";
    return model;
  }

 private:
  std::string name_;
};

std::vector<std::string> KindNames() {
  std::vector<std::string> names;
  for (const PropKind& kind : PropKinds()) names.emplace_back(kind.name);
  return names;
}

class EveryKind : public testing::TestWithParam<std::string> {
 protected:
  const PropKind& kind() const { return FindPropKind(GetParam()); }
  Model MakeAnew(int variant) const { return MakeProp(kind(), static_cast<uint32_t>(variant), 7, nullptr); }
  // Made once for all tests: the pictures of all boards take seconds.
  const Model& Make(int variant) const {
    static std::map<std::pair<std::string, int>, Model> made;
    const auto [place, is_new] = made.try_emplace({GetParam(), variant});
    if (is_new) place->second = MakeAnew(variant);
    return place->second;
  }
};

INSTANTIATE_TEST_SUITE_P(Props, EveryKind, testing::ValuesIn(KindNames()), [](const auto& info) { return info.param; });

TEST_P(EveryKind, HasACategoryOfTheTree) { EXPECT_TRUE(SemanticTree().Find(kind().category)) << kind().category; }

TEST_P(EveryKind, StandsOnTheGroundAtItsSize) {
  for (int v = 0; v < kind().variants; ++v) {
    const Box3f box = Make(v).mesh.Bounds();
    // Roots, stakes and footings may go below the ground; a tarp hangs in the air.
    EXPECT_GE(box.min.z, -0.301f) << "variant " << v;
    if (GetParam() != "tarp") {
      EXPECT_LE(box.min.z, 0.02f) << "variant " << v;
    }
    EXPECT_GE(box.max.z, kind().min_height) << "variant " << v;
    EXPECT_LE(box.max.z, kind().max_height) << "variant " << v;
  }
}

TEST_P(EveryKind, KeepsItsTriangleBudget) {
  for (int v = 0; v < kind().variants; ++v) {
    const size_t triangles = Make(v).mesh.triangles.size();
    EXPECT_GE(triangles, 12u);
    EXPECT_LE(triangles, kind().max_triangles) << "variant " << v;
  }
}

TEST_P(EveryKind, HasFiniteVerticesUnitNormalsAndUvs) {
  for (int v = 0; v < kind().variants; ++v) {
    const Model& model = Make(v);
    const Mesh& mesh = model.mesh;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      ASSERT_TRUE(IsFinite(mesh.positions[i]));
      ASSERT_NEAR(Norm(mesh.normals[i]), 1, 1e-3) << "variant " << v << ", vertex " << i;
      ASSERT_TRUE(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y));
    }
  }
}

TEST_P(EveryKind, UsesEveryMaterialAndTextureItBrings) {
  for (int v = 0; v < kind().variants; ++v) {
    const Model& model = Make(v);
    std::set<MaterialId> used;
    for (const MeshPart& part : model.mesh.parts) used.insert(part.material);
    EXPECT_EQ(used.size(), model.materials.size()) << "variant " << v;
    std::set<TextureId> shown;
    for (const Material& m : model.materials) {
      for (TextureId id : {m.base_color_texture, m.normal_texture}) {
        if (id != kNoTexture) shown.insert(id);
      }
    }
    EXPECT_EQ(shown.size(), model.textures.size()) << "variant " << v;
    EXPECT_TRUE(used.empty() || *used.rbegin() < model.materials.size());
  }
}

TEST_P(EveryKind, HasShadingNormalsOnTheSideOfItsFaces) {
  // Leaves soften their normals towards the crown, so this is asked of solid surfaces.
  const Model& model = Make(0);
  const Mesh& mesh = model.mesh;
  size_t faces = 0, wrong = 0;
  for (const MeshPart& part : mesh.parts) {
    if (model.materials[part.material].kind == SurfaceKind::kFoliage) continue;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = mesh.triangles[k];
      const Vec3f n = Cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
      const Vec3f shading = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
      ++faces;
      wrong += Norm(n) > 1e-9f && Dot(n, shading) < 0;
    }
  }
  EXPECT_LE(wrong, faces / 50);
}

TEST_P(EveryKind, IsTheSameFromTheSameSeed) {
  const Model &a = Make(0), b = MakeAnew(0);
  EXPECT_TRUE(SameMesh(a.mesh, b.mesh));
  EXPECT_TRUE(SamePictures(a, b));
}

TEST_P(EveryKind, HasVariantsThatDiffer) {
  for (int v = 1; v < kind().variants; ++v) {
    const Model &a = Make(v - 1), &b = Make(v);
    EXPECT_FALSE(SameMesh(a.mesh, b.mesh) && SamePictures(a, b) && SameColors(a, b)) << "variants " << v - 1 << " and " << v;
  }
}

TEST_P(EveryKind, MakesASceneThatPassesItsChecks) {
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 3);
  const EntityId entity = shelf.Place(GetParam(), {10, 20, 0}, 0.3f, 1);
  const auto scene = builder.Build();
  EXPECT_EQ(scene->entity(entity).category, scene->tree.At(kind().category));
  EXPECT_EQ(scene->entity(entity).name, GetParam());
  EXPECT_TRUE(scene->entity(entity).bounds.Contains({10, 20, scene->entity(entity).bounds.center().z}));
  EXPECT_EQ(scene->meshes.size(), static_cast<size_t>(kind().variants));
}

TEST_P(EveryKind, IsTheSameEntityWithAndWithoutAModelOfTheLibrary) {
  for (size_t v = 0; v < kind().library.size(); ++v) {
    const OneModel library{std::string(kind().library[v].name)};
    if (kind().library[v].name.empty()) continue;
    for (const ModelSource* models : {static_cast<const ModelSource*>(&library), static_cast<const ModelSource*>(nullptr)}) {
      EXPECT_EQ(MakeProp(kind(), static_cast<uint32_t>(v), 7, models).mesh.triangles.size() == 2, models != nullptr);
      SceneBuilder builder("shelf");
      PropShelf shelf(builder, models, 7);
      const EntityId entity = shelf.Place(GetParam(), {}, 0, static_cast<uint32_t>(v));
      const auto scene = builder.Build();
      EXPECT_EQ(scene->tree[scene->entity(entity).category].path, kind().category);
      EXPECT_EQ(scene->entity(entity).name, GetParam());
      EXPECT_EQ(scene->attributions.size(), models != nullptr ? 1u : 0u);
    }
  }
}

TEST(PropKinds, AreSortedAndHaveDistinctNames) {
  const auto& kinds = PropKinds();
  for (size_t i = 1; i < kinds.size(); ++i) EXPECT_LT(kinds[i - 1].name, kinds[i].name);
}

// Instructions name it by its colour.
TEST(PropKinds, TheOrangeMailboxIsOrangeAndTheOtherBlue) {
  const auto painted = [](const char* name, auto&& is) {
    const Model model = FindPropKind(name).make(0, 0);
    return std::ranges::any_of(model.materials, [&](const Material& m) { return m.name.starts_with("paint") && is(m.base_color); });
  };
  const auto orange = [](Vec3f c) { return c.x > 3 * c.y && c.y > 3 * c.z; };
  const auto blue = [](Vec3f c) { return c.z > 3 * c.y && c.y > 3 * c.x; };
  EXPECT_TRUE(painted("orange_mailbox", orange));
  EXPECT_FALSE(painted("orange_mailbox", blue));
  EXPECT_TRUE(painted("mailbox", blue));
}

TEST(PropKinds, UnknownNameIsAnInputErrorWithTheNearest) {
  try {
    FindPropKind("bench_wod");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bench_wood"), std::string::npos) << error.what();
  }
}

TEST(PropKinds, TogetherStayWithinTheTrianglesOfAWorld) {
  size_t sum = 0;
  for (const PropKind& kind : PropKinds()) sum += static_cast<size_t>(kind.variants) * kind.max_triangles;
  EXPECT_LE(sum, 5'300'000u);
}

TEST(PropShelf, InstancesOneMeshForManyPlaces) {
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 3);
  const EntityId a = shelf.Place("fire_hydrant", {0, 0, 0}), b = shelf.Place("fire_hydrant", {5, 0, 0});
  shelf.PlaceAs(a, "fire_hydrant", PlaceUpright({0, 9, 0}));
  const auto scene = builder.Build();
  EXPECT_NE(a, b);
  ASSERT_EQ(scene->instances.size(), 3u);
  EXPECT_EQ(scene->instances[0].mesh, scene->instances[1].mesh);
  EXPECT_EQ(scene->instances[2].entity, a);
  EXPECT_EQ(scene->entities.size(), 2u);
  EXPECT_EQ(scene->entity(b).name, "fire_hydrant 2");
}

// Pots by shop doors, vans at a kerb: neighbours are other individuals, whoever asks for the same one.
TEST(PropShelf, NeighboursAreOtherIndividuals) {
  for (const auto& [kind, pitch, least] :
       {std::tuple{"pot", 3.1f, 10u}, {"green_pot", 2.9f, 8u}, {"planter", 4.9f, 8u}, {"van", 6.2f, 2u}}) {
    for (const bool by_chance : {false, true}) {
      SceneBuilder builder("shelf");
      PropShelf shelf(builder, nullptr, 3);
      RngStream random(8, kind);
      for (int i = 0; i < 60; ++i) shelf.Place(kind, {pitch * static_cast<float>(i), 2, 0}, 0, by_chance ? random.Index(36) : 0);
      const auto scene = builder.Build();
      std::set<MeshId> individuals;
      for (size_t i = 0; i < 60; ++i) {
        individuals.insert(scene->instances[i].mesh);
        for (size_t k = i + 1; k < 60 && pitch * static_cast<float>(k - i) < PropShelf::kOwnLook; ++k)
          EXPECT_NE(scene->instances[i].mesh, scene->instances[k].mesh) << kind << " " << i << " and " << k;
      }
      if (by_chance) {
        EXPECT_GE(individuals.size(), least) << kind;
      }
    }
  }
}

TEST(PropShelf, PotsAreOfTheirOwnSizeTurnAndToneWithinTheirGround) {
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 3);
  for (int i = 0; i < 80; ++i) shelf.Place("pot", {3.1f * static_cast<float>(i), 0, 0});
  const auto scene = builder.Build();
  std::set<int> sizes, turns, tones;
  for (const Instance& pot : scene->instances) {
    const Vec3f along = pot.X_WM.A.column(0);
    EXPECT_LE(Norm(along), 1.0001f);
    EXPECT_GE(Norm(along), 0.75f);
    sizes.insert(static_cast<int>(100 * Norm(along)));
    turns.insert(static_cast<int>(10 * std::atan2(along.y, along.x)));
    tones.insert(static_cast<int>(100 * pot.tint.y));
  }
  EXPECT_GE(sizes.size(), 18u);
  EXPECT_GE(turns.size(), 30u);
  EXPECT_GE(tones.size(), 20u);
}

// Tints that plants get where they are placed.
std::vector<Vec3f> TintsOf(const char* kind, const std::vector<Vec3f>& places) {
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 3);
  for (Vec3f p : places) shelf.Place(kind, p);
  std::vector<Vec3f> tints;
  for (const Instance& instance : builder.Build()->instances) tints.push_back(instance.tint);
  return tints;
}

TEST(PropShelf, MakesAStandInUnderTheNameOfWhatWasAskedFor) {
  SceneBuilder builder("street");
  PropShelf shelf(builder, nullptr, 1);
  shelf.Replace("car", "car_1950s");
  shelf.Replace("ac_unit", "roof_cowl");
  shelf.Place("car", {0, 0, 0}, 0, 3);
  shelf.Place("ac_unit", {9, 0, 0}, 0, 1);
  shelf.Place("van", {20, 0, 0});
  EXPECT_THROW(shelf.Replace("car", "car_1960s"), InputError);
  const auto scene = builder.Build();
  const auto placed = [&](size_t i) {
    const Entity& entity = scene->entities[i];
    return entity.name + " of " + scene->tree[entity.category].path + " as " + scene->meshes[scene->instances[i].mesh].name;
  };
  ASSERT_EQ(scene->entities.size(), 3u);
  EXPECT_EQ(placed(0), "car of vehicle/car as car_1950s");
  // Of another category: it goes by its own name.
  EXPECT_EQ(placed(1), "roof_cowl of construction/rooftop/ventilation_tube as roof_cowl");
  EXPECT_EQ(placed(2), "van of vehicle/van as van");
}

TEST(PropShelf, GivesEveryTreeAGreenOfItsOwn) {
  std::vector<Vec3f> places;
  for (int i = 0; i < 60; ++i) places.push_back({7.3f * static_cast<float>(i % 10), 9.1f * static_cast<float>(i / 10), 0});
  const std::vector<Vec3f> tints = TintsOf("tree_generic", places);
  ASSERT_EQ(tints.size(), places.size());
  EXPECT_EQ(tints, TintsOf("tree_generic", places));
  std::set<float> yellow;
  double brightest = 0, darkest = 2;
  for (Vec3f t : tints) {
    yellow.insert(t.x / t.y);
    brightest = std::max<double>(brightest, t.y);
    darkest = std::min<double>(darkest, t.y);
  }
  EXPECT_GT(yellow.size(), 55u);
  EXPECT_GT(*yellow.rbegin() - *yellow.begin(), 0.12f);
  EXPECT_GT(brightest / darkest, 1.15);
  EXPECT_EQ(TintsOf("bench_wood", {{7.3f, 9.1f, 0}}).at(0), (Vec3f{1, 1, 1}));
}

// A hedge is planted a metre at a time: no joint of it may show.
TEST(PropShelf, ChangesTheGreenOfAHedgeSlowlyAlongIt) {
  std::vector<Vec3f> places;
  for (int i = 0; i < 80; ++i) places.push_back({static_cast<float>(i), 0.4f * static_cast<float>(i), 0});
  const std::vector<Vec3f> tints = TintsOf("hedge", places);
  double darkest = 2, brightest = 0;
  for (size_t i = 0; i < tints.size(); ++i) {
    darkest = std::min<double>(darkest, tints[i].y);
    brightest = std::max<double>(brightest, tints[i].y);
    const Vec3f before = tints[i > 0 ? i - 1 : 0];
    EXPECT_NEAR(tints[i].y / before.y, 1, 0.02) << i;
  }
  EXPECT_GT(brightest / darkest, 1.05);
}

TEST(PropShelf, SharesEqualTexturesAndMaterialsBetweenProps) {
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, nullptr, 3);
  shelf.Place("bench_wood", {});
  shelf.Place("dining_chair", {});
  shelf.Place("dining_table", {});
  const auto scene = builder.Build();
  EXPECT_EQ(std::count_if(scene->textures.begin(), scene->textures.end(), [](const Texture& t) { return t.name == "wood"; }), 1);
  for (size_t i = 0; i < scene->materials.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Material &a = scene->materials[i], &b = scene->materials[j];
      EXPECT_FALSE(a.name == b.name && a.base_color == b.base_color && a.roughness == b.roughness &&
                   a.base_color_texture == b.base_color_texture && a.uv_rotation == b.uv_rotation)
          << a.name;
    }
  }
}

TEST(PropShelf, GivesTheSameSceneWithAnyNumberOfThreads) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    SceneBuilder builder("shelf");
    PropShelf shelf(builder, nullptr, 3);
    for (const char* kind : {"tree_generic", "shrub", "car"}) shelf.Place(kind, {});
    return builder.Build();
  };
  const auto one = build(1), many = build(0);
  ASSERT_EQ(one->meshes.size(), many->meshes.size());
  for (size_t i = 0; i < one->meshes.size(); ++i) EXPECT_TRUE(SameMesh(one->meshes[i], many->meshes[i])) << one->meshes[i].name;
}

TEST(PropShelf, PrefersTheModelOfTheLibraryAndRecordsItsAttribution) {
  const PropKind& car = FindPropKind("car");
  const auto row = std::find_if(car.library.begin(), car.library.end(), [](const LibraryModel& m) { return m.name == "suv"; });
  ASSERT_NE(row, car.library.end());
  const OneModel library("suv");
  SceneBuilder builder("shelf");
  PropShelf shelf(builder, &library, 3);
  shelf.Place("car", {}, 0, static_cast<uint32_t>(row - car.library.begin()));
  const auto scene = builder.Build();
  EXPECT_EQ(scene->meshes[scene->instances[0].mesh].triangles.size(), 2u);
  ASSERT_EQ(scene->attributions.size(), 1u);
  EXPECT_EQ(scene->attributions[0], "Square, Nobody, CC0-1.0");
  // Its paint has the colour of the row, its other materials their own.
  const Mesh& mesh = scene->meshes[scene->instances[0].mesh];
  EXPECT_EQ(scene->materials[mesh.parts[0].material].base_color, row->color);
  EXPECT_EQ(scene->materials[mesh.parts[1].material].base_color, Material{}.base_color);
}

TEST(MakeProp, TurnsAndScalesALibraryModelAsItsRowAsks) {
  PropKind kind = FindPropKind("car");
  kind.library = {{"square", 3.0f, 90.0f}};
  const OneModel library("square");
  const Box3f box = MakeProp(kind, 0, 1, &library).mesh.Bounds();
  // 2 x 4 x 1 m becomes 3 m high and lies across.
  EXPECT_NEAR(box.max.z, 3, 1e-5);
  EXPECT_NEAR(box.size().x, 12, 1e-4);
  EXPECT_NEAR(box.size().y, 6, 1e-4);
}

TEST(MakeProp, FallsBackToTheProceduralOneWhereTheLibraryLacksTheModel) {
  const OneModel library("something else");
  const Model with = MakeProp(FindPropKind("car"), 0, 1, &library), without = MakeProp(FindPropKind("car"), 0, 1, nullptr);
  EXPECT_TRUE(SameMesh(with.mesh, without.mesh));
  EXPECT_TRUE(with.attribution.empty());
}

}  // namespace
}  // namespace airsim360

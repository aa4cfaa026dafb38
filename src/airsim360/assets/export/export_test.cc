#include "airsim360/assets/export/export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/importing/import.h"

namespace airsim360 {
namespace {

Texture Checker() {
  Image<Rgba8> image(4, 4);
  for (int i = 0; i < 16; ++i) {
    const auto grey = static_cast<uint8_t>(40 + 11 * i);
    image.pixels()[i] = {grey, 200, 30, static_cast<uint8_t>(i % 3 == 0 ? 0 : 255)};
  }
  return Texture::FromImage("checker", image, true);
}

Mesh Square(MaterialId front, MaterialId back) {
  Mesh mesh;
  mesh.name = "square";
  mesh.positions = {{0, 0, 0.1f}, {1, 0, 0.3f}, {1, 1, 0.7f}, {0, 1, 1.0f / 3}};
  mesh.normals.assign(4, Normalized(Vec3f{0.1f, -0.2f, 1}));
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 1, front, kNoEntity}, {1, 1, back, kNoEntity}};
  return mesh;
}

/// A little of everything: two entities in one mesh, one mesh in two instances, a mirrored one, all kinds.
std::shared_ptr<const Scene> Everything() {
  SceneBuilder builder("everything");
  builder.AddSky();
  const TextureId checker = builder.AddTexture(Checker());
  const MaterialId leaf = builder.AddMaterial({.name = "leaf",
                                               .kind = SurfaceKind::kFoliage,
                                               .alpha_mode = AlphaMode::kMask,
                                               .alpha_cutoff = 0.25f,
                                               .roughness = 0.5f,
                                               .transmission = 0.75f,
                                               .base_color_texture = checker,
                                               .uv_scale = {2, 0.5f}});
  const MaterialId lamp = builder.AddMaterial({.name = "bulb",
                                               .base_color = {0.1f, 0.2f, 0.3f},
                                               .metallic = 0.5f,
                                               .roughness = 0.25f,
                                               .emission = {8, 4, 2},
                                               .clear_coat = 1,
                                               .clear_coat_roughness = 0.0625f,
                                               .lamp = true,
                                               .macro_variation = 0.125f});
  const MaterialId pane = builder.AddMaterial({.name = "pane", .kind = SurfaceKind::kGlass, .interior = true});
  const CategoryId tree = builder.tree().At("vegetation/tree"), car = builder.tree().At("vehicle/car");
  const EntityId first = builder.AddEntity("first", tree), second = builder.AddEntity("second", car),
                 third = builder.AddEntity("third", car);
  Mesh shared = Square(leaf, pane), merged = Square(lamp, leaf);
  merged.parts[0].entity = first;
  merged.parts[1].entity = third;
  const MeshId square = builder.AddMesh(shared), two = builder.AddMesh(merged);
  builder.AddInstance({square, PlaceUpright({3, 4, 5}, 0.3f, 2), second, {0.5f, 1, 0.25f}});
  AffineTransform mirrored = PlaceUpright({-3, 0, 1}, 1.1f);
  mirrored.A = mirrored.A * Mat3f::FromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  builder.AddInstance({square, mirrored, third});
  builder.AddInstance({two, {}, kNoEntity});
  return builder.Build();
}

/// The scene after a way out and back in.
std::shared_ptr<const Scene> RoundTrip(const Scene& scene) {
  // Tests run side by side: a file for each.
  const auto file =
      std::filesystem::path(testing::TempDir()) / (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".glb");
  WriteFileAtomically(file, EncodeGlb(scene));
  const auto back = ImportScene(file);
  std::filesystem::remove(file);
  return back;
}

/// Corners of all triangles in W with the name of their entity, in any order.
std::vector<std::tuple<std::string, std::string, float, float, float>> Corners(const Scene& scene) {
  std::vector<std::tuple<std::string, std::string, float, float, float>> out;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      const Entity& entity = scene.entity(part.entity != kNoEntity ? part.entity : instance.entity);
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        for (uint32_t v : {mesh.triangles[t].x, mesh.triangles[t].y, mesh.triangles[t].z}) {
          const Vec3f p = instance.X_WM * mesh.positions[v];
          out.emplace_back(entity.name, scene.tree[entity.category].path, p.x, p.y, p.z);
        }
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(EncodeGlb, ComesBackWithTheSameTrianglesNamesAndCategories) {
  const auto scene = Everything(), back = RoundTrip(*scene);
  EXPECT_EQ(Corners(*back), Corners(*scene));
  EXPECT_EQ(back->entities.size(), scene->entities.size());  // the sky included
}

TEST(EncodeGlb, KeepsTintsOfInstances) {
  const auto scene = Everything(), back = RoundTrip(*scene);
  const auto tinted = std::find_if(back->instances.begin(), back->instances.end(),
                                   [&](const Instance& i) { return back->entity(i.entity).name == "second"; });
  ASSERT_NE(tinted, back->instances.end());
  EXPECT_EQ(tinted->tint, (Vec3f{0.5f, 1, 0.25f}));
}

TEST(EncodeGlb, KeepsMaterials) {
  const auto scene = Everything();
  const auto back = RoundTrip(*scene);
  for (const Material& before : scene->materials) {
    const auto after =
        std::find_if(back->materials.begin(), back->materials.end(), [&](const Material& m) { return m.name == before.name; });
    ASSERT_NE(after, back->materials.end()) << before.name;
    EXPECT_EQ(after->kind, before.kind);
    EXPECT_EQ(after->alpha_mode, before.alpha_mode);
    EXPECT_FLOAT_EQ(after->alpha_cutoff, before.alpha_cutoff);
    EXPECT_EQ(after->base_color, before.base_color);
    EXPECT_FLOAT_EQ(after->metallic, before.metallic);
    EXPECT_FLOAT_EQ(after->roughness, before.roughness);
    EXPECT_EQ(after->emission, before.emission);
    EXPECT_FLOAT_EQ(after->transmission, before.transmission);
    EXPECT_FLOAT_EQ(after->macro_variation, before.macro_variation);
    EXPECT_FLOAT_EQ(after->clear_coat, before.clear_coat);
    EXPECT_FLOAT_EQ(after->clear_coat_roughness, before.clear_coat > 0 ? before.clear_coat_roughness : 0.03f);
    EXPECT_EQ(after->interior, before.interior);
    EXPECT_EQ(after->lamp, before.lamp);
    ASSERT_EQ(after->base_color_texture == kNoTexture, before.base_color_texture == kNoTexture);
    if (before.base_color_texture == kNoTexture) continue;
    EXPECT_EQ(back->textures[after->base_color_texture].levels[0], scene->textures[before.base_color_texture].levels[0]);
  }
}

/// Two rooms of a town: entities without surfaces between those that have some, the sky first, weather, traces of use.
std::shared_ptr<const Scene> Street() {
  SceneBuilder builder("street");
  builder.AddSky();
  builder.AddAttribution("a bench, CC-BY");
  builder.SetSpawn({3, -7, 1.7f}, 37);
  builder.environment().sun_azimuth_deg = 100;
  builder.environment().cloud_cover = 0.8;
  builder.environment().wetness = 0.25;
  builder.environment().lamps = Lamps::kOn;
  const auto category = [&](const char* path) { return builder.tree().At(path); };
  const EntityId lost = builder.AddEntity("way/7", category("ground/road")), road = builder.AddEntity("way/8", category("ground/road")),
                 odd = builder.AddEntity("tower", builder.tree().Add("construction/tower/odd", true)),
                 house = builder.AddEntity("house", category("construction/house"));
  static_cast<void>(lost), static_cast<void>(odd);
  const TextureId checker = builder.AddTexture(Checker());
  const MaterialId asphalt = builder.AddMaterial({.name = "asphalt",
                                                  .emission = {3.3f, 1.1f, 0.7f},
                                                  .macro_variation = 0.2f,
                                                  .base_color_texture = checker,
                                                  .uv_scale = {0.3f, 0.7f},
                                                  .uv_offset = {0.1f, 0.2f},
                                                  .uv_rotation = 0.4f,
                                                  .ground = GroundWear::kCarriageway,
                                                  .blend_tiles = true,
                                                  .units = {3, 5}});
  Mesh flat = Square(asphalt, asphalt), round = Square(asphalt, asphalt);
  flat.normals.clear();
  const MeshId a = builder.AddMesh(flat), b = builder.AddMesh(round);
  builder.AddInstance({b, PlaceUpright({0, 5, 0}, 0.1f, 1), house});
  builder.AddInstance({a, PlaceUpright({3, 1, 0}, 0.7f, 3), road});
  builder.AddInstance({b, PlaceUpright({9, 5, 0}, 0.2f, 1), house});
  return builder.Build();
}

TEST(EncodeGlb, KeepsWhatIsNoSurface) {
  const auto scene = Street(), back = RoundTrip(*scene);
  ASSERT_EQ(back->entities.size(), scene->entities.size());
  for (size_t i = 0; i < scene->entities.size(); ++i) {
    EXPECT_EQ(back->entities[i].name, scene->entities[i].name);
    EXPECT_EQ(back->tree[back->entities[i].category].path, scene->tree[scene->entities[i].category].path);
  }
  EXPECT_EQ(back->sky_entity, scene->sky_entity);
  EXPECT_EQ(DescribeEnvironment(back->environment), DescribeEnvironment(scene->environment));
  EXPECT_EQ(back->environment.lamps, Lamps::kOn);
  EXPECT_EQ(back->spawn, scene->spawn);
  EXPECT_EQ(back->spawn_yaw_deg, 37);
  EXPECT_EQ(back->attributions, scene->attributions);
  ASSERT_EQ(back->instances.size(), scene->instances.size());
  for (size_t i = 0; i < scene->instances.size(); ++i) {
    const Instance &x = back->instances[i], &y = scene->instances[i];
    EXPECT_EQ(x.entity, y.entity);
    EXPECT_EQ(x.X_WM, y.X_WM);
    const Mesh &m = back->meshes[x.mesh], &n = scene->meshes[y.mesh];
    EXPECT_EQ(m.positions, n.positions);
    EXPECT_EQ(m.normals, n.normals);
    EXPECT_EQ(m.uvs, n.uvs);
    const Material &p = back->materials[m.parts[0].material], &q = scene->materials[n.parts[0].material];
    EXPECT_EQ(p.ground, q.ground);
    EXPECT_EQ(p.blend_tiles, q.blend_tiles);
    EXPECT_EQ(p.units, q.units);
    EXPECT_EQ(p.uv_scale, q.uv_scale);
    EXPECT_EQ(p.uv_offset, q.uv_offset);
    EXPECT_EQ(p.uv_rotation, q.uv_rotation);
    EXPECT_EQ(p.emission, q.emission);
  }
}

TEST(EncodeGlb, ARoomWithoutASkyComesBackWithoutOne) {
  SceneBuilder builder("room");
  builder.SetInteriorLight({0.5f, 0.25f, 0.125f});
  const MaterialId grey = builder.AddMaterial({.name = "grey"});
  builder.AddInstance({builder.AddMesh(Square(grey, grey)), {}, builder.AddEntity("wall", builder.tree().At("construction/wall"))});
  const auto back = RoundTrip(*builder.Build());
  EXPECT_EQ(back->sky_entity, kNoEntity);
  EXPECT_EQ(back->interior_light, (Vec3f{0.5f, 0.25f, 0.125f}));
}

TEST(EncodeGlb, IsDeterministic) { EXPECT_EQ(EncodeGlb(*Everything()), EncodeGlb(*Everything())); }

TEST(EncodeGlb, TheSunShinesFromWhereItStands) {
  SceneBuilder builder("sun");
  builder.AddSky();
  builder.environment().sun_azimuth_deg = 90;  // east: +X of W and of G
  builder.environment().sun_elevation_deg = 30;
  builder.AddMaterial({.name = "m"});
  Mesh mesh = Square(0, 0);
  const MeshId id = builder.AddMesh(mesh);
  builder.AddInstance({id, {}, builder.AddEntity("thing", builder.tree().At("vehicle/car"))});
  const Bytes glb = EncodeGlb(*builder.Build());
  const internal::GltfContainer container = internal::OpenGltfContainer("sun.glb", glb);
  const nlohmann::json json = nlohmann::json::parse(container.json);
  const nlohmann::json& node = json["nodes"].back();
  ASSERT_EQ(node["name"], "sun");
  // A light shines along -Z of its node.
  EXPECT_NEAR(node["matrix"][8].get<double>(), std::cos(M_PI / 6), 1e-12);
  EXPECT_NEAR(node["matrix"][9].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(node["matrix"][10].get<double>(), 0, 1e-12);
}

// What Blender does to a file: objects copied and moved, long names cut at 63 bytes.
TEST(EncodeGlb, CopiesMadeInAnEditorAreThingsOfTheirOwnAndLongNamesComeBack) {
  const std::string long_name = "way/123456789/2 Bürgermeister-Reuter-Straße am ehemaligen Güterbahnhof Nord";
  SceneBuilder builder("street");
  const MaterialId grey = builder.AddMaterial({.name = "grey"});
  const MeshId square = builder.AddMesh(Square(grey, grey));
  const EntityId lamp = builder.AddEntity("lamp", builder.tree().At("furniture/lighting/street_light")),
                 road = builder.AddEntity(long_name, builder.tree().At("ground/road"));
  for (float x : {0.0f, 1.0f}) builder.AddInstance({square, PlaceUpright({x, 0, 0}, 0, 1), lamp});
  builder.AddInstance({square, PlaceUpright({0, 5, 0}, 0, 1), road});
  builder.AddSky();
  const Bytes bytes = EncodeGlb(*builder.Build());
  internal::GltfContainer container = internal::OpenGltfContainer("street.glb", bytes);
  nlohmann::json json = nlohmann::json::parse(container.json);
  auto& nodes = json["nodes"];
  for (size_t i = 0; i < 2; ++i) {  // the lamp's two nodes once more, 10 m aside
    nlohmann::json copy = nodes[i];
    copy["name"] = "lamp.00" + std::to_string(i + 2);
    copy.erase("matrix");
    copy["translation"] = {10 + static_cast<int>(i), 0, 0};
    json["scenes"][0]["nodes"].push_back(nodes.size());
    nodes.push_back(copy);
  }
  nodes[1]["name"] = "lamp.001";
  nodes[2]["name"] = long_name.substr(0, 63);
  json["buffers"][0]["uri"] =
      "data:application/octet-stream;base64," + internal::EncodeBase64(Bytes(container.binary.begin(), container.binary.end()));
  const auto file = std::filesystem::path(testing::TempDir()) / "copies_made_in_an_editor.gltf";
  WriteFileAtomically(file, std::string_view(json.dump()));
  const auto scene = ImportScene(file);
  std::filesystem::remove(file);
  std::map<std::string, Box3f> boxes;
  for (const Entity& entity : scene->entities) boxes[entity.name] = entity.bounds;
  ASSERT_EQ(boxes.size(), 4u);  // and the sky
  ASSERT_TRUE(boxes.contains(long_name) && boxes.contains("lamp") && boxes.contains("lamp.002"));
  EXPECT_FLOAT_EQ(boxes["lamp"].max.x, 2);
  EXPECT_FLOAT_EQ(boxes["lamp.002"].min.x, 10);
  EXPECT_FLOAT_EQ(boxes["lamp.002"].max.x, 12);
}

}  // namespace
}  // namespace airsim360

// sunlit_room: a furnished room with two windows of clear glass, for light that comes in through them.
#include <cmath>
#include <utility>

#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal {
namespace {

constexpr float kHalfX = 3.0f, kHalfY = 2.5f, kHeight = 2.7f, kWall = 0.25f;
constexpr float kSill = 0.85f, kLintel = 2.25f, kWindowFrom = 0.55f, kWindowTo = 2.25f;

// The mesh of the room and what is drawn next.
class RoomPen {
 public:
  explicit RoomPen(SceneBuilder& builder) : builder_(builder) {}

  MaterialId Paint(const char* name, Vec3f color, float roughness = 0.8f) {
    Material material;
    material.name = name;
    material.base_color = color;
    material.roughness = roughness;
    return builder_.AddMaterial(material);
  }
  void Start(const char* name, const char* category, MaterialId material) {
    mesh_.SetEntity(builder_.AddEntity(name, builder_.tree().At(category)));
    mesh_.SetMaterial(material);
  }
  void Use(MaterialId material) { mesh_.SetMaterial(material); }
  void Box(Vec3f low, Vec3f high) { mesh_.Box(low, high); }
  MeshBuilder& mesh() { return mesh_; }
  SceneBuilder& builder() { return builder_; }

 private:
  SceneBuilder& builder_;
  MeshBuilder mesh_;
};

void BuildShell(RoomPen& pen) {
  const float x = kHalfX, y = kHalfY, t = kWall, h = kHeight;
  const MaterialId wall = pen.Paint("wall paint", {0.74f, 0.71f, 0.65f}, 0.9f);
  pen.Start("floor", "ground/floor", pen.Paint("oak floor", {0.33f, 0.21f, 0.12f}, 0.35f));
  pen.Box({-x - t, -y - t, -0.2f}, {x + t, y + t, 0});
  pen.Start("ceiling", "construction/ceiling", pen.Paint("ceiling paint", {0.82f, 0.82f, 0.80f}, 0.9f));
  pen.Box({-x - t, -y - t, h}, {x + t, y + t, h + 0.2f});
  pen.Start("wall west", "construction/wall", wall);
  pen.Box({-x - t, -y - t, 0}, {-x, y + t, h});
  pen.Start("wall east", "construction/wall", wall);
  pen.Box({x, -y - t, 0}, {x + t, y + t, h});
  pen.Start("wall north", "construction/wall", pen.Paint("wall paint green", {0.34f, 0.42f, 0.36f}, 0.9f));
  pen.Box({-x, y, 0}, {x, y + t, h});

  // The south wall around its windows.
  pen.Start("wall south", "construction/wall", wall);
  pen.Box({-x, -y - t, 0}, {x, -y, kSill});
  pen.Box({-x, -y - t, kLintel}, {x, -y, h});
  pen.Box({-x, -y - t, kSill}, {-kWindowTo, -y, kLintel});
  pen.Box({-kWindowFrom, -y - t, kSill}, {kWindowFrom, -y, kLintel});
  pen.Box({kWindowTo, -y - t, kSill}, {x, -y, kLintel});
}

// Frame, mullion, sill board, a pane in each half.
void BuildWindow(RoomPen& pen, const char* name, float x0, float x1) {
  const float y0 = -kHalfY - 0.17f, y1 = -kHalfY - 0.10f, pane_y = -kHalfY - 0.135f, f = 0.05f;
  const MaterialId frame = pen.Paint("window frame", {0.78f, 0.78f, 0.76f}, 0.4f);
  Material glass;
  glass.name = "clear glass";
  glass.kind = SurfaceKind::kGlass;
  glass.base_color = {0.97f, 0.99f, 0.98f};
  glass.roughness = 0.03f;
  glass.transmission = 1;
  pen.Start(name, "construction/window", frame);
  pen.Box({x0, y0, kSill}, {x1, y1, kSill + f});
  pen.Box({x0, y0, kLintel - f}, {x1, y1, kLintel});
  const float middle = (x0 + x1) / 2;
  for (float x : {x0, middle - f / 2, x1 - f}) pen.Box({x, y0, kSill + f}, {x + f, y1, kLintel - f});
  pen.Box({x0, y1, kSill}, {x1, -kHalfY + 0.12f, kSill + 0.03f});
  pen.Use(pen.builder().AddMaterial(glass));
  for (const auto& [a, b] : {std::pair{x0 + f, middle - f / 2}, std::pair{middle + f / 2, x1 - f}}) {
    pen.mesh().Quad({a, pane_y, kSill + f}, {b, pane_y, kSill + f}, {b, pane_y, kLintel - f}, {a, pane_y, kLintel - f});
  }
}

void BuildCurtains(RoomPen& pen) {
  Material cloth;
  cloth.name = "curtain";
  cloth.kind = SurfaceKind::kFoliage;
  cloth.base_color = {0.58f, 0.50f, 0.38f};
  cloth.transmission = 0.35f;
  pen.Start("curtain", "furniture/curtain", pen.builder().AddMaterial(cloth));
  for (float x : {-kWindowTo - 0.25f, -kWindowFrom + 0.02f, kWindowFrom - 0.27f, kWindowTo}) {
    for (int fold = 0; fold < 5; ++fold) {
      const float a = x + 0.05f * static_cast<float>(fold), y = -kHalfY + 0.10f + (fold % 2 ? 0.04f : 0.0f);
      pen.mesh().Tube({a + 0.025f, y, 0.04f}, {a + 0.025f, y, kLintel + 0.15f}, 0.035f, 0.032f, 10);
    }
  }
}

void BuildSeats(RoomPen& pen) {
  pen.Start("rug", "furniture/rug", pen.Paint("rug", {0.30f, 0.10f, 0.08f}, 0.95f));
  pen.Box({-1.7f, -1.1f, 0.002f}, {1.1f, 0.7f, 0.014f});
  pen.Start("sofa", "furniture/sofa", pen.Paint("sofa cloth", {0.13f, 0.20f, 0.27f}, 0.95f));
  pen.Box({-2.0f, 1.45f, 0.12f}, {0.2f, 2.4f, 0.42f});
  pen.Box({-2.0f, 2.12f, 0.42f}, {0.2f, 2.4f, 0.85f});
  for (float x : {-2.2f, 0.2f}) pen.Box({x, 1.45f, 0.12f}, {x + 0.2f, 2.4f, 0.62f});
  pen.Use(pen.Paint("cushion", {0.55f, 0.33f, 0.08f}, 0.95f));
  pen.Box({-1.9f, 1.98f, 0.43f}, {-1.45f, 2.11f, 0.83f});

  // A low table.
  pen.Start("table", "furniture/table", pen.Paint("walnut", {0.17f, 0.09f, 0.05f}, 0.3f));
  pen.Box({-1.3f, -0.35f, 0.38f}, {-0.1f, 0.35f, 0.42f});
  for (float x : {-1.25f, -0.2f}) {
    for (float y : {-0.3f, 0.25f}) pen.Box({x, y, 0.014f}, {x + 0.05f, y + 0.05f, 0.38f});
  }
  pen.Start("vase", "furniture/vase", pen.Paint("glazed clay", {0.08f, 0.22f, 0.34f}, 0.12f));
  pen.mesh().Sphere({-0.5f, 0.05f, 0.52f}, {0.09f, 0.09f, 0.10f}, 16, 28);

  // A chair by the window.
  pen.Start("chair", "furniture/seating/chair", pen.Paint("beech", {0.42f, 0.27f, 0.14f}, 0.45f));
  pen.Box({1.55f, -0.55f, 0.43f}, {2.0f, -0.1f, 0.47f});
  pen.Box({1.96f, -0.55f, 0.47f}, {2.0f, -0.1f, 0.95f});
  for (float x : {1.55f, 1.96f}) {
    for (float y : {-0.55f, -0.14f}) pen.Box({x, y, 0}, {x + 0.04f, y + 0.04f, 0.43f});
  }
}

void BuildWallThings(RoomPen& pen) {
  pen.Start("shelf", "furniture/shelf", pen.Paint("white board", {0.72f, 0.71f, 0.68f}, 0.5f));
  for (float z : {0.05f, 0.45f, 0.85f, 1.25f, 1.65f}) pen.Box({2.68f, 0.3f, z}, {3.0f, 2.0f, z + 0.03f});
  for (float y : {0.27f, 2.0f}) pen.Box({2.68f, y, 0}, {3.0f, y + 0.03f, 1.68f});
  const MaterialId covers[4] = {pen.Paint("book red", {0.36f, 0.06f, 0.04f}, 0.6f), pen.Paint("book blue", {0.05f, 0.10f, 0.24f}, 0.6f),
                                pen.Paint("book ochre", {0.45f, 0.30f, 0.08f}, 0.6f), pen.Paint("book grey", {0.30f, 0.30f, 0.29f}, 0.6f)};
  pen.Start("books", "furniture/book", covers[0]);
  for (int i = 0; i < 44; ++i) {
    const int row = i / 15;
    const float y = 0.33f + 0.105f * static_cast<float>(i % 15), z = 0.48f + 0.4f * static_cast<float>(row);
    const float tall = 0.22f + 0.03f * static_cast<float>(i * 7 % 4);
    pen.Use(covers[(i * 5 + i / 3) % 4]);
    pen.Box({2.76f, y, z}, {2.98f, y + 0.05f + 0.01f * static_cast<float>(i % 4), z + tall});
  }
  pen.Start("painting", "furniture/painting", pen.Paint("gilt", {0.45f, 0.33f, 0.13f}, 0.35f));
  pen.Box({-2.99f, -0.8f, 1.15f}, {-2.96f, 0.6f, 2.05f});
  const Vec3f bands[3] = {{0.30f, 0.42f, 0.55f}, {0.20f, 0.26f, 0.12f}, {0.48f, 0.36f, 0.16f}};
  for (int i = 0; i < 3; ++i) {
    pen.Use(pen.Paint("canvas", bands[i], 0.8f));
    const float z = 1.2f + 0.27f * static_cast<float>(2 - i);
    pen.Box({-2.96f, -0.74f, z}, {-2.95f, 0.54f, z + 0.26f});
  }
  pen.Start("plant", "vegetation/plant", pen.Paint("terracotta", {0.40f, 0.17f, 0.09f}, 0.8f));
  pen.mesh().Tube({2.5f, -2.0f, 0}, {2.5f, -2.0f, 0.35f}, 0.14f, 0.18f, 24);
  pen.Use(pen.Paint("leaves", {0.06f, 0.16f, 0.04f}, 0.5f));
  for (int i = 0; i < 9; ++i) {
    const float a = 2.4f * static_cast<float>(i), r = 0.16f + 0.012f * static_cast<float>(i);
    pen.mesh().Sphere({2.5f + r * std::cos(a), -2.0f + r * std::sin(a), 0.5f + 0.07f * static_cast<float>(i)}, {0.13f, 0.13f, 0.09f}, 8,
                      14);
  }
}

// A floor lamp whose shade glows in the evening: 800 lm.
void BuildLamp(RoomPen& pen) {
  Material shade;
  shade.name = "lamp shade";
  shade.base_color = {0.80f, 0.74f, 0.62f};
  shade.emission = Vec3f{1.0f, 0.74f, 0.48f} * (1100 * kNit);
  shade.lamp = true;
  pen.Start("lamp", "furniture/lighting/lamp", pen.Paint("black steel", {0.03f, 0.03f, 0.03f}, 0.4f));
  pen.mesh().Tube({-2.5f, 2.0f, 0}, {-2.5f, 2.0f, 0.03f}, 0.15f, 0.15f, 28);
  pen.mesh().Tube({-2.5f, 2.0f, 0.03f}, {-2.5f, 2.0f, 1.4f}, 0.012f, 0.012f, 12);
  pen.Use(pen.builder().AddMaterial(shade));
  pen.mesh().Sphere({-2.5f, 2.0f, 1.55f}, {0.16f, 0.16f, 0.16f}, 16, 28);
}

void BuildGarden(RoomPen& pen) {
  pen.Start("lawn", "ground/grass", pen.Paint("lawn", {0.10f, 0.16f, 0.045f}, 0.95f));
  pen.mesh().Quad({-60, -60, -0.2f}, {60, -60, -0.2f}, {60, 60, -0.2f}, {-60, 60, -0.2f});
  pen.Start("terrace", "ground/pavement", pen.Paint("flagstone", {0.34f, 0.32f, 0.29f}, 0.9f));
  pen.Box({-4, -6, -0.25f}, {4, -2.75f, -0.12f});
  pen.Start("hedge", "vegetation/hedge", pen.Paint("hedge", {0.045f, 0.085f, 0.03f}, 0.95f));
  pen.Box({-16, -15, -0.2f}, {16, -13.8f, 1.3f});
  pen.Start("house", "construction/house", pen.Paint("render", {0.62f, 0.52f, 0.40f}, 0.9f));
  pen.Box({-12, -34, -0.2f}, {-1, -26, 5.5f});
}

}  // namespace

std::shared_ptr<const Scene> BuildSunlitRoom(const WorldOptions&) {
  SceneBuilder builder("sunlit_room");
  builder.AddSky();
  builder.environment().sun_azimuth_deg = 205;
  builder.environment().sun_elevation_deg = 34;
  RoomPen pen(builder);
  BuildShell(pen);
  BuildWindow(pen, "window west", -kWindowTo, -kWindowFrom);
  BuildWindow(pen, "window east", kWindowFrom, kWindowTo);
  BuildCurtains(pen);
  BuildSeats(pen);
  BuildWallThings(pen);
  BuildLamp(pen);
  BuildGarden(pen);
  builder.AddInstance({builder.AddMesh(pen.mesh().Finish("room and garden")), {}, kNoEntity});
  builder.SetSpawn({0.6f, 0.9f, 1.5f});
  return builder.Build();
}

WorldInfo SunlitRoomInfo() {
  return {"sunlit_room",
          "indoor",
          23.0,  // 6 x 5 m less furniture
          {"construction/ceiling",
           "construction/house",
           "construction/wall",
           "construction/window",
           "furniture/book",
           "furniture/curtain",
           "furniture/lighting/lamp",
           "furniture/painting",
           "furniture/rug",
           "furniture/seating/chair",
           "furniture/shelf",
           "furniture/sofa",
           "furniture/table",
           "furniture/vase",
           "ground/floor",
           "ground/grass",
           "ground/pavement",
           "sky",
           "vegetation/hedge",
           "vegetation/plant"},
          "A furnished living room of 6 x 5 m with two windows of clear glass to the south and a garden; "
          "lit by the sun through them."};
}

}  // namespace airsim360::internal

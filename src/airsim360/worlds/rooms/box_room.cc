#include <utility>

#include "airsim360/worlds/built_in.h"

namespace airsim360::internal {
namespace {

// Corner i of the box [low, high]: bit 0 chooses x, bit 1 y, bit 2 z.
std::vector<Vec3f> Corners(Vec3f low, Vec3f high) {
  std::vector<Vec3f> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  return corners;
}

struct RoomFace {
  const char* name;
  const char* category;
  uint32_t corner[4];  // counter-clockwise seen from outside the box
  Vec3f color;
};

constexpr RoomFace kRoomFaces[] = {
    {"floor", "ground/floor", {0, 2, 3, 1}, {0.42f, 0.36f, 0.30f}},
    {"ceiling", "construction/ceiling", {4, 5, 7, 6}, {0.80f, 0.80f, 0.80f}},
    {"wall west", "construction/wall", {0, 4, 6, 2}, {0.60f, 0.30f, 0.25f}},
    {"wall east", "construction/wall", {1, 3, 7, 5}, {0.25f, 0.55f, 0.32f}},
    {"wall south", "construction/wall", {0, 1, 5, 4}, {0.30f, 0.38f, 0.60f}},
    {"wall north", "construction/wall", {2, 6, 7, 3}, {0.62f, 0.56f, 0.38f}},
};
constexpr uint32_t kCubeFaces[][4] = {{4, 5, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};

MaterialId AddPaint(SceneBuilder& builder, std::string name, Vec3f color) {
  Material material;
  material.name = std::move(name);
  material.base_color = color;
  return builder.AddMaterial(std::move(material));
}

void AddQuad(Mesh& mesh, const uint32_t (&c)[4]) {
  mesh.triangles.push_back({c[0], c[1], c[2]});
  mesh.triangles.push_back({c[0], c[2], c[3]});
}

}  // namespace

std::shared_ptr<const Scene> BuildBoxRoom(const WorldOptions&) {
  SceneBuilder builder("box_room");
  const auto entity = [&](const char* name, const char* category) { return builder.AddEntity(name, builder.tree().At(category)); };

  // The shell: eight shared corners, so that no ray slips through an edge; faces look inwards.
  Mesh room;
  room.name = "room";
  room.positions = Corners({-5, -5, 0}, {5, 5, 6});
  for (const RoomFace& face : kRoomFaces) {
    const auto& c = face.corner;
    const auto first = static_cast<uint32_t>(room.triangles.size());
    AddQuad(room, {c[0], c[3], c[2], c[1]});
    room.parts.push_back({first, 2, AddPaint(builder, face.name, face.color), entity(face.name, face.category)});
  }

  // The cube stands on the floor without a bottom face.
  Mesh cube;
  cube.name = "box";
  cube.positions = Corners({2.5f, -0.5f, 0}, {3.5f, 0.5f, 1});
  for (const auto& corners : kCubeFaces) AddQuad(cube, corners);
  cube.parts.push_back(
      {0, static_cast<uint32_t>(cube.triangles.size()), AddPaint(builder, "box", {0.75f, 0.45f, 0.12f}), entity("box", "furniture/box")});

  builder.AddInstance({builder.AddMesh(std::move(room)), {}, kNoEntity});
  builder.AddInstance({builder.AddMesh(std::move(cube)), {}, kNoEntity});
  builder.SetInteriorLight({1, 1, 1});
  builder.SetSpawn({0, 0, 1.6f});
  return builder.Build();
}

WorldInfo BoxRoomInfo() {
  return {"box_room",
          "indoor",
          99.0,  // 10 x 10 m less the cube
          {"ground/floor", "construction/ceiling", "construction/wall", "furniture/box"},
          "Analytic test world: a room of 10 x 10 x 6 m with one cube of 1 m, seven entities."};
}

}  // namespace airsim360::internal

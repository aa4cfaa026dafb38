// Builds what buildings_plan.cc planned and sets it on the hills.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "airsim360/image/image.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/building/roofs.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360::internal {
namespace {

using S = Surface;

struct Scheme {
  const char* name;
  Vec3f wall, trim, door, garage;
  bool boards;  ///< painted boards, else stucco
};
// Linear colours, as house paints are sold: none brighter than fresh white.
constexpr Scheme kSchemes[] = {
    {"rose", {0.45f, 0.31f, 0.28f}, {0.74f, 0.71f, 0.66f}, {0.16f, 0.03f, 0.03f}, {0.62f, 0.56f, 0.51f}, true},
    {"sky", {0.33f, 0.39f, 0.44f}, {0.74f, 0.74f, 0.71f}, {0.05f, 0.09f, 0.16f}, {0.66f, 0.67f, 0.66f}, true},
    {"sage", {0.33f, 0.36f, 0.28f}, {0.71f, 0.68f, 0.54f}, {0.10f, 0.05f, 0.03f}, {0.24f, 0.30f, 0.20f}, true},
    {"butter", {0.61f, 0.53f, 0.37f}, {0.75f, 0.73f, 0.66f}, {0.07f, 0.13f, 0.10f}, {0.72f, 0.66f, 0.50f}, true},
    {"slate", {0.10f, 0.13f, 0.17f}, {0.60f, 0.60f, 0.57f}, {0.42f, 0.20f, 0.03f}, {0.10f, 0.11f, 0.12f}, true},
    {"lilac", {0.40f, 0.37f, 0.42f}, {0.73f, 0.71f, 0.70f}, {0.14f, 0.05f, 0.12f}, {0.56f, 0.52f, 0.58f}, true},
    {"cream", {0.66f, 0.62f, 0.53f}, {0.45f, 0.31f, 0.20f}, {0.16f, 0.08f, 0.04f}, {0.55f, 0.47f, 0.36f}, false},
    {"peach", {0.56f, 0.44f, 0.34f}, {0.74f, 0.71f, 0.65f}, {0.09f, 0.05f, 0.03f}, {0.66f, 0.60f, 0.51f}, false},
    {"white", {0.72f, 0.71f, 0.68f}, {0.70f, 0.69f, 0.66f}, {0.03f, 0.06f, 0.13f}, {0.68f, 0.67f, 0.64f}, false},
    {"mint", {0.47f, 0.53f, 0.47f}, {0.73f, 0.73f, 0.69f}, {0.13f, 0.06f, 0.04f}, {0.64f, 0.67f, 0.62f}, false},
    {"terracotta", {0.35f, 0.19f, 0.13f}, {0.66f, 0.59f, 0.45f}, {0.05f, 0.09f, 0.08f}, {0.30f, 0.14f, 0.09f}, false},
};

// Boards of 13 cm: each leans out towards its lower edge, below which lies a shadow. One tile is 8 boards high.
constexpr float kBoardTile = 1.04f;
Texture BoardNormals() {
  Image<Rgba8> image(256, 256);
  for (int y = 0; y < 256; ++y) {
    const int in_board = y % 32;
    const float tilt = in_board < 28 ? 0.08f : -0.55f, z = 1 / std::hypot(tilt, 1.0f);
    for (int x = 0; x < 256; ++x)
      image(x, y) = {128, static_cast<uint8_t>(std::lround(127.5f + 127.5f * tilt * z)),
                     static_cast<uint8_t>(std::lround(127.5f + 127.5f * z)), 255};
  }
  return Texture::FromImage("siding normals", std::move(image), false);
}
Texture BoardColors() {
  Image<Rgba8> image(256, 256);
  for (int y = 0; y < 256; ++y) {
    const int in_board = y % 32, board = y / 32;
    const int tone = 247 - 3 * ((board * 5) % 4) - (in_board >= 29 ? 48 : in_board >= 27 ? 18 : 0);
    for (int x = 0; x < 256; ++x) {
      const auto v = static_cast<uint8_t>(tone - ((x / 8) * 7 + board * 3) % 5);
      image(x, y) = {v, v, v, 255};
    }
  }
  return Texture::FromImage("siding", std::move(image), true);
}

void Append(Mesh& all, const Mesh& mesh, const AffineTransform& X) {
  const auto base = static_cast<uint32_t>(all.positions.size()), first = static_cast<uint32_t>(all.triangles.size());
  const Vec3f cx{X.A.m[0][0], X.A.m[1][0], X.A.m[2][0]}, cy{X.A.m[0][1], X.A.m[1][1], X.A.m[2][1]},
      cz{X.A.m[0][2], X.A.m[1][2], X.A.m[2][2]};
  const Vec3f nx = Cross(cy, cz), ny = Cross(cz, cx), nz = Cross(cx, cy);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f n = mesh.normals[i];
    all.positions.push_back(X * mesh.positions[i]);
    all.normals.push_back(Normalized(nx * n.x + ny * n.y + nz * n.z));
  }
  all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
  for (Vec3u t : mesh.triangles) all.triangles.push_back({t.x + base, t.y + base, t.z + base});
  for (MeshPart part : mesh.parts) {
    part.first_triangle += first;
    all.parts.push_back(part);
  }
}

// Full dress where a wall can be seen from close by, less beyond.
std::vector<FacadeDetail> DetailOf(const StreetPlan& plan, const BuildingPlan& building) {
  const GroundRect reach = plan.reach().Inset(-0.5f);
  std::vector<FacadeDetail> detail;
  for (size_t i = 0; i < building.outline.size(); ++i) {
    const Vec2f middle = (building.outline[i] + building.outline[(i + 1) % building.outline.size()]) * 0.5f;
    detail.push_back(!reach.Contains(middle) ? FacadeDetail::kFlat : building.base > 45 ? FacadeDetail::kSimple : FacadeDetail::kFull);
  }
  return detail;
}

AffineTransform PlanFromHouse(const RowHouse& house) {
  return {Mat3f::FromColumns({house.along.x, house.along.y, 0}, {house.inward.x, house.inward.y, 0}, {0, 0, 1}),
          {house.origin.x, house.origin.y, 0}};
}

}  // namespace

std::vector<Surfaces> AddHouseSchemes(SceneBuilder& builder, const Surfaces& surfaces) {
  const TextureId colors = builder.AddTexture(BoardColors()), normals = builder.AddTexture(BoardNormals());
  std::vector<Surfaces> schemes;
  for (const Scheme& scheme : kSchemes) {
    const auto add = [&](S like, const char* part, Vec3f color) {
      Material material = builder.material(surfaces[like]);
      material.name = std::string("house ") + part + " " + scheme.name;
      material.base_color = color;
      if (like == S::kStuccoWhite && scheme.boards) {
        material.base_color_texture = colors;
        material.normal_texture = normals;
        material.metallic_roughness_texture = kNoTexture;
        material.roughness = 0.6f;
        material.uv_scale = {1 / kBoardTile, 1 / kBoardTile};
        material.blend_tiles = false;
      }
      return builder.AddMaterial(std::move(material));
    };
    schemes.push_back(surfaces.With(S::kStuccoWhite, add(S::kStuccoWhite, "wall", scheme.wall))
                          .With(S::kTrimWhite, add(S::kTrimWhite, "trim", scheme.trim))
                          .With(S::kDoorWood, add(S::kFrameDark, "door", scheme.door))
                          .With(S::kShutterGreen, add(S::kFrameWhite, "garage", scheme.garage)));
  }
  return schemes;
}

void BuildSfBuildings(District& d, const Hills& hills, const SfPlan& city, SlopeLay& lay) {
  const std::vector<Surfaces> schemes = AddHouseSchemes(d.builder, d.surfaces);
  const MeshId balcony = AddBalconyMesh(d.builder, d.surfaces), box = AddWindowBoxMesh(d.builder, d.surfaces);
  const std::array escapes{AddFireEscapeMesh(d.builder, d.surfaces, false), AddFireEscapeMesh(d.builder, d.surfaces, true)};
  const CategoryId building_id = d.builder.tree().At("construction/building"), roof_id = d.builder.tree().At("construction/building/roof");
  MeshBuilder mesh;
  Mesh all;
  const auto flush = [&](size_t block) {
    if (all.triangles.empty()) return;
    all.name = "buildings of block " + std::to_string(block);
    d.builder.AddInstance({d.builder.AddMesh(std::move(all)), {}, kNoEntity});
    all = {};
  };
  for (size_t i = 0; i < city.houses.size(); ++i) {
    const RowHouse& house = city.houses[i];
    const bool far = house.shape.flat;
    const EntityId walls = d.builder.AddEntity(far ? "far house" : "row house", building_id), roof = d.builder.AddEntity("roof", roof_id);
    FacadeContext context{d.builder, schemes[static_cast<size_t>(house.scheme)], mesh, balcony, box};
    BuildBayHouse(context, house.shape, walls, roof);
    Append(all, mesh.Finish("house"),
           lay.Rigid(house.At(house.shape.width / 2, house.shape.depth / 2), house.ground) * PlanFromHouse(house));
    if (i + 1 == city.houses.size() || city.houses[i + 1].block != house.block) flush(house.block);
  }
  EntityId walls = kNoEntity;
  Vec2f anchor;
  for (size_t i = 0; i < city.buildings.size(); ++i) {
    const PlacedBuilding& placed = city.buildings[i];
    const BuildingPlan& plan = placed.plan;
    if (plan.base == 0) {
      walls = d.builder.AddEntity(plan.name.empty() ? "building" : plan.name, building_id);
      anchor = plan.bounds().center();
    }
    const EntityId roof = d.builder.AddEntity("roof", roof_id);
    // All tiers of a building stand on the same piece of the plane.
    const AffineTransform X = lay.Rigid(anchor, placed.ground);
    lay.building = X;
    FacadeContext context{d.builder, d.surfaces, mesh, balcony, box, escapes};
    context.X_WB = X;
    context.fall = [&](Vec2f p) { return placed.ground - hills.Ground(p).z; };
    BuildFacades(context, plan, walls, DetailOf(d.plan, plan));
    BuildRoof(d.builder, mesh, d.surfaces, &d.placer.shelf(), plan, walls, roof);
    if (plan.base == 0) {
      mesh.SetTransform({});
      mesh.SetEntity(walls);
      mesh.SetMaterial(d.surfaces[S::kGranite]);
      mesh.Walls(plan.outline, -placed.foot, 0);
    }
    lay.building.reset();
    Append(all, mesh.Finish("building"), X);
    if (i + 1 == city.buildings.size() || city.buildings[i + 1].plan.block != plan.block) flush(plan.block);
  }
}

AffineTransform SlopeLay::Rigid(Vec2f at, float ground) const {
  const AffineTransform frame = hills_.drape().Frame(at);
  const Vec3f x{frame.A.m[0][0], frame.A.m[1][0], 0}, y{frame.A.m[0][1], frame.A.m[1][1], 0};
  return {Mat3f::FromColumns(x, y, {0, 0, 1}), Vec3f{frame.p.x, frame.p.y, ground} - x * at.x - y * at.y};
}

AffineTransform SlopeLay::operator()(std::string_view kind, const AffineTransform& placed) const {
  if (building) return *building * placed;
  const AffineTransform frame = hills_.drape().Frame({placed.p.x, placed.p.y});
  const Vec3f p = frame.p + Vec3f{0, 0, placed.p.z};
  Vec3f x{frame.A.m[0][0], frame.A.m[1][0], frame.A.m[2][0]}, y{frame.A.m[0][1], frame.A.m[1][1], frame.A.m[2][1]};
  const auto any = [&](std::initializer_list<std::string_view> kinds) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  };
  // Fences and mown grass follow the ground with upright pales and blades.
  if (any({"wood_fence", "metal_fence", "picket_fence", "rail", "rope_bollard", "metal_barricade", "hedge", "lawn_tile", "lawn_patch",
           "grass_tuft", "circle_fence"}))
    return {Mat3f::FromColumns(x, y, {0, 0, 1}) * placed.A, p};
  // What lies flat or rolls leans with the ground.
  if (any({"car", "taxi", "van", "bus", "cable_car", "food_truck", "bicycle", "manhole", "leaf_litter", "flower_bed", "rock",
           "water_barrier", "concrete_block"})) {
    x = Normalized(x);
    const Vec3f up = Normalized(Cross(x, y));
    return {Mat3f::FromColumns(x, Cross(up, x), up) * placed.A, p};
  }
  const float turn = std::atan2(x.y, x.x), c = std::cos(turn), s = std::sin(turn);
  return {Mat3f::FromColumns({c, s, 0}, {-s, c, 0}, {0, 0, 1}) * placed.A, p};
}

}  // namespace airsim360::internal

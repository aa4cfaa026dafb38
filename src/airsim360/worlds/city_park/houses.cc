// Houses with gables at the edges of the park, and the café at the lake.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal::park {
namespace {

constexpr float kOverhang = 0.55f, kWallStart = -3.5f;

struct House {
  Vec2f at;
  float half_x, half_y, yaw;  // the ridge runs along x
  int storeys;
  uint32_t style;
};

struct Style {
  Surface wall, roof, frame;
};
constexpr Style kStyles[] = {{Surface::kBrickRed, Surface::kRoofTile, Surface::kFrameWhite},
                             {Surface::kBrickBrown, Surface::kRoofSlate, Surface::kFrameWhite},
                             {Surface::kStuccoWhite, Surface::kRoofTile, Surface::kFrameWood},
                             {Surface::kBrickYellow, Surface::kRoofSlate, Surface::kFrameGreen},
                             {Surface::kStuccoOchre, Surface::kRoofTile, Surface::kFrameWhite}};

class HouseBuilder {
 public:
  HouseBuilder(Park& park, MeshBuilder& mesh) : park_(park), mesh_(mesh) {}

  void Build(const House& h) {
    house_ = h;
    style_ = kStyles[h.style % std::size(kStyles)];
    eaves_ = 0.45f + 2.85f * static_cast<float>(h.storeys);
    ridge_ = eaves_ + 0.62f * h.half_y;
    // The floor lies over the highest corner of the ground.
    float floor = -1e9f;
    for (float x : {-1.0f, 0.0f, 1.0f})
      for (float y : {-1.0f, 0.0f, 1.0f}) floor = std::max(floor, park_.layout.Ground(World(x * h.half_x, y * h.half_y)));
    mesh_.SetTransform(PlaceUpright({h.at.x, h.at.y, floor}, h.yaw));
    base_ = floor;
    mesh_.SetEntity(park_.AddEntity("house", "construction/building"));
    Walls();
    for (float side : {-1.0f, 1.0f}) Openings(side);
    Chimney();
    mesh_.SetEntity(park_.AddEntity("roof", "construction/building/roof"));
    Roof();
    mesh_.SetTransform({});
    park_.placer.Reserve({h.at, {h.half_x + 3, h.half_y + 3}, h.yaw});
  }
  float base() const { return base_; }
  Vec2f World(float x, float y) const {
    const float c = std::cos(house_.yaw), s = std::sin(house_.yaw);
    return {house_.at.x + c * x - s * y, house_.at.y + s * x + c * y};
  }

 private:
  void Use(Surface surface) { mesh_.SetMaterial(park_.surfaces[surface]); }

  void Walls() {
    const float x = house_.half_x, y = house_.half_y;
    Use(style_.wall);
    mesh_.Box({-x, -y, 0.35f}, {x, y, eaves_}, MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack);
    for (float side : {-1.0f, 1.0f}) {
      const Vec3f a{side * x, -side * y, eaves_}, b{side * x, side * y, eaves_}, c{side * x, 0, ridge_};
      mesh_.Triangle(a, b, c, {0, 0}, {2 * y, 0}, {y, eaves_ - ridge_});
    }
    Use(Surface::kConcrete);
    mesh_.Box({-x - 0.04f, -y - 0.04f, kWallStart}, {x + 0.04f, y + 0.04f, 0.35f},
              MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack | MeshBuilder::kTop);
  }

  // Windows on a long side (-1 front, with the door), storey by storey.
  void Openings(float side) {
    const float y = side * house_.half_y;
    const int bays = std::max(2, static_cast<int>(2 * house_.half_x / 3.0f));
    for (int storey = 0; storey < house_.storeys; ++storey) {
      for (int i = 0; i < bays; ++i) {
        const float x = house_.half_x * (2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(bays) - 1);
        const bool door = side < 0 && storey == 0 && i == bays / 2;
        const float z = 0.45f + 2.85f * static_cast<float>(storey);
        Opening(x, y, side, door ? z - 0.05f : z + 0.9f, door ? 0.52f : 0.62f, door ? 2.1f : 1.35f, door);
      }
    }
  }

  void Opening(float x, float y, float side, float z, float half, float height, bool door) {
    const auto bar = [&](float x0, float x1, float z0, float z1, float out) {
      const float y0 = std::min(y, y + side * out), y1 = std::max(y, y + side * out);
      mesh_.Box({x0, y0, z0}, {x1, y1, z1}, MeshBuilder::kAllSides);
    };
    Use(style_.frame);
    for (float e : {-half, half}) bar(x + e - 0.05f, x + e + 0.05f, z, z + height, 0.07f);
    bar(x - half - 0.05f, x + half + 0.05f, z + height, z + height + 0.10f, 0.09f);
    if (!door) {
      bar(x - half - 0.12f, x + half + 0.12f, z - 0.08f, z, 0.14f);
      bar(x - 0.02f, x + 0.02f, z, z + height, 0.05f);
      bar(x - half, x + half, z + 0.62f * height, z + 0.62f * height + 0.04f, 0.05f);
    }
    Use(door ? Surface::kDoorWood : Surface::kGlassDark);
    const float q = y + side * 0.02f;
    const Vec3f a{x - half, q, z}, b{x + half, q, z}, c{x + half, q, z + height}, d{x - half, q, z + height};
    if (side < 0) mesh_.Quad(a, b, c, d);
    if (side > 0) mesh_.Quad(b, a, d, c);
  }

  void Chimney() {
    Use(Surface::kBrickRed);
    const float x = 0.45f * house_.half_x;
    mesh_.Box({x - 0.35f, -0.9f, eaves_}, {x + 0.35f, -0.2f, ridge_ + 0.8f});
    Use(Surface::kCoping);
    mesh_.Box({x - 0.42f, -0.97f, ridge_ + 0.8f}, {x + 0.42f, -0.13f, ridge_ + 0.92f});
  }

  // Two slopes with a thickness, a little over the walls on all sides.
  void Roof() {
    Use(style_.roof);
    const float x = house_.half_x + kOverhang, y = house_.half_y + kOverhang;
    const float low = eaves_ - kOverhang * 0.62f + 0.05f, high = ridge_ + 0.05f, t = 0.16f;
    for (float side : {-1.0f, 1.0f}) {
      const Vec3f p0{side < 0 ? x : -x, side < 0 ? y : -y, low}, p1{side < 0 ? -x : x, side < 0 ? y : -y, low},
          p2{side < 0 ? -x : x, 0, high}, p3{side < 0 ? x : -x, 0, high};
      const Vec3f up{0, 0, t};
      mesh_.Quad(p0 + up, p1 + up, p2 + up, p3 + up);
      mesh_.Quad(p1, p0, p3, p2);
      mesh_.Quad(p0, p1, p1 + up, p0 + up);
      mesh_.Quad(p1, p2, p2 + up, p1 + up);
      mesh_.Quad(p3, p0, p0 + up, p3 + up);
    }
  }

  Park& park_;
  MeshBuilder& mesh_;
  House house_{};
  Style style_{};
  float eaves_ = 0, ridge_ = 0, base_ = 0;
};

// Ivy on some gables and fronts.
void GrowIvy(Park& park, const HouseBuilder& builder, const House& h, RngStream& rng) {
  for (int i = 0; i < 3; ++i) {
    const float x = h.half_x * (-0.75f + 0.7f * static_cast<float>(i));
    const Vec2f p = builder.World(x, -h.half_y - 0.02f);
    const EntityId ivy = park.AddEntity("ivy", "vegetation/climber/ivy");
    park.placer.shelf().PlaceAs(ivy, "ivy", PlaceUpright({p.x, p.y, builder.base() - 0.1f}, h.yaw, 1.1f), rng.Index(3));
  }
}

}  // namespace

void BuildHouses(Park& park) {
  RngStream rng(park.seed, "park houses");
  std::vector<House> houses;
  // Beyond the lake and along the edges of the lawns, seen from the spawn.
  constexpr float fixed[][4] = {{-30, 150, 9, 0.2f},  {-72, 146, 11, -0.3f}, {-8, 168, 8, 0.5f},   {60, 190, 12, 0.1f},
                                {196, 84, 11, 0.6f},  {-170, 62, 12, 0.3f},  {104, 166, 10, 0.7f}, {-262, 62, 12, 0.1f},
                                {330, 160, 13, 0.5f}, {-120, 168, 10, 0.0f}, {30, 206, 11, -0.2f}, {-210, 110, 10, 0.4f}};
  for (const auto& f : fixed) houses.push_back({{f[0], f[1]}, f[2], 4.8f, f[3], rng.Chance(0.35) ? 2 : 1, rng.Index(5)});
  // Along the side roads, facing them.
  for (const Curve& road : park.layout.side_roads()) {
    for (float s = 70; s < road.length() - 20; s += 30) {
      for (float hand : {-1.0f, 1.0f}) {
        if (rng.Chance(0.35)) continue;
        const auto half_x = static_cast<float>(rng.Uniform(5.5, 9));
        const Vec2f v = road.Along(s), out = Vec2f{-v.y, v.x} * hand;
        const Vec2f p = road.At(s, hand * (kSideHalf + kVergeEnd + 9 + static_cast<float>(rng.Uniform(0, 4))));
        houses.push_back(
            {p, half_x, static_cast<float>(rng.Uniform(4, 5.2)), FacingYaw(out * -1.0f), rng.Chance(0.5) ? 2 : 1, rng.Index(5)});
      }
    }
  }
  MeshBuilder mesh;
  HouseBuilder builder(park, mesh);
  for (const House& h : houses) {
    const Footprint room{h.at, {h.half_x + 3, h.half_y + 3}, h.yaw};
    const float reach = std::hypot(h.half_x, h.half_y) + 1.5f;
    if (park.layout.BeyondRoad(h.at) < h.half_y + 2 || park.layout.PathDistance(h.at, reach + 2) < reach || park.layout.Lake(h.at) < 1.5f ||
        !park.occupancy.IsFree(room))
      continue;
    builder.Build(h);
    if (rng.Chance(0.3)) GrowIvy(park, builder, h, rng);
  }
  park.builder.AddInstance({park.builder.AddMesh(mesh.Finish("houses")), {}, kNoEntity});
}

}  // namespace airsim360::internal::park

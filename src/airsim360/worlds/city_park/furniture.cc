// Furniture along the roads and paths.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/city_park/road_parts.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town/market_stall.h"

namespace airsim360::internal::park {
namespace {

// Places beside a road, in road coordinates: s along, o outwards from the kerb's face, hand +1 left.
class Kerbside {
 public:
  Kerbside(Park& park, const Curve& road, float half) : park_(park), road_(road), half_(half) {}
  Vec3f At(float s, float o, float hand, float z) const {
    const Vec2f p = road_.At(s, hand * (half_ + o));
    return {p.x, p.y, park_.layout.Base(p) + z};
  }
  // Yaw of a prop whose front looks at the road.
  float Facing(float s, float hand) const {
    const Vec2f v = road_.Along(s);
    return FacingYaw(Vec2f{v.y, -v.x} * hand);
  }
  // False in the mouths of junctions.
  bool Clear(float s) const {
    const Vec2f p = road_.At(s);
    for (const Curve& other : park_.layout.side_roads())
      if (&other != &road_ && other.Distance(p, 40) < 24) return false;
    return &road_ == &park_.layout.main() || park_.layout.main().Distance(p, 60) > 26;
  }
  void Put(const char* kind, float s, float o, float hand, float z, float turn = 0) {
    if (Clear(s)) park_.placer.Try(kind, At(s, o, hand, z), Facing(s, hand) + turn);
  }
  float length() const { return road_.length(); }

 private:
  Park& park_;
  const Curve& road_;
  float half_;
};

void FurnishRoad(Park& park, const Curve& road, float half) {
  Kerbside side(park, road, half);
  constexpr float kBed = 0.12f, kWalk = 0.168f;
  int lamp = 0;
  for (float s = 16; s < side.length(); s += 28) side.Put("crook_lamp", s, 0.9f, ++lamp % 2 ? 1.0f : -1.0f, kBed);
  for (float s = 8; s < side.length(); s += 11) {
    side.Put("bollard_lamp", s, 1.45f, 1, kBed);
    side.Put("bollard_lamp", s + 4, 1.45f, -1, kBed);
  }
  for (float s = 22; s < side.length(); s += 31) {
    for (float hand : {-1.0f, 1.0f}) side.Put("bench_wood", s, 3.35f, hand, kWalk);
  }
  for (float s = 42; s < side.length(); s += 62) {
    for (float hand : {-1.0f, 1.0f}) side.Put("trash_can", s, 3.4f, hand, kWalk);
  }
}

// Signs, cars at the kerb and in the lanes.
void PutTraffic(Park& park, const Curve& road, float half, bool parking, RngStream& rng) {
  Kerbside side(park, road, half);
  for (float s = 60; s < road.length(); s += 96) side.Put("traffic_sign", s, 0.75f, s > 200 ? 1.0f : -1.0f, 0.12f);
  const auto car = [&](float s, float d, bool forward) {
    const Vec2f p = road.At(s, d), v = road.Along(s);
    const float z = park.layout.Base(p) + (parking ? 0.02f : 0.04f);
    park.placer.Try(rng.Chance(0.88) ? "car" : "van", {p.x, p.y, z}, FacingYaw(forward ? v : v * -1.0f), 1, {1, 1, 1}, {},
                    parking ? Engine::kOff : Engine::kOn);
  };
  if (parking) {
    for (float hand : {-1.0f, 1.0f}) {
      for (float s = 40; s < road.length() - 10; s += 6.6f) {
        if (side.Clear(s) && rng.Chance(0.42)) car(s, hand * (half - 1.15f), hand < 0);
      }
    }
  } else {
    // Traffic keeps to the right; none near the spawn.
    const float middle = road.Find({0, 0}).s;
    for (float lane : {-5.0f, -2.2f, 2.2f, 5.0f}) {
      for (float s = 30 + 20 * static_cast<float>(rng.Uniform()); s < road.length() - 20; s += static_cast<float>(rng.Uniform(28, 85))) {
        if (std::abs(s - middle) > 62) car(s, lane, lane < 0);
      }
    }
  }
}

void FurnishJunctions(Park& park) {
  const Curve& main = park.layout.main();
  Kerbside kerb(park, main, kMainHalf);
  for (const Junction& junction : park.layout.junctions()) {
    const float hand = junction.left ? 1.0f : -1.0f;
    for (float ds : {-13.5f, 13.5f}) {
      for (float h : {hand, -hand}) {
        const float s = junction.s + ds;
        const Vec2f v = main.Along(s);
        park.placer.Try("traffic_light", kerb.At(s, 1.0f, h, 0.13f), FacingYaw(ds < 0 ? v * -1.0f : v));
      }
    }
  }
}

// Benches, bins, lights and picnic tables along the gravel paths.
void FurnishPath(Park& park, const Curve& path, RngStream& rng) {
  const auto put = [&](const char* kind, float s, float d, const char* category = nullptr) {
    const Vec2f p = path.At(s, d), v = path.Along(s), towards = Vec2f{v.y, -v.x} * (d > 0 ? 1.0f : -1.0f);
    if (!park.lawns.IsLawn(p) || park.layout.PathDistance(p, 4) < kPathHalf + 0.35f) return;
    const Vec3f at = park.OnGround(p, 0.03f);
    if (!category) {
      park.placer.Try(kind, at, FacingYaw(towards));
      return;
    }
    const Footprint room = FootprintOf(kind, p, FacingYaw(towards));
    if (!park.occupancy.IsFree(room)) return;
    park.placer.Reserve(room);
    const EntityId entity = park.AddEntity(kind, category);
    park.placer.shelf().PlaceAs(entity, kind, PlaceUpright(at, FacingYaw(towards)), rng.Index(3));
  };
  float hand = 1;
  for (float s = 9; s < path.length() - 4; s += 17, hand = -hand) put("bollard_lamp", s, hand * 1.75f);
  for (float s = 16; s < path.length() - 4; s += 33, hand = -hand) put("bench_wood", s, hand * 2.15f, "furniture/seating/bench");
  for (float s = 30; s < path.length() - 4; s += 66) put("trash_can", s, -1.9f);
  for (float s = 48; s < path.length() - 4; s += 52, hand = -hand) put("picnic_table", s, hand * static_cast<float>(rng.Uniform(4.5, 8)));
}

// Tables with chairs and umbrellas, stalls and flower beds on the lawn behind the lake.
void BuildCafe(Park& park, RngStream& rng) {
  const Vec2f middle{34, 112};
  const auto stand = [&](const char* kind, Vec2f p, float yaw, const char* category, uint32_t variant) {
    const EntityId entity = park.AddEntity(kind, category);
    park.placer.shelf().PlaceAs(entity, kind, PlaceUpright(park.OnGround(p, 0.02f), yaw), variant);
  };
  for (int i = 0; i < 8; ++i) {
    const Vec2f p = middle + Vec2f{4.2f * static_cast<float>(i % 4) - 6.3f, 4.6f * static_cast<float>(i / 4) - 2.3f};
    park.placer.Reserve({p, {1.5f, 1.5f}, 0});
    const auto turn = static_cast<float>(rng.Uniform(0, kTauF));
    stand("dining_table", p, turn, "furniture/table/cafe_table", rng.Index(4));
    for (int k = 0; k < 3; ++k) {
      const float a = turn + kTauF * static_cast<float>(k) / 3;
      const Vec2f out{std::cos(a), std::sin(a)};
      stand("dining_chair", p + out * 0.85f, FacingYaw(out * -1.0f), "furniture/seating/chair", rng.Index(4));
    }
    if (i % 2 == 0) stand("umbrella", p + Vec2f{0.25f, 1.25f}, turn, "furniture/shade/umbrella", rng.Index(4));
  }
  // Stalls with their umbrellas.
  for (uint32_t i = 0; i < 4; ++i) {
    const Vec2f p = middle + Vec2f{4.0f * static_cast<float>(i) - 6, -8.5f};
    const EntityId stall = park.AddEntity("food stall", "furniture/vending/food_stall");
    park.placer.Reserve({p, {1.6f, 1.0f}, 0});
    park.builder.AddInstance({AddStallMesh(park.builder, park.surfaces, i), PlaceUpright(park.OnGround(p, 0.03f), 0), stall});
    stand("umbrella", p + Vec2f{0, 0.85f}, 0, "furniture/shade/umbrella", i);
  }
  for (int i = 0; i < 7; ++i) {
    const Vec2f p = middle + Vec2f{3.0f * static_cast<float>(i) - 9, 7.0f};
    park.placer.Try("circle_fence", park.OnGround(p, 0.03f), 0);
    stand("flower_bed", p, 0, "vegetation/flower", rng.Index(4));
  }
}

void BuildPlayground(Park& park) {
  const Vec2f middle{-26, -54};
  for (uint32_t i = 0; i < 6; ++i) {
    const Vec2f p = middle + Vec2f{7.0f * static_cast<float>(i % 3) - 7, 7.5f * static_cast<float>(i / 3) - 4};
    park.placer.Try("playground", park.OnGround(p, 0.06f), 0.3f * static_cast<float>(i), 1, {1, 1, 1}, i);
  }
}

// Road works on the east road: a lane closed by barriers and drums.
void CloseLane(Park& park) {
  const Curve& road = park.layout.side_roads().front();
  const auto at = [&](float s, float d) {
    const Vec2f p = road.At(s, d);
    return Vec3f{p.x, p.y, park.layout.Base(p) + CarriagewayZ(d, kSideHalf) - 0.005f};
  };
  for (int i = 0; i < 5; ++i) {
    const float s = 262 + 3.4f * static_cast<float>(i);
    const Vec2f v = road.Along(s);
    park.placer.Try("road_block", at(s, -0.4f), FacingYaw({v.y, -v.x}), 1, {1, 1, 1}, static_cast<uint32_t>(i % 2));
  }
  for (int i = 0; i < 7; ++i) {
    const float s = 254 + 4.2f * static_cast<float>(i);
    park.placer.Try("traffic_barrel", at(s, i < 2 ? -3.4f + 1.5f * static_cast<float>(i) : -1.5f), 0);
  }
}

}  // namespace

void FurnishPark(Park& park) {
  // The lamp right before the spawn.
  const Vec2f lamp{1.6f, 5.0f};
  park.placer.Try("crook_lamp", {lamp.x, lamp.y, park.layout.Base(lamp) + 0.12f}, kTauF / 2);
  FurnishRoad(park, park.layout.main(), kMainHalf);
  for (const Curve& side : park.layout.side_roads()) FurnishRoad(park, side, kSideHalf);
  RngStream rng(park.seed, "park furniture");
  CloseLane(park);
  PutTraffic(park, park.layout.main(), kMainHalf, false, rng);
  for (const Curve& side : park.layout.side_roads()) PutTraffic(park, side, kSideHalf, true, rng);
  FurnishJunctions(park);
  for (const Curve& path : park.layout.paths()) FurnishPath(park, path, rng);
  BuildCafe(park, rng);
  BuildPlayground(park);
}

}  // namespace airsim360::internal::park

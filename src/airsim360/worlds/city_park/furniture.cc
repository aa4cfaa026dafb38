// Furniture along the roads and paths.
#include <cmath>
#include <numbers>

#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/district.h"

namespace airsim360::internal::park {
namespace {

constexpr float kTau = 2 * std::numbers::pi_v<float>;

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

}  // namespace

void FurnishPark(Park& park) {
  // The lamp right before the spawn.
  const Vec2f lamp{1.6f, 5.0f};
  park.placer.Try("crook_lamp", {lamp.x, lamp.y, park.layout.Base(lamp) + 0.12f}, kTau / 2);
  FurnishRoad(park, park.layout.main(), kMainHalf);
  for (const Curve& side : park.layout.side_roads()) FurnishRoad(park, side, kSideHalf);
}

void BuildHouses(Park&) {}

}  // namespace airsim360::internal::park

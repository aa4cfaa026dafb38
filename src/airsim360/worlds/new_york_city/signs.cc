// Billboards, banners, light boxes and flags.
#include <algorithm>
#include <cmath>
#include <span>

#include "airsim360/base/random.h"
#include "airsim360/worlds/new_york_city/city.h"
#include "airsim360/worlds/props/billboards.h"

namespace airsim360::internal {
namespace {

// One side of a lot's street wall: from `origin` along `along`, looking `out`.
struct WallLine {
  Vec2f origin, along, out;
  float length;
  Vec3f At(float s, float z, float off) const {
    const Vec2f p = origin + along * s + out * off;
    return {p.x, p.y, z};
  }
};

WallLine AvenueWall(const Lot& lot) {
  const GroundRect& r = lot.rect;
  if (lot.index == 0) return {{r.x0, r.y1}, {0, -1}, {-1, 0}, r.depth()};
  return {{r.x1, r.y0}, {0, 1}, {1, 0}, r.depth()};
}
WallLine StreetWall(const Lot& lot) {
  const GroundRect& r = lot.rect;
  if (lot.row == 0) return {{r.x0, r.y0}, {1, 0}, {0, -1}, r.width()};
  return {{r.x1, r.y1}, {-1, 0}, {0, 1}, r.width()};
}

// Gap between the wall plane and the back of a sign, so that ornament stays behind it.
float Gap(FacadeStyle style) {
  return style == FacadeStyle::kBracedGlass  ? 0.72f
         : style == FacadeStyle::kDeco       ? 0.34f
         : style == FacadeStyle::kGlazedDeco ? 0.36f
                                             : 0.28f;
}

// A sign at a height on one wall of the lot with a role.
struct Sign {
  const char* role;
  bool avenue;  // else on the wall along the street
  const char* name;
  const char* kind;
  uint32_t variant;
  float s, z, scale;  // metres along the wall and above the ground
};

// What instructions name.
constexpr Sign kNamedBoards[] = {
    {"deco corner", false, "billboard BLACK & WHITE", "billboard", 0, 17, 8.5f, 1.0f},
    {"grid tower", true, "billboard person in a blue suit", "billboard", 1, 15, 8.5f, 1.15f},
    {"brown tower", true, "billboard red car", "billboard", 2, 16, 9, 1.2f},
    {"brown tower", false, "billboard black and white portrait", "billboard", 3, 11, 9, 1.0f},
    {"braced corner", false, "blue billboard", "billboard", 4, 14, 9, 1.1f},
};
// And more of the same street life.
constexpr Sign kStreetLife[] = {
    {"grid tower", false, "banner", "banner", 0, 4, 7.5f, 1.0f},
    {"grid tower", false, "light box", "light_box", 1, 14, 5.6f, 0.9f},
    {"deco corner", false, "light box", "light_box", 0, 17.5f, 5.7f, 1.0f},
    {"deco corner", true, "billboard", "billboard", 5, 9, 11, 1.1f},
    {"deco corner", true, "banner", "banner", 1, 22, 9, 0.9f},
    {"grid tower", false, "billboard", "billboard", 11, 14, 9, 0.9f},
    {"brown tower", false, "light box", "light_box", 5, 11, 6.2f, 0.9f},
    {"braced corner", false, "billboard", "billboard", 9, 5.5f, 17.5f, 0.8f},
    {"braced corner", true, "billboard", "billboard", kDrawnBoards + kVistaBoards - 1, 18, 10.5f, 1.15f},
    {"braced corner", true, "banner", "banner", 2, 5, 8.5f, 1.3f},
    {"braced corner", true, "light box", "light_box", 4, 15, 6.0f, 0.9f},
    {"brown tower", true, "light box", "light_box", 2, 8, 6.1f, 1.0f},
    {"ribbon low", false, "billboard", "billboard", 10, 7, 8, 0.8f},
    {"blue tower", true, "banner", "banner", 3, 6, 9, 1.1f},
    {"north deco", true, "banner", "banner", 3, 5, 9, 1.0f},
    {"loft corner", true, "billboard", "billboard", 6, 12, 10, 1.1f},
    {"glass slab", true, "banner", "banner", 2, 6, 8, 1.0f},
};

EntityId Hang(District& d, const Lot& lot, const WallLine& wall, std::string name, std::string_view kind, uint32_t variant, float s,
              float z, float scale) {
  return PlaceNamed(d, std::move(name), kind, wall.At(s, z, Gap(lot.style)), FacingYaw(wall.out), variant, scale);
}

void HangAll(District& d, const Manhattan& city, std::span<const Sign> signs) {
  for (const Sign& sign : signs) {
    const Lot& lot = LotOf(city, sign.role);
    Hang(d, lot, sign.avenue ? AvenueWall(lot) : StreetWall(lot), sign.name, sign.kind, sign.variant, sign.s, sign.z, sign.scale);
  }
}

// A board on a steel frame at the edge of a roof, looking over wall `wall`.
void RaiseRoofBoard(District& d, const Lot& lot, const WallLine& wall, std::string name, uint32_t variant, float scale) {
  const float z = lot.podium, s = wall.length / 2, yaw = FacingYaw(wall.out);
  const EntityId board = PlaceNamed(d, std::move(name), "billboard", wall.At(s, z + 2.2f * scale, -1.2f), yaw, variant, scale);
  const Vec3f foot = wall.At(s, z, -1.2f);
  d.placer.shelf().PlaceAs(board, "billboard_frame", PlaceUpright(foot, yaw, scale));
}

void PaintMurals(District& d, const Manhattan& city) {
  uint32_t murals = 0;
  for (const BuildingPlan& plan : city.buildings) {
    if (plan.mural_edge < 0) continue;
    const auto e = static_cast<size_t>(plan.mural_edge);
    const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
    const float length = std::hypot(v.x, v.y), foot = plan.party_height[e], bare = plan.height() - foot;
    const float scale = std::min({1.25f, (length - 1.2f) / 12.6f, (bare - 2) / 9});
    const Vec2f out = Vec2f{v.y, -v.x} * (1 / length), p = a + v * 0.5f + out * 0.01f;
    PlaceNamed(d, "mural", "mural", {p.x, p.y, foot + (bare - 9 * scale) * 0.6f}, FacingYaw(out), murals++, scale);
  }
}

// Signs of one lot by chance. No board or box comes again before all others have.
class ChanceSigns {
 public:
  explicit ChanceSigns(District& d) : d_(d) {}

  void HangOn(const Lot& lot, RngStream rng) {
    const bool free = lot.role.empty();
    if (lot.corner() && free) {
      HangOnCorner(lot, rng);
    } else if (!lot.corner() && free && lot.style != FacadeStyle::kBrickWalkUp && rng.Chance(0.3)) {
      const WallLine wall = StreetWall(lot);
      Hang(d_, lot, wall, "light box", "light_box", boxes_++ % kLightBoxes, wall.length / 2, 5.8f, std::min(1.0f, wall.length / 11));
    }
    if (lot.corner() && lot.boards && rng.Chance(0.6)) {
      const WallLine wall = StreetWall(lot);
      Hang(d_, lot, wall, "american flag", "us_flag", 1, wall.length - 3, 5.2f, 1.25f);
    }
  }

 private:
  void HangOnCorner(const Lot& lot, RngStream& rng) {
    const WallLine wall = AvenueWall(lot);
    if (rng.Chance(0.75) && lot.boards) {
      const auto scale = static_cast<float>(rng.Uniform(0.75, 1.05)), z = static_cast<float>(rng.Uniform(7.5, 9));
      Hang(d_, lot, wall, "billboard", "billboard", Advert(), std::min(10.0f, wall.length / 2), z, scale);
    }
    if (rng.Chance(0.5) && lot.boards)
      Hang(d_, lot, wall, "banner", "banner", rng.Index(4), wall.length - 4, 7.5f, lot.podium > 20 && !lot.houses ? 0.9f : 0.6f);
    if (rng.Chance(0.35) && lot.height < 45 && !lot.houses) RaiseRoofBoard(d_, lot, StreetWall(lot), "roof billboard", Advert(), 0.9f);
  }
  uint32_t Advert() { return kDrawnBoards + adverts_++ % kVistaBoards; }

  District& d_;
  uint32_t adverts_ = 0, boxes_ = 6;
};

}  // namespace

void MarkMurals(Manhattan& city, const GroundRect& reach, uint64_t seed) {
  RngStream rng(seed, "murals");
  for (BuildingPlan& plan : city.buildings) {
    if (plan.base > 0 || !plan.upper.empty() || !reach.Contains(plan.bounds().center())) continue;
    float best = 11;  // metres of bare height
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      const Vec2f v = plan.outline[(e + 1) % plan.outline.size()] - plan.outline[e];
      const float bare = plan.height() - plan.party_height[e];
      if (plan.edges[e] != EdgeKind::kParty || std::hypot(v.x, v.y) < 9 || bare <= best) continue;
      best = bare;
      plan.mural_edge = static_cast<int>(e);
    }
    if (plan.mural_edge >= 0 && !rng.Chance(0.6)) plan.mural_edge = -1;
  }
}

void PartBoardsFromFireEscapes(Manhattan& city, uint64_t seed) {
  for (size_t i = 0; i < city.lots.size(); ++i) {
    Lot& lot = city.lots[i];
    if (lot.style != FacadeStyle::kBrickWalkUp || !lot.corner()) continue;
    lot.boards = !lot.role.empty() || RngStream(seed, "boards", i).Chance(0.5);
    if (!lot.boards) continue;
    for (BuildingPlan& plan : city.buildings)
      if (plan.block == lot.block && lot.rect.Contains(plan.bounds().center())) plan.fire_escapes = false;
  }
}

void HangSigns(District& d, const Manhattan& city, bool more) {
  HangAll(d, city, kNamedBoards);
  if (!more) return;
  HangAll(d, city, kStreetLife);
  const Lot &braced = LotOf(city, "braced corner"), &ribbon = LotOf(city, "ribbon low");
  RaiseRoofBoard(d, braced, StreetWall(braced), "roof billboard", 7, 1.25f);
  RaiseRoofBoard(d, ribbon, StreetWall(ribbon), "roof billboard", 8, 0.9f);
  PaintMurals(d, city);
  ChanceSigns chance(d);
  const GroundRect reach = d.plan.reach();
  for (size_t i = 0; i < city.lots.size(); ++i) {
    const Lot& lot = city.lots[i];
    if (lot.use != LotUse::kBuilding || !reach.Contains(lot.rect.center())) continue;
    if (lot.style == FacadeStyle::kBrownstone || (lot.houses && !lot.corner())) continue;
    chance.HangOn(lot, RngStream(d.seed, "signs", i));
  }
}

}  // namespace airsim360::internal

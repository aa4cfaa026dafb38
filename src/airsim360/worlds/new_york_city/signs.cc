// Billboards, banners, light boxes and flags.
#include <algorithm>
#include <cmath>

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
  return style == FacadeStyle::kBracedGlass ? 0.72f : style == FacadeStyle::kDeco ? 0.34f : 0.28f;
}

struct Boards {
  District& d;
  EntityId Hang(const WallLine& wall, FacadeStyle style, std::string name, std::string_view kind,
                uint32_t variant, float s, float z, float scale) {
    return PlaceNamed(d, std::move(name), kind, wall.At(s, z, Gap(style)), FacingYaw(wall.out), variant,
                      scale);
  }
};

// A board on a steel frame at the edge of a roof, looking over wall `wall`.
void RaiseRoofBoard(District& d, const Lot& lot, const WallLine& wall, std::string name, uint32_t variant,
                    float scale) {
  const float z = lot.podium, s = wall.length / 2, yaw = FacingYaw(wall.out);
  const EntityId board =
      PlaceNamed(d, std::move(name), "billboard", wall.At(s, z + 2.2f * scale, -1.2f), yaw, variant, scale);
  const Vec3f foot = wall.At(s, z, -1.2f);
  d.placer.shelf().PlaceAs(board, "billboard_frame", PlaceUpright(foot, yaw, scale));
}

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
  Boards boards{d};
  const auto lot = [&](const char* role) -> const Lot& { return LotOf(city, role); };
  const auto hang = [&](const char* role, bool avenue, std::string name, std::string_view kind,
                        uint32_t variant, float s, float z, float scale) {
    const Lot& at = lot(role);
    boards.Hang(avenue ? AvenueWall(at) : StreetWall(at), at.style, std::move(name), kind, variant, s, z,
                scale);
  };
  // What instructions name.
  hang("deco corner", false, "billboard BLACK & WHITE", "billboard", 0, 17, 8.5f, 1.0f);
  hang("grid tower", true, "billboard person in a blue suit", "billboard", 1, 15, 8.5f, 1.15f);
  hang("brown tower", true, "billboard red car", "billboard", 2, 16, 9, 1.2f);
  hang("brown tower", false, "billboard black and white portrait", "billboard", 3, 11, 9, 1.0f);
  hang("braced corner", false, "blue billboard", "billboard", 4, 14, 9, 1.1f);
  if (!more) return;
  // And more of the same street life.
  hang("grid tower", false, "banner", "banner", 0, 4, 7.5f, 1.0f);
  hang("grid tower", false, "light box", "light_box", 1, 14, 5.6f, 0.9f);
  hang("deco corner", false, "light box", "light_box", 0, 17.5f, 5.7f, 1.0f);
  hang("deco corner", true, "billboard", "billboard", 5, 9, 11, 1.1f);
  hang("deco corner", true, "banner", "banner", 1, 22, 9, 0.9f);
  hang("grid tower", false, "billboard", "billboard", 11, 14, 9, 0.9f);
  hang("brown tower", false, "light box", "light_box", 5, 11, 6.2f, 0.9f);
  hang("braced corner", false, "billboard", "billboard", 9, 5.5f, 17.5f, 0.8f);
  hang("braced corner", true, "billboard", "billboard", kDrawnBoards + kVistaBoards - 1, 18, 10.5f, 1.15f);
  hang("braced corner", true, "banner", "banner", 2, 5, 8.5f, 1.3f);
  hang("braced corner", true, "light box", "light_box", 4, 15, 6.0f, 0.9f);
  hang("brown tower", true, "light box", "light_box", 2, 8, 6.1f, 1.0f);
  hang("ribbon low", false, "billboard", "billboard", 10, 7, 8, 0.8f);
  hang("blue tower", true, "banner", "banner", 3, 6, 9, 1.1f);
  hang("north deco", true, "banner", "banner", 3, 5, 9, 1.0f);
  hang("loft corner", true, "billboard", "billboard", 6, 12, 10, 1.1f);
  hang("glass slab", true, "banner", "banner", 2, 6, 8, 1.0f);
  RaiseRoofBoard(d, lot("braced corner"), StreetWall(lot("braced corner")), "roof billboard", 7, 1.25f);
  RaiseRoofBoard(d, lot("ribbon low"), StreetWall(lot("ribbon low")), "roof billboard", 8, 0.9f);
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
  // Other corners of the core by chance; no board or box comes again before all others have.
  uint32_t adverts = 0, boxes = 6;
  const auto advert = [&] { return kDrawnBoards + adverts++ % kVistaBoards; };
  const GroundRect reach = d.plan.reach();
  for (size_t i = 0; i < city.lots.size(); ++i) {
    const Lot& at = city.lots[i];
    RngStream rng(d.seed, "signs", i);
    if (at.use != LotUse::kBuilding || !reach.Contains(at.rect.center())) continue;
    if (at.style == FacadeStyle::kBrownstone || (at.houses && !at.corner())) continue;
    const bool free = at.role.empty();
    if (at.corner() && free) {
      const WallLine wall = AvenueWall(at);
      if (rng.Chance(0.75) && at.boards)
        boards.Hang(wall, at.style, "billboard", "billboard", advert(),
                    std::min(10.0f, wall.length / 2), static_cast<float>(rng.Uniform(7.5, 9)),
                    static_cast<float>(rng.Uniform(0.75, 1.05)));
      if (rng.Chance(0.5) && at.boards)
        boards.Hang(wall, at.style, "banner", "banner", rng.Index(4), wall.length - 4, 7.5f,
                    at.podium > 20 && !at.houses ? 0.9f : 0.6f);
      if (rng.Chance(0.35) && at.height < 45 && !at.houses)
        RaiseRoofBoard(d, at, StreetWall(at), "roof billboard", advert(), 0.9f);
    } else if (!at.corner() && free && at.style != FacadeStyle::kBrickWalkUp && rng.Chance(0.3)) {
      const WallLine wall = StreetWall(at);
      boards.Hang(wall, at.style, "light box", "light_box", boxes++ % kLightBoxes, wall.length / 2, 5.8f,
                  std::min(1.0f, wall.length / 11));
    }
    if (at.corner() && at.boards && rng.Chance(0.6)) {
      const WallLine wall = StreetWall(at);
      boards.Hang(wall, at.style, "american flag", "us_flag", 1, wall.length - 3, 5.2f, 1.25f);
    }
  }
}

}  // namespace airsim360::internal

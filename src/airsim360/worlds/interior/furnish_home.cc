// Rooms of homes: what stands in them, as people live in them.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/interior/furnisher.h"

namespace airsim360::internal {
namespace {

void Curtains(RoomSpace& s) {
  const uint32_t kind = s.Pick("curtain", {});
  for (const RoomSpace::Hole& hole : s.holes()) {
    if (hole.kind != OpeningKind::kWindow || hole.sill < 0.5f) continue;
    // A pair on its rod above the window; the same in all of the room.
    s.Put("curtain", hole.spot.At(0, s.Size("curtain", kind).y / 2 + 0.15f), hole.spot.yaw, 0.02f, kind);
  }
}

// Under windows, so low that they go below the sill.
void Radiators(RoomSpace& s) {
  for (const RoomSpace::Hole& hole : s.holes())
    if (hole.kind == OpeningKind::kWindow && hole.sill > 0.6f && s.rng().Chance(0.8))
      s.Put("radiator", hole.spot.At(0, s.Size("radiator").y / 2 + 0.03f), hole.spot.yaw, 0.1f);
}

void Switches(RoomSpace& s) {
  for (const RoomSpace::Hole& hole : s.holes())
    if (IsDoor(hole.kind) || hole.kind == OpeningKind::kPassage)
      s.Put("switch_plate", hole.spot.At(hole.width / 2 + 0.14f, 0.008f), hole.spot.yaw, 1.05f);
}

void Pictures(RoomSpace& s, int count) {
  for (int i = 0; i < count; ++i) s.OnWall("picture_frame", static_cast<float>(s.rng().Uniform(1.35, 1.55)));
}

void Seats(RoomSpace& s) {
  const float sofa_depth = s.Size("sofa_3").y;
  std::optional<WallSpot> spot;
  for (const float front : {2.2f, 1.5f, 0.9f}) {
    if (!spot) spot = s.FindWall(2.3f, sofa_depth, 0.84f, front);
  }
  if (!spot) return;
  s.Put("sofa_3", spot->At(0, sofa_depth / 2 + 0.04f), spot->yaw);
  const Vec2f table = spot->At(0, sofa_depth + 0.75f);
  s.Put("rug", spot->At(0, sofa_depth + 0.65f), spot->yaw);
  s.At("coffee_table", table, spot->yaw);
  const float top = s.Top("coffee_table");
  s.Put("book_row", table + spot->along() * 0.25f, spot->yaw + Jitter(s, 0.6), top, 2);
  s.Put("dishes", table + spot->along() * 0.02f + spot->inward * 0.1f, 0, top, 0);
  s.Put("plant_small", table + spot->along() * -0.2f, 0, top);
  for (const float side : {-1.0f, 1.0f})
    if (s.rng().Chance(0.8)) s.At("armchair", spot->At(side * 1.75f, sofa_depth + 0.9f), spot->yaw + side * (kPiF / 2) + Jitter(s, 0.25));
  s.At("floor_lamp", spot->At(1.55f, 0.3f), 0);
  // The television stands opposite.
  const int opposite = std::abs(spot->inward.y) > 0.5f ? (spot->inward.y > 0 ? 2 : 0) : (spot->inward.x > 0 ? 1 : 3);
  if (const auto tv = s.AtWall("tv_stand", 0.3f, opposite))
    s.Put("television", tv->At(0, 0.22f), tv->yaw, s.Top("tv_stand"));
  else if (const auto any = s.AtWall("tv_stand", 0.3f))
    s.Put("television", any->At(0, 0.22f), any->yaw, s.Top("tv_stand"));
}

void Living(RoomSpace& s, double clutter) {
  Seats(s);
  s.RowAtWall("bookshelf", 2);
  s.AtWall("bookshelf", 0.4f);
  if (const auto d = s.AtWall("dresser", 0.4f)) {
    s.Put("table_lamp", d->At(-0.3f, 0.22f), d->yaw, s.Top("dresser"));
    s.Put("picture_frame", d->At(0.25f, 0.12f), d->yaw, s.Top("dresser"));
  }
  for (int i = 0; i < 2 + static_cast<int>(2 * clutter); ++i) s.AtWall("potted_plant_indoor");
  s.AtWall("armchair", 0.4f);
  Pictures(s, 5);
}

void DiningSet(RoomSpace& s, Vec2f p, float yaw, int chairs_a_side) {
  if (!s.At("dining_table_home", p, yaw)) return;
  const Vec3f table = s.Size("dining_table_home");
  const Vec2f t{std::cos(yaw), std::sin(yaw)}, n{-t.y, t.x};
  for (int i = 0; i < chairs_a_side; ++i) {
    const float along = table.x * ((static_cast<float>(i) + 0.5f) / static_cast<float>(chairs_a_side) - 0.5f);
    for (const float side : {-1.0f, 1.0f})
      s.Put("dining_chair_home", p + t * along + n * (side * (table.y / 2 + 0.12f + static_cast<float>(s.rng().Uniform(0.05, 0.2)))),
            yaw + (side > 0 ? 0 : kPiF) + Jitter(s, 0.18));
    for (const float side : {-1.0f, 1.0f})
      s.Put("dishes", p + t * along + n * (side * (table.y / 2 - 0.2f)), 0, s.Top("dining_table_home"));
  }
  s.Put("plant_small", p, 0, s.Top("dining_table_home"));
}

void Dining(RoomSpace& s, double clutter) {
  const bool long_x = s.rect().width() > s.rect().depth();
  DiningSet(s, s.rect().center(), long_x ? 0 : kPiF / 2, 3);
  if (const auto d = s.AtWall("dresser", 0.3f)) {
    s.Put("plant_small", d->At(0.2f, 0.2f), 0, s.Top("dresser"));
    s.Put("book_row", d->At(-0.25f, 0.2f), d->yaw, s.Top("dresser"));
  }
  s.AtWall("potted_plant_indoor");
  if (clutter > 0.5) s.AtWall("potted_plant_indoor");
  Pictures(s, 3);
}

// Units in a row: sink, stove and counters, with cabinets above, where a wall is long enough.
void Kitchen(RoomSpace& s, double clutter) {
  const float w = s.Size("kitchen_counter").x, d = s.Size("kitchen_counter").y,
              total = s.Size("kitchen_sink_counter").x + s.Size("stove").x + 3 * w + s.Size("fridge").x + 0.05f;
  // The tall fridge ends the row, the rest goes below windows.
  bool built = false;
  for (const bool full : {true, false}) {
    const float length = full ? total : total - w * 2;
    const auto spot = s.FindWall(length, d, 1.0f, 0.8f);
    if (!spot) continue;
    float at = -length / 2;
    const auto put = [&](const char* kind) {
      const float width = s.Size(kind).x;
      s.Put(kind, spot->At(at + width / 2, s.Size(kind).y / 2 + 0.02f), spot->yaw);
      at += width;
      return at - width / 2;
    };
    put("fridge");
    const float a = put("kitchen_counter"), b = put("kitchen_sink_counter");
    const float c = full ? put("kitchen_counter") : b, e = put("stove"), f = full ? put("kitchen_counter") : e;
    const float top = s.Top("kitchen_counter");
    for (const float x : {a, c, f}) {
      const auto blocked = std::any_of(s.holes().begin(), s.holes().end(), [&](const RoomSpace::Hole& h) {
        const Vec2f to = h.spot.foot - spot->At(x, 0);
        return std::hypot(to.x, to.y) < h.width / 2 + 0.4f;
      });
      if (!blocked) s.Put("wall_cabinet", spot->At(x, s.Size("wall_cabinet").y / 2 + 0.005f), spot->yaw, 1.45f);
    }
    s.Put("dishes", spot->At(a, 0.32f), 0, top);
    s.Put("kettle", spot->At(b + 0.38f, 0.2f), spot->yaw, top);
    if (full) s.Put("microwave", spot->At(c, 0.26f), spot->yaw, top);
    if (full) s.Put("clutter", spot->At(f, 0.3f), spot->yaw, top);
    built = true;
    break;
  }
  if (!built) {
    for (const char* kind : {"kitchen_sink_counter", "stove", "kitchen_counter", "fridge", "kitchen_counter"}) s.AtWall(kind, 0.7f);
  }
  s.Anywhere("waste_bin_indoor", 0.25f);
  if (clutter > 0.3) s.AtWall("box_small");
  s.AtWall("potted_plant_indoor");
  Pictures(s, 1);
}

void Bed(RoomSpace& s, const char* kind, float width) {
  const float length = s.Size(kind).y;
  const auto spot = s.FindWall(width, length, 0.8f, 0.6f);
  if (!spot) return;
  s.Put(kind, spot->At(0, length / 2 + 0.03f), spot->yaw);
  s.Put("rug", spot->At(0, length + 0.2f), spot->yaw);
  const float side = s.Size(kind).x / 2 + s.Size("nightstand").x / 2 + 0.04f;
  for (const float end : {-1.0f, 1.0f}) {
    if (width < 2.2f && end > 0) continue;
    s.Put("nightstand", spot->At(end * side, s.Size("nightstand").y / 2 + 0.03f), spot->yaw);
    s.Put("table_lamp", spot->At(end * side, s.Size("nightstand").y / 2 + 0.03f), spot->yaw, s.Top("nightstand"));
  }
}

void Desk(RoomSpace& s) {
  if (const auto d = s.AtWall("desk_office", 0.9f)) {
    const float depth = s.Size("desk_office").y, top = 0.73f;
    s.Put("office_chair", d->At(0, depth + 0.35f), d->yaw + kPiF + Jitter(s, 0.5));
    s.Put("monitor", d->At(0, 0.22f), d->yaw, top);
    s.Put("keyboard", d->At(0, 0.5f), d->yaw, top);
    s.Put("computer", d->At(0.55f, 0.3f), d->yaw);
    s.Put("table_lamp", d->At(-0.6f, 0.2f), d->yaw, top);
    s.Put("book_row", d->At(0.5f, 0.2f), d->yaw, top);
    s.Put("papers", d->At(-0.3f, 0.48f), d->yaw + Jitter(s, 0.3), top);
  }
}

void Sleeping(RoomSpace& s, double clutter, bool child) {
  Bed(s, child ? "bed_single" : "bed_double", child ? 1.5f : 2.7f);
  s.RowAtWall("wardrobe", child ? 1 : 2);
  if (const auto d = s.AtWall("dresser", 0.5f)) {
    s.Put("picture_frame", d->At(0.2f, 0.1f), d->yaw, s.Top("dresser"));
    s.Put("book_row", d->At(-0.2f, 0.2f), d->yaw, s.Top("dresser"));
  }
  if (child) Desk(s);
  s.AtWall(child ? "bookshelf" : "armchair", 0.3f);
  s.AtWall("potted_plant_indoor");
  s.OnWall("mirror_wall", 0.6f);
  if (clutter > 0.3) s.Anywhere("shoes", 0.4f);
  if (child)
    for (int i = 0; i < static_cast<int>(3 * clutter); ++i) s.Anywhere("box_small", 0.4f);
  Pictures(s, 3);
}

void Bath(RoomSpace& s, bool full) {
  if (full && !s.AtWall("bathtub", 0.4f)) s.AtWall("bathtub");
  if (full) s.AtWall("shower", 0.2f);
  if (const auto w = s.AtWall("washbasin", 0.6f)) s.Put("mirror_wall", w->At(0, 0.03f), w->yaw, 1.1f);
  s.AtWall("toilet", 0.6f);
  if (!full) return;
  s.AtWall("washing_machine", 0.3f);
  s.AtWall("waste_bin_indoor");
  s.Anywhere("rug", 0.4f);
}

void Store(RoomSpace& s, double clutter) {
  s.RowAtWall("bookshelf", 2, 0.02f, 0.3f);
  for (int i = 0; i < 2 + static_cast<int>(5 * clutter); ++i) s.AtWall(s.rng().Chance(0.5) ? "box_large" : "box_small");
}

}  // namespace

void FurnishHome(RoomSpace& s, double clutter) {
  switch (s.room().type) {
    case RoomType::kLivingRoom:
      Living(s, clutter);
      break;
    case RoomType::kDiningRoom:
      Dining(s, clutter);
      break;
    case RoomType::kKitchen:
      Kitchen(s, clutter);
      break;
    case RoomType::kBedroom:
      Sleeping(s, clutter, false);
      break;
    case RoomType::kChildRoom:
      Sleeping(s, clutter, true);
      break;
    case RoomType::kBathroom:
      Bath(s, true);
      break;
    case RoomType::kToilet:
      Bath(s, false);
      break;
    case RoomType::kStorage:
      Store(s, clutter);
      break;
    case RoomType::kStudy:
      Desk(s);
      s.RowAtWall("bookshelf", 3);
      s.RowAtWall("filing_cabinet", 2);
      s.AtWall("armchair", 0.3f);
      s.AtWall("potted_plant_indoor");
      s.Anywhere("waste_bin_indoor", 0.3f);
      Pictures(s, 3);
      break;
    case RoomType::kHall:
      s.AtWall("coat_rack", 0.3f);
      s.AtWall("dresser", 0.3f);
      s.AtWall("shoes", 0.3f);
      s.OnWall("mirror_wall", 0.6f);
      Pictures(s, 2);
      break;
    case RoomType::kCorridor:
      Pictures(s, 6);
      s.AtWall("potted_plant_indoor");
      break;
    default:
      break;
  }
  Curtains(s);
  Radiators(s);
  Switches(s);
}

}  // namespace airsim360::internal

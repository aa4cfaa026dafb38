// Shops and the halls between them.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/interior/furnisher.h"

namespace airsim360::internal {
namespace {

// Rows of something with ways between, clear of the walls.
void Rows(RoomSpace& s, const char* kind, float way, float margin, bool along_x) {
  const Vec3f size = s.Size(kind);
  const PlanRect r = s.rect().Inset(margin);
  const float step = size.y * 2 + way;
  const float from = along_x ? r.y0 : r.x0, to = along_x ? r.y1 : r.x1, begin = along_x ? r.x0 : r.y0, end = along_x ? r.x1 : r.y1;
  for (float at = from + size.y; at + size.y <= to; at += step) {
    for (float s0 = begin + size.x / 2; s0 + size.x / 2 <= end; s0 += size.x + 0.02f) {
      for (const float side : {-1.0f, 1.0f}) {
        const float across = at + side * size.y / 2;
        const Vec2f p = along_x ? Vec2f{s0, across} : Vec2f{across, s0};
        s.At(kind, p, along_x ? (side > 0 ? kPiF : 0) : (side > 0 ? kPiF / 2 : -kPiF / 2));
      }
    }
  }
}

void Counter(RoomSpace& s) {
  if (const auto c = s.AtWall("shop_counter", 0.9f)) s.Put("computer", c->At(0.2f, 0.3f), c->yaw + kPiF, s.Top("shop_counter"));
}

void Clothes(RoomSpace& s, double clutter) {
  Counter(s);
  for (int i = 0; i < 4; ++i) s.RowAtWall("shop_shelf", 3);
  const int rails = static_cast<int>(s.rect().width() * s.rect().depth() / 9 * clutter);
  for (int i = 0; i < rails; ++i) s.Anywhere("clothes_rail", 1.0f);
  for (int i = 0; i < 5; ++i) s.Anywhere("mannequin_bust", 0.8f);
  for (int i = 0; i < 3; ++i) s.OnWall("mirror_wall", 0.4f);
  s.Anywhere("bench_mall", 1);
}

void Electronics(RoomSpace& s) {
  Counter(s);
  for (int i = 0; i < 3; ++i) s.RowAtWall("shop_shelf", 4);
  for (int i = 0; i < 6; ++i) s.OnWall("television", 1.2f);
  const PlanRect r = s.rect().Inset(2.0f);
  for (float x = r.x0; x < r.x1; x += 2.6f) {
    for (float y = r.y0; y < r.y1; y += 2.4f) {
      if (!s.At("meeting_table", {x, y}, 0)) continue;
      for (const float d : {-0.6f, 0.0f, 0.6f})
        s.Put(d == 0 ? "laptop" : "monitor", {x + d, y}, s.rng().Chance(0.5) ? 0 : kPiF, s.Top("meeting_table"));
    }
  }
}

void Groceries(RoomSpace& s) {
  // Tills towards the hall, shelves behind, fridges along the walls.
  const bool door_north = s.rect().y0 < 10;
  const float y = door_north ? s.rect().y1 - 2.6f : s.rect().y0 + 2.6f;
  for (float x = s.rect().x0 + 1.6f; x < s.rect().x1 - 1.5f; x += 2.3f) s.At("checkout", {x, y}, kPiF / 2);
  s.Reserve({s.rect().center().x, y}, {s.rect().width() / 2, 1.6f});
  for (int i = 0; i < 2; ++i) s.RowAtWall("fridge", 5, 0.01f);
  Rows(s, "shop_shelf", 1.5f, 1.5f, false);
  for (int i = 0; i < 6; ++i) s.AtWall(s.rng().Chance(0.5) ? "box_large" : "pallet_stack");
}

void Cafe(RoomSpace& s) {
  s.RowAtWall("shop_counter", 2, 0.01f, 1.0f);
  s.AtWall("fridge", 0.5f);
  s.AtWall("kitchen_sink_counter", 0.5f);
  const PlanRect r = s.rect().Inset(1.0f);
  for (float y = r.y0 + 0.8f; y < r.y1; y += 2.3f) {
    for (float x = r.x0 + 0.8f; x < r.x1; x += 2.6f) {
      const float yaw = s.rng().Chance(0.3) ? kPiF / 2 : 0;
      if (!s.At("dining_table_home", {x, y}, yaw)) continue;
      const Vec3f table = s.Size("dining_table_home");
      const Vec2f t{std::cos(yaw), std::sin(yaw)}, n{-t.y, t.x};
      for (const float side : {-1.0f, 1.0f})
        for (const float along : {-0.25f, 0.25f})
          if (s.rng().Chance(0.9))
            s.Put("dining_chair_home",
                  Vec2f{x, y} + t * (along * table.x) + n * (side * (table.y / 2 + static_cast<float>(s.rng().Uniform(0.1, 0.35)))),
                  yaw + (side > 0 ? 0 : kPiF) + static_cast<float>(s.rng().Uniform(-0.3, 0.3)));
      if (s.rng().Chance(0.5)) s.Put("dishes", {x, y}, 0, s.Top("dining_table_home"));
      if (s.rng().Chance(0.3)) s.Put("plant_small", {x + 0.2f, y + 0.1f}, 0, s.Top("dining_table_home"));
    }
  }
  for (int i = 0; i < 4; ++i) s.AtWall("potted_plant_indoor");
  for (int i = 0; i < 2; ++i) s.AtWall("waste_bin_indoor");
}

void Books(RoomSpace& s) {
  Counter(s);
  for (int i = 0; i < 3; ++i) s.RowAtWall("bookshelf", 5);
  Rows(s, "bookshelf", 1.6f, 1.8f, true);
  s.Anywhere("armchair", 0.8f);
}

void Shop(RoomSpace& s, double clutter) {
  switch (s.rng().Index(6)) {
    case 0:
    case 1:
    case 2:
      Clothes(s, clutter);
      break;
    case 3:
      Electronics(s);
      break;
    case 4:
      Books(s);
      break;
    default:
      Cafe(s);
  }
  s.AtWall("potted_plant_indoor");
  s.OnWall("picture_frame", 1.5f);
}

void Concourse(RoomSpace& s, double clutter) {
  const PlanRect r = s.rect();
  const bool hall = s.room().type == RoomType::kAtrium;
  const int per = static_cast<int>(r.area() / (hall ? 34 : 45) * (0.4 + 0.6 * clutter));
  for (int i = 0; i < per; ++i) {
    if (const double u = s.rng().Uniform(); u < 0.35)
      s.Anywhere("bench_mall", 0.7f);
    else if (u < 0.65)
      s.Anywhere("potted_plant_indoor", 0.6f);
    else
      s.Anywhere("waste_bin_indoor", 0.5f);
  }
  if (hall) {
    for (int i = 0; i < 3; ++i) s.Anywhere("kiosk", 1.6f);
    for (int i = 0; i < 8; ++i) s.Anywhere(i % 2 ? "sofa_lounge" : "potted_plant_indoor", 1.0f);
  }
  for (int i = 0; i < 2; ++i) s.AtWall("vending_machine", 0.7f);
  for (int i = 0; i < 3; ++i) s.AtWall("potted_plant_indoor");
}

}  // namespace

void FurnishTrade(RoomSpace& s, double clutter) {
  switch (s.room().type) {
    case RoomType::kShop:
      Shop(s, clutter);
      break;
    case RoomType::kSupermarket:
      Groceries(s);
      break;
    case RoomType::kFoodCourt:
      Cafe(s);
      break;
    case RoomType::kConcourse:
    case RoomType::kGallery:
    case RoomType::kAtrium:
    case RoomType::kLobby:
      Concourse(s, clutter);
      break;
    default:
      FurnishWork(s, clutter);
  }
}

}  // namespace airsim360::internal

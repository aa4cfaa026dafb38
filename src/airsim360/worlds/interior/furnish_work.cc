// Offices and libraries.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/interior/furnisher.h"

namespace airsim360::internal {
namespace {

constexpr float kDeskTop = 0.73f;

// A desk whose user sits on its front side (-Y before turning by yaw); on it what is in use.
bool WorkPlace(RoomSpace& s, Vec2f p, float yaw, double clutter) {
  if (!s.At("desk_office", p, yaw)) return false;
  const Vec2f t{std::cos(yaw), std::sin(yaw)}, back{-t.y, t.x};
  const auto on = [&](const char* kind, float right, float rear, float turn) {
    s.Put(kind, p + t * right + back * rear, yaw + turn, kDeskTop);
  };
  s.Put("office_chair", p - back * (0.62f + Jitter(s, 0.12)), yaw + kPiF + Jitter(s, 0.7));
  const bool two = s.rng().Chance(0.4);
  on("monitor", two ? -0.28f : 0.0f, 0.18f, two ? 0.15f : Jitter(s, 0.1));
  if (two) on("monitor", 0.30f, 0.18f, -0.15f);
  on("keyboard", Jitter(s, 0.06), -0.13f, Jitter(s, 0.1));
  s.Put("computer", p + t * 0.62f + back * 0.1f, yaw);
  if (s.rng().Chance(0.5 * clutter)) on("book_row", -0.6f, 0.2f, Jitter(s, 0.3));
  if (s.rng().Chance(0.7 * clutter)) on("papers", 0.48f, -0.12f, Jitter(s, 0.5));
  if (s.rng().Chance(0.35 * clutter)) on("clutter", -0.5f, 0.05f, Jitter(s, 0.5));
  if (s.rng().Chance(0.5)) on("phone", 0.6f, 0.15f, Jitter(s, 0.3));
  if (s.rng().Chance(0.3 * clutter)) on("plant_small", -0.66f, -0.1f, 0);
  if (s.rng().Chance(0.25)) on("table_lamp", 0.66f, 0.2f, 0);
  if (s.rng().Chance(0.4)) s.Put("waste_bin_indoor", p - t * 0.6f - back * 0.1f, 0);
  return true;
}

// Benches of desks that face each other over a screen, in rows with ways between.
void Benches(RoomSpace& s, double clutter) {
  const Vec3f desk = s.Size("desk_office");
  const float pitch_x = desk.x + 0.02f, bench = 2 * desk.y + 0.04f, seat = 0.85f;
  const PlanRect r = s.rect().Inset(0.7f);
  const int per_bench = 3;
  const float group = static_cast<float>(per_bench) * pitch_x + 1.5f, row = bench + 2 * seat + 0.4f;
  for (float y = r.y0 + row / 2 - 0.3f; y + row / 2 - 0.5f < r.y1; y += row) {
    for (float x = r.x0; x + group - 1.5f < r.x1;) {
      const Vec2f middle{x + (group - 1.5f) / 2, y};
      if (!s.IsFree(middle, {(group - 1.5f) / 2, bench / 2 + seat})) {
        x += 0.4f;
        continue;
      }
      for (int i = 0; i < per_bench; ++i) {
        const float at = x + pitch_x * (static_cast<float>(i) + 0.5f);
        WorkPlace(s, {at, y - desk.y / 2 - 0.02f}, 0, clutter);
        WorkPlace(s, {at, y + desk.y / 2 + 0.02f}, kPiF, clutter);
        s.Put("partition", {at, y}, 0, 0, 0);
      }
      s.Reserve(middle, {(group - 1.5f) / 2, bench / 2 + seat});
      x += group - 0.3f;
    }
  }
}

void Filing(RoomSpace& s, int cabinets) {
  s.RowAtWall("filing_cabinet", cabinets, 0.01f, 0.6f);
  s.AtWall("bookshelf", 0.6f);
}

void OpenOffice(RoomSpace& s, double clutter) {
  Benches(s, clutter);
  Filing(s, 4);
  s.AtWall("printer", 0.6f);
  s.AtWall("coat_rack", 0.2f);
  for (int i = 0; i < 5; ++i) s.AtWall("potted_plant_indoor");
  s.AtWall("sofa_lounge", 0.6f);
  for (int i = 0; i < 2; ++i) s.OnWall("whiteboard", 0.9f);
  for (int i = 0; i < 3; ++i) s.OnWall("picture_frame", 1.4f);
  for (int i = 0; i < static_cast<int>(4 * clutter); ++i) s.AtWall("box_small");
}

void Cell(RoomSpace& s, double clutter) {
  const Vec2f c = s.rect().center();
  WorkPlace(s, {c.x + Jitter(s, 0.2), c.y + 0.55f}, s.rng().Chance(0.5) ? 0 : kPiF, clutter);
  s.RowAtWall("filing_cabinet", 2);
  s.AtWall("bookshelf", 0.5f);
  s.AtWall("coat_rack");
  s.AtWall("potted_plant_indoor");
  s.Anywhere("office_chair", 0.4f);
  s.OnWall("whiteboard", 0.9f);
  s.OnWall("picture_frame", 1.4f);
  if (clutter > 0.4) s.AtWall("box_small");
}

void Meeting(RoomSpace& s) {
  const Vec2f c = s.rect().center();
  const bool along_x = s.rect().width() > s.rect().depth();
  const float yaw = along_x ? 0 : kPiF / 2;
  if (s.At("meeting_table", c, yaw)) {
    const Vec3f table = s.Size("meeting_table");
    const Vec2f t{std::cos(yaw), std::sin(yaw)}, n{-t.y, t.x};
    const int seats = std::max(2, static_cast<int>(table.x / 0.75f));
    for (int i = 0; i < seats; ++i) {
      const float along = table.x * ((static_cast<float>(i) + 0.5f) / static_cast<float>(seats) - 0.5f);
      for (const float side : {-1.0f, 1.0f})
        s.Put("office_chair", c + t * along + n * (side * (table.y / 2 + 0.3f + static_cast<float>(s.rng().Uniform(0, 0.25)))),
              yaw + (side > 0 ? 0 : kPiF) + Jitter(s, 0.4));
    }
    s.Put("book_row", c + t * 0.3f, yaw + Jitter(s, 1), s.Top("meeting_table"));
    s.Put("laptop", c - t * 0.5f + n * 0.3f, yaw + kPiF, s.Top("meeting_table"));
    s.Put("papers", c + t * 0.8f - n * 0.3f, yaw, s.Top("meeting_table"));
    s.Put("dishes", c - t * 0.1f, yaw, s.Top("meeting_table"), 0);
  }
  s.OnWall("television", 1.15f);
  s.OnWall("whiteboard", 0.9f);
  s.AtWall("potted_plant_indoor");
  s.AtWall("dresser", 0.4f);
  s.OnWall("picture_frame", 1.4f);
}

void Pantry(RoomSpace& s) {
  const int units = s.RowAtWall("kitchen_counter", 3, 0, 0.9f);
  if (units == 0) s.AtWall("kitchen_counter", 0.5f);
  s.AtWall("kitchen_sink_counter", 0.7f);
  s.AtWall("fridge", 0.7f);
  s.AtWall("water_dispenser", 0.5f);
  s.AtWall("vending_machine", 0.6f);
  const Vec2f c = s.rect().center();
  for (const float side : {-1.0f, 1.0f}) {
    const Vec2f p = c + Vec2f{side * s.rect().width() / 5, 0};
    if (!s.At("dining_table_home", p, kPiF / 2)) continue;
    for (const float y : {-1.0f, 1.0f})
      s.Put("dining_chair_home", p + Vec2f{y * (s.Size("dining_table_home").y / 2 + 0.15f), 0}, y > 0 ? -kPiF / 2 : kPiF / 2);
  }
  s.AtWall("waste_bin_indoor");
  s.OnWall("picture_frame", 1.4f);
}

void PrintRoom(RoomSpace& s, double clutter) {
  for (int i = 0; i < 3; ++i) s.AtWall("printer", 0.6f);
  s.RowAtWall("filing_cabinet", 3);
  s.AtWall("bookshelf", 0.4f);
  s.AtWall("waste_bin_indoor");
  for (int i = 0; i < static_cast<int>(6 * clutter); ++i) s.AtWall(s.rng().Chance(0.5) ? "box_small" : "box_large");
}

void Stacks(RoomSpace& s) {
  // Double rows of shelves with ways of 1.2 m.
  const Vec3f shelf = s.Size("bookshelf");
  const PlanRect r = s.rect().Inset(1.3f);
  for (float x = r.x0 + shelf.y; x + shelf.y < r.x1; x += 2 * shelf.y + 1.25f) {
    for (float y = r.y0 + shelf.x / 2; y + shelf.x / 2 < r.y1; y += shelf.x + 0.01f) {
      s.At("bookshelf", {x - shelf.y / 2 - 0.01f, y}, -kPiF / 2);
      s.At("bookshelf", {x + shelf.y / 2 + 0.01f, y}, kPiF / 2);
    }
  }
  s.RowAtWall("bookshelf", 4);
}

void Reading(RoomSpace& s, double clutter) {
  const Vec3f table = s.Size("meeting_table");
  const PlanRect r = s.rect().Inset(1.6f);
  for (float y = r.y0 + table.y / 2; y + table.y / 2 < r.y1; y += table.y + 2.2f) {
    for (float x = r.x0 + table.x / 2; x + table.x / 2 < r.x1; x += table.x + 1.4f) {
      if (!s.At("meeting_table", {x, y}, 0)) continue;
      for (int i = 0; i < 3; ++i)
        for (const float side : {-1.0f, 1.0f})
          s.Put("dining_chair_home",
                {x + table.x * (static_cast<float>(i) - 1) / 3,
                 y + side * (table.y / 2 + 0.2f + static_cast<float>(s.rng().Uniform(0, 0.2)))},
                side > 0 ? 0 : kPiF);
      s.Put("table_lamp", {x, y}, 0, s.Top("meeting_table"));
      if (s.rng().Chance(0.7 * clutter)) s.Put("book_row", {x + 0.5f, y + 0.2f}, Jitter(s, 1.5), s.Top("meeting_table"));
      if (s.rng().Chance(0.3)) s.Put("laptop", {x - 0.5f, y - 0.25f}, 0, s.Top("meeting_table"));
    }
  }
  for (int i = 0; i < 3; ++i) s.RowAtWall("bookshelf", 4);
  for (int i = 0; i < 3; ++i) s.AtWall("armchair", 0.5f);
  for (int i = 0; i < 3; ++i) s.AtWall("potted_plant_indoor");
  s.OnWall("picture_frame", 1.5f);
}

void Washroom(RoomSpace& s) {
  const int basins = s.RowAtWall("washbasin", 3, 0.3f, 0.7f);
  for (int i = 0; i < basins; ++i) s.OnWall("mirror_wall", 1.1f);
  const int cells = s.RowAtWall("toilet", 3, 0.55f, 0.7f);
  if (cells == 0) s.AtWall("toilet", 0.5f);
  s.AtWall("waste_bin_indoor");
}

}  // namespace

void FurnishWork(RoomSpace& s, double clutter) {
  switch (s.room().type) {
    case RoomType::kOpenOffice:
      OpenOffice(s, clutter);
      break;
    case RoomType::kCellOffice:
      Cell(s, clutter);
      break;
    case RoomType::kDispatchOffice:
      Cell(s, clutter);
      WorkPlace(s, s.rect().center() + Vec2f{0, -1.6f}, kPiF, clutter);
      break;
    case RoomType::kMeetingRoom:
      Meeting(s);
      break;
    case RoomType::kPantry:
    case RoomType::kBreakRoom:
      Pantry(s);
      break;
    case RoomType::kPrintRoom:
    case RoomType::kStorage:
      PrintRoom(s, clutter);
      break;
    case RoomType::kBookStacks:
      Stacks(s);
      break;
    case RoomType::kReadingRoom:
      Reading(s, clutter);
      break;
    case RoomType::kToilet:
      Washroom(s);
      break;
    case RoomType::kLobby:
      s.AtWall("sofa_lounge", 0.6f);
      for (int i = 0; i < 3; ++i) s.AtWall("potted_plant_indoor");
      s.AtWall("shop_counter", 0.8f);
      s.OnWall("picture_frame", 1.4f);
      s.AtWall("waste_bin_indoor");
      break;
    case RoomType::kCorridor:
    case RoomType::kGallery:
      for (int i = 0; i < static_cast<int>(s.rect().width() * s.rect().depth() / 22); ++i) s.AtWall("potted_plant_indoor");
      for (int i = 0; i < 4; ++i) s.OnWall("picture_frame", 1.4f);
      s.AtWall("water_dispenser", 0.4f);
      if (s.rect().depth() > 2.5f && s.rect().width() > 2.5f)
        for (int i = 0; i < 4; ++i) s.AtWall("armchair", 0.4f);
      break;
    case RoomType::kAtrium:
      for (int i = 0; i < 4; ++i) s.Anywhere("potted_plant_indoor", 0.8f);
      for (int i = 0; i < 4; ++i) s.Anywhere("sofa_lounge", 1.2f);
      break;
    default:
      break;
  }
}

}  // namespace airsim360::internal

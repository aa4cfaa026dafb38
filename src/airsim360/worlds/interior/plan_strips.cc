#include "airsim360/worlds/interior/plan_strips.h"

#include <algorithm>

namespace airsim360::internal {

std::vector<int> FillStrip(PlanPen& pen, int storey, PlanRect rect, std::span<const StripRoom> rooms, bool mirrored, float jitter) {
  std::vector<float> shares;
  float sum = 0;
  for (const StripRoom& room : rooms) {
    shares.push_back(room.share * static_cast<float>(pen.rng().Uniform(1 - static_cast<double>(jitter), 1 + static_cast<double>(jitter))));
    sum += shares.back();
  }
  std::vector<int> numbers;
  float x = rect.x0;
  for (size_t i = 0; i < rooms.size(); ++i) {
    const float to = i + 1 == rooms.size() ? rect.x1 : x + rect.width() * shares[i] / sum;
    PlanRect cell{x, rect.y0, to, rect.y1};
    if (mirrored) cell = {rect.x0 + rect.x1 - to, rect.y0, rect.x0 + rect.x1 - x, rect.y1};
    numbers.push_back(pen.Room(rooms[i].type, storey, cell, rooms[i].ceiling, rooms[i].name));
    x = to;
  }
  return numbers;
}

void MakeStairwell(PlanPen& pen, int index) {
  PlanRoom& room = pen.room(index);
  const int storeys = static_cast<int>(pen.plan().spec.storeys);
  room.has_floor = room.storey == 0;
  if (room.storey + 1 >= storeys) return;
  room.has_ceiling = false;
  pen.plan().stairs.push_back({index, pen.height()});
}

void MakeAtrium(PlanPen& pen, int index) {
  PlanRoom& room = pen.room(index);
  const int top = static_cast<int>(pen.plan().spec.storeys) - 1;
  room.has_floor = room.storey == 0;
  room.has_ceiling = room.storey == top;
  if (room.storey == 0) room.ceiling_z = pen.plan().StoreyZ(top) + pen.height() - kSlab;
  if (room.storey == top && room.cell.width() > 3 && room.cell.depth() > 3) room.skylights.push_back(room.cell.Inset(1.0f));
}

}  // namespace airsim360::internal

// Rows of rooms side by side.
#pragma once

#include <span>
#include <vector>

#include "airsim360/worlds/interior/plan_pen.h"

namespace airsim360::internal {

/// A room of a row: its share of the length. Neighbours keep their order.
struct StripRoom {
  RoomType type;
  float share;
  float ceiling = 0;
  const char* name = nullptr;
};

/// Fills `rect` with rooms from west to east (east to west where `mirrored`) by their shares, which vary by up to `jitter`
/// with the seed. Their numbers, in the order of `rooms`.
std::vector<int> FillStrip(PlanPen& pen, int storey, PlanRect rect, std::span<const StripRoom> rooms, bool mirrored, float jitter = 0.06f);

/// A shaft of stairs: open from storey to storey, with flights between.
void MakeStairwell(PlanPen& pen, int room);
/// Open from the lowest storey to the roof, where it is glazed.
void MakeAtrium(PlanPen& pen, int room);

}  // namespace airsim360::internal

#include "airsim360/worlds/kit/street_plan.h"

#include <cmath>

namespace airsim360 {

GroundRect StreetPlan::reach() const {
  const float margin = blocks.front().pavement;
  const auto low = [&](const StreetLine& line) { return line.center - line.half_width - margin; };
  const auto high = [&](const StreetLine& line) { return line.center + line.half_width + margin; };
  const auto first = static_cast<size_t>(first_core), last = static_cast<size_t>(last_core);
  return {low(north_south[first]), low(east_west[first]), high(north_south[last]), high(east_west[last])};
}

StreetPlan PlanDowntownWest() {
  StreetPlan plan;
  plan.bike_lane_row = 2;
  plan.north_south = {{-277, 6}, {-165, 6}, {-57, 5.6f}, {53, 7}, {165, 6}, {277, 6}};
  plan.east_west = {{-273, 6}, {-161, 6}, {-53, 7}, {57, 5.6f}, {165, 6}, {277, 6}};
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      const StreetLine &west = plan.north_south[column], &east = plan.north_south[column + 1];
      const StreetLine &south = plan.east_west[row], &north = plan.east_west[row + 1];
      Block block;
      block.column = column;
      block.row = row;
      block.kerb = {west.center + west.half_width, south.center + south.half_width, east.center - east.half_width,
                    north.center - north.half_width};
      const bool core = column >= 1 && column <= 3 && row >= 1 && row <= 3;
      if (!core) block.kind = BlockKind::kBackdrop;
      if (column == 2 && row == 2) block.kind = BlockKind::kPlaza;
      if (column == 3 && row == 2) block.kind = BlockKind::kPark;
      plan.blocks.push_back(block);
    }
  }
  return plan;
}

StreetPlan PlanNewYorkCity() {
  StreetPlan plan;
  for (int i = -2; i <= 3; ++i) {
    const float at = static_cast<float>(i);
    plan.north_south.push_back({132 * at, 13, i == 0 ? StreetKind::kBoulevard : StreetKind::kAvenue});
    plan.east_west.push_back({84 * at, 6.5f});
  }
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      const auto c = static_cast<size_t>(column), r = static_cast<size_t>(row);
      Block block;
      block.column = column;
      block.row = row;
      block.kerb = {plan.north_south[c].center + 13, plan.east_west[r].center + 6.5f, plan.north_south[c + 1].center - 13,
                    plan.east_west[r + 1].center - 6.5f};
      const bool core = column >= 1 && column <= 3 && row >= 1 && row <= 3;
      if (!core) block.kind = BlockKind::kBackdrop;
      if (column == 3 && row == 2) block.kind = BlockKind::kPark;
      plan.blocks.push_back(block);
    }
  }
  return plan;
}

float CarriagewayHeight(const StreetLine& line, float d) { return -0.13f + 0.018f * (line.half_width - std::abs(d)); }

}  // namespace airsim360

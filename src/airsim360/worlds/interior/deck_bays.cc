#include "airsim360/worlds/interior/deck_bays.h"

namespace airsim360::internal {

std::vector<DeckBay> DeckBays(const InteriorPlan& plan, int storey) {
  std::vector<DeckBay> bays;
  const float d = plan.outline.y1, middle = d / 2;
  for (const PlanRoom& room : plan.rooms) {
    if (room.type != RoomType::kParkingDeck || room.storey != storey || room.cell.width() < 20) continue;
    // Three bays between columns; columns stand in the lines.
    const float x0 = room.cell.x0 + 0.3f, x1 = room.cell.x1 - 0.3f;
    const int spans = static_cast<int>((x1 - x0) / 7.5f);
    const float span = (x1 - x0) / static_cast<float>(spans), width = (span - plan.column - 0.1f) / 3;
    for (int i = 0; i < spans; ++i) {
      for (int k = 0; k < 3; ++k) {
        const float x = x0 + span * static_cast<float>(i) + plan.column / 2 + 0.05f + width * static_cast<float>(k);
        const auto add = [&](float y0, bool north) { bays.push_back({{x, y0, x + width, y0 + kBayDepth}, north}); };
        add(0.1f, false);
        add(middle - kBayDepth, true);
        add(middle, false);
        add(d - kBayDepth - 0.1f, true);
      }
    }
  }
  return bays;
}

std::vector<PlanRect> DeckAisles(const InteriorPlan& plan) {
  const PlanRect& r = plan.outline;
  const float middle = r.center().y;
  return {{r.x0 + 5, kBayDepth + 0.1f, r.x1 - 5, middle - kBayDepth}, {r.x0 + 5, middle + kBayDepth, r.x1 - 5, r.y1 - kBayDepth - 0.1f}};
}

}  // namespace airsim360::internal

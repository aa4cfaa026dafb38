// Floors, ceilings, the roof with its skylights.
#include <algorithm>
#include <vector>

#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

// `rect` without `holes`: rectangles between their edges.
std::vector<PlanRect> Without(const PlanRect& rect, const std::vector<PlanRect>& holes) {
  std::vector<float> xs{rect.x0, rect.x1}, ys{rect.y0, rect.y1};
  for (const PlanRect& h : holes) {
    for (float x : {h.x0, h.x1}) xs.push_back(std::clamp(x, rect.x0, rect.x1));
    for (float y : {h.y0, h.y1}) ys.push_back(std::clamp(y, rect.y0, rect.y1));
  }
  std::sort(xs.begin(), xs.end());
  std::sort(ys.begin(), ys.end());
  std::vector<PlanRect> pieces;
  for (size_t j = 0; j + 1 < ys.size(); ++j) {
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
      const PlanRect piece{xs[i], ys[j], xs[i + 1], ys[j + 1]};
      if (piece.width() < 1e-4f || piece.depth() < 1e-4f) continue;
      if (std::none_of(holes.begin(), holes.end(), [&](const PlanRect& h) { return h.Contains(piece.center()); })) pieces.push_back(piece);
    }
  }
  return pieces;
}

void LayFloor(const InteriorPlan& plan, int index, InteriorPen& pen) {
  const PlanRoom& room = plan.rooms[static_cast<size_t>(index)];
  const bool parking = room.type == RoomType::kParkingDeck || room.type == RoomType::kRamp;
  pen.Start("floor " + room.name, parking ? "ground/parking" : "ground/floor");
  pen.Use(FinishOf(plan, index).floor);
  pen.Level(room.cell, room.floor_z, true);
}

// A box of frames around the glass, on top of the roof.
void BuildSkylight(const PlanRect& hole, float ceiling_z, float roof_z, InteriorPen& pen) {
  const float z = roof_z + 0.25f;
  pen.Start("skylight", "construction/window");
  pen.Use(Finish::kFrameWhite);
  for (const bool high : {false, true}) {
    pen.Upright(true, high ? hole.y1 : hole.y0, hole.x0, hole.x1, ceiling_z, z, !high);
    pen.Upright(false, high ? hole.x1 : hole.x0, hole.y0, hole.y1, ceiling_z, z, !high);
    pen.Upright(true, high ? hole.y1 : hole.y0, hole.x0, hole.x1, roof_z, z, high);
    pen.Upright(false, high ? hole.x1 : hole.x0, hole.y0, hole.y1, roof_z, z, high);
  }
  const float pitch = 1.5f;
  for (const bool along_x : {true, false}) {
    const float from = along_x ? hole.y0 : hole.x0, to = along_x ? hole.y1 : hole.x1;
    const int bars = std::max(1, static_cast<int>((to - from) / pitch));
    for (int i = 0; i <= bars; ++i) {
      const float at = from + (to - from) * static_cast<float>(i) / static_cast<float>(bars);
      pen.WallBox(along_x, along_x ? hole.x0 : hole.y0, along_x ? hole.x1 : hole.y1, at - 0.03f, at + 0.03f, z - (along_x ? 0.1f : 0.09f),
                  z);
    }
  }
  pen.Use(Finish::kGlass);
  pen.Level(hole, z + 0.005f, true);
}

void BuildRoof(const InteriorPlan& plan, InteriorPen& pen) {
  const int top = static_cast<int>(plan.spec.storeys) - 1;
  const float z = plan.StoreyZ(top + 1), out = kOuterWall - kHalfWall;
  std::vector<PlanRect> holes;
  for (const PlanRoom& room : plan.rooms)
    if (room.storey == top) holes.insert(holes.end(), room.skylights.begin(), room.skylights.end());
  pen.Start("roof", "construction/building/roof");
  pen.Use(Finish::kFacadePanel);
  for (const PlanRect& piece : Without(plan.outline.Inset(-out), holes)) pen.Level(piece, z + 0.02f, true);
  for (const PlanRoom& room : plan.rooms)
    if (room.storey == top)
      for (const PlanRect& hole : room.skylights) BuildSkylight(hole, z - kSlab, z + 0.02f, pen);
}

}  // namespace

void BuildShell(const InteriorPlan& plan, InteriorPen& pen) {
  for (int i = 0; i < static_cast<int>(plan.rooms.size()); ++i) {
    const PlanRoom& room = plan.rooms[static_cast<size_t>(i)];
    if (room.has_floor) LayFloor(plan, i, pen);
    if (!room.has_ceiling) continue;
    // The ceiling of a hall through several storeys is that of the highest one.
    const bool top_of_hall = !room.has_floor;
    const float z = top_of_hall ? plan.StoreyZ(room.storey + 1) - kSlab : room.ceiling_z;
    pen.Start("ceiling " + room.name, "construction/ceiling");
    pen.Use(FinishOf(plan, i).ceiling);
    for (const PlanRect& piece : Without(room.cell, room.skylights)) pen.Level(piece, z, false);
  }
  BuildRoof(plan, pen);
  BuildWalls(plan, pen);
}

}  // namespace airsim360::internal

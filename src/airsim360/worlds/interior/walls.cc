// Walls: of boards or stone around their openings, of glass, balustrades, parapets, and what hangs down where there is none.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

// A stretch of a wall without, below or above an opening, in coordinates along it.
struct Piece {
  float from, to, z0, z1;
  bool foot;  ///< stands on the floor
};

std::vector<Piece> PiecesOf(const PlanWall& wall, float from, float to, float z0, float z1) {
  std::vector<Piece> pieces;
  float at = from;
  for (const PlanOpening& o : wall.openings) {
    const float a = wall.from + o.from, b = wall.from + o.to;
    if (a > at) pieces.push_back({at, a, z0, z1, true});
    if (o.sill > 0.001f) pieces.push_back({a, b, z0, z0 + o.sill, true});
    if (z0 + o.head < z1) pieces.push_back({a, b, z0 + o.head, z1, false});
    at = b;
  }
  if (to > at) pieces.push_back({at, to, z0, z1, true});
  return pieces;
}

class WallBuilder {
 public:
  WallBuilder(const InteriorPlan& plan, InteriorPen& pen) : plan_(plan), pen_(pen) {}

  void Build(const PlanWall& wall) {
    switch (wall.kind) {
      case WallKind::kPartition:
      case WallKind::kExterior:
        Solid(wall);
        break;
      case WallKind::kGlassPartition:
        Glass(wall);
        break;
      case WallKind::kOpen:
        Bulkhead(wall);
        break;
      case WallKind::kBalustrade:
        Bulkhead(wall);
        Balustrade(wall);
        break;
      case WallKind::kUpstand:
        Upstand(wall);
        break;
      case WallKind::kParapet:
        Parapet(wall);
        break;
    }
    if (wall.kind == WallKind::kBalustrade) return;
    for (const PlanOpening& opening : wall.openings) {
      if (IsDoor(opening.kind)) BuildDoor(plan_, wall, opening, pen_);
      if (opening.kind == OpeningKind::kWindow || opening.kind == OpeningKind::kGlazing) BuildWindow(plan_, wall, opening, pen_);
    }
  }

 private:
  float Low(const PlanWall& wall) const { return plan_.StoreyZ(wall.storey); }
  float High(const PlanWall& wall) const { return plan_.StoreyZ(wall.storey + 1); }
  std::string Name(const PlanWall& wall) const {
    const auto side = [&](int room) { return room < 0 ? std::string("outside") : plan_.rooms[static_cast<size_t>(room)].name; };
    return "wall " + side(wall.low < 0 ? wall.high : wall.low) + " - " + side(wall.low < 0 ? wall.low : wall.high);
  }
  // How far an end reaches past the joint, so that corners are closed: nothing where the wall goes on.
  float Reach(const PlanWall& wall, bool end) const {
    const float at = end ? wall.to : wall.from;
    for (const PlanWall& other : plan_.walls) {
      if (&other == &wall || other.storey != wall.storey || other.along_x != wall.along_x || std::abs(other.at - wall.at) > 1e-3f) continue;
      if (std::abs((end ? other.from : other.to) - at) < 1e-3f && other.kind != WallKind::kOpen && other.kind != WallKind::kBalustrade &&
          other.kind != WallKind::kUpstand)
        return 0;
    }
    if (wall.low >= 0 && wall.high >= 0) return kHalfWall - 0.001f;
    return kOuterWall - kHalfWall - 0.001f;
  }
  Finish FaceOf(int room) const { return room < 0 ? FacadeOf(plan_) : FinishOf(plan_, room).wall; }

  void Solid(const PlanWall& wall) {
    const float near = wall.at - (wall.low < 0 ? kOuterWall - kHalfWall : kHalfWall),
                far = wall.at + (wall.high < 0 ? kOuterWall - kHalfWall : kHalfWall);
    const float from = wall.from - Reach(wall, false), to = wall.to + Reach(wall, true);
    pen_.Start(Name(wall), "construction/wall");
    // Where an outer wall stands on the ground, its foot goes down to it.
    const bool foot = wall.storey == 0 && (wall.low < 0 || wall.high < 0);
    const float high =
        High(wall) + (wall.storey + 1 == static_cast<int>(plan_.spec.storeys) && (wall.low < 0 || wall.high < 0) ? 0.4f : 0.0f);
    const std::vector<Piece> pieces = PiecesOf(wall, from, to, Low(wall), high);
    for (const bool high_side : {false, true}) {
      const int room = high_side ? wall.high : wall.low;
      pen_.Use(FaceOf(room));
      for (const Piece& p : pieces)
        pen_.Upright(wall.along_x, high_side ? far : near, p.from, p.to, foot && p.foot && room < 0 && p.z0 < 0.01f ? -0.2f : p.z0, p.z1,
                     high_side);
    }
    // Reveals of openings, ends and tops.
    pen_.Use(Finish::kPlasterWhite);
    for (const PlanOpening& o : wall.openings) {
      const float a = wall.from + o.from, b = wall.from + o.to, z0 = Low(wall) + o.sill, z1 = Low(wall) + o.head;
      pen_.Upright(!wall.along_x, a, near, far, z0, z1, true);
      pen_.Upright(!wall.along_x, b, near, far, z0, z1, false);
      const PlanRect across = wall.along_x ? PlanRect{a, near, b, far} : PlanRect{near, a, far, b};
      pen_.Level(across, z1, false);
      pen_.Level(across, z0, true);
    }
    for (const bool end : {false, true}) pen_.Upright(!wall.along_x, end ? to : from, near, far, Low(wall), high, end);
    const PlanRect top = wall.along_x ? PlanRect{from, near, to, far} : PlanRect{near, from, far, to};
    pen_.Level(top, high, true);
    Skirting(wall, near, far, from, to);
  }

  void Skirting(const PlanWall& wall, float near, float far, float from, float to) {
    for (const bool high_side : {false, true}) {
      const int room = high_side ? wall.high : wall.low;
      if (room < 0 || !FinishOf(plan_, room).skirting || !plan_.rooms[static_cast<size_t>(room)].has_floor) continue;
      pen_.Use(Finish::kSkirting);
      const float face = high_side ? far : near, out = high_side ? 0.014f : -0.014f;
      for (const Piece& p :
           PiecesOf(wall, std::max(from, wall.from + kHalfWall), std::min(to, wall.to - kHalfWall), Low(wall), Low(wall) + 1))
        if (p.foot && p.to - p.from > 0.03f) pen_.WallBox(wall.along_x, p.from, p.to, face, face + out, p.z0, p.z0 + 0.08f);
    }
  }

  // Panes of glass from floor to head between posts, a band above.
  void Glass(const PlanWall& wall) {
    const float z0 = Low(wall), head = 2.4f, n = wall.at - 0.03f, f = wall.at + 0.03f;
    const float from = wall.from, to = wall.to;
    pen_.Start(Name(wall), "construction/wall");
    for (const bool high_side : {false, true}) {
      pen_.Use(FaceOf(high_side ? wall.high : wall.low));
      pen_.Upright(wall.along_x, wall.at + (high_side ? kHalfWall : -kHalfWall), from, to, z0 + head, High(wall), high_side);
    }
    pen_.Use(Finish::kPlasterWhite);
    pen_.Level(wall.along_x ? PlanRect{from, wall.at - kHalfWall, to, wall.at + kHalfWall}
                            : PlanRect{wall.at - kHalfWall, from, wall.at + kHalfWall, to},
               z0 + head, false);
    float at = from;
    const auto panes = [&](float a, float b) {
      if (b - a < 0.12f) return pen_.WallBox(wall.along_x, a, b, n, f, z0, z0 + head);
      const int count = std::max(1, static_cast<int>(std::ceil((b - a) / 1.3f)));
      for (int i = 0; i <= count; ++i) {
        const float s = a + (b - a - 0.04f) * static_cast<float>(i) / static_cast<float>(count);
        pen_.WallBox(wall.along_x, s, s + 0.04f, n, f, z0, z0 + head);
      }
      pen_.WallBox(wall.along_x, a, b, n, f, z0, z0 + 0.06f);
      pen_.WallBox(wall.along_x, a, b, n, f, z0 + head - 0.05f, z0 + head);
      pen_.Use(Finish::kGlassTinted);
      pen_.Pane(wall.along_x, wall.at, a + 0.04f, b - 0.04f, z0 + 0.06f, z0 + head - 0.05f);
      pen_.Use(Finish::kFrameDark);
    };
    pen_.Use(Finish::kFrameDark);
    for (const PlanOpening& o : wall.openings) {
      panes(at, wall.from + o.from);
      pen_.WallBox(wall.along_x, wall.from + o.from, wall.from + o.to, n, f, z0 + o.head, z0 + head);
      at = wall.from + o.to;
    }
    panes(at, to);
  }

  // What is between the lower of two ceilings and the floor above.
  void Bulkhead(const PlanWall& wall) {
    if (wall.low < 0 || wall.high < 0) return;
    const auto ceiling = [&](int index) {
      const PlanRoom& room = plan_.rooms[static_cast<size_t>(index)];
      return room.has_ceiling && room.has_floor ? room.ceiling_z : High(wall) - kSlab;
    };
    const float z = std::min(ceiling(wall.low), ceiling(wall.high));
    const bool mouth = !plan_.rooms[static_cast<size_t>(wall.low)].has_ceiling || !plan_.rooms[static_cast<size_t>(wall.high)].has_ceiling;
    if (!mouth && std::abs(ceiling(wall.low) - ceiling(wall.high)) < 0.01f) return;
    pen_.Start("edge " + Name(wall).substr(5), "construction/ceiling");
    pen_.Use(FinishOf(plan_, wall.low).ceiling == Finish::kCeilingConcrete ? Finish::kCeilingConcrete : Finish::kPlasterWhite);
    pen_.WallBox(wall.along_x, wall.from, wall.to, wall.at - kHalfWall, wall.at + kHalfWall, z, High(wall));
  }

  void Balustrade(const PlanWall& wall) {
    const float z = Low(wall), high = z + 1.1f;
    pen_.Start("balustrade " + Name(wall).substr(5), "barrier/railing/rail");
    const auto run = [&](float a, float b) {
      if (b - a < 0.1f) return;
      pen_.Use(Finish::kFrameSteel);
      pen_.WallBox(wall.along_x, a, b, wall.at - 0.03f, wall.at + 0.03f, high - 0.05f, high);
      pen_.WallBox(wall.along_x, a, b, wall.at - 0.04f, wall.at + 0.04f, z, z + 0.08f);
      const int posts = std::max(1, static_cast<int>((b - a) / 1.5f));
      for (int i = 0; i <= posts; ++i) {
        const float s = a + (b - a - 0.04f) * static_cast<float>(i) / static_cast<float>(posts);
        pen_.WallBox(wall.along_x, s, s + 0.04f, wall.at - 0.02f, wall.at + 0.02f, z + 0.08f, high - 0.05f);
      }
      pen_.Use(Finish::kGlassTinted);
      pen_.Pane(wall.along_x, wall.at, a, b, z + 0.08f, high - 0.05f);
    };
    float at = wall.from;
    for (const PlanOpening& o : wall.openings) {
      run(at, wall.from + o.from);
      at = wall.from + o.to;
    }
    run(at, wall.to);
  }

  void Upstand(const PlanWall& wall) {
    pen_.Start("upstand " + Name(wall).substr(5), "barrier/wall");
    pen_.Use(Finish::kConcreteWall);
    pen_.WallBox(wall.along_x, wall.from, wall.to, wall.at - 0.1f, wall.at + 0.1f, Low(wall) - kSlab, Low(wall) + 1.05f);
    pen_.Use(Finish::kPaintYellow);
    pen_.WallBox(wall.along_x, wall.from, wall.to, wall.at - 0.102f, wall.at + 0.102f, Low(wall) + 0.45f, Low(wall) + 0.6f);
  }

  // A deck's edge: parapet below, beam above, air between.
  void Parapet(const PlanWall& wall) {
    const float out = wall.low < 0 ? -1.0f : 1.0f, near = wall.at - out * kHalfWall, far = wall.at + out * (kOuterWall - kHalfWall);
    const float from = wall.from - Reach(wall, false), to = wall.to + Reach(wall, true), z = Low(wall);
    pen_.Start(Name(wall), "construction/wall");
    pen_.Use(Finish::kConcreteWall);
    float at = from;
    const auto low = [&](float a, float b) {
      if (b > a) pen_.WallBox(wall.along_x, a, b, near, far, z - (wall.storey == 0 ? 0.2f : kSlab), z + 1.1f);
    };
    for (const PlanOpening& o : wall.openings) {
      low(at, wall.from + o.from);
      at = wall.from + o.to;
    }
    low(at, to);
    pen_.WallBox(wall.along_x, from, to, near, far, High(wall) - kSlab - 0.35f,
                 High(wall) + (wall.storey + 1 == static_cast<int>(plan_.spec.storeys) ? 0.4f : 0.0f));
    pen_.Use(Finish::kFrameSteel);
    for (const float rail : {1.25f, 1.4f}) {
      at = from;
      for (const PlanOpening& o : wall.openings) {
        if (wall.from + o.from > at)
          pen_.WallBox(wall.along_x, at, wall.from + o.from, wall.at - 0.02f, wall.at + 0.02f, z + rail, z + rail + 0.04f);
        at = wall.from + o.to;
      }
      pen_.WallBox(wall.along_x, at, to, wall.at - 0.02f, wall.at + 0.02f, z + rail, z + rail + 0.04f);
    }
  }

  const InteriorPlan& plan_;
  InteriorPen& pen_;
};

}  // namespace

void BuildWalls(const InteriorPlan& plan, InteriorPen& pen) {
  WallBuilder builder(plan, pen);
  for (const PlanWall& wall : plan.walls) builder.Build(wall);
}

}  // namespace airsim360::internal

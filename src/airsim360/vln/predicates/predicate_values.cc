#include "airsim360/vln/predicates/predicate_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr double kStoreyHeight = 3.2;   // metres, where a building does not say
constexpr double kTallestStorey = 4.2;  // metres
constexpr double kStands = 1;           // metres between a thing's foot and the roof that it stands on
constexpr double kRoofHeight = 3;       // metres above the foot of what it stands on
constexpr int kDirections = 36;
constexpr double kWide = 8;  // metres: what is narrower fills its box across

/// Centre of a sector and half its width.
std::pair<double, double> SectorOf(const std::string& name) {
  std::vector<std::string> names = {"above", "below", "on_floor"};
  for (const Sector& sector : kSectors) {
    if (name == sector.name) return {sector.azimuth, sector.half_width};
    names.emplace_back(sector.name);
  }
  throw InputError(UnknownChoiceMessage("sector", name, names));
}

double Elevation(const Viewpoint& view, Vec3d p) {
  const Vec3d d = p - view.p_W;
  return std::atan2(d.z, std::hypot(d.x, d.y)) / kDegree;
}

// Half the angle that a box covers seen from above, degrees.
double HalfWidth(const Viewpoint& view, const Thing& thing) {
  const double middle = AzimuthOf(view, thing.center());
  double widest = 0;
  for (const double x : {thing.box.min.x, thing.box.max.x})
    for (const double y : {thing.box.min.y, thing.box.max.y})
      widest = std::max(widest, std::abs(std::remainder(AzimuthOf(view, {x, y, 0}) - middle, 360)));
  return widest;
}

ValueOf Bearing(const Predicate& predicate, const Viewpoint& view) {
  if (predicate.sector == "above" || predicate.sector == "below") {
    const double sign = predicate.sector == "above" ? 1 : -1;
    return {"deg", 2, [=](const Thing& thing) { return sign * Elevation(view, thing.center()) - kAboveElevation; }};
  }
  if (predicate.sector == "on_floor")
    return {"m", 0.1, [=](const Thing& thing) { return OnFloorBy(view.p_W.z, thing.box.min.z, thing.box.max.z); }};
  const auto [middle, half] = SectorOf(predicate.sector);
  return {"deg", 4, [=, middle = middle, half = half](const Thing& thing) {
            // A wide thing has to lie deeper in its sector: its middle is less sure.
            const double off = std::abs(std::remainder(AzimuthOf(view, thing.center()) - middle, 360));
            const double blur = std::min(12.0, HalfWidth(view, thing) / 4);
            return off < half ? half - off - std::min(blur, half - off) : half - off + std::min(blur, off - half);
          }};
}

ValueOf HeightQuantile(SceneGraph& graph, const Noun& noun, const Predicate& predicate) {
  const bool width = predicate.sector == "width";
  const auto extent = [width](const Thing& thing) { return width ? std::max(thing.size().x, thing.size().y) : thing.size().z; };
  std::vector<double> heights;
  for (const Thing& thing : graph.Find(noun)) heights.push_back(extent(thing));
  std::ranges::sort(heights);
  const auto place = static_cast<size_t>(predicate.share * static_cast<double>(heights.size()));
  const double limit = heights.empty() ? 0 : heights[std::min(place, heights.size() - 1)];
  // Where many are alike, what is as high as the limit is among them: half a step below it is the line.
  const auto below = std::ranges::lower_bound(heights, limit - 1e-3);
  const double line = below == heights.begin() ? limit - 1 : 0.5 * (limit + *std::prev(below));
  return {"m", 0.05, [=](const Thing& thing) { return extent(thing) - line; }};
}

// Signed metres of a point to the left of a box's long axis, which runs towards `yaw`; and half the box's width.
Vec2d FromAxis(const Viewpoint& view, const Thing& thing) {
  const bool along_x = thing.size().x >= thing.size().y;
  const Vec3d d = view.p_W - thing.center();
  const double towards = along_x ? (std::cos(view.yaw) >= 0 ? 1 : -1) : (std::sin(view.yaw) >= 0 ? 1 : -1);
  const double left = along_x ? towards * d.y : -towards * d.x;
  return {left, 0.5 * (along_x ? thing.size().y : thing.size().x)};
}

ValueOf SideOf(const Predicate& predicate, const Viewpoint& view) {
  if (predicate.sector != "left" && predicate.sector != "right")
    throw InputError("side_of: '" + predicate.sector + "' is neither left nor right");
  const double sign = predicate.sector == "left" ? 1 : -1;
  if (predicate.side_of_axis) {
    return {"m", 1, [=](const Thing& thing) {
              const Vec2d from = FromAxis(view, thing);
              return sign * from.x - from.y;
            }};
  }
  // All of it lies on that side.
  return {"m", 1, [=](const Thing& thing) {
            double least = std::numeric_limits<double>::infinity();
            for (const double x : {thing.box.min.x, thing.box.max.x})
              for (const double y : {thing.box.min.y, thing.box.max.y}) least = std::min(least, sign * InHeading(view, {x, y, 0}).y);
            return least;
          }};
}

// Where the line ahead is inside a box seen from above, metres ahead; x > y: nowhere.
Vec2d Chord(const Viewpoint& view, const Box3d& box) {
  const double d[2] = {std::cos(view.yaw), std::sin(view.yaw)}, o[2] = {view.p_W.x, view.p_W.y};
  const double low[2] = {box.min.x, box.min.y}, high[2] = {box.max.x, box.max.y};
  Vec2d chord{-1e9, 1e9};
  for (int i = 0; i < 2; ++i) {
    if (std::abs(d[i]) < 1e-9) {
      if (o[i] < low[i] || o[i] > high[i]) return {1e9, -1e9};
      continue;
    }
    const double a = (low[i] - o[i]) / d[i], b = (high[i] - o[i]) / d[i];
    chord = {std::max(chord.x, std::min(a, b)), std::min(chord.y, std::max(a, b))};
  }
  return chord;
}

// What is wide may be round: the line has to pass through the middle half of its box.
Box3d Core(const Thing& thing) {
  Box3d box = thing.box;
  for (int i = 0; i < 2; ++i) {
    const double shrink = thing.size()[i] > kWide ? thing.size()[i] / 4 : 0;
    box.min[i] += shrink;
    box.max[i] -= shrink;
  }
  return box;
}

// Surely entered by the middle of its box, surely not outside of its box; what lies between decides nothing.
ValueOf Across(const Viewpoint& view) {
  constexpr double kBeside = 0.2;  // metres from a box
  return {"m", 0.2, [view](const Thing& thing) {
            if (PlanDistance(view.p_W, thing.box).least <= 0) return -1.0;
            const Vec3d grown{kBeside, kBeside, 0};
            const Vec2d chord = Chord(view, Core(thing)), whole = Chord(view, {thing.box.min - grown, thing.box.max + grown});
            if (chord.x <= chord.y) return chord.x <= 0 ? -1.0 : std::min(chord.x, std::max(chord.y - chord.x, 0.3));
            return whole.x > whole.y || whole.y <= 0 ? -1.0 : 0.0;
          }};
}

ValueOf Along(const Predicate& predicate, const Viewpoint& view) {
  return {"m", 0.5, [=](const Thing& thing) {
            const Vec2d at = InHeading(view, thing.center());
            const double aside = std::abs(at.y), off = std::max(predicate.width, predicate.clear) - aside;
            // Between the two widths one person counts it and another does not.
            const double inside = aside <= predicate.width ? predicate.width - aside : std::min(off, 0.0);
            return std::min(inside, at.x - 1);
          }};
}

ValueOf OppositeSide(const Viewpoint& view) {
  return {"m", 1, [view](const Thing& thing) { return PlanDistance(view.p_W, thing.box).least - 0.5; }};
}

ValueOf OnTopOf(SceneGraph& graph, const Predicate& predicate) {
  return {"m", 0.5, [&supports = graph.Find(predicate.of)](const Thing& thing) {
            const Vec3d c = thing.center();
            double best = -10;
            for (const Thing& support : supports) {
              const Box3d& box = support.box;
              if (support.entities == thing.entities || c.x < box.min.x || c.x > box.max.x || c.y < box.min.y || c.y > box.max.y) continue;
              if (box.max.z < thing.box.min.z - kStands) continue;
              best = std::max(best, thing.box.min.z - box.min.z - kRoofHeight);
            }
            return best;
          }};
}

ValueOf Storey(SceneGraph& graph, const Predicate& predicate) {
  return {"m", 0.3, [&buildings = graph.Find(predicate.of)](const Thing& thing) {
            const Vec3d c = thing.center();
            constexpr double kGrown = 1.5;  // metres: signs and curtains hang before the wall
            double best = -10;
            for (const Thing& building : buildings) {
              const Box3d& box = building.box;
              const bool inside = c.x > box.min.x - kGrown && c.x < box.max.x + kGrown && c.y > box.min.y - kGrown &&
                                  c.y < box.max.y + kGrown && thing.box.min.z > box.min.z - 0.5 && thing.box.max.z < box.max.z + 0.5;
              if (inside) best = std::max(best, kTallestStorey - thing.size().z);
            }
            return best;
          }};
}

ValueOf SurroundedBy(SceneGraph& graph, const Predicate& predicate) {
  return {"share", 0.03, [predicate, &around = graph.Find(predicate.of)](const Thing& thing) {
            std::array<bool, kDirections> covered{};
            const Vec3d c = thing.center();
            for (const Thing& other : around) {
              const Box3d& box = other.box;
              if (other.entities == thing.entities) continue;
              if (box.min.x < thing.box.min.x && box.min.y < thing.box.min.y && box.max.x > thing.box.max.x && box.max.y > thing.box.max.y)
                return 1 - predicate.share;
              const Vec3d gap = Max(Max(thing.box.min - box.max, box.min - thing.box.max), {});
              if (std::hypot(gap.x, gap.y) > predicate.within) continue;
              const Vec3d at = other.center() - c;
              const double azimuth = std::atan2(at.y, at.x) / kDegree;
              covered[static_cast<size_t>(std::floor((azimuth + 180) / 10)) % kDirections] = true;
            }
            return static_cast<double>(std::ranges::count(covered, true)) / kDirections - predicate.share;
          }};
}

}  // namespace

ValueOf ValueOfPredicate(SceneGraph& graph, const Noun& noun, const Predicate& predicate, const Viewpoint& view) {
  switch (predicate.kind) {
    case PredicateKind::kBearing:
      return Bearing(predicate, view);
    case PredicateKind::kHeightQuantile:
      return HeightQuantile(graph, noun, predicate);
    case PredicateKind::kOppositeSide:
      return OppositeSide(view);
    case PredicateKind::kSideOf:
      return SideOf(predicate, view);
    case PredicateKind::kAcross:
      return Across(view);
    case PredicateKind::kAlong:
      return Along(predicate, view);
    case PredicateKind::kOnTopOf:
      return OnTopOf(graph, predicate);
    case PredicateKind::kStorey:
      return Storey(graph, predicate);
    case PredicateKind::kSurroundedBy:
      return SurroundedBy(graph, predicate);
    case PredicateKind::kNearest:
    case PredicateKind::kOrdinal:
      break;
  }
  throw InputError("'" + std::string(kPredicateNames[static_cast<int>(predicate.kind)]) + "' compares things and is no filter");
}

}  // namespace airsim360::internal

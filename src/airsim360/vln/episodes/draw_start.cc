#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/vln/episodes/places.h"

namespace airsim360::internal {
namespace {

constexpr double kLongRoad = 25;      // metres: shorter ones are stubs
constexpr double kLineJitter = 0.05;  // rad of a heading along a line
constexpr double kCrossings = 16;     // metres beyond a junction that are still at the intersection: crossings, kerbs, corners
constexpr double kAtCorner = 60;      // metres from a junction's middle: what is farther is not seen at it
constexpr double kLanes = 0.5;        // of half a junction's width: how far its lanes are from its middle

// Metres along the long side of a box, half of it, and its direction seen from above.
struct LongSide {
  Vec3d along, across;
  double half_length, half_width;
};
LongSide LongSideOf(const Box3d& box) {
  const Vec3d size = box.max - box.min;
  const bool x = size.x >= size.y;
  return {x ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, x ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, 0.5 * (x ? size.x : size.y),
          0.5 * (x ? size.y : size.x)};
}

// At `at` seen from above, at a drawn height over open ground; in rooms over the floor below `at`.
std::optional<Vec3d> Lift(const VlnGround& ground, Vec3d at, const InstructionTemplate& wanted, RngStream& random) {
  const double height = random.Uniform(wanted.lowest, wanted.highest);
  const auto hit = ground.rooms() ? ground.Below(at) : ground.At(at.x, at.y);
  const bool open = hit && (ground.Is(hit->entity, "ground") || ground.Is(hit->entity, "water") || ground.Is(hit->entity, "nature"));
  if (!open) return std::nullopt;
  const Vec3d p{at.x, at.y, hit->z + height};
  return ground.IsFree(p, std::max(wanted.room, StartRoom(ground))) ? std::optional(p) : std::nullopt;
}

double HeadingOf(Vec3d d) { return std::atan2(d.y, d.x); }

bool IsCounted(const Query& query) {
  return std::ranges::any_of(query.predicates, [](const Predicate& p) { return p.kind == PredicateKind::kOrdinal; });
}

struct Draw {
  const VlnGround& ground;
  SceneGraph& graph;
  const InstructionTemplate& wanted;
  double nearest, farthest;
  RngStream& random;
  const Thing& thing;

  std::optional<Standpoint> At(Vec3d place, double yaw) const {
    const auto p = Lift(ground, place, wanted, random);
    if (!p) return std::nullopt;
    return Standpoint{{*p, std::remainder(yaw, 2 * kPi)}};
  }

  std::optional<Standpoint> Around() const {
    const double azimuth = random.Uniform(-kPi, kPi), distance = random.Uniform(nearest, farthest);
    const Vec3d way{std::cos(azimuth), std::sin(azimuth), 0}, half = thing.size() * 0.5;
    // From the edge of the box on.
    const double edge = std::min(half.x / std::max(std::abs(way.x), 1e-9), half.y / std::max(std::abs(way.y), 1e-9));
    double yaw = random.Uniform(-kPi, kPi);
    // What is to be flown across lies on the line ahead.
    const bool across = std::ranges::any_of(wanted.query.predicates, [](const Predicate& p) { return p.kind == PredicateKind::kAcross; });
    const double spread = across ? 0.15 : 0.6;
    for (const Sector& sector : kSectors)
      if (wanted.heading == sector.name)
        yaw = azimuth + kPi + (sector.azimuth + random.Uniform(-spread, spread) * sector.half_width) * kPi / 180;
    return At(thing.center() + way * (edge + distance), yaw);
  }

  // Before two things of a kind, one behind the other: what is to be counted lies on the line ahead.
  std::optional<Standpoint> InLine() const {
    std::vector<const Thing*> before;
    for (const Thing& other : graph.Find(wanted.query.noun))
      if (&other != &thing && PlanDistance(thing.center(), other.box).least < farthest) before.push_back(&other);
    if (before.empty()) return std::nullopt;
    const Thing& first = *before[random.Index(static_cast<uint32_t>(before.size()))];
    const Vec3d way{thing.center().x - first.center().x, thing.center().y - first.center().y, 0};
    const double gap = Norm(way), most = farthest - gap, least = std::max(nearest - gap, 0.5 * nearest);
    if (gap < 1 || most < least) return std::nullopt;
    const Vec3d ahead = way / gap;
    const Vec3d half = first.size() * 0.5;
    const double edge = std::abs(ahead.x) * half.x + std::abs(ahead.y) * half.y;
    // A little aside, so that the first does not hide the others.
    constexpr double kAside = 0.6;  // metres
    const Vec3d aside = Vec3d{-ahead.y, ahead.x, 0} * random.Uniform(-kAside, kAside);
    const Vec3d place = first.center() - ahead * (edge + random.Uniform(least, most)) + aside;
    return At({place.x, place.y, thing.center().z}, HeadingOf(ahead) + random.Uniform(-0.5, 0.5) * kLineJitter);
  }

  std::optional<Standpoint> OnRoad() const {
    static const Noun kRoad{.word = "road", .categories = {"ground/road"}, .without = {"junction*", "outer streets*", "far *"}};
    std::vector<const Thing*> roads;
    for (const Thing& road : graph.Find(kRoad))
      if (std::max(road.size().x, road.size().y) >= kLongRoad && PlanDistance(thing.center(), road.box).least < farthest)
        roads.push_back(&road);
    if (roads.empty()) return std::nullopt;
    const Thing& road = *roads[random.Index(static_cast<uint32_t>(roads.size()))];
    const LongSide side = LongSideOf(road.box);
    const double s = random.Uniform(-0.9, 0.9) * side.half_length, lateral = random.Uniform(-0.4, 0.4) * side.half_width;
    const Vec3d place = road.center() + side.along * s + side.across * lateral;
    const Vec3d ahead = side.along * (random.Chance(0.5) ? 1.0 : -1.0), to = thing.center() - place;
    const double distance = PlanDistance(place, thing.box).least;
    if (Dot(to, ahead) < 0 || distance < nearest || distance > farthest) return std::nullopt;
    return At(place, HeadingOf(ahead));
  }

  std::optional<Standpoint> BeforeTurn() const {
    static const Noun kJunction{.word = "junction", .names = {"junction *"}};
    // What is seen "at the intersection" is seen from somewhere over it and its crossings, in any lane of the way ahead; who turns
    // does so in its middle.
    const bool looks = wanted.in_sight > 0;
    std::vector<const Thing*> junctions;
    for (const Thing& junction : graph.Find(kJunction))
      if (!looks || PlanDistance(junction.center(), thing.box).least < kAtCorner) junctions.push_back(&junction);
    if (junctions.empty()) return std::nullopt;
    const Thing& junction = *junctions[random.Index(static_cast<uint32_t>(junctions.size()))];
    const double quarter = random.Index(4) * kPi / 2, back = random.Uniform(14, 70);
    const Vec3d ahead{std::cos(quarter), std::sin(quarter), 0}, middle = junction.center();
    const Vec3d half = junction.size() * 0.5, aside{-ahead.y, ahead.x, 0};
    const double reach = std::abs(ahead.x) * half.x + std::abs(ahead.y) * half.y,
                 lanes = kLanes * (std::abs(aside.x) * half.x + std::abs(aside.y) * half.y);
    const Vec3d line = middle + aside * (looks ? random.Uniform(-lanes, lanes) : 0.0), place = line - ahead * back;
    const double distance = PlanDistance(place, thing.box).least;
    if (distance < nearest || distance > farthest) return std::nullopt;
    auto stands = At(place, quarter);
    if (!stands) return std::nullopt;
    const auto below = ground.Below(stands->start.p_W);
    if (!below || !(ground.Is(below->entity, "ground/road") || ground.Is(below->entity, "ground/lane_marking") ||
                    ground.Is(below->entity, "ground/bike_lane")))
      return std::nullopt;
    const Vec3d at = line + ahead * (looks ? random.Uniform(-reach, reach + kCrossings) : 0.0);
    stands->turn = Viewpoint{{at.x, at.y, stands->start.p_W.z}, std::remainder(quarter, 2 * kPi)};
    if (looks && !ground.IsFree(stands->turn->p_W, StartRoom(ground))) return std::nullopt;
    return stands;
  }

  // Before an end of the long side, looking along it.
  std::optional<Standpoint> Crossing() const {
    const LongSide side = LongSideOf(thing.box);
    const Vec3d ahead = side.along * (random.Chance(0.5) ? 1.0 : -1.0);
    const double back = side.half_length + random.Uniform(nearest, farthest);
    const Vec3d place = thing.center() - ahead * back + side.across * (random.Uniform(-0.6, 0.6) * side.half_width);
    return At(place, HeadingOf(ahead) + random.Uniform(-0.01, 0.01));
  }

  std::optional<Standpoint> Facing() const {
    const LongSide side = LongSideOf(thing.box);
    const Vec3d ahead = side.across * (random.Chance(0.5) ? 1.0 : -1.0);
    const Vec3d place =
        thing.center() - ahead * random.Uniform(nearest, farthest) + side.along * (random.Uniform(-0.7, 0.7) * side.half_length);
    return At(place, HeadingOf(ahead) + random.Uniform(-kLineJitter, kLineJitter));
  }

  std::optional<Standpoint> Beside() const {
    const LongSide side = LongSideOf(thing.box);
    const Vec3d ahead = side.along * (random.Chance(0.5) ? 1.0 : -1.0), left{-ahead.y, ahead.x, 0};
    const Vec3d place = thing.center() + left * (side.half_width + random.Uniform(nearest, farthest)) +
                        ahead * (random.Uniform(-0.6, 0.6) * side.half_length);
    return At(place, HeadingOf(ahead) + random.Uniform(-5, 5) * kLineJitter);
  }
};

}  // namespace

std::optional<Standpoint> DrawStart(const VlnGround& ground, SceneGraph& graph, const InstructionTemplate& wanted, double nearest,
                                    double farthest, RngStream& random) {
  const auto& things = graph.Find(wanted.query.noun);
  if (things.empty()) return std::nullopt;
  const Draw draw{ground, graph, wanted, nearest, farthest, random, things[random.Index(static_cast<uint32_t>(things.size()))]};
  switch (wanted.frame) {
    case StartFrame::kAround:
      return IsCounted(wanted.query) ? draw.InLine() : draw.Around();
    case StartFrame::kRoad:
      return draw.OnRoad();
    case StartFrame::kTurn:
      return draw.BeforeTurn();
    case StartFrame::kCrossing:
      return draw.Crossing();
    case StartFrame::kFacing:
      return draw.Facing();
    case StartFrame::kBeside:
      return draw.Beside();
  }
  return std::nullopt;
}

}  // namespace airsim360::internal

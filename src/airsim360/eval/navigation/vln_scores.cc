#include "airsim360/eval/navigation/vln_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/eval/navigation/path_metrics.h"

namespace airsim360 {
namespace {

using Spl = VlnProtocol::Spl;

constexpr std::array<VlnProtocol, 7> kProtocols = {{
    {.name = "ours", .quirk = "three dimensions, at most the radius, the agent must stop; SPL by the shortest free way"},
    {.name = "aerialvln",
     .quirk = "distances to the goal leave the height out; nDTW is exact here (their code approximates it by fastdtw)",
     .horizontal = true},
    {.name = "openfly",
     .quirk = "nearer than the radius; no stop is needed; SPL is straight line / flown and may exceed 1",
     .strict = true,
     .needs_stop = false,
     .spl = Spl::kStraightUnbounded},
    {.name = "citynav-mgp",
     .quirk = "distances to the goal leave the height out; no stop is needed",
     .horizontal = true,
     .needs_stop = false},
    {.name = "citynav-vlnce", .quirk = "nearer than the radius, in three dimensions", .strict = true},
    {.name = "traveluav",
     .quirk = "SPL takes the reference's length less the radius as the shortest way",
     .spl = Spl::kReferenceLessRadius},
    {.name = "uavon", .quirk = "a collision is a failure", .collision_fails = true},
}};

void CheckPath(const char* what, std::span<const Vec3d> path) {
  if (path.empty()) throw InputError(std::string(what) + " has no points");
  for (const Vec3d& p : path) {
    if (!std::isfinite(p.x + p.y + p.z)) throw InputError(std::string(what) + " has a point that is not finite");
  }
}

double Distance(Vec3d a, Vec3d b, bool horizontal) {
  const Vec3d d = a - b;
  return horizontal ? std::hypot(d.x, d.y) : Norm(d);
}

double SplOf(const VlnProtocol& protocol, bool success, double shortest, double straight, double reference, double flown, double radius) {
  if (!success) return 0;
  switch (protocol.spl) {
    case Spl::kStraightUnbounded:
      return flown > 0 ? straight / flown : 1;
    case Spl::kReferenceLessRadius:
      return SuccessByLength(true, std::max(0.0, reference - radius), flown);
    case Spl::kShortest:
      break;
  }
  return SuccessByLength(true, shortest, flown);
}

}  // namespace

std::span<const VlnProtocol> VlnProtocols() { return kProtocols; }

const VlnProtocol& FindVlnProtocol(const std::string& name) {
  std::vector<std::string> names;
  for (const VlnProtocol& protocol : kProtocols) {
    if (protocol.name == name) return protocol;
    names.emplace_back(protocol.name);
  }
  throw InputError("--protocol: " + UnknownChoiceMessage("protocol of navigation", name, names));
}

std::array<double, kVlnFigures.size()> Figures(const VlnScore& s) {
  return {s.success, s.oracle, s.spl, s.spl_straight, s.error, s.ndtw, s.sdtw, s.cls, s.length};
}

double CoverageByLength(std::span<const Vec3d> path, std::span<const Vec3d> reference, double radius) {
  double coverage = 0;
  for (const Vec3d& r : reference) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : path) nearest = std::min(nearest, Norm(p - r));
    coverage += std::exp(-nearest / radius);
  }
  coverage /= static_cast<double>(reference.size());
  const double expected = coverage * PathLength(reference), off = std::abs(expected - PathLength(path));
  // Two paths without length agree.
  return coverage * (expected + off > 0 ? expected / (expected + off) : 1);
}

VlnScore ScoreVln(const VlnEpisode& e, double radius, const VlnProtocol& protocol) {
  CheckPath("the reference", e.reference);
  CheckPath("the flown path", e.flown);
  if (!(radius > 0 && std::isfinite(radius))) throw InputError("the radius, " + std::to_string(radius) + ", is not a number above 0");
  if (e.shortest && !(*e.shortest >= 0 && std::isfinite(*e.shortest)))
    throw InputError("the shortest way, " + std::to_string(*e.shortest) + ", is not a number of at least 0");
  std::vector<Vec3d> places = e.places;
  places.insert(places.begin(), e.goal.value_or(e.reference.back()));
  const auto distance = [&](Vec3d p, Vec3d place) { return Distance(p, place, protocol.horizontal); };
  const auto arrived = [&](Vec3d p) {
    return std::ranges::any_of(places, [&](Vec3d place) {
      const double d = distance(p, place);
      return protocol.strict ? d < radius : d <= radius;
    });
  };
  // The first of those that are equally near: the goal itself before its other places.
  const Vec3d goal = *std::ranges::min_element(places, {}, [&](Vec3d place) { return distance(e.flown.back(), place); });
  VlnScore s;
  const bool success = arrived(e.flown.back()) && (e.stopped || !protocol.needs_stop) && !(e.collided && protocol.collision_fails);
  const double straight = Norm(goal - e.reference.front()), reference = PathLength(e.reference);
  s.success = success;
  s.oracle = std::ranges::any_of(e.flown, arrived);
  s.error = distance(e.flown.back(), goal);
  s.length = PathLength(e.flown);
  s.spl = SplOf(protocol, success, e.shortest.value_or(reference), straight, reference, s.length, radius);
  s.spl_straight = SuccessByLength(success, straight, s.length);
  s.ndtw = NormalizedTimeWarping(e.flown, e.reference, radius);
  s.sdtw = s.success * s.ndtw;
  s.cls = CoverageByLength(e.flown, e.reference, radius);
  return s;
}

}  // namespace airsim360

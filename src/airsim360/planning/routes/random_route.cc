#include "airsim360/planning/routes/random_route.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/planning/certificate.h"

namespace airsim360 {
namespace {

constexpr int kStarts = 200, kTurns = 12;     // draws of a start, and of each leg
constexpr double kTurn = 0.7, kClimb = 0.12;  // radians, standard deviations from leg to leg

std::optional<Vec3d> DrawStart(const ClearanceField& field, const ReachableSpace& space, const ClearanceQuery& world,
                               const RandomRouteOptions& options, RngStream& random) {
  for (int i = 0; i < kStarts; ++i) {
    const int x = static_cast<int>(random.Index(static_cast<uint32_t>(field.size(0))));
    const int y = static_cast<int>(random.Index(static_cast<uint32_t>(field.size(1))));
    Vec3d p = field.Center(x, y, 0);
    // More starts near the ground, where there is more to see and to avoid.
    const double u = random.Uniform();
    const double height = options.min_height + u * u * (options.max_height - options.min_height);
    p.z = field.BottomOfColumn(x, y) + height;
    if (space.Contains(p) && world.LowerBound(p, options.room, options.room) >= options.room) return p;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Vec3d>> DrawRoute(const ClearanceField& field, const ReachableSpace& space, const ClearanceQuery& world,
                                            const RandomRouteOptions& options, RngStream& random) {
  const double length = random.Uniform(options.min_length, options.max_length);
  const int legs = options.min_legs + static_cast<int>(random.Index(static_cast<uint32_t>(options.max_legs - options.min_legs + 1)));
  const std::optional<Vec3d> start = DrawStart(field, space, world, options, random);
  if (!start) return std::nullopt;
  // Shares of the length.
  std::vector<double> share(static_cast<size_t>(legs));
  double sum = 0;
  for (double& s : share) sum += s = random.Uniform(0.6, 1.4);

  std::vector<Vec3d> points = {*start};
  double heading = random.Uniform(0, 2 * std::numbers::pi);
  for (const double s : share) {
    bool found = false;
    for (int turn = 0; turn < kTurns && !found; ++turn) {
      // The harder it is to go on, the sharper the turns.
      const double widen = 1 + 0.3 * turn;
      const double yaw = heading + kTurn * widen * random.Normal(), climb = kClimb * widen * random.Normal();
      const Vec3d direction{std::cos(yaw) * std::cos(climb), std::sin(yaw) * std::cos(climb), std::sin(climb)};
      const Vec3d next = points.back() + direction * (length * s / sum);
      if (!SegmentIsClear(points.back(), next, world, options.room)) continue;
      points.push_back(next);
      heading = yaw;
      found = true;
    }
    if (!found) return std::nullopt;
  }
  return points;
}

}  // namespace airsim360

#include "airsim360/dataset/plan/flight_frames.h"

#include <algorithm>
#include <cmath>

#include "airsim360/dataset/plan/viewpoints.h"
#include "airsim360/math/median.h"
#include "airsim360/routes/route.h"

namespace airsim360 {
namespace {

// Lower median of the distances to what rays meet; a kilometre where most see the sky.
double MedianRange(const RayTracer& tracer, Vec3d p_W) {
  constexpr float kFar = 1000;
  static const std::vector<Vec3f> kDirections = EvenDirections(64);
  std::vector<float> ranges;
  for (const Vec3f& direction : kDirections) {
    if (const auto hit = tracer.Intersect(VecCast<float>(p_W), direction, kFar)) ranges.push_back(hit->distance);
  }
  if (ranges.empty()) return kFar;
  return LowerMedian(std::move(ranges));
}

// Times at which the parallax since the start is (k + 1/2) / n of that of the whole way.
std::vector<double> TimesOfEqualParallax(const RayTracer& tracer, const PolynomialTrajectory& path, uint64_t n) {
  constexpr int kSteps = 120;
  std::vector<double> sum = {0};
  const double dt = path.duration() / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const TrajectoryPoint middle = path.At((i + 0.5) * dt);
    sum.push_back(sum.back() + Norm(middle.v) * dt / MedianRange(tracer, middle.p));
  }
  std::vector<double> times;
  for (uint64_t k = 0; k < n; ++k) {
    const double wanted = sum.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    const auto above = std::ranges::upper_bound(sum, wanted) - sum.begin();
    const auto i = static_cast<size_t>(std::clamp<ptrdiff_t>(above, 1, kSteps));
    const double part = sum[i] > sum[i - 1] ? (wanted - sum[i - 1]) / (sum[i] - sum[i - 1]) : 0.5;
    times.push_back((static_cast<double>(i - 1) + part) * dt);
  }
  return times;
}

}  // namespace

FlightFrames::FlightFrames(Stage& stage, const RecipeRow& row, uint64_t seed)
    : row_(row), seed_(seed), tracer_(stage.solid()), space_(std::make_unique<WaypointSpace>(stage, row.clearance)) {}

std::vector<Shot> FlightFrames::Shots(int64_t number) const {
  const WaypointWorld world{row_.name, 0, row_.least_length, row_.most_length};
  const WaypointRoute route = MakeWaypointRoute(*space_, world, seed_, number, row_.clearance);
  const PolynomialTrajectory& path = route.flights.front().flight.trajectory;
  const Route way = Route::Along(path, std::nullopt);
  std::vector<Shot> shots;
  for (const double t : TimesOfEqualParallax(*tracer_, path, row_.flight_frames)) {
    const RoutePoint at = way.At(t);
    Shot shot{.t_ns = std::llround(t * 1e9), .body = {BodyPose(at.p, at.yaw, 0, 0), at.v, {0, 0, at.yaw_rate}}};
    shots.push_back(std::move(shot));
  }
  shots.back().last = true;
  return shots;
}

}  // namespace airsim360

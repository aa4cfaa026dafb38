// What the waypoint set costs, and where: draws, times and polynomials, certificates. CPU time of one thread.
//   waypoint_bench [WORLD [ROUTES]]
// Then free flights between random places of the world: found, refused, and how long each took.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/waypoint_set.h"
#include "airsim360/opening/world_loader.h"
#include "clock.h"

namespace airsim360 {
namespace {

double CpuSeconds() { return SecondsOf(CLOCK_THREAD_CPUTIME_ID); }

// CPU time of a call.
template <class Call>
double Measure(const Call& call) {
  const double start = CpuSeconds();
  call();
  return CpuSeconds() - start;
}

// The parts of one route again, one after another, as often as the whole needed them at least.
void MeasureRoutes(const WaypointSpace& space, const WaypointWorld& world, int64_t routes) {
  double whole = 0, allocation = 0, certificates = 0;
  int64_t flights = 0, queries = 0, segments = 0, added = 0;
  for (int64_t i = 0; i < routes; ++i) {
    WaypointRoute route;
    whole += Measure([&] { route = MakeWaypointRoute(space, world, 0, i, 0.5); });
    for (size_t s = 0; s < route.flights.size(); ++s) {
      const KinematicSet& set = KinematicSets()[s];
      const CertifiedFlight& flight = route.flights[s];
      ++flights;
      segments += static_cast<int64_t>(flight.flight.trajectory.segments());
      added += static_cast<int64_t>(flight.added);
      allocation += Measure([&] {
        AllocateTimes(flight.waypoints, {.speed = set.max_speed, .acceleration = set.max_acceleration}, {.sample_interval = set.interval});
      });
      certificates += Measure([&] { queries += Certify(flight.flight.trajectory, flight.flight.peaks, space.world(), 0.5).queries; });
    }
  }
  const double n = static_cast<double>(flights);
  std::printf(
      "%s: %lld flights of %.1f segments (%.2f waypoints added): %.3f ms each in all; times and polynomials "
      "%.3f ms, certificate %.3f ms (%.1f queries)\n",
      world.name.c_str(), static_cast<long long>(flights), static_cast<double>(segments) / n, static_cast<double>(added) / n,
      1e3 * whole / n, 1e3 * allocation / n, 1e3 * certificates / n, static_cast<double>(queries) / n);
  std::printf("100,000 flights at this rate: %.0f s of one core in all; times and polynomials alone %.0f s\n", 1e5 * whole / n,
              1e5 * allocation / n);
}

void MeasureFreeFlights(const WaypointSpace& space) {
  RngStream random(1, "free flights");
  const Box3d box = space.world().box();
  std::vector<double> found, refused;
  for (int i = 0; i < 40; ++i) {
    const auto draw = [&] {
      for (;;) {
        const Vec3d p{random.Uniform(box.min.x, box.max.x), random.Uniform(box.min.y, box.max.y),
                      random.Uniform(box.min.z, box.max.z - 25)};
        if (space.reachable().Contains(p)) return p;
      }
    };
    const Vec3d a = draw();
    Vec3d b = draw();
    if (Norm(b - a) > 150) b = a + (b - a) * (150 / Norm(b - a));
    bool ok = true;
    const double s = Measure([&] {
      try {
        FlyFree({a, b}, space.world(), {.limits = {.speed = 16, .acceleration = 3}, .allocation = {}});
      } catch (const InputError&) {
        ok = false;
      }
    });
    (ok ? found : refused).push_back(1e3 * s);
  }
  for (auto* list : {&found, &refused}) std::sort(list->begin(), list->end());
  const auto median = [](const std::vector<double>& v) { return v.empty() ? 0 : v[v.size() / 2]; };
  std::printf("free flights up to 150 m: %zu found (median %.1f ms, most %.1f ms), %zu refused (median %.1f ms)\n", found.size(),
              median(found), found.empty() ? 0 : found.back(), refused.size(), median(refused));
}

}  // namespace
}  // namespace airsim360

int main(int argc, char** argv) {
  using namespace airsim360;
  const std::string name = argc > 1 ? argv[1] : "downtown_west";
  const int64_t routes = argc > 2 ? std::atoll(argv[2]) : 200;
  Stage stage({.world = {.world = name}});
  const WaypointSpace space(stage, 0.5);
  const ThreadLimit limit(1);
  for (const WaypointWorld& world : WaypointWorlds()) {
    if (world.name == name) MeasureRoutes(space, world, routes);
  }
  MeasureFreeFlights(space);
}

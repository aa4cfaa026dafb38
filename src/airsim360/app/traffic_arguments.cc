#include "airsim360/app/traffic_arguments.h"

#include <charconv>

namespace airsim360 {

void TrafficArguments::AddTo(CLI::App& command) {
  command.add_option("--traffic", count, "vehicles that drive on the roads of the world (default 0; docs/guide/traffic.md)")
      ->check(CLI::Range(0, 20000));
  command.add_option("--traffic-warmup", warm_up, "seconds that they drive before the first frame (default 30)")
      ->check(CLI::Range(0.0, 3600.0));
}

std::string TrafficArguments::Describe() const {
  if (count == 0) return {};
  char warm[32];
  const auto end = std::to_chars(warm, warm + sizeof warm, warm_up).ptr;
  return std::to_string(count) + ", warm-up " + std::string(warm, end) + " s";
}

}  // namespace airsim360

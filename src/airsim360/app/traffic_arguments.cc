#include "airsim360/app/traffic_arguments.h"

#include "airsim360/base/text.h"

namespace airsim360 {

void TrafficArguments::AddTo(CLI::App& command) {
  command.add_option("--traffic", count, "vehicles that drive on the roads of the world (default 0; docs/guide/traffic.md)")
      ->check(CLI::Range(0, 20000));
  command.add_option("--traffic-warmup", warm_up, "seconds that they drive before the first frame (default 30)")
      ->check(CLI::Range(0.0, 3600.0));
}

std::string TrafficArguments::Describe() const {
  if (count == 0) return {};
  return std::to_string(count) + ", warm-up " + ShortestText(warm_up) + " s";
}

}  // namespace airsim360

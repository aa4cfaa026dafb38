#include "airsim360/app/flags/traffic_arguments.h"

#include "airsim360/base/error.h"
#include "airsim360/base/text.h"

namespace airsim360 {

void TrafficArguments::AddTo(CLI::App& command) {
  command.add_option("--traffic", count, "vehicles that drive on the roads of the world (default 0; docs/guide/traffic.md)")
      ->check(CLI::Range(0, 20000));
  command.add_option("--traffic-warmup", warm_up, "seconds that they drive before the first frame (default 30)")
      ->check(CLI::Range(0.0, 3600.0));
}

TrafficRequest TrafficArguments::Request(uint64_t seed) const {
  if (count == 0 && warm_up != TrafficArguments().warm_up)
    throw InputError("--traffic-warmup: nobody drives; add --traffic N, for example --traffic 60");
  return {static_cast<size_t>(count), seed, warm_up};
}

std::string TrafficArguments::Describe() const {
  if (count == 0) return {};
  return std::to_string(count) + ", warm-up " + ShortestText(warm_up) + " s";
}

}  // namespace airsim360

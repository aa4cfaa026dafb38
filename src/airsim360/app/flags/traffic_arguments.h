// The flags of traffic, the same for every command that has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "airsim360/sim/traffic/traffic_request.h"

namespace airsim360 {

/// --traffic N, --traffic-warmup S.
struct TrafficArguments {
  int count = 0;
  double warm_up = 30;

  void AddTo(CLI::App& command);
  /// InputError if there is a warm-up and nobody drives.
  TrafficRequest Request(uint64_t seed) const;
  /// What a dataset says of it. Empty = none.
  std::string Describe() const;
};

}  // namespace airsim360

// The flags of people, the same for every command that has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "airsim360/dataset/record/spec.h"
#include "airsim360/sim/people/populate.h"

namespace airsim360 {

/// --people N|FILE, --people-warmup S, --people-level L, --sockets FILE.
struct PeopleArguments {
  std::string people, sockets;
  double warm_up = 15;
  int level = -1, reserve = 0;

  void AddTo(CLI::App& command);
  /// What they ask for; InputError naming the flag for what makes no sense. Files are read when people are
  /// made.
  PeopleRequest Request(uint64_t seed) const;
  /// What a dataset says of them: numbers, and the SHA-256 of files. Empty = nobody.
  std::string Describe() const;
};

}  // namespace airsim360

// What the benchmarks take from their command line.
#pragma once

#include <cstring>

namespace airsim360 {

/// What follows the last `name` among the arguments; else `value`.
inline const char* Argument(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  return value;
}

}  // namespace airsim360

// What `airsim360 fly` is told to do, one task after the other.
#pragma once

#include <string>
#include <vector>

#include "airsim360/flight/control/command.h"

namespace airsim360 {

/// A command and when the next one comes.
struct FlyTask {
  std::string text;  ///< as written
  Command command;
  double seconds = 0;       ///< at most (`until_done`) or exactly so long
  bool until_done = false;  ///< goes on when the drone says that it is done
};

/// "takeoff [HEIGHT]; hover SECONDS; goto X,Y,Z[,SPEED]; velocity X,Y,Z,SECONDS; return; land": tasks apart
/// by
/// ';'. Metres of W, m/s, seconds. InputError naming `--script`, the task and the nearest valid one.
std::vector<FlyTask> ParseFlyScript(const std::string& text);

}  // namespace airsim360

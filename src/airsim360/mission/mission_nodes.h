// The leaves by which a drone acts in a mission. docs/guide/missions.md has the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "airsim360/behaviour/nodes.h"

namespace airsim360 {

/// Behind behaviour::Node.
enum class MissionNode : uint8_t {
  // Actions that fly: one of them has the drone
  kTakeoff = static_cast<uint8_t>(behaviour::Node::kFirstLeaf),
  kLand,
  kReturn,
  kGoto,
  kOrbit,
  kFollow,
  kLook,
  // Other actions
  kGimbal,
  kCapture,
  kWait,
  // Conditions
  kNear,
  kBatteryAbove,
  kSees,
  kTimeAfter,
};

/// Nodes of missions. Kinds of their ports: w where or who, x products, f name of a folder; numbers: see NumberRange.
const behaviour::Palette& MissionPalette();

/// Bounds of the numbers of a kind of port: m metres and s seconds, both 0 … 1e5; v metres a second, c count, h height over
/// something, q share of a charge, r turns, g degrees, i index.
struct NumberRange {
  double low, high;
  bool whole;
};
/// nullopt for kinds that are no numbers.
std::optional<NumberRange> RangeOf(char kind);
/// What is wrong with a number of that kind, "" if nothing: "-1 is not in 0.1 … 50".
std::string NumberProblem(char kind, double value);

}  // namespace airsim360

// What is written on the boards of the 1950s.
#pragma once

#include <string>
#include <vector>

namespace airsim360::internal {

/// What is painted beside the name.
enum class PaintedGoods { kRadio, kHat, kCup, kLiner, kWheel, kBottle, kRays, kLoaf };
/// Name and slogan of a painted board.
struct PaintedAdvert {
  const char *name, *line;
  PaintedGoods goods = PaintedGoods::kRays;
};
/// All names, slogans and words on boards, blades, neon signs and walls.
std::vector<std::string> SignTexts1950s();

}  // namespace airsim360::internal

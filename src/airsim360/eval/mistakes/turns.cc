#include "airsim360/eval/mistakes/turns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace airsim360::internal {
namespace {

constexpr int kMostColumns = 128, kMostRows = 64;
// Where a turn changes so few places there is nothing to tell it by.
constexpr size_t kLeastChanged = 50;
constexpr double kLeastShareChanged = 0.01;
// Turns below this share of the width are not looked for: pictures that were enlarged are off by so much at edges.
constexpr int kLeastRoll = 32;

double Mean(const std::vector<double>& errors) {
  double sum = 0, count = 0;
  for (const double e : errors) {
    if (!std::isnan(e)) sum += e, count += 1;
  }
  return sum / std::max(1.0, count);
}

struct TurnEvidence {
  size_t changed = 0, votes = 0;
  double straight = 0, turned = 0;  // sums of errors over the places that change
  double gain() const { return straight - turned; }
  // A prediction that knows nothing of the direction is as right one way as the other: ratio 1, votes 1/2.
  bool Shows(size_t places, double ratio, double share) const {
    return changed >= std::max(kLeastChanged, static_cast<size_t>(kLeastShareChanged * static_cast<double>(places))) &&
           turned<ratio * straight&& static_cast<double>(votes)> share * static_cast<double>(changed);
  }
};

TurnEvidence Weigh(const SampleGrid& grid, const Turn& turn, const Turn& upright, const std::vector<double>& straight,
                   const std::vector<double>& turned, const SameTruth& same) {
  TurnEvidence evidence;
  for (size_t p = 0; p < grid.pixels.size(); ++p) {
    if (std::isnan(straight[p]) || std::isnan(turned[p]) || same(upright.From(grid, grid.pixels[p]), turn.From(grid, grid.pixels[p])))
      continue;
    ++evidence.changed;
    evidence.straight += straight[p];
    evidence.turned += turned[p];
    evidence.votes += turned[p] < straight[p];
  }
  return evidence;
}

std::string Words(const Turn& turn, int columns) {
  std::string words;
  const auto add = [&](const std::string& text) { words += (words.empty() ? "" : " and ") + text; };
  if (turn.flipped) add("upside down");
  if (turn.mirrored) add(turn.flipped ? "mirrored" : "mirrored left to right (longitude counted the other way)");
  if (turn.roll != 0 && 2 * turn.roll == columns) {
    add("turned by 180 degrees (half the width)");
  } else if (turn.roll != 0) {
    const int64_t right = 2 * turn.roll > columns ? turn.roll - columns : turn.roll;
    add("rolled by about " + std::to_string((std::abs(right) * 360 + columns / 2) / columns) + " degrees to the " +
        (right > 0 ? "right" : "left"));
  }
  return words;
}

// A plain one is preferred to a roll that is hardly better.
constexpr size_t kPlainTurns = 8;

// The plain ones first.
std::vector<Turn> Turns(const SampleGrid& grid, bool panorama) {
  std::vector<Turn> turns = {{true, false, 0}, {false, true, 0}, {true, true, 0}};
  if (!panorama) return turns;
  const int columns = grid.picture_width;
  for (const int roll : {columns / 2, columns / 4, columns - columns / 4}) turns.push_back({false, false, roll});
  turns.push_back({true, false, columns / 2});
  turns.push_back({false, true, columns / 2});
  const int least = std::max(1, grid.width / kLeastRoll);
  for (int step = least; step <= grid.width - least; ++step)
    turns.push_back({false, false, static_cast<int>(static_cast<int64_t>(step) * columns / grid.width)});
  for (int step = 2; step < grid.width; step += 2)
    turns.push_back({true, false, static_cast<int>(static_cast<int64_t>(step) * columns / grid.width)});
  return turns;
}

std::vector<Turn> SmallRolls(const SampleGrid& grid) {
  std::vector<Turn> turns;
  const int columns = grid.picture_width;
  for (int step = 1; step < std::max(1, grid.width / kLeastRoll); ++step) {
    const int roll = static_cast<int>(static_cast<int64_t>(step) * columns / grid.width);
    turns.push_back({false, false, roll});
    turns.push_back({false, false, columns - roll});
  }
  return turns;
}

}  // namespace

SampleGrid::SampleGrid(int w, int h)
    : picture_width(w), picture_height(h), width(std::min(w, kMostColumns)), height(std::min(h, kMostRows)) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto row = static_cast<size_t>((y + 0.5) * h / height), column = static_cast<size_t>((x + 0.5) * w / width);
      pixels.push_back(row * static_cast<size_t>(w) + column);
    }
  }
}

size_t Turn::From(const SampleGrid& grid, size_t pixel) const {
  const auto w = static_cast<size_t>(grid.picture_width), h = static_cast<size_t>(grid.picture_height);
  const size_t x = pixel % w, y = pixel / w, from_x = mirrored ? w - 1 - x : x, from_y = flipped ? h - 1 - y : y;
  return from_y * w + (from_x + w - static_cast<size_t>(roll)) % w;
}

LikelyTurn FindTurn(const SampleGrid& grid, bool panorama, const TurnErrors& errors, const SameTruth& same) {
  // An enlarged picture may be moved a little: what it shows is compared with that.
  Turn upright;
  std::vector<double> straight = errors(upright);
  for (const Turn& moved : panorama ? SmallRolls(grid) : std::vector<Turn>{}) {
    std::vector<double> other = errors(moved);
    if (Mean(other) < Mean(straight)) upright = moved, straight = std::move(other);
  }
  Turn best, plain;
  TurnEvidence found, of_plain;
  const std::vector<Turn> turns = Turns(grid, panorama);
  for (size_t i = 0; i < turns.size(); ++i) {
    const TurnEvidence evidence = Weigh(grid, turns[i], upright, straight, errors(turns[i]), same);
    if (!evidence.Shows(grid.pixels.size(), 0.9, 0.5)) continue;
    if (evidence.gain() > found.gain()) best = turns[i], found = evidence;
    if (i < kPlainTurns && evidence.gain() > of_plain.gain()) plain = turns[i], of_plain = evidence;
  }
  if (of_plain.gain() > 0.87 * found.gain()) best = plain, found = of_plain;
  if (found.Shows(grid.pixels.size(), 0.6, 0.7)) return {Words(best, grid.picture_width), true};
  if (found.Shows(grid.pixels.size(), 0.8, 0.6)) return {Words(best, grid.picture_width), false};
  return {};
}

}  // namespace airsim360::internal

#include "airsim360/eval/mistakes/turns.h"

#include <algorithm>
#include <cmath>

#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360::internal {
namespace {

// Where a turn changes so few places there is nothing to tell it by.
constexpr size_t kLeastChanged = 50;
constexpr double kLeastShareChanged = 0.01;
// Turns below this share of the width are not looked for: pictures that were enlarged are off by so much at edges.
constexpr int kLeastRoll = 32;
// A plain turn is preferred to a roll that is hardly better.
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

double Mean(const std::vector<double>& errors) {
  double sum = 0, count = 0;
  for (const double e : errors) {
    if (!std::isnan(e)) sum += e, count += 1;
  }
  return sum / std::max(1.0, count);
}

double ShareRight(const std::vector<double>& errors) {
  const double right = std::log(1.25);
  double sum = 0, count = 0;
  for (const double e : errors) {
    if (!std::isnan(e)) sum += e < right, count += 1;
  }
  return sum / std::max(1.0, count);
}

struct Evidence {
  Turn turn;
  size_t changed = 0, votes = 0;
  double straight = 0, turned = 0;  // sums of errors over the places that change
  double right = 0;                 // share of all places

  double gain() const { return straight - turned; }
  // A prediction that knows nothing of the direction is as right one way as the other: ratio 1, votes 1/2.
  bool Shows(size_t places, double ratio, double share) const {
    const size_t least =
        std::max(std::min(kLeastChanged, places / 40), static_cast<size_t>(kLeastShareChanged * static_cast<double>(places)));
    const bool better = turned < ratio * straight;
    return changed >= least && better && static_cast<double>(votes) > share * static_cast<double>(changed);
  }
};

// What the turns of a panorama or another picture explain.
class Search {
 public:
  Search(const SampleGrid& grid, bool panorama, const TurnComparison& compare)
      : grid_(grid), panorama_(panorama), compare_(compare), upright_(TruthsOf(grid, {})), straight_(compare.errors(upright_)) {
    // An enlarged picture may be moved a little: what it shows is compared with that.
    double least = Mean(straight_);
    for (const Turn& moved : panorama ? SmallRolls(grid) : std::vector<Turn>{}) {
      std::vector<size_t> places = TruthsOf(grid, moved);
      std::vector<double> errors = compare.errors(places);
      const double mean = Mean(errors);
      if (mean < least) least = mean, upright_ = std::move(places), straight_ = std::move(errors);
    }
  }

  // Whether there is a turn that may be likely.
  bool Suspects() const {
    return std::ranges::any_of(Turns(grid_, panorama_), [&](const Turn& turn) { return Shows(Weigh(turn), 0.95, 0.5); });
  }

  // The turn with the most gain; nothing has changed places where there is none.
  Evidence Best() const {
    Evidence best, plain;
    const std::vector<Turn> turns = Turns(grid_, panorama_);
    for (size_t i = 0; i < turns.size(); ++i) {
      const Evidence evidence = Weigh(turns[i]);
      if (!Shows(evidence, 0.9, 0.5)) continue;
      if (evidence.gain() > best.gain()) best = evidence;
      if (i < kPlainTurns && evidence.gain() > plain.gain()) plain = evidence;
    }
    return plain.gain() > 0.87 * best.gain() ? plain : best;
  }

  bool Shows(const Evidence& evidence, double ratio, double share) const { return evidence.Shows(grid_.pixels.size(), ratio, share); }

 private:
  Evidence Weigh(const Turn& turn) const {
    const std::vector<size_t> places = TruthsOf(grid_, turn);
    const std::vector<double> turned = compare_.errors(places);
    const std::vector<uint8_t> same = compare_.same(upright_, places);
    Evidence evidence{turn};
    for (size_t p = 0; p < places.size(); ++p) {
      if (same[p] || std::isnan(straight_[p]) || std::isnan(turned[p])) continue;
      ++evidence.changed;
      evidence.straight += straight_[p];
      evidence.turned += turned[p];
      evidence.votes += turned[p] < straight_[p];
    }
    evidence.right = ShareRight(turned);
    return evidence;
  }

  const SampleGrid& grid_;
  bool panorama_;
  const TurnComparison& compare_;
  std::vector<size_t> upright_;
  std::vector<double> straight_;
};

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

}  // namespace

SampleGrid::SampleGrid(int w, int h, int most_columns, int most_rows)
    : picture_width(w), picture_height(h), width(std::min(w, most_columns)), height(std::min(h, most_rows)) {
  for (int x = 0; x < width; ++x) columns.push_back(static_cast<int>((x + 0.5) * w / width));
  for (int y = 0; y < height; ++y) rows.push_back(static_cast<int>((y + 0.5) * h / height));
  pixels = TruthsOf(*this, {});
}

std::vector<size_t> TruthsOf(const SampleGrid& grid, const Turn& turn) {
  std::vector<size_t> columns, places;
  for (const int x : grid.columns) {
    const int from = (turn.mirrored ? grid.picture_width - 1 - x : x) - turn.roll;
    columns.push_back(static_cast<size_t>(from < 0 ? from + grid.picture_width : from));
  }
  places.reserve(columns.size() * grid.rows.size());
  for (const int y : grid.rows) {
    const auto row = static_cast<size_t>(turn.flipped ? grid.picture_height - 1 - y : y) * static_cast<size_t>(grid.picture_width);
    for (const size_t column : columns) places.push_back(row + column);
  }
  return places;
}

LikelyTurn FindTurn(int width, int height, bool panorama, const std::function<TurnComparison(const SampleGrid&)>& compare) {
  const SampleGrid coarse(width, height, 64, 32), fine(width, height);
  if (const TurnComparison few = compare(coarse); !Search(coarse, panorama, few).Suspects()) return {};
  const TurnComparison all = compare(fine);
  const Search search(fine, panorama, all);
  const Evidence best = search.Best();
  const bool clear = search.Shows(best, 0.6, 0.7);
  if (!clear && !search.Shows(best, 0.8, 0.6)) return {};
  return {Words(best.turn, width), clear && best.right >= kNearlyAll, best.right};
}

}  // namespace airsim360::internal

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/mistakes/turns.h"

namespace airsim360 {
namespace {

using internal::SampleGrid;
using internal::Turn;

constexpr size_t kLeastLabels = 50;
// Labels of fewer pixels than this share say nothing of the numbering.
constexpr double kLeastShare = 0.005;

struct JointCounts {
  std::map<std::pair<uint32_t, uint32_t>, size_t> pairs;  // truth and prediction
  std::map<uint32_t, size_t> truths, predictions;
  size_t all = 0;
  double Share(size_t count) const { return static_cast<double>(count) / static_cast<double>(all); }
  size_t Of(uint32_t truth, uint32_t prediction) const {
    const auto found = pairs.find({truth, prediction});
    return found == pairs.end() ? 0 : found->second;
  }
};

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100 * share);
  return text;
}

LikelyMistake ConstantMistake(const JointCounts& counts) {
  if (counts.predictions.size() != 1 || counts.truths.size() < 2) return {};
  const uint32_t label = counts.predictions.begin()->first;
  const auto truth = counts.truths.find(label);
  const double right = truth == counts.truths.end() ? 0 : counts.Share(truth->second);
  if (right > 0.5) return {};
  return {"every predicted pixel is " + std::to_string(label) + ", which is right for " + Percent(right) +
              ": is that a label of these classes?",
          right < kLeastShare};
}

// Labels of the truth that are each predicted as another one of their own, and how many pixels are so.
struct Renumbering {
  size_t agree = 0, labels = 0, renumbered = 0;
  std::string example;
};

Renumbering BestRenumbering(const JointCounts& counts) {
  std::vector<std::pair<size_t, std::pair<uint32_t, uint32_t>>> order;
  for (const auto& [pair, count] : counts.pairs) order.push_back({count, pair});
  std::sort(order.rbegin(), order.rend());
  std::set<uint32_t> truths, predictions;
  Renumbering best;
  for (const auto& [count, pair] : order) {
    if (truths.contains(pair.first) || predictions.contains(pair.second)) continue;
    truths.insert(pair.first), predictions.insert(pair.second);
    best.agree += count;
    if (counts.Share(count) < kLeastShare || 2 * count < counts.truths.at(pair.first)) continue;
    ++best.labels;
    if (pair.first == pair.second) continue;
    if (++best.renumbered <= 3)
      best.example += (best.example.empty() ? "" : ", ") + std::to_string(pair.first) + " as " + std::to_string(pair.second);
  }
  return best;
}

LikelyMistake NumberingMistake(const JointCounts& counts) {
  size_t right = 0, most = 0;
  for (const auto& [label, count] : counts.truths) right += counts.Of(label, label), most = std::max(most, count);
  for (const uint32_t step : {1u, ~0u}) {
    size_t agree = 0, labels = 0;
    for (const auto& [label, count] : counts.truths) {
      const size_t here = counts.Of(label, label + step);
      agree += here;
      labels += 2 * here > count && counts.Share(count) >= kLeastShare;
    }
    if (labels >= 2 && counts.Share(agree) > 0.3 && 5 * right < agree)
      return {"the labels of the predictions are those of the truth " + std::string(step == 1 ? "plus" : "less") + " 1 (" +
                  Percent(counts.Share(agree)) + " of the pixels; " + Percent(counts.Share(right)) +
                  " are right as they are): are labels counted from 0 here and from 1 there?",
              counts.Share(agree) > 0.5};
  }
  const Renumbering best = BestRenumbering(counts);
  // One label for all is as good as this without seeing anything.
  const double share = counts.Share(best.agree), blind = counts.Share(most);
  const std::string text = "the predictions have another numbering of the classes: as they are " + Percent(counts.Share(right)) +
                           " of the pixels are right, renumbered " + Percent(share) + " would be (" + best.example + ")";
  if (best.renumbered >= 3 && 2 * best.renumbered > best.labels && share - blind > 0.4 * (1 - blind) && 5 * right < best.agree)
    return {text, true};
  if (best.renumbered >= 3 && share - blind > 0.5 * (1 - blind) && 1 - share < 0.5 * (1 - counts.Share(right))) return {text, false};
  if (counts.Share(right) < 0.02)
    return {"only " + Percent(counts.Share(right)) +
                " of the pixels are right: are the labels numbered otherwise, or pictures named otherwise?",
            false};
  return {};
}

}  // namespace

LikelyMistake LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height,
                                 uint32_t void_label, bool panorama) {
  const SampleGrid grid(width, height);
  JointCounts counts;
  for (const size_t p : grid.pixels) {
    if (truth[p] == void_label) continue;
    ++counts.pairs[{truth[p], prediction[p]}];
    ++counts.truths[truth[p]];
    ++counts.predictions[prediction[p]];
    ++counts.all;
  }
  if (counts.all < kLeastLabels) return {};
  if (LikelyMistake found = ConstantMistake(counts); !found.text.empty()) return found;
  LikelyMistake numbering = NumberingMistake(counts);
  if (numbering.sure) return numbering;
  const auto errors = [&](const Turn& turn) {
    std::vector<double> all;
    for (size_t p = 0; p < grid.pixels.size(); ++p) {
      const uint32_t t = truth[turn.From(grid, grid.pixels[p])];
      all.push_back(t == void_label ? std::nan("") : t != prediction[grid.pixels[p]]);
    }
    return all;
  };
  const auto same = [&](size_t a, size_t b) { return truth[a] == truth[b]; };
  const internal::LikelyTurn turn = internal::FindTurn(grid, panorama, errors, same);
  if (turn.sure || (!turn.words.empty() && numbering.text.empty()))
    return {"predictions fit far better when they are " + turn.words + ": are they?", turn.sure};
  return numbering;
}

}  // namespace airsim360

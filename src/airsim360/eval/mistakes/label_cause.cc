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

using internal::kNearlyAll;
using internal::SampleGrid;

// Labels of fewer pixels than this share say nothing of the numbering.
constexpr double kLeastShare = 0.005;
// A net predicts classes alone; one that takes each class for another one looks like another numbering. So that is sure where it
// explains nearly all and a part of the pixels have labels that are no class, or where nearly all have.
constexpr double kLeastForeign = 0.1;
bool IsSureNumbering(double explained, double foreign) {
  return foreign >= kNearlyAll || (explained >= kNearlyAll && foreign >= kLeastForeign);
}

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

JointCounts Count(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, const std::vector<size_t>& pixels,
                  uint32_t void_label) {
  std::vector<std::pair<uint32_t, uint32_t>> list;
  for (const size_t p : pixels) {
    if (truth[p] != void_label) list.push_back({truth[p], prediction[p]});
  }
  std::ranges::sort(list);
  JointCounts counts;
  counts.all = list.size();
  for (size_t first = 0; first < list.size();) {
    size_t end = first;
    while (end < list.size() && list[end] == list[first]) ++end;
    counts.pairs[list[first]] = end - first;
    counts.truths[list[first].first] += end - first;
    counts.predictions[list[first].second] += end - first;
    first = end;
  }
  return counts;
}

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100 * share);
  return text;
}

// How much one prediction a class explains: where floor and ceiling are taken for each other the picture is not upside down.
double ShareByClass(const JointCounts& counts) {
  std::map<uint32_t, size_t> most;
  for (const auto& [pair, count] : counts.pairs) most[pair.first] = std::max(most[pair.first], count);
  size_t sum = 0;
  for (const auto& [label, count] : most) sum += count;
  return counts.Share(sum);
}

LikelyMistake ConstantMistake(const JointCounts& counts, double foreign) {
  if (counts.predictions.size() != 1 || counts.truths.size() < 2) return {};
  const uint32_t label = counts.predictions.begin()->first;
  const auto truth = counts.truths.find(label);
  const double right = truth == counts.truths.end() ? 0 : counts.Share(truth->second);
  if (right > 0.5) return {};
  return {"every predicted pixel is " + std::to_string(label) + ", which is right for " + Percent(right) +
              ": is that a label of these classes?",
          foreign > 0};
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

LikelyMistake ShiftMistake(const JointCounts& counts, size_t right, double foreign) {
  for (const uint32_t step : {1u, ~0u}) {
    size_t agree = 0, labels = 0;
    for (const auto& [label, count] : counts.truths) {
      const size_t here = counts.Of(label, label + step);
      agree += here;
      labels += 2 * here > count && counts.Share(count) >= kLeastShare;
    }
    const double share = counts.Share(agree);
    if (labels >= 2 && share > 0.3 && 5 * right < agree)
      return {"the labels of the predictions are those of the truth " + std::string(step == 1 ? "plus" : "less") + " 1 (" + Percent(share) +
                  " of the pixels; " + Percent(counts.Share(right)) +
                  " are right as they are): are labels counted from 0 here and from 1 there?",
              IsSureNumbering(share, foreign)};
  }
  return {};
}

LikelyMistake NumberingMistake(const JointCounts& counts, double foreign) {
  size_t right = 0, most = 0;
  for (const auto& [label, count] : counts.truths) right += counts.Of(label, label), most = std::max(most, count);
  if (LikelyMistake shift = ShiftMistake(counts, right, foreign); !shift.text.empty()) return shift;
  const Renumbering best = BestRenumbering(counts);
  // One label for all is as good as this without seeing anything.
  const double share = counts.Share(best.agree), blind = counts.Share(most);
  const double gain = share - blind;
  const bool clear = 2 * best.renumbered > best.labels && gain > 0.4 * (1 - blind) && 5 * right < best.agree;
  const bool half = gain > 0.5 * (1 - blind) && 1 - share < 0.5 * (1 - counts.Share(right));
  if (best.renumbered >= 3 && (clear || half))
    return {"the predictions have another numbering of the classes: as they are " + Percent(counts.Share(right)) +
                " of the pixels are right, renumbered " + Percent(share) + " would be (" + best.example + ")",
            clear && IsSureNumbering(share, foreign)};
  if (counts.Share(right) < 0.02)
    return {"only " + Percent(counts.Share(right)) +
                " of the pixels are right: are the labels numbered otherwise, or pictures named otherwise?",
            false};
  return {};
}

internal::LikelyTurn LabelTurn(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height,
                               const LabelLook& look) {
  const auto same = [truth](std::span<const size_t> a, std::span<const size_t> b) {
    std::vector<uint8_t> equal;
    equal.reserve(a.size());
    for (size_t i = 0; i < a.size(); ++i) equal.push_back(truth[a[i]] == truth[b[i]]);
    return equal;
  };
  return internal::FindTurn(width, height, look.panorama, [&](const SampleGrid& grid) {
    const auto errors = [&](std::span<const size_t> places) {
      std::vector<double> all;
      all.reserve(places.size());
      for (size_t p = 0; p < places.size(); ++p) {
        const uint32_t t = truth[places[p]];
        all.push_back(t == look.void_label ? std::nan("") : t != prediction[grid.pixels[p]]);
      }
      return all;
    };
    return internal::TurnComparison{errors, same};
  });
}

}  // namespace

LikelyMistake LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height,
                                 const LabelLook& look) {
  const JointCounts counts = Count(prediction, truth, SampleGrid(width, height).pixels, look.void_label);
  if (counts.all < internal::kLeastSamples) return {};
  size_t none = 0;
  for (const auto& [label, count] : counts.predictions) none += look.is_class && !look.is_class(label) ? count : 0;
  const double foreign = counts.Share(none);
  if (LikelyMistake found = ConstantMistake(counts, foreign); !found.text.empty()) return found;
  LikelyMistake numbering = NumberingMistake(counts, foreign);
  if (numbering.sure) return numbering;
  internal::LikelyTurn turn = LabelTurn(prediction, truth, width, height, look);
  turn.sure = turn.sure && 1 - turn.right < 0.6 * (1 - ShareByClass(counts));
  if (turn.sure || (!turn.words.empty() && numbering.text.empty()))
    return {"predictions fit far better when they are " + turn.words + ": are they?", turn.sure};
  return numbering;
}

}  // namespace airsim360

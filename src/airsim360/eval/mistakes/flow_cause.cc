// Optical flow whose axes, sign or unit are others than ours.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/median.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

struct FlowPlace {
  int x, y;
};
struct FlowSize {
  int width, height;
};

// How to get back what was meant: from which pixel, exchanged or not, times what.
struct Remedy {
  const char* words;
  FlowPlace (*from)(FlowPlace p, FlowSize s);
  bool exchange;
  Vec2d (*factors)(FlowSize s);
  bool panorama_only = false;
};
constexpr auto kHere = [](FlowPlace p, FlowSize) { return p; };
constexpr auto kMirrored = [](FlowPlace p, FlowSize s) { return FlowPlace{s.width - 1 - p.x, p.y}; };
constexpr auto kUpsideDown = [](FlowPlace p, FlowSize s) { return FlowPlace{p.x, s.height - 1 - p.y}; };
constexpr auto kHalfTurn = [](FlowPlace p, FlowSize s) { return FlowPlace{(p.x + s.width / 2) % s.width, p.y}; };
constexpr auto kAsTheyAre = [](FlowSize) { return Vec2d{1, 1}; };
constexpr auto kOtherX = [](FlowSize) { return Vec2d{-1, 1}; };
constexpr auto kOtherY = [](FlowSize) { return Vec2d{1, -1}; };
constexpr Remedy kRemedies[] = {
    {"predictions point the other way: are they the flow back from the next picture, or of the other sign?", kHere, false,
     [](FlowSize) {
       return Vec2d{-1, -1};
     }},
    {"predictions fit far better with the other sign of dx: dx grows to the right", kHere, false, kOtherX},
    {"predictions fit far better with the other sign of dy: dy grows downwards", kHere, false, kOtherY},
    {"predictions fit far better when their channels are exchanged: dx comes first, then dy", kHere, true, kAsTheyAre},
    {"predictions are shares of the picture's size: multiply dx by its width and dy by its height", kHere, false,
     [](FlowSize s) {
       return Vec2d{1.0 * s.width, 1.0 * s.height};
     }},
    {"predictions are normalised to -1 ... 1: multiply dx by half the width and dy by half the height", kHere, false,
     [](FlowSize s) {
       return Vec2d{s.width / 2.0, s.height / 2.0};
     }},
    {"predictions are radians: multiply dx by width / 2 pi and dy by height / pi", kHere, false,
     [](FlowSize s) {
       return Vec2d{s.width / (2 * kPi), s.height / kPi};
     },
     true},
    {"predictions are of mirrored pictures: mirror them, and the sign of dx", kMirrored, false, kOtherX},
    {"predictions fit far better when they are mirrored: are they?", kMirrored, false, kAsTheyAre},
    {"predictions are of pictures that were upside down: turn them over, and the sign of dy", kUpsideDown, false, kOtherY},
    {"predictions fit far better when they are turned over: are they upside down?", kUpsideDown, false, kAsTheyAre},
    {"predictions fit far better when they are turned by 180 degrees: is the seam elsewhere?", kHalfTurn, false, kAsTheyAre, true},
};

// Of the probable mistakes.
constexpr double kLikely = 0.5;

struct FlowPictures {
  std::span<const double> prediction, truth;
  FlowSize size;
  bool panorama;

  Vec2d At(std::span<const double> flow, FlowPlace p) const {
    const size_t i = 2 * (static_cast<size_t>(p.y) * static_cast<size_t>(size.width) + static_cast<size_t>(p.x));
    return {flow[i], flow[i + 1]};
  }
  // In panoramas the shorter way round.
  double Apart(Vec2d a, Vec2d b) const {
    const double dx = a.x - b.x, way = panorama ? dx - size.width * std::round(dx / size.width) : dx;
    return std::sqrt(way * way + (a.y - b.y) * (a.y - b.y));
  }
};

// Medians of what a remedy changes; the share of all pixels that are right with it.
struct Undone {
  double before = 0, after = 0, length = 0;
  double uniform = 0;  // error of one flow for all pixels, the medians of the truth's
  double right = 0;
  // Below kLikely it is worth a word.
  double left() const { return before > 0.1 * length ? after / before : 1; }
};

// By one pixel in `step`. Nothing was undone where too few of them change.
Undone Undo(const FlowPictures& pictures, const Remedy& remedy, size_t step) {
  constexpr size_t kLeastChanged = 64;
  constexpr double kChange = 0.2;
  const Vec2d factors = remedy.factors(pictures.size);
  const auto width = static_cast<size_t>(pictures.size.width), pixels = width * static_cast<size_t>(pictures.size.height);
  std::vector<double> straight, mended, lengths, dx, dy, all_mended, all_lengths;
  for (size_t i = 0; i < pixels; i += step) {
    const FlowPlace here{static_cast<int>(i % width), static_cast<int>(i / width)};
    const Vec2d g = pictures.At(pictures.truth, here), p = pictures.At(pictures.prediction, here);
    Vec2d q = pictures.At(pictures.prediction, remedy.from(here, pictures.size));
    if (remedy.exchange) std::swap(q.x, q.y);
    q = {q.x * factors.x, q.y * factors.y};
    const double length = std::sqrt(g.x * g.x + g.y * g.y);
    if (!std::isfinite(length + p.x + p.y + q.x + q.y) || length == 0) continue;
    all_mended.push_back(pictures.Apart(q, g));
    all_lengths.push_back(length);
    dx.push_back(g.x);
    dy.push_back(g.y);
    if (pictures.Apart(p, q) < kChange * length) continue;
    straight.push_back(pictures.Apart(p, g));
    mended.push_back(all_mended.back());
    lengths.push_back(length);
  }
  if (straight.size() < std::max(kLeastChanged, all_mended.size() / 10)) return {};
  Undone undone{UpperMedian(straight), UpperMedian(mended), UpperMedian(lengths)};
  if (undone.left() >= kLikely) return undone;
  const double usual = UpperMedian(all_lengths);
  const Vec2d middle{UpperMedian(dx), UpperMedian(dy)};
  std::vector<double> from_middle;
  for (size_t i = 0; i < all_mended.size(); ++i) {
    undone.right += all_mended[i] < 0.25 * std::max(usual, all_lengths[i]) ? 1.0 / static_cast<double>(all_mended.size()) : 0;
    from_middle.push_back(pictures.Apart({dx[i], dy[i]}, middle));
  }
  undone.uniform = UpperMedian(std::move(from_middle));
  return undone;
}

}  // namespace

LikelyMistake LikelyFlowMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height, bool panorama) {
  constexpr size_t kFew = 2000, kMany = 20000;
  const FlowPictures pictures{prediction, truth, {width, height}, panorama};
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  // Odd, so that all columns are met.
  const auto step = [pixels](size_t samples) { return std::max<size_t>(1, pixels / samples) | 1; };
  LikelyMistake likely;
  double least = kLikely;
  for (const Remedy& remedy : kRemedies) {
    if (remedy.panorama_only && !panorama) continue;
    if (Undo(pictures, remedy, step(kFew)).left() >= 0.6) continue;
    const Undone undone = Undo(pictures, remedy, step(kMany));
    if (undone.left() >= least) continue;
    least = undone.left();
    // A flow that is nearly the same everywhere is met by chance.
    likely = {remedy.words, least < 0.3 && undone.right >= internal::kNearlyAll && undone.after < 0.5 * undone.uniform};
  }
  return likely;
}

}  // namespace airsim360

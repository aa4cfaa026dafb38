// Predictions that are merely bad are scored, whatever they look like. Scenes and predictions are drawn by seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360 {
namespace {

constexpr int kWide = 256, kHigh = 128;
constexpr size_t kArea = size_t{kWide} * kHigh;
using Field = std::vector<double>;
using Labels = std::vector<uint32_t>;

class Draws {
 public:
  explicit Draws(uint32_t seed) : random_(seed) {}
  double Uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double Normal() { return normal_(random_); }
  int Whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool Coin(double share = 0.5) { return Uniform(0, 1) < share; }
  std::mt19937& random() { return random_; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0, 1};
};

size_t Place(int x, int y) { return static_cast<size_t>(y) * kWide + static_cast<size_t>((x % kWide + kWide) % kWide); }

// Waves of a few periods around and down, with a mean of 0 and a deviation of about 1.
Field Smooth(Draws& draws) {
  Field field(kArea, 0);
  for (int wave = 0; wave < 4; ++wave) {
    const int around = draws.Whole(0, 4);
    const double down = draws.Uniform(0, 4), phase = draws.Uniform(0, 7), size = draws.Normal() * 0.7;
    std::vector<double> cosines, sines;  // of the angle around
    for (int x = 0; x < kWide; ++x) {
      const double angle = 2 * std::numbers::pi * around * (x + 0.5) / kWide + phase;
      cosines.push_back(std::cos(angle)), sines.push_back(std::sin(angle));
    }
    for (int y = 0; y < kHigh; ++y) {
      const double angle = 2 * std::numbers::pi * down * (y + 0.5) / kHigh, c = size * std::cos(angle), s = size * std::sin(angle);
      for (size_t x = 0; x < kWide; ++x) field[static_cast<size_t>(y) * kWide + x] += c * cosines[x] - s * sines[x];
    }
  }
  return field;
}

// Blocks of a few columns and rows before something.
struct Block {
  int x, y, width, height;
  double distance;
  bool Covers(int px, int py) const { return (px - x + kWide) % kWide < width && py >= y && py < y + height; }
};
std::vector<Block> Blocks(Draws& draws) {
  std::vector<Block> blocks(static_cast<size_t>(draws.Whole(0, 8)));
  for (Block& b : blocks)
    b = {draws.Whole(0, kWide - 1), draws.Whole(20, 90), draws.Whole(4, 70), draws.Whole(4, 60), std::exp(draws.Uniform(0, 3))};
  return blocks;
}

// A room or a street with blocks in it; the sky of a street is 0.
Field Scene(Draws& draws) {
  const double a = draws.Uniform(2, 6), b = draws.Uniform(2, 6), h = draws.Uniform(1, 3);
  const bool street = draws.Coin();
  const std::vector<Block> blocks = Blocks(draws);
  Field scene(kArea);
  for (int y = 0; y < kHigh; ++y) {
    const double phi = std::numbers::pi * (0.5 - (y + 0.5) / kHigh);
    for (int x = 0; x < kWide; ++x) {
      const double theta = 2 * std::numbers::pi * (x + 0.5) / kWide, right = std::cos(phi) * std::sin(theta),
                   ahead = std::cos(phi) * std::cos(theta), up = std::sin(phi);
      double& range = scene[Place(x, y)];
      range = street ? (up < 0 ? std::min(80.0, h / -up) : 0) : 1 / std::max({std::abs(right) / a, std::abs(ahead) / b, std::abs(up) / h});
      for (const Block& block : blocks) {
        if (block.Covers(x, y) && (range == 0 || range > block.distance)) range = block.distance;
      }
    }
  }
  return scene;
}

Field Blurred(const Field& field, int reach) {
  Field blurred(kArea);
  for (int y = 0; y < kHigh; ++y) {
    double sum = 0;
    for (int d = -reach; d <= reach; ++d) sum += field[Place(d, y)];
    for (int x = 0; x < kWide; ++x) {
      blurred[Place(x, y)] = std::max(0.0, sum / (2 * reach + 1));
      sum += field[Place(x + reach + 1, y)] - field[Place(x - reach, y)];
    }
  }
  return blurred;
}

template <class Value>
std::vector<Value> Coarse(const std::vector<Value>& field, int step) {
  std::vector<Value> coarse(kArea);
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) coarse[Place(x, y)] = field[Place(x / step * step, y / step * step)];
  }
  return coarse;
}

Field BadDepth(const Field& truth, Draws& draws) {
  const double largest = *std::ranges::max_element(truth), sky = draws.Coin() ? largest * draws.Uniform(1, 4) : 0;
  Field seen = truth;
  for (double& v : seen) v = v > 0 ? v : sky;
  switch (draws.Whole(0, 8)) {
    case 0:
      break;
    case 1:
      seen = Blurred(seen, draws.Whole(1, 40));
      break;
    case 2:
      seen = Coarse(seen, 1 << draws.Whole(1, 5));
      break;
    case 3:  // another scene
      seen = Scene(draws);
      break;
    case 4: {
      const double spread = draws.Uniform(0, 1.2);
      const Field waves = Smooth(draws);
      for (size_t i = 0; i < kArea; ++i) seen[i] = std::exp(1 + spread * waves[i]);
      break;
    }
    case 5:
      seen.assign(kArea, draws.Coin(0.3) ? 0 : draws.Uniform(0.1, 20));
      break;
    case 6: {  // affine
      const double scale = draws.Uniform(0.1, 2), offset = draws.Uniform(0, 6);
      for (double& v : seen) v = scale * v + offset;
      break;
    }
    case 7: {  // compressed
      const double power = draws.Uniform(0.1, 1.6);
      for (double& v : seen) v = std::pow(v, power);
      break;
    }
    default: {  // a gradient from top to bottom
      const double steep = draws.Normal();
      for (size_t i = 0; i < kArea; ++i)
        seen[i] = 4 * std::exp(steep * std::cos(std::numbers::pi * static_cast<double>(i / kWide) / kHigh));
    }
  }
  const double scale = std::exp(draws.Coin(0.8) ? draws.Uniform(-1.6, 1.6) : draws.Uniform(-4, 4)), noise = draws.Uniform(0, 0.7),
               wavy = draws.Coin() ? draws.Uniform(0, 0.6) : 0;
  const Field waves = Smooth(draws);
  for (size_t i = 0; i < kArea; ++i) seen[i] *= scale * std::exp(noise * draws.Normal() + wavy * waves[i]);
  return seen;
}

TEST(BadPredictions, OfDepthAreNeverRefused) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    Draws draws(seed);
    const Field truth = Scene(draws), prediction = BadDepth(truth, draws);
    const LikelyMistake found = LikelyDepthMistake(prediction, truth, kWide, kHigh);
    EXPECT_FALSE(found.sure) << "seed " << seed << ": " << found.text;
  }
}

// Classes 1 to n.
Labels LabelScene(Draws& draws, uint32_t n) {
  const std::vector<Block> blocks = Blocks(draws);
  Labels scene(kArea);
  const int horizon = draws.Whole(30, 90), wall = draws.Whole(0, 40);
  std::vector<uint32_t> of(blocks.size() + 3);
  for (uint32_t& label : of) label = 1 + static_cast<uint32_t>(draws.Whole(0, static_cast<int>(n) - 1));
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      uint32_t& label = scene[Place(x, y)];
      label = y < horizon - wall ? of[0] : y < horizon ? of[1] : of[2];
      for (size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].Covers(x, y)) label = of[b + 3];
      }
    }
  }
  return scene;
}

Labels BadLabels(const Labels& truth, Draws& draws, uint32_t n) {
  const auto any = [&] { return 1 + static_cast<uint32_t>(draws.Whole(0, static_cast<int>(n) - 1)); };
  std::vector<uint32_t> as(n + 1);
  std::iota(as.begin(), as.end(), 0u);
  Labels seen = truth;
  switch (draws.Whole(0, 7)) {
    case 0:
      break;
    case 1:
      seen = Coarse(seen, 1 << draws.Whole(1, 5));
      break;
    case 2:
      seen = LabelScene(draws, n);
      break;
    case 3:
      seen.assign(kArea, any());
      break;
    case 4:  // each class for the next one, or the one before
      std::rotate(as.begin() + 1, draws.Coin() ? as.begin() + 2 : as.end() - 1, as.end());
      break;
    case 5:
      std::shuffle(as.begin() + 1, as.end(), draws.random());
      break;
    case 6: {  // some classes for others
      const double share = draws.Uniform(0, 1);
      for (uint32_t c = 1; c <= n; ++c) as[c] = draws.Coin(share) ? any() : c;
      break;
    }
    default:  // only where it looks
      for (size_t i = 0; i < kArea; ++i) seen[i] = i / kWide < kArea / kWide / 2 ? seen[i] : 1;
  }
  const double flips = draws.Coin() ? draws.Uniform(0, 1) : 0, silent = draws.Coin(0.2) ? draws.Uniform(0, 0.3) : 0;
  for (uint32_t& label : seen) label = draws.Coin(silent) ? 255 : draws.Coin(flips) ? any() : as[label];
  return seen;
}

TEST(BadPredictions, OfLabelsAreNeverRefused) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    Draws draws(seed);
    const auto n = static_cast<uint32_t>(draws.Whole(2, 40));
    const Labels truth = LabelScene(draws, n), prediction = BadLabels(truth, draws, n);
    const LikelyMistake found = LikelyLabelMistake(prediction, truth, kWide, kHigh, {.is_class = [n](uint32_t id) { return id <= n; }});
    EXPECT_FALSE(found.sure) << "seed " << seed << ": " << found.text;
  }
}

// Of one camera that turns, nearly uniform, or of anything smooth.
Field Flow(Draws& draws) {
  const Field dx = Smooth(draws), dy = Smooth(draws);
  const double size = draws.Uniform(0.2, 9), turn = draws.Coin() ? draws.Normal() * size : 0, rest = turn == 0 ? 1 : draws.Uniform(0, 0.3);
  Field flow;
  for (size_t i = 0; i < kArea; ++i) flow.insert(flow.end(), {turn + rest * size * dx[i], rest * size * dy[i]});
  return flow;
}

Field BadFlow(const Field& truth, Draws& draws) {
  Field seen = truth;
  switch (draws.Whole(0, 6)) {
    case 0:
      break;
    case 1:
    case 2:
      seen = Flow(draws);
      break;
    case 3: {
      const double x = draws.Normal() * 4, y = draws.Normal() * 4;
      for (size_t i = 0; i < kArea; ++i) seen[2 * i] = x, seen[2 * i + 1] = y;
      break;
    }
    case 4:
      seen.assign(2 * kArea, 0);
      break;
    case 5: {
      const double scale = std::exp(draws.Uniform(-4, 2));
      for (double& v : seen) v *= scale;
      break;
    }
    default: {  // off by an angle
      const double c = std::cos(draws.Uniform(-1.2, 1.2)), s = std::sqrt(1 - c * c);
      for (size_t i = 0; i < kArea; ++i) {
        const double x = seen[2 * i], y = seen[2 * i + 1];
        seen[2 * i] = c * x - s * y, seen[2 * i + 1] = s * x + c * y;
      }
    }
  }
  const double noise = draws.Coin() ? draws.Uniform(0, 5) : 0;
  for (double& v : seen) v += noise * draws.Normal();
  return seen;
}

TEST(BadPredictions, OfFlowAreNeverRefused) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    Draws draws(seed);
    const Field truth = Flow(draws), prediction = BadFlow(truth, draws);
    const LikelyMistake found = LikelyFlowMistake(prediction, truth, kWide, kHigh, true);
    EXPECT_FALSE(found.sure) << "seed " << seed << ": " << found.text;
  }
}

}  // namespace
}  // namespace airsim360

#include "airsim360/eval/mistakes/likely_cause.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace airsim360 {
namespace {

constexpr int kWidth = 256, kHeight = 128;
constexpr size_t kPixels = size_t{kWidth} * kHeight;

struct Ray {
  double right, up, forward;
};
Ray RayOf(int x, int y) {
  const double theta = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5), phi = std::numbers::pi * (0.5 - (y + 0.5) / kHeight);
  return {std::cos(phi) * std::sin(theta), std::sin(phi), std::cos(phi) * std::cos(theta)};
}

template <class Value>
std::vector<Value> Panorama(const std::function<Value(int x, int y)>& of) {
  std::vector<Value> values;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) values.push_back(of(x, y));
  }
  return values;
}

// A floor that fills the lower half, the same all around, sky above (0), and towers to some sides.
double Street(int x, int y) {
  const Ray ray = RayOf(x, y);
  const double floor = ray.up < 0 ? std::min(60.0, 1.6 / -ray.up) : 0;
  for (const auto [from, to, distance, rows] : {std::array{20, 60, 12, 40}, {90, 100, 5, 55}, {150, 215, 25, 45}}) {
    if (x >= from && x < to && y >= rows && (floor == 0 || floor > distance)) return distance;
  }
  return floor;
}
// A box: wall behind wall, the same when mirrored or turned by half.
double SymmetricRoom(int x, int y) {
  const Ray ray = RayOf(x, y);
  return 1 / std::max({std::abs(ray.right) / 4, std::abs(ray.forward) / 3, std::abs(ray.up) / 1.5});
}

std::vector<double> Noisy(std::vector<double> values, double sigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  for (double& v : values) v *= std::exp(sigma * normal(random));
  return values;
}
std::vector<double> Turned(const std::function<double(int, int)>& truth, const std::function<std::pair<int, int>(int, int)>& from) {
  return Panorama<double>([&](int x, int y) {
    const auto [fx, fy] = from(x, y);
    return truth(fx, fy);
  });
}

// Relative errors of a good net, up to a tenth, leave a mistake sure; at larger ones it is still named.
class LikelyDepth : public ::testing::TestWithParam<double> {
 protected:
  static bool Good() { return GetParam() < 0.2; }
};

TEST_P(LikelyDepth, MistakesAreNamedAndRefusedWhereTheyExplainNearlyAll) {
  const auto truth = Panorama<double>(Street);
  struct Case {
    std::function<std::pair<int, int>(int, int)> from;
    const char* says;
  };
  for (const auto& [from, says] :
       {Case{[](int x, int y) { return std::pair(kWidth - 1 - x, y); }, "mirrored left to right"},
        Case{[](int x, int y) { return std::pair((x + kWidth / 2) % kWidth, y); }, "180 degrees"},
        Case{[](int x, int y) { return std::pair((x + kWidth - kWidth / 4) % kWidth, y); }, "about 90 degrees to the right"},
        Case{[](int x, int y) { return std::pair((x + 20) % kWidth, y); }, "about 28 degrees to the left"},
        Case{[](int x, int y) { return std::pair(x, kHeight - 1 - y); }, "upside down"}}) {
    const LikelyMistake found = LikelyDepthMistake(Noisy(Turned(Street, from), GetParam()), truth, kWidth, kHeight);
    EXPECT_EQ(found.sure, Good()) << says;
    EXPECT_NE(found.text.find(says), std::string::npos) << says << " as " << found.text;
  }
  const auto room = Panorama<double>(SymmetricRoom);
  for (const bool horizontal : {false, true}) {
    std::vector<double> wrong = room;
    for (size_t i = 0; i < wrong.size(); ++i) {
      const Ray ray = RayOf(static_cast<int>(i % kWidth), static_cast<int>(i / kWidth));
      wrong[i] *=
          horizontal ? std::hypot(ray.right, ray.forward) : std::max({std::abs(ray.right), std::abs(ray.up), std::abs(ray.forward)});
    }
    const LikelyMistake found = LikelyDepthMistake(Noisy(wrong, GetParam()), room, kWidth, kHeight);
    EXPECT_EQ(found.sure, Good());
    EXPECT_NE(found.text.find(horizontal ? "horizontal" : "axis of a cube face"), std::string::npos) << found.text;
  }
}

TEST_P(LikelyDepth, HonestPredictionsAreNot) {
  std::mt19937 random(3);
  for (const auto& scene : {Panorama<double>(Street), Panorama<double>(SymmetricRoom)}) {
    for (const double scale : {0.2, 0.5, 1.0, 2.0, 5.0}) {
      std::vector<double> scaled = scene;
      for (double& v : scaled) v *= scale;
      EXPECT_EQ(LikelyDepthMistake(Noisy(scaled, GetParam()), scene, kWidth, kHeight).text, "") << scale;
    }
    // Enlarged eight times, and blurred along the rows.
    const auto low = Panorama<double>([&](int x, int y) { return scene[static_cast<size_t>((y | 7) * kWidth + (x | 7))]; });
    EXPECT_EQ(LikelyDepthMistake(Noisy(low, GetParam()), scene, kWidth, kHeight).text, "");
    const auto blurred = Panorama<double>([&](int x, int y) {
      double sum = 0;
      for (int d = -9; d <= 9; ++d) sum += scene[static_cast<size_t>(y * kWidth + (x + d + kWidth) % kWidth)] / 19;
      return sum;
    });
    EXPECT_EQ(LikelyDepthMistake(Noisy(blurred, GetParam()), scene, kWidth, kHeight).text, "");
  }
  // A symmetric room looks the same from behind: nothing is said of what makes no difference.
  const auto room = Panorama<double>(SymmetricRoom);
  const auto behind = Turned(SymmetricRoom, [](int x, int y) { return std::pair((x + kWidth / 2) % kWidth, y); });
  EXPECT_EQ(LikelyDepthMistake(Noisy(behind, GetParam()), room, kWidth, kHeight).text, "");
}

INSTANTIATE_TEST_SUITE_P(Noise, LikelyDepth, ::testing::Values(0.0, 0.03, 0.1, 0.3));

TEST(LikelyMistakes, UnitsAreNamedWhereTheSkyIsNought) {
  const auto truth = Panorama<double>(Street);
  const auto times = [&](double factor) {
    auto values = truth;
    for (double& v : values) v *= factor;
    return LikelyDepthMistake(Noisy(values, 0.1), truth, kWidth, kHeight);
  };
  // A constant scale that is no unit may be that of a net.
  for (const auto& [factor, says] : {std::pair{6.0, "another unit"},
                                     {10.0, "another unit"},
                                     {50.0, "another unit"},
                                     {100.0, "centimetres"},
                                     {160.0, "another unit"},
                                     {1000.0, "millimetres"},
                                     {2000.0, "another unit"},
                                     {0.01, "centimetres"}}) {
    const LikelyMistake found = times(factor);
    EXPECT_NE(found.text.find(says), std::string::npos) << factor << found.text;
    EXPECT_NE(found.text.find("--pred-scale"), std::string::npos) << factor;
    EXPECT_EQ(found.sure, std::string_view(says) != "another unit") << factor;
  }
  EXPECT_EQ(times(0.256).text, "");
  auto png = truth;
  for (double& v : png) v *= 0.256;
  EXPECT_NE(LikelyDepthMistake(png, truth, kWidth, kHeight, {true, 0.001}).text.find("--png-scale 0.00390625"), std::string::npos);
}

TEST(LikelyMistakes, WhatIsNoDepthIsNamed) {
  const auto truth = Panorama<double>(SymmetricRoom);
  const double largest = *std::max_element(truth.begin(), truth.end());
  const auto of = [&](const std::function<double(double)>& change) {
    auto values = Noisy(truth, 0.05);
    for (double& v : values) v = change(v);
    return LikelyDepthMistake(values, truth, kWidth, kHeight);
  };
  EXPECT_TRUE(of([](double d) { return 1 / d; }).sure);
  EXPECT_NE(of([](double d) { return 1 / d; }).text.find("inverse"), std::string::npos);
  EXPECT_NE(of([](double d) { return std::log(d); }).text.find("natural logarithm"), std::string::npos);
  EXPECT_NE(of([&](double d) { return std::min(1.0, d / largest); }).text.find("divided by their largest"), std::string::npos);
  EXPECT_TRUE(of([](double d) { return -d; }).sure);
  EXPECT_NE(of([](double d) { return -d; }).text.find("negated"), std::string::npos);
  EXPECT_NE(of([](double d) { return d > 3 ? 1.0 : 2.0; }).text.find("only 2 values"), std::string::npos);
}

TEST(LikelyMistakes, TruthsThatShareTheirLargestAreNamed) {
  auto truth = Panorama<double>(Street);
  EXPECT_EQ(SharedMaximum(Noisy(truth, 0.1), 1e9), "");
  for (double& v : truth) v = v == 0 ? 1000 : v;
  EXPECT_NE(SharedMaximum(truth, 1e9).find("1000"), std::string::npos);
  EXPECT_EQ(SharedMaximum(Noisy(truth, 0.1), 1e9), "");
}

// Sky, wall, floor, a few things upon it.
uint32_t Label(int x, int y) {
  if (y > 70 && x > 30 && x < 70) return 12;
  if (y > 80 && x > 170 && x < 200) return 17;
  if (y > 60 && x > 100 && x < 110) return 20;
  return y < 50 ? 3 : y < 64 ? 5 : 8;
}

bool IsClass(uint32_t id) { return id == 3 || id == 5 || id == 8 || id == 12 || id == 17 || id == 20; }

TEST(LikelyLabels, MistakesAreNamedAndHonestPredictionsAreNot) {
  const auto truth = Panorama<uint32_t>(Label);
  std::mt19937 random(1);
  // `share` of the pixels are of any label of the truth.
  const auto predict = [&](double share, const std::function<uint32_t(int, int)>& of) {
    constexpr std::array<uint32_t, 6> kLabels = {3, 5, 8, 12, 17, 20};
    return Panorama<uint32_t>([&](int x, int y) {
      if (std::uniform_real_distribution<double>(0, 1)(random) >= share) return of(x, y);
      const uint32_t any = kLabels[random() % kLabels.size()];
      for (int i = 0; i < kWidth * kHeight; i += 7) {
        if (truth[static_cast<size_t>(i)] == any) return of(i % kWidth, i / kWidth);
      }
      return any;
    });
  };
  const auto look = [&](const std::vector<uint32_t>& prediction) {
    return LikelyLabelMistake(prediction, truth, kWidth, kHeight, {.is_class = IsClass});
  };
  for (const double share : {0.0, 0.05, 0.3}) {
    struct Case {
      std::function<uint32_t(int, int)> of;
      const char* says;
      bool foreign;  // labels that no net predicts
    };
    for (const auto& [of, says, foreign] : {Case{[](int x, int y) { return Label(kWidth - 1 - x, y); }, "mirrored", false},
                                            Case{[](int x, int y) { return Label((x + kWidth / 2) % kWidth, y); }, "180 degrees", false},
                                            Case{[](int x, int y) { return Label(x, kHeight - 1 - y); }, "upside down", false},
                                            Case{[](int x, int y) { return Label(x, y) + 1; }, "plus 1", true},
                                            Case{[](int x, int y) { return Label(x, y) - 1; }, "less 1", true},
                                            Case{[](int x, int y) { return Label(x, y) * 37 % 101; }, "another numbering", true},
                                            Case{[](int, int) { return 255u; }, "every predicted pixel is 255", true}}) {
      const LikelyMistake found = look(predict(share, of));
      EXPECT_EQ(found.sure, share < 0.1 || foreign) << says << share;
      EXPECT_NE(found.text.find(says), std::string::npos) << says << " as " << found.text;
    }
  }
  for (const double share : {0.0, 0.3, 0.7}) EXPECT_EQ(look(predict(share, Label)).text, "") << share;
  EXPECT_EQ(look(predict(0.1, [](int x, int y) { return Label(x | 7, y | 7); })).text, "");
  // All things are missed.
  EXPECT_EQ(look(predict(0.1, [](int, int y) { return y < 50 ? 3u : y < 64 ? 5u : 8u; })).text, "");
}

}  // namespace
}  // namespace airsim360

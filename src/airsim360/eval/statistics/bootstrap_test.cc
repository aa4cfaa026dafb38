#include "airsim360/eval/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

std::vector<double> Sample(size_t n) {
  RngStream random(3, "sample");
  std::vector<double> values;
  for (size_t i = 0; i < n; ++i) values.push_back(random.Normal());
  return values;
}

auto MeanOf(const std::vector<double>& values) {
  return [&values](std::span<const uint32_t> draws) {
    double sum = 0, count = 0;
    for (size_t i = 0; i < values.size(); ++i) sum += draws[i] * values[i], count += draws[i];
    return std::vector<double>{sum / count, count, std::nan("")};
  };
}

TEST(Bootstrap, OfAMeanIsItsStandardError) {
  const auto values = Sample(400);
  double mean = 0, square = 0;
  for (const double v : values) mean += v / 400, square += v * v / 400;
  const double error = std::sqrt((square - mean * mean) / 400);
  const auto intervals = BootstrapIntervals(400, 4000, 1, MeanOf(values));
  EXPECT_NEAR(intervals[0].low, mean - 1.96 * error, 0.1 * error);
  EXPECT_NEAR(intervals[0].high, mean + 1.96 * error, 0.1 * error);
  EXPECT_EQ(intervals[1].low, 400);
  EXPECT_EQ(intervals[1].high, 400);
  EXPECT_TRUE(std::isnan(intervals[2].low));
}

TEST(Bootstrap, DoesNotDependOnThreads) {
  const auto values = Sample(50);
  std::vector<Interval> one, many;
  {
    const ThreadLimit limit(1);
    one = BootstrapIntervals(50, 200, 9, MeanOf(values));
  }
  many = BootstrapIntervals(50, 200, 9, MeanOf(values));
  EXPECT_EQ(one[0].low, many[0].low);
  EXPECT_EQ(one[0].high, many[0].high);
  EXPECT_THROW(BootstrapIntervals(50, 0, 9, MeanOf(values)), InputError);
  EXPECT_THROW(BootstrapIntervals(0, 10, 9, MeanOf(values)), InputError);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/eval/navigation/path_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

TEST(SuccessByLength, IsTheShareOfTheShortestWay) {
  EXPECT_EQ(SuccessByLength(true, 10, 20), 0.5);
  EXPECT_EQ(SuccessByLength(true, 10, 8), 1);  // shorter than the reference is no more than perfect
  EXPECT_EQ(SuccessByLength(false, 10, 10), 0);
  EXPECT_EQ(SuccessByLength(true, 0, 0), 1);
}

TEST(TimeWarping, APathAlongsideIsItsDistanceAtEveryPoint) {
  std::vector<Vec3d> reference, path;
  for (int i = 0; i < 10; ++i) reference.push_back({1.0 * i, 0, 0}), path.push_back({1.0 * i, 0, 2});
  EXPECT_DOUBLE_EQ(DynamicTimeWarping(path, reference), 20);
  EXPECT_DOUBLE_EQ(NormalizedTimeWarping(path, reference, 4), std::exp(-0.5));
  EXPECT_DOUBLE_EQ(NormalizedTimeWarping(reference, reference, 4), 1);
  EXPECT_DOUBLE_EQ(PathLength(path), 9);
}

TEST(TimeWarping, IsTheLeastOfAllPairings) {
  // A second method: every pairing, by recursion.
  RngStream random(1, "warping");
  std::vector<Vec3d> a, b;
  for (int i = 0; i < 6; ++i) a.push_back({random.Uniform(), random.Uniform(), random.Uniform()});
  for (int i = 0; i < 5; ++i) b.push_back({random.Uniform(), random.Uniform(), random.Uniform()});
  const std::function<double(size_t, size_t)> least = [&](size_t i, size_t j) -> double {
    const double here = Norm(a[i] - b[j]);
    if (i == 0 && j == 0) return here;
    double before = 1e300;
    if (i > 0) before = std::min(before, least(i - 1, j));
    if (j > 0) before = std::min(before, least(i, j - 1));
    if (i > 0 && j > 0) before = std::min(before, least(i - 1, j - 1));
    return here + before;
  };
  EXPECT_NEAR(DynamicTimeWarping(a, b), least(5, 4), 1e-12);
  EXPECT_THROW(DynamicTimeWarping({}, b), InputError);
}

}  // namespace
}  // namespace airsim360

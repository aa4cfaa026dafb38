// Gradients, products and statistics of the network against independent computations.
#include "airsim360/mpde/network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/mpde/matrix/gemm.h"
#include "airsim360/mpde/train.h"

namespace airsim360 {
namespace {

std::vector<PersonPose> Truth(int rows, RngStream& random) {
  std::vector<PersonPose> truth;
  for (int i = 0; i < rows; ++i) truth.push_back({random.Uniform(2, 40), random.Uniform(-3, 3)});
  return truth;
}

template <class Real>
std::vector<Real> Inputs(int count, RngStream& random) {
  std::vector<Real> inputs;
  for (int i = 0; i < count; ++i) inputs.push_back(static_cast<Real>(random.Normal()));
  return inputs;
}

TEST(MpdeNetwork, GradientsAreThoseOfFiniteDifferencesToAMillionth) {
  constexpr int kRows = 10;
  RngStream random(3, "gradients");
  Network<double> network({.inputs = 5, .hidden = 7, .stages = 2, .dropout = 0.25}, 4);
  // Scales and offsets away from where they start, and outputs that matter.
  for (Tensor<double>& tensor : network.tensors()) {
    for (double& value : tensor.value) value += 0.3 * random.Normal();
  }
  const std::vector<double> inputs = Inputs<double>(kRows * 5, random);
  const std::vector<PersonPose> truth = Truth(kRows, random);
  std::vector<double> gradient(kRows * kMpdeOutputs), unused(kRows * kMpdeOutputs);
  const auto loss = [&] { return MpdeLoss<double>(network.Forward(inputs, kRows, 77, false), truth, 0.7, unused); };
  MpdeLoss<double>(network.Forward(inputs, kRows, 77, false), truth, 0.7, gradient);
  network.Backward(gradient);
  int checked = 0;
  for (size_t t = 0; t < network.tensors().size(); ++t) {
    const std::vector<double> exact = network.tensors()[t].gradient;
    for (size_t i = 0; i < exact.size(); ++i) {
      double& value = network.tensors()[t].value[i];
      const double kept = value, step = 1e-5;
      // Fourth order: what is left is of the order of the step's fifth power.
      const auto at = [&](double offset) {
        value = kept + offset;
        return loss();
      };
      const double slope = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
      value = kept;
      EXPECT_NEAR(exact[i], slope, 1e-6 * std::max(std::abs(slope), 1e-3)) << network.tensors()[t].name << " " << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 400);
}

TEST(MpdeNetwork, ProductsAreThoseOfThreeLoopsAtAnySize) {
  RngStream random(1, "products");
  for (const auto& [m, k, n] : {std::array{1, 1, 1}, std::array{13, 7, 17}, std::array{25, 33, 4}, std::array{40, 16, 48}}) {
    const std::vector<float> a = Inputs<float>(m * k, random), b = Inputs<float>(k * n, random);
    std::vector<float> c(static_cast<size_t>(m * n)), turned(b.size()), again(c.size());
    Multiply(a.data(), b.data(), c.data(), m, k, n);
    Transpose(b.data(), turned.data(), k, n);
    Multiply(a.data(), turned.data(), again.data(), m, k, n, true);
    EXPECT_EQ(c, again);
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < n; ++j) {
        double sum = 0;
        for (int p = 0; p < k; ++p) sum += double{a[static_cast<size_t>(i * k + p)]} * b[static_cast<size_t>(p * n + j)];
        EXPECT_NEAR(c[static_cast<size_t>(i * n + j)], sum, 1e-5);
      }
    }
  }
}

TEST(MpdeNetwork, NormalisedUnitsHaveMeanZeroAndRunningStatisticsFollow) {
  // One block deep enough to see: with no stages, scale 1 and offset 0 the entry's units are those of a standardised batch.
  constexpr int kRows = 400;
  RngStream random(2, "statistics");
  Network<float> network({.inputs = 3, .hidden = 8, .stages = 0, .dropout = 0}, 1);
  const std::vector<float> inputs = Inputs<float>(kRows * 3, random);
  for (int i = 0; i < 200; ++i) network.Forward(inputs, kRows, 0);
  const std::vector<float> trained(network.Forward(inputs, kRows, 0).begin(), network.Forward(inputs, kRows, 0).end());
  const std::span<const float> inferred = network.Infer(inputs, kRows);
  for (size_t i = 0; i < inferred.size(); ++i) EXPECT_NEAR(inferred[i], trained[i], 5e-3) << i;
}

TEST(MpdeNetwork, DropoutTakesItsShareAndFollowsItsKey) {
  RngStream random(2, "dropout");
  Network<float> network({.inputs = 4, .hidden = 64, .stages = 1, .dropout = 0.5}, 1);
  const std::vector<float> inputs = Inputs<float>(64 * 4, random);
  const auto run = [&](uint64_t key) {
    const std::span<const float> out = network.Forward(inputs, 64, key, false);
    return std::vector<float>(out.begin(), out.end());
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(MpdeNetwork, ShapesOutOfRangeAreRefused) {
  EXPECT_THROW(Network<float>({.hidden = 0}, 0), InputError);
  EXPECT_THROW(Network<float>({.hidden = 2'000'000'000}, 0), InputError);
  EXPECT_THROW(Network<float>({.dropout = 1}, 0), InputError);
  EXPECT_THROW(Network<float>({.stages = -1}, 0), InputError);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/mpde/network.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/mpde/matrix/gemm.h"

namespace airsim360 {
namespace {

constexpr double kSmallVariance = 1e-5;
constexpr double kMomentum = 0.1;  // of running statistics
constexpr int kGroup = 16;         // columns of one task

void CheckShape(const NetworkShape& shape) {
  const auto check = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw InputError(std::string(name) + ": " + std::to_string(value) + " is not from " + std::to_string(low) + " to " +
                       std::to_string(high));
  };
  check("inputs", shape.inputs, 1, 4096);
  check("hidden", shape.hidden, 1, 4096);
  check("stages", shape.stages, 0, 16);
  check("dropout", shape.dropout, 0, 0.9);
}

}  // namespace

template <class Real>
Network<Real>::Network(const NetworkShape& shape, uint64_t seed) : shape_(shape) {
  CheckShape(shape);
  blocks_.push_back(MakeBlock("entry", shape.inputs));
  for (int i = 0; i < shape.stages; ++i) {
    blocks_.push_back(MakeBlock("stage" + std::to_string(i) + ".first", shape.hidden));
    blocks_.push_back(MakeBlock("stage" + std::to_string(i) + ".second", shape.hidden));
  }
  bridge_ = AddTensor("bridge.weight", shape.hidden, shape.hidden, 0, true, true);
  blocks_.push_back(MakeBlock("exit", shape.hidden));
  head_ = AddTensor("head.weight", shape.hidden, kMpdeOutputs, 0, true, true);
  head_offset_ = AddTensor("head.offset", 1, kMpdeOutputs, 0, true, false);
  // Each weight has a stream of its own, named after it.
  for (Tensor<Real>& tensor : tensors_) {
    if (!tensor.decays) continue;
    RngStream random(seed, "mpde " + tensor.name);
    const double deviation = std::sqrt((tensor.columns == kMpdeOutputs ? 0.1 : 2.0) / tensor.rows);
    for (Real& value : tensor.value) value = static_cast<Real>(deviation * random.Normal());
  }
}

template <class Real>
size_t Network<Real>::AddTensor(const std::string& name, int rows, int columns, Real value, bool learned, bool decays) {
  const size_t size = static_cast<size_t>(rows) * static_cast<size_t>(columns);
  tensors_.push_back({name, rows, columns, std::vector<Real>(size, value), std::vector<Real>(learned ? size : 0), decays});
  return tensors_.size() - 1;
}

template <class Real>
typename Network<Real>::Block Network<Real>::MakeBlock(const std::string& name, int inputs) {
  Block block{};
  block.inputs = inputs;
  block.weight = AddTensor(name + ".weight", inputs, shape_.hidden, 0, true, true);
  block.scale = AddTensor(name + ".scale", 1, shape_.hidden, 1, true, false);
  block.offset = AddTensor(name + ".offset", 1, shape_.hidden, 0, true, false);
  block.mean = AddTensor(name + ".running_mean", 1, shape_.hidden, 0, false, false);
  block.variance = AddTensor(name + ".running_variance", 1, shape_.hidden, 1, false, false);
  return block;
}

template <class Real>
void Network<Real>::Linear(size_t weight, std::span<const Real> inputs, int columns, std::vector<Real>& out) {
  out.resize(static_cast<size_t>(rows_) * static_cast<size_t>(columns));
  Multiply(inputs.data(), tensors_[weight].value.data(), out.data(), rows_, tensors_[weight].rows, columns);
}

template <class Real>
void Network<Real>::LinearBack(size_t weight, const std::vector<Real>& inputs, const std::vector<Real>& out_gradient, int columns,
                               std::vector<Real>& in_gradient) {
  Tensor<Real>& w = tensors_[weight];
  // dW = X^T dY, dX = dY W^T.
  transposed_.resize(inputs.size());
  Transpose(inputs.data(), transposed_.data(), rows_, w.rows);
  Multiply(transposed_.data(), out_gradient.data(), w.gradient.data(), w.rows, rows_, columns);
  in_gradient.resize(inputs.size());
  Multiply(out_gradient.data(), w.value.data(), in_gradient.data(), rows_, columns, w.rows, true);
}

// body(first column, number of columns) for each group of columns; the number is a constant where a group is whole, so that loops over it
// are vectors.
template <class Body>
void EachGroup(int hidden, const Body& body) {
  ParallelFor((hidden + kGroup - 1) / kGroup, [&](int64_t group) {
    const int first = static_cast<int>(group) * kGroup;
    if (first + kGroup <= hidden)
      body(first, std::integral_constant<int, kGroup>());
    else
      body(first, hidden - first);
  });
}

// One group of columns of a block: normalisation, ReLU, dropout.
template <class Real>
template <class Count>
void Network<Real>::Normalise(Block& block, int first, Count columns, bool training) {
  const int hidden = shape_.hidden;
  const auto at = [&](int row) { return static_cast<size_t>(row) * static_cast<size_t>(hidden) + static_cast<size_t>(first); };
  Real mean[kGroup] = {}, inverse[kGroup] = {}, scale[kGroup], offset[kGroup];
  Real* running_mean = &tensors_[block.mean].value[static_cast<size_t>(first)];
  Real* running_variance = &tensors_[block.variance].value[static_cast<size_t>(first)];
  for (int j = 0; j < columns; ++j) {
    mean[j] = running_mean[j], inverse[j] = running_variance[j];
    scale[j] = tensors_[block.scale].value[static_cast<size_t>(first + j)];
    offset[j] = tensors_[block.offset].value[static_cast<size_t>(first + j)];
  }
  // Mean and variance of the batch.
  if (training) {
    std::fill_n(mean, kGroup, Real{0}), std::fill_n(inverse, kGroup, Real{0});
    for (int row = 0; row < rows_; ++row) {
      const Real* linear = &linear_[at(row)];
      for (int j = 0; j < columns; ++j) mean[j] += linear[j];
    }
    for (int j = 0; j < columns; ++j) mean[j] /= static_cast<Real>(rows_);
    for (int row = 0; row < rows_; ++row) {
      const Real* linear = &linear_[at(row)];
      for (int j = 0; j < columns; ++j) inverse[j] += (linear[j] - mean[j]) * (linear[j] - mean[j]);
    }
    for (int j = 0; j < columns; ++j) {
      inverse[j] /= static_cast<Real>(rows_);
      if (!update_statistics_) continue;
      running_mean[j] += static_cast<Real>(kMomentum) * (mean[j] - running_mean[j]);
      const Real unbiased = inverse[j] * static_cast<Real>(rows_) / static_cast<Real>(rows_ - 1);
      running_variance[j] += static_cast<Real>(kMomentum) * (unbiased - running_variance[j]);
    }
  }
  for (int j = 0; j < columns; ++j) {
    inverse[j] = 1 / std::sqrt(inverse[j] + static_cast<Real>(kSmallVariance));
    block.inverse_deviation[static_cast<size_t>(first + j)] = inverse[j];
  }
  // Of 64 random bits four units take 16 each.
  const bool drops = training && shape_.dropout > 0;
  const auto limit = static_cast<uint64_t>(std::lround(shape_.dropout * 65536));
  const Real kept = drops ? 1 / (1 - static_cast<Real>(limit) / 65536) : 1;
  const uint64_t key = MixBits(dropout_key_ + block.weight);
  Real factor[kGroup], normal[kGroup];
  std::fill_n(factor, kGroup, kept);
  for (int row = 0; row < rows_; ++row) {
    for (int four = 0; drops && four < columns; four += 4) {
      uint64_t bits = MixBits(key + at(row) + static_cast<size_t>(four));
      for (int j = four; j < four + 4; ++j, bits >>= 16) factor[j] = (bits & 0xffff) >= limit ? kept : Real{0};
    }
    const Real* linear = &linear_[at(row)];
    Real* output = &block.output[at(row)];
    Real alive[kGroup];
    for (int j = 0; j < columns; ++j) {
      normal[j] = (linear[j] - mean[j]) * inverse[j];
      const Real value = scale[j] * normal[j] + offset[j];
      alive[j] = value > 0 ? factor[j] : Real{0};
      output[j] = value * alive[j];
    }
    if (!training) continue;
    std::copy_n(normal, columns, &block.normal[at(row)]);
    std::copy_n(alive, columns, &block.factor[at(row)]);
  }
}

template <class Real>
void Network<Real>::RunBlock(Block& block, std::span<const Real> inputs, bool training) {
  const size_t size = static_cast<size_t>(rows_) * static_cast<size_t>(shape_.hidden);
  if (training) block.input.assign(inputs.begin(), inputs.end());
  Linear(block.weight, inputs, shape_.hidden, linear_);
  block.output.resize(size);
  block.inverse_deviation.resize(static_cast<size_t>(shape_.hidden));
  if (training) block.normal.resize(size), block.factor.resize(size);
  EachGroup(shape_.hidden, [&](int first, auto columns) { Normalise(block, first, columns, training); });
}

template <class Real>
std::span<const Real> Network<Real>::Run(std::span<const Real> inputs, bool training) {
  RunBlock(blocks_.front(), inputs, training);
  size_t last = 0;
  for (int stage = 0; stage < shape_.stages; ++stage) {
    Block &first = blocks_[static_cast<size_t>(2 * stage + 1)], &second = blocks_[static_cast<size_t>(2 * stage + 2)];
    RunBlock(first, blocks_[last].output, training);
    RunBlock(second, first.output, training);
    for (size_t i = 0; i < second.output.size(); ++i) second.output[i] += blocks_[last].output[i];
    last += 2;
  }
  if (training) bridge_input_ = blocks_[last].output;
  Linear(bridge_, blocks_[last].output, shape_.hidden, bridged_);
  RunBlock(blocks_.back(), bridged_, training);
  Linear(head_, blocks_.back().output, kMpdeOutputs, outputs_);
  for (size_t i = 0; i < outputs_.size(); ++i) outputs_[i] += tensors_[head_offset_].value[i % kMpdeOutputs];
  return outputs_;
}

template <class Real>
std::span<const Real> Network<Real>::Infer(std::span<const Real> inputs, int rows) {
  rows_ = rows;
  return Run(inputs, false);
}

template <class Real>
std::span<const Real> Network<Real>::Forward(std::span<const Real> inputs, int rows, uint64_t dropout_key, bool update_statistics) {
  rows_ = rows, dropout_key_ = MixBits(dropout_key), update_statistics_ = update_statistics;
  return Run(inputs, true);
}

// `gradient` of the block's output becomes that of its input.
template <class Real>
void Network<Real>::BlockBack(Block& block, std::vector<Real>& gradient) {
  const int hidden = shape_.hidden;
  EachGroup(hidden, [&](int first, auto columns) {
    Real by_scale[kGroup] = {}, by_offset[kGroup] = {}, rate[kGroup];
    const auto at = [&](int row) { return static_cast<size_t>(row) * static_cast<size_t>(hidden) + static_cast<size_t>(first); };
    for (int row = 0; row < rows_; ++row) {
      Real* slope = &gradient[at(row)];
      const Real *factor = &block.factor[at(row)], *normal = &block.normal[at(row)];
      for (int j = 0; j < columns; ++j) {
        slope[j] *= factor[j];
        by_offset[j] += slope[j];
        by_scale[j] += slope[j] * normal[j];
      }
    }
    for (int j = 0; j < columns; ++j) {
      const auto c = static_cast<size_t>(first + j);
      tensors_[block.scale].gradient[c] = by_scale[j];
      tensors_[block.offset].gradient[c] = by_offset[j];
      rate[j] = tensors_[block.scale].value[c] * block.inverse_deviation[c];
      by_scale[j] /= static_cast<Real>(rows_), by_offset[j] /= static_cast<Real>(rows_);
    }
    for (int row = 0; row < rows_; ++row) {
      Real* slope = &gradient[at(row)];
      const Real* normal = &block.normal[at(row)];
      for (int j = 0; j < columns; ++j) slope[j] = rate[j] * (slope[j] - by_offset[j] - normal[j] * by_scale[j]);
    }
  });
  std::vector<Real> input_gradient;
  LinearBack(block.weight, block.input, gradient, hidden, input_gradient);
  gradient = std::move(input_gradient);
}

template <class Real>
void Network<Real>::Backward(std::span<const Real> output_gradient) {
  std::vector<Real> outer(output_gradient.begin(), output_gradient.end()), gradient;
  std::vector<Real>& by_offset = tensors_[head_offset_].gradient;
  std::fill(by_offset.begin(), by_offset.end(), Real{0});
  for (size_t i = 0; i < outer.size(); ++i) by_offset[i % kMpdeOutputs] += outer[i];
  LinearBack(head_, blocks_.back().output, outer, kMpdeOutputs, gradient);
  BlockBack(blocks_.back(), gradient);
  LinearBack(bridge_, bridge_input_, std::vector<Real>(gradient), shape_.hidden, gradient);
  for (int stage = shape_.stages - 1; stage >= 0; --stage) {
    std::vector<Real> around = gradient;
    BlockBack(blocks_[static_cast<size_t>(2 * stage + 2)], gradient);
    BlockBack(blocks_[static_cast<size_t>(2 * stage + 1)], gradient);
    for (size_t i = 0; i < gradient.size(); ++i) gradient[i] += around[i];
  }
  BlockBack(blocks_.front(), gradient);
}

template class Network<float>;
template class Network<double>;

}  // namespace airsim360

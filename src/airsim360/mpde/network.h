// The network of monocular pedestrian distance estimation: residual blocks of linear layers, batch normalisation, ReLU and dropout
// (the shape of MonoLoco++, Bertoni, Kreiss, Alahi 2021), with exact gradients written by hand.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace airsim360 {

/// What the four outputs are.
enum MpdeOutput : int { kLogDistance, kLogSpread, kSine, kCosine, kMpdeOutputs };

struct NetworkShape {
  int inputs = 34;
  int hidden = 256;      ///< 1 to 4096
  int stages = 3;        ///< residual stages of two blocks each, 0 to 16
  double dropout = 0.2;  ///< in [0, 0.9]
};

/// A matrix or a row of numbers that belongs to a network.
template <class Real>
struct Tensor {
  std::string name;
  int rows = 0, columns = 0;
  std::vector<Real> value, gradient = {};  ///< by rows; the gradient is empty where nothing is learned (running statistics)
  bool decays = false;                     ///< weights of linear layers do, offsets and scales do not
};

/// Entry, stages, a linear bridge, exit, head; each block is linear (no offset: the normalisation has one), batch normalisation, ReLU,
/// dropout; a stage adds its input to its result. Real is float for use, double to check gradients.
template <class Real>
class Network {
 public:
  /// Random weights (He et al. 2015) that depend on the seed alone. InputError for a shape out of range.
  Network(const NetworkShape& shape, uint64_t seed);

  /// Outputs, kMpdeOutputs a row, of `rows` inputs by running statistics. Valid until the next call.
  std::span<const Real> Infer(std::span<const Real> inputs, int rows);
  /// The same by the statistics of this batch (at least 2 rows), with dropout: which units drop follows from the key. Remembers what
  /// Backward needs; `update_statistics` moves the running ones a tenth of the way.
  std::span<const Real> Forward(std::span<const Real> inputs, int rows, uint64_t dropout_key, bool update_statistics = true);
  /// Sets the gradients of all parameters, given those of the outputs of the last Forward.
  void Backward(std::span<const Real> output_gradient);

  const NetworkShape& shape() const { return shape_; }
  std::vector<Tensor<Real>>& tensors() { return tensors_; }
  const std::vector<Tensor<Real>>& tensors() const { return tensors_; }
  /// Offset of an output of the head.
  Real& bias(MpdeOutput output) { return tensors_.back().value[static_cast<size_t>(output)]; }

 private:
  struct Block {
    size_t weight, scale, offset, mean, variance;  // in tensors_
    int inputs;
    std::vector<Real> input, normal, factor, inverse_deviation, output;
  };
  Block MakeBlock(const std::string& name, int inputs);
  size_t AddTensor(const std::string& name, int rows, int columns, Real value, bool learned, bool decays);
  void AddWeight(const std::string& name, int rows, int columns);
  void Linear(size_t weight, std::span<const Real> inputs, int columns, std::vector<Real>& out);
  void LinearBack(size_t weight, const std::vector<Real>& inputs, const std::vector<Real>& out_gradient, int columns,
                  std::vector<Real>& in_gradient);
  void RunBlock(Block& block, std::span<const Real> inputs, bool training);
  template <class Count>
  void Normalise(Block& block, int first, Count columns, bool training);
  void BlockBack(Block& block, std::vector<Real>& gradient);
  std::span<const Real> Run(std::span<const Real> inputs, bool training);

  NetworkShape shape_;
  std::vector<Tensor<Real>> tensors_;
  std::vector<Block> blocks_;
  size_t bridge_ = 0, head_ = 0, head_offset_ = 0;
  std::vector<Real> bridged_, bridge_input_, outputs_, transposed_, linear_;
  int rows_ = 0;
  uint64_t dropout_key_ = 0;
  bool update_statistics_ = true;
};

}  // namespace airsim360

// Training of the network of monocular pedestrian distance estimation.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/mpde/model.h"
#include "airsim360/mpde/virtual_cameras.h"

namespace airsim360 {

/// What is trained on: samples as they are, or people who are seen anew each time.
struct MpdeSet {
  std::string name;
  std::vector<MpdeSample> samples = {};
  std::vector<PersonShape> shapes = {};  ///< used if there are no samples
  ViewDraw draw = {};                    ///< cameras of shapes
  double share = 1;                      ///< of the batches, relative to the other sets; above 0

  size_t size() const { return samples.empty() ? shapes.size() : samples.size(); }
};

/// The paper's: AdamW at 0.002, decay 0.01, x 0.98 every 300 steps.
struct MpdeTraining {
  MpdeEncoding encoding = MpdeEncoding::kShape;
  NetworkShape network;
  uint64_t steps = 4000;
  uint64_t batch = 512;
  double rate = 0.002, decay = 0.01;
  double rate_factor = 0.98;
  uint64_t rate_steps = 300;  ///< the rate is multiplied by rate_factor after so many
  double angle_weight = 1;    ///< of the orientation's loss beside the distance's
  double jitter = 0;          ///< keypoint noise on samples that are given as they are, share of the person's height
  double shift = 0;           ///< they are moved along the ground too: standard deviation of the logarithm of the distance
  uint64_t seed = 0;

  void Visit(ConfigVisitor& v);
};

/// Loss of a batch: |1 - d / d*| exp(-s) + s of the distance d (Laplace distribution of relative scale exp(s)), and weight times
/// |sin - sin*| + |cos - cos*| of the angle; mean over the rows. `outputs` and `gradient`: kMpdeOutputs a row; the gradient is set.
template <class Real>
Real MpdeLoss(std::span<const Real> outputs, std::span<const PersonPose> truth, double angle_weight, std::span<Real> gradient);

/// AdamW (Loshchilov and Hutter 2019) on all tensors that learn.
class AdamW {
 public:
  explicit AdamW(const Network<float>& network);
  void Step(Network<float>& network, double rate, double decay);

 private:
  std::vector<std::vector<float>> first_, second_;
  uint64_t steps_ = 0;
};

/// What a batch row is: set by share, entry and view by lot. A pure function of its arguments.
MpdeSample DrawSample(std::span<const MpdeSet> sets, const MpdeTraining& training, uint64_t step, uint64_t row);

/// Trains from scratch. Every number follows from the arguments, whatever the number of threads. `progress` is called after each step
/// with its loss. InputError if a set is empty, a share is not above 0, or an option is out of range.
MpdeModel TrainMpde(std::span<const MpdeSet> sets, const MpdeTraining& training,
                    const std::function<void(uint64_t step, double loss)>& progress = {});

}  // namespace airsim360

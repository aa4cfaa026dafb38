#include "airsim360/mpde/train.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

constexpr uint64_t kRowsOfTask = 32;

void CheckTraining(std::span<const MpdeSet> sets, const MpdeTraining& training) {
  if (sets.empty()) throw InputError("training: no data");
  for (const MpdeSet& set : sets) {
    if (set.size() == 0) throw InputError(set.name + ": holds nobody to train on");
    if (!(set.share > 0 && std::isfinite(set.share))) throw InputError(set.name + ": its share must be above 0");
    if (set.draw.highest < set.draw.lowest || set.draw.farthest < set.draw.nearest)
      throw InputError(set.name + ": views need highest >= lowest and farthest >= nearest");
  }
  if (training.batch < 2 || training.batch > 65536)
    throw InputError("batch: " + std::to_string(training.batch) + " is not from 2 to 65536");
  if (training.steps < 1 || training.steps > 10'000'000)
    throw InputError("steps: " + std::to_string(training.steps) + " is not from 1 to 10000000");
  if (training.rate_steps < 1) throw InputError("rate_steps: must be at least 1");
}

// A person moved along the ground by a factor of the distance: smaller and nearer the horizon, as seen by a level camera.
void MoveAlongGround(double factor, MpdeSample& sample) {
  double middle = 0;
  for (size_t i = 0; i < sample.rays.size(); i += 2) middle += sample.rays[i] / kMpdeKeypoints;
  for (size_t i = 0; i < sample.rays.size(); i += 2) {
    sample.rays[i] = static_cast<float>(middle + (sample.rays[i] - middle) / factor);
    sample.rays[i + 1] = static_cast<float>(sample.rays[i + 1] / factor);
  }
  sample.truth.distance *= factor;
}

const MpdeSet& PickSet(std::span<const MpdeSet> sets, double at) {
  double total = 0;
  for (const MpdeSet& set : sets) total += set.share;
  at *= total;
  for (const MpdeSet& set : sets) {
    if (at < set.share) return set;
    at -= set.share;
  }
  return sets.back();
}

// Where the untrained network should be: the median distance of the first samples.
float FirstLogDistance(std::span<const MpdeSet> sets, const MpdeTraining& training) {
  std::vector<double> logs;
  for (uint64_t i = 0; i < 512; ++i) logs.push_back(std::log(std::max(DrawSample(sets, training, 0, i).truth.distance, 0.01)));
  std::ranges::nth_element(logs, logs.begin() + 256);
  return static_cast<float>(logs[256]);
}

}  // namespace

void MpdeTraining::Visit(ConfigVisitor& v) {
  v.Field("encoding", "how keypoints enter the network: as rays (MonoLoco), or place, size and shape", encoding, kMpdeEncodingNames);
  v.Count("hidden", "width of the network (256)", network.hidden, 4096);
  v.Count("stages", "residual stages of two blocks (3)", network.stages, 16);
  v.Field("dropout", "share of units that drop out in training", network.dropout, 0, 0.9);
  v.Field("steps", "batches", steps);
  v.Field("batch", "samples in each", batch);
  v.Field("rate", "of AdamW", rate, 1e-7, 1);
  v.Field("decay", "weight decay", decay, 0, 1);
  v.Field("rate_factor", "times which the rate goes every rate_steps", rate_factor, 0.01, 1);
  v.Field("rate_steps", "steps between", rate_steps);
  v.Field("angle_weight", "of the orientation's loss beside the distance's", angle_weight, 0, 100);
  v.Field("jitter", "keypoint noise on samples of files, share of the person's height", jitter, 0, 0.5);
  v.Field("shift", "samples of files move along the ground: deviation of the logarithm of the distance", shift, 0, 2);
}

template <class Real>
Real MpdeLoss(std::span<const Real> outputs, std::span<const PersonPose> truth, double angle_weight, std::span<Real> gradient) {
  const Real share = 1 / static_cast<Real>(truth.size()), weight = static_cast<Real>(angle_weight);
  Real loss = 0;
  for (size_t row = 0; row < truth.size(); ++row) {
    const Real* out = &outputs[row * kMpdeOutputs];
    Real* back = &gradient[row * kMpdeOutputs];
    const Real ratio = std::exp(out[kLogDistance]) / static_cast<Real>(truth[row].distance);
    const Real miss = 1 - ratio, precision = std::exp(-out[kLogSpread]);
    loss += std::abs(miss) * precision + out[kLogSpread];
    back[kLogDistance] = (miss > 0 ? -1 : 1) * ratio * precision * share;
    back[kLogSpread] = (1 - std::abs(miss) * precision) * share;
    const Real sine = out[kSine] - static_cast<Real>(std::sin(truth[row].angle));
    const Real cosine = out[kCosine] - static_cast<Real>(std::cos(truth[row].angle));
    loss += weight * (std::abs(sine) + std::abs(cosine));
    back[kSine] = (sine > 0 ? weight : -weight) * share;
    back[kCosine] = (cosine > 0 ? weight : -weight) * share;
  }
  return loss * share;
}
template float MpdeLoss<float>(std::span<const float>, std::span<const PersonPose>, double, std::span<float>);
template double MpdeLoss<double>(std::span<const double>, std::span<const PersonPose>, double, std::span<double>);

AdamW::AdamW(const Network<float>& network) {
  for (const Tensor<float>& tensor : network.tensors()) {
    first_.emplace_back(tensor.gradient.size());
    second_.emplace_back(tensor.gradient.size());
  }
}

void AdamW::Step(Network<float>& network, double rate, double decay) {
  constexpr double kFirst = 0.9, kSecond = 0.999;
  constexpr float kSmall = 1e-8f;
  ++steps_;
  const double correction =
      std::sqrt(1 - std::pow(kSecond, static_cast<double>(steps_))) / (1 - std::pow(kFirst, static_cast<double>(steps_)));
  const auto step = static_cast<float>(rate * correction);
  // sqrt(v) / sqrt(1 - b2^t) + e, multiplied through.
  const auto small = static_cast<float>(kSmall * std::sqrt(1 - std::pow(kSecond, static_cast<double>(steps_))));
  std::vector<Tensor<float>>& tensors = network.tensors();
  ParallelFor(static_cast<int64_t>(tensors.size()), [&](int64_t t) {
    const auto index = static_cast<size_t>(t);
    Tensor<float>& tensor = tensors[index];
    const float keep = tensor.decays ? static_cast<float>(1 - rate * decay) : 1.0f;
    float *m = first_[index].data(), *v = second_[index].data(), *value = tensor.value.data();
    const float* g = tensor.gradient.data();
    for (size_t i = 0; i < tensor.gradient.size(); ++i) {
      m[i] += static_cast<float>(1 - kFirst) * (g[i] - m[i]);
      v[i] += static_cast<float>(1 - kSecond) * (g[i] * g[i] - v[i]);
      value[i] = keep * value[i] - step * m[i] / (std::sqrt(v[i]) + small);
    }
  });
}

MpdeSample DrawSample(std::span<const MpdeSet> sets, const MpdeTraining& training, uint64_t step, uint64_t row) {
  RngStream random(training.seed, "mpde sample", step * training.batch + row);
  const MpdeSet& set = PickSet(sets, random.Uniform());
  const uint32_t entry = random.Index(static_cast<uint32_t>(set.size()));
  const bool mirror = random.Chance(0.5);
  if (set.samples.empty()) {
    const MpdeSample seen = DrawView(set.shapes[entry], set.draw, random);
    return mirror ? Mirrored(seen) : seen;
  }
  MpdeSample sample = set.samples[entry];
  if (training.shift > 0) MoveAlongGround(std::exp(training.shift * random.Normal()), sample);
  if (training.jitter > 0) AddKeypointNoise({.noise = training.jitter, .noise_px = 0}, random, sample.rays);
  return mirror ? Mirrored(sample) : sample;
}

MpdeModel TrainMpde(std::span<const MpdeSet> sets, const MpdeTraining& training,
                    const std::function<void(uint64_t step, double loss)>& progress) {
  CheckTraining(sets, training);
  NetworkShape shape = training.network;
  shape.inputs = InputCount(training.encoding);
  MpdeModel model(training.encoding, shape, training.seed);
  model.network.bias(kLogDistance) = FirstLogDistance(sets, training);
  AdamW optimiser(model.network);
  const auto width = static_cast<size_t>(shape.inputs);
  std::vector<float> inputs(training.batch * width), gradient(training.batch * kMpdeOutputs);
  std::vector<PersonPose> truth(training.batch);
  double rate = training.rate;
  for (uint64_t step = 0; step < training.steps; ++step) {
    ParallelFor(static_cast<int64_t>((training.batch + kRowsOfTask - 1) / kRowsOfTask), [&](int64_t task) {
      const uint64_t first = static_cast<uint64_t>(task) * kRowsOfTask;
      for (uint64_t row = first; row < std::min(first + kRowsOfTask, training.batch); ++row) {
        const MpdeSample sample = DrawSample(sets, training, step, row);
        truth[row] = sample.truth;
        Encode(sample.rays, training.encoding, std::span(inputs).subspan(row * width, width));
      }
    });
    const std::span<const float> outputs = model.network.Forward(inputs, static_cast<int>(training.batch), MixBits(training.seed) + step);
    const float loss = MpdeLoss<float>(outputs, truth, training.angle_weight, gradient);
    if (!std::isfinite(loss)) throw RuntimeError("training: the loss is no number at step " + std::to_string(step) + "; take a lower rate");
    model.network.Backward(gradient);
    optimiser.Step(model.network, rate, training.decay);
    if ((step + 1) % training.rate_steps == 0) rate *= training.rate_factor;
    if (progress) progress(step, loss);
  }
  return model;
}

}  // namespace airsim360

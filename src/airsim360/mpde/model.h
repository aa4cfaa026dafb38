// A trained network with what it takes to use it, and its file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "airsim360/mpde/network.h"
#include "airsim360/mpde/sample.h"

namespace airsim360 {

struct MpdeModel {
  MpdeEncoding encoding = MpdeEncoding::kShape;
  Network<float> network;
  std::string training = {};  ///< what it was trained on and how, JSON

  MpdeModel(MpdeEncoding e, const NetworkShape& shape, uint64_t seed) : encoding(e), network(shape, seed) {}
};

struct MpdePrediction {
  PersonPose pose;
  double spread_m = 0;  ///< scale of the Laplace distribution of the distance: half of the errors are below 0.69 of it
};

/// One prediction a sample. Runs on all threads; the bits do not depend on them.
std::vector<MpdePrediction> Predict(MpdeModel& model, std::span<const MpdeSample> samples);

/// Mean of the predictions of several models: distances by their logarithms, angles by their directions.
std::vector<MpdePrediction> PredictTogether(std::span<MpdeModel> models, std::span<const MpdeSample> samples);

/// safetensors: the tensors by their names, float32, and in __metadata__ format, hidden, stages, dropout, encoding, training.
void WriteMpdeModel(const MpdeModel& model, const std::filesystem::path& file);
/// InputError naming the file and what is wrong with it: not of this kind, cut off, other shapes, numbers that are not finite.
MpdeModel ReadMpdeModel(const std::filesystem::path& file);

}  // namespace airsim360

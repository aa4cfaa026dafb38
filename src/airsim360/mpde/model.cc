#include "airsim360/mpde/model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

using OrderedJson = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "safetensors is little-endian");

constexpr const char* kFormat = "airsim360-mpde-1";
constexpr size_t kInferenceRows = 512;
constexpr uint64_t kLargestHeader = 1 << 20, kLargestFile = uint64_t{2} << 30;
constexpr float kFarthestLog = 7;  // 1.1 km: what no camera tells from farther away

MpdePrediction PredictionOf(std::span<const float> out) {
  const double distance = std::exp(std::clamp(out[kLogDistance], -kFarthestLog, kFarthestLog));
  const double spread = distance * std::exp(std::clamp(out[kLogSpread], -kFarthestLog, kFarthestLog));
  return {{distance, std::atan2(out[kSine], out[kCosine])}, spread};
}

[[noreturn]] void Refuse(const std::filesystem::path& file, const std::string& what) { throw InputError(file.string() + ": " + what); }

// Header and data of a safetensors file.
struct Parts {
  OrderedJson header;
  std::span<const std::byte> data;
};

Parts Split(const Bytes& bytes, const std::filesystem::path& file) {
  uint64_t length = 0;
  if (bytes.size() < sizeof length) Refuse(file, "is no safetensors file: it has " + std::to_string(bytes.size()) + " bytes");
  std::memcpy(&length, bytes.data(), sizeof length);
  if (length > kLargestHeader || length > bytes.size() - sizeof length)
    Refuse(file, "is no safetensors file, or is cut off: a header of " + std::to_string(length) + " bytes");
  const std::string_view text = AsText(std::span(bytes).subspan(sizeof length, length));
  // Depth first: the parser recurses.
  if (std::ranges::count(text, '[') + std::ranges::count(text, '{') > 10000) Refuse(file, "its header nests too deeply");
  Parts parts{OrderedJson::parse(text, nullptr, false), std::span(bytes).subspan(sizeof length + length)};
  if (!parts.header.is_object()) Refuse(file, "its header is no JSON object");
  return parts;
}

std::string Entry(const OrderedJson& metadata, const char* key, const std::filesystem::path& file) {
  if (!metadata.is_object() || !metadata.contains(key) || !metadata[key].is_string())
    Refuse(file, std::string("__metadata__ lacks '") + key + "': it is no model of `airsim360 mpde train`");
  return metadata[key];
}

double Number(const OrderedJson& metadata, const char* key, const std::filesystem::path& file) {
  const std::string text = Entry(metadata, key, file);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(std::abs(value) < 1e6))
    Refuse(file, std::string(key) + ": '" + text.substr(0, 40) + "' is no number in range");
  return value;
}

void Fill(Tensor<float>& tensor, const Parts& parts, const std::filesystem::path& file) {
  const auto found = parts.header.find(tensor.name);
  if (found == parts.header.end()) Refuse(file, "tensor '" + tensor.name + "' is missing");
  const uint64_t size = tensor.value.size() * sizeof(float);
  const OrderedJson& entry = *found;
  if (!entry.is_object() || entry.value("dtype", OrderedJson()) != "F32" ||
      entry.value("shape", OrderedJson()) != OrderedJson{tensor.rows, tensor.columns})
    Refuse(file, "tensor '" + tensor.name + "': must be F32 of shape [" + std::to_string(tensor.rows) + ", " +
                     std::to_string(tensor.columns) + "]");
  const OrderedJson offsets = entry.value("data_offsets", OrderedJson());
  if (!offsets.is_array() || offsets.size() != 2 || !offsets[0].is_number_unsigned() || !offsets[1].is_number_unsigned())
    Refuse(file, "tensor '" + tensor.name + "': data_offsets must be two numbers");
  const uint64_t begin = offsets[0], end = offsets[1];
  if (end < begin || end - begin != size || end > parts.data.size())
    Refuse(file, "tensor '" + tensor.name + "': data_offsets [" + std::to_string(begin) + ", " + std::to_string(end) + "] are not " +
                     std::to_string(size) + " bytes of the " + std::to_string(parts.data.size()) + " there are");
  std::memcpy(tensor.value.data(), parts.data.data() + begin, size);
  if (!std::ranges::all_of(tensor.value, [](float v) { return std::isfinite(v); }))
    Refuse(file, "tensor '" + tensor.name + "': holds numbers that are not finite");
}

}  // namespace

std::vector<MpdePrediction> Predict(MpdeModel& model, std::span<const MpdeSample> samples) {
  const auto width = static_cast<size_t>(model.network.shape().inputs);
  std::vector<MpdePrediction> predictions;
  std::vector<float> inputs;
  for (size_t first = 0; first < samples.size(); first += kInferenceRows) {
    const size_t rows = std::min(kInferenceRows, samples.size() - first);
    inputs.resize(rows * width);
    for (size_t row = 0; row < rows; ++row)
      Encode(samples[first + row].rays, model.encoding, std::span(inputs).subspan(row * width, width));
    const std::span<const float> outputs = model.network.Infer(inputs, static_cast<int>(rows));
    for (size_t row = 0; row < rows; ++row) predictions.push_back(PredictionOf(outputs.subspan(row * kMpdeOutputs, kMpdeOutputs)));
  }
  return predictions;
}

std::vector<MpdePrediction> PredictTogether(std::span<MpdeModel> models, std::span<const MpdeSample> samples) {
  struct Sum {
    double log_distance = 0, log_spread = 0, sine = 0, cosine = 0;
  };
  std::vector<Sum> sums(samples.size());
  for (MpdeModel& model : models) {
    const std::vector<MpdePrediction> predictions = Predict(model, samples);
    for (size_t i = 0; i < samples.size(); ++i) {
      sums[i].log_distance += std::log(predictions[i].pose.distance), sums[i].log_spread += std::log(predictions[i].spread_m);
      sums[i].sine += std::sin(predictions[i].pose.angle), sums[i].cosine += std::cos(predictions[i].pose.angle);
    }
  }
  std::vector<MpdePrediction> mean;
  const auto n = static_cast<double>(models.size());
  for (const Sum& sum : sums)
    mean.push_back({{std::exp(sum.log_distance / n), std::atan2(sum.sine, sum.cosine)}, std::exp(sum.log_spread / n)});
  return mean;
}

void WriteMpdeModel(const MpdeModel& model, const std::filesystem::path& file) {
  const NetworkShape& shape = model.network.shape();
  OrderedJson header;
  header["__metadata__"] = {{"format", kFormat},
                            {"encoding", kMpdeEncodingNames[static_cast<int>(model.encoding)]},
                            {"hidden", std::to_string(shape.hidden)},
                            {"stages", std::to_string(shape.stages)},
                            {"dropout", std::to_string(shape.dropout)},
                            {"training", model.training}};
  uint64_t offset = 0;
  for (const Tensor<float>& tensor : model.network.tensors()) {
    const uint64_t size = tensor.value.size() * sizeof(float);
    header[tensor.name] = {{"dtype", "F32"}, {"shape", {tensor.rows, tensor.columns}}, {"data_offsets", {offset, offset + size}}};
    offset += size;
  }
  std::string text = header.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  text.resize((text.size() + 7) / 8 * 8, ' ');  // the data begin on 8 bytes
  const uint64_t length = text.size();
  Bytes bytes(sizeof length + text.size());
  std::memcpy(bytes.data(), &length, sizeof length);
  std::memcpy(bytes.data() + sizeof length, text.data(), text.size());
  for (const Tensor<float>& tensor : model.network.tensors()) {
    const auto data = std::as_bytes(std::span(tensor.value));
    bytes.insert(bytes.end(), data.begin(), data.end());
  }
  WriteFileAtomically(file, bytes);
}

MpdeModel ReadMpdeModel(const std::filesystem::path& file) {
  const Bytes bytes = ReadFile(file, kLargestFile);
  const Parts parts = Split(bytes, file);
  const OrderedJson metadata = parts.header.value("__metadata__", OrderedJson());
  if (Entry(metadata, "format", file) != kFormat)
    Refuse(file, "format '" + Entry(metadata, "format", file).substr(0, 40) + "' is not " + kFormat);
  const std::string encoding = Entry(metadata, "encoding", file);
  const auto known = std::ranges::find(kMpdeEncodingNames, encoding);
  if (known == std::end(kMpdeEncodingNames)) Refuse(file, "encoding: '" + encoding.substr(0, 40) + "' is neither rays nor shape");
  const auto kind = static_cast<MpdeEncoding>(known - std::begin(kMpdeEncodingNames));
  NetworkShape shape;
  shape.inputs = InputCount(kind);
  shape.hidden = static_cast<int>(Number(metadata, "hidden", file));
  shape.stages = static_cast<int>(Number(metadata, "stages", file));
  shape.dropout = Number(metadata, "dropout", file);
  // More numbers than the file can hold are refused before memory is taken for them.
  const double numbers = 1.0 * shape.hidden * shape.hidden * (2.0 * shape.stages + 2);
  if (numbers * sizeof(float) > static_cast<double>(bytes.size())) Refuse(file, "hidden and stages ask for more tensors than it holds");
  MpdeModel model(kind, shape, 0);
  model.training = Entry(metadata, "training", file);
  for (Tensor<float>& tensor : model.network.tensors()) Fill(tensor, parts, file);
  return model;
}

}  // namespace airsim360

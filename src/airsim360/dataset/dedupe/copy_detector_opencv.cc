// The one file that knows OpenCV; copy_detector_none.cc stands in for it where OpenCV's DNN is not installed.
#include <cmath>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/dedupe/copy_detector.h"
#include "airsim360/dataset/dedupe/onnx_header.h"

namespace airsim360::internal {

struct CopyDetector::Network {
  std::string name;
  cv::dnn::Net net;
  cv::Mat input;

  // One row of numbers.
  std::vector<float> Run();
};

namespace {

constexpr uint64_t kMostModel = uint64_t{1} << 30;  // bytes
constexpr size_t kMostMemory = size_t{4} << 30;     // bytes between the layers
constexpr int kMostNumbers = 16384;
constexpr float kMean[3] = {0.485f, 0.456f, 0.406f}, kDeviation[3] = {0.229f, 0.224f, 0.225f};

// OpenCV's reason, on one line.
std::string ReasonOf(const std::exception& error) {
  const auto* own = dynamic_cast<const cv::Exception*>(&error);
  std::string reason = own ? own->err : error.what();
  for (char& c : reason) c = c == '\n' || c == '\r' ? ' ' : c;
  return reason.substr(0, 240);
}

std::string SizeText(const cv::Mat& array) {
  std::string text;
  for (int i = 0; i < array.dims; ++i) text += (i > 0 ? " x " : "") + std::to_string(array.size[i]);
  return text;
}

}  // namespace

std::vector<float> CopyDetector::Network::Run() {
  cv::Mat row;
  try {
    net.setInput(input);
    row = net.forward();
  } catch (const std::exception& error) {
    throw InputError(name + ": OpenCV cannot run this network: " + ReasonOf(error));
  }
  if (row.type() != CV_32F || row.dims != 2 || row.size[0] != 1 || row.size[1] < 2 || row.size[1] > kMostNumbers)
    throw InputError(name + ": the network gives " + SizeText(row) + ", not one descriptor: 1 x 2 … " + std::to_string(kMostNumbers) +
                     " numbers");
  std::vector<float> numbers(row.ptr<float>(), row.ptr<float>() + row.size[1]);
  for (const float v : numbers) {
    if (!std::isfinite(v)) throw InputError(name + ": the network gives numbers that are not finite");
  }
  return numbers;
}

CopyDetector::CopyDetector(const std::filesystem::path& model) : network_(std::make_unique<Network>()) {
  const Bytes bytes = ReadFile(model, kMostModel);
  const std::string name = network_->name = model.string();
  const OnnxHeader header = ReadOnnxHeader(bytes, name);
  if (header.width > 0) width_ = header.width;
  if (header.height > 0) height_ = header.height;
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(ThreadCount());
  const cv::dnn::MatShape shape = {1, 3, height_, width_};
  size_t weights = 0, between = 0, outputs = 0;
  try {
    network_->net = cv::dnn::readNetFromONNX(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    network_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    outputs = network_->net.getUnconnectedOutLayers().size();
    network_->net.getMemoryConsumption(shape, weights, between);
  } catch (const std::exception& error) {
    throw InputError(name + ": OpenCV " CV_VERSION " cannot read this network of opset " + std::to_string(header.opset) + ": " +
                     ReasonOf(error) + "; export it with opset 9 (torch.onnx.export(…, opset_version=9))");
  }
  if (outputs != 1) throw InputError(name + ": the network has " + std::to_string(outputs) + " outputs, not one descriptor");
  if (between > kMostMemory)
    throw InputError(name + ": the network takes " + std::to_string(between >> 20) + " MiB of memory between its layers; at most " +
                     std::to_string(kMostMemory >> 20));
  network_->input.create(4, shape.data(), CV_32F);
  network_->input.setTo(0);
  network_->Run();
}

CopyDetector::~CopyDetector() = default;

std::vector<float> CopyDetector::Describe(const Image<Rgb8>& picture) {
  float* planes[3];
  for (int c = 0; c < 3; ++c) planes[c] = network_->input.ptr<float>(0, c);
  for (size_t i = 0; i < picture.size(); ++i) {
    const Rgb8 p = picture.pixels()[i];
    const uint8_t values[3] = {p.r, p.g, p.b};
    for (int c = 0; c < 3; ++c) planes[c][i] = (static_cast<float>(values[c]) / 255 - kMean[c]) / kDeviation[c];
  }
  std::vector<float> numbers = network_->Run();
  double square = 0;
  for (const float v : numbers) square += double{v} * double{v};
  for (float& v : numbers) v = square > 0 ? static_cast<float>(v / std::sqrt(square)) : 0;
  return numbers;
}

}  // namespace airsim360::internal

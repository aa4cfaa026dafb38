// Stands in for copy_detector_opencv.cc where OpenCV's DNN is not installed.
#include "airsim360/base/error.h"
#include "airsim360/dataset/dedupe/copy_detector.h"

namespace airsim360::internal {

struct CopyDetector::Network {};

CopyDetector::CopyDetector(const std::filesystem::path&) {
  throw InputError(
      "--method sscd: this program is built without OpenCV's DNN; install libopencv-dnn-dev and build again, or use parallax,hash");
}
CopyDetector::~CopyDetector() = default;
std::vector<float> CopyDetector::Describe(const Image<Rgb8>&) { return {}; }

}  // namespace airsim360::internal

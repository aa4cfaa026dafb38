// A network of the user's that describes pictures so that copies have like descriptors (SSCD: Pizzi et al., "A
// Self-Supervised Descriptor for Image Copy Detection", CVPR 2022), run by OpenCV's DNN.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "airsim360/image/image.h"

namespace airsim360::internal {

class CopyDetector {
 public:
  /// Reads an ONNX file of at most 1 GiB and runs it once on a grey picture. InputError if it is none, if OpenCV does not know
  /// one of its operators, if it does not take one picture (ReadOnnxHeader) or does not give one row of 2 to 16384 finite
  /// numbers; and in a program that was built without OpenCV's DNN.
  explicit CopyDetector(const std::filesystem::path& model);
  ~CopyDetector();
  CopyDetector(const CopyDetector&) = delete;
  CopyDetector& operator=(const CopyDetector&) = delete;

  /// Size of its pictures: that of the file; 320 where the file leaves it open, as the authors of SSCD squeeze pictures.
  int width() const { return width_; }
  int height() const { return height_; }
  /// Descriptor of length 1 (0 where the network gives only zeros) of a picture of that size. Its values are scaled by the
  /// mean and deviation of ImageNet, red first. InputError if the network gives something else than at the start. Not for two
  /// threads at once; it uses all of them. The last digits depend on the processor.
  std::vector<float> Describe(const Image<Rgb8>& picture);

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  int width_ = 320, height_ = 320;
};

}  // namespace airsim360::internal

// The frame whose picture is most like another's, by descriptors of a network.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/dataset/dedupe/copy_detector.h"
#include "airsim360/dataset/export/native_dataset.h"

namespace airsim360::internal {

/// A frame that may be asked for.
struct AlikeFrame {
  size_t position = 0;  ///< in the dataset
  Mat3d R_WC;
  std::string place;  ///< only frames of one place are compared
};

class AlikeSearch {
 public:
  /// `data` must outlive it. InputError as CopyDetector. `frames`: in the order in which they are asked for.
  AlikeSearch(const NativeDataset& data, std::vector<AlikeFrame> frames, const std::filesystem::path& model);

  struct Twin {
    size_t number = 0;      ///< of `frames`
    double similarity = 0;  ///< cosine of the angle between the descriptors
  };
  /// The kept frame of the same place that is most like frame `number`, of equals the one kept first.
  std::optional<Twin> MostAlike(size_t number);
  /// Keeps the frame of the last call of MostAlike.
  void Keep();
  /// Number of pictures that were described.
  int64_t described() const { return described_; }

 private:
  Image<Rgb8> Picture(size_t number);

  struct Kept {
    std::vector<float> descriptors;  // one after the other
    std::vector<size_t> numbers;
  };
  const NativeDataset& data_;
  std::vector<AlikeFrame> frames_;
  CopyDetector detector_;
  std::map<std::string, Kept> kept_;     // by place
  std::map<size_t, Image<Rgb8>> ahead_;  // pictures read ahead, on all threads
  size_t last_ = 0;
  std::vector<float> last_descriptor_;
  int64_t described_ = 0;
};

/// The row of `rows` (as many as fit, each of row.size() numbers) with the largest product with `row`; the first of equals.
/// nullopt without rows. The same result with any number of threads.
std::optional<std::pair<size_t, double>> LargestProduct(std::span<const float> rows, std::span<const float> row);

}  // namespace airsim360::internal

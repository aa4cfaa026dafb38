// Average precision as COCO defines it, of any kind of overlap: masks, boxes, keypoints. Pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace airsim360 {

struct CocoTruth {
  double area = 0;      ///< what the ranges of area are about
  bool crowd = false;   ///< any number of detections may match it; neither right nor wrong
  bool ignore = false;  ///< matches count neither as right nor as wrong
};
struct CocoDetection {
  double score = 0, area = 0;
};
struct CocoOverlap {
  uint32_t truth = 0;
  double value = 0;
};

/// One picture and one category, truths and detections in the order of their files.
struct CocoCell {
  std::vector<CocoTruth> truths;
  std::vector<CocoDetection> detections;
  /// Of each detection with truths, ascending by truth; overlaps below the least threshold may be left out.
  std::vector<std::vector<CocoOverlap>> overlaps;
};

struct CocoOptions {
  std::vector<double> thresholds;            ///< of the overlap
  std::vector<std::array<double, 2>> areas;  ///< ranges, both ends within
  std::vector<size_t> most_detections;       ///< the best so many of a picture and category, ascending
};
/// 0.50, 0.55 … 0.95; all, small (up to 32²), medium, large (from 96²) areas; 1, 10, 100 detections.
CocoOptions StandardCocoOptions();
/// The same for keypoints: all, medium and large; 20 detections.
CocoOptions KeypointCocoOptions();

inline constexpr size_t kRecallSteps = 101;  ///< recalls 0, 0.01 … 1 at which precision is read

/// Precision and recall for every threshold, category, range of area and number of detections; -1 where a category has no
/// truth of that area.
class CocoTable {
 public:
  CocoTable(const CocoOptions& options, size_t categories);
  double& Precision(size_t threshold, size_t recall, size_t category, size_t area, size_t most);
  double& Recall(size_t threshold, size_t category, size_t area, size_t most);

  static constexpr size_t kAll = static_cast<size_t>(-1);
  /// Means over thresholds and categories (or one of them), over what is not -1; -1 if there is nothing.
  double MeanPrecision(size_t threshold, size_t category, size_t area, size_t most) const;
  double MeanRecall(size_t threshold, size_t category, size_t area, size_t most) const;

 private:
  size_t thresholds_, categories_, areas_, mosts_;
  std::vector<double> precision_, recall_;
};

/// Which detections of a cell are right, for every threshold and range of area.
struct CocoMatches {
  std::vector<double> scores;  ///< descending; equal scores in the order of the file
  struct Area {
    size_t truths = 0;             ///< that count
    std::vector<uint8_t> matched;  ///< thresholds x detections
    std::vector<uint8_t> ignored;  ///< neither right nor wrong
  };
  std::vector<Area> areas;  ///< one a range; empty where there is nothing to match
};
/// Detections choose by falling score, each the truth not yet taken with which it overlaps most (of equal ones the last), at
/// least by the threshold; truths that count before those that are ignored.
CocoMatches MatchCoco(const CocoCell& cell, const CocoOptions& options);

/// `matches[image][category]`: the table of all pictures, `draws[image]` times each (empty = once).
CocoTable AccumulateCoco(std::span<const std::vector<CocoMatches>> matches, const CocoOptions& options, size_t categories,
                         std::span<const uint32_t> draws = {});

}  // namespace airsim360

#include "airsim360/eval/coco/summary.h"

#include <cmath>

namespace airsim360 {

std::vector<CocoFigure> InstanceFigures(const CocoOptions& options) {
  const size_t last = options.most_detections.size() - 1;
  std::vector<CocoFigure> figures = {{"ap", true, 0, 0, last},       {"ap50", true, 0.5, 0, last},    {"ap75", true, 0.75, 0, last},
                                     {"ap_small", true, 0, 1, last}, {"ap_medium", true, 0, 2, last}, {"ap_large", true, 0, 3, last}};
  for (size_t m = 0; m <= last; ++m) figures.push_back({"ar" + std::to_string(options.most_detections[m]), false, 0, 0, m});
  figures.push_back({"ar_small", false, 0, 1, last});
  figures.push_back({"ar_medium", false, 0, 2, last});
  figures.push_back({"ar_large", false, 0, 3, last});
  return figures;
}

std::vector<CocoFigure> KeypointFigures() {
  std::vector<CocoFigure> figures;
  for (const bool precision : {true, false}) {
    const std::string name = precision ? "ap" : "ar";
    figures.insert(figures.end(), {{name, precision, 0, 0, 0},
                                   {name + "50", precision, 0.5, 0, 0},
                                   {name + "75", precision, 0.75, 0, 0},
                                   {name + "_medium", precision, 0, 1, 0},
                                   {name + "_large", precision, 0, 2, 0}});
  }
  return figures;
}

std::vector<CocoFigure> PlainFigures(const CocoOptions& options) {
  const size_t last = options.most_detections.size() - 1;
  return {{"ap", true, 0, 0, last}, {"ap50", true, 0.5, 0, last}, {"ap75", true, 0.75, 0, last}, {"ar", false, 0, 0, last}};
}

double ValueOf(const CocoFigure& figure, const CocoTable& table, const CocoOptions& options, size_t category) {
  size_t threshold = CocoTable::kAll;
  for (size_t t = 0; t < options.thresholds.size(); ++t) {
    if (figure.threshold > 0 && std::abs(options.thresholds[t] - figure.threshold) < 1e-9) threshold = t;
  }
  return figure.precision ? table.MeanPrecision(threshold, category, figure.area, figure.most)
                          : table.MeanRecall(threshold, category, figure.area, figure.most);
}

}  // namespace airsim360

// The pictures on which predictions do worst: a list in the report, and a contact sheet to look at.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/eval/files/picture_files.h"
#include "airsim360/image/image.h"

namespace airsim360 {

struct SheetOptions {
  int worst = 0;     ///< how many; 0 = none (20 with a file)
  std::string file;  ///< .png or .jpg of them; "" = none
};
void AddSheetFlags(CLI::App& command, SheetOptions& options);
void CheckSheetOptions(SheetOptions& options);

struct SheetItem {
  size_t index = 0;  ///< handed to `strip`
  std::string name;
  double value = 0;  ///< large is bad
};
/// `worst`: name and value of the worst, and the sheet: one row each, made by strip(index).
void AppendWorst(nlohmann::ordered_json& json, const SheetOptions& options, std::vector<SheetItem> items, const char* figure,
                 const std::function<Image<Rgb8>(size_t)>& strip);

/// Truth, prediction, and where they differ, side by side.
Image<Rgb8> DepthStrip(const NumberPicture& prediction, const NumberPicture& truth);
/// The hue of a flow is its direction, its colour is full at the 95th percentile of the true lengths.
Image<Rgb8> FlowStrip(const NumberPicture& prediction, const NumberPicture& truth, bool panorama);
Image<Rgb8> LabelStrip(const LabelPicture& prediction, const LabelPicture& truth);

}  // namespace airsim360

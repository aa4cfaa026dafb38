#include "airsim360/app/eval/eval_sheet.h"

#include <algorithm>
#include <cmath>

#include "airsim360/app/eval/eval_views.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/draw.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr int kUsualWorst = 20, kMostWorst = 200;
constexpr int kPanelWidth = 384, kGap = 4, kCaption = 14;
constexpr Rgb8 kPaper{24, 24, 28}, kInk{235, 235, 235}, kNothing{0, 0, 0}, kRight{40, 44, 52}, kWrong{236, 92, 60};

Image<Rgb8> SideBySide(const std::vector<Image<Rgb8>>& panels) {
  const int height = std::max(1, kPanelWidth * panels[0].height() / panels[0].width());
  Image<Rgb8> strip(static_cast<int>(panels.size()) * (kPanelWidth + kGap) - kGap, height, kPaper);
  int x = 0;
  for (const Image<Rgb8>& panel : panels) {
    Blit(ResizeBox(panel, kPanelWidth, height), x, 0, strip);
    x += kPanelWidth + kGap;
  }
  return strip;
}

// Hue by direction, the fuller the longer; 1 is full.
Rgb8 FlowColor(double dx, double dy) {
  const double length = std::min(std::hypot(dx, dy), 1.0);
  return OklchColor(0.95 - 0.25 * length, 0.15 * length, std::atan2(dy, dx) / kDegree);
}

void WriteSheet(const std::string& path, const Image<Rgb8>& sheet) {
  const bool jpeg = path.ends_with(".jpg") || path.ends_with(".jpeg");
  WriteFileAtomically(path, jpeg ? EncodeJpeg(sheet, 90) : EncodePng(sheet));
}

}  // namespace

void AddSheetFlags(CLI::App& command, SheetOptions& options) {
  command.add_option("--worst", options.worst, "also name so many pictures on which predictions do worst");
  AddOutputOption(command, "--sheet", options.file,
                  "draw them, truth, prediction and difference side by side: .png or .jpg (20 unless --worst says)");
}

void CheckSheetOptions(SheetOptions& options) {
  if (!options.file.empty() && options.worst == 0) options.worst = kUsualWorst;
  if (options.worst < 0 || options.worst > kMostWorst)
    throw InputError("--worst " + std::to_string(options.worst) + ": must be 1 to " + std::to_string(kMostWorst));
  if (options.file.empty()) return;
  for (const char* ending : {".png", ".jpg", ".jpeg"}) {
    if (options.file.ends_with(ending)) return;
  }
  throw InputError("--sheet: '" + options.file + "' ends neither with .png nor .jpg");
}

void AppendWorst(nlohmann::ordered_json& json, const SheetOptions& options, std::vector<SheetItem> items, const char* figure,
                 const std::function<Image<Rgb8>(size_t)>& strip) {
  if (options.worst == 0) return;
  std::erase_if(items, [](const SheetItem& item) { return std::isnan(item.value); });
  std::stable_sort(items.begin(), items.end(), [](const SheetItem& a, const SheetItem& b) { return a.value > b.value; });
  if (items.size() > static_cast<size_t>(options.worst)) items.resize(static_cast<size_t>(options.worst));
  json["worst"] = nlohmann::ordered_json::array();
  for (const SheetItem& item : items) json["worst"].push_back({{"picture", item.name}, {figure, item.value}});
  if (options.file.empty() || items.empty()) return;
  std::vector<Image<Rgb8>> strips;
  int height = kGap;
  for (const SheetItem& item : items) {
    strips.push_back(strip(item.index));
    height += strips.back().height() + kCaption + kGap;
  }
  Image<Rgb8> sheet(strips[0].width() + 2 * kGap, height, kPaper);
  int y = kGap;
  for (size_t i = 0; i < strips.size(); ++i) {
    char value[48];
    std::snprintf(value, sizeof(value), "  %s %.4g", figure, items[i].value);
    DrawText(items[i].name + value, kGap, y + 2, kInk, 1, sheet);
    Blit(strips[i], kGap, y + kCaption, sheet);
    y += strips[i].height() + kCaption + kGap;
  }
  WriteSheet(options.file, sheet);
  json["sheet"] = options.file;
}

Image<Rgb8> DepthStrip(const NumberPicture& prediction, const NumberPicture& truth) {
  double low = INFINITY, high = 0;
  for (const double v : truth.values) {
    if (v > 0 && std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  high = std::max(high, 1.001 * low);
  std::vector<Image<Rgb8>> panels(3, Image<Rgb8>(truth.width, truth.height, kNothing));
  for (size_t i = 0; i < truth.values.size(); ++i) {
    const double g = truth.values[i], p = prediction.values[i];
    if (!(g > 0 && std::isfinite(g))) continue;
    panels[0].pixels()[i] = ScaleColor(1 - LogScale(g, low, high));
    panels[1].pixels()[i] = ScaleColor(1 - LogScale(p, low, high));
    // Relative error: 50 % and more is the end of the scale.
    panels[2].pixels()[i] = ScaleColor(2 * std::abs(p - g) / g);
  }
  return SideBySide(panels);
}

Image<Rgb8> FlowStrip(const NumberPicture& prediction, const NumberPicture& truth, bool panorama) {
  std::vector<double> lengths;
  const size_t pixels = truth.values.size() / 2;
  for (size_t i = 0; i < pixels; ++i) {
    if (const double length = std::hypot(truth.values[2 * i], truth.values[2 * i + 1]); std::isfinite(length)) lengths.push_back(length);
  }
  if (lengths.empty()) lengths.push_back(1);
  const auto most = lengths.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(lengths.size() - 1));
  std::nth_element(lengths.begin(), most, lengths.end());
  const double full = std::max(*most, 1e-3);
  std::vector<Image<Rgb8>> panels(3, Image<Rgb8>(truth.width, truth.height, kNothing));
  for (size_t i = 0; i < pixels; ++i) {
    const double gx = truth.values[2 * i], gy = truth.values[2 * i + 1], px = prediction.values[2 * i], py = prediction.values[2 * i + 1];
    if (!std::isfinite(gx) || !std::isfinite(gy)) continue;
    const double dx = panorama ? std::remainder(px - gx, static_cast<double>(truth.width)) : px - gx;
    panels[0].pixels()[i] = FlowColor(gx / full, gy / full);
    panels[1].pixels()[i] = FlowColor(px / full, py / full);
    panels[2].pixels()[i] = ScaleColor(std::hypot(dx, py - gy) / full);
  }
  return SideBySide(panels);
}

Image<Rgb8> LabelStrip(const LabelPicture& prediction, const LabelPicture& truth) {
  std::vector<Image<Rgb8>> panels(3, Image<Rgb8>(truth.width, truth.height, kNothing));
  for (size_t i = 0; i < truth.ids.size(); ++i) {
    panels[0].pixels()[i] = IdColor(truth.ids[i]);
    panels[1].pixels()[i] = IdColor(prediction.ids[i]);
    panels[2].pixels()[i] = prediction.ids[i] == truth.ids[i] ? kRight : kWrong;
  }
  return SideBySide(panels);
}

}  // namespace airsim360

// airsim360 eval: metrics of results against a reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/file.h"
#include "airsim360/eval/image_metrics.h"
#include "airsim360/eval/panorama_statistics.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

struct ImageArguments {
  std::string first, second;
  FlipOptions flip;
};

Image<Rgb8> ReadRgb8(const std::string& path) {
  const Image<Rgba8> rgba = DecodeRgba8(ReadFile(path), path);
  Image<Rgb8> rgb(rgba.width(), rgba.height());
  std::transform(rgba.pixels().begin(), rgba.pixels().end(), rgb.pixels().begin(), [](Rgba8 p) { return Rgb8{p.r, p.g, p.b}; });
  return rgb;
}

/// JSON has no infinity: equal pictures give null.
nlohmann::ordered_json Decibels(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

void RunImage(const ImageArguments& arguments, const GlobalOptions& globals) {
  const Image<Rgb8> a = ReadRgb8(arguments.first), b = ReadRgb8(arguments.second);
  const double psnr = Psnr(a, b), ssim = Ssim(a, b), flip = MeanFlip(b, a, arguments.flip);
  // Rows have solid angles in a full panorama only.
  const bool panorama = a.width() == 2 * a.height();
  const double ws_psnr = panorama ? WsPsnr(a, b) : 0;
  if (globals.json) {
    PrintJson({{"first", arguments.first},
               {"second", arguments.second},
               {"width", a.width()},
               {"height", a.height()},
               {"equal", a == b},
               {"ws_psnr_db", panorama ? Decibels(ws_psnr) : nlohmann::ordered_json(nullptr)},
               {"psnr_db", Decibels(psnr)},
               {"ssim", ssim},
               {"flip", flip}});
    return;
  }
  if (panorama) std::printf("WS-PSNR  %8.3f dB\n", ws_psnr);
  std::printf("PSNR     %8.3f dB\nSSIM     %8.5f\nFLIP     %8.5f (mean)\n", psnr, ssim, flip);
}

void RunStatistics(const std::vector<std::string>& files, const GlobalOptions& globals) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (!globals.json) std::printf("slope   flat   grad    entropy\n");
  for (const std::string& file : files) {
    const Image<Rgb8> picture = ReadRgb8(file);
    const PanoramaStatistics s = MeasurePanorama(picture);
    list.push_back({{"file", file}, {"slope", s.slope}, {"flat", s.flat}, {"gradient", s.gradient}, {"entropy", s.entropy}});
    if (!globals.json) std::printf("%5.2f  %5.3f  %6.4f  %5.2f   %s\n", s.slope, s.flat, s.gradient, s.entropy, file.c_str());
  }
  if (globals.json) PrintJson(list);
}

}  // namespace

void AddEvalCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("eval", "metrics of results against a reference");
  command->require_subcommand(1);
  CLI::App* image = command->add_subcommand("image", "WS-PSNR, PSNR, SSIM and FLIP of two pictures");
  const auto arguments = std::make_shared<ImageArguments>();
  image->add_option("first", arguments->first, "PNG, JPEG or WebP; transparency is ignored")->required();
  image->add_option("second", arguments->second, "the reference, of the same size")->required();
  image->add_option("--ppd", arguments->flip.pixels_per_degree, "FLIP: pixels per degree that the viewer sees (default 67.02)");
  image->add_flag("--wrap", arguments->flip.wrap_columns, "FLIP: the left border goes on at the right one (panoramas)");
  image->callback([arguments, &globals] { RunImage(*arguments, globals); });
  CLI::App* statistics = command->add_subcommand("statistics", "spectrum slope, flat share, gradient and entropy of panoramas");
  const auto files = std::make_shared<std::vector<std::string>>();
  statistics->add_option("files", *files, "equirectangular pictures (PNG, JPEG, WebP), twice as wide as high")->required();
  statistics->callback([files, &globals] { RunStatistics(*files, globals); });
  AddEvalDepth(*command, globals);
  AddEvalSemantic(*command, globals);
  AddEvalPanoptic(*command, globals);
  AddEvalVideo(*command, globals);
  AddEvalCoco(*command, globals);
  AddEvalFlow(*command, globals);
  AddEvalLayout(*command, globals);
  AddEvalMpde(*command, globals);
  AddEvalVln(*command, globals);
}

}  // namespace airsim360

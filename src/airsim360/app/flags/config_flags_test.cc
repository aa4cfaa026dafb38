#include "airsim360/app/flags/config_flags.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "airsim360/app/flags/picture_arguments.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

DatasetSpec Parsed(std::vector<std::string> words) {
  CLI::App app;
  PictureArguments arguments;
  arguments.AddTo(app);
  std::ranges::reverse(words);  // as CLI11 wants them
  app.parse(words);
  return arguments.Spec();
}

std::string Refusal(std::vector<std::string> words) {
  try {
    Parsed(std::move(words));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConfigFlags, EveryOptionOfPicturesIsAFlag) {
  const DatasetSpec spec = Parsed({"--tier", "high", "--samples", "7", "--no-denoise", "--edge-samples=64", "--tone", "agx", "--exposure",
                                   "-1.5", "--pano-frame", "level", "--lens", "real360", "--rgb-format", "jpg"});
  EXPECT_EQ(spec.tier, Tier::kHigh);
  EXPECT_EQ(spec.samples, 7);
  EXPECT_FALSE(spec.denoise);
  EXPECT_EQ(spec.edge_samples, 64);
  EXPECT_EQ(spec.tone, ToneCurve::kAgx);
  EXPECT_EQ(spec.exposure_ev, -1.5);
  EXPECT_FALSE(spec.auto_exposure);
  EXPECT_EQ(spec.pano_frame, PanoFrame::kLevel);
  EXPECT_EQ(spec.lens, LensModel::kReal360);
  EXPECT_EQ(spec.rgb_format, RgbFormat::kJpeg);
}

TEST(ConfigFlags, WithoutFlagsEverythingIsAsTheStructsSay) {
  const DatasetSpec spec = Parsed({}), standard;
  EXPECT_EQ(spec.tier, standard.tier);
  EXPECT_EQ(spec.samples, 0);
  EXPECT_TRUE(spec.denoise);
  EXPECT_EQ(spec.products, standard.products);
}

TEST(ConfigFlags, ExposureIsANumberOrAuto) {
  EXPECT_TRUE(Parsed({"--exposure", "auto"}).auto_exposure);
  EXPECT_EQ(Parsed({"--exposure", "+2"}).exposure_ev, 2);
  for (const char* value : {"20.1", "-21", "nan", "inf", "1e300", "one", "1 2", ""})
    EXPECT_EQ(Refusal({"--exposure", value}), "--exposure: '" + std::string(value) + "' is neither 'auto' nor a number from -20 to 20");
}

TEST(ConfigFlags, CountsOutOfRangeNameTheNearest) {
  EXPECT_EQ(Refusal({"--edge-samples", "0"}), "--edge-samples: 0 is not in 1 … 64; did you mean 1?");
  EXPECT_EQ(Refusal({"--edge-samples", "-3"}), "--edge-samples: -3 is not in 1 … 64; did you mean 1?");
  EXPECT_EQ(Refusal({"--edge-samples", "9223372036854775807"}), "--edge-samples: 9223372036854775807 is not in 1 … 64; did you mean 64?");
  for (const char* value : {"9223372036854775808", "2.5", "four", "0x10"})
    EXPECT_EQ(Refusal({"--samples", value}), "--samples: '" + std::string(value) + "' is not a whole number from 1 to 1048576");
}

TEST(ConfigFlags, WrongWordsNameTheNearest) {
  EXPECT_NE(Refusal({"--tone", "filmik"}).find("--tone: unknown tone 'filmik'; did you mean 'filmic'?"), std::string::npos);
  EXPECT_NE(Refusal({"--pano-frame", "lvel"}).find("did you mean 'level'?"), std::string::npos);
  EXPECT_NE(Refusal({"--products", "normal,flwo"}).find("--products: unknown product 'flwo'; did you mean 'flow'?"), std::string::npos);
}

TEST(ConfigFlags, ProductsAreAddedToThoseOfEveryDataset) {
  const DatasetSpec spec = Parsed({"--products", "flow,part,rgb", "--normal", "--radiance"});
  Products wanted;
  wanted.flow = wanted.part = wanted.normal = wanted.radiance = true;
  EXPECT_EQ(spec.products, wanted);
  // A part is told by the material; nobody asked for its picture.
  EXPECT_TRUE(ProductsOf(spec).material);
  for (const ProductFolder& folder : ProductFolders(spec)) EXPECT_NE(folder.name, "material");
}

TEST(ConfigFlags, TierLabelsHasNoLight) {
  EXPECT_NE(Refusal({"--tier", "labels", "--products", "radiance"}).find("no light"), std::string::npos);
  EXPECT_FALSE(ProductsOf(Parsed({"--tier", "labels"})).rgb);
}

TEST(ConfigFlags, ChoicesOfCompletionAreThoseThatAreTaken) {
  const ConfigFields fields = [](ConfigVisitor& v) { DatasetSpec().Visit(v); };
  EXPECT_EQ(ConfigFlagChoices(fields, "--tier"), (std::vector<std::string>{"labels", "fast", "high", "reference"}));
  EXPECT_EQ(ConfigFlagChoices(fields, "--samples"), std::vector<std::string>{});
  for (const std::string& flag : PictureFlagNames())
    for (const std::string& word : ConfigFlagChoices(fields, flag)) EXPECT_EQ(Refusal({flag, word}), "no error");
}

TEST(PictureArguments, WhatTheTierHasNoUseForIsRefused) {
  const std::vector<std::vector<std::string>> colours = {{"--tone", "agx"},     {"--exposure", "1"}, {"--exposure", "auto"},
                                                         {"--lens", "real360"}, {"--look", "photo"}, {"--rgb-format", "jpg"}};
  for (const std::vector<std::string>& flag : colours) {
    std::vector<std::string> words = flag;
    words.insert(words.end(), {"--tier", "labels"});
    EXPECT_EQ(Refusal(words), flag[0] + ": tier 'labels' has no use for it; use --tier fast or high or reference");
    for (const char* tier : {"fast", "high", "reference"}) {
      words.back() = tier;
      EXPECT_EQ(Refusal(words), "no error") << flag[0] << tier;
    }
  }
  EXPECT_EQ(Refusal({"--samples", "4"}), "--samples: tier 'fast' has no use for it; use --tier high or reference");
  EXPECT_EQ(Refusal({"--no-denoise", "--tier", "reference"}), "--no-denoise: tier 'reference' has no use for it; use --tier high");
  EXPECT_EQ(Refusal({"--edge-samples", "4", "--tier", "reference"}),
            "--edge-samples: tier 'reference' has no use for it; use --tier fast or high");
  EXPECT_EQ(Refusal({"--edge-samples", "4", "--tier", "labels", "--products", "coverage"}), "no error");
  EXPECT_EQ(Refusal({"--products", "normal,rgb", "--tier", "labels"}).find("--products: 'rgb'"), 0u);
  EXPECT_EQ(Refusal({"--products", "normal,rgb"}), "no error");
  EXPECT_EQ(Refusal({"--look", "photo", "--tone", "agx"}).find("--tone: --look photo"), 0u);
}

TEST(TrafficArguments, AWarmUpNeedsVehicles) {
  TrafficArguments arguments{.warm_up = 5};
  EXPECT_THROW(arguments.Request(0), InputError);
  arguments.count = 1;
  EXPECT_EQ(arguments.Request(0).warm_up, 5);
}

TEST(CheckPictureSettings, WhatDoesNotFitTheCameraOrTheTierIsNamed) {
  const auto refusal = [](const PictureSettings& settings, const Camera& camera) -> std::string {
    try {
      CheckPictureSettings(settings, camera, "--");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  PictureSettings settings;
  EXPECT_EQ(refusal(settings, Pinhole{}), "no error");
  settings.lens = LensModel::kReal360;
  EXPECT_EQ(refusal(settings, Equirectangular{}), "no error");
  EXPECT_EQ(refusal(settings, Pinhole{}).find("--lens: 'real360'"), 0u);
  settings = {};
  settings.auto_exposure = true;
  EXPECT_EQ(refusal(settings, CubeFace{}).find("--exposure: 'auto'"), 0u);
  settings = {};
  settings.samples = 257;
  EXPECT_EQ(refusal(settings, Equirectangular{}), "--samples: 257 is not in 1 … 256 of tier fast; did you mean 256?");
  settings.tier = Tier::kReference;
  EXPECT_EQ(refusal(settings, Equirectangular{}), "no error");
}

}  // namespace
}  // namespace airsim360

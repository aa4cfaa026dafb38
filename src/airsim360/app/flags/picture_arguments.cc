#include "airsim360/app/flags/picture_arguments.h"

#include <algorithm>

#include "airsim360/app/flags/config_flags.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// "normal,position,…": what a dataset does not hold in any case.
std::string OptionalProductNames() {
  std::string names;
  for (const ProductInfo& product : kProducts) {
    if (!product.always) names += (names.empty() ? "" : ",") + std::string(product.name);
  }
  return names;
}

std::string Named(const std::vector<Tier>& tiers) {
  std::string names;
  for (const Tier tier : tiers) names += (names.empty() ? "" : " or ") + std::string(kTierNames[static_cast<int>(tier)]);
  return names;
}

// What the tier makes nothing of is not accepted and ignored.
void RefuseIdle(const DatasetSpec& spec) {
  const std::vector<Tier> light = {Tier::kFast, Tier::kHigh, Tier::kReference};
  // Coverage counts the rays of antialiasing in every tier.
  const bool edges = spec.edge_samples != 0 && !spec.products.coverage;
  const struct {
    const char* flag;
    bool given;
    std::vector<Tier> tiers;
  } flags[] = {{"--samples", spec.samples != 0, {Tier::kHigh, Tier::kReference}},
               {"--no-denoise", !spec.denoise, {Tier::kHigh}},
               {"--edge-samples", edges, {Tier::kFast, Tier::kHigh}},
               {"--tone", spec.tone != ToneCurve::kFilmic, light},
               {"--exposure", spec.auto_exposure || spec.exposure_ev != 0, light},
               {"--lens", spec.lens != LensModel::kIdeal, light},
               {"--look", spec.look != Look::kClean, light},
               {"--rgb-format", spec.rgb_format != RgbFormat::kPng, light}};
  for (const auto& f : flags) {
    if (f.given && std::ranges::find(f.tiers, spec.tier) == f.tiers.end())
      throw InputError(std::string(f.flag) + ": tier '" + kTierNames[static_cast<int>(spec.tier)] + "' has no use for it; use --tier " +
                       Named(f.tiers));
  }
  if (spec.look == Look::kPhoto && spec.tone != ToneCurve::kFilmic)
    throw InputError("--tone: --look photo has a curve of its own (--shoulder, --contrast); leave one of them out");
}

}  // namespace

void PictureArguments::AddTo(CLI::App& command) {
  command_ = &command;
  AddConfigFlags(command, [this](ConfigVisitor& v) { picture_.Visit(v); });
  command.add_option("--products", products_, "beside rgb,range,semantic,entity: " + OptionalProductNames())
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--normal", normal_, "the same as --products normal");
  command.add_flag("--radiance", radiance_, "the same as --products radiance: linear light, radiance/STEM.exr, half float");
}

DatasetSpec PictureArguments::Spec() const {
  DatasetSpec spec = picture_;
  spec.products = WithProducts(spec.products, products_, "--products");
  spec.products.normal |= normal_;
  spec.products.radiance |= radiance_;
  if (spec.look != Look::kPhoto) {
    for (const std::string& flag : ConfigFlagNames([](ConfigVisitor& v) { CameraLook().Visit(v); })) {
      if (command_ && command_->count(flag) > 0) throw InputError(flag + ": it is of the camera that --look photo is; add --look photo");
    }
  }
  if (spec.products.radiance && spec.tier == Tier::kLabels) throw InputError("--radiance: tier 'labels' has no light; use --tier fast");
  if (spec.tier == Tier::kLabels && std::ranges::find(products_, "rgb") != products_.end())
    throw InputError("--products: 'rgb' is not of tier labels, which has no colours; use --tier fast");
  RefuseIdle(spec);
  return spec;
}

void PictureArguments::Check(const DatasetSpec& spec) {
  for (const View& view : Views(spec)) {
    CheckPictureSettings(spec, view.camera, "--");
    if (view.gimbal && spec.pano_frame == PanoFrame::kLevel)
      throw InputError("--pano-frame: 'level' would turn camera '" + view.name + "', which a gimbal turns already; use body");
  }
}

const std::vector<std::string>& PictureFlagNames() {
  static const std::vector<std::string> names = ConfigFlagNames([](ConfigVisitor& v) { DatasetSpec().Visit(v); });
  return names;
}

}  // namespace airsim360

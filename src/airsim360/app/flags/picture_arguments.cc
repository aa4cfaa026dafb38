#include "airsim360/app/flags/picture_arguments.h"

#include <algorithm>

#include "airsim360/app/flags/config_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/sensors/idle_settings.h"

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
  RefuseIdleSettings(spec, spec.products, "--");
  if (spec.tier == Tier::kLabels && spec.rgb_format != RgbFormat::kPng)
    throw InputError("--rgb-format: tier 'labels' has no use for it; use --tier fast or high or reference");
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

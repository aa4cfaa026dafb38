#include "airsim360/dataset/record/spec.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {}  // namespace

namespace {

// The views of one camera; its name and place are the caller's.
std::vector<View> ViewsOf(const RigCamera& spec) {
  const int w = spec.width, h = spec.height;
  const double fov = spec.fov_deg * kDegree;
  if (spec.lens) return {{"", *spec.lens, spec.projection}};
  switch (spec.projection) {
    case Projection::kErp:
      return {{"", Equirectangular{w, h}, spec.projection}};
    case Projection::kPinhole: {
      const double f = 0.5 * w / std::tan(0.5 * fov);
      const Pinhole camera{.width = w, .height = h, .fx = f, .fy = f, .cx = 0.5 * w, .cy = 0.5 * h};
      return {{"", camera, spec.projection}};
    }
    case Projection::kFisheye:
      return {{"", Fisheye::Equidistant(w, h, fov), spec.projection}};
    case Projection::kCube:
    case Projection::kLens:
      break;
  }
  std::vector<View> faces;
  for (int face = 0; face < 6; ++face) {
    faces.push_back({std::string("_") + kCubeFaceNames[face], CubeFace{static_cast<CubeFaceName>(face), w}, spec.projection});
  }
  return faces;
}

}  // namespace

std::vector<View> Views(const DatasetSpec& spec) {
  if (spec.cameras.empty()) {
    return ViewsOf(
        {.name = "", .projection = spec.projection, .width = spec.width, .height = spec.height, .fov_deg = spec.fov_deg, .p_B = {}});
  }
  std::vector<View> views;
  for (const RigCamera& camera : spec.cameras) {
    const RigidTransform X_BM = BodyPose(camera.p_B, camera.yaw_deg * kDegree, camera.pitch_deg * kDegree, camera.roll_deg * kDegree);
    for (View& view : ViewsOf(camera)) {
      view.suffix = "_" + camera.name + view.suffix;
      view.X_BC = X_BM * camera.X_IC;
      view.name = camera.name;
      view.gimbal = camera.gimbal;
      views.push_back(std::move(view));
    }
  }
  return views;
}

RigidTransform CameraPose(const View& view, const RigidTransform& X_WB) {
  return view.gimbal ? X_WB * view.gimbal->AtRest(X_WB.R) * view.X_BC : X_WB * view.X_BC;
}

bool MayLackRays(Projection projection) { return projection == Projection::kFisheye || projection == Projection::kLens; }

bool IsPanoramic(const DatasetSpec& spec) {
  return std::ranges::all_of(Views(spec), [](const View& view) { return view.projection == Projection::kErp; });
}

void DatasetSpec::Visit(ConfigVisitor& v) {
  PictureSettings::Visit(v);
  v.Field("rgb_format", "png or jpg", rgb_format, kRgbFormatNames);
}

namespace {

bool IsHeld(const DatasetSpec& spec, const ProductInfo& product) {
  return spec.products.*product.wanted && !(product.needs_light && spec.tier == Tier::kLabels);
}

}  // namespace

Products ProductsOf(const DatasetSpec& spec) {
  Products products = spec.products;
  for (const ProductInfo& product : kProducts) products.*product.wanted = IsHeld(spec, product);
  return Rendered(products);
}

std::string Stem(int64_t index) {
  char text[32];
  std::snprintf(text, sizeof text, "%06lld", static_cast<long long>(index));
  return text;
}

std::vector<ProductFolder> ProductFolders(const DatasetSpec& spec) {
  std::vector<ProductFolder> folders;
  for (const ProductInfo& product : kProducts) {
    if (!IsHeld(spec, product)) continue;
    const bool jpeg = product.wanted == &Products::rgb && spec.rgb_format == RgbFormat::kJpeg;
    folders.push_back({product.name, jpeg ? ".jpg" : product.extension});
  }
  return folders;
}

bool NeedsWideSemantics(const Scene& scene) {
  return std::any_of(scene.entities.begin(), scene.entities.end(), [](const Entity& entity) { return entity.category > 255; });
}

}  // namespace airsim360

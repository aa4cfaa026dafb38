#include "airsim360/dataset/encode.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "airsim360/base/hash.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/encode_extra.h"
#include "airsim360/dataset/people/person_record.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/category_colors.h"

namespace airsim360 {
namespace {

// Compass heading, pitch and roll of the panorama, degrees.
GPano PhotoSpherePose(const Mat3d& R_WC) {
  const Vec3d right = R_WC.column(0), down = R_WC.column(1), forward = R_WC.column(2);
  double heading = std::atan2(forward.x, forward.y) * kRadian;
  if (heading < 0) heading += 360;
  return {heading, std::asin(std::clamp(forward.z, -1.0, 1.0)) * kRadian, std::atan2(-right.z, -down.z) * kRadian};
}

Bytes EncodeRgb(const Capture& capture, Projection projection, const DatasetSpec& spec) {
  std::optional<GPano> gpano;
  if (projection == Projection::kErp) gpano = PhotoSpherePose(capture.X_WC.R);
  return spec.rgb_format == RgbFormat::kJpeg ? EncodeJpeg(capture.frame.rgb, kJpegQuality, gpano) : EncodePng(capture.frame.rgb, gpano);
}

Bytes EncodeSemantic(const Image<CategoryId>& semantic, bool wide) {
  return wide ? EncodePng(semantic) : EncodePalettePng(internal::NarrowSemantic(semantic), CategoryPalette());
}

Bytes EncodeProduct(const std::string& product, const Capture& capture, const View& view, const EncodeContext& context) {
  if (product == "rgb") return EncodeRgb(capture, view.projection, context.spec);
  if (product == "range") return EncodeExr(capture.frame.range);
  if (product == "semantic") return EncodeSemantic(capture.frame.semantic, NeedsWideSemantics(context.scene));
  if (product == "entity") return EncodeIdPng(capture.frame.entity);
  if (product == "radiance") return EncodeHalfExr(capture.frame.radiance);
  return internal::EncodeExtra(product, capture.frame, context.scene);
}

// Smallest and median range over the pixels of all views that hit something.
void FillRangeFigures(const std::vector<Capture>& captures, FrameRecord& record) {
  size_t pixels = 0;
  for (const Capture& capture : captures) pixels += capture.frame.range.pixels().size();
  std::vector<float> hits;
  hits.reserve(pixels);
  for (const Capture& capture : captures) {
    std::copy_if(capture.frame.range.pixels().begin(), capture.frame.range.pixels().end(), std::back_inserter(hits),
                 [](float range) { return range > 0; });
  }
  if (hits.empty()) return;
  const auto middle = hits.begin() + static_cast<ptrdiff_t>((hits.size() - 1) / 2);
  std::nth_element(hits.begin(), middle, hits.end());
  record.range_median = *middle;
  record.range_min = *std::min_element(hits.begin(), middle + 1);
}

}  // namespace

EncodeContext MakeEncodeContext(const DatasetSpec& spec, const Scene& scene, const SimPeople* people) {
  EncodeContext context{spec, scene, Views(spec), {}, people};
  for (const View& view : context.views) context.solid_angles.emplace_back(view.camera);
  return context;
}

namespace {

// Rows of the persons of every view, and a picture of everyone who can be seen.
void EncodePeople(const EncodeContext& context, int64_t index, const std::vector<Capture>& captures, const FrameLabels& people,
                  EncodedFrame& frame) {
  struct Crop {
    size_t view;
    const PersonLabel* label;
  };
  std::vector<Crop> crops;
  for (size_t v = 0; v < people.size(); ++v) {
    ViewRecord& view = frame.record.views[v];
    view.persons = PersonRows({*context.people, context.views[v].camera, captures[v].frame.entity, view.segments}, people[v]);
    for (size_t i = 0; i < people[v].size() && context.spec.crops; ++i) {
      if (view.persons[i].pixels > 0) crops.push_back({v, &people[v][i]});
    }
  }
  for (size_t v = 0; v < people.size() && context.spec.overlay; ++v) {
    const View& view = context.views[v];
    EncodedFile file;
    file.bytes = EncodePng(DrawPeople(captures[v].frame.rgb, view.camera, people[v]), std::nullopt);
    file.record = {"overlay" + view.suffix, "overlay/" + Stem(index) + view.suffix + ".png", static_cast<int64_t>(file.bytes.size()),
                   Sha256Hex(file.bytes)};
    frame.files.push_back(std::move(file));
  }
  const size_t first = frame.files.size();
  frame.files.resize(first + crops.size());
  ParallelFor(static_cast<int64_t>(crops.size()), [&](int64_t task) {
    const Crop& crop = crops[static_cast<size_t>(task)];
    const View& view = context.views[crop.view];
    const std::string stem = CropStem(index, view.suffix, crop.label->person);
    EncodedFile& file = frame.files[first + static_cast<size_t>(task)];
    file.bytes = EncodePng(RenderCrop(captures[crop.view].frame.rgb, view.camera, CropOf(*crop.label)), std::nullopt);
    file.record = {stem, stem + ".png", static_cast<int64_t>(file.bytes.size()), Sha256Hex(file.bytes)};
  });
}

}  // namespace

EncodedFrame Encode(const EncodeContext& context, int64_t index, const std::vector<Capture>& captures, const FrameLabels& people) {
  const std::vector<ProductFolder> folders = ProductFolders(context.spec);
  const size_t views = context.views.size();
  EncodedFrame frame;
  frame.record.index = index;
  frame.record.t_ns = captures[0].t_ns;
  frame.record.X_WC = captures[0].X_WC;
  frame.record.body = captures[0].body;
  frame.record.views.resize(views);
  frame.files.resize(folders.size() * views);

  // Every file is one task; so are the segments of every view and the range figures of the frame.
  const auto tasks = static_cast<int64_t>(frame.files.size() + views + 1);
  ParallelFor(tasks, [&](int64_t task) {
    const auto i = static_cast<size_t>(task);
    if (i < frame.files.size()) {
      const ProductFolder& folder = folders[i / views];
      const View& view = context.views[i % views];
      EncodedFile& file = frame.files[i];
      file.bytes = EncodeProduct(folder.name, captures[i % views], view, context);
      file.record = {folder.name + view.suffix, folder.name + "/" + Stem(index) + view.suffix + folder.extension,
                     static_cast<int64_t>(file.bytes.size()), Sha256Hex(file.bytes)};
    } else if (i < frame.files.size() + views) {
      const size_t v = i - frame.files.size();
      const Frame& image = captures[v].frame;
      const Projection projection = context.views[v].projection;
      frame.record.views[v] = {context.views[v].suffix, captures[v].X_WC, captures[v].X_WC_next,
                               FindSegments(image.entity, image.semantic, context.scene, context.solid_angles[v],
                                            {.wraps = projection == Projection::kErp, .allows_void = MayLackRays(projection)})};
      frame.record.views[v].photo = captures[v].photo;
      if (!image.rgb.empty()) frame.record.views[v].exposure = image.exposure;
    } else {
      FillRangeFigures(captures, frame.record);
    }
  });
  EncodePeople(context, index, captures, people, frame);
  for (const EncodedFile& file : frame.files) frame.record.files.push_back(file.record);
  return frame;
}

}  // namespace airsim360

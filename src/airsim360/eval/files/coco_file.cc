#include "airsim360/eval/files/coco_file.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/similarity.h"
#include "airsim360/eval/files/json_cursor.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

using internal::JsonCursor;
using internal::JsonFile;
using internal::OwnId;

int Size(const JsonCursor& value) {
  const int64_t size = value.Integer();
  if (size < 1 || size > kMaxPixels) value.Fail(std::to_string(size) + " is no size of a picture");
  return static_cast<int>(size);
}

std::vector<CocoImage> Images(const JsonCursor& list, bool sized) {
  std::vector<CocoImage> images;
  std::set<int64_t> ids;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    CocoImage image{.id = OwnId(one, ids), .name = one.Has("file_name") ? one["file_name"].Text() : ""};
    if (sized || one.Has("width")) image.width = Size(one["width"]), image.height = Size(one["height"]);
    if (static_cast<int64_t>(image.width) * image.height > kMaxPixels)
      one.Fail("a picture of more than " + std::to_string(kMaxPixels) + " pixels");
    images.push_back(std::move(image));
  }
  std::stable_sort(images.begin(), images.end(), [](const CocoImage& a, const CocoImage& b) { return a.id < b.id; });
  return images;
}

std::vector<CocoCategory> Categories(const JsonCursor& list) {
  std::vector<CocoCategory> categories;
  std::set<int64_t> ids;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    CocoCategory category{.id = OwnId(one, ids), .name = one.Has("name") ? one["name"].Text() : ""};
    if (one.Has("sigmas")) category.sigmas = one["sigmas"].Numbers();
    categories.push_back(std::move(category));
  }
  std::stable_sort(categories.begin(), categories.end(), [](const CocoCategory& a, const CocoCategory& b) { return a.id < b.id; });
  return categories;
}

// Polygons, run lengths as numbers, or run lengths as text.
RleMask Mask(const JsonCursor& value, int width, int height) {
  if (value.is_array()) {
    if (value.size() == 0) value.Fail("no polygon");
    std::vector<RleMask> parts;
    for (size_t i = 0; i < value.size(); ++i) {
      const std::vector<double> polygon = value[i].Numbers();
      if (polygon.size() % 2 != 0 || polygon.size() < 4)
        value[i].Fail("a polygon of " + std::to_string(polygon.size()) + " numbers: it is x and y of each corner, at least three");
      // pycocotools takes four numbers for a box.
      parts.push_back(polygon.size() == 4 ? RasterizeBox({polygon[0], polygon[1], polygon[2], polygon[3]}, width, height)
                                          : RasterizePolygon(polygon, width, height));
    }
    return UniteMasks(parts);
  }
  const std::vector<double> size = value["size"].Numbers(2);
  if (size[0] != height || size[1] != width)
    value.Fail("a mask of " + std::to_string(static_cast<int64_t>(size[1])) + "x" + std::to_string(static_cast<int64_t>(size[0])) +
               " pixels in a picture of " + std::to_string(width) + "x" + std::to_string(height));
  const JsonCursor counts = value["counts"];
  if (counts.is_string()) return ParseCompressedRle(counts.Text(), width, height);
  RleMask mask{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  for (size_t i = 0; i < counts.size(); ++i) {
    const int64_t count = counts[i].Integer();
    if (count < 0 || count > kMaxPixels) counts[i].Fail(std::to_string(count) + " is no length of a run");
    mask.counts.push_back(static_cast<uint32_t>(count));
  }
  CheckMask(mask);
  return mask;
}

template <size_t N>
std::array<double, N> Array(const JsonCursor& value) {
  const std::vector<double> numbers = value.Numbers(N);
  std::array<double, N> array;
  std::copy(numbers.begin(), numbers.end(), array.begin());
  return array;
}

std::array<double, 5> Bfov(const JsonCursor& value) {
  std::vector<double> numbers = value.Numbers();
  if (numbers.size() == 4) numbers.push_back(0);
  if (numbers.size() != 5) value.Fail("a box on the sphere is [lon, lat, width, height] or [lon, lat, width, height, turn] in degrees");
  if (!(numbers[2] > 0 && numbers[2] < 180 && numbers[3] > 0 && numbers[3] < 180))
    value.Fail("width and height of a box on the sphere must lie between 0 and 180 degrees");
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

std::array<double, 7> Box3d(const JsonCursor& value) {
  std::array<double, 7> box{};
  if (value.is_array()) {
    box = Array<7>(value);
  } else {
    const auto centre = Array<3>(value["center"]), size = Array<3>(value["size"]);
    box = {centre[0], centre[1], centre[2], size[0], size[1], size[2], value.NumberOr("yaw_deg", 0)};
  }
  if (!(box[3] > 0 && box[4] > 0 && box[5] > 0)) value.Fail("sizes of a box must be above 0");
  return box;
}

// Counts the boxes that had another one on the circle of columns, which is taken if `wrapped` is not null.
void ReadShape(const JsonCursor& one, CocoKind kind, const CocoImage& image, size_t* wrapped, CocoObject& object) {
  switch (kind) {
    case CocoKind::kMasks: {
      const JsonCursor segmentation = one["segmentation"];
      try {
        object.mask = Mask(segmentation, image.width, image.height);
      } catch (const InputError& error) {
        // What the masks' own functions say does not name the place.
        if (std::string_view(error.what()).find(": ") != std::string_view::npos) throw;
        segmentation.Fail(error.what());
      }
      break;
    }
    case CocoKind::kBoxes: {
      const bool round = wrapped && one.Has("bbox_wrap");
      if (round) ++*wrapped;
      const JsonCursor box = one[round ? "bbox_wrap" : "bbox"];
      object.box = Array<4>(box);
      if (object.box[2] < 0 || object.box[3] < 0) box.Fail("a box is [x, y, width, height]; a width or height is not below 0");
      break;
    }
    case CocoKind::kKeypoints:
      object.keypoints = one["keypoints"].Numbers();
      if (object.keypoints.empty() || object.keypoints.size() % 3 != 0) one["keypoints"].Fail("keypoints are [x, y, v] each");
      break;
    case CocoKind::kSphericalBoxes:
      object.bfov = Bfov(one["bfov"]);
      break;
    case CocoKind::kBoxes3d:
      object.box3d = Box3d(one["box3d"]);
      break;
  }
}

// pycocotools' rule: of the box where the first result has one, else of what is compared.
double ResultArea(const CocoObject& object, const JsonCursor& one, CocoKind kind, bool boxes) {
  if (kind == CocoKind::kBoxes) return object.box[2] * object.box[3];
  if (boxes && kind != CocoKind::kSphericalBoxes && kind != CocoKind::kBoxes3d) {
    const std::array<double, 4> box = Array<4>(one["bbox"]);
    return box[2] * box[3];
  }
  if (kind == CocoKind::kMasks) return static_cast<double>(MaskArea(object.mask));
  return kind == CocoKind::kKeypoints ? KeypointArea(object.keypoints) : 0;
}

std::unordered_map<int64_t, const CocoImage*> ById(const std::vector<CocoImage>& images) {
  std::unordered_map<int64_t, const CocoImage*> index;
  for (const CocoImage& image : images) index[image.id] = &image;
  return index;
}

bool HasBoxPolygon(const JsonCursor& one) {
  const JsonCursor polygons = one["segmentation"];
  for (size_t i = 0; polygons.is_array() && i < polygons.size(); ++i) {
    if (polygons[i].size() == 4) return true;
  }
  return false;
}

// A list of objects with scores is no truth, a file of images with annotations that have none no result.
void RefuseResults(const JsonCursor& top) {
  const bool scored = top.is_array() && top.size() > 0 && top[size_t{0}].Has("score");
  if (scored) top.Fail("a list of results, where annotations are expected: are the two files swapped? The prediction comes first");
}
void RefuseTruths(const JsonCursor& top) {
  if (!top.Has("images") || !top.Has("categories") || !top.Has("annotations")) return;
  const JsonCursor list = top["annotations"];
  if (list.size() > 0 && !list[size_t{0}].Has("score"))
    top.Fail("annotations without scores, where results are expected: are the two files swapped? The prediction comes first");
}

void NoteWrapped(size_t count, const char* what, CocoTruths& truths) {
  if (count > 0) truths.notes.push_back("bbox_wrap is taken for bbox where there is one: of " + std::to_string(count) + " " + what);
}

CocoTruths TruthsOf(const JsonCursor& top, CocoKind kind, bool wrap) {
  RefuseResults(top);
  CocoTruths truths;
  truths.images = Images(top["images"], kind == CocoKind::kMasks);
  truths.categories = Categories(top["categories"]);
  const auto images = ById(truths.images);
  std::set<int64_t> categories;
  for (const CocoCategory& category : truths.categories) categories.insert(category.id);
  const JsonCursor list = top["annotations"];
  std::set<int64_t> ids;
  bool zero = false, ignored = false;
  size_t box_polygons = 0, wrapped = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    CocoObject object{.image = one["image_id"].Integer(), .category = one["category_id"].Integer()};
    const auto image = images.find(object.image);
    if (image == images.end()) one.Fail("image_id " + std::to_string(object.image) + " is not among the images");
    if (!categories.contains(object.category)) one.Fail("category_id " + std::to_string(object.category) + " is not among the categories");
    if (one.Has("id")) zero |= OwnId(one, ids) == 0;
    object.crowd = one.FlagOr("iscrowd", false);
    ignored |= one.FlagOr("ignore", false) && !object.crowd;
    ReadShape(one, kind, *image->second, wrap ? &wrapped : nullptr, object);
    if (kind == CocoKind::kMasks) box_polygons += HasBoxPolygon(one);
    if (kind == CocoKind::kKeypoints) {
      object.box = Array<4>(one[wrap && one.Has("bbox_wrap") ? "bbox_wrap" : "bbox"]);
      double labelled = 0;
      for (size_t k = 2; k < object.keypoints.size(); k += 3) labelled += object.keypoints[k] > 0;
      object.no_keypoints = one.NumberOr("num_keypoints", labelled) == 0;
    }
    const double own = kind == CocoKind::kMasks ? static_cast<double>(MaskArea(object.mask)) : object.box[2] * object.box[3];
    object.area = one.NumberOr("area", own);
    truths.objects.push_back(std::move(object));
  }
  NoteWrapped(wrapped, "truths", truths);
  if (zero) truths.notes.push_back("an annotation has the id 0: pycocotools counts detections that match it as wrong; here they are right");
  if (box_polygons > 0)
    truths.notes.push_back("polygons of four numbers, of " + std::to_string(box_polygons) +
                           " annotations, are taken for boxes [x, y, width, height], as pycocotools does");
  if (ignored) truths.notes.push_back("'ignore' of annotations is not looked at: pycocotools overwrites it with 'iscrowd'");
  return truths;
}

std::vector<CocoObject> ResultsOf(const JsonCursor& top, CocoKind kind, bool wrap, CocoTruths& truths) {
  RefuseTruths(top);
  const JsonCursor list = top.is_object() ? top["annotations"] : top;
  const auto images = ById(truths.images);
  std::vector<CocoObject> results;
  const bool boxes = list.size() > 0 && list[size_t{0}].Has("bbox") && list[size_t{0}]["bbox"].size() > 0;
  std::set<int64_t> strangers;
  size_t wrapped = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    CocoObject object{.image = one["image_id"].Integer(), .category = one["category_id"].Integer(), .score = one["score"].Number()};
    const auto image = images.find(object.image);
    if (image == images.end()) {
      strangers.insert(object.image);
      continue;
    }
    ReadShape(one, kind, *image->second, wrap ? &wrapped : nullptr, object);
    object.area = ResultArea(object, one, kind, boxes);
    results.push_back(std::move(object));
  }
  if (!strangers.empty())
    list.Fail("results of " + std::to_string(strangers.size()) + " pictures that the ground truth does not have, image_id " +
              std::to_string(*strangers.begin()) + " first: are they of another split or numbered otherwise?");
  NoteWrapped(wrapped, "detections", truths);
  if (boxes && kind == CocoKind::kMasks)
    truths.notes.push_back(
        "results hold boxes beside masks: as pycocotools does, their areas (small, medium, large) are those of the boxes");
  return results;
}

}  // namespace

CocoTruths ReadCocoTruths(const std::filesystem::path& path, CocoKind kind, bool wrap) {
  return TruthsOf(JsonFile::Read(path).top(), kind, wrap);
}

CocoTruths ParseCocoTruths(std::string_view text, const std::string& name, CocoKind kind) {
  return TruthsOf(JsonFile::Parse(text, name).top(), kind, false);
}

std::vector<CocoObject> ReadCocoResults(const std::filesystem::path& path, CocoKind kind, CocoTruths& truths, bool wrap) {
  return ResultsOf(JsonFile::Read(path).top(), kind, wrap, truths);
}

std::vector<CocoObject> ParseCocoResults(std::string_view text, const std::string& name, CocoKind kind, CocoTruths& truths) {
  return ResultsOf(JsonFile::Parse(text, name).top(), kind, false, truths);
}

}  // namespace airsim360

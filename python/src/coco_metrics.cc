// airsim360.metrics: average precision of boxes and keypoints on arrays, the same functions as `airsim360 eval boxes` and `eval keypoints`.
#include <algorithm>
#include <limits>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/objects.h"
#include "airsim360/eval/coco/similarity.h"
#include "airsim360/eval/coco/summary.h"
#include "airsim360/math/angles.h"
#include "convert.h"

namespace airsim360::python {
namespace {

/// What is given of each picture; nothing where it is None.
class Lists {
 public:
  Lists(const py::object& given, const char* name, size_t pictures) : name_(name) {
    if (given.is_none()) return;
    lists_ = given.cast<py::sequence>();
    if (lists_->size() != pictures)
      throw InputError(name_ + ": one entry a picture, " + std::to_string(lists_->size()) + " for " + std::to_string(pictures) +
                       " pictures");
  }
  bool given() const { return lists_.has_value(); }
  const std::string& name() const { return name_; }
  /// `count` numbers of picture `i`.
  std::vector<double> Numbers(size_t i, size_t count) const {
    const Doubles numbers = ToNumbers((*lists_)[i], name_.c_str());
    if (numbers.ndim() != 1 || static_cast<size_t>(numbers.size()) != count)
      throw InputError(name_ + ": picture " + std::to_string(i) + " needs " + std::to_string(count) + " numbers, one an object");
    for (size_t k = 0; k < count; ++k) Finite(numbers.data()[k], name_.c_str());
    return {numbers.data(), numbers.data() + count};
  }
  std::vector<int64_t> Integers(size_t i, size_t count) const {
    const auto integers = (*lists_)[i].cast<std::vector<int64_t>>();
    if (integers.size() != count)
      throw InputError(name_ + ": picture " + std::to_string(i) + " needs " + std::to_string(count) + " ids, one an object");
    return integers;
  }
  py::object At(size_t i) const { return (*lists_)[i]; }

 private:
  std::string name_;
  std::optional<py::sequence> lists_;
};

/// (K, columns) or (K, …, columns) finite numbers; no rows where there is nothing.
Doubles Rows(const Lists& lists, size_t i, py::ssize_t dimensions, const std::vector<py::ssize_t>& columns, const char* shape) {
  const Doubles rows = ToNumbers(lists.At(i), lists.name().c_str());
  const bool fits = rows.ndim() == dimensions && std::ranges::find(columns, rows.shape(dimensions - 1)) != columns.end();
  if (rows.size() > 0 && !fits) throw InputError(lists.name() + ": picture " + std::to_string(i) + " needs an array of " + shape);
  for (py::ssize_t k = 0; k < rows.size(); ++k) Finite(rows.data()[k], lists.name().c_str());
  return rows;
}
size_t CountOf(const Doubles& rows) { return rows.size() == 0 ? 0 : static_cast<size_t>(rows.shape(0)); }

/// What boxes and keypoints have in common.
struct Common {
  size_t pictures;
  Lists predictions, scores, truths, pred_categories, categories, crowds, areas;

  Common(const py::sequence& p, const py::sequence& s, const py::sequence& t, const py::object& pc, const py::object& c,
         const py::object& crowd, const py::object& area)
      : pictures(t.size()),
        predictions(p, "predictions", pictures),
        scores(s, "scores", pictures),
        truths(t, "truths", pictures),
        pred_categories(pc, "pred_categories", pictures),
        categories(c, "categories", pictures),
        crowds(crowd, "crowds", pictures),
        areas(area, "areas", pictures) {
    if (pictures == 0) throw InputError("truths: no pictures");
    if (pred_categories.given() != categories.given())
      throw InputError(std::string(categories.given() ? "pred_categories" : "categories") + ": give the categories of both, or of neither");
  }
};

/// Fills image, category, score of the objects [first, …) that are predictions of picture `i`.
void FinishPredictions(const Common& common, size_t i, std::vector<CocoObject>& objects, size_t first) {
  const size_t count = objects.size() - first;
  const std::vector<double> scores = common.scores.Numbers(i, count);
  const auto categories = common.categories.given() ? common.pred_categories.Integers(i, count) : std::vector<int64_t>(count, 0);
  for (size_t k = 0; k < count; ++k) {
    objects[first + k].image = static_cast<int64_t>(i);
    objects[first + k].category = categories[k];
    objects[first + k].score = scores[k];
  }
}

/// The same of truths, with crowds and areas.
void FinishTruths(const Common& common, size_t i, std::vector<CocoObject>& objects, size_t first) {
  const size_t count = objects.size() - first;
  const auto categories = common.categories.given() ? common.categories.Integers(i, count) : std::vector<int64_t>(count, 0);
  const auto crowds = common.crowds.given() ? common.crowds.Integers(i, count) : std::vector<int64_t>(count, 0);
  for (size_t k = 0; k < count; ++k) {
    objects[first + k].image = static_cast<int64_t>(i);
    objects[first + k].category = categories[k];
    objects[first + k].crowd = crowds[k] != 0;
  }
  if (!common.areas.given()) return;
  const std::vector<double> areas = common.areas.Numbers(i, count);
  for (size_t k = 0; k < count; ++k) objects[first + k].area = areas[k];
}

py::dict Score(CocoTruths& truths, const std::vector<CocoObject>& results, const CocoRun& run, const std::vector<CocoFigure>& figures,
               const std::vector<double>& sigmas, bool categories_given) {
  std::map<int64_t, size_t> ids;
  for (const CocoObject& object : truths.objects) ids.emplace(object.category, 0);
  if (!categories_given) ids.emplace(0, 0);
  for (const auto& [id, unused] : ids) truths.categories.push_back({.id = id, .name = "", .sigmas = sigmas});
  CocoTable table(run.options, truths.categories.size());
  {
    const py::gil_scoped_release release;
    table = AccumulateCoco(MatchAll(truths, results, run), run.options, truths.categories.size());
  }
  py::dict dict, each;
  for (const CocoFigure& figure : figures) dict[py::str(figure.name)] = ValueOf(figure, table, run.options);
  for (size_t c = 0; categories_given && c < truths.categories.size(); ++c) {
    py::dict one;
    for (const CocoFigure& figure : figures) one[py::str(figure.name)] = ValueOf(figure, table, run.options, c);
    each[py::int_(truths.categories[c].id)] = one;
  }
  dict["per_category"] = each;
  return dict;
}

struct BoxKind {
  CocoKind kind;
  std::vector<py::ssize_t> columns;
  const char* shape;
};

BoxKind FindBoxKind(const std::string& name) {
  static const std::map<std::string, BoxKind> kKinds = {
      {"bbox", {CocoKind::kBoxes, {4}, "(K, 4): x, y, width, height in pixels"}},
      {"bfov", {CocoKind::kSphericalBoxes, {4, 5}, "(K, 4) or (K, 5): lon, lat, width, height, turn in radians"}},
      {"box3d", {CocoKind::kBoxes3d, {7}, "(K, 7): centre x, y, z, length, width, height in metres, yaw in radians"}}};
  const auto found = kKinds.find(name);
  if (found != kKinds.end()) return found->second;
  throw InputError("kind: " + UnknownChoiceMessage("kind of box", name, std::vector<std::string>{"bbox", "bfov", "box3d"}));
}

CocoObject ToBox(const double* row, py::ssize_t columns, CocoKind kind, const std::string& what) {
  CocoObject object;
  if (kind == CocoKind::kBoxes) {
    std::copy(row, row + 4, object.box.begin());
    if (row[2] < 0 || row[3] < 0) throw InputError(what + ": a box is x, y, width, height; a width or height is not below 0");
    object.area = row[2] * row[3];
  } else if (kind == CocoKind::kSphericalBoxes) {
    for (py::ssize_t k = 0; k < columns; ++k) object.bfov[static_cast<size_t>(k)] = row[k] / kDegree;
    if (!(row[2] > 0 && row[2] < kPi && row[3] > 0 && row[3] < kPi))
      throw InputError(what + ": width and height of a box on the sphere must lie between 0 and pi");
  } else {
    std::copy(row, row + 7, object.box3d.begin());
    object.box3d[6] /= kDegree;
    if (!(row[3] > 0 && row[4] > 0 && row[5] > 0)) throw InputError(what + ": sizes of a box must be above 0");
  }
  return object;
}

void AddBoxes(const Lists& lists, size_t i, const BoxKind& kind, std::vector<CocoObject>& objects) {
  const Doubles rows = Rows(lists, i, 2, kind.columns, kind.shape);
  for (size_t k = 0; k < CountOf(rows); ++k)
    objects.push_back(ToBox(rows.data() + static_cast<py::ssize_t>(k) * rows.shape(1), rows.shape(1), kind.kind, lists.name()));
}

py::dict Boxes(const py::sequence& predictions, const py::sequence& scores, const py::sequence& truths, const std::string& kind,
               const py::object& pred_categories, const py::object& categories, const py::object& crowds, const py::object& areas,
               std::optional<int> wrap) {
  const BoxKind box = FindBoxKind(kind);
  const bool flat = box.kind == CocoKind::kBoxes;
  if (!flat && wrap) throw InputError("wrap: is for the kind bbox: the others have no seam");
  if (!flat && !areas.is_none()) throw InputError("areas: are for the kind bbox: figures of the others know no area");
  if (wrap && *wrap < 1) throw InputError("wrap: " + std::to_string(*wrap) + " is no width of a panorama, pixels");
  const Common common(predictions, scores, truths, pred_categories, categories, crowds, areas);
  CocoTruths all;
  std::vector<CocoObject> results;
  for (size_t i = 0; i < common.pictures; ++i) {
    all.images.push_back({.id = static_cast<int64_t>(i), .name = "", .width = wrap.value_or(0)});
    const size_t first = results.size(), first_truth = all.objects.size();
    AddBoxes(common.predictions, i, box, results);
    AddBoxes(common.truths, i, box, all.objects);
    FinishPredictions(common, i, results, first);
    FinishTruths(common, i, all.objects, first_truth);
  }
  CocoRun run{.kind = box.kind, .wrap = wrap.has_value()};
  if (!flat) run.options.areas = {{-1, std::numeric_limits<double>::infinity()}};
  return Score(all, results, run, flat ? InstanceFigures(run.options) : PlainFigures(run.options), {}, common.categories.given());
}

constexpr const char* kKeypointShape = "(K, n, 3): x, y in pixels and v, above 0 where a truth is labelled";

py::dict Keypoints(const py::sequence& predictions, const py::sequence& scores, const py::sequence& truths, const py::sequence& boxes,
                   const py::object& sigmas, const py::object& pred_categories, const py::object& categories, const py::object& crowds,
                   const py::object& areas) {
  const Common common(predictions, scores, truths, pred_categories, categories, crowds, areas);
  const Lists box_lists(boxes, "boxes", common.pictures);
  const auto known = CocoKeypointSigmas();
  std::vector<double> own(known.begin(), known.end());
  if (!sigmas.is_none()) {
    const Doubles given = ToNumbers(sigmas, "sigmas");
    own.assign(given.data(), given.data() + given.size());
    if (given.ndim() != 1 || own.empty() || std::ranges::any_of(own, [](double s) { return !(s > 0 && s < 1e9); }))
      throw InputError("sigmas: (n,) numbers above 0");
  }
  CocoTruths all;
  std::vector<CocoObject> results;
  const auto add = [&](const Lists& lists, size_t i, std::vector<CocoObject>& objects) {
    const Doubles rows = Rows(lists, i, 3, {3}, kKeypointShape);
    if (CountOf(rows) > 0 && static_cast<size_t>(rows.shape(1)) != own.size())
      throw InputError(lists.name() + ": picture " + std::to_string(i) + " has " + std::to_string(rows.shape(1)) +
                       " keypoints an object, and there are " + std::to_string(own.size()) + " sigmas");
    for (size_t k = 0; k < CountOf(rows); ++k) {
      const double* row = rows.data() + static_cast<py::ssize_t>(3 * own.size() * k);
      CocoObject& object = objects.emplace_back();
      object.keypoints.assign(row, row + 3 * own.size());
    }
  };
  for (size_t i = 0; i < common.pictures; ++i) {
    all.images.push_back({.id = static_cast<int64_t>(i), .name = ""});
    const size_t first = results.size(), first_truth = all.objects.size();
    add(common.predictions, i, results);
    for (size_t k = first; k < results.size(); ++k) results[k].area = KeypointArea(results[k].keypoints);
    add(common.truths, i, all.objects);
    const size_t count = all.objects.size() - first_truth;
    const Doubles around = Rows(box_lists, i, 2, {4}, "(K, 4): x, y, width, height in pixels");
    if (CountOf(around) != count)
      throw InputError("boxes: picture " + std::to_string(i) + " needs one for each of its " + std::to_string(count) + " truths");
    for (size_t k = 0; k < count; ++k) {
      CocoObject& object = all.objects[first_truth + k];
      std::copy(around.data() + 4 * k, around.data() + 4 * k + 4, object.box.begin());
      object.area = object.box[2] * object.box[3];
      object.no_keypoints = true;
      for (size_t j = 2; j < object.keypoints.size(); j += 3) object.no_keypoints &= !(object.keypoints[j] > 0);
    }
    FinishPredictions(common, i, results, first);
    FinishTruths(common, i, all.objects, first_truth);
  }
  CocoRun run{.kind = CocoKind::kKeypoints, .options = KeypointCocoOptions()};
  return Score(all, results, run, KeypointFigures(), own, common.categories.given());
}

}  // namespace

void BindCocoMetrics(py::module_& metrics) {
  const py::none none;
  metrics.def(
      "boxes", &Boxes, py::arg("predictions"), py::arg("scores"), py::arg("truths"), py::arg("kind") = "bbox",
      py::arg("pred_categories") = none, py::arg("categories") = none, py::arg("crowds") = none, py::arg("areas") = none,
      py::arg("wrap") = none,
      "COCO's average precision of boxes (cocodataset.org/#detection-eval), lists of one entry a picture: predictions (K, columns), scores (K,), truths "
      "(G, columns). kind: bbox (x, y, width, height, pixels), bfov (lon, lat, width, height[, turn], radians) or box3d (centre x, y, z, length, width, "
      "height, metres, yaw, radians). pred_categories (K,) and categories (G,): whole numbers, both or neither (all are one). crowds (G,): 1 = a crowd. "
      "areas (G,): pixels, of bbox, instead of width * height. wrap: width of panoramas in pixels whose columns go round, of bbox. A dict: of bbox the "
      "twelve figures ap, ap50, ap75, ap_small, ap_medium, ap_large, ar1, ar10, ar100, ar_small, ar_medium, ar_large, else ap, ap50, ap75, ar; "
      "per_category, those of each id. -1 = no truth. ValueError names the argument that does not fit.");
  metrics.def(
      "keypoints", &Keypoints, py::arg("predictions"), py::arg("scores"), py::arg("truths"), py::arg("boxes"), py::arg("sigmas") = none,
      py::arg("pred_categories") = none, py::arg("categories") = none, py::arg("crowds") = none, py::arg("areas") = none,
      "COCO's average precision by object keypoint similarity (cocodataset.org/#keypoints-eval), lists of one entry a picture: predictions (K, n, 3), scores "
      "(K,), truths (G, n, 3): x, y in pixels, v above 0 where labelled; truths without any do not count. boxes (G, 4) of the truths: x, y, width, height, "
      "pixels. sigmas (n,): deviations relative to the root of the area, COCO's 17 by default. areas (G,): pixels, instead of width * height. Categories and "
      "crowds as of boxes. A dict: ap, ap50, ap75, ap_medium, ap_large, ar, ar50, ar75, ar_medium, ar_large; per_category. -1 = no truth. ValueError names "
      "the argument that does not fit.");
}

}  // namespace airsim360::python

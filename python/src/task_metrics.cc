// airsim360.metrics: scores of tasks on arrays, the same functions as `airsim360 eval`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/objects.h"
#include "airsim360/eval/coco/summary.h"
#include "airsim360/eval/depth/depth_metrics.h"
#include "airsim360/eval/flow/flow_metrics.h"
#include "airsim360/eval/layout/layout_metrics.h"
#include "airsim360/eval/mpde_metrics.h"
#include "airsim360/eval/navigation/vln_scores.h"
#include "airsim360/eval/panoptic/panoptic_quality.h"
#include "airsim360/eval/panoptic/tracking_quality.h"
#include "airsim360/eval/semantic/confusion.h"
#include "airsim360/eval/sphere/pixel_view.h"
#include "airsim360/eval/spherical_iou.h"
#include "convert.h"

namespace airsim360::python {
namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int64_t kLeastId = std::numeric_limits<int64_t>::min(), kMostId = std::numeric_limits<int64_t>::max(), kMost32 = 0xffffffff;

/// Whole numbers of `least` to `most`, of any dtype of numbers; floats must be whole. `masked` as of ToNumbers. What is hidden may be anything.
Array<int64_t> ToIds(const py::handle& value, const char* what, int64_t least = kLeastId, int64_t most = kMostId,
                     std::optional<int64_t> masked = {}) {
  const PlainArray plain = ToPlainArray(value, what, masked.has_value());
  const char kind = plain.values.dtype().kind();
  Array<int64_t> ids(std::vector<py::ssize_t>(plain.values.shape(), plain.values.shape() + plain.values.ndim()));
  const auto fill = [&]<class T>(const Array<T>& given, const auto& fits) {
    for (py::ssize_t i = 0; i < given.size(); ++i) {
      const T id = given.data()[i];
      const bool hidden = plain.hidden && plain.hidden->data()[i];
      if (!hidden && !fits(id))
        throw InputError(std::string(what) + ": " + py::str(py::cast(id)).cast<std::string>() + " is no id" +
                         (most == kMost32 ? " (whole numbers, 0 to 4294967295)" : " (whole numbers)"));
      ids.mutable_data()[i] = hidden ? *masked : static_cast<int64_t>(id);
    }
  };
  if (kind == 'f') {
    constexpr double kWhole = 9007199254740992;  // from here on not every whole number is a double
    fill(Array<double>::ensure(plain.values), [&](double id) {
      return id == std::floor(id) && std::abs(id) <= kWhole && id >= static_cast<double>(least) && id <= static_cast<double>(most);
    });
  } else if (kind == 'u') {
    fill(Array<uint64_t>::ensure(plain.values), [&](uint64_t id) { return id <= static_cast<uint64_t>(most); });
  } else if (kind == 'i' || kind == 'b') {
    fill(Array<int64_t>::ensure(plain.values), [&](int64_t id) { return id >= least && id <= most; });
  } else {
    RefuseDtype(plain.values, what, "not an array of ids");
  }
  return ids;
}

/// Ids of 32 bits.
std::vector<uint32_t> Narrow(const Array<int64_t>& ids) { return {ids.data(), ids.data() + ids.size()}; }

/// Masks: what is not 0 is in. Floats and more than one value that is not 0 are refused: probabilities and ids are no masks.
Array<uint8_t> ToMasks(const py::handle& value, const char* what) {
  const PlainArray plain = ToPlainArray(value, what, false);
  const char kind = plain.values.dtype().kind();
  if (plain.values.size() > 0 && kind != 'b' && kind != 'i' && kind != 'u' && kind != 'f')
    RefuseDtype(plain.values, what, "not an array of masks");
  const Array<double> numbers = Array<double>::ensure(plain.values);
  Array<uint8_t> masks(std::vector<py::ssize_t>(numbers.shape(), numbers.shape() + numbers.ndim()));
  double inside = kind == 'f' ? 1 : 0;
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers.data()[i];
    if (inside == 0) inside = number;
    if (number != 0 && number != inside)
      throw InputError(std::string(what) + ": " + py::str(py::cast(number)).cast<std::string>() +
                       (kind == 'f'
                            ? " is neither 0 nor 1: compare probabilities with a threshold first"
                            : " and " + py::str(py::cast(inside)).cast<std::string>() + " in masks: ids are no masks, give one mask each"));
    masks.mutable_data()[i] = number != 0;
  }
  return masks;
}

template <class T>
std::span<const T> Span(const Array<T>& array) {
  return {array.data(), static_cast<size_t>(array.size())};
}

void CheckSameShape(const py::array& a, const py::array& b, const char* names) {
  bool same = a.ndim() == b.ndim();
  for (py::ssize_t i = 0; same && i < a.ndim(); ++i) same = a.shape(i) == b.shape(i);
  if (!same) throw InputError(std::string(names) + ": arrays of different shape");
}

/// What `measure` gives; its errors name the argument `weights`, which is --weights of the command.
template <class Measure>
auto WithWeights(const Measure& measure) {
  try {
    return measure();
  } catch (const InputError& error) {
    constexpr std::string_view kFlag = "--weights";
    std::string text = error.what();
    if (text.starts_with(kFlag)) text.erase(0, 2);
    throw InputError(text);
  }
}

/// One weight a pixel of pictures (H, W), or of each of a stack (N, H, W); empty for pixels.
std::vector<double> WeightsOf(const py::array& pictures, const std::string& name, py::ssize_t trailing = 0) {
  const PixelWeight weight = WithWeights([&] { return ParsePixelWeight(name); });
  if (weight == PixelWeight::kPixel) return {};
  const py::ssize_t last = pictures.ndim() - trailing;
  if (last < 2) throw InputError("weights: pictures must be (H, W)");
  const auto height = static_cast<int>(pictures.shape(last - 2)), width = static_cast<int>(pictures.shape(last - 1));
  const std::vector<double> one = WithWeights([&] { return WholeView(width, height, weight); }).weights;
  std::vector<double> all;
  for (py::ssize_t n = 0, count = last == 3 ? pictures.shape(0) : 1; n < count; ++n) all.insert(all.end(), one.begin(), one.end());
  return all;
}

template <class Names, class Values>
py::dict ToDict(const Names& names, const Values& values) {
  py::dict dict;
  for (size_t i = 0; i < names.size(); ++i) dict[py::str(std::string(names[i]))] = values[i];
  return dict;
}

py::dict Depth(const py::object& prediction, const py::object& truth, const std::string& weights, double min_depth, double max_depth) {
  const Doubles p = ToNumbers(prediction, "prediction"), g = ToNumbers(truth, "truth", kNan);
  CheckSameShape(p, g, "prediction, truth");
  const std::vector<double> w = WeightsOf(g, weights);
  const DepthOptions options{.min_depth = min_depth, .max_depth = max_depth};
  CheckDepthOptions(options);
  DepthErrors errors;
  {
    const py::gil_scoped_release release;
    errors = MeasureDepth(Span(p), Span(g), w, options);
  }
  if (errors.valid == 0) throw InputError("truth: " + NoDepthText(options));
  py::dict dict = ToDict(kDepthFigures, Figures(errors));
  dict["valid"] = errors.valid;
  return dict;
}

// An id that no class has.
int64_t NoClass(const std::vector<int64_t>& classes) {
  int64_t id = kLeastId;
  while (std::ranges::find(classes, id) != classes.end()) ++id;
  return id;
}

std::vector<uint16_t> Classes(const Array<int64_t>& ids, const std::vector<int64_t>& classes) {
  std::map<int64_t, uint16_t> index;
  for (size_t c = 0; c < classes.size(); ++c) index[classes[c]] = static_cast<uint16_t>(c);
  std::vector<uint16_t> result;
  result.reserve(static_cast<size_t>(ids.size()));
  for (const int64_t id : Span(ids)) {
    const auto found = index.find(id);
    result.push_back(found == index.end() ? Confusion::kOther : found->second);
  }
  return result;
}

py::dict Semantic(const py::object& prediction, const py::object& truth, const std::vector<int64_t>& classes, const std::string& weights) {
  const auto p = ToIds(prediction, "prediction"), g = ToIds(truth, "truth", kLeastId, kMostId, NoClass(classes));
  CheckSameShape(p, g, "prediction, truth");
  if (classes.empty() || classes.size() >= Confusion::kOther) throw InputError("classes: must be 1 to 65534 ids");
  std::vector<int64_t> sorted = classes;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    throw InputError("classes: the id " + std::to_string(*twice) + " occurs twice");
  Confusion confusion(classes.size());
  confusion.Add(Classes(p, classes), Classes(g, classes), WeightsOf(g, weights));
  if (std::isnan(confusion.PixelAccuracy())) throw InputError("truth: no pixel is of one of the classes");
  py::dict iou, acc;
  const auto n = static_cast<py::ssize_t>(classes.size());
  py::array_t<double> table({n, n + 1});
  for (size_t t = 0; t < classes.size(); ++t) {
    iou[py::int_(classes[t])] = confusion.Iou(t);
    acc[py::int_(classes[t])] = confusion.Accuracy(t);
    for (size_t c = 0; c <= classes.size(); ++c)
      table.mutable_at(static_cast<py::ssize_t>(t), static_cast<py::ssize_t>(c)) = confusion.At(t, c);
  }
  py::dict dict;
  dict["miou"] = confusion.MeanIou();
  dict["miou_present"] = confusion.MeanIouOfPresent();
  dict["pixel_accuracy"] = confusion.PixelAccuracy();
  dict["macc"] = confusion.MeanAccuracy();
  dict["fwiou"] = confusion.FrequencyWeightedIou();
  dict["iou"] = iou;
  dict["acc"] = acc;
  dict["confusion"] = table;
  return dict;
}

py::dict Panoptic(const py::object& prediction, const py::object& truth, const std::map<uint32_t, int64_t>& predicted,
                  const std::map<uint32_t, int64_t>& real, const std::vector<uint32_t>& crowds, const std::string& weights) {
  // What is hidden is void.
  const auto p = ToIds(prediction, "prediction", 0, kMost32, 0), g = ToIds(truth, "truth", 0, kMost32, 0);
  CheckSameShape(p, g, "prediction, truth");
  for (const uint32_t crowd : crowds) {
    if (!real.contains(crowd)) throw InputError("crowds: " + std::to_string(crowd) + " is no segment of the truth (categories)");
  }
  std::map<int64_t, size_t> categories;
  for (const auto* segments : {&predicted, &real}) {
    for (const auto& [id, category] : *segments) categories.emplace(category, categories.size());
  }
  std::vector<PanopticSegment> ps, gs;
  for (const auto& [id, category] : predicted) ps.push_back({id, categories[category], false});
  for (const auto& [id, category] : real)
    gs.push_back({id, categories[category], std::find(crowds.begin(), crowds.end(), id) != crowds.end()});
  PanopticOverlap overlap;
  overlap.Add(Narrow(p), Narrow(g), WeightsOf(g, weights));
  std::vector<PanopticCount> counts(categories.size());
  overlap.Count(ps, gs, counts);
  py::dict dict;
  for (const auto& [category, index] : categories) {
    const PanopticQuality q = QualityOf(counts[index]);
    py::dict one;
    one["pq"] = q.pq, one["sq"] = q.sq, one["rq"] = q.rq, one["iou"] = counts[index].iou;
    one["tp"] = counts[index].tp, one["fp"] = counts[index].fp, one["fn"] = counts[index].fn;
    dict[py::int_(category)] = one;
  }
  return dict;
}

// The masks (K, H, W) of one picture.
void AddMasks(const py::handle& masks, int64_t image, const char* what, std::vector<CocoObject>& objects, CocoImage& size) {
  const auto array = ToMasks(masks, what);
  if (array.size() == 0) return;
  if (array.ndim() != 3) throw InputError(std::string(what) + ": masks of a picture are (K, H, W)");
  size.height = static_cast<int>(array.shape(1));
  size.width = static_cast<int>(array.shape(2));
  const size_t pixels = static_cast<size_t>(size.height) * static_cast<size_t>(size.width);
  for (py::ssize_t k = 0; k < array.shape(0); ++k) {
    CocoObject object{.image = image, .category = 1};
    object.mask = EncodeMask(Span(array).subspan(static_cast<size_t>(k) * pixels, pixels), size.width, size.height);
    object.area = static_cast<double>(MaskArea(object.mask));
    objects.push_back(std::move(object));
  }
}

py::dict EntityPrecision(const py::sequence& predictions, const py::sequence& scores, const py::sequence& truths,
                         const std::string& weights) {
  if (predictions.size() != truths.size() || scores.size() != truths.size())
    throw InputError("predictions, scores, truths: one entry a picture each");
  CocoTruths all{{}, {{1, "entity"}}, {}, {}};
  std::vector<CocoObject> results;
  for (size_t i = 0; i < truths.size(); ++i) {
    CocoImage image{.id = static_cast<int64_t>(i), .name = ""};
    const size_t first = results.size();
    AddMasks(truths[i], image.id, "truths", all.objects, image);
    AddMasks(predictions[i], image.id, "predictions", results, image);
    const Doubles score = ToNumbers(scores[i], "scores");
    if (static_cast<size_t>(score.size()) != results.size() - first) throw InputError("scores: one a predicted mask");
    for (size_t k = first; k < results.size(); ++k) results[k].score = Finite(score.data()[k - first], "scores");
    all.images.push_back(image);
  }
  CocoRun run{.class_agnostic = true};
  const auto matches = WithWeights([&] {
    run.solid_angle = ParsePixelWeight(weights) == PixelWeight::kSolidAngle;
    return MatchAll(all, results, run);
  });
  const CocoTable table = AccumulateCoco(matches, run.options, 1);
  py::dict dict;
  for (const CocoFigure& figure : InstanceFigures(run.options)) dict[py::str(figure.name)] = ValueOf(figure, table, run.options);
  return dict;
}

// (H, W, 2), also of (2, H, W).
Doubles ToFlow(const Doubles& flow, const char* what) {
  if (flow.ndim() == 3 && flow.shape(2) == 2) return flow;
  if (flow.ndim() != 3 || flow.shape(0) != 2) throw InputError(std::string(what) + ": flow is (H, W, 2) or (2, H, W)");
  const py::ssize_t height = flow.shape(1), width = flow.shape(2);
  Doubles turned({height, width, py::ssize_t{2}});
  for (py::ssize_t i = 0; i < height * width; ++i) {
    turned.mutable_data()[2 * i] = flow.data()[i];
    turned.mutable_data()[2 * i + 1] = flow.data()[height * width + i];
  }
  return turned;
}

py::dict FlowOf(const py::object& prediction, const py::object& truth, const std::string& weights) {
  const Doubles p = ToFlow(ToNumbers(prediction, "prediction"), "prediction"), g = ToFlow(ToNumbers(truth, "truth", kNan), "truth");
  CheckSameShape(p, g, "prediction, truth");
  const FlowErrors errors = MeasureFlow(Span(p), Span(g), static_cast<int>(g.shape(1)), static_cast<int>(g.shape(0)),
                                        g.shape(1) == 2 * g.shape(0), {}, WeightsOf(g, weights, 1));
  if (errors.valid == 0) throw InputError("truth: no pixel has a flow");
  py::dict dict = ToDict(kFlowFigures, Figures(errors));
  dict["valid"] = errors.valid;
  return dict;
}

py::dict Vln(const py::object& flown, const py::object& reference, double radius, const std::string& protocol, const py::object& goal,
             const py::object& shortest, bool stopped, bool collided) {
  VlnEpisode episode{
      .reference = ToPoints(reference, "reference"), .flown = ToPoints(flown, "flown"), .stopped = stopped, .collided = collided};
  if (!goal.is_none()) episode.goal = ToVec3(goal, "goal");
  if (!shortest.is_none()) episode.shortest = Finite(shortest.cast<double>(), "shortest");
  return ToDict(kVlnFigures, Figures(ScoreVln(episode, radius, FindVlnProtocol(protocol))));
}

py::dict Mpde(const py::object& distance, const py::object& angle, const py::object& true_distance, const py::object& true_angle) {
  const Doubles d = ToNumbers(distance, "distance"), a = ToNumbers(angle, "angle"), td = ToNumbers(true_distance, "true_distance"),
                ta = ToNumbers(true_angle, "true_angle");
  CheckSameShape(d, a, "distance, angle");
  CheckSameShape(d, td, "distance, true_distance");
  CheckSameShape(d, ta, "distance, true_angle");
  std::vector<PersonPose> prediction, truth;
  for (py::ssize_t i = 0; i < d.size(); ++i) {
    prediction.push_back({CheckPersonDistance(d.data()[i], "distance"), a.data()[i]});
    truth.push_back({CheckPersonDistance(td.data()[i], "true_distance"), ta.data()[i]});
  }
  const MpdeErrors e = MeasureMpde(prediction, truth);
  py::dict dict;
  dict["count"] = e.count, dict["distance_mae_m"] = e.distance_mae_m, dict["angle_mae_deg"] = e.angle_mae_deg,
  dict["angle_unwrapped_mae_deg"] = e.angle_unwrapped_mae_deg;
  return dict;
}

RoomLayout ToRoom(const py::object& corners, const char* what) {
  const Doubles array = ToNumbers(corners, what);
  if (array.ndim() != 2 || array.shape(1) != 2 || array.shape(0) % 2 != 0)
    throw InputError(std::string(what) + ": corners are (2 N, 2), ceiling and floor in turn");
  RoomLayout room;
  for (py::ssize_t i = 0; i < array.shape(0); i += 2) {
    room.ceiling.push_back({array.at(i, 0), array.at(i, 1)});
    room.floor.push_back({array.at(i + 1, 0), array.at(i + 1, 1)});
  }
  return room;
}

py::dict Layout(const py::object& prediction, const py::object& truth, int width) {
  if (width < 8 || width > 16384 || width % 2 != 0) throw InputError("width " + std::to_string(width) + ": must be even, 8 to 16384");
  return ToDict(kLayoutFigures, Figures(MeasureLayout(ToRoom(prediction, "prediction"), ToRoom(truth, "truth"), width, width / 2)));
}

py::dict Tracking(const py::object& pred_category, const py::object& pred_instance, const py::object& category, const py::object& instance,
                  const std::vector<bool>& things) {
  if (things.empty()) throw InputError("things: a flag a category");
  const auto categories = [&](const py::object& value, const char* what) {
    const auto ids = ToIds(value, what, 0, kMost32, kMost32);
    for (const int64_t id : Span(ids)) {
      if (id >= static_cast<int64_t>(things.size()) && id != kMost32)
        throw InputError(std::string(what) + ": " + std::to_string(id) + " is none of the " + std::to_string(things.size()) +
                         " categories that things has, and not 0xffffffff (void)");
    }
    return ids;
  };
  const auto pc = categories(pred_category, "pred_category"), pi = ToIds(pred_instance, "pred_instance", 0, kMost32),
             c = categories(category, "category"), i = ToIds(instance, "instance", 0, kMost32);
  CheckSameShape(pc, pi, "pred_category, pred_instance");
  CheckSameShape(pc, c, "pred_category, category");
  CheckSameShape(pc, i, "pred_category, instance");
  TrackingQuality quality(things);
  const auto pc32 = Narrow(pc), pi32 = Narrow(pi), c32 = Narrow(c), i32 = Narrow(i);
  quality.Add({pc32, pi32}, {c32, i32});
  const TrackingScore s = quality.Score();
  py::dict dict;
  dict["stq"] = s.stq, dict["aq"] = s.aq, dict["sq"] = s.sq, dict["tubes"] = s.tubes;
  return dict;
}

SphericalBox ToBfov(const py::object& box, const char* what) {
  const Doubles a = ToNumbers(box, what);
  if (a.ndim() != 1 || (a.size() != 4 && a.size() != 5))
    throw InputError(std::string(what) + ": a box is (lon, lat, width, height[, turn])");
  return {a.data()[0], a.data()[1], a.data()[2], a.data()[3], a.size() == 5 ? a.data()[4] : 0};
}

}  // namespace

void BindTaskMetrics(py::module_& metrics) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  metrics.def(
      "depth", &Depth, py::arg("prediction"), py::arg("truth"), py::arg("weights") = "pixel", py::arg("min_depth") = 0.0,
      py::arg("max_depth") = kInfinity,
      "Errors of ranges (H, W), metres, as a dict: absrel, sqrel, rmse, rmselog, log10, mae, d1, d2, d3, silog, tau, valid. weights: pixel or solid_angle.");
  metrics.def(
      "semantic", &Semantic, py::arg("prediction"), py::arg("truth"), py::arg("classes"), py::arg("weights") = "pixel",
      "Classes of pictures (H, W) or of a stack (N, H, W), in one table: miou, miou_present, pixel_accuracy, macc, fwiou, iou and acc by id, confusion (n, n + 1).");
  metrics.def(
      "panoptic", &Panoptic, py::arg("prediction"), py::arg("truth"), py::arg("pred_categories"), py::arg("categories"),
      py::arg("crowds") = std::vector<uint32_t>{}, py::arg("weights") = "pixel",
      "Panoptic quality of ids (H, W), 0 = void, whose categories are dicts id -> category: a dict category -> pq, sq, rq, iou, tp, fp, fn.");
  metrics.def("entity", &EntityPrecision, py::arg("predictions"), py::arg("scores"), py::arg("truths"), py::arg("weights") = "pixel",
              "COCO's twelve figures of masks without categories: of each picture masks (K, H, W) and scores (K,).");
  metrics.def("flow", &FlowOf, py::arg("prediction"), py::arg("truth"), py::arg("weights") = "pixel",
              "Errors of flow (H, W, 2) or (2, H, W), NaN = unknown: epe, fl_all, below1, below3, below5, angle_error_deg, valid.");
  metrics.def("vln", &Vln, py::arg("flown"), py::arg("reference"), py::arg("radius") = 20.0, py::arg("protocol") = "ours",
              py::arg("goal") = py::none(), py::arg("shortest") = py::none(), py::arg("stopped") = true, py::arg("collided") = false,
              "Scores of one flown path (N, 3): sr, osr, spl, spl_straight, ne, ndtw, sdtw, cls, path_length.");
  metrics.def("mpde", &Mpde, py::arg("distance"), py::arg("angle"), py::arg("true_distance"), py::arg("true_angle"),
              "Errors of distances (N,), metres, and angles (N,), radians: count, distance_mae_m, angle_mae_deg, angle_unwrapped_mae_deg.");
  metrics.def(
      "layout", &Layout, py::arg("prediction"), py::arg("truth"), py::arg("width") = 1024,
      "Errors of a room of corners (2 N, 2) in pixels, ceiling and floor in turn: iou2d, iou3d, corner_error_percent, pixel_error_percent, rmse, d1.");
  metrics.def("tracking", &Tracking, py::arg("pred_category"), py::arg("pred_instance"), py::arg("category"), py::arg("instance"),
              py::arg("things"), "STEP's stq, aq, sq, tubes of one video: arrays (T, H, W), 0xffffffff = void; things: a flag a category.");
  metrics.def(
      "bfov_iou", [](const py::object& a, const py::object& b) { return SphericalIou(ToBfov(a, "a"), ToBfov(b, "b")); }, py::arg("a"),
      py::arg("b"), "Unbiased intersection over union of boxes (lon, lat, width, height[, turn]) on the sphere, radians.");
}

}  // namespace airsim360::python

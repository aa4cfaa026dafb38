// airsim360 eval video: STQ and VPQ of panoptic video.
#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_panoptic_input.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_video_input.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/panoptic/tracking_quality.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct EvalVideoArguments {
  PanopticPaths paths;
  std::string protocol;
  std::vector<int> windows = {1, 2, 3, 4};
  StepOptions step;
  std::string step_flag;  // the first flag that was given and is for STEP's PNGs alone
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
  std::vector<std::string> held_out;
};

// What a part of the pictures of a sequence gives.
struct Part {
  std::shared_ptr<TrackingQuality> tracking;
  std::map<int, std::vector<PanopticCount>> windows;
};
// What one sequence gives.
struct Result {
  std::vector<Part> views, rolled;
  std::vector<double> frame_pq;                                 // of each frame, the whole picture
  std::vector<std::pair<std::string, LikelyMistake>> mistakes;  // of each frame
};

// Category and instance of every pixel, as the tracking term sees them.
struct Labels {
  std::vector<uint32_t> category, instance;
};
Labels LabelsOf(const LabelPicture& picture, const std::vector<PanopticSegment>& segments, const std::vector<bool>& things,
                const std::string& name) {
  std::unordered_map<uint32_t, std::pair<uint32_t, uint32_t>> of_id = {{0, {TrackingQuality::kVoid, 0}}};
  for (const PanopticSegment& s : segments) of_id[s.id] = {static_cast<uint32_t>(s.category), things[s.category] && !s.crowd ? s.id : 0};
  Labels labels;
  labels.category.reserve(picture.ids.size());
  labels.instance.reserve(picture.ids.size());
  for (const uint32_t id : picture.ids) {
    const auto found = of_id.find(id);
    if (found == of_id.end()) throw InputError(name + ": pixels have the id " + std::to_string(id) + ", but no segment of it is listed");
    labels.category.push_back(found->second.first);
    labels.instance.push_back(found->second.second);
  }
  return labels;
}

// Segments of a window of frames: an id is one thing throughout.
void MergeSegments(const std::vector<PanopticSegment>& more, std::map<uint32_t, PanopticSegment>& all, const char* whose) {
  for (const PanopticSegment& s : more) {
    const auto [at, fresh] = all.emplace(s.id, s);
    if (!fresh && at->second.category != s.category)
      throw InputError(std::string(whose) + " segment " + std::to_string(s.id) + " changes its category within a window of video");
    at->second.crowd |= s.crowd;
  }
}

std::vector<PanopticSegment> Values(const std::map<uint32_t, PanopticSegment>& segments) {
  std::vector<PanopticSegment> list;
  for (const auto& [id, segment] : segments) list.push_back(segment);
  return list;
}

struct SeenFrame {
  PanopticOverlap overlap;
  std::vector<PanopticSegment> predicted, real;
};

void CountWindows(const std::vector<SeenFrame>& frames, int window, std::vector<PanopticCount>& counts) {
  // A sequence shorter than a window is one window.
  const size_t length = std::min(static_cast<size_t>(window), frames.size());
  for (size_t first = 0; first + length <= frames.size(); ++first) {
    PanopticOverlap overlap;
    std::map<uint32_t, PanopticSegment> predicted, real;
    for (size_t f = first; f < first + length; ++f) {
      overlap.Add(frames[f].overlap);
      MergeSegments(frames[f].predicted, predicted, "predicted");
      MergeSegments(frames[f].real, real, "true");
    }
    overlap.Count(Values(predicted), Values(real), counts);
  }
}

// A part of a sequence's pictures while its frames go by.
class PartCounter {
 public:
  explicit PartCounter(const std::vector<bool>& things) : things_(things), tracking_(std::make_shared<TrackingQuality>(things)) {}

  void Add(const VideoFrame& frame, const LabelPicture& prediction, const PixelView& view, const std::string& name) {
    const LabelPicture pred{prediction.width, prediction.height, Take<uint32_t>(prediction.ids, view)},
        real{frame.truth.width, frame.truth.height, Take<uint32_t>(frame.truth.ids, view)};
    const Labels predicted = LabelsOf(pred, frame.predicted, things_, name), truth = LabelsOf(real, frame.real, things_, name);
    tracking_->Add({predicted.category, predicted.instance}, {truth.category, truth.instance}, view.weights);
    SeenFrame& seen = frames_.emplace_back();
    seen.overlap.Add(pred.ids, real.ids, view.weights);
    // A part need not show all that is listed of the whole picture.
    const bool whole = view.source.empty();
    seen.predicted = whole ? frame.predicted : seen.overlap.PresentPredictions(frame.predicted);
    seen.real = whole ? frame.real : seen.overlap.PresentTruths(frame.real);
  }

  Part Count(const std::vector<int>& windows) const {
    Part part{tracking_, {}};
    for (const int window : windows) {
      auto& counts = part.windows[window];
      counts.resize(things_.size());
      CountWindows(frames_, window, counts);
    }
    return part;
  }

  /// Panoptic quality of each frame alone.
  std::vector<double> FrameQualities() const {
    std::vector<double> qualities;
    for (const SeenFrame& frame : frames_) {
      std::vector<PanopticCount> counts(things_.size());
      frame.overlap.Count(frame.predicted, frame.real, counts);
      qualities.push_back(MeanQuality(counts, std::vector<bool>(counts.size(), true)).pq);
    }
    return qualities;
  }

 private:
  const std::vector<bool>& things_;
  std::shared_ptr<TrackingQuality> tracking_;
  std::vector<SeenFrame> frames_;
};

LikelyMistake MistakeOf(const VideoFrame& frame, const std::vector<bool>& things, const std::string& name, bool panorama) {
  if (frame.mistake.sure) return frame.mistake;
  const Labels pred = LabelsOf(frame.prediction, frame.predicted, things, name), gt = LabelsOf(frame.truth, frame.real, things, name);
  const int width = frame.truth.width, height = frame.truth.height;
  LikelyMistake seen_so = LikelyLabelMistake(pred.category, gt.category, width, height,
                                             {.void_label = TrackingQuality::kVoid, .panorama = panorama && width == 2 * height});
  return seen_so.sure || frame.mistake.text.empty() ? seen_so : frame.mistake;
}

// The sequence `index` of the video and of its predictions of pictures that were moved.
Result MeasureSequence(const Video& video, const std::vector<Video>& rolled, const std::vector<Rolled>& turns, size_t index,
                       const EvalVideoArguments& a, bool panorama, ViewCache& cache) {
  std::vector<bool> things;
  for (const PanopticCategory& category : video.categories) things.push_back(category.thing);
  const Sequence& sequence = video.sequences[index];
  Result result;
  std::vector<PartCounter> parts, moved;
  for (size_t r = 0; r < turns.size(); ++r) moved.emplace_back(things);
  try {
    for (size_t f = 0; f < sequence.frames.size(); ++f) {
      const VideoFrame frame = sequence.frames[f]();
      const std::string name = "frame " + std::to_string(f);
      const auto views = cache.Of(frame.truth.width, frame.truth.height);
      while (parts.size() < views->size()) parts.emplace_back(things);
      for (size_t v = 0; v < views->size(); ++v) parts[v].Add(frame, frame.prediction, (*views)[v], name);
      for (size_t r = 0; r < turns.size(); ++r) {
        VideoFrame turned = rolled[r].sequences[index].frames[f]();
        turned.prediction.ids = turns[r].Back<uint32_t>(turned.prediction.ids, turned.prediction.width);
        moved[r].Add(turned, turned.prediction, views->front(), name + " of " + turns[r].path);
      }
      result.mistakes.push_back({frame.file, MistakeOf(frame, things, name, panorama)});
    }
    for (const PartCounter& part : parts) result.views.push_back(part.Count(a.windows));
    for (const PartCounter& part : moved) result.rolled.push_back(part.Count(a.windows));
    result.frame_pq = parts.front().FrameQualities();
  } catch (const InputError& error) {
    throw InputError("sequence '" + sequence.name + "': " + error.what());
  }
  return result;
}

struct Scores {
  TrackingScore tracking;
  std::map<int, std::vector<PanopticCount>> windows;
};

// Of all sequences, the part that of(result) is.
template <class Of>
Scores Pool(const std::vector<Result>& results, size_t categories, const Of& of, std::span<const uint32_t> draws = {}) {
  Scores scores;
  std::vector<const TrackingQuality*> tracking;
  for (size_t i = 0; i < results.size(); ++i) {
    const Part& part = of(results[i]);
    for (uint32_t draw = 0; draw < (draws.empty() ? 1 : draws[i]); ++draw) {
      tracking.push_back(part.tracking.get());
      for (const auto& [window, counts] : part.windows) {
        auto& sum = scores.windows[window];
        sum.resize(categories);
        AddCounts(counts, sum);
      }
    }
  }
  scores.tracking = TrackingQuality::Pool(tracking);
  return scores;
}

double MeanVpq(const Scores& scores, const std::vector<bool>& chosen) {
  double sum = 0;
  for (const auto& [window, counts] : scores.windows) sum += MeanQuality(counts, chosen).pq;
  return sum / static_cast<double>(scores.windows.size());
}

std::vector<Figure> FiguresOf(const Scores& scores, const std::vector<PanopticCategory>& categories) {
  std::vector<Figure> figures = {{"stq", scores.tracking.stq}, {"aq", scores.tracking.aq}, {"sq", scores.tracking.sq}};
  for (const auto& [group, chosen] : PanopticGroups(categories))
    figures.emplace_back(group == "all" ? "vpq" : "vpq_" + group, MeanVpq(scores, chosen));
  return figures;
}

void AppendShortSequences(Json& json, const Video& video, int longest) {
  size_t count = 0, first = 0;
  for (size_t i = video.sequences.size(); i-- > 0;) {
    if (video.sequences[i].frames.size() < static_cast<size_t>(longest)) ++count, first = i;
  }
  if (count == 0) return;
  const Sequence& sequence = video.sequences[first];
  json["notes"].push_back(std::to_string(count) + " of " + std::to_string(video.sequences.size()) +
                          " sequences are shorter than the longest window of " + std::to_string(longest) +
                          " frames and count as one window of their length; '" + sequence.name + "' first, of " +
                          std::to_string(sequence.frames.size()));
}

void CheckWindows(const std::vector<int>& windows) {
  for (const int window : windows) {
    if (window < 1 || window > 1000) throw InputError("--windows: " + std::to_string(window) + " frames; must be 1 to 1000");
  }
  if (windows.empty()) throw InputError("--windows: names none");
}

Json OpenWorld(const Scores& scores, const std::vector<PanopticCategory>& categories, const std::vector<std::string>& held_out) {
  const std::vector<bool> held = ChooseCategories(categories, held_out, "--open-world");
  std::vector<bool> known(held);
  known.flip();
  return {{"held_out", held_out}, {"known", {{"vpq", MeanVpq(scores, known)}}}, {"unknown", {{"vpq", MeanVpq(scores, held)}}}};
}

// Each sequence alone, in the report and in the table.
void AppendSequences(Json& json, const EvalVideoArguments& a, const Video& video, const std::vector<Result>& results) {
  std::vector<std::vector<std::string>> rows = {{"sequence", "frames", "tubes", "stq", "aq", "sq"}};
  for (size_t i = 0; i < results.size(); ++i) {
    const TrackingScore s = results[i].views.front().tracking->Score();
    json["per_sequence"].push_back(
        {{"sequence", video.sequences[i].name}, {"stq", s.stq}, {"aq", s.aq}, {"sq", s.sq}, {"frames", s.frames}, {"tubes", s.tubes}});
    rows.push_back({video.sequences[i].name, std::to_string(s.frames), std::to_string(s.tubes), NumberText(s.stq), NumberText(s.aq),
                    NumberText(s.sq)});
  }
  WriteCsv(a.report.csv, rows);
}

void AppendWorstFrames(Json& json, const EvalVideoArguments& a, const Video& video, const std::vector<Result>& results) {
  std::vector<SheetItem> items;
  std::vector<std::pair<size_t, size_t>> frames;  // of each item: sequence, frame
  for (size_t i = 0; i < results.size(); ++i) {
    for (size_t f = 0; f < results[i].frame_pq.size(); ++f) {
      items.push_back({frames.size(), video.sequences[i].name + " frame " + std::to_string(f), 1 - results[i].frame_pq[f]});
      frames.emplace_back(i, f);
    }
  }
  AppendWorst(json, a.sheet, items, "1-pq", [&](size_t item) {
    const VideoFrame frame = video.sequences[frames[item].first].frames[frames[item].second]();
    return LabelStrip(frame.prediction, frame.truth);
  });
}

// The figures of the parts and of predictions of pictures that were moved, and intervals of the main ones.
void AppendParts(Json& json, const EvalVideoArguments& a, const Video& video, const std::vector<Result>& results,
                 const std::vector<Rolled>& turns, const std::vector<Figure>& main, uint64_t seed) {
  const size_t n = video.categories.size();
  const auto of_view = [&](size_t view, std::span<const uint32_t> draws = {}) {
    const Scores scores = Pool(
        results, n, [view](const Result& one) -> const Part& { return one.views[view]; }, draws);
    return FiguresOf(scores, video.categories);
  };
  AppendViews(json, a.view, [&](size_t view) { return ToJson(of_view(view)); });
  std::vector<std::vector<Figure>> turned;
  for (size_t r = 0; r < turns.size(); ++r)
    turned.push_back(FiguresOf(Pool(results, n, [r](const Result& one) -> const Part& { return one.rolled[r]; }), video.categories));
  AppendRolled(json, turns, turned, main);
  std::vector<std::string> names;
  for (const Figure& figure : main) names.push_back(figure.first);
  AppendIntervals(json, a.report, seed, results.size(), names, [&](std::span<const uint32_t> draws) {
    std::vector<double> values;
    for (const Figure& figure : of_view(0, draws)) values.push_back(figure.second);
    return values;
  });
}

void AppendNotes(Json& json, const EvalVideoArguments& a, const Video& video) {
  json["notes"].push_back(
      "step: tubes and confusions of all sequences are pooled; where a class is predicted as void, void is a class of IoU 0, as in STEP's code; crowds of the truth do not count for AQ");
  json["notes"].push_back(
      "vpq: mean over --windows of the panoptic quality of windows of so many frames, each taken as one large picture (Kim et al., CVPR 2020)");
  for (const std::string& note : video.notes) json["notes"].push_back(note);
  for (const std::string& warning : video.warnings) json["warnings"].push_back(warning);
  AppendShortSequences(json, video, *std::max_element(a.windows.begin(), a.windows.end()));
}

void Run(EvalVideoArguments a, const GlobalOptions& globals) {
  if (!a.protocol.empty() && a.protocol != "step")
    throw InputError("--protocol: " + UnknownChoiceMessage("protocol of video", a.protocol, std::vector<std::string>{"step"}));
  CheckWindows(a.windows);
  const std::set<int> windows(a.windows.begin(), a.windows.end());
  a.windows.assign(windows.begin(), windows.end());
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  ViewCache cache(a.view);
  const bool pictures = PanopticJson(a.paths.gt).empty();
  if (!pictures && !a.step_flag.empty()) throw InputError(a.step_flag + " is for STEP's PNGs: panoptic JSON names its categories");
  if (!pictures) CheckTruthFiles(a.paths);
  const Video video = pictures ? StepVideo(a.paths, a.step) : PanopticVideo(a.paths);
  ChooseCategories(video.categories, a.held_out, "--open-world");
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<Video> rolled;
  for (const Rolled& turn : turns) {
    const PanopticPaths moved{turn.path, a.paths.gt, "", a.paths.gt_dir};
    rolled.push_back(pictures ? StepVideo(moved, a.step) : PanopticVideo(moved));
  }
  const bool panorama = ArePanoramas(a.view, {a.paths.gt, a.paths.pred});
  const auto results = MeasureAll<Result>("eval video", video.sequences.size(),
                                          [&](size_t i) { return MeasureSequence(video, rolled, turns, i, a, panorama, cache); });

  const Scores scores = Pool(results, video.categories.size(), [](const Result& one) -> const Part& { return one.views.front(); });
  const std::vector<Figure> main = FiguresOf(scores, video.categories);
  Json json = ToJson(main);
  std::vector<std::pair<std::string, LikelyMistake>> mistakes;
  for (const Result& result : results) mistakes.insert(mistakes.end(), result.mistakes.begin(), result.mistakes.end());
  JudgeMistakes(mistakes, a.view.force, json);
  json["tubes"] = scores.tracking.tubes;
  json["frames"] = scores.tracking.frames;
  json["weights"] = a.view.weights;
  json["projection"] = a.view.projection;
  for (const auto& [window, counts] : scores.windows)
    AppendPanoptic(json["windows"][std::to_string(window)], counts, video.categories, false);
  if (!a.held_out.empty()) json["open_world"] = OpenWorld(scores, video.categories, a.held_out);
  AppendSequences(json, a, video, results);
  AppendParts(json, a, video, results, turns, main, globals.seed);
  AppendWorstFrames(json, a, video, results);
  AppendNotes(json, a, video);
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

}  // namespace

void AddEvalVideo(CLI::App& command, GlobalOptions& globals) {
  CLI::App* video = command.add_subcommand("video", "segmentation and tracking of panoptic video: STQ, AQ, SQ, VPQ");
  const auto a = std::make_shared<EvalVideoArguments>();
  AddPanopticPaths(*video, a->paths);
  video->get_option("pred")->description(
      "COCO panoptic JSON whose ids are the same over frames (images may have video_id), VIPSeg's of videos, a dataset of ours, or a folder of STEP's PNGs");
  video->add_option("--windows", a->windows, "N,…: lengths of windows for VPQ, frames (default 1,2,3,4)")->delimiter(',');
  video->add_option("--protocol", a->protocol, "step: its figures are always among those given");
  video
      ->add_option("--open-world", a->held_out, "categories that training has not seen, by name or id: their VPQ beside that of the others")
      ->delimiter(',');
  video->add_option("--classes", a->step.classes, "STEP's PNGs: number of classes (default 19)");
  video->add_option("--things", a->step.things, "STEP's PNGs: classes whose instances are followed (default 11,13)")->delimiter(',');
  video->add_option("--void", a->step.void_class, "STEP's PNGs: class of ignored pixels (default 255)");
  AddViewFlags(*video, a->view);
  AddReportFlags(*video, a->report, "a row a sequence");
  AddSheetFlags(*video, a->sheet);
  video->callback([a, video, &globals] {
    for (const char* flag : {"--classes", "--things", "--void"}) {
      if (video->count(flag) > 0 && a->step_flag.empty()) a->step_flag = flag;
    }
    Run(*a, globals);
  });
}

}  // namespace airsim360

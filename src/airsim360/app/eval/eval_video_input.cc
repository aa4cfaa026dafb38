#include "airsim360/app/eval/eval_video_input.h"

#include <filesystem>
#include <map>
#include <memory>

#include "airsim360/base/error.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/step_video.h"

namespace airsim360 {

Video PanopticVideo(const PanopticPaths& paths) {
  auto input = std::make_shared<PanopticInput>(paths);
  Video video;
  video.categories = input->truth.categories;
  video.notes = input->notes;
  video.warnings = input->warnings;
  std::map<std::string, size_t> index;
  for (size_t i = 0; i < input->truth.frames.size(); ++i) {
    const std::string& name = input->truth.frames[i].sequence;
    const auto [at, fresh] = index.emplace(name, video.sequences.size());
    if (fresh) video.sequences.push_back({name, {}});
    video.sequences[at->second].frames.push_back([input, i] {
      auto [pred, gt] = input->Read(i);
      return VideoFrame{
          std::move(pred), std::move(gt), input->Prediction(i).segments, input->truth.frames[i].segments, input->Prediction(i).file, {}};
    });
  }
  return video;
}

Video StepVideo(const PanopticPaths& paths, const StepOptions& options) {
  if (options.classes < 1 || options.classes > 254) throw InputError("--classes " + std::to_string(options.classes) + ": must be 1 to 254");
  if (options.void_class < 0 || options.void_class > 255)
    throw InputError("--void " + std::to_string(options.void_class) + ": must be 0 to 255");
  for (const int thing : options.things) {
    if (thing < 0 || thing >= options.classes)
      throw InputError("--things: " + std::to_string(thing) + " is none of the classes 0 to " + std::to_string(options.classes - 1) +
                       " (--classes)");
  }
  if (!paths.pred_dir.empty() || !paths.gt_dir.empty())
    throw InputError("--pred-dir and --gt-dir are for panoptic JSON; folders of STEP's PNGs are PRED and GT themselves");
  const StepClasses classes{options.classes, options.void_class, {options.things.begin(), options.things.end()}};
  Video video;
  for (int c = 0; c < options.classes; ++c) video.categories.push_back({c, std::to_string(c), classes.things.contains(c)});
  const FilePairs files = PairFiles(paths.pred, paths.gt, {".png"}, "");
  video.notes = files.notes;
  // Sorted by path: a folder is a sequence, and its files are in order.
  for (const FilePair& pair : files.pairs) {
    const std::string name = std::filesystem::path(pair.name).parent_path().string();
    if (video.sequences.empty() || video.sequences.back().name != name) video.sequences.push_back({name, {}});
    video.sequences.back().frames.push_back([pair, classes] {
      StepFrame pred = ReadStepFrame(pair.prediction, classes, false), gt = ReadStepFrame(pair.truth, classes, true);
      if (pred.ids.width != gt.ids.width || pred.ids.height != gt.ids.height)
        throw InputError(pair.prediction.string() + " and " + pair.truth.string() + " are of different size");
      const std::string file = (gt.reversed ? pair.truth : pair.prediction).string();
      LikelyMistake mistake = ChannelMistake(pred, gt);
      if (gt.reversed)
        mistake = {"red is 0 where blue is not: are the channels the other way round (red is the class, 256 green + blue the instance)?",
                   true};
      return VideoFrame{std::move(pred.ids), std::move(gt.ids), std::move(pred.segments), std::move(gt.segments), file, std::move(mistake)};
    });
  }
  return video;
}

}  // namespace airsim360

#include "airsim360/dataset/collector.h"

#include <chrono>
#include <cmath>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/frame_writer.h"
#include "airsim360/dataset/people/people_export.h"
#include "airsim360/sim/people/labels.h"
#include "airsim360/dataset/summaries.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

double Milliseconds(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<int64_t> FramesOfShard(const DatasetSpec& spec) {
  std::vector<int64_t> frames;
  for (int64_t i = spec.shard; i < spec.frames; i += spec.shards) frames.push_back(i);
  return frames;
}

// True if every file of a frame is there with its size.
bool FilesArePresent(const fs::path& folder, const std::vector<FileRecord>& files) {
  for (const FileRecord& file : files) {
    std::error_code error;
    const auto size = fs::file_size(folder / file.path, error);
    if (error || static_cast<int64_t>(size) != file.bytes) return false;
  }
  return true;
}

// Frames of this shard that are still to be made; the journal forgets frames whose files are gone.
std::vector<int64_t> MissingFrames(const CollectInput& input, DatasetIndex& index) {
  std::map<int64_t, bool> done;
  for (int64_t frame : index.Frames()) {
    done[frame] = FilesArePresent(input.out, index.Files(frame));
    if (!done[frame]) index.RemoveFrame(frame);
  }
  std::vector<int64_t> missing;
  for (int64_t frame : FramesOfShard(input.spec)) {
    if (!done[frame]) missing.push_back(frame);
  }
  return missing;
}

// True if all frames and all files that describe them are there: SHA256SUMS is the last file written.
bool IsFinished(const fs::path& folder, const DatasetSpec& spec) {
  if (spec.material && !fs::exists(folder / "materials.json")) return false;
  if (spec.part && !fs::exists(folder / "parts.json")) return false;
  if (!spec.people.empty()) {
    const std::map<std::string, std::string> made = {{"coco_keypoints", "person_keypoints.json"},
                                                     {"kitti", "kitti/label_2"},
                                                     {"nuscenes", "nuscenes/v1.0-airsim360/sample.json"},
                                                     {"monoloco", "monoloco.json"}};
    for (const char* name : {"people.jsonl", "keypoint_orders.json"}) {
      if (!fs::exists(folder / name)) return false;
    }
    for (const std::string& format : spec.people_formats) {
      if (!fs::exists(folder / made.at(format))) return false;
    }
  }
  for (const char* name : {kChecksumsName, "frames.jsonl", "entities.json", "panoptic.json", "trajectory.csv",
                           "README.md", "contact_sheet.png"}) {
    if (!fs::exists(folder / name)) return false;
  }
  return true;
}

PanoramicRig MakeRig(const DatasetSpec& spec, const View& view) {
  PanoramicRig rig;
  rig.camera = view.camera;
  rig.pano_frame = spec.pano_frame;
  rig.tier = spec.tier;
  rig.products = ProductsOf(spec);
  rig.samples = spec.samples;
  rig.denoise = spec.denoise;
  rig.exposure_ev = spec.exposure_ev;
  rig.tone = spec.tone;
  rig.auto_exposure = spec.auto_exposure;
  rig.seed = spec.seed;
  rig.lens = spec.lens;
  return rig;
}

// Where flow leads to: the next frame of the whole flight; from the last one on, as the body moves there, for
// as long as the frame before took.
double NextSeconds(const std::vector<Shot>& shots, size_t frame) {
  constexpr double kLoneFrameSeconds = 0.1;  // a single frame has no interval of its own
  if (frame + 1 < shots.size()) return static_cast<double>(shots[frame + 1].t_ns - shots[frame].t_ns) * 1e-9;
  return frame > 0 ? static_cast<double>(shots[frame].t_ns - shots[frame - 1].t_ns) * 1e-9 : kLoneFrameSeconds;
}
RigidTransform NextPose(const std::vector<Shot>& shots, size_t frame) {
  if (frame + 1 < shots.size()) return shots[frame + 1].body.X_WB;
  return Extrapolate(shots[frame].body, NextSeconds(shots, frame));
}

/// The people of the frames: what they look like, and their labels.
class PeopleSource {
 public:
  explicit PeopleSource(const CollectInput& input) : input_(input) {
    if (input.people) dynamic_.emplace(input.tracer);
  }
  /// The scene at a shot; nullptr without people.
  std::shared_ptr<const SceneState> StateOf(const Shot& shot) {
    if (!input_.people || !shot.people) return nullptr;
    return Shown(PosesOf(shot), shot.t_ns);
  }
  /// The scene that flow leads to, with the same levels of detail: the next frame's, after the last one as people would go on.
  std::shared_ptr<const SceneState> StateAfter(const std::vector<Shot>& shots, size_t frame) {
    const Shot& shot = shots[frame];
    const bool last = frame + 1 == shots.size();
    if (!input_.people || !shot.people || (!last && !shots[frame + 1].people)) return nullptr;
    const int64_t t_ns = last ? shot.t_ns + std::llround(NextSeconds(shots, frame) * 1e9) : shots[frame + 1].t_ns;
    PeoplePoses poses = last ? PosesLater(*input_.people, *shot.people, t_ns + input_.people->epoch_ns) : PosesOf(shots[frame + 1]);
    poses.levels = LevelsOf(shot);
    return Shown(poses, t_ns);
  }
  FrameLabels Label(const Shot& shot, const std::shared_ptr<const SceneState>& state,
                    const EncodeContext& context, const std::vector<Capture>& captures) {
    FrameLabels labels;
    if (!state) return labels;
    const PeoplePoses poses = PosesOf(shot);
    const std::shared_ptr<const RayTracer> tracer = dynamic_->At(state);
    for (size_t v = 0; v < captures.size(); ++v) {
      labels.push_back(
          LabelPeople({*input_.people, poses, *tracer, context.views[v].camera, captures[v].X_WC}));
    }
    return labels;
  }

 private:
  std::vector<uint8_t> LevelsOf(const Shot& shot) const {
    return LevelsFor(*input_.people, shot.people->crowd.people, shot.body.X_WB.p);
  }
  PeoplePoses PosesOf(const Shot& shot) const {
    PeoplePoses poses = PosesAt(*input_.people, *shot.people, shot.t_ns + input_.people->epoch_ns);
    poses.levels = LevelsOf(shot);
    return poses;
  }
  std::shared_ptr<const SceneState> Shown(const PeoplePoses& poses, int64_t t_ns) const {
    auto state = std::make_shared<SceneState>();
    state->t_ns = t_ns;
    ShowPeople(*input_.people, poses, *state);
    return state;
  }
  const CollectInput& input_;
  std::optional<DynamicTracer> dynamic_;
};

// Renders and writes the missing frames.
void WriteFrames(const CollectInput& input, const std::vector<int64_t>& frames, Renderer& renderer,
                 DatasetIndex& index, CollectResult& result) {
  const EncodeContext context = MakeEncodeContext(input.spec, input.scene, input.people.get());
  PeopleSource people(input);
  FrameWriter writer(context, index, input.out);
  ProgressBar progress("collect", static_cast<int64_t>(frames.size()));
  for (int64_t frame : frames) {
    const Shot& shot = input.flight.shots.at(static_cast<size_t>(frame));
    const auto i = static_cast<size_t>(frame);
    const std::shared_ptr<const SceneState> state = people.StateOf(shot);
    NextTrigger next{NextPose(input.flight.shots, i), state};
    if (input.spec.flow) next.state = people.StateAfter(input.flight.shots, i);
    std::vector<Capture> captures = writer.Acquire();
    for (size_t v = 0; v < captures.size(); ++v) {
      PanoramicRig rig = MakeRig(input.spec, context.views[v]);
      rig.state = state;
      CaptureRig(rig, shot.body, shot.t_ns, renderer, captures[v], &next);
      result.render_ms += captures[v].stats.render_ms;
      result.rays += captures[v].stats.rays;
    }
    FrameLabels labels = people.Label(shot, state, context, captures);
    writer.Submit(frame, std::move(captures), std::move(labels));
    progress.Update(++result.written);
  }
  writer.Finish();
  result.write_ms = writer.write_ms();
}

// Writes the files that are made from all frames, and last the checksums of everything.
void WriteSummaries(const CollectInput& input) {
  DatasetIndex::Finish(input.out, input.scene);
  const DatasetIndex index(input.out, DatasetIndex::Mode::kRead);
  std::map<std::string, std::string> checksums;
  const auto write = [&](const char* name, std::span<const std::byte> bytes) {
    WriteFileAtomically(input.out / name, bytes);
    checksums[name] = Sha256Hex(bytes);
  };
  write("frames.jsonl", AsBytes(FramesJsonl(index)));
  write("entities.json", AsBytes(EntitiesJson(index, input.scene)));
  if (input.spec.material) write("materials.json", AsBytes(MaterialsJson(input.scene)));
  if (input.spec.part) write("parts.json", AsBytes(PartsJson()));
  if (input.people) {
    const std::string people = PeopleJsonl(index, input.spec);
    write("people.jsonl", AsBytes(people));
    for (const ExportedFile& file : ExportPeople(people, input.spec)) {
      CreateWritableFolder((input.out / file.path).parent_path());
      write(file.path.c_str(), AsBytes(file.text));
    }
  }
  write("panoptic.json", AsBytes(PanopticJson(index, input.spec, input.scene)));
  write("trajectory.csv", AsBytes(TrajectoryCsv(input.flight)));
  if (!input.trajectory_json.empty()) write("trajectory.json", AsBytes(input.trajectory_json));
  write("contact_sheet.png", ContactSheetPng(index, input.spec, input.out));
  write("README.md", AsBytes(CardMarkdown(index, input.spec, input.scene)));

  for (const char* name : {kMetaName, kIndexName}) checksums[name] = Sha256HexOfFile(input.out / name);
  for (int64_t frame : index.Frames()) {
    for (const FileRecord& file : index.Files(frame)) checksums[file.path] = file.sha256;
  }
  std::string text;
  for (const auto& [name, sha256] : checksums) text += sha256 + "  " + name + "\n";
  WriteFileAtomically(input.out / kChecksumsName, text);
}

}  // namespace

CollectResult Collect(const CollectInput& input, Renderer& renderer) {
  if (static_cast<int64_t>(input.flight.shots.size()) != input.spec.frames) {
    throw RuntimeError("collect: the flight has " + std::to_string(input.flight.shots.size()) +
                       " shots for " + std::to_string(input.spec.frames) + " frames");
  }
  const auto start = std::chrono::steady_clock::now();
  CollectResult result{.frames = static_cast<int64_t>(FramesOfShard(input.spec).size())};
  const std::string meta = MetaJson(input.spec, input.scene);
  CheckFolder(input.out, meta);
  const FolderLock lock(input.out);
  RemoveTemporaryFiles(input.out);
  if (!fs::exists(input.out / kMetaName)) WriteFileAtomically(input.out / kMetaName, meta);
  for (const ProductFolder& folder : ProductFolders(input.spec))
    CreateWritableFolder(input.out / folder.name);
  if (input.spec.overlay) CreateWritableFolder(input.out / "overlay");
  if (input.spec.crops) CreateWritableFolder(input.out / "crops");
  {
    DatasetIndex index(input.out, DatasetIndex::Mode::kJournal);
    const std::vector<int64_t> missing = MissingFrames(input, index);
    if (missing.empty() && IsFinished(input.out, input.spec)) {
      result.already_complete = true;
      return result;
    }
    fs::remove(input.out / kChecksumsName);
    WriteFrames(input, missing, renderer, index, result);
    result.wall_ms = Milliseconds(start);
  }
  WriteSummaries(input);
  return result;
}

}  // namespace airsim360

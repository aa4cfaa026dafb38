#include "airsim360/dataset/collector.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/frame_writer.h"
#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/pose_export.h"
#include "airsim360/dataset/shot_source.h"
#include "airsim360/dataset/summaries.h"
#include "airsim360/dataset/vehicle_lines.h"
#include "airsim360/dataset/video.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

double Milliseconds(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<int64_t> FramesOfShard(const CollectInput& input) {
  if (input.frames) return *input.frames;
  const DatasetSpec& spec = input.spec;
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
  for (int64_t frame : FramesOfShard(input)) {
    if (!done[frame]) missing.push_back(frame);
  }
  return missing;
}

// True if all frames and all files that describe them are there: SHA256SUMS is the last file written.
bool IsFinished(const CollectInput& input) {
  const fs::path& folder = input.out;
  const DatasetSpec& spec = input.spec;
  for (const auto& [name, text] : input.further_files) {
    if (!fs::exists(folder / name)) return false;
  }
  if (!input.flight.trajectory.empty() && !fs::exists(folder / "trajectory.csv")) return false;
  if (input.traffic && !fs::exists(folder / "vehicles.jsonl")) return false;
  if (spec.products.material && !fs::exists(folder / "materials.json")) return false;
  if (spec.products.part && !fs::exists(folder / "parts.json")) return false;
  if (spec.video && !fs::exists(folder / kVideoName)) return false;
  if (!spec.people.empty()) {
    for (const char* name : {"people.jsonl", "keypoint_orders.json"}) {
      if (!fs::exists(folder / name)) return false;
    }
    for (const auto& [format, path, holds] : kPeopleFormatPaths) {
      if (std::ranges::count(spec.people_formats, format) > 0 && !fs::exists(folder / path)) return false;
    }
  }
  for (const std::string& name : PoseFileNames(spec)) {
    if (!fs::exists(folder / name)) return false;
  }
  for (const char* name : {kChecksumsName, "frames.jsonl", "entities.json", "panoptic.json", "README.md", "contact_sheet.png"}) {
    if (!fs::exists(folder / name)) return false;
  }
  return true;
}

// Renders and writes frames; `done` is told of each.
void WriteFrames(const CollectInput& input, const std::vector<int64_t>& frames, Renderer& renderer, DatasetIndex& index,
                 const std::function<void(int64_t frame)>& done, CollectResult& result) {
  const EncodeContext context = MakeEncodeContext(input.spec, input.scene, input.people.get());
  internal::ShotSource source(input);
  FrameWriter writer(context, index, input.out);
  for (const int64_t frame : frames) {
    std::vector<Capture> captures = writer.Acquire();
    FrameLabels labels = source.TakeForDataset(frame, context.views, renderer, captures);
    for (const Capture& capture : captures) {
      result.render_ms += capture.stats.render_ms;
      result.rays += capture.stats.rays;
    }
    writer.Submit(frame, std::move(captures), std::move(labels));
    ++result.written;
    done(frame);
  }
  writer.Finish();
  result.write_ms += writer.write_ms();
}

void CheckNothingIsMissing(const CollectInput& input) {
  DatasetIndex index(input.out, DatasetIndex::Mode::kJournal);
  const size_t missing = MissingFrames(input, index).size();
  if (missing > 0) throw RuntimeError("collect: " + std::to_string(missing) + " frames are still missing: run it again to finish it");
}

}  // namespace

void FinishDataset(const CollectInput& input) {
  DatasetIndex::Finish(input.out, input.scene);
  const DatasetIndex index(input.out, DatasetIndex::Mode::kRead);
  std::map<std::string, std::string> checksums;
  const auto write = [&](const char* name, std::span<const std::byte> bytes) {
    WriteFileAtomically(input.out / name, bytes);
    checksums[name] = Sha256Hex(bytes);
  };
  const std::string frames = FramesJsonl(index);
  write("frames.jsonl", AsBytes(frames));
  for (const ExportedFile& file : ExportPoses(frames, input.spec)) write(file.path.c_str(), AsBytes(file.text));
  write("entities.json", AsBytes(EntitiesJson(index, input.scene)));
  if (input.spec.products.material) write("materials.json", AsBytes(MaterialsJson(input.scene)));
  if (input.spec.products.part) write("parts.json", AsBytes(PartsJson()));
  if (!input.spec.people.empty()) {
    const std::string people = PeopleJsonl(index, input.spec);
    write("people.jsonl", AsBytes(people));
    for (const ExportedFile& file : ExportPeople(people, input.spec)) {
      CreateWritableFolder((input.out / file.path).parent_path());
      write(file.path.c_str(), AsBytes(file.text));
    }
  }
  write("panoptic.json", AsBytes(PanopticJson(index, input.spec, input.scene)));
  if (!input.flight.trajectory.empty()) write("trajectory.csv", AsBytes(TrajectoryCsv(input.flight)));
  for (const auto& [name, text] : input.further_files) write(name.c_str(), AsBytes(text));
  if (input.traffic) write("vehicles.jsonl", AsBytes(VehiclesJsonl(*input.traffic, input.flight, input.people.get())));
  if (!input.trajectory_json.empty()) write("trajectory.json", AsBytes(input.trajectory_json));
  if (input.spec.video) {
    FilmDataset(input.out, input.out / kVideoName, {});
    checksums[kVideoName] = Sha256HexOfFile(input.out / kVideoName);
  }
  write("contact_sheet.png", ContactSheetPng(index, input.spec, input.scene, input.out));
  write("README.md", AsBytes(CardMarkdown(index, input.spec, input.scene)));

  for (const char* name : {kMetaName, kIndexName}) checksums[name] = Sha256HexOfFile(input.out / name);
  for (int64_t frame : index.Frames()) {
    for (const FileRecord& file : index.Files(frame)) checksums[file.path] = file.sha256;
  }
  std::string text;
  for (const auto& [name, sha256] : checksums) text += sha256 + "  " + name + "\n";
  WriteFileAtomically(input.out / kChecksumsName, text);
}

namespace {

// Rendered here, or elsewhere where `renderer` is null.
CollectResult Run(const CollectInput& input, Renderer* renderer, const RenderElsewhere& elsewhere) {
  if (!input.frames && static_cast<int64_t>(input.flight.shots.size()) != input.spec.frames) {
    throw RuntimeError("collect: the flight has " + std::to_string(input.flight.shots.size()) + " shots for " +
                       std::to_string(input.spec.frames) + " frames");
  }
  const auto start = std::chrono::steady_clock::now();
  CollectResult result{.frames = static_cast<int64_t>(FramesOfShard(input).size())};
  const std::string meta = MetaJson(input.spec, input.scene);
  CheckFolder(input.out, meta);
  const FolderLock lock(input.out);
  RemoveTemporaryFiles(input.out);
  if (!fs::exists(input.out / kMetaName)) WriteFileAtomically(input.out / kMetaName, meta);
  for (const ProductFolder& folder : ProductFolders(input.spec)) CreateWritableFolder(input.out / folder.name);
  if (input.spec.overlay) CreateWritableFolder(input.out / "overlay");
  if (input.spec.crops) CreateWritableFolder(input.out / "crops");
  std::vector<int64_t> missing;
  {
    DatasetIndex index(input.out, DatasetIndex::Mode::kJournal);
    missing = MissingFrames(input, index);
    if (missing.empty() && IsFinished(input)) {
      result.already_complete = true;
      return result;
    }
    fs::remove(input.out / kChecksumsName);
    if (renderer) {
      ProgressBar progress("collect", static_cast<int64_t>(missing.size()));
      WriteFrames(
          input, missing, *renderer, index, [&](int64_t) { progress.Update(result.written); }, result);
    }
  }
  if (!renderer && !missing.empty()) {
    ProgressBar progress("collect", static_cast<int64_t>(missing.size()));
    // A frame that was begun twice counts once.
    const auto all = static_cast<int64_t>(missing.size());
    elsewhere(
        missing, [&] { progress.Update(std::min(++result.written, all)); }, result);
    result.written = all;
    CheckNothingIsMissing(input);
  }
  result.wall_ms = Milliseconds(start);
  if (input.before_summaries) input.before_summaries();
  FinishDataset(input);
  return result;
}

}  // namespace

CollectResult Collect(const CollectInput& input, Renderer& renderer) { return Run(input, &renderer, {}); }

CollectResult Collect(const CollectInput& input, const RenderElsewhere& elsewhere) { return Run(input, nullptr, elsewhere); }

CollectResult CollectPart(const CollectInput& input, Renderer& renderer, std::span<const int64_t> frames,
                          const std::function<void(int64_t frame)>& done) {
  CollectResult result{.frames = static_cast<int64_t>(frames.size())};
  DatasetIndex index(input.out, DatasetIndex::Mode::kJournal);
  const std::vector<int64_t> journal = index.Frames();
  std::vector<int64_t> wanted;
  for (const int64_t frame : frames) {
    if (frame < 0 || frame >= input.spec.frames) throw RuntimeError("collect: there is no frame " + std::to_string(frame));
    if (!std::ranges::binary_search(journal, frame)) wanted.push_back(frame);
  }
  WriteFrames(input, wanted, renderer, index, done, result);
  return result;
}

}  // namespace airsim360

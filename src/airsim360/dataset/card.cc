// README.md of a dataset.
#include <algorithm>
#include <cstdio>

#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/pose_export.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/dataset/summaries.h"
#include "airsim360/dataset/video.h"

namespace airsim360 {
namespace {

template <class... Values>
std::string Formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// Classes, the largest part of the sphere first.
std::string HistogramTable(const std::vector<CategoryTotal>& totals, const Scene& scene) {
  std::vector<CategoryTotal> sorted = totals;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  int64_t pixels = 0;
  double solid_angle = 0;
  for (const CategoryTotal& total : totals) {
    pixels += total.pixels;
    solid_angle += total.solid_angle;
  }
  std::string table =
      "| id | category | kind | entities | pixels | % of pixels | % of solid angle "
      "|\n|--:|---|---|--:|--:|--:|--:|\n";
  for (const CategoryTotal& total : sorted) {
    const Category& category = scene.tree[total.category];
    table += "| " + std::to_string(total.category) + " | `" + category.path + "` | " + (category.thing ? "thing" : "stuff") + " | " +
             std::to_string(total.entities) + " | " + std::to_string(total.pixels) +
             Formatted(" | %.3f | %.3f |\n", 100.0 * static_cast<double>(total.pixels) / static_cast<double>(pixels),
                       100.0 * total.solid_angle / solid_angle);
  }
  return table;
}

// Files that only datasets with people, or with cameras that have intrinsics, hold.
std::string FurtherFiles(const DatasetSpec& spec) {
  std::string text;
  const auto line = [&](const std::string& path, const std::string& holds) { text += "- `" + path + "` " + holds + "\n"; };
  if (spec.video) line(kVideoName, "the colour pictures as a video, of panoramas in 360 degrees");
  if (spec.products.material) line("materials.json", "what the values of `material/` are");
  if (spec.products.part) line("parts.json", "what the values of `part/` are");
  for (const std::string& name : PoseFileNames(spec))
    line(name, name.ends_with(".json") ? "poses and intrinsics for nerfstudio" : "poses and intrinsics for COLMAP");
  if (spec.people.empty()) return text;
  line("people.jsonl", "everyone in every picture: boxes, keypoints, skeletons, behaviours, one line a picture");
  line("keypoint_orders.json", "names of keypoints and joints, and their order in COCO, OpenPose, SMPL and others");
  for (const auto& [format, path, holds] : kPeopleFormatPaths) {
    if (std::ranges::count(spec.people_formats, format) > 0) line(path, holds);
  }
  if (spec.crops) line("crops/*.png", "a pinhole picture of everyone who can be seen");
  if (spec.overlay) line("overlay/*.png", "the colour pictures with the labels of people drawn in");
  return text;
}

}  // namespace

std::string CardMarkdown(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene) {
  const std::vector<CategoryTotal> totals = index.CategoryTotals();
  const size_t entities = index.SeenEntities().size();
  std::string text = "# " + scene.name + ": labelled " + (IsPanoramic(spec) ? "panoramas" : "pictures") + "\n\n";
  text += "![colour, range, semantic and entity pictures of some frames, with a legend](contact_sheet.png)\n\n";
  text += "| | |\n|---|---|\n";
  const auto row = [&](const std::string& key, const std::string& value) { text += "| " + key + " | " + value + " |\n"; };
  row("world", "`" + spec.world + "`, seed " + std::to_string(spec.seed));
  row("frames", std::to_string(index.Frames().size()) + (spec.shards > 1
                                                             ? " (shard " + std::to_string(spec.shard) + " of " +
                                                                   std::to_string(spec.shards) + " of " + std::to_string(spec.frames) + ")"
                                                             : std::string()));
  const auto size_of = [](const auto& camera) {
    return std::to_string(camera.width) + " x " + std::to_string(camera.height) + ", " +
           kProjectionNames[static_cast<int>(camera.projection)];
  };
  if (spec.cameras.empty()) row("size", size_of(spec));
  for (const RigCamera& camera : spec.cameras) row("camera `" + camera.name + "`", size_of(camera));
  if (!spec.people.empty()) {
    const PeopleTotals people = index.CountPeople();
    row("people", spec.people + "; seen " + std::to_string(people.persons_seen) + ", with at least " + std::to_string(kLargePerson) +
                      " pixels in some picture " + std::to_string(people.persons_large));
  }
  row("tier", kTierNames[static_cast<int>(spec.tier)]);
  row("route", spec.route);
  row("classes seen", std::to_string(totals.size()));
  row("entities seen", std::to_string(entities));
  row("generator", std::string("airsim360 ") + kVersion);

  text += "\n## Files\n\n";
  for (const ProductFolder& folder : ProductFolders(spec)) {
    text += "- `" + folder.name + "/*" + folder.extension + "`\n";
  }
  text += FurtherFiles(spec);
  text +=
      "- `frames.jsonl` pose, velocity and SHA-256 of every file, one line a frame; `entities.json`; "
      "`panoptic.json` (COCO panoptic)\n"
      "- `trajectory.csv` the whole flight; `index.sqlite` for queries; `meta.json` conventions, encodings "
      "and category tree\n"
      "- `SHA256SUMS`: check with `sha256sum -c SHA256SUMS` or `airsim360 verify .`\n";
  text += "\n## Classes\n\n" + HistogramTable(totals, scene);
  text += "\n## Licence\n\nThe pictures and labels are computed by AirSim360 and belong to whoever made them.\n";
  if (!scene.attributions.empty()) {
    text += "The world shows these third-party models; keep their attribution when you publish the pictures:\n\n";
    for (const std::string& line : scene.attributions) text += "- " + line + "\n";
  }
  return text;
}

}  // namespace airsim360

#include "airsim360/dataset/export/export.h"

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/dataset/export/export_job.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

struct Format {
  ExportFormatInfo info;
  void (*write)(internal::ExportJob&);
};

// The order in which help and docs list them.
constexpr Format kFormats[] = {
    {{"omni360", "the layout of the AirSim360 release: PNG, HDF5 depth, the paper's class names, UE poses"}, internal::ExportOmni360},
    {{"coco", "COCO instances of things: RLE masks, boxes that know the seam"}, internal::ExportCoco},
    {{"coco_entity", "COCO instances of everything, one category: class-agnostic entities"}, internal::ExportCocoEntity},
    {{"coco_keypoints", "COCO keypoints of people"}, internal::ExportCocoKeypoints},
    {{"webdataset", "tar files of samples"}, internal::ExportWebDataset},
    {{"colmap", "COLMAP models: panoramas and pinhole faces, poses, points from the range"}, internal::ExportColmap},
    {{"nerfstudio", "transforms.json of panoramas"}, internal::ExportNerfstudio},
    {{"tum", "TUM RGB-D poses and picture list"}, internal::ExportTum},
    {{"euroc", "EuRoC/ASL: pictures, ground truth, IMU where one was flown"}, internal::ExportEuroc},
    {{"kitti_odometry", "KITTI odometry poses and pictures"}, internal::ExportKittiOdometry},
    {{"kitti_object", "KITTI object labels of the vehicles of traffic and of people: boxes in the picture and in space"},
     internal::ExportKittiObject},
    {{"nuscenes", "nuScenes' tables: boxes of people and of the vehicles of traffic, with tracks"}, internal::ExportNuScenes},
    {{"cityscapes", "Cityscapes labelIds, trainIds and instanceIds"}, internal::ExportCityscapes},
    {{"ade20k", "ADE20K scene parsing, 150 classes"}, internal::ExportAde20k},
    {{"wildpass", "WildPASS, 8 classes"}, internal::ExportWildPass},
    {{"scannet", "ScanNet's label images: the 40 classes of NYU"}, internal::ExportScanNet},
    {{"matterport", "Matterport3D's 40 categories"}, internal::ExportMatterport},
    {{"stanford2d3d", "2D-3D-S, 13 classes"}, internal::ExportStanford2d3d},
    {{"layout", "corners of the room around each camera, as HorizonNet reads them; rooms and doors of the building"},
     internal::ExportLayout},
    {{"mcap", "MCAP for ROS 2 and Foxglove: pictures, range, odometry, transforms, people"}, internal::ExportMcap},
    {{"cryptomatte", "Cryptomatte EXR of the coverage of entities"}, internal::ExportCryptomatte},
    {{"parquet", "a table of frames: counts, classes, poses"}, internal::ExportParquet},
    {{"vps", "video panoptic segmentation, one id one entity over all frames"}, internal::ExportVps},
    {{"step", "KITTI-STEP panoptic maps"}, internal::ExportStep},
    {{"mots", "MOTS masks of cars and people"}, internal::ExportMots},
    {{"360vots", "360VOTS: a track for each moving thing: BFoV, rotated BFoV, masks across the seam"}, internal::Export360Vots},
    {{"flow", "optical flow of panoramas (.flo) with occlusion"}, internal::ExportFlow},
    {{"lerobot", "LeRobot v2.1: actions and state with the panorama as video"}, internal::ExportLeRobot},
    {{"video", "videos of colour, depth, semantics and entities; labels without loss"}, internal::ExportVideo},
};

constexpr auto kInfos = [] {
  std::array<ExportFormatInfo, std::size(kFormats)> infos{};
  for (size_t i = 0; i < infos.size(); ++i) infos[i] = kFormats[i].info;
  return infos;
}();

const Format& FindFormat(const std::string& name) {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.info.name);
  return kFormats[ParseChoice("format", name, names, "--format")];
}

// The target must not be part of the dataset, which would be edited.
void CheckApart(const fs::path& dataset, const fs::path& out) {
  const fs::path inner = fs::weakly_canonical(out), outer = fs::weakly_canonical(dataset);
  const auto [at, rest] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  if (at == outer.end())
    throw InputError("--out: '" + out.string() + "' is inside the dataset, which is not changed; choose a folder beside it");
}

constexpr const char* kReportName = "export.json";

}  // namespace

std::span<const ExportFormatInfo> ExportFormats() { return kInfos; }

ExportResult ExportDataset(const fs::path& dataset, const std::string& format, const fs::path& out, const ExportOptions& options) {
  const Format& found = FindFormat(format);
  const NativeDataset data(dataset);
  CheckApart(dataset, out);
  data.CheckDescription();
  ExportFolder folder(out);
  internal::ExportJob job{data, folder, options, format};
  found.write(job);
  const internal::Json report = {{"format", format},           {"dataset_sha256sums", data.Hash()},
                                 {"world", data.spec().world}, {"frames", data.size()},
                                 {"notes", job.notes},         {"attributions", data.attributions()}};
  folder.Write(kReportName, internal::Pretty(report));
  folder.Commit();
  ExportResult result{.frames = static_cast<int64_t>(data.size()), .notes = internal::Dump(job.notes)};
  for (const std::string& file : ListFiles(out)) {
    ++result.files;
    result.bytes += static_cast<int64_t>(fs::file_size(out / file));
  }
  return result;
}

namespace internal {

void ExportJob::Need(bool there, const std::string& what, const std::string& flag) const {
  if (there) return;
  throw InputError("--format " + format + ": needs " + what + ", which '" + data.folder().string() + "' lacks: collect it with " + flag);
}

const View& ExportJob::OneView() const {
  Need(data.views().size() == 1, "one picture a frame", "one camera (no --cameras, no --projection cube)");
  return data.views().front();
}

const View& ExportJob::Panorama() const {
  Need(OneView().projection == Projection::kErp, "panoramas", "--projection erp");
  return data.views().front();
}

std::string Number(double value) { return ShortestText(value + 0.0); }

std::string RleText(const std::vector<uint32_t>& runs) {
  // Groups of five bits, least significant first, bit 5 = more follow; from the third run on the difference to the one
  // two before.
  std::string text;
  for (size_t i = 0; i < runs.size(); ++i) {
    int64_t value = runs[i];
    if (i > 2) value -= runs[i - 2];
    for (bool more = true; more;) {
      int64_t group = value & 31;
      value >>= 5;
      more = (group & 16) != 0 ? value != -1 : value != 0;
      if (more) group |= 32;
      text += static_cast<char>(group + 48);
    }
  }
  return text;
}

std::map<EntityId, std::vector<uint32_t>> EntityRuns(const Image<EntityId>& entity) {
  struct Open {
    std::vector<uint32_t> runs;
    uint64_t end = 0;  // of the last run that is the entity's, in pixels column by column
  };
  std::map<EntityId, Open> all;
  const int width = entity.width(), height = entity.height();
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height;) {
      const EntityId id = entity(x, y);
      const int begin = y;
      while (y < height && entity(x, y) == id) ++y;
      if (id == kNoEntity) continue;
      Open& open = all[id];
      const uint64_t at = static_cast<uint64_t>(x) * height + static_cast<uint64_t>(begin);
      const auto length = static_cast<uint32_t>(y - begin);
      if (at == open.end && !open.runs.empty()) {
        open.runs.back() += length;
      } else {
        open.runs.push_back(static_cast<uint32_t>(at - open.end));
        open.runs.push_back(length);
      }
      open.end = at + length;
    }
  }
  std::map<EntityId, std::vector<uint32_t>> result;
  const uint64_t pixels = entity.size();
  for (auto& [id, open] : all) {
    if (open.end < pixels) open.runs.push_back(static_cast<uint32_t>(pixels - open.end));
    result.emplace(id, std::move(open.runs));
  }
  return result;
}

}  // namespace internal
}  // namespace airsim360

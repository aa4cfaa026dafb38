// The layout of the AirSim360 release: panorama/, depth/, semantic/, instance/, class lists and records of poses.
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/hdf5.h"
#include "airsim360/dataset/export/paper_classes.h"
#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr float kFarthest = 1000;  // metres; what is farther, and the sky, is that far

// Unreal's world: left-handed, X as ours, Y to the south, Z up, centimetres; a rotator in degrees whose yaw grows from X to Y.
std::string RecordLine(const RigidTransform& X_WC) {
  const Mat3d R = X_WC.R * CameraInBody().R.transpose();
  const double yaw = std::atan2(R.m[1][0], R.m[0][0]), pitch = std::asin(std::clamp(R.m[2][0], -1.0, 1.0)),
               roll = std::atan2(R.m[2][1], R.m[2][2]);
  const auto angle = [&](double radians) { return Number(std::round(radians * kRadian * 1e6) / 1e6); };
  const auto length = [](double metres) { return Number(std::round(metres * 1e6) / 1e4); };
  return length(X_WC.p.x) + "," + length(-X_WC.p.y) + "," + length(X_WC.p.z) + "," + angle(roll) + "," + angle(pitch) + "," + angle(-yaw) +
         "\n";
}

Image<float> Depth(Image<float> range) {
  for (float& r : range.pixels()) r = r > 0 && r < kFarthest ? r : kFarthest;
  return range;
}

struct Labels {
  Image<Rgba8> semantic, instance;
  uint64_t other = 0;  // pixels of no class of the list
};

Labels LabelsOf(const ExportJob& job, const NativeFrame& frame, const View& view, const SceneClasses& classes) {
  const Image<CategoryId> semantic = job.data.Semantic(frame, view);
  const Image<EntityId> entity = job.data.Entity(frame, view);
  Labels labels{Image<Rgba8>(semantic.width(), semantic.height()), Image<Rgba8>(semantic.width(), semantic.height())};
  // Neighbours are mostly of one category.
  CategoryId last = kVoid;
  Rgb8 color;
  uint8_t id = 0;
  for (size_t i = 0; i < semantic.size(); ++i) {
    if (semantic.pixels()[i] != last) {
      last = semantic.pixels()[i];
      color = job.data.category(last).color;
      id = classes.IdOf(last);
    }
    const EntityId e = entity.pixels()[i];
    labels.semantic.pixels()[i] = {color.r, color.g, color.b, id};
    labels.instance.pixels()[i] = {static_cast<uint8_t>(e), static_cast<uint8_t>(e >> 8), static_cast<uint8_t>(e >> 16), id};
    labels.other += id == 0;
  }
  return labels;
}

Bytes Colour(const ExportJob& job, const NativeFrame& frame, const View& view) { return job.data.Read(frame, view, "rgb"); }

}  // namespace

void ExportOmni360(ExportJob& job) {
  job.NeedColour();
  const View& view = job.Panorama();
  std::map<std::string, SceneClasses> classes;  // by world
  std::map<std::string, std::string> records;
  std::map<std::string, std::pair<uint64_t, uint64_t>> pixels;  // of no class, of all
  for (size_t i = 0; i < job.data.size(); ++i) {
    const std::string world = job.data.Frame(i).world;
    if (!classes.contains(world)) classes[world] = ClassesOf(world, job.data);
  }
  job.EachFrame(
      [&](const NativeFrame& frame) {
        const std::string n = std::to_string(frame.index);
        const Labels labels = LabelsOf(job, frame, view, classes.at(frame.world));
        job.out.Write("panorama/panorama_" + n + job.data.Extension("rgb"), Colour(job, frame, view));
        job.out.Write("depth/Depth_" + n + ".h5", EncodeHdf5(Depth(job.data.Range(frame, view)), "depth"));
        job.out.Write("semantic/panorama_" + n + ".png", EncodePng(labels.semantic));
        job.out.Write("instance/panorama_" + n + ".png", EncodePng(labels.instance));
        return std::pair<uint64_t, uint64_t>(labels.other, labels.semantic.size());
      },
      [&](const NativeFrame& frame, std::pair<uint64_t, uint64_t> counted) {
        records[frame.world] += RecordLine(frame.X_WC(view));
        pixels[frame.world].first += counted.first;
        pixels[frame.world].second += counted.second;
      });
  for (const auto& [world, list] : classes) {
    std::string text;
    for (size_t i = 0; i < list.names.size(); ++i) {
      if (!list.names[i].empty()) text += list.names[i] + " " + std::to_string(i + 1) + "\n";
    }
    job.out.Write("semantic_lists_" + list.list + ".txt", text);
    job.out.Write(list.record + "_record.csv", "X,Y,Z,Roll,Pitch,Yaw\n" + records[world]);
    job.notes["other_share"][world] = static_cast<double>(pixels[world].first) / static_cast<double>(pixels[world].second);
  }
}

}  // namespace airsim360::internal

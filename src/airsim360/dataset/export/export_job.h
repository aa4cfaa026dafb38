// What every format gets: the dataset, where to write, and a loop over frames. Not for other modules.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/export/export.h"
#include "airsim360/dataset/export/export_folder.h"
#include "airsim360/dataset/export/native_dataset.h"

namespace airsim360::internal {

using Json = nlohmann::ordered_json;

struct ExportJob {
  const NativeDataset& data;
  ExportFolder& out;
  const ExportOptions& options;
  std::string format;
  Json notes = Json::object();

  /// InputError "--format F needs WHAT, which this dataset lacks: collect it with FLAG" unless `there`.
  void Need(bool there, const std::string& what, const std::string& flag) const;
  void NeedColour() const { Need(data.Has("rgb"), "colour pictures", "another --tier than labels"); }
  void NeedPeople() const { Need(data.HasPeople(), "people", "--people N"); }
  /// The one equirectangular view; InputError for other cameras.
  const View& Panorama() const;
  /// The view of datasets with one picture a frame; InputError for others.
  const View& OneView() const;

  /// Calls make(frame) for all frames, several at once, and take(frame, what was made) in the order of frames.
  template <class Make, class Take>
  void EachFrame(const Make& make, const Take& take) const {
    using Made = decltype(make(std::declval<const NativeFrame&>()));
    const size_t count = data.size(), batch = static_cast<size_t>(4 * std::max(1, ThreadCount()));
    ProgressBar progress("export", static_cast<int64_t>(count));
    for (size_t begin = 0; begin < count; begin += batch) {
      const size_t n = std::min(batch, count - begin);
      std::vector<NativeFrame> frames(n);
      std::vector<Made> made(n);
      ParallelFor(static_cast<int64_t>(n), [&](int64_t i) {
        const auto k = static_cast<size_t>(i);
        frames[k] = data.Frame(begin + k);
        made[k] = make(frames[k]);
      });
      for (size_t k = 0; k < n; ++k) {
        take(frames[k], std::move(made[k]));
        progress.Update(static_cast<int64_t>(begin + k) + 1);
      }
    }
  }
  /// The same where nothing is taken in order.
  template <class Body>
  void EachFrame(const Body& body) const {
    EachFrame([&](const NativeFrame& frame) { return body(frame), 0; }, [](const NativeFrame&, int) {});
  }
};

/// JSON in one line; text that is no UTF-8 is replaced.
inline std::string Dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }
inline std::string Pretty(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }
/// The shortest text that reads back exactly.
std::string Number(double value);
/// COCO's compressed run lengths ("counts") of the pixels with mask[i] != 0 over a picture, columns first.
std::string RleText(const std::vector<uint32_t>& runs);

/// Run lengths of each entity of a picture over its columns, beginning with pixels that are not the entity's, by id.
std::map<EntityId, std::vector<uint32_t>> EntityRuns(const Image<EntityId>& entity);

// One function a format.
void ExportOmni360(ExportJob& job);
void ExportCoco(ExportJob& job);
void ExportCocoEntity(ExportJob& job);
void ExportCocoKeypoints(ExportJob& job);
void ExportWebDataset(ExportJob& job);
void ExportColmap(ExportJob& job);
void ExportNerfstudio(ExportJob& job);
void ExportTum(ExportJob& job);
void ExportEuroc(ExportJob& job);
void ExportKittiOdometry(ExportJob& job);
void ExportKittiObject(ExportJob& job);
void ExportNuScenes(ExportJob& job);
void ExportCityscapes(ExportJob& job);
void ExportAde20k(ExportJob& job);
void ExportWildPass(ExportJob& job);
void ExportScanNet(ExportJob& job);
void ExportMatterport(ExportJob& job);
void ExportStanford2d3d(ExportJob& job);
void ExportLayout(ExportJob& job);
void ExportMcap(ExportJob& job);
void ExportCryptomatte(ExportJob& job);
void ExportParquet(ExportJob& job);
void ExportVps(ExportJob& job);
void ExportStep(ExportJob& job);
void ExportMots(ExportJob& job);
void Export360Vots(ExportJob& job);
void ExportFlow(ExportJob& job);
void ExportLeRobot(ExportJob& job);
void ExportVideo(ExportJob& job);

}  // namespace airsim360::internal

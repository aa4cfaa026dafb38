// Object detection: filters by camera, boxes of what is seen.
#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/images/detections.h"

namespace airsim360 {
namespace {

using airsim::CameraName;
using airsim::External;
using Text = const std::string&;
constexpr size_t kMostPatterns = 1000;

DetectionFilter& FilterOf(Session& s, const CameraName& camera, Text vehicle) {
  const size_t index = s.control(vehicle).index();
  FindCamera(s.world().cameras[index], camera.text);
  return s.world().detection[{index, CanonicalCamera(camera.text)}];
}

}  // namespace

void AddDetectionCalls(Api& api) {
  api.Change(
      "simAddDetectionFilterMeshName",
      [](Session& s, const CameraName& camera, airsim::ImageType, Text pattern, Text vehicle, const External&) {
        auto& patterns = FilterOf(s, camera, vehicle).patterns;
        if (patterns.size() >= kMostPatterns) throw std::invalid_argument("more than 1000 filters");
        patterns.push_back(std::make_shared<const Pattern>(Pattern::Wildcard(pattern)));
      },
      1);
  api.Change(
      "simSetDetectionFilterRadius",
      [](Session& s, const CameraName& camera, airsim::ImageType, float radius_cm, Text vehicle, const External&) {
        FilterOf(s, camera, vehicle).radius = radius_cm / 100;
      },
      1);
  api.Change(
      "simClearDetectionMeshNames",
      [](Session& s, const CameraName& camera, airsim::ImageType, Text vehicle, const External&) {
        FilterOf(s, camera, vehicle).patterns.clear();
      },
      1);
  api.Picture(
      "simGetDetections",
      [](ImageService& images, const SnapshotPointer& now, const CameraName& camera, airsim::ImageType type, Text vehicle,
         const External&) {
        const size_t index = now->Find(vehicle);
        const auto filter = now->world->detection.find({index, CanonicalCamera(camera.text)});
        if (filter == now->world->detection.end() || filter->second.patterns.empty()) {
          FindCamera(now->world->cameras[index], camera.text);
          return std::vector<airsim::DetectionInfo>{};
        }
        const ImageService::View view = images.RenderLabels(*now, index, camera.text, type);
        return DetectionsIn(view, *now, images.session().objects(), filter->second);
      },
      1);
}

}  // namespace airsim360

// simGetImages, simGetImage and AirSim360's panoramas.
#include "airsim360/rpc/api/api.h"

namespace airsim360 {
namespace {

constexpr int kSmallestPanorama = 16, kLargestPanorama = 8192;  // pixels across

// Each panorama has a resolution; those that have none of their own follow the first that gets one.
bool SetPanoramaResolution(Session& s, const std::string& name, int width, int height, const std::string& vehicle) {
  const size_t index = s.control(vehicle).index();
  if (FindCamera(s.world().cameras[index], name).panorama == PanoramaKind::kNone) {
    throw std::invalid_argument("Camera '" + name + "' is no panorama");
  }
  if (width < kSmallestPanorama || width > kLargestPanorama || width != int64_t{2} * height) {
    throw std::invalid_argument("a panorama is twice as wide as high and 16 to 8192 pixels wide, not " + std::to_string(width) + "x" +
                                std::to_string(height));
  }
  for (auto& [other, camera] : s.world().cameras[index]) {
    if (camera.panorama == PanoramaKind::kNone || (other != name && camera.own_resolution)) continue;
    camera.panorama_width = width;
    camera.panorama_height = height;
    camera.own_resolution |= other == name;
  }
  return true;
}

// The answer without what lies in the region: the client has that already.
airsim::LentImages LeaveIn(const LentRegion& region, std::vector<airsim::ImageResponse> images) {
  airsim::LentImages lent{std::move(images), {}, region.wanted()};
  for (airsim::ImageResponse& image : lent.images) {
    WireBlock& pixels = image.pixels_as_float ? image.image_data_float.bytes : image.image_data_uint8.bytes;
    if (!region.Has(pixels.data())) {
      lent.places.emplace_back(0, 0);
      continue;
    }
    lent.places.emplace_back(region.OffsetOf(pixels.data()), pixels.size());
    pixels = {};
  }
  return lent;
}

}  // namespace

void AddImageCalls(Api& api) {
  api.Picture(
      "simGetImages",
      [](ImageService& images, const SnapshotPointer& now, const airsim::ImageRequests& requests, const std::string& vehicle,
         const airsim::External& external) { return images.Capture(now, requests.list, vehicle, external.external); },
      1);
  // Ours: `token` and the region are of memory that the client has lent (MemoryLoans). Floats are as with binary_float.
  api.Picture("simGetImagesLent", [&api](ImageService& images, const SnapshotPointer& now, airsim::ImageRequests requests,
                                         const std::string& vehicle, bool external, uint64_t token, uint64_t offset, uint64_t size) {
    LentRegion region(api.loans().Find(token), offset, size);
    for (airsim::ImageRequest& request : requests.list) request.binary_float = true;
    return LeaveIn(region, images.Capture(now, requests.list, vehicle, external, &region));
  });
  api.Picture(
      "simGetImage",
      [](ImageService& images, const SnapshotPointer& now, const airsim::CameraName& camera, airsim::ImageType type,
         const std::string& vehicle, const airsim::External& external) {
        airsim::ImageRequest request;
        request.camera_name = camera;
        request.image_type = type;
        request.annotation_name = external.annotation;
        return std::move(images.Capture(now, {request}, vehicle, external.external)[0].image_data_uint8);
      },
      1);
  api.Change("simSetPanoramaResolution",
             [](Session& s, const airsim::CameraName& camera, int width, int height, const std::string& vehicle) {
               return SetPanoramaResolution(s, camera.text, width, height, vehicle);
             });
  // Ours, for benches.
  api.Picture("simGetRenderMilliseconds", [](ImageService& images, const SnapshotPointer&) { return images.last_render_ms(); });
  // In the simulation's thread, so that the instant is that of everything said before.
  api.Change("simTriggerPanoramaCapture", [&api](Session& s, const airsim::CameraName& camera, const std::string& vehicle) {
    const VehicleControl& control = s.control(vehicle);
    if (FindCamera(s.world().cameras[control.index()], camera.text).panorama == PanoramaKind::kNone) {
      throw std::invalid_argument("Camera '" + camera.text + "' is no panorama");
    }
    s.PublishNow();
    api.images().Trigger(control.status().name, s.snapshot());
    return true;
  });
}

}  // namespace airsim360

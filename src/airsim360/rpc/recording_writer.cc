#include "airsim360/rpc/recording_writer.h"

#include <cstdlib>
#include <ctime>
#include <fstream>

#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/rpc/ned.h"

namespace airsim360 {
namespace {

std::filesystem::path NewFolder(const std::filesystem::path& parent) {
  char name[64];
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::strftime(name, sizeof name, "%Y-%m-%d-%H-%M-%S", &local);
  if (!parent.empty()) return parent / name;
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home ? home : ".") / "Documents" / "AirSim" / name;
}

// Portable float map, as AirSim writes it: little-endian, top row first.
std::string Pfm(const airsim::ImageResponse& image) {
  std::string text = "Pf\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  // Taken out of their form on the wire: tag, then big-endian.
  const std::string_view bytes = image.image_data_float.bytes.view();
  for (size_t i = 0; i + kWireFloatBytes <= bytes.size(); i += kWireFloatBytes) {
    for (size_t k = kWireFloatBytes - 1; k > 0; --k) text += bytes[i + k];
  }
  return text;
}

}  // namespace

RecordingWriter::RecordingWriter(Session& session, ImageService& images)
    : settings_(session.settings().recording) {
  if (settings_.cameras.empty()) settings_.cameras.push_back({});
  session.Post([this, &images](Session& s) -> std::function<void()> {
    s.recorder().SetSink([this, &images](const SnapshotPointer& snapshot) {
      images.Post([this, snapshot](ImageService& service) { Write(service, snapshot); });
    });
    return {};
  });
}

void RecordingWriter::Open() {
  folder_ = NewFolder(settings_.folder);
  CreateWritableFolder(folder_ / "images");
  std::ofstream(folder_ / "airsim_rec.txt")
      << "VehicleName\tTimeStamp\tPOS_X\tPOS_Y\tPOS_Z\tQ_W\tQ_X\tQ_Y\tQ_Z\tImageFile\n";
  LogInfo("recording to " + folder_.string());
}

std::string RecordingWriter::WriteImage(const airsim::ImageResponse& image, const std::string& vehicle) {
  const std::string name = "img_" + vehicle + "_" +
                           std::filesystem::path(image.camera_name).filename().string() + "_" +
                           std::to_string(static_cast<int>(image.image_type)) + "_" +
                           std::to_string(image.time_stamp) + (image.pixels_as_float ? ".pfm" : ".png");
  WriteFileAtomically(folder_ / "images" / name,
                      image.pixels_as_float ? Pfm(image) : std::string(image.image_data_uint8.bytes.view()));
  return name;
}

void RecordingWriter::Write(ImageService& images, const SnapshotPointer& snapshot) {
  if (failed_) return;
  try {
    if (folder_.empty()) Open();
    for (size_t v = 0; v < snapshot->vehicles.size(); ++v) {
      const VehicleStatus& vehicle = snapshot->vehicles[v];
      std::vector<airsim::ImageRequest> requests;
      for (const RecordingSettings::Camera& camera : settings_.cameras) {
        if (camera.vehicle.empty() ? v != 0 : camera.vehicle != vehicle.name) continue;
        airsim::ImageRequest request;
        request.camera_name.text = camera.camera;
        request.image_type = camera.type;
        request.pixels_as_float = camera.pixels_as_float;
        requests.push_back(request);
      }
      if (requests.empty()) continue;
      std::string files;
      for (const auto& image : images.Capture(snapshot, requests, vehicle.name, false)) {
        if (!files.empty()) files += ';';
        files += WriteImage(image, vehicle.name);
      }
      const airsim::Pose pose = airsim::ToPose(snapshot->state.vehicles[v].motion.X_WB, vehicle.origin_W);
      const auto& p = pose.position;
      const auto& q = pose.orientation;
      std::ofstream(folder_ / "airsim_rec.txt", std::ios::app)
          << vehicle.name << '\t' << snapshot->time_stamp() / 1000000 << '\t' << p.x_val << '\t' << p.y_val
          << '\t' << p.z_val << '\t' << q.w_val << '\t' << q.x_val << '\t' << q.y_val << '\t' << q.z_val
          << '\t' << files << '\n';
    }
  } catch (const std::exception& error) {
    failed_ = true;
    LogWarning("recording has ended: " + std::string(error.what()));
  }
}

}  // namespace airsim360

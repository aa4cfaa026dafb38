#include "airsim360/rpc/recording_writer.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

std::filesystem::path NewFolder(const std::filesystem::path& parent) {
  char name[64];
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::strftime(name, sizeof name, "%Y-%m-%d-%H-%M-%S", &local);
  const char* home = std::getenv("HOME");
  const std::filesystem::path folder = parent.empty() ? std::filesystem::path(home ? home : ".") / "Documents" / "AirSim" : parent;
  // Two recordings may start in one second.
  std::filesystem::path unused = folder / name;
  std::error_code error;
  for (int number = 2; std::filesystem::exists(unused, error); ++number)
    unused = folder / std::string(name).append("-").append(std::to_string(number));
  return unused;
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

class FolderRecording : public FlightRecorder::Recording, public std::enable_shared_from_this<FolderRecording> {
 public:
  FolderRecording(const RecordingSettings& settings, ImageService& images);
  void Record(const SnapshotPointer& snapshot) override;
  bool failed() const override { return failed_; }

 private:
  void Write(ImageService& images, const SnapshotPointer& snapshot);
  void WriteVehicle(ImageService& images, const SnapshotPointer& snapshot, size_t index);
  std::string WriteImage(const airsim::ImageResponse& image, const std::string& vehicle);
  void Append(const std::string& line);

  const RecordingSettings settings_;
  ImageService& images_;
  const std::filesystem::path folder_;
  std::atomic<bool> failed_{false};
  std::atomic<int> waiting_{0};  // records that are not written yet
  bool is_late_ = false;         // of the session's thread: the log knows
};

FolderRecording::FolderRecording(const RecordingSettings& settings, ImageService& images)
    : settings_(settings), images_(images), folder_(NewFolder(settings.folder)) {
  CreateWritableFolder(folder_ / "images");
  Append("VehicleName\tTimeStamp\tPOS_X\tPOS_Y\tPOS_Z\tQ_W\tQ_X\tQ_Y\tQ_Z\tImageFile\n");
  LogInfo("recording to " + folder_.string());
}

void FolderRecording::Record(const SnapshotPointer& snapshot) {
  constexpr int kMostWaiting = 256;
  if (waiting_ >= kMostWaiting) {
    if (!is_late_) LogWarning("the recording does not keep up: records are left out");
    is_late_ = true;
    return;
  }
  ++waiting_;
  constexpr uint64_t kRecorder = 0;  // no connection has this id
  images_.Post(kRecorder, [self = shared_from_this(), snapshot](ImageService& images) {
    self->Write(images, snapshot);
    --self->waiting_;
  });
}

void FolderRecording::Append(const std::string& line) {
  const std::filesystem::path path = folder_ / "airsim_rec.txt";
  std::ofstream file(path, std::ios::app);
  errno = 0;
  if (!(file << line << std::flush)) throw RuntimeError(path.string() + ": cannot write: " + std::strerror(errno));
}

std::string FolderRecording::WriteImage(const airsim::ImageResponse& image, const std::string& vehicle) {
  const std::string name = "img_" + vehicle + "_" + std::filesystem::path(image.camera_name).filename().string() + "_" +
                           std::to_string(static_cast<int>(image.image_type)) + "_" + std::to_string(image.time_stamp) +
                           (image.pixels_as_float ? ".pfm" : ".png");
  WriteFileAtomically(folder_ / "images" / name, image.pixels_as_float ? Pfm(image) : std::string(image.image_data_uint8.bytes.view()));
  return name;
}

void FolderRecording::Write(ImageService& images, const SnapshotPointer& snapshot) {
  if (failed_) return;
  try {
    for (size_t v = 0; v < snapshot->vehicles.size(); ++v) WriteVehicle(images, snapshot, v);
  } catch (const std::exception& error) {
    failed_ = true;
    LogWarning("recording has ended: " + std::string(error.what()));
  }
}

// One line of the table and the pictures that it names.
void FolderRecording::WriteVehicle(ImageService& images, const SnapshotPointer& snapshot, size_t v) {
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
  if (requests.empty()) return;
  std::string files;
  for (const auto& image : images.Capture(snapshot, requests, vehicle.name, false)) {
    if (!files.empty()) files += ';';
    files += WriteImage(image, vehicle.name);
  }
  const airsim::Pose pose = airsim::ToPose(snapshot->state.vehicles[v].motion.X_WB, vehicle.origin_W);
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  std::ostringstream line;
  line << vehicle.name << '\t' << snapshot->time_stamp() / 1000000 << '\t' << p.x_val << '\t' << p.y_val << '\t' << p.z_val << '\t'
       << q.w_val << '\t' << q.x_val << '\t' << q.y_val << '\t' << q.z_val << '\t' << files << '\n';
  Append(line.str());
}

}  // namespace

void WriteRecordings(Session& session, ImageService& images) {
  session.Post([&images](Session& s) -> std::function<void()> {
    RecordingSettings settings = s.settings().recording;
    if (settings.cameras.empty()) settings.cameras.push_back({});
    s.recorder().SetOpen([settings, &images] { return std::make_shared<FolderRecording>(settings, images); });
    if (!settings.enabled) return {};
    try {
      s.recorder().Start();
    } catch (const std::exception& error) {
      LogWarning("nothing is recorded: " + std::string(error.what()));
    }
    return {};
  });
}

}  // namespace airsim360

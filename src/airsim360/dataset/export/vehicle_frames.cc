#include "airsim360/dataset/export/vehicle_frames.h"

#include "airsim360/base/file.h"

namespace airsim360::internal {
namespace {

std::filesystem::path VehiclesFile(const ExportJob& job) { return job.data.folder() / "vehicles.jsonl"; }

}  // namespace

bool HasVehicles(const ExportJob& job) { return std::filesystem::exists(VehiclesFile(job)); }

std::vector<Json> ReadVehicles(const ExportJob& job) {
  const std::filesystem::path path = VehiclesFile(job);
  std::vector<Json> frames;
  const std::string text = ReadTextFile(path, uint64_t{4} << 30);
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const Json line = Json::parse(text.substr(begin, end - begin), nullptr, false);
    if (!line.is_object() || !line.contains("vehicles") || !line["vehicles"].is_array())
      throw InputError(path.string() + ":" + std::to_string(frames.size() + 1) + ": is no line of vehicles");
    frames.push_back(line["vehicles"]);
    begin = end + 1;
  }
  if (frames.size() != job.data.size())
    throw InputError(path.string() + ": has " + std::to_string(frames.size()) + " lines, the dataset " + std::to_string(job.data.size()) +
                     " frames");
  return frames;
}

std::vector<SeenVehicle> VehiclesSeen(const ExportJob& job, const NativeFrame& frame, const View& view, const Json& vehicles) {
  return OfVehicles(job, frame, [&] {
    std::map<EntityId, const Json*> known;
    for (const Json& vehicle : vehicles) known[vehicle.at("entity")] = &vehicle;
    std::vector<SeenVehicle> seen;
    for (const Segment& segment : job.data.Segments(frame, view))
      if (const auto found = known.find(segment.entity); found != known.end()) seen.push_back({found->second, segment});
    return seen;
  });
}

bool IsCategory(const std::string& category, const std::string& path) { return category == path || category.starts_with(path + "/"); }

}  // namespace airsim360::internal

#include "airsim360/view/drawing.h"

#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "airsim360/assets/labels/label_count.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/record/rig_file.h"
#include "airsim360/opening/world_file.h"
#include "airsim360/routes/route_file.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// A file for as long as it is read; messages name it without its folder.
class PassingFile {
 public:
  PassingFile(std::string name, const std::string& text) : name_(std::move(name)) {
    static std::atomic<int> count = 0;
    folder_ = fs::temp_directory_path() / ("airsim360_view_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
    fs::create_directories(folder_);
    WriteFileAtomically(path(), text);
  }
  ~PassingFile() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  fs::path path() const { return folder_ / name_; }
  std::string InMessages(std::string message) const {
    const std::string folder = folder_.string() + "/";
    for (size_t at = 0; (at = message.find(folder, at)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

 private:
  std::string name_;
  fs::path folder_;
};

std::string Count(size_t count, const char* one, const char* many) { return std::to_string(count) + " " + (count == 1 ? one : many); }

// Has `read` look at a text as a file of that name.
template <class Read>
std::string CheckFile(const char* name, const std::string& text, const Read& read) {
  const PassingFile file(name, text);
  try {
    return read(file.path());
  } catch (const InputError& error) {
    throw InputError(file.InMessages(error.what()));
  }
}

std::string CheckPeople(const SimModel& model, const std::string& text) {
  if (!model.people) throw InputError("there is nobody in this world; start 'airsim360 view' with --people N to draw for people");
  if (text.find("trees:") != std::string::npos) throw InputError("trees: files beside people.yaml are not known here");
  return CheckFile("people.yaml", text, [&](const fs::path& file) {
    CrowdRequest request;
    request.file = file;
    const auto crowd = BuildCrowd(model.tracer->scene(), model.people->crowd->navmesh, request);
    StartCrowd(*crowd);
    return Count(crowd->areas.size(), "area", "areas") + ", " + Count(crowd->people.size(), "person", "people");
  });
}

std::string CheckLabels(const Scene& scene, const fs::path& file) {
  const LabelCount count = CountLabelled(scene, file);
  if (count.unused > 0) throw InputError("labels.yaml: " + Count(count.unused, "rule matches", "rules match") + " nothing in this world");
  return Count(count.rules, "rule", "rules") + " for " + Count(count.entities, "thing", "things");
}

std::string CheckWorld(const Scene& scene, const fs::path& file) {
  const std::vector<PlacedLamp> lamps = LampsOfWorldFile(file);
  CheckLamps(scene, lamps);
  return Count(lamps.size(), "lamp", "lamps");
}

}  // namespace

std::string CheckDrawing(const SimModel& model, const std::string& kind, const std::string& text) {
  if (kind == "people") return CheckPeople(model, text);
  if (kind == "cameras")
    return CheckFile("rig.yaml", text, [](const fs::path& file) { return Count(ReadRigFile(file).size(), "camera", "cameras"); });
  if (kind == "labels")
    return CheckFile("labels.yaml", text, [&](const fs::path& file) { return CheckLabels(model.tracer->scene(), file); });
  if (kind == "world") return CheckFile("world.yaml", text, [&](const fs::path& file) { return CheckWorld(model.tracer->scene(), file); });
  if (kind != "route")
    throw InputError("kind: " +
                     UnknownChoiceMessage("drawing", kind, std::vector<std::string>{"people", "route", "cameras", "labels", "world"}));
  const std::vector<Waypoint> waypoints = ParseRouteYaml(text, "route.yaml");
  if (waypoints.size() > 1) RouteThrough(waypoints, 1);
  return Count(waypoints.size(), "waypoint", "waypoints");
}

}  // namespace airsim360

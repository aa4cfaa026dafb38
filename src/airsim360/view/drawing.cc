#include "airsim360/view/drawing.h"

#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/routes/route_file.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// A file for as long as it is read; messages name it without its folder.
class PassingFile {
 public:
  explicit PassingFile(const std::string& text) {
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
  fs::path path() const { return folder_ / "people.yaml"; }
  std::string InMessages(std::string message) const {
    const std::string folder = folder_.string() + "/";
    for (size_t at = 0; (at = message.find(folder, at)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

 private:
  fs::path folder_;
};

std::string CheckPeople(const SimModel& model, const std::string& text) {
  if (!model.people) throw InputError("there is nobody in this world; start 'airsim360 view' with --people N to draw for people");
  if (text.find("trees:") != std::string::npos) throw InputError("trees: files beside people.yaml are not known here");
  const PassingFile file(text);
  try {
    CrowdRequest request;
    request.file = file.path();
    const auto crowd = BuildCrowd(model.tracer->scene(), model.people->crowd->navmesh, request);
    StartCrowd(*crowd);
    return std::to_string(crowd->areas.size()) + " areas, " + std::to_string(crowd->people.size()) + " people";
  } catch (const InputError& error) {
    throw InputError(file.InMessages(error.what()));
  }
}

}  // namespace

std::string CheckDrawing(const SimModel& model, const std::string& kind, const std::string& text) {
  if (kind == "people") return CheckPeople(model, text);
  if (kind != "route") throw InputError("kind: " + UnknownChoiceMessage("drawing", kind, std::vector<std::string>{"people", "route"}));
  const std::vector<Waypoint> waypoints = ParseRouteYaml(text, "route.yaml");
  if (waypoints.size() > 1) RouteThrough(waypoints, 1);
  return std::to_string(waypoints.size()) + " waypoints";
}

}  // namespace airsim360

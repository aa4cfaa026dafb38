// airsim360 fly: one drone flies a script, or waypoints, through a world.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/camera_check.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/picture_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/video_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/app/fly/fly_run.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/dataset/video.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/drone_file.h"
#include "airsim360/math/angles.h"
#include "airsim360/planning/splines/time_allocation.h"
#include "airsim360/routes/route_file.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/trajectory_reference.h"

namespace airsim360 {
namespace {
namespace fs = std::filesystem;

struct FlyArguments {
  std::string world, drone = "hummingbird", controller = "indi", waypoints, script, mission, pose, sensors, wind, out, size = "1024x512",
                     video;
  double vmax = 4, amax = 4, speed = 0, longest = 600, fps = VideoOptions{}.frame_rate;
  int64_t frames = 0;
  bool record = false;
  EnvironmentFlags environment;
  PeopleArguments people;
  TrafficArguments traffic;
  PictureArguments picture;
  bool pano_frame_given = false;
  VideoArguments encoding;
};

// The waypoints as a trajectory within the limits, and where it begins.
std::shared_ptr<const PolynomialTrajectory> PlanThroughWaypoints(const FlyArguments& arguments) {
  std::vector<Vec3d> points;
  for (const Waypoint& waypoint : ReadRouteFile(arguments.waypoints)) points.push_back(waypoint.p);
  if (points.size() < 2) throw InputError("--waypoints: " + arguments.waypoints + " holds one point only");
  TrajectoryLimits limits;
  limits.speed = arguments.vmax;
  limits.acceleration = arguments.amax;
  return std::make_shared<const PolynomialTrajectory>(AllocateTimes(points, limits, {.split = true}).trajectory);
}

// The standard set without its panorama, which --frames and --video stand for: cameras are those that a file
// names.
SensorSet ReadSensors(const std::string& file) {
  SensorSet sensors = SensorSet::Standard();
  sensors.cameras.clear();
  return file.empty() ? sensors : ReadSensorSet(file, sensors);
}

std::vector<FlyTask> TasksOf(const FlyArguments& arguments, const std::shared_ptr<const PolynomialTrajectory>& trajectory) {
  if (!arguments.mission.empty()) return {};
  if (!trajectory) return ParseFlyScript(arguments.script.empty() ? "takeoff 2; hover 3; land" : arguments.script);
  const Vec3d way = trajectory->At(std::min(1.0, trajectory->duration())).p - trajectory->At(0).p;
  const auto reference = std::make_shared<const PlannedReference>(trajectory, std::nullopt, std::atan2(way.y, way.x));
  constexpr double kSettle = 1;  // seconds to come to rest after it
  return {{"waypoints", TrajectoryCommand{reference}, trajectory->duration() + kSettle}, {"hover 1", HoverCommand{}, 1}};
}

// Where the drone begins: hovering at the first waypoint, or standing under the pose.
void SetStart(const FlyArguments& arguments, const RayTracer& tracer, const PolynomialTrajectory* trajectory, DroneSetup& setup) {
  const Scene& scene = tracer.scene();
  constexpr Vec3d kLift{0, 0, 0.05};  // metres: a place on the ground is none below it
  if (trajectory != nullptr) {
    CheckStart(tracer, trajectory->At(0).p + kLift, "--waypoints: the first");
    const Vec3d way = trajectory->At(std::min(1.0, trajectory->duration())).p - trajectory->At(0).p;
    setup.X_WB = BodyPose(trajectory->At(0).p, std::atan2(way.y, way.x), 0, 0);
    setup.airborne = true;
  } else if (!arguments.pose.empty()) {
    const PoseArgument pose = ParsePose(arguments.pose);
    CheckStart(tracer, pose.p + kLift, "--pose");
    setup.X_WB = BodyPose(pose.p, pose.yaw_deg * kDegree, 0, 0);
  } else {
    setup.X_WB = BodyPose(VecCast<double>(FirstViewpoint(scene)), scene.spawn_yaw_deg * kDegree, 0, 0);
  }
}

// What became of a mission, as text: still running is "stopped".
std::string MissionResult(const MissionProgress& mission) {
  if (mission.result == MissionProgress::Result::kRunning) return "stopped";
  return kMissionResultNames[static_cast<size_t>(mission.result)];
}

nlohmann::ordered_json MissionJson(const FlyResult& r) {
  nlohmann::ordered_json json = {
      {"result", MissionResult(*r.mission)}, {"log", r.mission->log}, {"captures", nlohmann::ordered_json::object()}};
  for (const MissionCapture& capture : r.captures) json["captures"][capture.to] = json["captures"].value(capture.to, 0) + 1;
  return json;
}

nlohmann::ordered_json ResultJson(const FlyArguments& arguments, const DroneModel& drone, const FlyResult& r, const Scene& scene) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const SimEvent& event : r.events) {
    nlohmann::ordered_json json = {{"t_s", static_cast<double>(event.t_ns) * 1e-9},
                                   {"event", kSimEventNames[static_cast<size_t>(event.kind)]}};
    if (event.collision.count > 0) {
      const CollisionInfo& c = event.collision;
      json["entity_id"] = c.entity;
      json["entity"] = c.entity != kNoEntity ? scene.entity(c.entity).name : "";
      json["impact_speed"] = c.impact_speed;
      json["point"] = {c.p_W.x, c.p_W.y, c.p_W.z};
      json["normal"] = {c.normal_W.x, c.normal_W.y, c.normal_W.z};
    }
    if (event.kind == SimEvent::Kind::kNearMiss) {
      json["time_to_collision"] = event.near_miss.seconds;
      json["braking"] = event.near_miss.braking;
    }
    if (!event.text.empty()) json["text"] = event.text;
    events.push_back(json);
  }
  char hash[24];
  std::snprintf(hash, sizeof(hash), "%016llx", static_cast<unsigned long long>(r.hash));
  nlohmann::ordered_json json = {{"out", arguments.out},         {"world", arguments.world},
                                 {"drone", drone.name},          {"controller", arguments.controller},
                                 {"flight_s", r.pace.simulated}, {"steps", r.steps}};
  if (r.tracking_rms >= 0) {
    json["tracking_rms"] = r.tracking_rms;
    json["tracking_max"] = r.tracking_max;
  }
  json["least_clearance"] = nullptr;
  if (r.least_clearance) json["least_clearance"] = *r.least_clearance;
  json["charge"] = r.charge;
  if (r.mission) json["mission"] = MissionJson(r);
  json["events"] = events;
  json["real_time_factor"] = r.pace.real_time_factor;
  json["state_hash"] = hash;
  return json;
}

std::string Metres(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f m", value);
  return text;
}

constexpr char kFlightName[] = "flight.json";

std::string FileSum(const std::string& file) { return file.empty() ? "" : "sha256:" + Sha256HexOfFile(file); }

// All that the flight follows from; frames have a description of their own. Files count by what they hold.
std::string DescribeFlight(const FlyArguments& arguments, const GlobalOptions& globals, const Environment& environment) {
  const bool is_file = fs::is_regular_file(arguments.drone);
  nlohmann::ordered_json json = {{"format", "airsim360-flight-1"},
                                 {"generator", std::string("airsim360 ") + kVersion},
                                 {"parameters",
                                  {{"world", DescribeWorld(arguments.world, globals)},
                                   {"seed", globals.seed},
                                   {"labels", DescribeLabels(globals)},
                                   {"drone", is_file ? FileSum(arguments.drone) : arguments.drone},
                                   {"controller", arguments.controller},
                                   {"waypoints", FileSum(arguments.waypoints)},
                                   {"script", arguments.script},
                                   {"pose", arguments.pose},
                                   {"vmax", arguments.vmax},
                                   {"amax", arguments.amax},
                                   {"sensors", FileSum(arguments.sensors)},
                                   {"wind", FileSum(arguments.wind)},
                                   {"people", arguments.people.Describe()},
                                   {"traffic", arguments.traffic.Describe()},
                                   {"environment", DescribeEnvironment(environment)}}}};
  if (!arguments.mission.empty()) {
    json["parameters"]["mission"] = FileSum(arguments.mission);
    json["parameters"]["longest"] = arguments.longest;
  }
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void WriteFiles(const FlyArguments& arguments, const FlyResult& result) {
  const fs::path out = arguments.out;
  WriteFileAtomically(out / "trajectory.csv", TrajectoryCsv(result.flight));
  if (result.recording) WriteRecording(out / "run.a360", *result.recording);
}

// What frames and videos of the flight look like. A video is level unless told otherwise: nobody likes a sphere that rolls.
DatasetSpec SpecOf(const FlyArguments& arguments, const GlobalOptions& globals, bool video) {
  DatasetSpec spec = arguments.picture.Spec();
  DescribeRun("fly", arguments.world, globals, spec);
  const ImageSize size = ParseSize(arguments.size);
  CheckPanoramaSize(size);
  spec.width = size.width;
  spec.height = size.height;
  spec.frames = arguments.frames;
  spec.route = "flight of " + arguments.drone;
  spec.people = arguments.people.Describe();
  spec.traffic = arguments.traffic.Describe();
  if (video && !arguments.pano_frame_given) spec.pano_frame = PanoFrame::kLevel;
  PictureArguments::Check(spec);
  return spec;
}

void WriteFrames(const FlyArguments& arguments, const GlobalOptions& globals, Stage& stage, const FlyResult& result) {
  if (arguments.frames == 0) return;
  DatasetSpec spec = SpecOf(arguments, globals, false);
  spec.environment = DescribeEnvironment(stage.environment());
  Collect(InputOf(stage, spec, result.flight, fs::path(arguments.out) / "frames"), stage.renderer(spec.tier));
}

// A dataset of each name that the mission's captures have.
void WriteCaptures(const FlyArguments& arguments, const GlobalOptions& globals, Stage& stage, const FlyResult& result) {
  std::map<std::string, Flight> flights;
  std::map<std::string, std::vector<std::string>> products;
  for (const MissionCapture& capture : result.captures) {
    flights[capture.to].shots.push_back(capture.shot);
    products[capture.to] = capture.products;
  }
  for (auto& [to, flight] : flights) {
    DatasetSpec spec = SpecOf(arguments, globals, false);
    spec.products = WithProducts(spec.products, products[to]);
    PictureArguments::Check(spec);
    spec.frames = static_cast<int64_t>(flight.shots.size());
    spec.route = "mission flown by " + arguments.drone;
    spec.environment = DescribeEnvironment(stage.environment());
    flight.trajectory = result.flight.trajectory;
    flight.least_clearance = result.flight.least_clearance;
    Collect(InputOf(stage, spec, flight, fs::path(arguments.out) / to), stage.renderer(spec.tier));
  }
}

std::optional<VideoResult> WriteVideo(const FlyArguments& arguments, const GlobalOptions& globals, Stage& stage, FlyResult& result) {
  if (arguments.video.empty()) return {};
  const DatasetSpec spec = SpecOf(arguments, globals, true);
  Flight flight;
  flight.shots = std::move(result.video);
  return FilmFlight(InputOf(stage, spec, flight, {}), stage.renderer(spec.tier), arguments.video,
                    arguments.encoding.Options(arguments.fps));
}

// Everything that can be wrong with a video, before anything is loaded.
void CheckVideoFlags(const FlyArguments& arguments, const GlobalOptions& globals) {
  const DatasetSpec spec = SpecOf(arguments, globals, true);
  if (arguments.video.empty()) return;
  if (spec.tier == Tier::kLabels) throw InputError("--video: it needs colours; use --tier fast instead of labels");
  CheckVideoPath(arguments.video);
  CheckVideo({spec.width, spec.height}, arguments.encoding.Options(arguments.fps));
}

// Everything is written by then; the status says that the mission did not do what it should.
void CheckMissionResult(const FlyArguments& arguments, const FlyResult& result) {
  if (!result.mission || result.mission->result == MissionProgress::Result::kSuccess) return;
  const std::string last = result.mission->log.empty() ? "" : "; last: " + result.mission->log.back();
  if (result.mission->result == MissionProgress::Result::kRunning)
    throw RuntimeError(arguments.mission + ": the mission was stopped after " + std::to_string(std::lround(arguments.longest)) +
                       " s (--longest)" + last);
  throw RuntimeError(arguments.mission + ": the mission has failed" + last);
}

// Everything is written by then as well.
void CheckCrash(const FlyResult& result, const Scene& scene) {
  for (const SimEvent& event : result.events)
    if (event.kind == SimEvent::Kind::kCrash) throw RuntimeError("fly: the drone has crashed: " + DescribeEvent(event, scene));
}

// A place that the drone cannot reach, say, or a battery that was empty before.
void CheckTasks(const FlyResult& result) {
  for (const std::string& task : result.unfinished) throw RuntimeError("fly: '" + task + "' did not end and was given up");
}

void PrintFlight(const FlyArguments& arguments, const FlyResult& result, const std::optional<VideoResult>& video) {
  const std::string clearance = result.least_clearance ? Metres(*result.least_clearance) : "not flown";
  std::printf("%s: %.1f s of flight, %zu events, least clearance in the air %s, %.1f times real time\n", arguments.out.c_str(),
              result.pace.simulated, result.events.size(), clearance.c_str(), result.pace.real_time_factor);
  if (video)
    std::printf("%s: %lld pictures, %.2f s (%s)\n", arguments.video.c_str(), static_cast<long long>(video->pictures), video->seconds,
                video->encoder.c_str());
  if (result.tracking_rms >= 0) std::printf("tracking error %.3f m rms, %.3f m at most\n", result.tracking_rms, result.tracking_max);
  if (result.mission) std::printf("mission: %s, %zu captures\n", MissionResult(*result.mission).c_str(), result.captures.size());
}

nlohmann::ordered_json VideoJson(const FlyArguments& arguments, const VideoResult& video) {
  return {{"file", arguments.video},
          {"pictures", video.pictures},
          {"seconds", video.seconds},
          {"encoder", video.encoder},
          {"render_ms", video.render_ms / static_cast<double>(video.pictures)}};
}

/// What follows from the flags alone. Everything that can be wrong with them is found here, before a world is loaded.
struct FlyPlan {
  std::string mission_xml;
  DroneSetup setup;
  std::shared_ptr<const PolynomialTrajectory> trajectory;
  FlyJob job;
  StageOptions stage;
};

FlyPlan PlanFlight(FlyArguments& arguments, const GlobalOptions& globals) {
  if (!arguments.waypoints.empty() + !arguments.script.empty() + !arguments.mission.empty() > 1)
    throw InputError("fly: give one of --waypoints, --script and --mission");
  FlyPlan plan;
  if (!arguments.mission.empty()) {
    plan.mission_xml = ReadTextFile(arguments.mission, uint64_t{1} << 21);
    CheckMission(plan.mission_xml, arguments.mission);
  }
  plan.setup = {.name = "drone", .model = FindDrone(arguments.drone)};
  plan.setup.autopilot.controller = ParseControllerKind(arguments.controller);
  plan.setup.sensors = ReadSensors(arguments.sensors);
  if (!arguments.waypoints.empty()) plan.trajectory = PlanThroughWaypoints(arguments);
  FlyJob& job = plan.job;
  job.tasks = TasksOf(arguments, plan.trajectory);
  double longest = arguments.mission.empty() ? 0 : arguments.longest;
  for (const FlyTask& task : job.tasks) longest += task.seconds;
  CheckSensorLog(plan.setup.sensors, longest);
  CheckVideoFlags(arguments, globals);
  plan.stage = StageOptionsOf(arguments.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                              arguments.traffic.Request(globals.seed));
  plan.stage.wind = ReadWindFile(arguments.wind);
  if (!arguments.pose.empty()) {
    arguments.pose = WithPlace("--pose", arguments.pose, RequestOf(arguments.world, globals));
    const PoseArgument pose = ParsePose(arguments.pose);
    if (pose.pitch_deg != 0 || pose.roll_deg != 0)
      throw InputError("--pose: '" + arguments.pose + "': a drone that begins on the ground stands level; give x,y,z[,yaw_deg]");
  }
  job.longest = arguments.longest;
  job.speed = arguments.speed;
  job.frames = arguments.frames;
  if (!arguments.video.empty()) job.video_fps = arguments.fps;
  if (arguments.record) job.record_note = arguments.world + ", " + arguments.drone;
  job.log = [](const std::string& text) { LogInfo(text); };
  return plan;
}

void RunFly(FlyArguments arguments, const GlobalOptions& globals) {
  FlyPlan plan = PlanFlight(arguments, globals);
  FlyJob& job = plan.job;
  Stage stage(plan.stage);
  SetStart(arguments, *stage.solid(), plan.trajectory.get(), plan.setup);
  SimModel model = stage.Model();
  model.drones.push_back(std::make_shared<const SimDrone>(plan.setup, model.dt_ns));
  job.model = std::make_shared<const SimModel>(std::move(model));
  if (!arguments.mission.empty())
    job.mission = ReadMission(plan.mission_xml, arguments.mission, {job.model, OriginOfWorld(RequestOf(arguments.world, globals))});

  const fs::path out = arguments.out;
  const std::string description = DescribeFlight(arguments, globals, stage.environment());
  CheckFolder(out, description, "flight", kFlightName);
  const FolderLock lock(out);
  WriteFileAtomically(out / kFlightName, description);
  SensorLog sensors(job.model, stage, out / "sensors");
  job.sensors = &sensors;
  FlyResult result = RunFlight(job);
  sensors.WriteTables();
  WriteFiles(arguments, result);
  WriteFrames(arguments, globals, stage, result);
  WriteCaptures(arguments, globals, stage, result);
  const std::optional<VideoResult> video = WriteVideo(arguments, globals, stage, result);
  if (globals.json) {
    nlohmann::ordered_json json = ResultJson(arguments, plan.setup.model, result, stage.scene());
    if (video) json["video"] = VideoJson(arguments, *video);
    PrintJson(json);
  } else {
    PrintFlight(arguments, result, video);
  }
  CheckMissionResult(arguments, result);
  CheckCrash(result, stage.scene());
  CheckTasks(result);
}

// Flags that count for one way to fly alone are not accepted and ignored elsewhere.
void CheckBelonging(const CLI::App& command) {
  RefuseWithout(command, {"--vmax", "--amax"}, "--waypoints");
  RefuseWithout(command, {"--longest"}, "--mission");
  RefuseWithout(command, {"--fps", "--encoder", "--quality"}, "--video");
  if (command.count("--waypoints") > 0 && command.count("--pose") > 0)
    throw InputError("--pose: with --waypoints the flight begins at the first of them");
}

}  // namespace

void AddFlyCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("fly", "fly one drone through a world, with dynamics and sensors");
  auto arguments = std::make_shared<FlyArguments>();
  command
      ->add_option("--world", arguments->world,
                   "name (airsim360 worlds) or path of a .glb, .gltf, .obj, .city.json, .osm, .osm.pbf or world .yaml")
      ->required();
  command->add_option("--out", arguments->out, "folder of trajectory.csv, sensors/ and frames/")->required();
  command->add_option("--drone", arguments->drone, "name of the catalogue, a drone .yaml, or words in quotes (default hummingbird)");
  command->add_option("--controller", arguments->controller, "simple_flight, px4, se3 or indi (default indi)");
  command->add_option("--waypoints", arguments->waypoints, "CSV x,y,z: minimum-snap flight through them, begun hovering at the first");
  command->add_option("--script", arguments->script,
                      "tasks: takeoff [HEIGHT]; hover SECONDS; goto X,Y,Z[,SPEED]; velocity X,Y,Z,SECONDS; "
                      "return; land (default \"takeoff 2; hover 3; land\")");
  command->add_option("--mission", arguments->mission,
                      "behaviour tree in XML (docs/guide/missions.md); its captures become datasets in --out");
  command->add_option("--longest", arguments->longest, "seconds after which a mission is stopped (default 600)")
      ->check(CLI::Range(0.1, 86400.0));
  command->add_option("--pose", arguments->pose,
                      "x,y,z[,yaw_deg] above where it stands; in maps also 60.1708N,24.9375E for x,y (default: the spawn)");
  command->add_option("--vmax", arguments->vmax, "m/s of --waypoints (default 4)")->check(CLI::Range(0.01, 100.0));
  command->add_option("--amax", arguments->amax, "m/s^2 of --waypoints (default 4)")->check(CLI::Range(0.01, 100.0));
  command->add_option("--sensors", arguments->sensors, "sensor file (docs/reference/sensors.md): all that it names is written to sensors/");
  AddWindFlag(*command, arguments->wind);
  command->add_option("--speed", arguments->speed, "simulated seconds a second, 0 = as fast as possible (default)")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--frames", arguments->frames, "panoramas spread over the flight, in frames/ (default 0)")
      ->check(CLI::Range(int64_t{0}, int64_t{1000000}));
  command->add_option("--size", arguments->size, "WxH of the panoramas (default 1024x512)");
  arguments->picture.AddTo(*command);
  command->add_option("--video", arguments->video, "FILE.mp4: a 360 degree video of the flight; needs the program ffmpeg");
  command->add_option("--fps", arguments->fps, "pictures a second of the video (default 30)")->check(CLI::Range(0.1, 240.0));
  arguments->encoding.AddTo(*command);
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->add_flag("--record", arguments->record, "write run.a360: commands and state hashes, for replay");
  command->callback([arguments, command, &globals] {
    CheckBelonging(*command);
    arguments->pano_frame_given = command->count("--pano-frame") > 0;
    RunFly(*arguments, globals);
  });
}

}  // namespace airsim360

// airsim360 collect: a dataset along a route.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "airsim360/app/dataset/collect_human.h"
#include "airsim360/app/dataset/collect_processes.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/camera_arguments.h"
#include "airsim360/app/flags/camera_check.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/picture_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/app/plan/plan_file.h"
#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/export/export.h"
#include "airsim360/dataset/video.h"
#include "airsim360/planning/export/export_text.h"
#include "airsim360/routes/route_file.h"
#include "airsim360/routes/survey.h"
#include "airsim360/sim/people_survey.h"
#include "airsim360/sim/visit_poses.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kDefaultFrames = 8;
constexpr int64_t kMaxFrames = 1'000'000;
constexpr double kFileRouteSpeed = 3;  // m/s along route files without times
constexpr double kTouching = 0.05;     // metres: a route closer to a surface is worth a warning

struct CollectArguments {
  std::string world, route = "auto", format = "native", shard = "0/1", out, plan, poses, recipe, subset;
  int64_t frames = 0;  // 0: not given
  double fps = 0;      // 0: not given
  std::optional<double> start;
  EnvironmentFlags environment;
  CameraArguments camera;
  PictureArguments picture;
  PeopleArguments people;
  TrafficArguments traffic;
  ProcessArguments processes;
};

// Written frame by frame; other formats are exports of the finished dataset.
constexpr std::array<std::string_view, 9> kOwnFormats = {"native",   "coco",     "video", "coco_keypoints", "kitti",
                                                         "nuscenes", "monoloco", "crops", "overlay"};

// The formats of --format that are exports.
std::vector<std::string> ExportsOf(const CollectArguments& arguments) {
  std::vector<std::string> exports;
  for (const ExportFormatInfo& format : ExportFormats()) {
    const std::string name = format.name;
    if (std::ranges::count(kOwnFormats, name) == 0 && ("," + arguments.format + ",").find("," + name + ",") != std::string::npos)
      exports.push_back(name);
  }
  return exports;
}

// Beside the dataset, whose files they are not. What stands there already was made by an earlier run: an export is whole or missing.
void WriteExports(const CollectArguments& arguments, bool quiet) {
  const std::string folder = fs::path(arguments.out).lexically_normal().string();
  for (const std::string& format : ExportsOf(arguments)) {
    const fs::path out = (folder.ends_with('/') ? folder.substr(0, folder.size() - 1) : folder) + "_" + format;
    if (!fs::exists(out)) ExportDataset(arguments.out, format, out);
    if (!quiet) std::printf("%s: as %s\n", out.c_str(), format.c_str());
  }
}

// The video, people, and what is written of them. The native layout holds panoptic.json and people.jsonl in any case.
void SetFormats(const CollectArguments& arguments, DatasetSpec& spec) {
  std::vector<std::string> known(kOwnFormats.begin(), kOwnFormats.end());
  for (const ExportFormatInfo& other : ExportFormats()) known.emplace_back(other.name);
  const std::vector<std::string> formats = ParseList("--format", arguments.format, known);
  const std::vector<std::string> exports = ExportsOf(arguments);
  if (!exports.empty() && (arguments.shard != "0/1" || !arguments.recipe.empty()))
    throw InputError("--format: '" + exports.front() + "' is made of a whole dataset; collect without it, then airsim360 dataset export");
  spec.people = arguments.people.Describe();
  spec.traffic = arguments.traffic.Describe();
  const auto wanted = [&](const std::string& name) { return std::ranges::count(formats, name) > 0; };
  for (const std::string format : kPeopleFormats) {
    const bool coco = format == "coco_keypoints" && wanted("coco") && !spec.people.empty();
    if (wanted(format) || coco) spec.people_formats.push_back(format);
  }
  spec.video = wanted("video");
  if (spec.video && spec.tier == Tier::kLabels) throw InputError("--format: a video needs colours; use --tier fast instead of labels");
  if (spec.video && Views(spec).size() > 1)
    throw InputError("--format: a video shows one picture a frame; use --projection erp, pinhole or fisheye");
  if (spec.video) CheckVideo({spec.width, spec.height}, {});
  spec.crops = wanted("crops");
  spec.overlay = wanted("overlay");
  for (const char* format : {"kitti", "nuscenes", "monoloco"}) {
    if (wanted(format) && (!IsPanoramic(spec) || !spec.cameras.empty()))
      throw InputError("--format: '" + std::string(format) + "' is made of panoramas; use --projection erp");
  }
  if (spec.people.empty() && (spec.crops || spec.overlay || !spec.people_formats.empty()))
    throw InputError("--format: '" + arguments.format + "' is about people; add --people N");
  if ((spec.crops || spec.overlay) && spec.tier == Tier::kLabels)
    throw InputError("--format: crops and overlay need colours; use --tier fast instead of labels");
}

DatasetSpec MakeSpec(const CollectArguments& arguments, const GlobalOptions& globals) {
  DatasetSpec spec = arguments.picture.Spec();
  arguments.camera.Apply(spec);
  PictureArguments::Check(spec);
  DescribeRun("collect", arguments.world, globals, spec);
  SetFormats(arguments, spec);
  const Shard shard = ParseShard(arguments.shard);
  spec.shard = shard.index;
  spec.shards = shard.count;
  return spec;
}

// The moments of frames along a route: as many as are wanted, evenly, or one each 1 / fps seconds.
std::vector<int64_t> ShotTimes(const CollectArguments& arguments, const Route& route) {
  if (arguments.fps == 0) return EvenTimes(route, arguments.frames > 0 ? arguments.frames : kDefaultFrames);
  const double start = arguments.start.value_or(0), left = route.duration() - start;
  char text[160];
  if (left < 0) {
    std::snprintf(text, sizeof text, "--start: %g s is after the end of the flight, which lasts %.6g s", start, route.duration());
    throw InputError(text);
  }
  const auto most = static_cast<int64_t>(std::floor(std::min(left * arguments.fps, 1e12) + 1e-9)) + 1;
  if (arguments.frames > most) {
    std::snprintf(text, sizeof text, "--frames: %lld are more than the %lld of the %.6g s of flight at --fps %g",
                  static_cast<long long>(arguments.frames), static_cast<long long>(most), left, arguments.fps);
    throw InputError(text);
  }
  const int64_t frames = arguments.frames > 0 ? arguments.frames : most;
  if (frames > kMaxFrames) {
    throw InputError("--fps: " + std::to_string(frames) + " frames are more than " + std::to_string(kMaxFrames) +
                     "; take the first of them with --frames");
  }
  std::vector<int64_t> times;
  for (int64_t i = 0; i < frames; ++i) times.push_back(std::llround((start + static_cast<double>(i) / arguments.fps) * 1e9));
  return times;
}

// What meta.json says of the frames of a route: nothing where they are so many, evenly.
std::string Rate(const CollectArguments& arguments) {
  if (arguments.fps == 0) return "";
  char text[96];
  std::snprintf(text, sizeof text, ", %.9g frames/s", arguments.fps);
  std::string rate = text;
  if (arguments.start) {
    std::snprintf(text, sizeof text, " from %.9g s", *arguments.start);
    rate += text;
  }
  return rate;
}

// The route and the moments of its frames.
struct Plan {
  std::shared_ptr<const Route> route;
  std::vector<int64_t> shot_times_ns;
};

// A route file: without --frames one frame at every waypoint, with it frames spread evenly.
Plan PlanFromFile(const CollectArguments& arguments, DatasetSpec& spec) {
  const std::vector<Waypoint> waypoints = ReadRouteFile(arguments.route);
  Plan plan{std::make_shared<const Route>(RouteThrough(waypoints, kFileRouteSpeed)), {}};
  const std::string hash = "sha256:" + Sha256HexOfFile(arguments.route);
  if (arguments.frames > 0 || arguments.fps > 0) {
    plan.shot_times_ns = ShotTimes(arguments, *plan.route);
    spec.route = "even along " + hash + Rate(arguments);
  } else {
    for (const RouteNode& node : plan.route->nodes()) plan.shot_times_ns.push_back(std::llround(node.t * 1e9));
    spec.route = "waypoints of " + hash;
  }
  return plan;
}

// A planned trajectory: frames spread evenly over it.
Plan PlanFromTrajectory(const CollectArguments& arguments, DatasetSpec& spec) {
  const PlannedPath path = ReadPlanFile(arguments.plan);
  Plan plan{std::make_shared<const Route>(Route::Along(path.trajectory, path.yaw)), {}};
  plan.shot_times_ns = ShotTimes(arguments, *plan.route);
  spec.route = "planned sha256:" + Sha256HexOfFile(arguments.plan) + Rate(arguments);
  return plan;
}

// A survey of a world with people: frames where the body hovers near them, as far as there are as many such places;
// nullopt if there are none.
std::optional<Plan> PlanNearPeople(const CollectArguments& arguments, const SimModel& model, const std::vector<Vec3d>& doors,
                                   DatasetSpec& spec) {
  PeopleSurveyOptions options{.seed = spec.seed, .passages = doors};
  const int64_t frames = arguments.frames > 0 ? arguments.frames : kDefaultFrames;
  if (arguments.fps == 0) options.viewpoints = static_cast<int>(std::min<int64_t>(frames, kMostPeopleStops));
  std::optional<PeopleSurvey> survey = PlanPeopleSurvey(model, options);
  if (!survey) return std::nullopt;
  Plan plan{std::make_shared<const Route>(std::move(survey->route)), {}};
  spec.route = "auto, near people" + Rate(arguments);
  if (arguments.fps == 0 && frames == static_cast<int64_t>(survey->stop_times_ns.size())) {
    plan.shot_times_ns = std::move(survey->stop_times_ns);
  } else {
    plan.shot_times_ns = ShotTimes(arguments, *plan.route);
  }
  return plan;
}

Plan MakePlan(const CollectArguments& arguments, const GlobalOptions& globals, const SimModel& model, DatasetSpec& spec) {
  if (!arguments.plan.empty()) return PlanFromTrajectory(arguments, spec);
  if (arguments.route != "auto") return PlanFromFile(arguments, spec);
  const auto building = RoomsOf(RequestOf(arguments.world, globals));
  const std::vector<Vec3d> doors = building ? building->OpenPassages() : std::vector<Vec3d>();
  if (std::optional<Plan> near_people = PlanNearPeople(arguments, model, doors, spec)) return *std::move(near_people);
  const SurveyOptions survey{.seed = spec.seed, .viewpoints = SurveyViewpoints(arguments.frames), .passages = doors};
  Plan plan{std::make_shared<const Route>(PlanSurvey(*model.tracer, survey)), {}};
  plan.shot_times_ns = ShotTimes(arguments, *plan.route);
  spec.route = "auto" + Rate(arguments);
  return plan;
}

// All shots and what lies between; fills spec.route and spec.frames.
Flight Fly(const CollectArguments& arguments, const GlobalOptions& globals, const SimModel& model, DatasetSpec& spec,
           std::string& trajectory_json) {
  Flight flight;
  if (!arguments.poses.empty()) {
    flight = VisitPoses(model, ReadPoseFile(arguments.poses));
    spec.route = "poses of sha256:" + Sha256HexOfFile(arguments.poses);
  } else {
    const Plan plan = MakePlan(arguments, globals, model, spec);
    flight = FlyRoute(model, plan.route, plan.shot_times_ns);
    if (const auto* path = plan.route->path()) {
      trajectory_json = TrajectoryJson({.trajectory = *path,
                                        .peaks = CertifiedPeaks(*path),
                                        .cost_snap = IntegralOfSquaredDerivative(*path, 4),
                                        .yaw = ReadPlanFile(arguments.plan).yaw.value_or(ConstantYaw{})});
    }
  }
  spec.frames = static_cast<int64_t>(flight.shots.size());
  if (spec.shards > spec.frames) {
    throw InputError("--shard: '" + arguments.shard + "': more shards than frames (" + std::to_string(spec.frames) + ")");
  }
  return flight;
}

// What can be wrong with where the frames are to be, before a world is loaded.
void CheckRoute(const CollectArguments& arguments) {
  if (arguments.route != "auto") ReadRouteFile(arguments.route);
  if (!arguments.plan.empty()) ReadPlanFile(arguments.plan);
  if (!arguments.poses.empty()) ReadPoseFile(arguments.poses);
  if (!arguments.plan.empty() && arguments.route != "auto") throw InputError("--plan: give either --plan or --route, not both");
  if (!arguments.poses.empty() && (arguments.route != "auto" || !arguments.plan.empty()))
    throw InputError("--poses: give one of --poses, --route and --plan");
  if (!arguments.poses.empty() && (arguments.frames > 0 || arguments.fps > 0))
    throw InputError("--poses: there is one frame at each pose; leave out --frames and --fps");
  if (arguments.start && arguments.fps == 0) throw InputError("--start: it is when the frames of --fps begin; add --fps");
}

// A dataset for each subset of a table.
void RunRecipe(const CollectArguments& arguments, const GlobalOptions& globals) {
  if (arguments.route != "auto" || !arguments.plan.empty() || !arguments.poses.empty() || !arguments.people.people.empty() ||
      arguments.traffic.count > 0)
    throw InputError("--recipe: it has routes and people of its own; leave out --route, --plan, --poses, --people and --traffic");
  if (arguments.processes.processes > 1 || !globals.gpus.empty() || arguments.fps > 0)
    throw InputError("--recipe: it takes no --fps, --processes or several GPUs; use --shard I/N in several runs");
  CollectArguments with_people = arguments;
  with_people.people.people = "1";
  CollectHumanSets({.recipe = arguments.recipe,
                    .world = arguments.world,
                    .out = arguments.out,
                    .subset = arguments.subset,
                    .frames = arguments.frames,
                    .spec = MakeSpec(with_people, globals),
                    .has_camera = arguments.camera.projection != "erp" || !arguments.camera.size.empty() || arguments.camera.fov_deg != 0,
                    .environment = arguments.environment,
                    .people = arguments.people},
                   globals);
}

void RunCollect(const CollectArguments& arguments, GlobalOptions& globals) {
  if (arguments.processes.is_worker()) BecomeWorker(arguments.processes, globals);
  const int processes = arguments.processes.is_worker() ? 1 : CountProcesses(arguments.processes, globals);
  if (!arguments.recipe.empty()) return RunRecipe(arguments, globals);
  if (arguments.world.empty()) throw InputError("--world is required");
  if (!arguments.subset.empty()) throw InputError("--subset: it is about --recipe; add --recipe omni360-human");
  // Everything that can be wrong with the flags is found before the world is loaded and anything is written.
  DatasetSpec spec = MakeSpec(arguments, globals);
  CheckRoute(arguments);
  Stage stage(StageOptionsOf(arguments.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                             arguments.traffic.Request(globals.seed)));
  spec.environment = DescribeEnvironment(stage.environment());
  const SimModel model = stage.Model(kRouteStepNs);
  std::string trajectory_json;
  const Flight flight = Fly(arguments, globals, model, spec, trajectory_json);
  if (!arguments.processes.is_worker()) {
    CheckCameraPlaces(*model.tracer, spec, flight);
    CheckFlowSteps(*model.tracer, spec, flight);
    if (flight.least_clearance < kTouching) LogWarning("the route touches or enters a surface of the world");
  }
  const CollectInput input = InputOf(stage, spec, flight, arguments.out, trajectory_json);
  if (arguments.processes.is_worker()) {
    return RunWorker([&](std::span<const int64_t> frames, const std::function<void(int64_t)>& done) {
      return CollectPart(input, stage.renderer(spec.tier), frames, done);
    });
  }
  const CollectResult result = processes == 1 ? Collect(input, stage.renderer(spec.tier)) : Collect(input, RenderInProcesses(processes));
  WriteExports(arguments, globals.json);
  ReportRun(stage, spec, result, arguments.out, globals.json);
}

}  // namespace

void AddCollectCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("collect", "collect a labelled dataset along a route; run again to finish an interrupted one");
  auto arguments = std::make_shared<CollectArguments>();
  command->add_option("--world", arguments->world,
                      "name (airsim360 worlds) or path of a .glb, .gltf, .obj, .city.json, .osm, .osm.pbf or world .yaml; "
                      "with --recipe only its subsets");
  command->add_option("--recipe", arguments->recipe,
                      "omni360-human, or a file like data/omni360_human.yaml: a dataset for each subset of its table");
  command->add_option("--subset", arguments->subset, "with --recipe: only this one, for example downtown_city/03");
  command->add_option("--out", arguments->out, "folder of the dataset")->required();
  command->add_option("--route", arguments->route,
                      "auto (a survey through free space; near people if there are any), or a file (CSV x,y,z[,yaw_deg][,t], YAML, GPX or "
                      "KML): without --frames one frame at each waypoint");
  command->add_option("--plan", arguments->plan, "fly a trajectory of `airsim360 plan` (its JSON or YAML), frames spread evenly over it");
  command->add_option("--poses", arguments->poses,
                      "one frame at each pose of a file: CSV x,y,z[,yaw_deg,pitch_deg,roll_deg] or qw,qx,qy,qz, TUM, or "
                      "frames.jsonl of another dataset (docs/guide/datasets.md)");
  command->add_option("--frames", arguments->frames, "frames, spread evenly over the flight (default 8); with --fps so many at that rate")
      ->check(CLI::Range(int64_t{1}, kMaxFrames));
  command->add_option("--fps", arguments->fps, "so many frames a second of the flight, as long as it lasts")
      ->check(CLI::Range(0.001, 1000.0));
  command->add_option("--start", arguments->start, "with --fps: the first frame, seconds after the flight's start")
      ->check(CLI::Range(0.0, 1e7));
  arguments->camera.AddTo(*command);
  arguments->picture.AddTo(*command);
  command->add_option(
      "--format", arguments->format,
      "native,coco (default native, which includes COCO panoptic and people.jsonl), video (video.mp4, 360 degrees; "
      "needs the program ffmpeg); of people also coco_keypoints,kitti,nuscenes,monoloco,crops,overlay; those of `dataset export` go "
      "to OUT_FORMAT beside it");
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->add_option("--shard", arguments->shard, "I/N: only the frames with index % N == I, I from 0 (default 0/1)");
  arguments->processes.AddTo(*command);
  command->callback([arguments, &globals] { RunCollect(*arguments, globals); });
}

}  // namespace airsim360

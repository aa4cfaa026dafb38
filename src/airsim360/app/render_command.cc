// airsim360 render: one capture as a dataset of one frame.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

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
#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/people_survey.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

constexpr double kLookDown = -20;  // degrees, of a narrow camera near people

struct RenderArguments {
  std::string world, pose, out;
  EnvironmentFlags environment;
  CameraArguments camera;
  PictureArguments picture;
  PeopleArguments people;
  TrafficArguments traffic;
  bool overlay = false;
};

// The scene's first viewpoint: facing east, or from outside the scene facing its middle.
PoseArgument ScenePose(const Scene& scene) {
  const Vec3f spawn = FirstViewpoint(scene);
  PoseArgument pose;
  pose.p = VecCast<double>(spawn);
  pose.yaw_deg = scene.spawn_yaw_deg;
  const Vec3d to_middle = VecCast<double>(scene.bounds.center() - spawn);
  if (!scene.bounds.empty() && !scene.bounds.Contains(spawn)) {
    pose.yaw_deg = std::atan2(to_middle.y, to_middle.x) * kRadian;
    pose.pitch_deg = std::atan2(to_middle.z, std::hypot(to_middle.x, to_middle.y)) * kRadian;
  }
  return pose;
}

// Where people are seen best, if there are any.
PoseArgument DefaultPose(const SimModel& model, const DatasetSpec& spec) {
  const std::optional<PeopleSurvey> survey = PlanPeopleSurvey(model, {.seed = spec.seed, .viewpoints = 1});
  if (!survey) return ScenePose(model.tracer->scene());
  const RoutePoint start = survey->route.At(0);
  PoseArgument pose{.p = start.p, .yaw_deg = start.yaw * kRadian};
  // People are below; a panorama sees them anyway, and its horizon stays level.
  if (!IsPanoramic(spec)) pose.pitch_deg = kLookDown;
  return pose;
}

void RunRender(const RenderArguments& arguments, const GlobalOptions& globals) {
  // Everything that can be wrong with the flags is found before the world is loaded.
  DatasetSpec spec = arguments.picture.Spec();
  arguments.camera.Apply(spec);
  PictureArguments::Check(spec);
  DescribeRun("render", arguments.world, globals, spec);
  spec.people = arguments.people.Describe();
  spec.traffic = arguments.traffic.Describe();
  spec.overlay = arguments.overlay;
  if (spec.overlay && (spec.people.empty() || spec.tier == Tier::kLabels))
    throw InputError("--overlay: draws the labels of people into the colours: it needs --people and a tier with colours");
  PoseArgument pose;
  if (!arguments.pose.empty()) pose = ParsePose(WithPlace("--pose", arguments.pose, RequestOf(arguments.world, globals)));

  Stage stage(StageOptionsOf(arguments.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                             arguments.traffic.Request(globals.seed)));
  spec.environment = DescribeEnvironment(stage.environment());
  const SimModel model = stage.Model(kRouteStepNs);
  if (arguments.pose.empty()) pose = DefaultPose(model, spec);
  spec.route = "pose " + ShortestText(pose.p.x) + "," + ShortestText(pose.p.y) + "," + ShortestText(pose.p.z) + "," +
               ShortestText(pose.yaw_deg) + "," + ShortestText(pose.pitch_deg) + "," + ShortestText(pose.roll_deg);
  Flight flight = Hover(BodyPose(pose.p, pose.yaw_deg * kDegree, pose.pitch_deg * kDegree, pose.roll_deg * kDegree));
  if (stage.people()) flight.shots[0].people = stage.people()->start;
  if (stage.traffic()) flight.shots[0].traffic = stage.traffic()->start;
  CheckCameraPlaces(*model.tracer, spec, flight);
  const CollectResult result = Collect(InputOf(stage, spec, flight, arguments.out), stage.renderer(spec.tier));
  ReportRun(stage, spec, result, arguments.out, globals.json);
}

}  // namespace

void AddRenderCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("render", "one capture with all labels, as a dataset of one frame");
  auto arguments = std::make_shared<RenderArguments>();
  command
      ->add_option("--world", arguments->world,
                   "name (airsim360 worlds) or path of a .glb, .gltf, .obj, .city.json, .osm, .osm.pbf or world .yaml")
      ->required();
  command->add_option("--out", arguments->out, "folder of the dataset")->required();
  command->add_option("--pose", arguments->pose,
                      "x,y,z[,yaw_deg[,pitch_deg[,roll_deg]]] in metres and degrees; in maps also 60.1708N,24.9375E for x,y (default: "
                      "the world's spawn, or near people)");
  arguments->camera.AddTo(*command);
  arguments->picture.AddTo(*command);
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  command->add_flag("--overlay", arguments->overlay, "overlay/000000.png: the picture with the labels of people drawn in");
  AddEnvironmentFlags(*command, arguments->environment);
  AddWorldFlags(*command, globals);
  command->callback([arguments, &globals] { RunRender(*arguments, globals); });
}

}  // namespace airsim360

// airsim360 collect: a dataset along a route.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "airsim360/app/arguments.h"
#include "airsim360/app/commands.h"
#include "airsim360/app/environment_flags.h"
#include "airsim360/app/picture_arguments.h"
#include "airsim360/app/session.h"
#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/sim/route_file.h"
#include "airsim360/sim/survey.h"

namespace airsim360 {
namespace {

constexpr int64_t kDefaultFrames = 8;
constexpr int64_t kMaxFrames = 1'000'000;
constexpr double kFileRouteSpeed = 3;  // m/s along route files without times
constexpr double kTouching = 0.05;     // metres: a route closer to a surface is worth a warning

struct CollectArguments {
  std::string world, route = "auto", size = "2048x1024", tier = "fast", format = "native", rgb_format = "png";
  std::string pano_frame = "body", shard = "0/1", out, products;
  int64_t frames = 0;  // 0: not given
  int samples = 0;
  bool normal = false, no_denoise = false;
  EnvironmentFlags environment;
  PictureArguments picture;
};

// "I/N", 0 <= I < N.
void ParseShard(const std::string& text, DatasetSpec& spec) {
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, spec.shard);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, spec.shards);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (!good || spec.shard < 0 || spec.shards < 1 || spec.shard >= spec.shards) {
    throw InputError("--shard: '" + text + "' is not I/N with I from 0 to N - 1, for example 0/4");
  }
}

// A choice among two or more words.
size_t ParseChoice(const char* flag, const std::string& value, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found == choices.end())
    throw InputError(std::string(flag) + ": " + UnknownChoiceMessage("value", value, choices));
  return static_cast<size_t>(found - choices.begin());
}

DatasetSpec MakeSpec(const CollectArguments& arguments, uint64_t seed) {
  DatasetSpec spec;
  spec.command = "collect";
  spec.world = arguments.world;
  spec.seed = seed;
  const ImageSize size = ParseSize(arguments.size);
  CheckPanoramaSize(size);
  spec.width = size.width;
  spec.height = size.height;
  spec.tier = ParseTierArgument(arguments.tier);
  spec.samples = CheckSamples(spec.tier, arguments.samples);
  spec.denoise = !arguments.no_denoise;
  spec.normal = arguments.normal;
  arguments.picture.Apply(spec);
  if (!arguments.products.empty()) ParseProducts(arguments.products, spec);
  ParseList("--format", arguments.format,
            {"native", "coco"});  // the native layout holds panoptic.json in any case
  spec.rgb_format = ParseChoice("--rgb-format", arguments.rgb_format, {"png", "jpg"}) == 1 ? RgbFormat::kJpeg
                                                                                           : RgbFormat::kPng;
  spec.pano_frame = ParseChoice("--pano-frame", arguments.pano_frame, {"body", "level"}) == 1
                        ? PanoFrame::kLevel
                        : PanoFrame::kBody;
  ParseShard(arguments.shard, spec);
  return spec;
}

// The route and the moments of its frames; fills spec.route and spec.frames.
struct Plan {
  std::shared_ptr<const Route> route;
  std::vector<int64_t> shot_times_ns;
};

// A route file: without --frames one frame at every waypoint, with it frames spread evenly.
Plan PlanFromFile(const CollectArguments& arguments, DatasetSpec& spec) {
  const std::vector<Waypoint> waypoints = ReadRouteCsv(arguments.route);
  Plan plan{std::make_shared<const Route>(RouteThrough(waypoints, kFileRouteSpeed)), {}};
  const std::string hash = "sha256:" + Sha256HexOfFile(arguments.route);
  if (arguments.frames > 0) {
    plan.shot_times_ns = EvenTimes(*plan.route, arguments.frames);
    spec.route = "even along " + hash;
  } else {
    for (const RouteNode& node : plan.route->nodes())
      plan.shot_times_ns.push_back(std::llround(node.t * 1e9));
    spec.route = "waypoints of " + hash;
  }
  return plan;
}

Plan MakePlan(const CollectArguments& arguments, const RayTracer& tracer, DatasetSpec& spec) {
  Plan plan;
  if (arguments.route == "auto") {
    plan.route = std::make_shared<const Route>(PlanSurvey(tracer, {.seed = spec.seed}));
    plan.shot_times_ns = EvenTimes(*plan.route, arguments.frames > 0 ? arguments.frames : kDefaultFrames);
    spec.route = "auto";
  } else {
    plan = PlanFromFile(arguments, spec);
  }
  spec.frames = static_cast<int64_t>(plan.shot_times_ns.size());
  if (spec.shards > spec.frames) {
    throw InputError("--shard: '" + arguments.shard + "': more shards than frames (" +
                     std::to_string(spec.frames) + ")");
  }
  return plan;
}

void RunCollect(const CollectArguments& arguments, const GlobalOptions& globals) {
  // Everything that can be wrong with the flags is found before the world is loaded and anything is written.
  DatasetSpec spec = MakeSpec(arguments, globals.seed);
  if (arguments.route != "auto") ReadRouteCsv(arguments.route);
  const OpenedWorld world = OpenWorld(arguments.world, globals.seed, spec.tier, arguments.environment);
  spec.environment = DescribeEnvironment(world.environment);
  const Plan plan = MakePlan(arguments, *world.tracer, spec);
  const Flight flight = FlyRoute({.tracer = world.tracer, .dt_ns = kRouteStepNs}, plan.route, plan.shot_times_ns);
  if (flight.least_clearance < kTouching) LogWarning("the route touches or enters a surface of the world");
  const CollectResult result = Collect({spec, *world.scene, flight, arguments.out}, *world.renderer);
  ReportRun(world, spec, result, arguments.out, globals.json);
}

}  // namespace

void AddCollectCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand(
      "collect", "collect a labelled dataset along a route; run again to finish an interrupted one");
  auto arguments = std::make_shared<CollectArguments>();
  command
      ->add_option("--world", arguments->world,
                   "name (airsim360 worlds) or path of a .glb, .gltf, .obj or world .yaml")
      ->required();
  command->add_option("--out", arguments->out, "folder of the dataset")->required();
  command->add_option("--route", arguments->route,
                      "auto (a survey through free space), or a CSV file x,y,z[,yaw_deg][,t]: without "
                      "--frames one frame at each row");
  command->add_option("--frames", arguments->frames, "frames, spread evenly over the flight (default 8)")
      ->check(CLI::Range(int64_t{1}, kMaxFrames));
  command->add_option("--size", arguments->size, "WxH of the panorama, W = 2 H (default 2048x1024)");
  command->add_option("--tier", arguments->tier, "labels, fast, high or reference (default fast)");
  command->add_option("--samples", arguments->samples,
                      "high: ambient rays of a pixel at the equator (4); reference: paths of a pixel (64)");
  command->add_flag("--no-denoise", arguments->no_denoise, "tier high: leave the noise in");
  command->add_option("--format", arguments->format,
                      "native,coco (default native, which includes COCO panoptic)");
  command->add_option("--rgb-format", arguments->rgb_format, "png or jpg (default png)");
  command->add_option("--pano-frame", arguments->pano_frame,
                      "body or level: turn with the body or only with its heading");
  AddEnvironmentFlags(*command, arguments->environment);
  arguments->picture.AddTo(*command);
  command->add_option("--products", arguments->products,
                      "beside rgb,range,semantic,entity: normal,position,albedo,material,sky,flow,coverage");
  command->add_flag("--normal", arguments->normal, "the same as --products normal");
  command->add_option("--shard", arguments->shard,
                      "I/N: only the frames with index % N == I, I from 0 (default 0/1)");
  command->callback([arguments, &globals] { RunCollect(*arguments, globals); });
}

}  // namespace airsim360

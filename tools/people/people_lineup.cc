// A line-up of people on a plain: what bodies and motions look like.
//   build/bin/people_lineup OUT.png [--rest] [--seed N] [--count N] [--level N] [--turn DEGREES] [--width N]
//                           [--zoom TIMES] [--aim METRES] [--high]    (--aim: the height in the picture's middle)
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/people/body/skinning.h"
#include "airsim360/people/body/test_bodies.h"
#include "airsim360/people/motion/pose.h"
#include "airsim360/render/renderer.h"

using namespace airsim360;

namespace {

struct Options {
  std::string out = "lineup.png";
  bool rest = false, high = false;
  int seed = 1, count = 8, level = 0, width = 1024, first = 0;
  double turn = 0, time = 3.0, zoom = 1, aim = 0.95;
};

Options Parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const auto value = [&] { return i + 1 < argc ? std::atof(argv[++i]) : 0; };
    if (a == "--rest") o.rest = true;
    else if (a == "--high") o.high = true;
    else if (a == "--seed") o.seed = static_cast<int>(value());
    else if (a == "--count") o.count = static_cast<int>(value());
    else if (a == "--first") o.first = static_cast<int>(value());
    else if (a == "--level") o.level = static_cast<int>(value());
    else if (a == "--turn") o.turn = value();
    else if (a == "--time") o.time = value();
    else if (a == "--zoom") o.zoom = value();
    else if (a == "--aim") o.aim = value();
    else if (a == "--width") o.width = static_cast<int>(value());
    else o.out = a;
  }
  return o;
}

std::shared_ptr<const Scene> Plain() {
  SceneBuilder builder("plain");
  const MaterialId paving = builder.AddMaterial({.name = "paving", .base_color = {0.32f, 0.31f, 0.29f}});
  const EntityId ground = builder.AddEntity("ground", builder.tree().At("ground/pavement"));
  Mesh mesh;
  mesh.positions = {{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 2, paving, kNoEntity}};
  builder.AddInstance({builder.AddMesh(std::move(mesh)), {}, ground});
  builder.AddSky();
  return builder.Build();
}

// What the person at this place of the line does.
PersonState Doing(int i) {
  constexpr Behaviour kLower[] = {Behaviour::kWalk, Behaviour::kJog, Behaviour::kRun, Behaviour::kIdle, Behaviour::kIdle, Behaviour::kIdle, Behaviour::kWalk, Behaviour::kIdle,
                                  Behaviour::kIdle, Behaviour::kSit, Behaviour::kWalk, Behaviour::kWalk, Behaviour::kCrouch, Behaviour::kStretch, Behaviour::kIdle, Behaviour::kWait, Behaviour::kIdle, Behaviour::kIdle, Behaviour::kWalk};
  constexpr Behaviour kUpper[] = {Behaviour::kWalk, Behaviour::kJog, Behaviour::kRun, Behaviour::kIdle, Behaviour::kTalk, Behaviour::kPhoneCall, Behaviour::kTexting, Behaviour::kTakePhoto,
                                  Behaviour::kWave, Behaviour::kSit, Behaviour::kCarry, Behaviour::kPushStroller, Behaviour::kCrouch, Behaviour::kStretch, Behaviour::kPoint, Behaviour::kWait, Behaviour::kLookUp, Behaviour::kListen, Behaviour::kUmbrella};
  PersonState s;
  const size_t k = static_cast<size_t>(i) % std::size(kLower);
  s.lower = kLower[k];
  s.upper = kUpper[k];
  s.speaking = s.upper == Behaviour::kTalk;
  return s;
}

double SpeedOf(Behaviour b) {
  return b == Behaviour::kWalk ? 1.3 : b == Behaviour::kJog ? 2.6 : b == Behaviour::kRun ? 4.0 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = Parse(argc, argv);
  std::vector<PersonInScene> people;
  for (int i = 0; i < o.count; ++i) {
    const BodySpec spec = internal::DrawBodySpec(static_cast<uint64_t>(o.seed), static_cast<uint64_t>(i + o.first), 0.15);
    people.push_back({"person/" + std::to_string(i), MakeBody(spec), o.level});
    const Body& b = *people.back().body;
    const Mesh& mesh = b.levels[static_cast<size_t>(o.level)].mesh;
    std::printf("%d: %s %.0f y %.2f m, %s, %s: %zu triangles\n", i, spec.sex == Sex::kMale ? "male" : "female", spec.age, spec.stature, b.character.c_str(), b.outfit.c_str(), mesh.triangles.size());
  }
  std::vector<PersonRef> refs;
  const auto scene = AddPeople(Plain(), people, refs);

  // Everybody faces -Y, turned; walkers come from behind so that they are in the line at the end.
  const double spacing = 1.15, yaw = (-90 + o.turn) * 0.017453292519943295;
  std::vector<SkeletonPose> poses(people.size());
  std::vector<const SkeletonPose*> shown;
  for (int i = 0; i < o.count; ++i) {
    const Body& body = *people[static_cast<size_t>(i)].body;
    PersonState s = Doing(i + o.first);
    const double speed = o.rest ? 0 : SpeedOf(s.lower);
    const Vec3d forward{std::cos(yaw), std::sin(yaw), 0}, place{(i - 0.5 * (o.count - 1)) * spacing, 0, 0};
    s.yaw = yaw;
    s.v_WP = forward * speed;
    s.p_WP = place - s.v_WP * o.time;
    if (o.rest) {
      poses[static_cast<size_t>(i)] = RestPose(body, {RotationZ(yaw), s.p_WP});
    } else {
      s.has_gaze = s.upper == Behaviour::kLookUp || s.upper == Behaviour::kPoint;
      s.p_W_gaze = place + forward * 6 + Vec3d{0, 0, 5};
      MotionState motion = StartMotion(body, s, static_cast<uint64_t>(i), 0);
      const int64_t dt = 50'000'000;
      for (int64_t t = dt; t <= static_cast<int64_t>(o.time * 1e9); t += dt) {
        s.p_WP += s.v_WP * 0.05;
        StepMotion(body, s, t, nullptr, motion);
      }
      poses[static_cast<size_t>(i)] = PoseOf(body, motion, s);
    }
    shown.push_back(&poses[static_cast<size_t>(i)]);
  }
  auto state = std::make_shared<SceneState>();
  AppendPeople(people, refs, shown, {}, *state);

  // The camera stands before the line.
  const Tier tier = o.high ? Tier::kHigh : Tier::kFast;
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(scene), {.tier = tier});
  const int height = static_cast<int>(o.width / (0.56 * o.count) > o.width ? o.width : o.width / (0.56 * o.count));
  const double distance = 14, f = o.zoom * o.width * distance / (spacing * (o.count + 0.3));
  RenderRequest request;
  request.camera = Pinhole{o.width, height, f, f, 0.5 * o.width, 0.5 * height + 0.0};
  request.X_WC = BodyPose({0, -distance, 1.35}, 1.5707963, std::atan2(o.aim - 1.35, distance), 0) * CameraInBody();
  request.state = state;
  request.tier = tier;
  Frame frame;
  renderer->Render(request, frame);
  WriteFileAtomically(o.out, EncodePng(frame.rgb));
}

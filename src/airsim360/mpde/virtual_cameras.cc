#include "airsim360/mpde/virtual_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr int kTries = 32;
constexpr double kClosestInView = 0.3;  // metres ahead of the camera

struct NamedDraw {
  const char* name;
  ViewDraw draw;
};

// Heights, fields of view and focal lengths of the rigs of the same names: KITTI 1242 x 375 at 721 px, nuScenes 1600 x 900 at 1266 px,
// FreeMan's telephones 1920 x 1080 around a stage, and ours in the air.
std::vector<NamedDraw> Draws() {
  return {
      {"kitti", {.lowest = 1.4, .highest = 1.8, .half_height_deg = 14.6, .slope = 0.012, .noise = 0.02}},
      {"nuscenes", {.lowest = 1.45, .highest = 1.7, .nearest = 4, .bearing_deg = 32, .half_height_deg = 19.5, .focal_px = 1266}},
      {"freeman",
       {.lowest = 0.8,
        .highest = 1.7,
        .nearest = 2.5,
        .farthest = 7,
        .bearing_deg = 25,
        .pitch_spread_deg = 4,
        .half_height_deg = 20,
        .slope = 0,
        .noise = 0.008,
        .focal_px = 1480}},
      {"drone0", {.lowest = 1.6, .highest = 8, .nearest = 3, .farthest = 35, .bearing_deg = 40, .half_height_deg = 30, .focal_px = 935}},
      {"drone20",
       {.lowest = 1.6,
        .highest = 8,
        .nearest = 3,
        .farthest = 35,
        .bearing_deg = 40,
        .pitch_deg = 20,
        .half_height_deg = 30,
        .focal_px = 935}}};
}

// Moves two points apart, or together, around their middle.
void Widen(Vec3d& a, Vec3d& b, double factor) {
  const Vec3d middle = (a + b) * 0.5;
  a = middle + (a - middle) * factor;
  b = middle + (b - middle) * factor;
}

// A point right, below and ahead of a camera that looks `pitch` below the horizon; `level` is ahead, left, up of it.
Vec3d ToCamera(Vec3d level, double pitch) {
  const double s = std::sin(pitch), c = std::cos(pitch);
  return {-level.y, -level.x * s - level.z * c, level.x * c - level.z * s};
}

}  // namespace

void ViewDraw::Visit(ConfigVisitor& v) {
  v.Field("lowest", "metres of virtual cameras above the ground", lowest, 0.1, 200);
  v.Field("highest", "metres of virtual cameras above the ground", highest, 0.1, 200);
  v.Field("nearest", "metres along the ground", nearest, 0.5, 500);
  v.Field("farthest", "metres along the ground", farthest, 0.5, 500);
  v.Field("bearing_deg", "people are up to so far to either side", bearing_deg, 0, 80);
  v.Field("pitch_deg", "of virtual cameras, below the horizon", pitch_deg, -80, 80);
  v.Field("pitch_spread_deg", "standard deviation of the pitch", pitch_spread_deg, 0, 45);
  v.Field("half_height_deg", "half the height of the picture", half_height_deg, 5, 80);
  v.Field("slope", "standard deviation of the ground's slope", slope, 0, 1);
  v.Field("stature", "standard deviation of the logarithm of a factor of people's sizes", stature, 0, 0.5);
  v.Field("noise", "standard deviation of keypoints, share of the person's height", noise, 0, 0.5);
  v.Field("noise_px", "standard deviation of keypoints on top, pixels", noise_px, 0, 100);
  v.Field("focal_px", "of the cameras, for noise_px", focal_px, 10, 100000);
  v.Field("blunder", "share of keypoints that are found badly", blunder, 0, 1);
  v.Field("blunder_size", "so many times the noise", blunder_size, 1, 100);
  v.Field("convention", "keypoints at the joints, or where annotators of COCO put them", convention, kKeypointConventionNames);
}

std::vector<std::string> ViewNames() {
  std::vector<std::string> names;
  for (const NamedDraw& named : Draws()) names.emplace_back(named.name);
  return names;
}

ViewDraw NamedViews(std::string_view name) {
  for (const NamedDraw& named : Draws()) {
    if (name == named.name) return named.draw;
  }
  throw InputError(UnknownChoiceMessage("views", name, ViewNames()));
}

PersonShape AsAnnotated(PersonShape shape) {
  // Each length times real people's over ours (medians, apparent metres); outer points first move with what they hang on.
  constexpr double kTrunk = 1.023, kThigh = 0.952, kShin = 0.937, kUpperArm = 0.850, kForearm = 0.919, kShoulders = 1.029, kHips = 1.382,
                   kEars = 1.374;
  auto& k = shape.keypoints;
  const auto was = k;
  const Vec3d hips = (was[11] + was[12]) * 0.5, shoulders = (was[5] + was[6]) * 0.5;
  const Vec3d lift = (shoulders - hips) * (kTrunk - 1);
  for (size_t i = 0; i <= 6; ++i) k[i] = was[i] + lift;
  Widen(k[3], k[4], kEars);
  Widen(k[5], k[6], kShoulders);
  Widen(k[11], k[12], kHips);
  for (size_t side = 0; side < 2; ++side) {
    k[7 + side] = k[5 + side] + (was[7 + side] - was[5 + side]) * kUpperArm;
    k[9 + side] = k[7 + side] + (was[9 + side] - was[7 + side]) * kForearm;
    k[13 + side] = k[11 + side] + (was[13 + side] - was[11 + side]) * kThigh;
    k[15 + side] = k[13 + side] + (was[15 + side] - was[13 + side]) * kShin;
  }
  return shape;
}

void AddKeypointNoise(const ViewDraw& draw, RngStream& random, KeypointRays& rays) {
  float top = rays[1], bottom = rays[1];
  for (size_t i = 1; i < rays.size(); i += 2) top = std::min(top, rays[i]), bottom = std::max(bottom, rays[i]);
  const double deviation = std::hypot(draw.noise * (bottom - top), draw.noise_px / draw.focal_px);
  for (size_t i = 0; i < rays.size(); i += 2) {
    const double own = draw.blunder > 0 && random.Chance(draw.blunder) ? deviation * draw.blunder_size : deviation;
    rays[i] += static_cast<float>(own * random.Normal());
    rays[i + 1] += static_cast<float>(own * random.Normal());
  }
}

MpdeSample DrawView(const PersonShape& shape, const ViewDraw& draw, RngStream& random) {
  MpdeSample sample;
  sample.person = shape.person;
  const double limit = std::tan(draw.half_height_deg * kDegree);
  for (int i = 0; i < kTries; ++i) {
    const double distance = draw.nearest * std::pow(draw.farthest / draw.nearest, random.Uniform());
    const double bearing = draw.bearing_deg * kDegree * random.Uniform(-1, 1), turn = random.Uniform(-std::numbers::pi, std::numbers::pi);
    const double height = random.Uniform(draw.lowest, draw.highest);
    const double pitch = (draw.pitch_deg + draw.pitch_spread_deg * random.Normal()) * kDegree;
    const Vec3d feet{distance * std::cos(bearing), distance * std::sin(bearing), draw.slope * distance * random.Normal() - height};
    const double size = draw.stature > 0 ? std::exp(draw.stature * random.Normal()) : 1;
    const double c = size * std::cos(turn), s = size * std::sin(turn);
    const auto see = [&](Vec3d p) { return ToCamera(feet + Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, size * p.z}, pitch); };
    bool inside = true;
    for (size_t k = 0; k < shape.keypoints.size(); ++k) {
      const Vec3d p = see(shape.keypoints[k]);
      const double z = std::max(p.z, kClosestInView);
      sample.rays[2 * k] = static_cast<float>(p.x / z), sample.rays[2 * k + 1] = static_cast<float>(p.y / z);
      inside = inside && p.z > kClosestInView && std::abs(p.y / z) <= limit;
    }
    const Vec3d center = see(shape.center), ahead = ToCamera({std::cos(shape.yaw + turn), std::sin(shape.yaw + turn), 0}, pitch);
    sample.truth = {Norm(center), WrapAngle(std::atan2(-ahead.z, ahead.x) - std::atan2(center.x, center.z))};
    if (inside) break;
  }
  AddKeypointNoise(draw, random, sample.rays);
  return sample;
}

}  // namespace airsim360

#include "airsim360/vln/language/lookout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

constexpr int kDraws = 400, kOpenDraws = 300;         // places tried; of these only such below the open sky
constexpr double kRoom = 0.6;                         // metres free around a place
constexpr double kFlightShort = 6, kFlightLong = 24;  // metres ahead
constexpr size_t kLeastWords = 2;                     // words with something clearly in sight
constexpr double kRight = std::numbers::pi / 180;

double Milli(double value) { return std::round(value * 1000) / 1000; }

// Between a man's eyes and the eaves, mostly low.
double HeightOf(bool indoors, RngStream& random) {
  if (indoors) return random.Uniform(1.0, 2.0);
  return random.Chance(0.7) ? random.Uniform(1.6, 5) : random.Uniform(5, 14);
}

std::optional<Viewpoint> DrawPlace(const VlnGround& ground, RngStream& random, bool open) {
  const Box3d& box = ground.inhabited();
  const bool indoors = ground.rooms();
  const double x = random.Uniform(box.min.x, box.max.x), y = random.Uniform(box.min.y, box.max.y), height = HeightOf(indoors, random);
  const double yaw = Milli(random.Uniform(-180, 180)) * kRight;
  std::optional<GroundHit> floor = ground.At(x, y);
  if (!floor) return std::nullopt;
  if (open && !indoors) {
    const bool surface = ground.Is(floor->entity, "ground") || ground.Is(floor->entity, "nature") || ground.Is(floor->entity, "object");
    if (!surface) return std::nullopt;
  } else if (!indoors || ground.scene().sky_entity != kNoEntity || floor->z > box.max.z - 1) {
    floor = ground.Below({x, y, random.Uniform(box.min.z, box.max.z)});
    if (!floor) return std::nullopt;
  }
  const Vec3d p{Milli(x), Milli(y), Milli(floor->z + height)};
  if (!ground.IsFree(p, kRoom)) return std::nullopt;
  return Viewpoint{p, yaw};
}

Vec3d Ahead(const Viewpoint& from, double metres) {
  const Vec3d p = from.p_W + Vec3d{std::cos(from.yaw), std::sin(from.yaw), 0} * metres;
  return {Milli(p.x), Milli(p.y), Milli(p.z)};
}

// As far ahead as is free, if that is far enough to pass things.
std::optional<Viewpoint> FlyAhead(const VlnGround& ground, const Viewpoint& from, RngStream& random) {
  const bool indoors = ground.rooms();
  const double shortest = indoors ? 2 : kFlightShort, length = indoors ? random.Uniform(2, 5) : random.Uniform(kFlightShort, kFlightLong);
  double free = 0;
  for (double d = 0; d <= length; d += kRoom)
    if (ground.IsFree(Ahead(from, d), kRoom))
      free = d;
    else
      break;
  if (free < shortest) return std::nullopt;
  return Viewpoint{Ahead(from, free), from.yaw};
}

Glance Shoot(const Picture& picture, Renderer& renderer, Frame& frame, const SurfacePoints& surfaces, bool keep_pixels) {
  renderer.Render(
      MakeRequest(picture.camera(), picture.X_WC(), Tier::kLabels, {.rgb = false, .range = true, .semantic = false, .entity = true}),
      frame);
  Glance glance{picture, Look(picture, frame, &surfaces)};
  if (keep_pixels) glance.pixels = frame.entity;
  return glance;
}

bool ShowsEnough(const Lexicon& lexicon, const std::vector<Seen>& seen) {
  const auto groups = Group(lexicon, seen);
  return static_cast<size_t>(std::ranges::count_if(groups, [](const Sighted& s) { return !s.clear.empty(); })) >=
         std::min(kLeastWords, lexicon.in_use());
}

}  // namespace

std::optional<Lookout> DrawLookout(const VlnGround& ground, const Lexicon& lexicon, const SurfacePoints& surfaces, Renderer& renderer,
                                   uint64_t number, const LookoutOptions& options) {
  RngStream random(options.seed, "language lookout", number);
  Frame frame;
  int looks = 0;
  for (int draw = 0; draw < kDraws && looks < 4; ++draw) {
    const auto place = DrawPlace(ground, random, draw < kOpenDraws);
    if (!place) continue;
    ++looks;
    const Picture panorama{true, 0, *place, options.width, options.width / 2};
    Glance around = Shoot(panorama, renderer, frame, surfaces, options.masks);
    if (!ShowsEnough(lexicon, around.seen)) continue;
    // Each camera looks at something that is clearly seen.
    std::vector<double> clear;
    for (const Sighted& s : Group(lexicon, around.seen))
      for (const Seen* seen : s.clear) clear.push_back(seen->azimuth_deg);
    Lookout lookout{number, {std::move(around)}, {}};
    for (int i = 0; i < options.cameras; ++i) {
      const double towards = clear[random.Index(static_cast<uint32_t>(clear.size()))] + random.Uniform(-25, 25);
      lookout.glances.push_back(Shoot({false, Milli(std::remainder(towards, 360)), *place, options.width / 2, options.width / 2}, renderer,
                                      frame, surfaces, options.masks));
    }
    const auto then = options.later ? FlyAhead(ground, *place, random) : std::nullopt;
    if (then) lookout.later = Shoot({true, 0, *then, options.width, options.width / 2}, renderer, frame, surfaces, false);
    return lookout;
  }
  return std::nullopt;
}

}  // namespace airsim360::internal

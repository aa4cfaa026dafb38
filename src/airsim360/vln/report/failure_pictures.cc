#include "airsim360/vln/report/failure_pictures.h"

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/transform.h"

namespace airsim360 {
namespace {

constexpr int kQuality = 80;

// Of the last move that was one, else of the start.
double HeadingAtEnd(const VlnResult& r, const LanguageEpisode& episode) {
  for (size_t i = r.pred.size(); i-- > 1;) {
    const Vec3d move = r.pred[i] - r.pred[i - 1];
    if (std::hypot(move.x, move.y) > 0.2) return std::atan2(move.y, move.x);
  }
  return episode.start.yaw;
}

// A ring of red around a direction, with a dark rim.
void Ring(Image<Rgb8>& image, double azimuth, double elevation, double radius) {
  const double x0 = (azimuth / (2 * kPi) + 0.5) * image.width(), y0 = (0.5 - elevation / kPi) * image.height();
  for (int dy = -static_cast<int>(radius) - 2; dy <= radius + 2; ++dy) {
    for (int dx = -static_cast<int>(radius) - 2; dx <= radius + 2; ++dx) {
      const double off = std::abs(std::hypot(dx, dy) - radius);
      const int x = (static_cast<int>(x0) + dx + image.width()) % image.width(), y = static_cast<int>(y0) + dy;
      if (off > 2.2 || y < 0 || y >= image.height()) continue;
      image(x, y) = off <= 1.2 ? Rgb8{255, 40, 40} : Rgb8{20, 0, 0};
    }
  }
}

std::string Draw(Renderer& renderer, const VlnResult& r, const LanguageEpisode& episode, const FailurePictureOptions& options,
                 const std::shared_ptr<const SceneState>& moved) {
  const double yaw = HeadingAtEnd(r, episode);
  const Vec3d from = r.pred.back(), to = episode.goal - from;
  RenderRequest request;
  static_cast<RenderSettings&>(request) = options.picture;
  request.camera = Equirectangular{options.width, options.width / 2};
  request.X_WC = BodyPose(from, yaw, 0, 0) * CameraInBody();
  request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
  request.state = moved;
  Frame frame;
  renderer.Render(request, frame);
  Ring(frame.rgb, std::remainder(yaw - std::atan2(to.y, to.x), 2 * kPi), std::atan2(to.z, std::hypot(to.x, to.y)), options.width / 60.0);
  const Bytes jpeg = EncodeJpeg(frame.rgb, kQuality);
  return std::string(AsText(jpeg));
}

}  // namespace

FailurePictures DrawFailures(const std::vector<VlnRun>& runs, const std::vector<LanguageEpisode>& episodes,
                             const FailurePictureOptions& options) {
  if (options.width < 64 || options.width > 4096 || options.width % 2 != 0)
    throw InputError("--width: " + std::to_string(options.width) + " is no even number in 64 … 4096");
  CheckRenderSettings(options.picture, "--");
  if (options.picture.tier == Tier::kLabels) throw InputError("--tier: labels has no pictures; choices: fast, high, reference");
  std::map<std::string, const LanguageEpisode*> by_id;
  for (const LanguageEpisode& e : episodes) by_id[e.id] = &e;
  // One world at a time.
  struct Wanted {
    const VlnRun* run;
    const VlnResult* result;
    const LanguageEpisode* episode;
  };
  std::map<std::tuple<std::string, uint64_t, int64_t, std::string>, std::vector<Wanted>> by_world;
  int64_t total = 0, done = 0;
  for (const VlnRun& run : runs) {
    size_t taken = 0;
    for (const VlnResult& r : run.results) {
      const auto found = by_id.find(r.id);
      if (r.success || found == by_id.end() || taken == options.most) continue;
      const LanguageEpisode& e = *found->second;
      by_world[{e.world, e.world_seed, e.people, e.weather}].push_back({&run, &r, &e});
      ++taken, ++total;
    }
  }
  ProgressBar bar("vln report", total);
  FailurePictures pictures;
  for (const auto& [world, wanted] : by_world) {
    const auto& [name, seed, people, weather] = world;
    const auto stage = options.open(name, seed, people);
    const auto renderer = weather.empty()
                              ? stage->NewRenderer(options.picture.tier)
                              : stage->NewRenderer(options.picture.tier, ApplyFlags({.weather = weather}, stage->environment()));
    for (const Wanted& w : wanted) {
      pictures[{w.run->name, w.result->id}] = Draw(*renderer, *w.result, *w.episode, options, stage->StartState());
      bar.Update(++done);
    }
  }
  return pictures;
}

}  // namespace airsim360

#include "airsim360/vln/language/lookout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

constexpr int kDraws = 400, kOpenDraws = 300;         // places tried; of these only such below the open sky
constexpr double kRoom = 0.6;                         // metres free around a place
constexpr double kFlightShort = 6, kFlightLong = 24;  // metres ahead
constexpr size_t kLeastWords = 2;                     // words with something clearly in sight
constexpr size_t kPreviews = 6, kLooks = 2;           // places that are looked at coarsely; the best of them, looked at in full
constexpr int kPreviewWidth = 128;                    // pixels of a coarse panorama
constexpr int kAims = 3;                              // directions drawn for a camera
constexpr double kHalfView = 40;                      // degrees to either side that a camera surely shows
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

Glance Shoot(const Picture& picture, Renderer& renderer, Frame& frame, const SurfacePoints* surfaces, bool keep_pixels) {
  renderer.Render(
      MakeRequest(picture.camera(), picture.X_WC(), Tier::kLabels, {.rgb = false, .range = true, .semantic = false, .entity = true}),
      frame);
  Glance glance{picture, Look(picture, frame, surfaces)};
  if (keep_pixels) glance.pixels = frame.entity;
  return glance;
}

size_t WordsInSight(const Lexicon& lexicon, const std::vector<Seen>& seen) {
  const auto groups = Group(lexicon, seen);
  return static_cast<size_t>(std::ranges::count_if(groups, [](const Sighted& s) { return !s.clear.empty(); }));
}

// A place as a coarse panorama shows it.
struct Prospect {
  Viewpoint place;
  size_t words = 0;            // with something clearly in sight
  std::vector<double> passed;  // azimuths, degrees, of near things that are the only ones of their word: worth flying past
};

// From few rays, and whether things are half hidden or not.
Prospect Foresee(const Viewpoint& place, int width, const Lexicon& lexicon, Renderer& renderer, Frame& frame) {
  Glance coarse = Shoot({true, 0, place, kPreviewWidth, kPreviewWidth / 2}, renderer, frame, nullptr, false);
  const double scale = static_cast<double>(width) / kPreviewWidth;
  for (Seen& seen : coarse.seen) seen.pixels = std::llround(static_cast<double>(seen.pixels) * scale * scale);
  Prospect prospect{place, WordsInSight(lexicon, coarse.seen), {}};
  for (const Sighted& s : Group(lexicon, coarse.seen))
    if (s.only() != nullptr && s.only()->nearest < kFlightLong) prospect.passed.push_back(s.only()->azimuth_deg);
  return prospect;
}

// Free places, those with the most words first.
std::vector<Prospect> BestPlaces(const VlnGround& ground, const Lexicon& lexicon, Renderer& renderer, RngStream& random, int width) {
  Frame frame;
  std::vector<Prospect> found;
  for (int draw = 0; draw < kDraws && found.size() < kPreviews; ++draw)
    if (const auto place = DrawPlace(ground, random, draw < kOpenDraws)) found.push_back(Foresee(*place, width, lexicon, renderer, frame));
  std::ranges::stable_sort(found, std::greater{}, &Prospect::words);
  found.resize(std::min(found.size(), kLooks));
  return found;
}

// Turned so that what lies ahead is flown past, on one side or the other.
Viewpoint TurnedToPass(const Prospect& prospect, RngStream& random) {
  const double aside = random.Uniform(12, 55) * (random.Chance(0.5) ? 1 : -1);
  const double azimuth = prospect.passed[random.Index(static_cast<uint32_t>(prospect.passed.size()))] + aside;
  return {prospect.place.p_W, Milli(std::remainder(prospect.place.yaw / kRight - azimuth, 360)) * kRight};
}

// Where a camera looks: near something that is clearly seen, and of a few such directions the one with the most different things.
class Aim {
 public:
  Aim(const Lexicon& lexicon, const std::vector<Seen>& seen) {
    for (const Sighted& s : Group(lexicon, seen)) {
      std::vector<double>& azimuths = by_word_.emplace_back();
      for (const Seen* thing : s.clear) azimuths.push_back(thing->azimuth_deg);
      clear_.insert(clear_.end(), azimuths.begin(), azimuths.end());
    }
  }
  double Draw(RngStream& random) const {
    double best = 0;
    int64_t most = -1;
    for (int i = 0; i < kAims; ++i) {
      const double azimuth = clear_[random.Index(static_cast<uint32_t>(clear_.size()))] + random.Uniform(-25, 25);
      if (const int64_t words = WordsAt(azimuth); words > most) {
        most = words;
        best = azimuth;
      }
    }
    return Milli(std::remainder(best, 360));
  }

 private:
  int64_t WordsAt(double azimuth) const {
    const auto inside = [&](double thing) { return std::abs(std::remainder(thing - azimuth, 360)) < kHalfView; };
    return std::ranges::count_if(by_word_, [&](const auto& azimuths) { return std::ranges::any_of(azimuths, inside); });
  }
  std::vector<std::vector<double>> by_word_;
  std::vector<double> clear_;  // degrees from the heading
};

}  // namespace

std::optional<Lookout> DrawLookout(const VlnGround& ground, const Lexicon& lexicon, const SurfacePoints& surfaces, Renderer& renderer,
                                   uint64_t number, const LookoutOptions& options) {
  RngStream random(options.seed, "language lookout", number);
  Frame frame;
  for (const Prospect& prospect : BestPlaces(ground, lexicon, renderer, random, options.width)) {
    const bool flies = options.later && !prospect.passed.empty();
    const Viewpoint place = flies ? TurnedToPass(prospect, random) : prospect.place;
    Glance around = Shoot({true, 0, place, options.width, options.width / 2}, renderer, frame, &surfaces, options.masks);
    if (WordsInSight(lexicon, around.seen) < std::min(kLeastWords, lexicon.in_use())) continue;
    const Aim aim(lexicon, around.seen);
    Lookout lookout{number, {std::move(around)}, {}};
    const int side = options.width / 2;
    for (int i = 0; i < options.cameras; ++i)
      lookout.glances.push_back(Shoot({false, aim.Draw(random), place, side, side}, renderer, frame, &surfaces, options.masks));
    const auto then = flies ? FlyAhead(ground, place, random) : std::nullopt;
    if (then) lookout.later = Shoot({true, 0, *then, options.width, options.width / 2}, renderer, frame, &surfaces, false);
    return lookout;
  }
  return std::nullopt;
}

}  // namespace airsim360::internal

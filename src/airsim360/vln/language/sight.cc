#include "airsim360/vln/language/sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace airsim360::internal {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;

double Wrapped(double degrees) { return std::remainder(degrees, 360); }

struct Tally {
  Seen seen;
  double first_deg = 0, left = 0, right = 0;  // azimuths relative to the first pixel's
  Vec3d direction;
  double columns = 0;
};

void Add(Tally& tally, int x, int y, double azimuth_deg, Vec3d direction, float range) {
  Seen& seen = tally.seen;
  if (seen.pixels++ == 0) {
    tally.first_deg = azimuth_deg;
    seen.x0 = seen.x1 = x;
    seen.y0 = seen.y1 = y;
    seen.nearest = range;
  }
  const double offset = Wrapped(azimuth_deg - tally.first_deg);
  tally.left = std::min(tally.left, offset);
  tally.right = std::max(tally.right, offset);
  tally.direction += direction;
  tally.columns += x + 0.5;
  seen.x0 = std::min(seen.x0, x);
  seen.x1 = std::max(seen.x1, x);
  seen.y0 = std::min(seen.y0, y);
  seen.y1 = std::max(seen.y1, y);
  seen.nearest = std::min(seen.nearest, static_cast<double>(range));
}

Seen Finish(const Tally& tally, const Picture& picture) {
  Seen seen = tally.seen;
  const Vec3d d = tally.direction;
  seen.azimuth_deg = -std::atan2(d.y, d.x) / kDegree;
  seen.elevation_deg = std::atan2(d.z, std::hypot(d.x, d.y)) / kDegree;
  const double middle = Wrapped(seen.azimuth_deg - tally.first_deg);
  seen.left_deg = seen.azimuth_deg + tally.left - middle;
  seen.right_deg = seen.azimuth_deg + tally.right - middle;
  seen.x = tally.columns / static_cast<double>(seen.pixels);
  const bool both_ends = seen.x0 == 0 && seen.x1 == picture.width - 1;
  seen.cut = picture.panorama ? both_ends : seen.x0 == 0 || seen.y0 == 0 || seen.x1 == picture.width - 1 || seen.y1 == picture.height - 1;
  return seen;
}

}  // namespace

Camera Picture::camera() const {
  if (panorama) return Equirectangular{width, height};
  return Pinhole{width, height, width / 2.0, width / 2.0, width / 2.0, height / 2.0};
}

RigidTransform Picture::X_WC() const { return BodyPose(from.p_W, from.yaw - azimuth_deg * kDegree, 0, 0) * CameraInBody(); }

std::vector<Seen> Look(const Picture& picture, const Frame& frame) {
  std::unordered_map<EntityId, Tally> tallies;
  const int w = picture.width, h = picture.height;
  const double c = std::cos(picture.azimuth_deg * kDegree), s = std::sin(picture.azimuth_deg * kDegree);
  std::vector<double> azimuths(w);  // of columns, from the heading
  std::vector<Vec2d> ways(w);       // of columns of a panorama: ahead, left
  for (int x = 0; x < w; ++x) {
    azimuths[x] = picture.panorama ? 360 * ((x + 0.5) / w - 0.5) : picture.azimuth_deg + std::atan((x + 0.5 - w / 2.0) / (w / 2.0)) / kDegree;
    ways[x] = {std::cos(azimuths[x] * kDegree), -std::sin(azimuths[x] * kDegree)};
  }
  for (int y = 0; y < h; ++y) {
    EntityId last = kNoEntity;
    Tally* tally = nullptr;
    const double elevation = kPi * (0.5 - (y + 0.5) / h), up = std::sin(elevation), level = std::cos(elevation);
    for (int x = 0; x < w; ++x) {
      const EntityId entity = frame.entity(x, y);
      if (entity == kNoEntity) continue;
      if (entity != last || tally == nullptr) {
        tally = &tallies[entity];
        last = entity;
      }
      Vec3d d;  // ahead, left, up
      if (picture.panorama) {
        d = {level * ways[x].x, level * ways[x].y, up};
      } else {
        const Vec3d ray = Normalized(Vec3d{w / 2.0, w / 2.0 - x - 0.5, h / 2.0 - y - 0.5});
        d = {c * ray.x + s * ray.y, -s * ray.x + c * ray.y, ray.z};
      }
      Add(*tally, x, y, azimuths[x], d, frame.range(x, y));
    }
  }
  std::vector<Seen> all;
  for (auto& [entity, tally] : tallies) {
    tally.seen.entity = entity;
    all.push_back(Finish(tally, picture));
  }
  std::ranges::sort(all, {}, &Seen::entity);
  return all;
}

std::vector<Sighted> Group(const Lexicon& lexicon, const std::vector<Seen>& seen) {
  std::vector<Sighted> groups(lexicon.words().size());
  for (const Seen& thing : seen) {
    if (thing.pixels <= kUnseen) continue;
    for (const uint16_t word : lexicon.NamedBy(thing.entity)) (thing.pixels >= kClear ? groups[word].clear : groups[word].doubtful).push_back(&thing);
    for (const uint16_t word : lexicon.MistakenFor(thing.entity)) groups[word].doubtful.push_back(&thing);
  }
  return groups;
}

}  // namespace airsim360::internal

#include "airsim360/vln/language/sight.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

double Wrapped(double degrees) { return std::remainder(degrees, 360); }

struct Tally {
  Seen seen;
  double first_deg = 0, left = 0, right = 0;  // azimuths relative to the first pixel's
  Vec3d direction;
  double columns = 0;
};

// What lies in a column and what lies left of it.
struct Columns {
  std::vector<double> azimuths;  // degrees from the heading
  std::vector<Vec2d> ways;       // of a panorama: sums of (ahead, left) of all columns before this one
};

Columns ColumnsOf(const Picture& picture) {
  const int w = picture.width;
  Columns columns{std::vector<double>(w), std::vector<Vec2d>(w + 1)};
  for (int x = 0; x < w; ++x) {
    const double azimuth =
        picture.panorama ? 360 * ((x + 0.5) / w - 0.5) : picture.azimuth_deg + std::atan((x + 0.5 - w / 2.0) / (w / 2.0)) / kDegree;
    columns.azimuths[x] = azimuth;
    columns.ways[x + 1] = columns.ways[x] + Vec2d{std::cos(azimuth * kDegree), -std::sin(azimuth * kDegree)};
  }
  return columns;
}

// The sum of the unit directions (ahead, left, up) of pixels of a row.
Vec3d DirectionOf(const Picture& picture, const Columns& columns, int y, int from, int to) {
  if (picture.panorama) {
    const double elevation = kPi * (0.5 - (y + 0.5) / picture.height), level = std::cos(elevation);
    const Vec2d way = columns.ways[to] - columns.ways[from];
    return {level * way.x, level * way.y, std::sin(elevation) * (to - from)};
  }
  const double half = picture.width / 2.0, up = picture.height / 2.0 - y - 0.5;
  const double c = std::cos(picture.azimuth_deg * kDegree), s = std::sin(picture.azimuth_deg * kDegree);
  Vec3d sum;
  for (int x = from; x < to; ++x) {
    const double left = half - x - 0.5, scale = 1 / std::sqrt(half * half + left * left + up * up);
    sum += Vec3d{half * scale, left * scale, up * scale};
  }
  return {c * sum.x + s * sum.y, -s * sum.x + c * sum.y, sum.z};
}

// Pixels of one thing that follow each other in a row: columns from … to - 1.
void AddRun(Tally& tally, const Columns& columns, int y, int from, int to, Vec3d direction, const float* range) {
  Seen& seen = tally.seen;
  if (seen.pixels == 0) {
    tally.first_deg = columns.azimuths[from];
    seen.x0 = from;
    seen.x1 = to - 1;
    seen.y0 = seen.y1 = y;
    seen.nearest = range[from];
  }
  seen.pixels += to - from;
  // Past the place opposite to the first pixel azimuths go on at the other side.
  const double start = Wrapped(columns.azimuths[from] - tally.first_deg), end = start + columns.azimuths[to - 1] - columns.azimuths[from];
  tally.left = std::min(tally.left, end > 180 ? -180 : start);
  tally.right = std::max(tally.right, std::min(end, 180.0));
  tally.direction += direction;
  tally.columns += (from + to) * 0.5 * (to - from);
  seen.x0 = std::min(seen.x0, from);
  seen.x1 = std::max(seen.x1, to - 1);
  seen.y1 = y;
  float nearest = range[from];
  for (int x = from + 1; x < to; ++x) nearest = std::min(nearest, range[x]);
  seen.nearest = std::min(seen.nearest, static_cast<double>(nearest));
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
  seen.round = picture.panorama && both_ends;
  return seen;
}

// Points whose pixel shows the thing, or something farther away where the thing is finer than a pixel.
double ShareShown(const Picture& picture, const Frame& frame, EntityId entity, const std::vector<Vec3d>& points) {
  constexpr double kSlack = 0.02;  // of the range, for what one pixel spans
  if (points.empty()) return 1;
  const Camera camera = picture.camera();
  const RigidTransform X_CW = picture.X_WC().inverse();
  int shown = 0;
  for (const Vec3d& p : points) {
    const Vec3d p_C = X_CW * p;
    const auto pixel = RayToPixel(camera, p_C);
    if (!pixel) continue;
    const int x = static_cast<int>(std::floor(pixel->x)), y = static_cast<int>(std::floor(pixel->y));
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
    const float range = frame.range(x, y);
    shown += frame.entity(x, y) == entity || !(range > 0) || range > (1 - kSlack) * Norm(p_C);
  }
  return static_cast<double>(shown) / static_cast<double>(points.size());
}

}  // namespace

Camera Picture::camera() const {
  if (panorama) return Equirectangular{width, height};
  return Pinhole{width, height, width / 2.0, width / 2.0, width / 2.0, height / 2.0};
}

RigidTransform Picture::X_WC() const { return BodyPose(from.p_W, from.yaw - azimuth_deg * kDegree, 0, 0) * CameraInBody(); }

std::vector<Seen> Look(const Picture& picture, const Frame& frame, const SurfacePoints* surfaces) {
  std::unordered_map<EntityId, Tally> tallies;
  const Columns columns = ColumnsOf(picture);
  for (int y = 0; y < picture.height; ++y) {
    const EntityId* row = &frame.entity(0, y);
    for (int from = 0, to = 0; from < picture.width; from = to) {
      while (to < picture.width && row[to] == row[from]) ++to;
      if (row[from] != kNoEntity)
        AddRun(tallies[row[from]], columns, y, from, to, DirectionOf(picture, columns, y, from, to), &frame.range(0, y));
    }
  }
  std::vector<Seen> all;
  for (auto& [entity, tally] : tallies) {
    tally.seen.entity = entity;
    Seen& seen = all.emplace_back(Finish(tally, picture));
    if (surfaces != nullptr) seen.shown = seen.pixels >= kClear ? ShareShown(picture, frame, entity, surfaces->Of(entity)) : 0;
  }
  std::ranges::sort(all, {}, &Seen::entity);
  return all;
}

std::vector<Sighted> Group(const Lexicon& lexicon, const std::vector<Seen>& seen) {
  std::vector<Sighted> groups(lexicon.words().size());
  for (const Seen& thing : seen) {
    if (thing.pixels <= kUnseen) continue;
    for (const uint16_t word : lexicon.NamedBy(thing.entity))
      (thing.clear() ? groups[word].clear : groups[word].doubtful).push_back(&thing);
    for (const uint16_t word : lexicon.MistakenFor(thing.entity)) groups[word].doubtful.push_back(&thing);
  }
  return groups;
}

}  // namespace airsim360::internal

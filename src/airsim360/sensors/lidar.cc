#include "airsim360/sensors/lidar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {
namespace {

constexpr size_t kPacket = 16, kTile = 64 * kPacket;  // shots of one task
constexpr uint64_t kMostShots = uint64_t{1} << 26;

// Channel by channel from the lowest, columns turning to the right.
std::vector<Vec3f> SpinningDirections(const LidarSpec& spec) {
  std::vector<Vec2d> elevations;  // cosine, sine
  const double rise = spec.channels > 1 ? (spec.high_deg - spec.low_deg) / static_cast<double>(spec.channels - 1) : 0;
  for (uint64_t i = 0; i < spec.channels; ++i) {
    const double elevation = (spec.low_deg + rise * static_cast<double>(i)) * kDegree;
    elevations.push_back({std::cos(elevation), std::sin(elevation)});
  }
  std::vector<Vec3f> directions;
  directions.reserve(spec.shots());
  const double turn = spec.sweep_deg / static_cast<double>(spec.columns);
  for (uint64_t column = 0; column < spec.columns; ++column) {
    const double azimuth = (spec.start_deg - turn * static_cast<double>(column)) * kDegree;
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    for (const Vec2d& e : elevations) directions.push_back(VecCast<float>(Vec3d{e.x * c, e.x * s, e.y}));
  }
  return directions;
}

// Two counter-turning prisms (Risley): the sum of two vectors that turn at rates without a common period, so
// that later scans fill the gaps of earlier ones. 7294 and -4664 turns a minute, those of a Livox Mid-40.
Vec3f RosetteDirection(const LidarSpec& spec, uint64_t scan, uint64_t shot) {
  const double part = static_cast<double>(shot) / static_cast<double>(spec.shots());
  const double t = (static_cast<double>(scan) + part) / spec.rate_hz;
  const double a = 2 * std::numbers::pi * std::fmod(7294.0 / 60 * t, 1.0);
  const double b = -2 * std::numbers::pi * std::fmod(4664.0 / 60 * t, 1.0);
  const double half = spec.field_deg / 2 * kDegree;
  const double y = half / 2 * (std::cos(a) + std::cos(b)), z = half / 2 * (std::sin(a) + std::sin(b));
  const double angle = std::hypot(y, z);
  const double scale = angle > 0 ? std::sin(angle) / angle : 1;
  return VecCast<float>(Vec3d{std::cos(angle), y * scale, z * scale});
}

// Everything about one scan that its tiles share.
struct ScanJob {
  const LidarSpec& spec;
  const SensorKey& key;
  const RayTracer& tracer;
  const Kinematics& body;
  const RigidTransform& X_BS;
  const std::vector<Vec3f>& directions;
  int64_t t_ns;
  uint64_t column_shots;  // shots that leave together
};

// Seconds before the end of the scan at which a shot leaves.
double ShotTime(const ScanJob& job, size_t shot) {
  const double columns = static_cast<double>(job.directions.size() / job.column_shots);
  return (static_cast<double>(shot / job.column_shots) + 1 - columns) / (columns * job.spec.rate_hz);
}

// Adds the point of a hit, with noise; nothing if it is lost or out of reach.
void AddPoint(const ScanJob& job, size_t shot, const SensorHit& hit, std::vector<LidarPoint>& points) {
  if (hit.range <= 0) return;
  float range = hit.range;
  if (job.spec.sigma > 0 || job.spec.dropout > 0) {
    RngStream random = SampleStream(job.key, "lidar", MixBits(static_cast<uint64_t>(job.t_ns)) + shot);
    if (job.spec.dropout > 0 && random.Chance(job.spec.dropout)) return;
    if (job.spec.sigma > 0) range += static_cast<float>(random.Normal() * job.spec.sigma);
  }
  if (range < job.spec.min_range || range > job.spec.max_range) return;
  points.push_back({job.directions[shot] * range, range, hit.label.reflectance * hit.cosine, static_cast<float>(ShotTime(job, shot)),
                    hit.label.category, hit.label.entity, static_cast<uint32_t>(shot)});
}

void ScanTile(const ScanJob& job, size_t begin, size_t end, std::vector<LidarPoint>& points) {
  std::array<SensorRay, kPacket> rays;
  std::array<SensorHit, kPacket> hits;
  RigidTransform X_WS = job.body.X_WB * job.X_BS;
  const float far = static_cast<float>(job.spec.max_range + 5 * job.spec.sigma);
  for (size_t first = begin; first < end; first += kPacket) {
    const size_t count = std::min(kPacket, end - first);
    for (size_t i = 0; i < count; ++i) {
      const size_t shot = first + i;
      if (job.spec.motion_distortion && (i == 0 || shot % job.column_shots == 0))
        X_WS = Extrapolate(job.body, ShotTime(job, shot)) * job.X_BS;
      rays[i] = {VecCast<float>(X_WS.p), VecCast<float>(X_WS.R * VecCast<double>(job.directions[shot]))};
    }
    TraceRays(job.tracer, std::span(rays).first(count), 0, far, job.spec.through_panes, hits);
    for (size_t i = 0; i < count; ++i) AddPoint(job, first + i, hits[i], points);
  }
}

}  // namespace

void LidarSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place on the body or gimbal", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("gimbal", "0 = fixed to the body, n = on the n-th gimbal", gimbal);
  v.Field("pattern", "spinning or rosette", pattern);
  v.Field("rate_hz", "scans a second", rate_hz, 0.01, 1000);
  v.Field("channels", "spinning: beams above each other", channels);
  v.Field("columns", "shots of a scan / channels", columns);
  v.Field("low_deg", "spinning: elevation of the lowest channel", low_deg, -90, 90);
  v.Field("high_deg", "spinning: elevation of the highest channel", high_deg, -90, 90);
  v.Field("start_deg", "spinning: azimuth of the first column, to the left", start_deg, -360, 360);
  v.Field("sweep_deg", "spinning: angle swept to the right", sweep_deg, 0, 360);
  v.Field("field_deg", "rosette: full opening of the cone", field_deg, 0, 180);
  v.Field("min_range", "metres", min_range, 0, 1e4);
  v.Field("max_range", "metres", max_range, 0, 1e5);
  v.Field("sigma", "metres", sigma, 0, 100);
  v.Field("dropout", "share of points lost at random", dropout, 0, 1);
  v.Field("through_panes", "clear glass is not seen", through_panes);
  v.Field("motion_distortion", "each shot leaves at its own time", motion_distortion);
}

void LidarSpec::Check() const {
  static const std::vector<std::string> kPatterns = {"spinning", "rosette"};
  ParseChoice("pattern", pattern, kPatterns, "lidar");
  if (channels == 0 || columns == 0 || channels > kMostShots || columns > kMostShots / channels) {
    throw InputError("lidar: " + std::to_string(channels) + " channels of " + std::to_string(columns) +
                     " columns; their product must be in 1 … " + std::to_string(kMostShots));
  }
  if (high_deg < low_deg || max_range < min_range) throw InputError("lidar: a range ends before it begins");
}

std::vector<Vec3f> LidarDirections(const LidarSpec& spec, uint64_t scan) {
  if (spec.pattern == "spinning") return SpinningDirections(spec);
  std::vector<Vec3f> directions;
  directions.reserve(spec.shots());
  for (uint64_t shot = 0; shot < spec.shots(); ++shot) directions.push_back(RosetteDirection(spec, scan, shot));
  return directions;
}

void ScanLidar(const LidarSpec& spec, const SensorKey& key, const RayTracer& tracer, const Kinematics& body, const RigidTransform& X_BS,
               int64_t t_ns, LidarScan& scan) {
  spec.Check();
  const std::vector<Vec3f> directions = LidarDirections(spec, static_cast<uint64_t>(SampleIndex(spec.rate_hz, t_ns)));
  const ScanJob job{spec, key, tracer, body, X_BS, directions, t_ns, spec.pattern == "spinning" ? spec.channels : 1};
  std::vector<std::vector<LidarPoint>> tiles((directions.size() + kTile - 1) / kTile);
  ParallelFor(static_cast<int64_t>(tiles.size()), [&](int64_t i) {
    const auto tile = static_cast<size_t>(i);
    tiles[tile].reserve(kTile);
    ScanTile(job, tile * kTile, std::min((tile + 1) * kTile, directions.size()), tiles[tile]);
  });
  scan.t_ns = t_ns;
  scan.X_WS = body.X_WB * X_BS;
  scan.shots = static_cast<uint32_t>(directions.size());
  scan.points.clear();
  for (const auto& tile : tiles) scan.points.insert(scan.points.end(), tile.begin(), tile.end());
}

}  // namespace airsim360

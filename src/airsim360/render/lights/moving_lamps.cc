#include "airsim360/render/lights/moving_lamps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/lights/lamp_parts.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kColumn = 6;           // metres
constexpr float kFarthestMoving = 80;  // metres; low beams reach 50 to 75
constexpr int64_t kMostOfColumns = 1 << 20;
constexpr float kFarthestPlace = 1e6f;   // metres from the origin: what a user puts beyond lights nobody
constexpr float kRoadBelow = 0.3f;       // metres below a lamp where its columns are weighed: beams are cut off above
constexpr uint32_t kOpenColumn = 0xf00;  // header: four corners count

float ScaleOf(const Mat3f& A) { return std::cbrt(std::fabs(A.determinant())); }

// Not one of the wide and dim ones, whose light is for probes to gather: these know the scene as built.
bool IsStrong(const Lamp& lamp) { return Norm(lamp.beam) >= 1 || Luminance(lamp.power) / (kPiF * lamp.area) >= kBrightLamp; }

// A lamp of a mesh where an instance of it stands.
Lamp PlaceMeshLamp(const Lamp& of_mesh, const AffineTransform& X_WM, Vec3f glow, uint32_t instance) {
  const float scale = ScaleOf(X_WM.A);
  Lamp lamp = of_mesh;
  lamp.center = X_WM * of_mesh.center;
  lamp.radius *= scale;
  lamp.area *= scale * scale;
  lamp.facing = X_WM.A * of_mesh.facing * scale;
  lamp.power = of_mesh.power * glow * (scale * scale);
  const float sharp = Norm(of_mesh.beam);
  if (sharp > 0) lamp.beam = Normalized(X_WM.A * of_mesh.beam) * sharp;
  lamp.instance = instance;
  return lamp;
}

}  // namespace

std::vector<MovedInstance> AwayFromHome(const RayTracer& tracer) {
  std::vector<MovedInstance> away;
  for (const MovedInstance& moved : tracer.moved())
    if (moved.hidden || !(moved.X_WM == tracer.scene().instances[moved.instance].X_WM)) away.push_back(moved);
  return away;
}

bool MovingLamps::Holds(const Lamp& lamp) const { return IsStrong(lamp) && std::ranges::binary_search(instances_, lamp.instance); }

const std::vector<Lamp>& MovingLamps::LampsOf(const Scene& scene, const SurfaceTables& tables, const Environment& environment,
                                              uint32_t instance) {
  const MeshId id = scene.instances[instance].mesh;
  const auto [found, fresh] = mesh_lamps_.try_emplace(id);
  if (!fresh) return found->second;
  const Mesh& mesh = scene.meshes[id];
  InstanceRecord upright = tables.instances[instance];
  for (int k = 0; k < 9; ++k) upright.normal_matrix[k] = k % 4 == 0 ? 1.0f : 0.0f;
  for (const LampShape& shape : FindLamps(scene, mesh, Mat3f(), environment).shapes) {
    const Lamp lamp = PlaceLamp(mesh, tables, upright, AffineTransform{}, {1, 1, 1}, shape).lamp;
    if (IsStrong(lamp)) found->second.push_back(lamp);
  }
  return found->second;
}

void MovingLamps::Follow(const RayTracer& tracer, const SurfaceTables& tables, const Environment& environment,
                         std::span<const MovedInstance> moved, float daylight) {
  instances_.clear(), records_.clear(), cells_.clear(), cell_of_.clear(), reached_.clear();
  const Scene& scene = tracer.scene();
  for (const MovedInstance& m : moved) {
    const Vec3f glow = tables.GlowOf(m.instance);
    if (m.hidden || glow == Vec3f{}) continue;
    std::vector<Lamp> placed;
    for (const Lamp& lamp : LampsOf(scene, tables, environment, m.instance))
      MergeLamp(PlaceMeshLamp(lamp, m.X_WM, glow, m.instance), 0, placed);
    for (const Lamp& lamp : placed) {
      std::optional<LampRecord> record = RecordOf(lamp, daylight);
      if (!record || !(std::fabs(lamp.center.x) < kFarthestPlace && std::fabs(lamp.center.y) < kFarthestPlace)) continue;
      record->reach = std::min(record->reach, kFarthestMoving);
      records_.push_back(*record);
      if (instances_.empty() || instances_.back() != m.instance) instances_.push_back(m.instance);
    }
  }
  if (records_.empty()) return;
  PlaceColumns(daylight);
  ParallelFor(static_cast<int64_t>(records_.size()), [&](int64_t lamp) {
    const FlushDenormals flush;
    LookFromCorners(tracer, static_cast<uint32_t>(lamp), reached_[static_cast<size_t>(lamp)]);
  });
}

// Columns stand at multiples of their width, so that they stay where they are while lamps move.
void MovingLamps::PlaceColumns(float daylight) {
  Box3f box;
  for (const LampRecord& r : records_) {
    box.Add(Vec3f{r.center[0] - r.reach, r.center[1] - r.reach, 0});
    box.Add(Vec3f{r.center[0] + r.reach, r.center[1] + r.reach, 0});
  }
  const auto lattice = [&](float x) { return std::floor(x / cell_); };
  for (cell_ = kColumn;; cell_ *= 2) {
    nx_ = static_cast<int>(lattice(box.max.x) - lattice(box.min.x)) + 1,
    ny_ = static_cast<int>(lattice(box.max.y) - lattice(box.min.y)) + 1;
    if (static_cast<int64_t>(nx_) * ny_ <= kMostOfColumns) break;
  }
  origin_x_ = lattice(box.min.x) * cell_, origin_y_ = lattice(box.min.y) * cell_;
  cell_of_.assign(static_cast<size_t>(nx_) * static_cast<size_t>(ny_), 0);
  cells_.assign(1, LampCell{});

  reached_.resize(records_.size());
  const float least = LeastLampLight(daylight) / 2;
  ParallelFor(static_cast<int64_t>(records_.size()),
              [&](int64_t lamp) { reached_[static_cast<size_t>(lamp)] = ColumnsInReach(records_[static_cast<size_t>(lamp)], least); });
  std::vector<float> strengths(LampCell::kLamps);
  for (uint32_t lamp = 0; lamp < records_.size(); ++lamp) Keep(lamp, reached_[lamp], strengths);
}

Vec3f MovingLamps::CornerAt(const LampRecord& lamp, int x, int y) const {
  return {origin_x_ + static_cast<float>(x) * cell_, origin_y_ + static_cast<float>(y) * cell_, lamp.center[2]};
}

// Those where a surface that faces the lamp gets at least so much light at a corner.
std::vector<MovingLamps::Reached> MovingLamps::ColumnsInReach(const LampRecord& lamp, float least) const {
  const auto first = [&](float center, float origin) { return std::max(0, static_cast<int>((center - lamp.reach - origin) / cell_)); };
  const auto last = [&](float center, float origin, int n) {
    return std::min(n - 1, static_cast<int>((center + lamp.reach - origin) / cell_));
  };
  const int x0 = first(lamp.center[0], origin_x_), x1 = last(lamp.center[0], origin_x_, nx_);
  const int y0 = first(lamp.center[1], origin_y_), y1 = last(lamp.center[1], origin_y_, ny_);
  const int across = x1 - x0 + 2;
  std::vector<float> corner;
  for (int y = y0; y <= y1 + 1; ++y)
    for (int x = x0; x <= x1 + 1; ++x) corner.push_back(StrengthOf(lamp, CornerAt(lamp, x, y) - Vec3f{0, 0, kRoadBelow}));
  std::vector<Reached> reached;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float* c = &corner[static_cast<size_t>((y - y0) * across + x - x0)];
      const float strength = std::max(std::max(c[0], c[1]), std::max(c[across], c[across + 1]));
      if (strength >= least) reached.push_back({x, y, strength});
    }
  }
  return reached;
}

// Enters a lamp into its columns; where one is full, instead of the weakest if that is weaker.
void MovingLamps::Keep(uint32_t lamp, const std::vector<Reached>& reached, std::vector<float>& strengths) {
  for (const Reached& r : reached) {
    uint32_t& cell = cell_of_[static_cast<size_t>(r.y) * static_cast<size_t>(nx_) + static_cast<size_t>(r.x)];
    if (cell == 0) {
      cell = static_cast<uint32_t>(cells_.size());
      cells_.emplace_back().header = kOpenColumn;
      strengths.resize(cells_.size() * LampCell::kLamps);
    }
    LampCell& column = cells_[cell];
    float* const own = &strengths[size_t{cell} * LampCell::kLamps];
    uint32_t k = column.header & 255;
    if (k < LampCell::kLamps) {
      ++column.header;
    } else {
      k = static_cast<uint32_t>(std::min_element(own, own + LampCell::kLamps) - own);
      if (!(own[k] < r.strength)) continue;
    }
    column.lamp[k] = lamp, own[k] = r.strength;
  }
}

// Which corners of the columns that keep a lamp see it.
void MovingLamps::LookFromCorners(const RayTracer& tracer, uint32_t lamp, const std::vector<Reached>& reached) {
  if (reached.empty()) return;
  const LampRecord& record = records_[lamp];
  const Vec3f center{record.center[0], record.center[1], record.center[2]};
  const auto entry = [&](const Reached& r) -> uint32_t* {
    LampCell& column = cells_[cell_of_[static_cast<size_t>(r.y) * static_cast<size_t>(nx_) + static_cast<size_t>(r.x)]];
    for (uint32_t k = 0; k < (column.header & 255); ++k)
      if ((column.lamp[k] & 0xffffffu) == lamp) return &column.lamp[k];
    return nullptr;
  };
  std::vector<std::pair<int, int>> corners;  // row, column
  for (const Reached& r : reached) {
    if (entry(r) == nullptr) continue;
    for (const int c : {0, 1, 2, 3}) corners.emplace_back(r.y + (c >> 1), r.x + (c & 1));
  }
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());

  std::vector<uint8_t> seen(corners.size(), 1);
  for (size_t first = 0; first < corners.size(); first += 16) {
    RayHit16 rays{};
    alignas(64) int valid[16] = {};
    bool occluded[16] = {};
    for (size_t k = 0; k < 16; ++k) rays.direction_z[k] = 1, rays.mask[k] = kMaskSolid;
    for (size_t i = first; i < std::min(first + 16, corners.size()); ++i) {
      const size_t k = i - first;
      const Vec3f p = CornerAt(record, corners[i].second, corners[i].first), to = center - p;
      const float distance = Norm(to), free = distance - 1.02f * record.radius;
      if (!(free > 0)) continue;
      rays.origin_x[k] = p.x, rays.origin_y[k] = p.y, rays.origin_z[k] = p.z;
      rays.direction_x[k] = to.x / distance, rays.direction_y[k] = to.y / distance, rays.direction_z[k] = to.z / distance;
      rays.t_far[k] = free;
      rays.geometry[k] = rays.instance[k] = kMiss;
      valid[k] = -1;
    }
    tracer.Occluded16(valid, rays, occluded, false);
    for (size_t i = first; i < std::min(first + 16, corners.size()); ++i) seen[i] = !occluded[i - first];
  }
  for (const Reached& r : reached) {
    uint32_t* const kept = entry(r);
    for (int c = 0; c < 4 && kept != nullptr; ++c) {
      const auto at = std::ranges::lower_bound(corners, std::pair{r.y + (c >> 1), r.x + (c & 1)});
      if (seen[static_cast<size_t>(at - corners.begin())] != 0) *kept |= 1u << (24 + c);
    }
  }
}

LampView MovingLamps::view() const {
  if (records_.empty()) return {};
  return {records_.data(), cells_.data(), cell_of_.data(), origin_x_, origin_y_, 0, 1 / cell_, nx_, ny_, 1};
}

}  // namespace airsim360::internal

#include "airsim360/render/lights/lamp_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/lights/lit_places.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

// Lamps of one instance closer than this are one (the globes of a post, the two head lights of a car).
constexpr float kMergeDistance = 1.5f;
constexpr size_t kMergeAmong = 64;  // of the last ones
constexpr size_t kFewLamps = 256;   // a small scene has room for dim ones, too
// A lamp reaches as far as it brings 0.05 lx, or one part in 10,000 of the daylight; one that brings less
// than a five-hundredth of the daylight at 2 m is left out.
constexpr float kLeastLight = 0.05f * kLux, kLeastOfCell = 1e-4f, kNearShare = 2e-3f, kNearLamp = 2, kFarthest = 150;
constexpr float kFinestCell = 2.5f;
constexpr int kMostCells = 150000;
constexpr float kAboveGround = 1.2f;
constexpr int kSeenLamps = 24;  // of a corner

// Sixteen rays, all lanes finite.
struct Packet {
  RayHit16 rays{};
  alignas(64) int valid[16] = {};

  Packet() {
    for (int i = 0; i < 16; ++i) rays.direction_z[i] = 1, rays.mask[i] = kMaskSolid;
  }
  void Set(int i, Vec3f p, Vec3f d, float t_far) {
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = 0, rays.t_far[i] = t_far;
    rays.geometry[i] = rays.instance[i] = kMiss;
    valid[i] = -1;
  }
};

LampRecord Record(const Lamp& lamp) {
  LampRecord record{};
  const float facing = Norm(lamp.facing);
  // max(0, body + facing cos) has the mean area / 4 of a convex surface: exact for flat and for closed lamps.
  const float body = lamp.area >= 4 * facing ? lamp.area / 4 : std::sqrt(lamp.area * facing) - facing;
  for (int k = 0; k < 3; ++k) {
    record.center[k] = lamp.center[k];
    record.facing[k] = lamp.facing[k];
    record.color[k] = lamp.power[k] / (kPiF * lamp.area);
    record.beam[k] = lamp.beam[k];
  }
  record.radius = lamp.radius;
  record.body = std::max(0.0f, body);
  record.soft = facing / kPiF;
  return record;
}

// Irradiance of a surface that faces a lamp in the direction `to` (not unit), per unit of the lamp's radiance.
float FacedIrradiance(const LampRecord& lamp, Vec3f to) {
  const float distance = std::max(Norm(to), 1e-4f);
  const Vec3f w = to / -distance, facing{lamp.facing[0], lamp.facing[1], lamp.facing[2]}, beam{lamp.beam[0], lamp.beam[1], lamp.beam[2]};
  return scalar::lamp_irradiance(lamp.body, Dot(facing, w), lamp.soft, lamp.radius, distance, lamp.reach) *
         scalar::beam_shape(Norm(beam), Dot(beam, w), w.z);
}

// Whether a ray met a surface from behind.
bool MeetsBack(const RayTracer& tracer, const RayHit16& r, int k) {
  if (r.geometry[k] == kMiss) return false;
  const SurfaceRef ref = tracer.Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
  const Instance& instance = tracer.scene().instances[ref.instance];
  const Mesh& mesh = tracer.scene().meshes[instance.mesh];
  const Vec3u t = mesh.triangles[ref.triangle];
  const Vec3f a = instance.X_WM * mesh.positions[t.x], b = instance.X_WM * mesh.positions[t.y], c = instance.X_WM * mesh.positions[t.z];
  const Vec3f normal = Cross(b - a, c - a) * (instance.X_WM.A.determinant() < 0 ? -1.0f : 1.0f);
  return Dot(normal, Vec3f{r.direction_x[k], r.direction_y[k], r.direction_z[k]}) > 0;
}

// Two lamps seen as one.
Lamp Join(const Lamp& a, const Lamp& b) {
  Lamp out = a;
  const float wa = Luminance(a.power), wb = Luminance(b.power), share = wb / std::max(wa + wb, 1e-30f);
  out.center = a.center * (1 - share) + b.center * share;
  out.radius = std::max(Norm(out.center - a.center) + a.radius, Norm(out.center - b.center) + b.radius);
  out.area = a.area + b.area;
  out.facing = a.facing + b.facing;
  out.power = a.power + b.power;
  return out;
}

}  // namespace

size_t MergeLamp(const Lamp& lamp, size_t first, std::vector<Lamp>& merged) {
  size_t at = std::max(first, merged.size() - std::min(merged.size(), kMergeAmong));
  while (at < merged.size() && !(Norm(merged[at].center - lamp.center) <= kMergeDistance && merged[at].beam == lamp.beam)) ++at;
  if (at == merged.size()) {
    merged.push_back(lamp);
  } else {
    merged[at] = Join(merged[at], lamp);
  }
  return at;
}

float LeastLampLight(float daylight) { return std::max(kLeastLight, kLeastOfCell * daylight); }

std::optional<LampRecord> RecordOf(const Lamp& lamp, float daylight) {
  LampRecord record = Record(lamp);
  const Vec3f color{record.color[0], record.color[1], record.color[2]};
  const float intensity = Luminance(color) * (record.body + Norm(lamp.facing));
  if (!(intensity > kNearShare * daylight * kNearLamp * kNearLamp) || !std::isfinite(intensity)) return std::nullopt;
  record.reach = std::min(kFarthest, std::sqrt(intensity / LeastLampLight(daylight)));
  return record;
}

float StrengthOf(const LampRecord& lamp, Vec3f p) {
  return Luminance({lamp.color[0], lamp.color[1], lamp.color[2]}) *
         FacedIrradiance(lamp, Vec3f{lamp.center[0], lamp.center[1], lamp.center[2]} - p);
}

// What one corner of the lattice knows.
struct LampGrid::Corner {
  std::array<uint32_t, kSeenLamps> lamp;   // strongest first
  std::array<float, kSeenLamps> strength;  // irradiance of a surface that faces it, unhidden
  uint32_t seen = 0;                       // bit k: lamp[k]
  int count = 0;
  bool solid = false;
};

LampGrid::LampGrid(const RayTracer& tracer, const LightTable& table, float daylight) {
  cells_.emplace_back(LampCell{});
  Merge(table, daylight);
  if (!records_.empty()) PlaceCells(tracer);
}

void LampGrid::Merge(const LightTable& table, float daylight) {
  record_of_.assign(table.size(), LightTable::kNoLamp);
  std::vector<Lamp> merged;
  const std::span<const Lamp> lamps = table.lamps();
  size_t first_of_instance = 0;
  for (uint32_t i = 0; i < lamps.size(); ++i) {
    const Lamp& lamp = lamps[i];
    if (i == 0 || lamps[i - 1].instance != lamp.instance) first_of_instance = merged.size();
    const bool beam = Norm(lamp.beam) >= 1;  // head and tail lamps, however dim
    if (lamps.size() > kFewLamps && !beam && Luminance(lamp.power) / (kPiF * lamp.area) < kBrightLamp) continue;
    record_of_[i] = static_cast<uint32_t>(MergeLamp(lamp, first_of_instance, merged));
  }

  // Reach; what does not reach far is dropped.
  std::vector<uint32_t> kept(merged.size(), LightTable::kNoLamp);
  for (size_t k = 0; k < merged.size(); ++k) {
    const std::optional<LampRecord> record = RecordOf(merged[k], daylight);
    if (!record) continue;
    kept[k] = static_cast<uint32_t>(records_.size());
    records_.push_back(*record);
  }
  for (uint32_t& r : record_of_) r = r == LightTable::kNoLamp ? r : kept[r];
  for (uint32_t i = 0; i < lamps.size(); ++i)
    if (record_of_[i] != LightTable::kNoLamp) of_instance_.emplace_back(lamps[i].instance, record_of_[i]);
  std::ranges::sort(of_instance_);
  of_instance_.erase(std::unique(of_instance_.begin(), of_instance_.end()), of_instance_.end());
}

Vec3f LampGrid::CornerPosition(uint32_t corner) const {
  const auto x = corner % (nx_ + 1), y = corner / (nx_ + 1) % (ny_ + 1), z = corner / ((nx_ + 1) * (ny_ + 1));
  return origin_ + Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * cell_ + Vec3f{0, 0, raised_[corner]};
}

// Where cells are tall, corners below the ground and those above the street lights would be all there is: the former look
// from just above the ground instead.
void LampGrid::RaiseCorners(const RayTracer& tracer, const std::vector<uint32_t>& corners) {
  if (cell_ <= kFinestCell) return;
  ParallelFor((static_cast<int64_t>(corners.size()) + 15) / 16, [&](int64_t run) {
    const FlushDenormals flush;
    const size_t first = static_cast<size_t>(run) * 16, last = std::min(first + 16, corners.size());
    Packet packet;
    for (size_t i = first; i < last; ++i) packet.Set(static_cast<int>(i - first), CornerPosition(corners[i]), Vec3f{0, 0, 1}, cell_);
    tracer.Intersect16(packet.valid, packet.rays, false);
    for (size_t i = first; i < last; ++i) {
      const auto k = static_cast<int>(i - first);
      if (MeetsBack(tracer, packet.rays, k)) raised_[corners[i]] = packet.rays.t_far[k] + kAboveGround;
    }
  });
}

void LampGrid::PlaceCells(const RayTracer& tracer) {
  // Where the lamps reach and the scene is.
  Box3f box;
  for (const LampRecord& r : records_) {
    const Vec3f c{r.center[0], r.center[1], r.center[2]}, reach{r.reach, r.reach, r.reach};
    box.Add(Box3f{c - reach, c + reach});
  }
  const Vec3f margin{0.05f, 0.05f, 0.05f};
  box = {Max(box.min, tracer.scene().bounds.min - margin), Min(box.max, tracer.scene().bounds.max + margin)};
  const Vec3f size = Max(box.size(), Vec3f{0.1f, 0.1f, 0.1f});
  const float largest = std::max(std::max(size.x, size.y), size.z);
  const auto cells = [&](float extent) { return static_cast<int>(std::ceil(extent / cell_)); };
  cell_ = std::clamp(largest / 24, 0.3f, kFinestCell);
  while (static_cast<int64_t>(cells(size.x)) * cells(size.y) * cells(size.z) > kMostCells) cell_ *= 1.06f;
  nx_ = cells(size.x), ny_ = cells(size.y), nz_ = cells(size.z);
  origin_ = box.min;
  cell_of_.assign(static_cast<size_t>(nx_) * ny_ * nz_, 0);

  // Only cells that hold surfaces are ever asked.
  std::vector<uint8_t> filled(cell_of_.size());
  const float reach = 0.5f * std::sqrt(3.0f) * cell_;
  ParallelFor(static_cast<int64_t>(ny_) * nz_, [&](int64_t row) {
    for (int64_t k = row * nx_; k < (row + 1) * nx_; ++k) {
      const Vec3f center = origin_ + Vec3f{static_cast<float>(k % nx_) + 0.5f, static_cast<float>(k / nx_ % ny_) + 0.5f,
                                           static_cast<float>(k / nx_ / ny_) + 0.5f} *
                                         cell_;
      filled[k] = tracer.Clearance(center, reach * 1.01f) < reach;
    }
  });
  raised_.assign(static_cast<size_t>(nx_ + 1) * (ny_ + 1) * (nz_ + 1), 0.0f);
  std::vector<uint32_t> places;
  std::vector<uint32_t> corner_of(static_cast<size_t>(nx_ + 1) * (ny_ + 1) * (nz_ + 1), 0);
  for (uint32_t k = 0; k < filled.size(); ++k) {
    if (filled[k] == 0) continue;
    places.push_back(k);
    for (uint32_t c = 0; c < 8; ++c) {
      corner_of[CornerOf(k, c)] = 1;
    }
  }
  std::vector<uint32_t> used;
  for (uint32_t c = 0; c < corner_of.size(); ++c) {
    if (corner_of[c] == 0) continue;
    corner_of[c] = static_cast<uint32_t>(used.size());
    used.push_back(c);
  }
  RaiseCorners(tracer, used);
  FillCells(places, SeeFromCorners(tracer, used), corner_of);
  raised_ = {};
}

std::vector<uint32_t> LampGrid::LampsThatReach(const Box3f& box) const {
  std::vector<uint32_t> near;
  for (uint32_t l = 0; l < records_.size(); ++l) {
    const Vec3f c{records_[l].center[0], records_[l].center[1], records_[l].center[2]};
    if (Norm(c - Min(Max(c, box.min), box.max)) < records_[l].reach) near.push_back(l);
  }
  return near;
}

void LampGrid::LookAtLamps(const RayTracer& tracer, Vec3f p, RankedLamps& ranked, Corner& corner) const {
  const size_t count = std::min<size_t>(ranked.size(), kSeenLamps);
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<int64_t>(count), ranked.end());
  corner.count = static_cast<int>(count);
  for (size_t begin = 0; begin < count; begin += 16) {
    Packet packet;
    bool occluded[16] = {};
    for (size_t k = begin; k < std::min(begin + 16, count); ++k) {
      const LampRecord& lamp = records_[ranked[k].second];
      corner.lamp[k] = ranked[k].second;
      corner.strength[k] = -ranked[k].first;
      const Vec3f to = Vec3f{lamp.center[0], lamp.center[1], lamp.center[2]} - p;
      const float distance = Norm(to), free = distance - 1.02f * lamp.radius;
      corner.seen |= 1u << k;
      if (free > 0) packet.Set(static_cast<int>(k - begin), p, to / distance, free);
    }
    tracer.Occluded16(packet.valid, packet.rays, occluded, false);
    for (size_t k = begin; k < std::min(begin + 16, count); ++k) {
      if (packet.valid[k - begin] && occluded[k - begin]) corner.seen &= ~(1u << k);
    }
  }
}

std::vector<LampGrid::Corner> LampGrid::SeeFromCorners(const RayTracer& tracer, const std::vector<uint32_t>& places) const {
  std::vector<Corner> corners(places.size());
  constexpr int64_t kRun = 256;
  ParallelFor((static_cast<int64_t>(places.size()) + kRun - 1) / kRun, [&](int64_t run) {
    const FlushDenormals flush;
    const int64_t first = run * kRun, last = std::min<int64_t>(first + kRun, static_cast<int64_t>(places.size()));
    Box3f box;
    for (int64_t i = first; i < last; ++i) box.Add(CornerPosition(places[i]));
    const std::vector<uint32_t> near = LampsThatReach(box);
    RankedLamps ranked;
    for (int64_t i = first; i < last; ++i) {
      const Vec3f p = CornerPosition(places[i]);
      ranked.clear();
      for (uint32_t l : near) {
        const float strength = StrengthOf(records_[l], p);
        if (strength > 0) ranked.emplace_back(-strength, l);
      }
      LookAtLamps(tracer, p, ranked, corners[i]);
    }
  });
  MarkSolid(tracer, places, corners);
  return corners;
}

void LampGrid::MarkSolid(const RayTracer& tracer, const std::vector<uint32_t>& places, std::vector<Corner>& corners) const {
  // A corner from which the surface above it, or towards its strongest lamp, shows its back is in a solid.
  // Seen from there lamps tell nothing.
  ParallelFor((static_cast<int64_t>(places.size()) + 15) / 16, [&](int64_t run) {
    const FlushDenormals flush;
    const size_t first = static_cast<size_t>(run) * 16, last = std::min(first + 16, places.size());
    for (const bool upwards : {true, false}) {
      Packet packet;
      for (size_t i = first; i < last; ++i) {
        if (corners[i].seen != 0 || corners[i].count == 0) continue;
        const Vec3f p = CornerPosition(places[i]);
        const LampRecord& lamp = records_[corners[i].lamp[0]];
        const Vec3f to = Vec3f{lamp.center[0], lamp.center[1], lamp.center[2]} - p;
        packet.Set(static_cast<int>(i - first), p, upwards ? Vec3f{0.011f, 0.007f, 1} : Normalized(to), INFINITY);
      }
      tracer.Intersect16(packet.valid, packet.rays, false);
      for (size_t i = first; i < last; ++i) {
        const auto k = static_cast<int>(i - first);
        if (packet.valid[k] != 0) corners[i].solid |= MeetsBack(tracer, packet.rays, k);
      }
    }
  });
}

// The lamps that bring most to any corner; those that no corner sees come last.
void LampGrid::FillCells(const std::vector<uint32_t>& places, const std::vector<Corner>& corners, const std::vector<uint32_t>& corner_of) {
  constexpr float kUnseen = 0.1f, kNegligible = 1e-3f;
  std::vector<LampCell> filled(places.size());
  ParallelFor((static_cast<int64_t>(places.size()) + 255) / 256, [&](int64_t run) {
    struct Candidate {
      uint32_t lamp;
      float score;
      uint32_t seen;
    };
    std::vector<Candidate> found;
    for (int64_t i = run * 256; i < std::min<int64_t>((run + 1) * 256, static_cast<int64_t>(places.size())); ++i) {
      found.clear();
      uint32_t open = 0;
      const uint32_t place = places[i];
      for (uint32_t c = 0; c < 8; ++c) {
        const Corner& corner = corners[corner_of[CornerOf(place, c)]];
        if (!corner.solid) open |= 1u << c;
        for (int k = 0; k < corner.count; ++k) {
          const bool seen = (corner.seen >> k & 1) != 0;
          const float score = corner.strength[k] * (seen ? 1.0f : kUnseen);
          auto at = std::find_if(found.begin(), found.end(), [&](const Candidate& f) { return f.lamp == corner.lamp[k]; });
          if (at == found.end()) at = found.insert(found.end(), {corner.lamp[k], 0, 0});
          at->score = std::max(at->score, score);
          if (seen) at->seen |= 1u << c;
        }
      }
      size_t count = std::min<size_t>(found.size(), LampCell::kLamps);
      std::partial_sort(found.begin(), found.begin() + static_cast<int64_t>(count), found.end(),
                        [](const Candidate& a, const Candidate& b) { return a.score != b.score ? a.score > b.score : a.lamp < b.lamp; });
      while (count > 0 && found[count - 1].score < kNegligible * found[0].score) --count;
      LampCell& cell = filled[i];
      cell = LampCell{};
      cell.header = static_cast<uint32_t>(count) | open << 8;
      for (size_t k = 0; k < count; ++k) cell.lamp[k] = found[k].lamp | found[k].seen << 24;
    }
  });
  for (size_t i = 0; i < places.size(); ++i) {
    if ((filled[i].header & 255) == 0) continue;
    cell_of_[places[i]] = static_cast<uint32_t>(cells_.size());
    cells_.push_back(filled[i]);
  }
  AverageCells();
}

uint32_t LampGrid::CornerOf(size_t place, uint32_t c) const {
  const auto k = static_cast<uint32_t>(place);
  const uint32_t x = k % nx_ + (c & 1), y = k / nx_ % ny_ + (c >> 1 & 1), z = k / nx_ / ny_ + (c >> 2);
  return (z * (ny_ + 1) + y) * (nx_ + 1) + x;
}

// Light on six sides at the corners that are not in solids.
void LampGrid::AverageCells() {
  std::vector<size_t> place(cells_.size());
  for (size_t k = 0; k < cell_of_.size(); ++k) place[cell_of_[k]] = k;
  sides_.assign(cells_.size(), {});
  ParallelFor(static_cast<int64_t>(cells_.size()), [&](int64_t i) {
    const LampCell& cell = cells_[i];
    float open = 0;
    std::array<Vec3f, 6> sum{};
    for (uint32_t c = 0; i > 0 && c < 8; ++c) {
      if ((cell.header >> (8 + c) & 1) == 0) continue;
      ++open;
      const Vec3f p = CornerPosition(CornerOf(place[i], c));
      for (uint32_t k = 0; k < (cell.header & 255); ++k) {
        if ((cell.lamp[k] >> (24 + c) & 1) == 0) continue;
        const LampRecord& lamp = records_[cell.lamp[k] & 0xffffffu];
        const Vec3f to = Normalized(Vec3f{lamp.center[0], lamp.center[1], lamp.center[2]} - p);
        const Vec3f color{lamp.color[0], lamp.color[1], lamp.color[2]};
        const Vec3f light = color * (StrengthOf(lamp, p) / std::max(Luminance(color), 1e-30f));
        for (int side = 0; side < 6; ++side) sum[side] += light * std::max(0.0f, side & 1 ? -to[side / 2] : to[side / 2]);
      }
    }
    for (int side = 0; side < 6; ++side) sides_[i][side] = sum[side] / std::max(open, 1.0f);
  });
}

Vec3f LampGrid::NearIrradiance(Vec3f p, Vec3f n) const {
  const Vec3f q = (p + n * (0.5f * cell_) - origin_) / cell_;
  const auto inside = [](float x, int n) { return x >= 0 && x < static_cast<float>(n); };
  const auto at = [&](Vec3f a) {
    return inside(a.x, nx_) && inside(a.y, ny_) && inside(a.z, nz_)
               ? cell_of_[(static_cast<size_t>(a.z) * ny_ + static_cast<size_t>(a.y)) * nx_ + static_cast<size_t>(a.x)]
               : 0u;
  };
  if (records_.empty()) return {};
  uint32_t cell = at(q);
  if (cell == 0) cell = at((p - origin_) / cell_);
  const std::array<Vec3f, 6>& e = sides_[cell];
  return e[n.x < 0 ? 1 : 0] * (n.x * n.x) + e[n.y < 0 ? 3 : 2] * (n.y * n.y) + e[n.z < 0 ? 5 : 4] * (n.z * n.z);
}

float LampGrid::TypicalLight() const {
  std::vector<float> light;
  for (size_t i = 1; i < sides_.size(); ++i) light.push_back(Luminance(sides_[i][4]));
  return LightOfLitPlaces(std::move(light));
}

LampView LampGrid::view() const {
  if (records_.empty()) return {};
  return {records_.data(), cells_.data(), cell_of_.data(), origin_.x, origin_.y, origin_.z, 1 / cell_, nx_, ny_, nz_};
}

LampView LampGrid::ViewWithout(std::span<const uint32_t> instances, std::vector<LampRecord>& own) const {
  own.clear();
  LampView changed = view();
  for (const uint32_t instance : instances) {
    const auto same = std::ranges::equal_range(of_instance_, instance, {}, &std::pair<uint32_t, uint32_t>::first);
    if (same.empty()) continue;
    if (own.empty()) own = records_;
    for (const auto& [_, record] : same) std::ranges::fill(own[record].color, 0.0f);
  }
  if (!own.empty()) changed.lamps = own.data();
  return changed;
}

Vec3f LampGrid::Irradiance(Vec3f p, Vec3f normal) const {
  const Vec3f q = (p - origin_) / cell_;
  if (records_.empty() || !(q.x >= 0 && q.y >= 0 && q.z >= 0)) return {};
  const int x = static_cast<int>(q.x), y = static_cast<int>(q.y), z = static_cast<int>(q.z);
  if (x >= nx_ || y >= ny_ || z >= nz_) return {};
  const LampCell& cell = cells_[cell_of_[(static_cast<size_t>(z) * ny_ + y) * nx_ + x]];
  const Vec3f f{q.x - static_cast<float>(x), q.y - static_cast<float>(y), q.z - static_cast<float>(z)};
  float weight[8], sum = 0;
  for (int c = 0; c < 8; ++c) {
    weight[c] = (c & 1 ? f.x : 1 - f.x) * (c & 2 ? f.y : 1 - f.y) * (c & 4 ? f.z : 1 - f.z) + 1e-4f;
    weight[c] = (cell.header >> (8 + c) & 1) != 0 ? weight[c] : 0;
    sum += weight[c];
  }
  Vec3f light;
  for (uint32_t k = 0; k < (cell.header & 255) && sum > 0; ++k) {
    const LampRecord& lamp = records_[cell.lamp[k] & 0xffffffu];
    const Vec3f to = Vec3f{lamp.center[0], lamp.center[1], lamp.center[2]} - p;
    const float distance = std::max(Norm(to), 1e-4f), lit = Dot(to, normal) / distance;
    if (lit <= 0) continue;
    float seen = 0;
    for (int c = 0; c < 8; ++c) seen += (cell.lamp[k] >> (24 + c) & 1) != 0 ? weight[c] : 0;
    light += Vec3f{lamp.color[0], lamp.color[1], lamp.color[2]} * (FacedIrradiance(lamp, to) * lit * seen / sum);
  }
  return light;
}

}  // namespace airsim360::internal

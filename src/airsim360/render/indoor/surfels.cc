#include "airsim360/render/indoor/surfels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

constexpr float kSampleStep = 0.45f;              // of a cell
constexpr float kTinyShare = 0.05f;               // of a cell's face: smaller pieces have samples by chance
constexpr size_t kMostSamples = Surfel::kPoints;  // of a cell and direction
constexpr float kFlat = 0.002f;                   // m
constexpr size_t kMostSurfels = 3;
constexpr float kBuriedNear = 0.02f;  // m
constexpr float kThin = 0.0005f;      // m: a sheet of paper hides nothing
constexpr float kAgrees = 0.9f;       // least cosine between the normals of most of a cell's surface and its first surfel
constexpr float kFacing = 0.35f;      // least cosine between the normals of a place and its surfel
constexpr float kPlane = 0.6f;        // of a cell: thickness of the disc
constexpr float kOffPlane = 24;       // how much farther a surfel is that lies in another plane

float Lift(float cell) { return std::min(0.012f, cell * 0.2f); }

// Cells do not end where walls stand.
Vec3f OriginOf(float cell) { return Vec3f{0.377f, 0.411f, 0.353f} * cell; }

uint32_t SideOf(Vec3f n) {
  const float x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  return x > y && x > z ? (n.x > 0 ? 0 : 1) : y > z ? (n.y > 0 ? 2 : 3) : (n.z > 0 ? 4 : 5);
}

struct Sorted {
  uint64_t key;  // of cell and side
  SurfaceSample sample;
};

int32_t CellOf(float x) { return static_cast<int32_t>(std::floor(std::clamp(x, -0.9f * kFarCell, 0.9f * kFarCell))); }

std::vector<Sorted> SortSamples(std::span<const SurfacePiece> pieces, float cell, const std::function<bool(Vec3f, Vec3f)>& wanted) {
  constexpr int64_t kChunk = 256;
  const Vec3f origin = OriginOf(cell);
  const float least = kTinyShare * cell * cell;
  const int64_t chunks = (static_cast<int64_t>(pieces.size()) + kChunk - 1) / kChunk;
  std::vector<std::vector<Sorted>> parts(static_cast<size_t>(chunks));
  ParallelFor(chunks, [&](int64_t chunk) {
    std::vector<Sorted>& out = parts[static_cast<size_t>(chunk)];
    for (int64_t i = chunk * kChunk; i < std::min<int64_t>((chunk + 1) * kChunk, static_cast<int64_t>(pieces.size())); ++i) {
      SurfacePiece piece = pieces[static_cast<size_t>(i)];
      if (!StandsForTiny(piece, least, ShiftOf(static_cast<uint64_t>(i)).y)) continue;
      for (const bool back : {false, true}) {
        SamplePiece(piece, cell * kSampleStep, back, [&](const SurfaceSample& s) {
          if (wanted && !wanted(s.p, s.n)) return;
          const Vec3f q = (s.p - origin) / cell;
          out.push_back({IndoorKey(CellOf(q.x), CellOf(q.y), CellOf(q.z)) << 3 | SideOf(s.n), s});
        });
      }
    }
  });
  std::vector<Sorted> all = JoinParts(std::move(parts));
  std::stable_sort(all.begin(), all.end(), [](const Sorted& a, const Sorted& b) { return a.key < b.key; });
  return all;
}

// Inside something, or just under it.
bool Buried(const IndoorWorld& world, const SurfaceSample& s, uint64_t seed) {
  RayPacket packet;
  Vec3f t, b;
  TangentFrame(s.n, t, b);
  const Vec2f shift = ShiftOf(seed);
  constexpr uint32_t kRays = 8;
  for (uint32_t i = 0; i < kRays; ++i) {
    const Vec2f u = EvenPoint(i, shift);
    const float r = std::sqrt(u.x), angle = 6.2831853f * u.y;
    packet.Set(static_cast<int>(i), s.p + s.n * 1.5e-3f, t * (r * std::cos(angle)) + b * (r * std::sin(angle)) + s.n * std::sqrt(1 - u.x),
               INFINITY);
  }
  world.tracer.Intersect16(packet.valid, packet.rays, false);
  int bad = 0;
  for (uint32_t i = 0; i < kRays; ++i) {
    if (!packet.Hit(static_cast<int>(i))) continue;
    const MetSurface met = SurfaceUnder(world, packet, static_cast<int>(i));
    bad += met.behind || packet.rays.t_far[i] < kBuriedNear;
  }
  return bad * 3 >= static_cast<int>(kRays) * 2;
}

bool Sees(const IndoorWorld& world, const Surfel& surfel, const SurfaceSample& s, float lift) {
  const Vec3f from = surfel.p + surfel.n * lift, to = s.p + s.n * lift;
  return Norm(to - from) < 1e-4f || !world.tracer.Occluded(from, to);
}

// Which samples something lies on, closer than kBuriedNear: what is under panels, rugs and plates gets no light, but lies in one
// plane with what does.
std::vector<uint8_t> FindCovered(const IndoorWorld& world, std::span<const Sorted> samples) {
  std::vector<uint8_t> covered(samples.size());
  for (size_t first = 0; first < samples.size(); first += 16) {
    const size_t count = std::min<size_t>(16, samples.size() - first);
    RayPacket packet;
    for (size_t k = 0; k < count; ++k) {
      const SurfaceSample& s = samples[first + k].sample;
      packet.Set(static_cast<int>(k), s.p + s.n * kThin, s.n, kBuriedNear);
    }
    alignas(64) bool occluded[16] = {};
    world.tracer.Occluded16(packet.valid, packet.rays, occluded, true);
    std::copy(occluded, occluded + count, covered.begin() + static_cast<int64_t>(first));
  }
  return covered;
}

void FindClear(const IndoorWorld& world, float cell, Surfel& surfel) {
  RayPacket packet;
  for (int i = 0; i < kClearSectors; ++i) {
    // Along the square of ClearSector.
    const float turn = (static_cast<float>(i) + 0.5f) * (4.0f / kClearSectors);
    const float a = turn < 1 ? turn : turn < 3 ? 2 - turn : turn - 4;
    const float x = (turn < 1 || turn > 3 ? 1 : -1) * (1 - std::fabs(a));
    packet.Set(i, surfel.p + surfel.n * Lift(cell), Normalized(surfel.t * x + surfel.b * a), 2 * cell);
  }
  world.tracer.Intersect16(packet.valid, packet.rays, false);
  for (int i = 0; i < kClearSectors; ++i) surfel.clear[i] = packet.Hit(i) ? packet.rays.t_far[i] : 2 * cell;
}

// From near to the middle of what surface there is (cells are cut by edges) to far. First those that face as most of it does: the
// bevel of a lamp's frame would speak for the ceiling else.
void OrderSamples(std::span<Sorted> samples) {
  Vec3f middle, facing;
  float area = 0;
  for (const Sorted& s : samples) {
    middle += s.sample.p * s.sample.area, facing += s.sample.n * s.sample.area, area += s.sample.area;
  }
  middle = middle / std::max(area, 1e-20f);
  const float agrees = kAgrees * Norm(facing);
  const auto before = [&](const Sorted& a, const Sorted& b) {
    const bool one = Dot(a.sample.n, facing) >= agrees, other = Dot(b.sample.n, facing) >= agrees;
    if (one != other) return one;
    return Dot(a.sample.p - middle, a.sample.p - middle) < Dot(b.sample.p - middle, b.sample.p - middle);
  };
  std::stable_sort(samples.begin(), samples.end(), before);
}

// The surfels of one cell and side.
std::vector<Surfel> PlaceInCell(const IndoorWorld& world, float cell, std::span<Sorted> samples) {
  const uint64_t key = samples[0].key >> 3;
  const int32_t at[3] = {static_cast<int32_t>(key >> 40) - kFarCell, static_cast<int32_t>(key >> 20 & 0xfffff) - kFarCell,
                         static_cast<int32_t>(key & 0xfffff) - kFarCell};
  OrderSamples(samples);
  std::vector<Surfel> out;
  // Of many samples some, from near to far.
  const size_t asked = std::min(samples.size(), kMostSamples);
  const float weight = static_cast<float>(samples.size()) / static_cast<float>(asked);
  for (size_t k = 0; k < asked; ++k) samples[k] = samples[k * samples.size() / asked];
  samples = samples.first(asked);
  const std::vector<uint8_t> covered = FindCovered(world, samples);
  for (size_t i = 0; i < asked; ++i) {
    if (covered[i] != 0) continue;
    SurfaceSample s = samples[i].sample;
    s.area *= weight;
    Surfel* seen = nullptr;
    for (Surfel& surfel : out) {
      if (seen == nullptr && Sees(world, surfel, s, Lift(cell))) seen = &surfel;
    }
    if (seen != nullptr) {
      // In sight along one plane both are in the open.
      const bool flat = s.n == seen->n && std::fabs(Dot(s.p - seen->p, s.n)) < kFlat;
      if (!flat && Buried(world, s, samples[i].key + i)) continue;
      seen->area += s.area, seen->albedo += s.albedo * s.area;
      if (seen->point_count < Surfel::kPoints) {
        seen->points[seen->point_count++] = s.p;
        if (flat) std::swap(seen->points[seen->plane_count++], seen->points[seen->point_count - 1]);
      }
    } else if (out.size() < kMostSurfels && !Buried(world, s, samples[i].key + i)) {
      Surfel surfel;
      surfel.p = s.p, surfel.n = s.n, surfel.albedo = s.albedo * s.area, surfel.area = s.area;
      TangentFrame(s.n, surfel.t, surfel.b);
      std::copy(at, at + 3, surfel.cell);
      surfel.points[0] = s.p, surfel.point_count = surfel.plane_count = 1;
      out.push_back(surfel);
    }
  }
  for (Surfel& surfel : out) {
    surfel.albedo = surfel.albedo / std::max(surfel.area, 1e-12f);
    FindClear(world, cell, surfel);
  }
  return out;
}

}  // namespace

SurfelSet::SurfelSet(const IndoorWorld& world, std::span<const SurfacePiece> pieces, float cell,
                     const std::function<bool(Vec3f, Vec3f)>& wanted)
    : cell_(cell), origin_(OriginOf(cell)) {
  std::vector<Sorted> samples = SortSamples(pieces, cell, wanted);
  std::vector<size_t> starts;
  for (size_t i = 0; i < samples.size(); ++i)
    if (i == 0 || samples[i].key != samples[i - 1].key) starts.push_back(i);
  starts.push_back(samples.size());
  const int64_t groups = static_cast<int64_t>(starts.size()) - 1, kChunk = 64;
  std::vector<std::vector<Surfel>> parts(static_cast<size_t>((groups + kChunk - 1) / kChunk));
  ParallelFor(static_cast<int64_t>(parts.size()), [&](int64_t chunk) {
    const FlushDenormals flush;
    for (int64_t g = chunk * kChunk; g < std::min(groups, (chunk + 1) * kChunk); ++g) {
      const size_t first = starts[static_cast<size_t>(g)], count = starts[static_cast<size_t>(g) + 1] - first;
      for (const Surfel& surfel : PlaceInCell(world, cell, std::span(samples).subspan(first, count)))
        parts[static_cast<size_t>(chunk)].push_back(surfel);
    }
  });
  for (const auto& part : parts) surfels_.insert(surfels_.end(), part.begin(), part.end());
  MakeTable();
}

void SurfelSet::MakeTable() {
  for (const Surfel& surfel : surfels_) places_.push_back({surfel.p, surfel.n});
  const auto key = [&](size_t i) { return IndoorKey(surfels_[i].cell[0], surfels_[i].cell[1], surfels_[i].cell[2]); };
  size_t count = 0;
  for (size_t i = 0; i < surfels_.size(); ++i) count += i == 0 || key(i) != key(i - 1);
  cells_.assign(std::bit_ceil(std::max<size_t>(16, 2 * count)), {kNoCell, 0, 0});
  for (size_t i = 0; i < surfels_.size();) {
    size_t end = i + 1;
    while (end < surfels_.size() && key(end) == key(i)) ++end;
    size_t at = IndoorHash(key(i)) & (cells_.size() - 1);
    while (cells_[at].key != kNoCell) at = (at + 1) & (cells_.size() - 1);
    cells_[at] = {key(i), static_cast<uint32_t>(i), static_cast<uint32_t>(end - i)};
    i = end;
  }
}

std::pair<uint32_t, uint32_t> SurfelSet::In(int x, int y, int z) const {
  const uint64_t key = IndoorKey(x, y, z);
  for (size_t at = IndoorHash(key) & (cells_.size() - 1);; at = (at + 1) & (cells_.size() - 1)) {
    if (cells_[at].key == key) return {cells_[at].first, cells_[at].count};
    if (cells_[at].key == kNoCell) return {0, 0};
  }
}

namespace {

// Whether nothing stands between a surfel and what is at d from it.
bool ClearTo(const Surfel& surfel, Vec3f d) {
  const float x = Dot(d, surfel.t), y = Dot(d, surfel.b);
  const float far = surfel.clear[static_cast<int>(ClearSector(x, y))] + 0.004f;
  return x * x + y * y <= far * far;
}

}  // namespace

float SurfelSet::Weight(const Surfel& surfel, Vec3f p, Vec3f n) const {
  const float c = Dot(n, surfel.n);
  if (c < kFacing) return 0;
  const Vec3f d = p - surfel.p;
  if (!ClearTo(surfel, d)) return 0;
  const float e = Dot(d, surfel.n) / (kPlane * cell_);
  return std::max(0.0f, 1 - e * e * 0.8f) * (c - kFacing) * (c - kFacing) + 1e-5f;
}

uint32_t SurfelSet::Nearest(Vec3f p, Vec3f n) const {
  const Vec3f q = (p - origin_) / cell_;
  const int x = CellOf(q.x), y = CellOf(q.y), z = CellOf(q.z);
  uint32_t best = kNone;
  float least = INFINITY;
  const auto look = [&](int cx, int cy, int cz) {
    const auto [first, count] = In(cx, cy, cz);
    for (uint32_t i = first; i < first + count; ++i) {
      const Place& at = places_[i];
      const Vec3f d = p - at.p;
      const float h = Dot(d, at.n), c = Dot(n, at.n);
      const float far = (Dot(d, d) + kOffPlane * h * h) * (2 - c);
      if (c >= kFacing && far < least && ClearTo(surfels_[i], d)) least = far, best = i;
    }
  };
  look(x, y, z);
  if (best != kNone) return best;
  for (int k = 0; k < 27; ++k) look(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1);
  return best;
}

void SurfelSet::Prefetch(Vec3f p) const {
  const Vec3f q = (p - origin_) / cell_;
  __builtin_prefetch(&cells_[IndoorHash(IndoorKey(CellOf(q.x), CellOf(q.y), CellOf(q.z))) & (cells_.size() - 1)]);
}

}  // namespace airsim360::internal

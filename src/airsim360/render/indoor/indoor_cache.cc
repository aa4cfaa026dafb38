#include "airsim360/render/indoor/indoor_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kOpen = 0.5f, kAllOpen = 0.8f;  // share of the sky that outdoor places see

void Put(Vec3f v, float* to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

IndoorSurfel Kept(const Surfel& s, const LevelLight& light, size_t i, float clear_step) {
  IndoorSurfel out{};
  Put(s.p, out.point), Put(s.n, out.normal), Put(s.t, out.tangent);
  Put(light.light[i], out.light), Put(light.lamps[i], out.lamps);
  // Irradiance of linear radiance over the hemisphere, relative to the surfel's own normal.
  const float own = light.mean[i] / 4 + Dot(light.bend[i], s.n) / 2;
  out.bend[0] = own > 0 ? light.mean[i] / 4 / own : 1;
  Put(own > 0 ? light.bend[i] * (0.5f / own) : Vec3f{}, out.bend + 1);
  out.share = std::clamp((kAllOpen - light.open[i]) / (kAllOpen - kOpen), 0.0f, 1.0f);
  for (int k = 0; k < kClearSectors; ++k) out.clear[k] = static_cast<uint8_t>(std::clamp(s.clear[k] / clear_step, 0.0f, 255.0f));
  return out;
}

}  // namespace

IndoorCache::Level IndoorCache::LevelOf(const SurfelSet& set, const LevelLight& light) {
  Level level;
  level.cell = set.cell(), level.origin = set.origin();
  for (size_t i = 0; i < set.surfels().size(); ++i) level.surfels.push_back(Kept(set.surfels()[i], light, i, 2 * set.cell() / 255));
  level.cells.assign(set.cells().begin(), set.cells().end());
  return level;
}

IndoorCache::IndoorCache(const LightSolver& solver)
    : coarse_(LevelOf(solver.coarse(), solver.coarse_light())), radiance_(solver.Radiances()) {
  if (solver.fine() != nullptr) fine_ = LevelOf(*solver.fine(), solver.fine_light());
}

bool IndoorCache::Sound(const Level& level) {
  const size_t count = level.surfels.size();
  if (!std::has_single_bit(level.cells.size()) || !(level.cell > 0)) return false;
  size_t used = 0;
  for (const IndoorCell& cell : level.cells) {
    if (cell.key == kNoCell) continue;
    ++used;
    if (cell.first > count || cell.count > count - cell.first) return false;
  }
  return used < level.cells.size();
}

bool IndoorCache::Sound() const { return Sound(coarse_) && Sound(fine_) && radiance_.size() == coarse_.surfels.size(); }

IndoorLevel IndoorCache::View(const Level& level) {
  return {level.surfels.data(), level.cells.data(),  level.cells.size() - 1, {level.origin.x, level.origin.y, level.origin.z},
          1 / level.cell,       2 * level.cell / 255};
}

IndoorView IndoorCache::view() const { return {View(coarse_), View(fine_)}; }

size_t IndoorCache::bytes() const {
  return (coarse_.surfels.size() + fine_.surfels.size()) * sizeof(IndoorSurfel) + radiance_.size() * sizeof(Vec3f) +
         (coarse_.cells.size() + fine_.cells.size()) * sizeof(IndoorCell);
}

std::optional<Vec3f> IndoorCache::RadianceAt(Vec3f p, Vec3f normal) const {
  const Vec3f q = (p - coarse_.origin) / coarse_.cell;
  if (!(std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)}) < 0.9f * kFarCell)) return std::nullopt;
  const int32_t at[3] = {static_cast<int32_t>(std::floor(q.x)), static_cast<int32_t>(std::floor(q.y)),
                         static_cast<int32_t>(std::floor(q.z))};
  const uint64_t mask = coarse_.cells.size() - 1;
  float least = INFINITY;
  size_t best = 0;
  const auto look = [&](int32_t x, int32_t y, int32_t z) {
    const uint64_t key = IndoorKey(x, y, z);
    uint64_t slot = IndoorHash(key) & mask;
    while (coarse_.cells[slot].key != key && coarse_.cells[slot].key != kNoCell) slot = (slot + 1) & mask;
    const IndoorCell& cell = coarse_.cells[slot];
    if (cell.key == kNoCell) return;
    for (size_t i = cell.first; i < cell.first + cell.count; ++i) {
      const IndoorSurfel& s = coarse_.surfels[i];
      const Vec3f n{s.normal[0], s.normal[1], s.normal[2]}, t{s.tangent[0], s.tangent[1], s.tangent[2]};
      const Vec3f d = p - Vec3f{s.point[0], s.point[1], s.point[2]};
      const float cosine = Dot(normal, n), x1 = Dot(d, t), y1 = Dot(d, Cross(n, t));
      const float clear = s.clear[static_cast<int>(ClearSector(x1, y1))] * (2 * coarse_.cell / 255) + 0.004f;
      if (cosine < 0.35f || x1 * x1 + y1 * y1 > clear * clear) continue;
      const float far = Dot(d, d) * (2 - cosine);
      if (far < least) least = far, best = i;
    }
  };
  look(at[0], at[1], at[2]);
  for (int k = 0; k < 27 && least == INFINITY; ++k) look(at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1);
  if (least == INFINITY) return std::nullopt;
  return radiance_[best];
}

}  // namespace airsim360::internal

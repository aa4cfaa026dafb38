#include "airsim360/render/indoor/light_links.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kLinkLift = 1.5e-3f;
constexpr int kMostMirrors = 6;
constexpr float kSectors = 8;    // of directions about the normal
constexpr float kGuided = 0.8f;  // of the density that follows the light
constexpr float kMostDense = 64;

// What a pane takes on the way of the packet's rays, as grey.
void DimPacket(const IndoorWorld& world, const RayPacket& hit, const RayPacket& sent, float* share) {
  if (!world.tracer.has_clear_panes()) return;
  RayPacket panes = sent;
  for (int i = 0; i < 16; ++i) panes.rays.t_far[i] = hit.Hit(i) ? hit.rays.t_far[i] : INFINITY;
  std::array<Vec3f, 16> tint;
  tint.fill({1, 1, 1});
  DimByPanes(world.tracer, world.tables, panes.valid, panes.rays, tint);
  for (size_t i = 0; i < 16; ++i) share[i] *= Luminance(tint[i]);
}

// Ends one ray, or turns it at a mirror; true: it goes on. lamps: for the first surface of an even ray, else nullptr.
bool Land(const IndoorWorld& world, const Reflectance& reflectance, const SurfelSet& coarse, RayPacket& packet, int i,
          const MetSurface& met, bool last, const LampMix* lamps, const Surfel& from, Landing& out) {
  out.direction = packet.Direction(i);
  if (!packet.Hit(i)) {
    out.target = LightLink::kSky;
    return false;
  }
  if (lamps != nullptr) out.glow = GlowUnder(world, *lamps, packet, i, met, from.n, from.p);
  if (met.mirror) {
    out.share *= Luminance(met.base);
    out.target = LightLink::kNothing;
    if (last) return false;
    const Vec3f d = out.direction - met.normal * (2 * Dot(out.direction, met.normal));
    packet.Set(i, met.point + met.normal * kLinkLift, d, INFINITY);
    return true;
  }
  out.target = coarse.Nearest(met.point, met.normal);
  if (out.target != SurfelSet::kNone) return false;
  out.target = met.behind ? LightLink::kNothing : Landing::kOutside;
  out.outside = {met.point, met.normal, reflectance.Of(met.material, met.base), {}};
  return false;
}

}  // namespace

LinkTable::LinkTable() {
  for (int i = 0; i < 256; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / 256;
    out[i] = std::sqrt(x), up[i] = std::sqrt(1 - x);
    cosine[i] = std::cos(6.2831853f * x), sine[i] = std::sin(6.2831853f * x);
  }
}
const LinkTable& LinkSteps() {
  static const LinkTable table;
  return table;
}

void SendRays(const IndoorWorld& world, const Reflectance& reflectance, const SurfelSet& coarse, const Surfel& from,
              std::span<const Vec2f> points, const LampMix& lamps, std::vector<Landing>& landings) {
  const LinkTable& steps = LinkSteps();
  const std::span<const Vec3f> places = from.InPlane();
  landings.assign(points.size(), {});
  // Rays of a packet go about the same way.
  std::vector<std::pair<uint32_t, uint32_t>> order(points.size());
  for (uint32_t i = 0; i < points.size(); ++i)
    order[i] = {static_cast<uint32_t>(points[i].y * kSectors) << 16 | static_cast<uint32_t>(points[i].x * 256), i};
  std::sort(order.begin(), order.end());
  for (size_t first = 0; first < points.size(); first += 16) {
    const int count = static_cast<int>(std::min<size_t>(16, points.size() - first));
    RayPacket packet;
    float share[16];
    std::fill(share, share + 16, 1.0f);
    for (int i = 0; i < count; ++i) {
      const uint32_t ray = order[first + static_cast<size_t>(i)].second;
      // As far as the link will remember.
      const Vec3f d = LinkDirection(steps, from, LinkStep(points[ray].x), LinkStep(points[ray].y));
      packet.Set(i, places[ray % places.size()] + from.n * kLinkLift, d, INFINITY);
    }
    bool mirrored = false;
    for (int bounce = 0; bounce == 0 || mirrored; ++bounce) {
      const RayPacket sent = packet;
      world.tracer.Intersect16(packet.valid, packet.rays, bounce == 0);
      DimPacket(world, packet, sent, share);
      mirrored = false;
      MetSurface met[16];
      for (int i = 0; i < count; ++i) {
        if (!packet.Hit(i)) continue;
        met[i] = SurfaceUnder(world, packet, i);
        coarse.Prefetch(met[i].point);
      }
      for (int i = 0; i < count; ++i) {
        if (packet.valid[i] == 0) continue;
        const uint32_t ray = order[first + static_cast<size_t>(i)].second;
        Landing& landing = landings[ray];
        landing.share = share[i];
        const bool meets = bounce == 0 && static_cast<int>(ray) < lamps.even;
        const bool turned =
            Land(world, reflectance, coarse, packet, i, met[i], bounce == kMostMirrors, meets ? &lamps : nullptr, from, landing);
        if (meets) landing.glow.radiance = landing.glow.radiance * share[i];
        if (turned) {
          share[i] = landing.share;
          mirrored = true;
        } else {
          // The sky in a mirror is a light of its own.
          if (bounce > 0 && landing.target == LightLink::kSky) {
            landing.target = Landing::kOutside;
            landing.outside = {{}, {}, {}, SkyAlong(world, landing.direction)};
          }
          packet.valid[i] = 0;
        }
      }
    }
  }
}

size_t LightGuide::CellOf(Vec2f point) {
  const auto at = [](float x) { return static_cast<size_t>(std::clamp(static_cast<int>(x * kSide), 0, kSide - 1)); };
  return at(point.x) * kSide + at(point.y);
}

LightGuide::LightGuide(const std::array<float, kCells>& sum, const std::array<float, kCells>& count) {
  // Means of 3 x 3 cells; v goes round.
  std::array<float, kCells> light{};
  float total = 0;
  for (int u = 0; u < kSide; ++u) {
    for (int v = 0; v < kSide; ++v) {
      float s = 0, c = 0;
      for (int k = 0; k < 9; ++k) {
        const int du = k / 3 - 1, dv = k % 3 - 1;
        const int at = std::clamp(u + du, 0, kSide - 1) * kSide + (v + dv + kSide) % kSide;
        const float weight = du == 0 && dv == 0 ? 2.0f : 1.0f;
        s += sum[static_cast<size_t>(at)] * weight, c += count[static_cast<size_t>(at)] * weight;
      }
      const float mean = c > 0 ? s / c : 0;
      light[static_cast<size_t>(u * kSide + v)] = mean;
      total += mean;
    }
  }
  float kept = 0;
  for (int i = 0; i < kCells; ++i) {
    const float relative = total > 0 ? light[static_cast<size_t>(i)] * kCells / total : 1;
    density_[static_cast<size_t>(i)] = 1 - kGuided + kGuided * std::min(relative, kMostDense);
    kept += density_[static_cast<size_t>(i)];
  }
  for (float& d : density_) d *= kCells / kept;
}

void LightGuide::Sample(int count, Vec2f shift, std::vector<Vec2f>& points) const {
  size_t cell = 0;
  float below = 0;  // of the sum of density before the cell
  for (int k = 0; k < count; ++k) {
    const float target = (static_cast<float>(k) + shift.x) / static_cast<float>(count) * kCells;
    while (cell + 1 < kCells && below + density_[cell] <= target) below += density_[cell++];
    const Vec2f in = EvenPoint(static_cast<uint32_t>(k), shift);
    points.push_back({(static_cast<float>(cell / kSide) + in.x) / kSide, (static_cast<float>(cell % kSide) + in.y) / kSide});
  }
}

void SampleEvenly(int count, Vec2f shift, std::vector<Vec2f>& points) {
  for (int k = 0; k < count; ++k) points.push_back(EvenPoint(static_cast<uint32_t>(k), shift));
}

}  // namespace airsim360::internal

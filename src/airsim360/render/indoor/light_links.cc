#include "airsim360/render/indoor/light_links.h"

#include <algorithm>
#include <array>
#include <bit>
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

// What panes take on the way of the packet's rays, as grey, and which rays they turn.
void MeetPanes(const IndoorWorld& world, const RayPacket& hit, const RayPacket& sent, float* share, PaneTurns& turns) {
  RayPacket panes = sent;
  for (int i = 0; i < 16; ++i) panes.rays.t_far[i] = hit.Hit(i) ? hit.rays.t_far[i] : INFINITY;
  std::array<Vec3f, 16> tint;
  tint.fill({1, 1, 1});
  TurnAtPanes(world.tracer, world.tables, panes.valid, panes.rays, tint, turns);
  for (size_t i = 0; i < 16; ++i) share[i] *= Luminance(tint[i]);
}

// The mirrored rest of a ray that met something with that normal at `distance`.
void Mirror(RayPacket& packet, int i, float distance, Vec3f normal) {
  const Vec3f d = packet.Direction(i), n = Dot(normal, d) > 0 ? -normal : normal;
  packet.Set(i, packet.Origin(i) + d * distance + n * kLinkLift, d - n * (2 * Dot(d, n)), INFINITY);
}

// By which panes turn a ray or not.
float TurnNumber(const Surfel& from, uint32_t ray, int bounce) {
  const uint64_t place = static_cast<uint64_t>(std::bit_cast<uint32_t>(from.p.x)) << 32 ^
                         static_cast<uint64_t>(std::bit_cast<uint32_t>(from.p.y)) << 16 ^ std::bit_cast<uint32_t>(from.p.z);
  return EvenPoint(ray, ShiftOf(place + static_cast<uint64_t>(bounce))).x;
}

// Where rays are on their way.
struct Journey {
  int bounce;  ///< mirrors met
  bool last;   ///< there will be no further one
};

// Ends one ray, or turns it at a mirror; true: it goes on. `meets`: it shares the light of lamps with rays to them.
bool Land(const IndoorWorld& world, const Reflectance& reflectance, const SurfelSet& coarse, RayPacket& packet, int i,
          const MetSurface& met, Journey at, const LampMix& lamps, bool meets, const Surfel& from, Landing& out) {
  out.direction = packet.Direction(i);
  if (!packet.Hit(i)) {
    out.target = LightLink::kSky;
    // The sky in a mirror is a light of its own.
    if (at.bounce > 0) out.target = Landing::kOutside, out.outside = {{}, {}, {}, SkyAlong(world, out.direction)};
    return false;
  }
  if (meets) out.glow = GlowUnder(world, lamps, packet, i, met, from.n, from.p);
  if (met.mirror) {
    out.share *= Luminance(met.base);
    out.target = LightLink::kNothing;
    if (!at.last) Mirror(packet, i, packet.rays.t_far[i], met.normal);
    return !at.last;
  }
  // A lamp in a mirror is one, too: no ray to lamps finds it.
  const Vec3f glow = at.bounce > 0 && lamps.plain != nullptr ? PlainGlow(world, *lamps.plain, packet, i, met) : Vec3f{};
  if (glow != Vec3f{}) {
    out.target = Landing::kOutside, out.outside = {{}, {}, {}, glow};
    return false;
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
    bool goes_on = true;
    for (int bounce = 0; goes_on; ++bounce) {
      const RayPacket sent = packet;
      const bool last = bounce == kMostMirrors;
      world.tracer.Intersect16(packet.valid, packet.rays, bounce == 0);
      PaneTurns turns;
      std::fill(turns.at, turns.at + 16, INFINITY);
      if (world.tracer.has_clear_panes()) {
        for (int i = 0; i < 16; ++i)
          turns.number[i] = last ? 1 : TurnNumber(from, order[first + static_cast<size_t>(i % count)].second, bounce);
        MeetPanes(world, packet, sent, share, turns);
      }
      goes_on = false;
      MetSurface met[16];
      for (int i = 0; i < count; ++i) {
        if (!packet.Hit(i) || turns.at[i] < INFINITY) continue;
        met[i] = SurfaceUnder(world, packet, i);
        coarse.Prefetch(met[i].point);
      }
      for (int i = 0; i < count; ++i) {
        if (packet.valid[i] == 0) continue;
        if (turns.at[i] < INFINITY) {
          Mirror(packet, i, turns.at[i], turns.normal[i]);
          goes_on = true;
          continue;
        }
        const uint32_t ray = order[first + static_cast<size_t>(i)].second;
        Landing& landing = landings[ray];
        landing.share = share[i];
        const bool meets = bounce == 0 && static_cast<int>(ray) < lamps.even;
        const bool turned = Land(world, reflectance, coarse, packet, i, met[i], {bounce, last}, lamps, meets, from, landing);
        if (meets) landing.glow.radiance = landing.glow.radiance * share[i];
        share[i] = landing.share;
        goes_on |= turned;
        if (!turned) packet.valid[i] = 0;
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

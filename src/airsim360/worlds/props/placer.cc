#include "airsim360/worlds/props/placer.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/plane.h"

namespace airsim360 {
namespace {

constexpr float kCell = 4;

struct Extent {
  std::string_view kind;
  float half_x, half_y;
};
// Long things, seen from their front (towards -Y).
constexpr Extent kExtents[] = {
    {"car", 0.98f, 2.45f},          {"van", 1.08f, 2.9f},           {"bus", 1.35f, 6.3f},           {"bench_wood", 0.95f, 0.42f},
    {"bus_stop", 2.1f, 0.85f},      {"bicycle", 0.32f, 0.92f},      {"hedge", 0.5f, 0.35f},         {"rail", 1.0f, 0.06f},
    {"wood_fence", 1.0f, 0.08f},    {"traffic_light", 0.3f, 0.3f},  {"street_light", 0.25f, 0.25f}, {"lamp_post", 0.3f, 0.3f},
    {"food_cart", 1.5f, 1.0f},      {"poster_stand", 0.5f, 0.4f},   {"traffic_sign", 0.15f, 0.15f}, {"playground", 2.0f, 2.9f},
    {"road_block", 0.78f, 0.26f},   {"picnic_table", 0.95f, 0.85f}, {"bollard_lamp", 0.15f, 0.15f}, {"crook_lamp", 0.2f, 0.2f},
    {"subway_stairs", 2.15f, 0.9f},
};

Vec2f AxisX(const Footprint& f) { return {std::cos(f.yaw), std::sin(f.yaw)}; }
Vec2f AxisY(const Footprint& f) { return {-std::sin(f.yaw), std::cos(f.yaw)}; }

// Half length of the projection of a footprint on a unit axis.
float Reach(const Footprint& f, Vec2f axis) { return f.half.x * std::abs(Dot(AxisX(f), axis)) + f.half.y * std::abs(Dot(AxisY(f), axis)); }

int64_t CellKey(int x, int y) { return (static_cast<int64_t>(x) << 32) ^ static_cast<uint32_t>(y); }

}  // namespace

bool Footprint::Overlaps(const Footprint& other) const {
  // Separating axes: the four edge directions.
  const Vec2f between = other.center - center;
  for (Vec2f axis : {AxisX(*this), AxisY(*this), AxisX(other), AxisY(other)}) {
    if (std::abs(Dot(between, axis)) >= Reach(*this, axis) + Reach(other, axis)) return false;
  }
  return true;
}

bool Footprint::Contains(Vec2f p) const {
  const Vec2f v = p - center;
  return std::abs(Dot(v, AxisX(*this))) <= half.x && std::abs(Dot(v, AxisY(*this))) <= half.y;
}

template <class Visit>
void Occupancy::ForCells(const Footprint& f, const Visit& visit) const {
  const float rx = Reach(f, {1, 0}), ry = Reach(f, {0, 1});
  const auto cell = [](float x) { return static_cast<int>(std::floor(x / kCell)); };
  for (int y = cell(f.center.y - ry); y <= cell(f.center.y + ry); ++y) {
    for (int x = cell(f.center.x - rx); x <= cell(f.center.x + rx); ++x) visit(CellKey(x, y));
  }
}

bool Occupancy::IsFree(const Footprint& footprint) const {
  bool free = true;
  ForCells(footprint, [&](int64_t key) {
    const auto it = cells_.find(key);
    if (!free || it == cells_.end()) return;
    free = std::none_of(it->second.begin(), it->second.end(), [&](uint32_t i) { return all_[i].Overlaps(footprint); });
  });
  return free;
}

void Occupancy::Add(const Footprint& footprint) {
  const auto index = static_cast<uint32_t>(all_.size());
  all_.push_back(footprint);
  ForCells(footprint, [&](int64_t key) { cells_[key].push_back(index); });
}

Footprint FootprintOf(std::string_view kind, Vec2f at, float yaw, float scale) {
  for (const Extent& e : kExtents) {
    if (e.kind == kind) return {at, Vec2f{e.half_x, e.half_y} * scale, yaw};
  }
  // The square in the circle of the kind's radius, a little rounded up.
  const float r = FindPropKind(kind).footprint_radius * 0.8f * scale;
  return {at, {r, r}, yaw};
}

std::optional<EntityId> Placer::Try(std::string_view kind, Vec3f p, float yaw, float scale, Vec3f tint, std::optional<uint32_t> variant,
                                    Engine engine) {
  const Footprint footprint = FootprintOf(kind, {p.x, p.y}, yaw, scale);
  if (!occupancy_.IsFree(footprint)) return std::nullopt;
  occupancy_.Add(footprint);
  const EntityId entity = shelf_.Place(kind, p, yaw, Pick(kind, variant), scale, tint, engine);
  placements_.push_back({FindPropKind(kind).name, entity, p, footprint});
  return entity;
}

EntityId Placer::Put(std::string_view kind, Vec3f p, float yaw, float scale, Vec3f tint, std::optional<uint32_t> variant) {
  occupancy_.Add(FootprintOf(kind, {p.x, p.y}, yaw, scale));
  return shelf_.Place(kind, p, yaw, Pick(kind, variant), scale, tint);
}

uint32_t Placer::Pick(std::string_view kind, std::optional<uint32_t> variant) {
  if (variant) return *variant;
  return rng_.Index(static_cast<uint32_t>(FindPropKind(kind).variants));
}

}  // namespace airsim360

#include "airsim360/assets/viewpoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace airsim360::internal {
namespace {

constexpr float kEyeHeight = 1.7f;
constexpr int kGrid = 9;

// Vertical probes over the middle of the scene: height of the top surface below the sky at each.
class Probes {
 public:
  explicit Probes(const Box3f& bounds) {
    const Vec3f size = bounds.size();
    for (int j = 0; j < kGrid; ++j) {
      for (int i = 0; i < kGrid; ++i) {
        // Slightly off the lines of symmetry, where edges are likely.
        points_.push_back({bounds.center().x + size.x * (0.6f * (static_cast<float>(i) + 0.503f) / kGrid - 0.3f),
                           bounds.center().y + size.y * (0.6f * (static_cast<float>(j) + 0.497f) / kGrid - 0.3f)});
      }
    }
    tops_.assign(points_.size(), -std::numeric_limits<float>::infinity());
    for (Vec2f p : points_) {
      area_.Add(Vec3f{p.x, p.y, 0});
    }
  }

  void Hit(const std::array<Vec3f, 3>& t) {
    const auto [min_x, max_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [min_y, max_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    if (max_x < area_.min.x || min_x > area_.max.x || max_y < area_.min.y || min_y > area_.max.y) return;
    for (size_t i = 0; i < points_.size(); ++i) {
      // Barycentric coordinates of the probe in the triangle's plan.
      const Vec2f p = points_[i];
      if (p.x < min_x || p.x > max_x || p.y < min_y || p.y > max_y) continue;
      const float d = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
      const float u = ((p.x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (p.y - t[0].y)) / d;
      const float v = ((t[1].x - t[0].x) * (p.y - t[0].y) - (p.x - t[0].x) * (t[1].y - t[0].y)) / d;
      if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
      tops_[i] = std::max(tops_[i], t[0].z + u * (t[1].z - t[0].z) + v * (t[2].z - t[0].z));
    }
  }

  // The probe with the lowest top surface, the one nearest the middle among equals (to 0.25 m).
  std::optional<Vec3f> LowestOpenGround(const Box3f& bounds) const {
    std::optional<size_t> best;
    const auto rank = [&](size_t i) {
      const Vec2f off = points_[i] - Vec2f{bounds.center().x, bounds.center().y};
      return std::pair(std::floor(tops_[i] * 4), off.x * off.x + off.y * off.y);
    };
    for (size_t i = 0; i < points_.size(); ++i) {
      if (std::isfinite(tops_[i]) && (!best || rank(i) < rank(*best))) best = i;
    }
    if (!best) return std::nullopt;
    return Vec3f{points_[*best].x, points_[*best].y, tops_[*best]};
  }

 private:
  std::vector<Vec2f> points_;
  std::vector<float> tops_;
  Box3f area_;
};

}  // namespace

Vec3f ChooseViewpoint(const std::vector<Mesh>& meshes, const std::vector<Instance>& instances, const Box3f& bounds) {
  const Vec3f size = bounds.size();
  const float radius = 0.5f * Norm(size);
  if (std::max(size.x, size.y) < 20) {
    // A thing: all of it within some 60 degrees, from a little above its middle.
    return bounds.center() + Vec3f{0, -(0.5f * size.y + std::max(1.2f * radius, 0.05f)), 0.1f * size.z};
  }
  Probes probes(bounds);
  for (const Instance& instance : instances) {
    const Mesh& mesh = meshes[instance.mesh];
    for (const Vec3u& t : mesh.triangles) {
      probes.Hit({instance.X_WM * mesh.positions[t.x], instance.X_WM * mesh.positions[t.y], instance.X_WM * mesh.positions[t.z]});
    }
  }
  const std::optional<Vec3f> ground = probes.LowestOpenGround(bounds);
  return ground ? *ground + Vec3f{0, 0, kEyeHeight} : Vec3f{bounds.center().x, bounds.center().y, bounds.max.z + kEyeHeight};
}

}  // namespace airsim360::internal

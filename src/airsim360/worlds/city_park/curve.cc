#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "airsim360/worlds/city_park/layout.h"

namespace airsim360::internal::park {

Curve::Curve(std::span<const Vec2f> control, float step) {
  for (size_t i = 0; i + 1 < control.size(); ++i) {
    const Vec2f b = control[i], c = control[i + 1];
    const Vec2f a = control[i > 0 ? i - 1 : 0], d = control[std::min(i + 2, control.size() - 1)];
    const int n = std::max(1, static_cast<int>(std::hypot(c.x - b.x, c.y - b.y) / step));
    for (int k = 0; k < n; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(n);
      points_.push_back(
          (b * 2.0f + (c - a) * t + (a * 2.0f - b * 5.0f + c * 4.0f - d) * (t * t) + (b * 3.0f - a - c * 3.0f + d) * (t * t * t)) * 0.5f);
    }
  }
  points_.push_back(control.back());
  Index();
}

Curve::Curve(std::vector<Vec2f> points) : points_(std::move(points)) { Index(); }

void Curve::Index() {
  s_.assign(1, 0.0f);
  for (size_t i = 1; i < points_.size(); ++i) {
    const Vec2f v = points_[i] - points_[i - 1];
    s_.push_back(s_.back() + std::hypot(v.x, v.y));
  }
  low_ = high_ = points_.front();
  for (Vec2f p : points_) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  // Circles around runs of segments let Distance skip most of the line.
  constexpr size_t kRun = 16;
  for (size_t first = 0; first + 1 < points_.size(); first += kRun) {
    const size_t last = std::min(first + kRun, points_.size() - 1);
    const Vec2f center = (points_[first] + points_[last]) * 0.5f;
    float radius = 0;
    for (size_t i = first; i <= last; ++i) radius = std::max(radius, std::hypot(points_[i].x - center.x, points_[i].y - center.y));
    chunks_.push_back({center, radius, first, last});
  }
}

float Curve::Within(Vec2f p) const {
  const Chunk* nearest = nullptr;
  float least = std::numeric_limits<float>::max();
  for (const Chunk& chunk : chunks_) {
    const Vec2f to = p - chunk.center;
    const float square = to.x * to.x + to.y * to.y;
    if (square < least) least = square, nearest = &chunk;
  }
  // A little more, for what rounding takes.
  return nearest == nullptr ? least : (std::sqrt(least) + nearest->radius) * 1.0001f + 1e-3f;
}

Curve::Nearest Curve::Find(Vec2f p) const {
  Nearest best{1e9f, 0, 0};
  const float within = Within(p);
  for (const Chunk& chunk : chunks_) {
    if (std::hypot(p.x - chunk.center.x, p.y - chunk.center.y) - chunk.radius >= std::min(best.distance, within)) continue;
    for (size_t i = chunk.first; i < chunk.last; ++i) {
      const Vec2f a = points_[i], v = points_[i + 1] - a, w = p - a;
      const float length2 = v.x * v.x + v.y * v.y;
      const float t = std::clamp((w.x * v.x + w.y * v.y) / length2, 0.0f, 1.0f);
      const Vec2f d = w - v * t;
      const float distance = std::sqrt(d.x * d.x + d.y * d.y);
      if (distance >= best.distance) continue;
      const float hand = v.x * w.y - v.y * w.x;
      best = {distance, s_[i] + t * std::sqrt(length2), hand < 0 ? -distance : distance};
    }
  }
  return best;
}

float Curve::Distance(Vec2f p, float limit) const {
  float best = limit;
  const float outside_x = std::max({low_.x - p.x, 0.0f, p.x - high_.x}), outside_y = std::max({low_.y - p.y, 0.0f, p.y - high_.y});
  if (outside_x * outside_x + outside_y * outside_y >= best * best) return best;
  const float within = Within(p);
  for (const Chunk& chunk : chunks_) {
    const Vec2f to = p - chunk.center;
    const float reach = std::min(best, within) + chunk.radius;
    if (to.x * to.x + to.y * to.y >= reach * reach) continue;
    for (size_t i = chunk.first; i < chunk.last; ++i) {
      const Vec2f a = points_[i], v = points_[i + 1] - a, w = p - a;
      const float t = std::clamp((w.x * v.x + w.y * v.y) / (v.x * v.x + v.y * v.y), 0.0f, 1.0f);
      const Vec2f d = w - v * t;
      best = std::min(best, std::sqrt(d.x * d.x + d.y * d.y));
    }
  }
  return best;
}

size_t Curve::Segment(float s) const {
  const auto it = std::upper_bound(s_.begin(), s_.end(), s);
  const auto i = static_cast<size_t>(std::max<std::ptrdiff_t>(1, it - s_.begin())) - 1;
  return std::min(i, points_.size() - 2);
}

Vec2f Curve::Along(float s) const {
  // Between the directions of the segments that meet at the ends of this one.
  const size_t i = Segment(s);
  const auto direction = [&](size_t k) {
    const Vec2f v = points_[k + 1] - points_[k];
    return v * (1 / std::hypot(v.x, v.y));
  };
  const Vec2f here = direction(i), before = direction(i > 0 ? i - 1 : 0), after = direction(std::min(i + 1, points_.size() - 2));
  const float t = std::clamp((s - s_[i]) / (s_[i + 1] - s_[i]), 0.0f, 1.0f);
  const Vec2f a = (before + here) * 0.5f, b = (here + after) * 0.5f, v = a + (b - a) * t;
  return v * (1 / std::hypot(v.x, v.y));
}

Vec2f Curve::At(float s, float side) const {
  const size_t i = Segment(s);
  const float t = (s - s_[i]) / (s_[i + 1] - s_[i]);
  const Vec2f p = points_[i] + (points_[i + 1] - points_[i]) * t;
  const Vec2f v = Along(s);
  return p + Vec2f{-v.y, v.x} * side;
}

}  // namespace airsim360::internal::park

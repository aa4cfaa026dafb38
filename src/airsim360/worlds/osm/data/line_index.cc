#include "airsim360/worlds/osm/data/line_index.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr double kCell = 16;         // metres
constexpr double kMaxCells = 40000;  // a box takes at most; larger ones are kept apart

int64_t Key(int64_t x, int64_t y) { return x * 0x100000000ll ^ (y & 0xffffffffll); }
int64_t CellOf(double x) { return static_cast<int64_t>(std::floor(std::clamp(x, -1e6, 1e6) / kCell)); }

bool IsLarge(const Bounds2d& box) { return ((box.max.x - box.min.x) / kCell + 2) * ((box.max.y - box.min.y) / kCell + 2) > kMaxCells; }

template <class Visit>
void ForCells(const Bounds2d& box, const Visit& visit) {
  for (int64_t y = CellOf(box.min.y); y <= CellOf(box.max.y); ++y)
    for (int64_t x = CellOf(box.min.x); x <= CellOf(box.max.x); ++x) visit(Key(x, y));
}

}  // namespace

void LineIndex::Add(Vec2d a, Vec2d b, uint32_t owner) {
  // Long pieces in parts, so that their boxes stay small.
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int parts = std::clamp(static_cast<int>(length / (2 * kCell)), 1, 4000);
  for (int i = 0; i < parts; ++i) {
    const Vec2d p = a + (b - a) * (static_cast<double>(i) / parts), q = a + (b - a) * ((i + 1.0) / parts);
    const auto index = static_cast<uint32_t>(pieces_.size());
    pieces_.push_back({p, q, owner});
    Bounds2d box;
    box.Add(p);
    box.Add(q);
    ForCells(box, [&](int64_t key) { cells_[key].push_back(index); });
  }
}

void LineIndex::AddRing(const Ring& ring, uint32_t owner) {
  for (size_t i = 0; i < ring.size(); ++i) Add(ring[i], ring[(i + 1) % ring.size()], owner);
}

LineIndex::Near LineIndex::Find(Vec2d p, double radius, uint32_t except) const {
  Near best;
  Bounds2d box{{p.x - radius, p.y - radius}, {p.x + radius, p.y + radius}};
  ForCells(box, [&](int64_t key) {
    const auto it = cells_.find(key);
    if (it == cells_.end()) return;
    for (uint32_t i : it->second) {
      const Piece& piece = pieces_[i];
      if (piece.owner == except) continue;
      const Vec2d v = piece.b - piece.a, w = p - piece.a;
      const double length2 = std::max(v.x * v.x + v.y * v.y, 1e-12);
      const double t = std::clamp((w.x * v.x + w.y * v.y) / length2, 0.0, 1.0);
      const Vec2d q = piece.a + v * t;
      const double distance = std::hypot(p.x - q.x, p.y - q.y);
      if (distance > radius || distance > best.distance) continue;
      if (distance == best.distance && piece.owner >= best.owner) continue;
      best = {distance, piece.owner, q, v * (1 / std::sqrt(length2))};
    }
  });
  return best;
}

void BoxIndex::Add(const Bounds2d& box, uint32_t owner) {
  const auto index = static_cast<uint32_t>(boxes_.size());
  boxes_.emplace_back(box, owner);
  if (!(box.min.x <= box.max.x)) return;
  if (IsLarge(box)) {
    large_.push_back(index);
    return;
  }
  ForCells(box, [&](int64_t key) { cells_[key].push_back(index); });
}

std::vector<uint32_t> BoxIndex::Find(const Bounds2d& box) const {
  std::vector<uint32_t> found;
  const auto take = [&](uint32_t i) {
    if (boxes_[i].first.Overlaps(box)) found.push_back(i);
  };
  for (uint32_t i : large_) take(i);
  if (IsLarge(box)) {
    for (uint32_t i = 0; i < boxes_.size(); ++i) take(i);
  } else if (box.min.x <= box.max.x) {
    ForCells(box, [&](int64_t key) {
      const auto it = cells_.find(key);
      if (it == cells_.end()) return;
      for (uint32_t i : it->second) take(i);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (uint32_t& i : found) i = boxes_[i].second;
  return found;
}

}  // namespace airsim360::internal

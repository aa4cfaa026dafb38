#include "airsim360/worlds/kit/drape.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "airsim360/worlds/kit/vertex_welder.h"

namespace airsim360 {
namespace {

struct Corner {
  Vec3f p, n;
  Vec2f uv;
};
using Piece = std::vector<Corner>;

Corner Between(const Corner& a, const Corner& b, float t) {
  return {a.p + (b.p - a.p) * t, a.n + (b.n - a.n) * t, a.uv + (b.uv - a.uv) * t};
}

// The part of a convex piece where side(corner) >= 0; `snap` moves a cut exactly onto the line.
template <class Side, class Snap>
Piece Clip(const Piece& piece, const Side& side, const Snap& snap) {
  Piece kept;
  for (size_t i = 0; i < piece.size(); ++i) {
    const Corner &a = piece[i], &b = piece[(i + 1) % piece.size()];
    const float sa = side(a), sb = side(b);
    if (sa >= 0) kept.push_back(a);
    if ((sa < 0) == (sb < 0) || sa == 0 || sb == 0) continue;
    // From the lower end on, so that neighbours cut their common edge in the same point.
    Corner cut = std::pair(a.p.x, a.p.y) < std::pair(b.p.x, b.p.y) ? Between(a, b, sa / (sa - sb)) : Between(b, a, sb / (sb - sa));
    snap(cut);
    kept.push_back(cut);
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

// Visits the slices of a piece between the lines of one axis: visit(index of the slice, slice).
template <class Visit>
void Slice(const Piece& piece, const std::vector<float>& lines, int axis, const Visit& visit) {
  const auto at = [axis](const Corner& c) { return c.p[axis]; };
  float low = at(piece[0]), high = low;
  for (const Corner& c : piece) low = std::min(low, at(c)), high = std::max(high, at(c));
  const auto index = [&](float x) {
    const auto it = std::upper_bound(lines.begin(), lines.end(), x);
    return static_cast<size_t>(std::clamp<std::ptrdiff_t>(it - lines.begin() - 1, 0, static_cast<std::ptrdiff_t>(lines.size()) - 2));
  };
  const size_t first = index(low), last = index(high);
  Piece rest = piece;
  for (size_t i = first; i < last && !rest.empty(); ++i) {
    const float line = lines[i + 1];
    const auto snap = [&](Corner& c) { c.p[axis] = line; };
    const Piece slice = Clip(
        rest, [&](const Corner& c) { return line - at(c); }, snap);
    rest = Clip(
        rest, [&](const Corner& c) { return at(c) - line; }, snap);
    if (!slice.empty()) visit(i, slice);
  }
  if (!rest.empty()) visit(last, rest);
}

Vec3f Unit(Vec3f v, Vec3f otherwise) {
  const float l = Norm(v);
  return l > 1e-12f ? v / l : otherwise;
}

}  // namespace

Drape::Drape(std::vector<float> xs, std::vector<float> ys, const std::function<Vec3f(Vec2f)>& ground)
    : xs_(std::move(xs)), ys_(std::move(ys)), nodes_(xs_.size() * ys_.size()) {
  const size_t w = xs_.size(), h = ys_.size();
  for (size_t j = 0; j < h; ++j)
    for (size_t i = 0; i < w; ++i) nodes_[j * w + i].p = ground({xs_[i], ys_[j]});
  for (size_t j = 0; j < h; ++j) {
    for (size_t i = 0; i < w; ++i) {
      const size_t west = i > 0 ? i - 1 : i, east = std::min(i + 1, w - 1), south = j > 0 ? j - 1 : j, north = std::min(j + 1, h - 1);
      Node& node = nodes_[j * w + i];
      node.dx = (nodes_[j * w + east].p - nodes_[j * w + west].p) / (xs_[east] - xs_[west]);
      node.dy = (nodes_[north * w + i].p - nodes_[south * w + i].p) / (ys_[north] - ys_[south]);
    }
  }
}

size_t Drape::Column(float x) const {
  const auto it = std::upper_bound(xs_.begin() + 1, xs_.end() - 1, x);
  return static_cast<size_t>(it - xs_.begin()) - 1;
}

size_t Drape::Row(float y) const {
  const auto it = std::upper_bound(ys_.begin() + 1, ys_.end() - 1, y);
  return static_cast<size_t>(it - ys_.begin()) - 1;
}

// Barycentric weights in the upper left or lower right triangle of a cell.
Drape::Weights Drape::Locate(Vec2f p, size_t i, size_t j, bool upper) const {
  const size_t w = xs_.size(), at = j * w + i;
  const float s = (p.x - xs_[i]) / (xs_[i + 1] - xs_[i]), t = (p.y - ys_[j]) / (ys_[j + 1] - ys_[j]);
  if (upper) return {{at, at + w, at + w + 1}, {1 - t, t - s, s}};
  return {{at, at + 1, at + w + 1}, {1 - s, s - t, t}};
}

Drape::Weights Drape::Locate(Vec2f p) const {
  const size_t i = Column(p.x), j = Row(p.y);
  const float s = (p.x - xs_[i]) / (xs_[i + 1] - xs_[i]), t = (p.y - ys_[j]) / (ys_[j + 1] - ys_[j]);
  return Locate(p, i, j, t > s);
}

Drape::Node Drape::Mix(const Weights& m) const {
  Node node{};
  for (int k = 0; k < 3; ++k) {
    const Node& from = nodes_[m.node[k]];
    node.p = node.p + from.p * m.w[k];
    node.dx = node.dx + from.dx * m.w[k];
    node.dy = node.dy + from.dy * m.w[k];
  }
  return node;
}

Vec3f Drape::At(Vec3f p) const { return Mix(Locate({p.x, p.y})).p + Vec3f{0, 0, p.z}; }

AffineTransform Drape::Frame(Vec2f p) const {
  const Node node = Mix(Locate(p));
  return {Mat3f::FromColumns(node.dx, node.dy, {0, 0, 1}), node.p};
}

Mesh Drape::Lay(const Mesh& flat) const {
  Mesh laid;
  laid.name = flat.name;
  constexpr Vec3f kUp{0, 0, 1};
  // Most corners belong to several pieces.
  std::optional<internal::VertexWelder> welder;
  std::vector<uint32_t> corners;
  const auto emit = [&](const Piece& piece, size_t i, size_t j, bool upper) {
    corners.clear();
    for (const Corner& c : piece) {
      const Node node = Mix(Locate({c.p.x, c.p.y}, i, j, upper));
      // Normals turn with the cofactors of the frame.
      const Vec3f n = Cross(node.dy, kUp) * c.n.x + Cross(kUp, node.dx) * c.n.y + Cross(node.dx, node.dy) * c.n.z;
      corners.push_back(welder->Add(node.p + Vec3f{0, 0, c.p.z}, Unit(n, kUp), c.uv));
    }
    for (size_t k = 1; k + 1 < corners.size(); ++k) laid.triangles.push_back({corners[0], corners[k], corners[k + 1]});
  };
  const auto split = [&](const Piece& piece) {
    Slice(piece, xs_, 0, [&](size_t i, const Piece& strip) {
      Slice(strip, ys_, 1, [&](size_t j, const Piece& cell) {
        const float x = xs_[i], y = ys_[j], kx = 1 / (xs_[i + 1] - x), ky = 1 / (ys_[j + 1] - y);
        const auto above = [&](const Corner& c) { return (c.p.y - y) * ky - (c.p.x - x) * kx; };
        const auto keep = [](Corner&) {};
        const Piece upper = Clip(cell, above, keep), lower = Clip(
                                                         cell, [&](const Corner&c) { return -above(c); }, keep);
        if (!upper.empty()) emit(upper, i, j, true);
        // What stands on the diagonal itself (a wall) is in both.
        const bool on_line = std::all_of(cell.begin(), cell.end(), [&](const Corner& c) { return above(c) == 0; });
        if (!lower.empty() && !on_line) emit(lower, i, j, false);
      });
    });
  };
  for (const MeshPart& part : flat.parts) {
    welder.emplace(laid);
    const auto first = static_cast<uint32_t>(laid.triangles.size());
    for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      Piece piece;
      for (uint32_t v : {flat.triangles[t].x, flat.triangles[t].y, flat.triangles[t].z})
        piece.push_back({flat.positions[v], flat.normals[v], flat.uvs[v]});
      split(piece);
    }
    const auto count = static_cast<uint32_t>(laid.triangles.size()) - first;
    if (count > 0) laid.parts.push_back({first, count, part.material, part.entity});
  }
  return laid;
}

}  // namespace airsim360

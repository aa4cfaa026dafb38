#include "airsim360/people/behaviour/seats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

namespace airsim360::internal {
namespace {

constexpr double kPlaceWidth = 0.6;                    // of a sofa or bench for one
constexpr double kLowest = 0.34, kHighest = 0.56;      // metres: seats from which feet reach the floor
constexpr double kSpacing = 0.025;                     // of the points that stand for a surface
constexpr double kBehindHips = 0.175;                  // metres from the hips to a back rest, flesh and clothes included
constexpr double kThighOnSeat = 0.30;                  // from the hips to the edge of a seat that is deeper
constexpr double kReachOfFeet = 0.43;                  // from the hips to the point between the feet
constexpr double kTrunk = 0.14, kFarthestDesk = 0.36;  // the belly, and the edge of a table that hands lie on, before the hips

constexpr size_t kMostPoints = 1'000'000;  // of one piece of furniture
constexpr float kLargestPiece = 50;        // metres: what is longer is no furniture

/// A point of a surface and how much of it that stands for.
struct SurfacePoint {
  Vec3d p;
  double area = 0;
  bool level = false;
};

using Corners = std::array<Vec3d, 3>;

struct LocalBox {
  Vec3d min, max;
};

/// Whether a triangle and a box have a point in common (separating axes).
bool Touch(const Corners& t, const LocalBox& box) {
  const Vec3d centre = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
  const Corners v{t[0] - centre, t[1] - centre, t[2] - centre};
  const auto apart = [&](Vec3d axis) {
    const double a = Dot(axis, v[0]), b = Dot(axis, v[1]), c = Dot(axis, v[2]);
    const double r = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    return std::min({a, b, c}) > r || std::max({a, b, c}) < -r;
  };
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3d& axis : axes)
    if (apart(axis)) return false;
  const Vec3d edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  if (apart(Cross(edges[0], edges[1]))) return false;
  for (const Vec3d& edge : edges)
    for (const Vec3d& axis : axes)
      if (apart(Cross(edge, axis))) return false;
  return true;
}

/// The frame of a seat: origin on the floor, x to the front, y to the left.
struct SeatFrame {
  Vec3d origin;
  Vec2d front{1, 0};
  Vec3d In(Vec3d p) const {
    const Vec3d d = p - origin;
    return {d.x * front.x + d.y * front.y, d.y * front.x - d.x * front.y, d.z};
  }
  Vec3d Out(Vec3d p) const { return origin + Vec3d{front.x * p.x - front.y * p.y, front.y * p.x + front.x * p.y, p.z}; }
};

void AddPoints(const Corners& t, std::vector<SurfacePoint>& points) {
  const Vec3d normal = Cross(t[1] - t[0], t[2] - t[0]);
  const double area = 0.5 * Norm(normal);
  if (area < 1e-10) return;
  const int n = static_cast<int>(std::clamp(std::ceil(std::sqrt(2 * area) / kSpacing), 1.0, 80.0));
  const bool level = std::abs(normal.z) > 0.8 * 2 * area;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 2 * i + 1; ++k) {
      // The middles of n * n equal triangles.
      const double u = (i + (k % 2 ? 1.0 / 3 : 2.0 / 3)) / n;
      const double w = (k / 2 + (k % 2 ? 2.0 / 3 : 1.0 / 3)) / n;
      points.push_back({t[0] + (t[1] - t[0]) * (u - w) + (t[2] - t[0]) * w, area / (n * n), level});
    }
  }
}

/// Whether nothing of a seat lies over a point, up to where the lowest arm rests begin.
class TopSurface {
 public:
  explicit TopSurface(const std::vector<SurfacePoint>& points) {
    for (const SurfacePoint& s : points)
      if (s.p.z < kHighest) top_[CellOf(s.p)] = std::max(top_[CellOf(s.p)], s.p.z);
  }
  bool Has(const SurfacePoint& s) const {
    const auto found = top_.find(CellOf(s.p));
    return found != top_.end() && s.p.z > found->second - 0.012;
  }

 private:
  static std::pair<int, int> CellOf(Vec3d p) {
    constexpr double kCell = 0.04;
    return {static_cast<int>(std::floor(p.x / kCell)), static_cast<int>(std::floor(p.y / kCell))};
  }
  std::map<std::pair<int, int>, double> top_;
};

/// Height of the level surface that is open above and that the points have most of between the lowest and the highest seat.
std::optional<double> SeatHeight(const std::vector<SurfacePoint>& points) {
  constexpr int kBins = 24;
  constexpr double kLeast = 0.03;  // square metres
  const TopSurface top(points);
  std::array<double, kBins> area{};
  const double step = (kHighest - kLowest) / kBins;
  for (const SurfacePoint& s : points) {
    if (!s.level || s.p.z < kLowest || s.p.z >= kHighest || !top.Has(s)) continue;
    area[std::min<size_t>(static_cast<size_t>((s.p.z - kLowest) / step), kBins - 1)] += s.area;
  }
  double best = 0, height = 0;
  for (int i = 0; i + 2 < kBins; ++i) {
    const double sum = area[static_cast<size_t>(i)] + area[static_cast<size_t>(i) + 1] + area[static_cast<size_t>(i) + 2];
    if (sum > best) best = sum, height = kLowest + (i + 2) * step;
  }
  if (best < kLeast) return std::nullopt;
  return height;
}

bool IsTable(std::string_view path) {
  return path.starts_with("furniture/desk") || path.starts_with("furniture/table") || path.starts_with("furniture/counter");
}

}  // namespace

bool IsSeat(std::string_view path) {
  for (const std::string_view prefix : {"furniture/seating/chair", "furniture/seating/office_chair", "furniture/seating/armchair",
                                        "furniture/seating/bench", "furniture/sofa"})
    if (path.starts_with(prefix)) return true;
  return false;
}

/// Which parts of which instances a piece of furniture is made of, and boxes of the parts of all instances.
struct SeatFinder::Index {
  struct PartBox {
    Box3f box;  ///< around the corners of the part's own box
    size_t instance = 0, part = 0;
  };

  explicit Index(const Scene& s) : scene(s) {
    std::vector<std::vector<Box3f>> of_mesh;
    for (const Mesh& mesh : scene.meshes) of_mesh.push_back(BoxesOf(mesh));
    for (size_t i = 0; i < scene.instances.size(); ++i) {
      const Instance& instance = scene.instances[i];
      const Mesh& mesh = scene.meshes[instance.mesh];
      for (size_t k = 0; k < mesh.parts.size(); ++k) {
        const Box3f& own = of_mesh[instance.mesh][k];
        if (own.empty()) continue;
        const EntityId entity = EntityOf(instance, mesh.parts[k]);
        const std::string_view path = PathOf(entity);
        if (path.starts_with("vegetation")) continue;  // people sit below leaves, and push twigs aside
        Box3f box;
        for (int c = 0; c < 8; ++c)
          box.Add(instance.X_WM * Vec3f{c & 1 ? own.max.x : own.min.x, c & 2 ? own.max.y : own.min.y, c & 4 ? own.max.z : own.min.z});
        boxes.push_back({box, i, k});
        if (IsSeat(path)) parts[entity].emplace_back(i, k);
      }
    }
  }

  static EntityId EntityOf(const Instance& instance, const MeshPart& part) {
    return part.entity != kNoEntity ? part.entity : instance.entity;
  }

  /// Category of an entity; empty where there is none.
  std::string_view PathOf(EntityId entity) const {
    return entity == kNoEntity ? std::string_view() : std::string_view(scene.tree[scene.entity(entity).category].path);
  }

  static std::vector<Box3f> BoxesOf(const Mesh& mesh) {
    std::vector<Box3f> found;
    for (const MeshPart& part : mesh.parts) {
      Box3f& box = found.emplace_back();
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t)
        for (int k = 0; k < 3; ++k) box.Add(mesh.positions[mesh.triangles[t][k]]);
    }
    return found;
  }

  Corners At(const Instance& instance, uint32_t triangle) const {
    const Mesh& mesh = scene.meshes[instance.mesh];
    Corners t;
    for (size_t k = 0; k < 3; ++k) t[k] = VecCast<double>(instance.X_WM * mesh.positions[mesh.triangles[triangle][k]]);
    return t;
  }

  /// Everything of other things within `reach` of a place, in the frame of a seat, until f(category path, corners) is false.
  template <class F>
  void Around(EntityId self, const SeatFrame& frame, double reach, const F& f) const {
    Box3f near;
    near.Add(VecCast<float>(frame.origin - Vec3d{reach, reach, -0.05}));
    near.Add(VecCast<float>(frame.origin + Vec3d{reach, reach, 1.6}));
    const auto apart = [&](Vec3f low, Vec3f high) {
      return low.x > near.max.x || high.x < near.min.x || low.y > near.max.y || high.y < near.min.y || low.z > near.max.z ||
             high.z < near.min.z;
    };
    for (const PartBox& candidate : boxes) {
      if (apart(candidate.box.min, candidate.box.max)) continue;
      const Instance& instance = scene.instances[candidate.instance];
      const Mesh& mesh = scene.meshes[instance.mesh];
      const MeshPart& part = mesh.parts[candidate.part];
      const EntityId entity = EntityOf(instance, part);
      if (entity == self) continue;
      const std::string_view path = PathOf(entity);
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        Box3f box;
        for (int k = 0; k < 3; ++k) box.Add(instance.X_WM * mesh.positions[mesh.triangles[t][k]]);
        if (apart(box.min, box.max)) continue;
        const Corners corners = At(instance, t);
        if (!f(path, Corners{frame.In(corners[0]), frame.In(corners[1]), frame.In(corners[2])})) return;
      }
    }
  }

  std::vector<SurfacePoint> PointsOf(EntityId furniture, Vec3d origin) const {
    std::vector<SurfacePoint> points;
    const auto found = parts.find(furniture);
    if (found == parts.end()) return points;
    for (const auto& [i, k] : found->second) {
      const Instance& instance = scene.instances[i];
      const MeshPart& part = scene.meshes[instance.mesh].parts[k];
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count && points.size() < kMostPoints; ++t) {
        Corners corners = At(instance, t);
        for (Vec3d& p : corners) p = p - origin;
        AddPoints(corners, points);
      }
    }
    return points;
  }

  /// Away from the back rest, along an axis of the model if one fits; `otherwise` without one.
  Vec2d Front(EntityId furniture, const std::vector<SurfacePoint>& points, double height, Vec2d otherwise) const {
    Vec3d seat, back;
    double on_seat = 0, on_back = 0;
    for (const SurfacePoint& s : points) {
      if (s.level && std::abs(s.p.z - height) < 0.04) seat += s.p * s.area, on_seat += s.area;
      if (s.p.z > height + 0.15 && s.p.z < height + 0.6) back += s.p * s.area, on_back += s.area;
    }
    Vec2d front = otherwise;
    if (on_back > 0.02 && on_seat > 0) {
      const Vec3d d = seat * (1 / on_seat) - back * (1 / on_back);
      if (std::hypot(d.x, d.y) > 0.05) front = {d.x, d.y};
    }
    const double length = std::hypot(front.x, front.y);
    if (length < 1e-6) return {};
    front = front * (1 / length);
    const AffineTransform& X = scene.instances[parts.at(furniture).front().first].X_WM;
    for (const int column : {0, 1, 2}) {
      Vec2d axis{X.A.m[0][column], X.A.m[1][column]};
      const double size = std::hypot(axis.x, axis.y);
      if (size < 1e-6) continue;
      axis = axis * (1 / size);
      const double along = axis.x * front.x + axis.y * front.y;
      if (std::abs(along) > 0.9) return axis * (along < 0 ? -1.0 : 1.0);
    }
    return front;
  }

  /// Whether somebody whose hips are above the origin has room; then also the table before them.
  bool HasRoom(EntityId self, const SeatFrame& frame, Seating& seating) const {
    const double h = seating.height;
    const LocalBox boxes_of_body[] = {{{-0.16, -0.23, h + 0.08}, {kTrunk, 0.23, h + 0.80}},                  // trunk
                                      {{0.0, -0.18, h + 0.0}, {kReachOfFeet + 0.10, 0.18, h + 0.155}},       // thighs, knees
                                      {{kReachOfFeet - 0.12, -0.17, 0.03}, {kReachOfFeet + 0.2, 0.17, h}}};  // shanks, feet
    const LocalBox before{{kTrunk, -0.12, h + 0.14}, {0.5, 0.12, h + 0.42}};
    bool room = true;
    double top = 0, edge = 1;
    Around(self, frame, 0.9, [&](std::string_view path, const Corners& t) {
      for (const LocalBox& box : boxes_of_body) room = room && !Touch(t, box);
      const Vec3d normal = Cross(t[1] - t[0], t[2] - t[0]);
      if (!room || !IsTable(path) || std::abs(normal.z) < 0.95 * Norm(normal) || !Touch(t, before)) return room;
      top = std::max({top, t[0].z, t[1].z, t[2].z});
      edge = std::min({edge, t[0].x, t[1].x, t[2].x});
      return true;
    });
    if (top > 0 && edge < kFarthestDesk) seating.desk = top;
    return room;
  }

  const Scene& scene;
  std::vector<PartBox> boxes;
  std::map<EntityId, std::vector<std::pair<size_t, size_t>>> parts;
};

SeatFinder::SeatFinder(const Scene& scene) : index_(std::make_unique<const Index>(scene)) {}
SeatFinder::~SeatFinder() = default;

std::vector<Seat> SeatFinder::Seats(EntityId furniture, Vec2d front) const {
  const Box3f& bounds = index_->scene.entity(furniture).bounds;
  const Vec3f size = bounds.size();
  if (!(std::max({size.x, size.y, size.z}) < kLargestPiece)) return {};
  SeatFrame piece{{bounds.center().x, bounds.center().y, bounds.min.z}, {}};
  std::vector<SurfacePoint> points = index_->PointsOf(furniture, piece.origin);
  const std::optional<double> height = points.empty() ? std::nullopt : SeatHeight(points);
  if (!height) return {};
  piece.front = index_->Front(furniture, points, *height, front);
  if (piece.front.x == 0 && piece.front.y == 0) return {};
  double left = -1e9, right = 1e9;
  for (SurfacePoint& s : points) {
    s.p = piece.In(piece.origin + s.p);
    if (s.level && std::abs(s.p.z - *height) < 0.04) left = std::max(left, s.p.y), right = std::min(right, s.p.y);
  }
  const int count = static_cast<int>(std::clamp((left - right) / kPlaceWidth, 1.0, 6.0));
  std::vector<Seat> seats;
  for (int i = 0; i < count; ++i) {
    const double y = 0.5 * (left + right) + kPlaceWidth * (i - (count - 1) / 2.0);
    double edge = -1e9, rear = 1e9, back = -1e9;
    for (const SurfacePoint& s : points) {
      if (std::abs(s.p.y - y) > 0.15 || !s.level || std::abs(s.p.z - *height) > 0.04) continue;
      edge = std::max(edge, s.p.x), rear = std::min(rear, s.p.x);
    }
    for (const SurfacePoint& s : points)
      if (std::abs(s.p.y - y) < 0.2 && s.p.z > *height + 0.10 && s.p.z < *height + 0.45 && s.p.x < edge - 0.25)
        back = std::max(back, s.p.x);
    if (edge - rear < 0.2) continue;
    const double hips = std::max(back > -1e8 ? back + kBehindHips : rear + 0.10, edge - kThighOnSeat);
    if (edge - hips < 0.12) continue;
    Seat seat;
    seat.seating = {*height, kReachOfFeet, 0};
    const SeatFrame frame{piece.Out({hips, y, 0}), piece.front};
    if (!index_->HasRoom(furniture, frame, seat.seating)) continue;
    seat.feet = frame.Out({kReachOfFeet, 0, 0});
    seat.yaw = std::atan2(piece.front.y, piece.front.x);
    seats.push_back(seat);
  }
  return seats;
}

}  // namespace airsim360::internal

#include "airsim360/sim/people/silhouette.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

// Pixels that may see a triangle. Columns of panoramas count from the column of a reference direction, so that
// they may be negative or exceed the width.
struct Window {
  int x0 = 0, x1 = -1, y0 = 0, y1 = -1;  // inclusive
  bool empty() const { return x1 < x0 || y1 < y0; }
  void Add(const Window& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    x0 = std::min(x0, other.x0), x1 = std::max(x1, other.x1);
    y0 = std::min(y0, other.y0), y1 = std::max(y1, other.y1);
  }
};

/// Windows of triangles in one kind of camera.
class WindowFinder {
 public:
  WindowFinder(const Camera& camera, std::span<const Vec3f> p_C)
      : camera_(camera), width_(Width(camera)), height_(Height(camera)), p_C_(p_C) {
    panorama_ = std::holds_alternative<Equirectangular>(camera);
    Vec3f sum;
    for (const Vec3f& p : p_C) sum += Normalized(p);
    middle_ = std::atan2(sum.x, sum.z);
    if (const auto* pinhole = std::get_if<Pinhole>(&camera)) flat_ = *pinhole;
    if (const auto* face = std::get_if<CubeFace>(&camera)) {
      const double half = 0.5 * face->size;
      flat_ = {face->size, face->size, half, half, half, half};
      turn_ = CubeFaceRotation(face->face).transpose();
    }
  }

  Window Of(const Vec3u& t) const { return panorama_ ? OnSphere(t) : OnPlane(t); }
  /// Column of the picture.
  int Wrap(int x) const { return panorama_ ? ((x % width_) + width_) % width_ : x; }
  bool panorama() const { return panorama_; }

 private:
  // By the cap around the triangle: its middle and the farthest corner.
  Window OnSphere(const Vec3u& t) const {
    const Vec3f a = Normalized(p_C_[t.x]), b = Normalized(p_C_[t.y]), c = Normalized(p_C_[t.z]);
    const Vec3f m = Normalized(a + b + c);
    const double nearest = std::min({Dot(m, a), Dot(m, b), Dot(m, c)});
    if (!(nearest > 0)) return {-width_ / 2, width_ - width_ / 2 - 1, 0, height_ - 1};  // larger than any cap
    const double radius = std::acos(std::min(1.0, nearest)) + 1e-5;
    const double lat = std::asin(std::clamp(-static_cast<double>(m.y), -1.0, 1.0));
    const auto row = [&](double latitude) { return (0.5 - latitude / kPi) * height_ - 0.5; };
    Window window;
    window.y0 = std::max(0, static_cast<int>(std::ceil(row(lat + radius))));
    window.y1 = std::min(height_ - 1, static_cast<int>(std::floor(row(lat - radius))));
    if (std::abs(lat) + radius >= kPi / 2) {
      window.x0 = -width_ / 2;
      window.x1 = width_ - width_ / 2 - 1;
      return Shifted(window);
    }
    const double half = std::asin(std::min(1.0, std::sin(radius) / std::cos(lat)));
    const double lon = std::remainder(std::atan2(m.x, m.z) - middle_, 2 * kPi);
    const double scale = width_ / (2 * kPi), center = (middle_ + lon) * scale + width_ / 2.0 - 0.5;
    window.x0 = static_cast<int>(std::ceil(center - half * scale));
    window.x1 = static_cast<int>(std::floor(center + half * scale));
    if (window.x1 - window.x0 >= width_) window.x1 = window.x0 + width_ - 1;
    return window;
  }
  // A whole turn, seen from the middle of the body.
  Window Shifted(Window window) const {
    const int middle = static_cast<int>(std::floor(middle_ * width_ / (2 * kPi))) + width_ / 2;
    window.x0 += middle, window.x1 += middle;
    return window;
  }
  // Where the plane of the picture, continued beyond its borders, sees a point turned by turn_; nullopt behind it.
  std::optional<Vec2d> Project(Vec3d p) const {
    constexpr double kNear = 1e-3;
    if (const auto* lens = std::get_if<CalibratedLens>(&camera_)) return ProjectBeyond(*lens, p);
    if (const auto* fisheye = std::get_if<Fisheye>(&camera_)) {
      const double across = std::hypot(p.x, p.y);
      if (across < 1e-12) return Vec2d{fisheye->cx, fisheye->cy};
      const double theta = std::min(std::atan2(across, p.z), fisheye->max_theta), t2 = theta * theta;
      const auto& k = fisheye->k;
      const double r = theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
      return Vec2d{fisheye->cx + fisheye->fx * r * p.x / across, fisheye->cy + fisheye->fy * r * p.y / across};
    }
    if (p.z < kNear * Norm(p)) return std::nullopt;
    return Vec2d{flat_->fx * p.x / p.z + flat_->cx, flat_->fy * p.y / p.z + flat_->cy};
  }
  // Where an edge that ends behind a pinhole is in the picture: from its corner `before` straight on for ever, this way. nullopt where
  // that is not certain, close to the camera.
  static std::optional<Vec2d> WayOut(Vec3d before, Vec3d behind) {
    if (!(before.z > behind.z)) return std::nullopt;
    const Vec3d aside = before + (behind - before) * (before.z / (before.z - behind.z));  // z = 0
    if (std::hypot(aside.x, aside.y) < 1e-6 * std::max(Norm(before), Norm(behind))) return std::nullopt;
    return Vec2d{aside.x, aside.y};
  }
  // By the corners in the picture, and the ways of edges that end behind the camera. Lenses bend those: the whole picture.
  Window OnPlane(const Vec3u& t) const {
    constexpr int kMargin = 2;  // pixels: edges of fisheye pictures are bent
    constexpr double kFar = 1e9;
    const Window whole{0, width_ - 1, 0, height_ - 1};
    Vec3d corner[3];
    std::optional<Vec2d> pixel[3];
    for (int i = 0; i < 3; ++i) {
      corner[i] = turn_ * VecCast<double>(p_C_[t[i]]);
      pixel[i] = Project(corner[i]);
    }
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    const auto add = [&](Vec2d at) {
      x0 = std::min(x0, at.x), x1 = std::max(x1, at.x);
      y0 = std::min(y0, at.y), y1 = std::max(y1, at.y);
    };
    for (int i = 0; i < 3; ++i) {
      if (pixel[i]) {
        add(*pixel[i]);
        continue;
      }
      for (const int before : {(i + 1) % 3, (i + 2) % 3}) {
        if (!pixel[before]) continue;
        if (!flat_) return whole;
        const auto way = WayOut(corner[before], corner[i]);
        if (!way) return whole;
        add({pixel[before]->x + kFar * flat_->fx * way->x, pixel[before]->y + kFar * flat_->fy * way->y});
      }
    }
    if (x1 < x0) return {};
    const auto bound = [](double v, int most) { return static_cast<int>(std::clamp(v, -3.0, most + 3.0)); };
    return {std::max(0, bound(x0 - kMargin, width_)), std::min(width_ - 1, bound(x1 + kMargin, width_)),
            std::max(0, bound(y0 - kMargin, height_)), std::min(height_ - 1, bound(y1 + kMargin, height_))};
  }

  const Camera& camera_;
  int width_, height_;
  std::span<const Vec3f> p_C_;
  bool panorama_;
  double middle_ = 0;
  std::optional<Pinhole> flat_;  // of a picture where straight edges are straight
  Mat3d turn_;                   // from C to the frame of flat_
};

// The tight box of a mask; the mask is cut to it.
void Tighten(Window window, Silhouette& s) {
  const int w = window.x1 - window.x0 + 1;
  Window tight;
  for (int y = window.y0; y <= window.y1; ++y) {
    for (int x = window.x0; x <= window.x1; ++x) {
      if (s.mask[static_cast<size_t>(y - window.y0) * w + (x - window.x0)] == 0) continue;
      tight.Add({x, x, y, y});
      ++s.pixels;
    }
  }
  if (s.pixels == 0) {
    s.mask.clear();
    return;
  }
  std::vector<uint8_t> cut;
  for (int y = tight.y0; y <= tight.y1; ++y) {
    const auto row = s.mask.begin() + (static_cast<ptrdiff_t>(y - window.y0) * w + tight.x0 - window.x0);
    cut.insert(cut.end(), row, row + (tight.x1 - tight.x0 + 1));
  }
  s.mask = std::move(cut);
  s.box = PictureBox{tight.x0, tight.y0, tight.x1 - tight.x0 + 1, tight.y1 - tight.y0 + 1};
}

}  // namespace

PixelDirections::PixelDirections(const Camera& camera) : camera_(camera) {
  if (!std::holds_alternative<Equirectangular>(camera)) return;
  const int w = Width(camera), h = Height(camera);
  for (int i = 0; i < w; ++i) {
    const double theta = 2 * kPi * ((i + 0.5) / w - 0.5);
    columns_.push_back({static_cast<float>(std::sin(theta)), static_cast<float>(std::cos(theta))});
  }
  for (int j = 0; j < h; ++j) {
    const double phi = kPi * (0.5 - (j + 0.5) / h);
    rows_.push_back({static_cast<float>(std::sin(phi)), static_cast<float>(std::cos(phi))});
  }
}

Vec3f PixelDirections::At(int i, int j) const {
  if (!rows_.empty()) {
    const Vec2f column = columns_[static_cast<size_t>(i)], row = rows_[static_cast<size_t>(j)];
    return {row.y * column.x, -row.x, row.y * column.y};
  }
  const auto ray = PixelToRay(camera_, {i + 0.5, j + 0.5});
  return ray ? VecCast<float>(*ray) : Vec3f{};
}

Silhouette FindSilhouette(const PixelDirections& directions, std::span<const Vec3f> p_C, std::span<const Vec3u> triangles) {
  Silhouette s;
  if (p_C.empty() || triangles.empty()) return s;
  const WindowFinder finder(directions.camera(), p_C);
  std::vector<Window> windows;
  Window all;
  for (const Vec3u& t : triangles) {
    windows.push_back(finder.Of(t));
    all.Add(windows.back());
  }
  if (all.empty()) return s;
  const int turn = Width(directions.camera());
  if (finder.panorama() && all.x1 - all.x0 >= turn) all.x1 = all.x0 + turn - 1;
  const int w = all.x1 - all.x0 + 1;
  s.mask.assign(static_cast<size_t>(w) * static_cast<size_t>(all.y1 - all.y0 + 1), 0);

  for (size_t k = 0; k < triangles.size(); ++k) {
    const Window& window = windows[k];
    if (window.empty()) continue;
    // A ray is inside if it is on the same side of all three planes through the camera and an edge, the side
    // on which the third corner is.
    const Vec3f a = p_C[triangles[k].x], b = p_C[triangles[k].y], c = p_C[triangles[k].z];
    Vec3f ab = Cross(a, b), bc = Cross(b, c), ca = Cross(c, a);
    if (Dot(ab, c) < 0) ab = -ab, bc = -bc, ca = -ca;
    for (int y = window.y0; y <= window.y1; ++y) {
      uint8_t* row = &s.mask[static_cast<size_t>(y - all.y0) * static_cast<size_t>(w)];
      for (int x = window.x0; x <= window.x1; ++x) {
        const int column = finder.panorama() ? (x - all.x0) % turn : x - all.x0;
        if (row[column] != 0) continue;
        const Vec3f d = directions.At(finder.Wrap(x), y);
        if (Dot(d, ab) >= 0 && Dot(d, bc) >= 0 && Dot(d, ca) >= 0 && !(d == Vec3f{})) row[column] = 1;
      }
    }
  }
  Tighten(all, s);
  if (s.box && finder.panorama()) s.box->x = finder.Wrap(s.box->x);
  return s;
}

}  // namespace airsim360

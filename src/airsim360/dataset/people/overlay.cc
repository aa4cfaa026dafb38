// Labels drawn into a copy of the picture, for people to look at.
#include <algorithm>
#include <cmath>

#include "airsim360/dataset/people/person_record.h"
#include "airsim360/image/draw.h"
#include "airsim360/people/keypoints/keypoint_orders.h"

namespace airsim360 {
namespace {

constexpr Rgb8 kStateColors[] = {{0, 0, 0}, {230, 60, 60}, {255, 150, 40}, {250, 230, 60}, {60, 230, 90}};

/// A picture to draw into, across the seam too.
class Canvas {
 public:
  Canvas(const Camera& camera, Image<Rgb8>& picture)
      : camera_(camera), picture_(picture), panorama_(std::holds_alternative<Equirectangular>(camera)) {}

  void Dot(Vec2d at, int half, Rgb8 color) {
    for (int y = -half; y <= half; ++y) {
      for (int x = -half; x <= half; ++x) Put(static_cast<int>(at.x) + x, static_cast<int>(at.y) + y, color);
    }
  }
  // The straight line between two points of C, seen from the camera.
  void Line(Vec3d a, Vec3d b, Rgb8 color, int half) {
    const auto from = RayToPixel(camera_, a), to = RayToPixel(camera_, b);
    if (!from || !to) return;
    double length = std::abs(from->x - to->x);
    if (panorama_) length = std::min(length, picture_.width() - length);
    const int steps = std::clamp(static_cast<int>(length + std::abs(from->y - to->y)) + 1, 1, 4000);
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      if (const auto at = RayToPixel(camera_, a * (1 - t) + b * t)) Dot(*at, half, color);
    }
  }
  void Box(const PictureBox& box, Rgb8 color) {
    for (int x = box.x; x < box.x + box.w; ++x) Put(x, box.y, color), Put(x, box.y + box.h - 1, color);
    for (int y = box.y; y < box.y + box.h; ++y) Put(box.x, y, color), Put(box.x + box.w - 1, y, color);
  }
  void Text(std::string_view text, int x, int y, Rgb8 color, int scale) {
    FillRectangle(x - scale, y - scale, TextWidth(text, scale) + 2 * scale, 9 * scale, {0, 0, 0}, picture_);
    DrawText(text, x, y, color, scale, picture_);
  }

 private:
  void Put(int x, int y, Rgb8 color) {
    const int w = picture_.width();
    if (panorama_) x = ((x % w) + w) % w;
    if (x >= 0 && x < w && y >= 0 && y < picture_.height()) picture_(x, y) = color;
  }
  const Camera& camera_;
  Image<Rgb8>& picture_;
  bool panorama_;
};

}  // namespace

Image<Rgb8> DrawPeople(const Image<Rgb8>& rgb, const Camera& camera, std::span<const PersonLabel> labels) {
  Image<Rgb8> picture = rgb;
  Canvas canvas(camera, picture);
  const int scale = std::max(1, rgb.width() / 2048);
  // The farthest first.
  std::vector<const PersonLabel*> order;
  for (const PersonLabel& label : labels) order.push_back(&label);
  std::ranges::stable_sort(order, [](const auto* a, const auto* b) { return Norm(a->box3d.center_C) > Norm(b->box3d.center_C); });
  for (const PersonLabel* label : order) {
    const auto& keypoints = label->keypoints;
    // Those nobody can see are left out.
    const auto seen = std::ranges::count(keypoints, KeypointState::kVisible, &KeypointLabel::state);
    if (seen == 0) continue;
    const Rgb8 color = IdColor(label->entity);
    if (label->amodal.box) canvas.Box(*label->amodal.box, color);
    for (const auto& [a, b] : SocketEdges())
      canvas.Line(keypoints[static_cast<size_t>(a)].p_C, keypoints[static_cast<size_t>(b)].p_C, {255, 255, 255}, 0);
    for (size_t i = 0; i < std::min<size_t>(kCocoSocketCount, keypoints.size()); ++i) {
      if (keypoints[i].state == KeypointState::kAbsent) continue;
      canvas.Dot(keypoints[i].pixel, scale, kStateColors[static_cast<size_t>(keypoints[i].state)]);
    }
    if (label->amodal.box) {
      std::string text = BehaviourName(label->state.upper);
      if (label->state.lower != label->state.upper) text += std::string("+") + BehaviourName(label->state.lower);
      canvas.Text(text, label->amodal.box->x % rgb.width(), label->amodal.box->y - 10 * scale, color, scale);
    }
  }
  return picture;
}

}  // namespace airsim360

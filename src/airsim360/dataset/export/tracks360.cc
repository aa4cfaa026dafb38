// 360VOTS: single-object tracks in panoramas (Huang et al., "360VOT", ICCV 2023; "360VOTS", 2024). For each frame a box, a
// rotated box, a bounding field of view and a rotated one; masks across the seam. Longitude grows to the right, latitude up.
#include <cmath>
#include <limits>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr int64_t kLeastPixels = 16;  // of a thing in a frame that counts

bool IsTracked(const std::string& path) {
  for (const char* root : {"human", "vehicle", "animal", "uav"}) {
    if (path == root || path.starts_with(std::string(root) + "/")) return true;
  }
  return false;
}

struct Extent {
  double x0 = std::numeric_limits<double>::max(), x1 = -x0, y0 = x0, y1 = -x0;
  void Add(double x, double y) { x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y); }
  double area() const { return (x1 - x0) * (y1 - y0); }
};

struct Bfov {
  double lon = 0, lat = 0, width = 0, height = 0, rotation = 0;  // degrees
};

// Axes of a view at a place of the sphere, turned clockwise in the picture, as OpenCV turns its boxes: right, up, forward.
struct Axes {
  Vec3d right, up, forward;
};
Axes AxesAt(double lon, double lat, double rotation) {
  const Vec3d forward{std::cos(lat) * std::sin(lon), -std::sin(lat), std::cos(lat) * std::cos(lon)};
  const Vec3d right{std::cos(lon), 0, -std::sin(lon)}, up = Cross(right, forward);
  const double c = std::cos(rotation), s = std::sin(rotation);
  return {right * c - up * s, right * s + up * c, forward};
}

// Angles to the right and up in the view: of its tangent plane, or around the axes where something is behind.
Extent ExtentIn(const std::vector<Vec3d>& rays, const Axes& axes) {
  Extent extent;
  bool behind = false;
  for (const Vec3d& ray : rays) behind |= Dot(ray, axes.forward) < 0.1;
  for (const Vec3d& ray : rays) {
    const double x = Dot(ray, axes.right), y = Dot(ray, axes.up), z = Dot(ray, axes.forward);
    extent.Add(std::atan2(x, z), behind ? std::asin(std::clamp(y, -1.0, 1.0)) : std::atan2(y, z));
  }
  return extent;
}

// Moves the centre until the extent is the same to all sides.
Bfov Centred(const std::vector<Vec3d>& rays, double lon, double lat, double rotation) {
  Extent extent;
  for (int step = 0; step < 12; ++step) {
    const Axes axes = AxesAt(lon, lat, rotation);
    extent = ExtentIn(rays, axes);
    const double dx = 0.5 * (extent.x0 + extent.x1), dy = 0.5 * (extent.y0 + extent.y1);
    const Vec3d centre =
        Normalized(axes.forward + axes.right * std::tan(std::clamp(dx, -1.0, 1.0)) + axes.up * std::tan(std::clamp(dy, -1.0, 1.0)));
    lon = std::atan2(centre.x, centre.z);
    lat = std::asin(std::clamp(-centre.y, -1.0, 1.0));
  }
  // What is left of the difference is covered.
  extent = ExtentIn(rays, AxesAt(lon, lat, rotation));
  return {lon * kRadian, lat * kRadian, 2 * std::max(-extent.x0, extent.x1) * kRadian, 2 * std::max(-extent.y0, extent.y1) * kRadian,
          rotation * kRadian};
}

Bfov RotatedBfov(const std::vector<Vec3d>& rays, const Bfov& upright) {
  Bfov best = upright;
  for (int degrees = -44; degrees <= 45; ++degrees) {
    if (degrees == 0) continue;
    const Extent extent = ExtentIn(rays, AxesAt(upright.lon / kRadian, upright.lat / kRadian, degrees / kRadian));
    if (extent.area() * kRadian * kRadian >= best.width * best.height) continue;
    const Bfov candidate = Centred(rays, upright.lon / kRadian, upright.lat / kRadian, degrees / kRadian);
    if (candidate.width * candidate.height < best.width * best.height) best = candidate;
  }
  return best;
}

Json BfovJson(const Bfov& b) {
  return {{"clon", b.lon}, {"clat", b.lat}, {"fov_h", b.width}, {"fov_v", b.height}, {"rotation", b.rotation}};
}

// The smallest of the rectangles turned by whole degrees around corners of pixels that lie on a circle of columns.
Json RotatedBoxJson(const std::vector<Vec2d>& corners, int width) {
  double best = std::numeric_limits<double>::max();
  Json json;
  for (int degrees = 0; degrees < 90; ++degrees) {
    const double c = std::cos(degrees / kRadian), s = std::sin(degrees / kRadian);
    Extent extent;
    for (const Vec2d& p : corners) extent.Add(c * p.x + s * p.y, -s * p.x + c * p.y);
    if (extent.area() >= best) continue;
    best = extent.area();
    const double u = 0.5 * (extent.x0 + extent.x1), v = 0.5 * (extent.y0 + extent.y1);
    json = {{"cx", std::fmod(c * u - s * v, width)},
            {"cy", s * u + c * v},
            {"w", extent.x1 - extent.x0},
            {"h", extent.y1 - extent.y0},
            {"rotation", degrees}};
  }
  return json;
}

// Rays and corners of the pixels at the border of a mask.
struct Outline {
  std::vector<Vec3d> rays;
  std::vector<Vec2d> corners;
  Vec3d sum;
};
Outline OutlineOf(const Image<EntityId>& entity, const Segment& segment, const Camera& camera) {
  Outline outline;
  const int width = entity.width();
  const PixelBox& box = segment.box_wrap;
  for (int y = box.y; y < box.y + box.h; ++y) {
    // Of each row the first and last pixel bound the mask; those between lie inside the same view.
    int first = -1, last = -1;
    for (int x = box.x; x < box.x + box.w; ++x) {
      if (entity(x % width, y) != segment.entity) continue;
      if (first < 0) first = x;
      last = x;
    }
    if (first < 0) continue;
    for (const double x : {static_cast<double>(first), last + 1.0}) {
      for (const double row : {static_cast<double>(y), y + 1.0}) {
        outline.corners.push_back({x, row});
        const Vec3d ray = *PixelToRay(camera, {std::fmod(x, width), row});
        outline.rays.push_back(ray);
        outline.sum += ray;
      }
    }
  }
  return outline;
}

Json LabelJson(const Image<EntityId>& entity, const Segment& segment, const Camera& camera) {
  const Outline outline = OutlineOf(entity, segment, camera);
  const Vec3d middle = Normalized(outline.sum);
  const Bfov bfov = Centred(outline.rays, std::atan2(middle.x, middle.z), std::asin(std::clamp(-middle.y, -1.0, 1.0)), 0);
  const PixelBox& b = segment.box_wrap;
  return {{"bfov", BfovJson(bfov)},
          {"rbfov", BfovJson(RotatedBfov(outline.rays, bfov))},
          {"bbox", {{"cx", std::fmod(b.x + 0.5 * b.w, entity.width())}, {"cy", b.y + 0.5 * b.h}, {"w", b.w}, {"h", b.h}, {"rotation", 0}}},
          {"rbbox", RotatedBoxJson(outline.corners, entity.width())}};
}

}  // namespace

void Export360Vots(ExportJob& job) {
  job.NeedColour();
  const View& view = job.Panorama();
  std::map<EntityId, Json> tracks;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        job.out.Write("images/" + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
        const Image<EntityId> entity = job.data.Entity(frame, view);
        std::map<EntityId, Json> labels;
        for (const Segment& segment : job.data.Segments(frame, view)) {
          if (segment.area < kLeastPixels || !IsTracked(job.data.category(segment.category).path)) continue;
          labels[segment.entity] = LabelJson(entity, segment, view.camera);
          Image<uint8_t> mask(entity.width(), entity.height());
          std::ranges::transform(entity.pixels(), mask.pixels().begin(), [&](EntityId e) { return e == segment.entity ? 255 : 0; });
          job.out.Write("tracks/" + std::to_string(segment.entity) + "/mask/" + frame.stem + ".png", EncodePng(mask));
        }
        return labels;
      },
      [&](const NativeFrame& frame, const std::map<EntityId, Json>& labels) {
        for (const auto& [entity, label] : labels) tracks[entity][job.data.FileName(frame, view, "rgb")] = label;
      });
  job.Need(!tracks.empty(), "people, vehicles or animals of 16 pixels or more", "--people N, or where vehicles are");
  for (const auto& [entity, labels] : tracks) job.out.Write("tracks/" + std::to_string(entity) + "/label.json", Pretty(labels));
  job.notes["tracks"] = tracks.size();
}

}  // namespace airsim360::internal

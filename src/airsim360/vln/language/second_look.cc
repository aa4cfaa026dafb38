#include "airsim360/vln/language/second_look.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr double kOffX = 0.31, kOffY = 0.67;  // of a ray in its pixel
constexpr size_t kMostSeen = 8;               // pictures kept
constexpr size_t kMostPoints = 400;           // corners of a thing that distances between things are measured from
constexpr size_t kMostKept = 4'000'000;       // triangles of things kept between items

// Unit direction in W of a place in a picture, from compass angles.
Vec3d DirectionOf(const LanguagePicture& picture, double x, double y) {
  const double yaw = picture.yaw_deg * kPi / 180;
  if (picture.panorama) {
    const double clockwise = (x / picture.width - 0.5) * 2 * kPi, up = (0.5 - y / picture.height) * kPi;
    return {std::cos(up) * std::cos(yaw - clockwise), std::cos(up) * std::sin(yaw - clockwise), std::sin(up)};
  }
  const double looks = yaw - picture.azimuth_deg * kPi / 180, half = picture.width / 2.0;
  const double right = (x - half) / half, down = (y - picture.height / 2.0) / half;
  const Vec3d d{std::cos(looks) + right * std::sin(looks), std::sin(looks) - right * std::cos(looks), -down};
  return d / Norm(d);
}

// Nearest point of a triangle, by its seven regions (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
double ToTriangle(Vec3d p, const std::array<Vec3d, 3>& t) {
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return Norm(ap);
  const Vec3d bp = p - t[1];
  const double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return Norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return Norm(ap - ab * (d1 / (d1 - d3)));
  const Vec3d cp = p - t[2];
  const double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return Norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return Norm(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return Norm(bp - (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double sum = va + vb + vc;
  return sum == 0 ? Norm(ap) : Norm(ap - ab * (vb / sum) - ac * (vc / sum));
}

// Whether a camera of 90 degrees holds a direction.
bool InFrame(const LanguagePicture& picture, Vec3d to) {
  const double ahead = (picture.yaw_deg - picture.azimuth_deg) * kPi / 180;
  const double depth = std::cos(ahead) * to.x + std::sin(ahead) * to.y, left = std::cos(ahead) * to.y - std::sin(ahead) * to.x;
  return depth > 0 && std::max(std::abs(left), std::abs(to.z)) < depth;
}

// Entities of one row.
void CastRow(const RayTracer& tracer, const LanguagePicture& picture, int row, std::vector<EntityId>& entities) {
  const FlushDenormals guard;
  const Scene& scene = tracer.scene();
  for (int x = 0; x < picture.width; x += 16) {
    alignas(64) int valid[16];
    RayHit16 rays{};
    for (int i = 0; i < 16; ++i) {
      const Vec3f d = VecCast<float>(DirectionOf(picture, std::min(x + i, picture.width - 1) + kOffX, row + kOffY));
      valid[i] = x + i < picture.width ? -1 : 0;
      rays.origin_x[i] = static_cast<float>(picture.position.x);
      rays.origin_y[i] = static_cast<float>(picture.position.y);
      rays.origin_z[i] = static_cast<float>(picture.position.z);
      rays.direction_x[i] = d.x;
      rays.direction_y[i] = d.y;
      rays.direction_z[i] = d.z;
      rays.t_far[i] = std::numeric_limits<float>::infinity();
      rays.mask[i] = kMaskAll;
      rays.geometry[i] = kMiss;
    }
    tracer.Intersect16(valid, rays, true);
    for (int i = 0; i < 16 && x + i < picture.width; ++i) {
      if (rays.geometry[i] == kMiss) continue;
      entities[x + i] = EntityAt(scene, tracer.Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]));
    }
  }
}

}  // namespace

SecondLook::SecondLook(std::shared_ptr<const RayTracer> tracer) : tracer_(std::move(tracer)), parts_(PartsByEntity(scene())) {}

const Glimpses& SecondLook::LookAt(const LanguagePicture& picture) {
  if (const auto found = seen_.find(picture.file); found != seen_.end()) return found->second;
  if (seen_.size() >= kMostSeen) seen_.clear();
  if (kept_ > kMostKept) {
    triangles_.clear();
    points_.clear();
    kept_ = 0;
  }
  std::vector<std::vector<EntityId>> rows(picture.height, std::vector<EntityId>(picture.width, kNoEntity));
  ParallelFor(picture.height, [&](int64_t y) { CastRow(*tracer_, picture, static_cast<int>(y), rows[y]); });
  Glimpses& glimpses = seen_[picture.file];
  const double yaw = picture.yaw_deg * kPi / 180;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (rows[y][x] == kNoEntity) continue;
      Glimpse& g = glimpses[rows[y][x]];
      const Vec3d d = DirectionOf(picture, x + kOffX, y + kOffY);
      ++g.rays;
      g.sum += d;
      g.column += x + kOffX;
      g.left = std::min<double>(g.left, x);
      g.right = std::max<double>(g.right, x);
      g.top = std::min<double>(g.top, y);
      g.bottom = std::max<double>(g.bottom, y);
      g.azimuths.push_back(std::remainder(yaw - std::atan2(d.y, d.x), 2 * kPi) * 180 / kPi);
    }
  }
  return glimpses;
}

const std::vector<std::array<Vec3d, 3>>& SecondLook::Triangles(EntityId entity) {
  const auto [entry, is_new] = triangles_.try_emplace(entity);
  if (!is_new) return entry->second;
  for (const auto& [i, k] : parts_.at(entity)) {
    const Instance& instance = scene().instances[i];
    const Mesh& mesh = scene().meshes[instance.mesh];
    const MeshPart& part = mesh.parts[k];
    for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto place = [&](uint32_t v) { return VecCast<double>(instance.X_WM * mesh.positions[v]); };
      entry->second.push_back({place(mesh.triangles[t].x), place(mesh.triangles[t].y), place(mesh.triangles[t].z)});
    }
  }
  kept_ += entry->second.size();
  return entry->second;
}

const std::vector<Vec3d>& SecondLook::Points(EntityId entity) {
  const auto [entry, is_new] = points_.try_emplace(entity);
  if (is_new)
    for (const auto& t : Triangles(entity)) entry->second.insert(entry->second.end(), t.begin(), t.end());
  return entry->second;
}

double SecondLook::Extent(EntityId entity) {
  Vec3d low{1e9, 1e9, 1e9}, high = low * -1.0;
  for (const Vec3d& p : Points(entity)) {
    low = Min(low, p);
    high = Max(high, p);
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

double SecondLook::Shown(const LanguagePicture& picture, EntityId entity) {
  const auto& triangles = Triangles(entity);
  const size_t step = std::max<size_t>(1, triangles.size() / kMostPoints);
  double shown = 0, all = 0;
  for (size_t i = 0; i < triangles.size(); i += step) {
    const auto& [a, b, c] = triangles[i];
    const double area = Norm(Cross(b - a, c - a));
    const Vec3d middle = (a + b + c) / 3;
    for (const Vec3d& p : {middle, (middle + a) / 2, (middle + b) / 2, (middle + c) / 2}) {
      all += area;
      const Vec3d to = p - picture.position;
      if (!picture.panorama && !InFrame(picture, to)) continue;
      const auto hit = tracer_->Intersect(VecCast<float>(picture.position), VecCast<float>(to), 0.999F);
      if (!hit || EntityAt(scene(), hit->surface) == entity) shown += area;
    }
  }
  return all > 0 ? shown / all : 0;
}

double SecondLook::Distance(Vec3d from, EntityId to) {
  double least = 1e9;
  for (const auto& t : Triangles(to)) least = std::min(least, ToTriangle(from, t));
  return least;
}

double SecondLook::Apart(EntityId a, EntityId b) {
  double least = 1e9;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    const auto& points = Points(from);
    const size_t step = std::max<size_t>(1, points.size() / kMostPoints);
    for (size_t i = 0; i < points.size(); i += step) least = std::min(least, Distance(points[i], to));
  }
  return least;
}

}  // namespace airsim360::internal

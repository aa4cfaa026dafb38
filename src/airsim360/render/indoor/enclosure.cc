#include "airsim360/render/indoor/enclosure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

constexpr int kDirections = 48;
constexpr float kSteep = 0.5f;            // sine of the elevation from which a ray looks for a roof: 12 of them
constexpr float kFar = 60;                // m: what is farther encloses nothing
constexpr float kMostCubes = 60000;       // of the box looked at
constexpr float kLeastVolume = 12;        // m^3: smaller hollows are no rooms
constexpr float kLeastShareOfBox = 0.1f;  // of its box that a scanned house is made of
constexpr float kMargin = 1;              // m about ceilings

bool IsUnder(const SemanticTree& tree, CategoryId id, std::string_view path) {
  const std::string& name = tree[id].path;
  return name == path || (name.starts_with(path) && name[path.size()] == '/');
}

// All that may be indoors: from the lowest floor to the ceilings, else the whole of a small scene.
Box3f PlacesToLook(const Scene& scene) {
  Box3f ceilings;
  for (const Entity& entity : scene.entities) {
    if (!entity.bounds.empty() && IsUnder(scene.tree, entity.category, "construction/ceiling")) ceilings.Add(entity.bounds);
  }
  Box3f box = scene.bounds;
  if (!ceilings.empty()) {
    const float low = std::max(box.min.z, ceilings.min.z - 12);
    box = {{ceilings.min.x - kMargin, ceilings.min.y - kMargin, low}, ceilings.max + Vec3f{kMargin, kMargin, 0}};
    return {Max(box.min, scene.bounds.min), Min(box.max, scene.bounds.max)};
  }
  const Vec3f size = box.size();
  return std::max({size.x, size.y, size.z}) <= Enclosure::kScanned ? box : Box3f{};
}

// Even over the sphere, the same everywhere.
Vec3f EvenDirection(int i) {
  const float z = 1 - (2 * static_cast<float>(i) + 1) / kDirections, angle = static_cast<float>(i) * 2.39996323f;
  const float s = std::sqrt(1 - z * z);
  return {s * std::cos(angle), s * std::sin(angle), z};
}

// Of sixteen places: how many rays met something, a surface from behind, and left steeply upwards.
struct Counts {
  int met[16] = {}, behind[16] = {}, left[16] = {};
};

Counts LookAround(const RayTracer& tracer, const Vec3f* places, int count) {
  Counts counts;
  RayPacket packet(kMaskAll);
  for (int k = 0; k < kDirections; ++k) {
    const Vec3f d = EvenDirection(k);
    packet.Clear();
    for (int i = 0; i < count; ++i) packet.Set(i, places[i], d, kFar);
    tracer.Intersect16(packet.valid, packet.rays, false);
    for (int i = 0; i < count; ++i) {
      if (!packet.Hit(i)) {
        counts.left[i] += d.z > kSteep;
        continue;
      }
      ++counts.met[i];
      const SurfaceRef ref = tracer.Resolve(packet.rays.geometry[i], packet.rays.instance[i], packet.rays.primitive[i]);
      counts.behind[i] += SeenFromBehind(tracer, ref, d);
    }
  }
  return counts;
}

}  // namespace

bool SeenFromBehind(const RayTracer& tracer, const SurfaceRef& ref, Vec3f direction) {
  const Scene& scene = tracer.scene();
  const Instance& instance = scene.instances[ref.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Vec3u& t = mesh.triangles[ref.triangle];
  const Vec3f a = instance.X_WM * mesh.positions[t.x], b = instance.X_WM * mesh.positions[t.y], c = instance.X_WM * mesh.positions[t.z];
  // A mirrored instance turns its triangles round; their front stays the front.
  const Mat3f& A = instance.X_WM.A;
  const float turned = Dot(Cross(A.column(0), A.column(1)), A.column(2)) < 0 ? -1.0f : 1.0f;
  return Dot(Cross(b - a, c - a), direction) * turned > 0;
}

Enclosure::Enclosure(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  if (scene.instances.empty() || scene.interior_light != Vec3f{}) return;
  const Box3f box = PlacesToLook(scene);
  if (box.empty()) return;
  Look(tracer, box);
  const Vec3f size = box.size();
  if (volume() < std::max(kLeastVolume, kLeastShareOfBox * size.x * size.y * std::min(size.z, 4.0f))) {
    cubes_.clear();
    enclosed_ = n_[0] = n_[1] = n_[2] = 0;
  }
}

void Enclosure::Look(const RayTracer& tracer, const Box3f& box) {
  const Vec3f size = box.size();
  size_ = std::clamp(std::cbrt(size.x * size.y * size.z / kMostCubes), 0.5f, 8.0f);
  while ((size.x / size_ + 1) * (size.y / size_ + 1) * (size.z / size_ + 1) > 2 * kMostCubes) size_ *= 1.2f;
  origin_ = box.min;
  for (int k = 0; k < 3; ++k) n_[k] = static_cast<int>(size[k] / size_) + 1;
  cubes_.assign(static_cast<size_t>(n_[0]) * n_[1] * n_[2], 0);
  ParallelFor(static_cast<int64_t>(n_[1]) * n_[2], [&](int64_t row) {
    const FlushDenormals flush;
    const int y = static_cast<int>(row % n_[1]), z = static_cast<int>(row / n_[1]);
    for (int first = 0; first < n_[0]; first += 16) {
      const int count = std::min(16, n_[0] - first);
      Vec3f places[16];
      for (int i = 0; i < count; ++i) places[i] = origin_ + Vec3f{first + i + 0.5f, y + 0.5f, z + 0.5f} * size_;
      const Counts counts = LookAround(tracer, places, count);
      for (int i = 0; i < count; ++i) {
        const bool solid = counts.behind[i] * 5 > kDirections;
        cubes_[static_cast<size_t>(row) * n_[0] + first + i] = !solid && counts.met[i] * 10 > kDirections * 6 && counts.left[i] < 2;
      }
    }
  });
  enclosed_ = std::accumulate(cubes_.begin(), cubes_.end(), int64_t{0});
}

bool Enclosure::Touches(const Box3f& box) const {
  int low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](float x) { return static_cast<int>(std::floor(std::clamp((x - origin_[k]) / size_, -2.0f, n_[k] + 2.0f))); };
    low[k] = at(box.min[k]) - 1, high[k] = at(box.max[k]) + 1;
  }
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x)
        if (At(x, y, z)) return true;
  return false;
}

bool Enclosure::Holds(const RayTracer& tracer, Vec3f p) const {
  const Vec3f q = (p - origin_) / size_;
  for (int k = 0; k < 3; ++k)
    if (!(q[k] > -1 && q[k] < static_cast<float>(n_[k]) + 1)) return false;
  const int x = static_cast<int>(std::floor(q.x)), y = static_cast<int>(std::floor(q.y)), z = static_cast<int>(std::floor(q.z));
  if (At(x, y, z)) return true;
  // Cubes in walls and furniture are solid, whoever stands in their other half.
  for (int k = 0; k < 27; ++k) {
    const int cx = x + k % 3 - 1, cy = y + k / 3 % 3 - 1, cz = z + k / 9 - 1;
    const Vec3f middle = origin_ + Vec3f{cx + 0.5f, cy + 0.5f, cz + 0.5f} * size_;
    if (At(cx, cy, cz) && !tracer.Occluded(p, middle)) return true;
  }
  return false;
}

}  // namespace airsim360::internal

#include "airsim360/render/indoor/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

constexpr float kTiny = 1e-4f;  // m^2 of a triangle, below which it counts by chance

Box3f BoxOf(const SurfacePiece& piece) {
  Box3f box;
  for (const Vec3f& p : piece.corner) box.Add(p);
  return box;
}

// Halves of the longest edge, until pieces are small or nowhere near enclosed space.
void Cut(const Enclosure& enclosure, const SurfacePiece& piece, float largest, std::vector<SurfacePiece>& out) {
  if (!enclosure.Touches(BoxOf(piece))) return;
  int longest = 0;
  float length = 0;
  for (int k = 0; k < 3; ++k) {
    const float edge = Norm(piece.corner[(k + 1) % 3] - piece.corner[k]);
    if (edge > length) longest = k, length = edge;
  }
  if (length <= largest) {
    out.push_back(piece);
    return;
  }
  const int next = (longest + 1) % 3;
  const Vec3f middle = (piece.corner[longest] + piece.corner[next]) * 0.5f;
  SurfacePiece one = piece, two = piece;
  one.corner[next] = middle, two.corner[longest] = middle;
  Cut(enclosure, one, largest, out);
  Cut(enclosure, two, largest, out);
}

void CutInstance(const IndoorWorld& world, const Enclosure& enclosure, const Reflectance& reflectance, uint32_t index, float largest,
                 std::vector<SurfacePiece>& out) {
  const Scene& scene = world.tracer.scene();
  const Instance& instance = scene.instances[index];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const InstanceRecord& record = world.tables.instances[index];
  Box3f box;
  for (const Vec3f& p : mesh.positions) box.Add(instance.X_WM * p);
  if (box.empty() || !enclosure.Touches(box)) return;
  const Mat3f& A = instance.X_WM.A;
  const float turned = Dot(Cross(A.column(0), A.column(1)), A.column(2)) < 0 ? -1.0f : 1.0f;
  for (uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const uint32_t material = world.tables.triangles[record.first_triangle + k].material & ~kMirroredUv;
    if (IsClearPane(scene.materials[material])) continue;
    const Vec3u& t = mesh.triangles[k];
    SurfacePiece piece{
        {instance.X_WM * mesh.positions[t.x], instance.X_WM * mesh.positions[t.y], instance.X_WM * mesh.positions[t.z]}, {}, {}};
    const Vec3f cross = Cross(piece.corner[1] - piece.corner[0], piece.corner[2] - piece.corner[0]) * turned;
    if (!(Norm(cross) > 1e-9f)) continue;
    piece.normal = Normalized(cross);
    const Vec3f tint{record.tint[0], record.tint[1], record.tint[2]};
    piece.albedo = reflectance.Of(material, world.tables.mean_colors[material] * tint * world.tables.MeanColor(record, k));
    if (StandsForTiny(piece, kTiny, ShiftOf(static_cast<uint64_t>(index) << 32 | k).x)) Cut(enclosure, piece, largest, out);
  }
}

}  // namespace

bool StandsForTiny(SurfacePiece& piece, float least, float u) {
  constexpr float kMost = 64;  // pieces that one stands for
  const float area = 0.5f * piece.stands_for * Norm(Cross(piece.corner[1] - piece.corner[0], piece.corner[2] - piece.corner[0]));
  if (area >= least) return true;
  const float kept = std::max(area / least, 1 / kMost);
  piece.stands_for /= kept;
  return u < kept;
}

std::vector<SurfacePiece> EnclosedPieces(const IndoorWorld& world, const Enclosure& enclosure, const Reflectance& reflectance) {
  const Scene& scene = world.tracer.scene();
  const std::vector<uint8_t> moving = MovingInstances(scene);
  std::vector<std::vector<SurfacePiece>> of_instance(scene.instances.size());
  ParallelFor(static_cast<int64_t>(scene.instances.size()), [&](int64_t i) {
    if (!moving[static_cast<size_t>(i)])
      CutInstance(world, enclosure, reflectance, static_cast<uint32_t>(i), kPieceSize, of_instance[static_cast<size_t>(i)]);
  });
  return JoinParts(std::move(of_instance));
}

double AreaOf(std::span<const SurfacePiece> pieces) {
  double area = 0;
  for (const SurfacePiece& piece : pieces)
    area += 0.5 * piece.stands_for * Norm(Cross(piece.corner[1] - piece.corner[0], piece.corner[2] - piece.corner[0]));
  return area;
}

void SamplePiece(const SurfacePiece& piece, float step, bool back, const std::function<void(const SurfaceSample&)>& each) {
  const Vec3f a = piece.corner[1] - piece.corner[0], b = piece.corner[2] - piece.corner[0];
  const int across = std::max(1, static_cast<int>(std::ceil(Norm(a) / step))),
            along = std::max(1, static_cast<int>(std::ceil(Norm(b) / step)));
  // First corners of the lattice's cells, moved by a third, so that their mean is the triangle's.
  const auto at = [](int i, int of) { return (static_cast<float>(i) + 1.0f / 3) / static_cast<float>(of); };
  int count = 0;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j) count += at(i, across) + at(j, along) < 1;
  SurfaceSample sample{{},
                       back ? -piece.normal : piece.normal,
                       piece.albedo,
                       0.5f * Norm(Cross(a, b)) * piece.stands_for / static_cast<float>(std::max(1, count))};
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < along; ++j) {
      const float u = at(i, across), v = at(j, along);
      if (!(u + v < 1)) continue;
      sample.p = piece.corner[0] + a * u + b * v;
      each(sample);
    }
  }
}

}  // namespace airsim360::internal

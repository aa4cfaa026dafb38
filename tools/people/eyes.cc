#include "eyes.h"

#include "airsim360/people/body/loft.h"
#include "joints.h"

namespace airsim360::bake {
namespace {

// Vertices of the base mesh that mark the eyeballs, which its lids fit.
constexpr size_t kEyeMarkers[2][2] = {{14598, 14670}, {14670, 14742}};

}  // namespace

Ball EyeBall(const std::vector<Vec3f>& v, size_t eye) {
  const auto [first, end] = kEyeMarkers[eye];
  const auto count = static_cast<double>(end - first);
  Ball ball;
  for (size_t i = first; i < end; ++i) ball.center += VecCast<double>(ToPerson(v[i])) / count;
  for (size_t i = first; i < end; ++i) ball.radius += Norm(VecCast<double>(ToPerson(v[i])) - ball.center) / count;
  return ball;
}

void AddEyes(const std::vector<Vec3f>& v, std::vector<Piece>& pieces, const std::array<uint32_t, 3>& materials) {
  struct Shell {
    double forward, radius;
  };
  constexpr Shell kShells[] = {{0, 1}, {0.52, 0.595}, {0.74, 0.385}};
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    const Ball ball = EyeBall(v, eye);
    for (size_t k = 0; k < std::size(kShells); ++k) {
      internal::LoftMesh mesh;
      const double r = kShells[k].radius * ball.radius;
      mesh.Ellipsoid(ball.center + Vec3d{kShells[k].forward * ball.radius, 0, 0}, {r, r, r}, Joint::kHead, 0, k == 0 ? 12 : 8);
      const BodyLevel level = mesh.Finish("eye");
      Piece piece;
      piece.whole = true;
      piece.material = materials[k];
      piece.positions = level.mesh.positions;
      piece.uvs = level.mesh.uvs;
      piece.influences = level.influences;
      for (uint32_t i = 0; i < piece.positions.size(); ++i) piece.source.push_back(i);
      for (const Vec3u& t : level.mesh.triangles) {
        // Only what can look out between the lids.
        const Vec3f middle = (piece.positions[t.x] + piece.positions[t.y] + piece.positions[t.z]) * (1.0f / 3);
        if (middle.x > ball.center.x + 0.1 * ball.radius) piece.indices.insert(piece.indices.end(), {t.x, t.y, t.z});
      }
      pieces.push_back(std::move(piece));
    }
  }
}

}  // namespace airsim360::bake

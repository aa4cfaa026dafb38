#include "airsim360/sim/traffic/bicycle_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "airsim360/base/disjoint_sets.h"

namespace airsim360::internal {
namespace {

constexpr float kNear = 0.012f;         // metres: how exact the mesh of a bicycle is
constexpr float kHubHalfWidth = 0.06f;  // metres
constexpr float kBoss = 0.022f;         // metres of a crank beyond the axle of its pedal
constexpr float kStandReach = 0.03f;    // metres: what is lower than this and no wheel is the stand
constexpr size_t kFramePart = kBicycleParts, kStandPart = kBicycleParts + 1;

// Numbers of what hangs together, by triangle.
std::vector<uint32_t> Pieces(const Mesh& mesh) {
  std::map<std::tuple<float, float, float>, uint32_t> places;
  std::vector<uint32_t> vertex;
  for (const Vec3f& p : mesh.positions)
    vertex.push_back(places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(places.size())).first->second);
  DisjointSets sets(places.size());
  for (const Vec3u& t : mesh.triangles) sets.Join(vertex[t.y], vertex[t.x]), sets.Join(vertex[t.z], vertex[t.x]);
  std::vector<uint32_t> pieces;
  for (const Vec3u& t : mesh.triangles) pieces.push_back(sets.Root(vertex[t.x]));
  return pieces;
}

// How far something reaches from an axle along X.
float ReachFrom(const std::vector<Vec3f>& points, Vec3f axle) {
  float reach = 0;
  for (const Vec3f& p : points) reach = std::max(reach, std::hypot(p.y - axle.y, p.z - axle.z));
  return reach;
}

size_t PartOf(const BicycleMeasures& m, const std::vector<Vec3f>& points) {
  Box3f box;
  for (const Vec3f& p : points) box.Add(p);
  const bool narrow = std::max(-box.min.x, box.max.x) < kHubHalfWidth;
  if (narrow && ReachFrom(points, m.front_hub) < m.wheel_radius + kNear) return static_cast<size_t>(BicyclePart::kFrontWheel);
  if (narrow && ReachFrom(points, m.rear_hub) < m.wheel_radius + kNear) return static_cast<size_t>(BicyclePart::kRearWheel);
  for (const bool left : {true, false}) {
    const Vec3f pedal = m.Pedal(left);
    if (std::abs(box.center().x - pedal.x) < kNear && ReachFrom(points, pedal) < 0.05f)
      return static_cast<size_t>(left ? BicyclePart::kLeftPedal : BicyclePart::kRightPedal);
  }
  if (ReachFrom(points, m.bracket) < m.crank + kBoss) return static_cast<size_t>(BicyclePart::kCranks);
  return box.min.z < kStandReach ? kStandPart : kFramePart;
}

// The triangles of one part, with the vertices that they need.
Mesh CutOut(const Mesh& mesh, const std::vector<size_t>& part_of, size_t part, const char* name) {
  Mesh out;
  out.name = mesh.name + " " + name;
  std::map<uint32_t, uint32_t> kept;
  const auto keep = [&](uint32_t v) {
    const auto [place, fresh] = kept.try_emplace(v, static_cast<uint32_t>(out.positions.size()));
    if (!fresh) return place->second;
    out.positions.push_back(mesh.positions[v]);
    if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[v]);
    if (!mesh.uvs.empty()) out.uvs.push_back(mesh.uvs[v]);
    if (!mesh.colors.empty()) out.colors.push_back(mesh.colors[v]);
    return place->second;
  };
  for (const MeshPart& from : mesh.parts) {
    const auto first = static_cast<uint32_t>(out.triangles.size());
    for (uint32_t k = from.first_triangle; k < from.first_triangle + from.triangle_count; ++k) {
      if (part_of[k] != part) continue;
      const Vec3u t = mesh.triangles[k];
      const uint32_t x = keep(t.x), y = keep(t.y), z = keep(t.z);
      out.triangles.push_back({x, y, z});
    }
    const auto count = static_cast<uint32_t>(out.triangles.size()) - first;
    if (count > 0) out.parts.push_back({first, count, from.material, from.entity});
  }
  return out;
}

// The part of each triangle; nothing where a part is missing.
std::vector<size_t> PartsBy(const BicycleMeasures& measures, const std::vector<uint32_t>& pieces,
                            const std::map<uint32_t, std::vector<Vec3f>>& points) {
  std::map<uint32_t, size_t> part_of_piece;
  std::array<float, kBicycleParts> reach{};
  for (const auto& [piece, of] : points) {
    const size_t part = part_of_piece[piece] = PartOf(measures, of);
    if (part < kBicycleParts) reach[part] = std::max(reach[part], ReachFrom(of, part == 0 ? measures.front_hub : measures.rear_hub));
  }
  if (std::min(reach[0], reach[1]) < measures.wheel_radius - kNear || std::ranges::count(reach, 0.0f) > 0) return {};
  std::vector<size_t> part_of;
  for (const uint32_t piece : pieces) part_of.push_back(part_of_piece[piece]);
  return part_of;
}

// Where a mesh is to be cut.
struct CutPlan {
  const BicycleMeasures* measures = nullptr;
  std::vector<size_t> part_of;  // by triangle
};

CutPlan CutUp(const Mesh& mesh) {
  const std::vector<uint32_t> pieces = Pieces(mesh);
  std::map<uint32_t, std::vector<Vec3f>> points;
  for (size_t k = 0; k < pieces.size(); ++k) {
    const Vec3u t = mesh.triangles[k];
    for (const uint32_t v : {t.x, t.y, t.z}) points[pieces[k]].push_back(mesh.positions[v]);
  }
  for (const BicycleMeasures& measures : kBicycleMeasures)
    if (std::vector<size_t> part_of = PartsBy(measures, pieces, points); !part_of.empty()) return {&measures, std::move(part_of)};
  return {};
}

AffineTransform TurnedAbout(Vec3f axle, double angle) {
  Mat3f A;
  const Mat3d R = RotationX(angle);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) A.m[i][j] = static_cast<float>(R.m[i][j]);
  return {A, axle - A * axle};
}

}  // namespace

const BicycleMeasures* MeasuresOf(const Mesh& bicycle) { return CutUp(bicycle).measures; }

std::optional<BicycleMeshes> AddBicycleMeshes(MeshId bicycle, Scene& scene) {
  const CutPlan plan = CutUp(scene.meshes[bicycle]);
  if (plan.measures == nullptr) return std::nullopt;
  constexpr const char* kNames[] = {"front wheel", "rear wheel", "cranks", "left pedal", "right pedal", "frame"};
  BicycleMeshes meshes{.measures = plan.measures};
  for (size_t part = 0; part <= kBicycleParts; ++part) {
    (part == kFramePart ? meshes.frame : meshes.part[part]) = static_cast<MeshId>(scene.meshes.size());
    scene.meshes.push_back(CutOut(scene.meshes[bicycle], plan.part_of, part, kNames[part]));
  }
  return meshes;
}

AffineTransform PlaceOfPart(const BicycleMeasures& measures, BicyclePart part, const Cycling& cycling, double pitch) {
  // +X of the mesh is the axis about which what rolls forwards turns.
  const AffineTransform cranks = TurnedAbout(measures.bracket, cycling.crank - double{measures.built_crank});
  switch (part) {
    case BicyclePart::kFrontWheel:
      return TurnedAbout(measures.front_hub, cycling.wheel);
    case BicyclePart::kRearWheel:
      return TurnedAbout(measures.rear_hub, cycling.wheel);
    case BicyclePart::kCranks:
      return cranks;
    case BicyclePart::kLeftPedal:
    case BicyclePart::kRightPedal:
      break;
  }
  const Vec3f pedal = measures.Pedal(part == BicyclePart::kLeftPedal);
  AffineTransform X = TurnedAbout(pedal, pitch);
  X.p = X.p + (cranks * pedal - pedal);
  return X;
}

}  // namespace airsim360::internal

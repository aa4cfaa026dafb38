#include "levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "connected.h"
#include "layers.h"

namespace airsim360::bake {
namespace {

constexpr size_t kTrianglesOf[kBakedLevels] = {26000, 6000, 1250, 300};

// What each level may be off by at most, metres, and how far garments are kept from what they cover: further than
// that, or skin shows through them.
constexpr float kMostError[kBakedLevels] = {0.004f, 0.02f, 0.035f, 0.06f};
constexpr float kGap[kBakedLevels] = {0.004f, 0.008f, 0.016f, 0.03f};
constexpr float kCrumb[kBakedLevels] = {0, 0.012f, 0.05f, 0.1f};

// Hair and shoes are of many parts and seams, which simplifying does not get below a thousand triangles: far off they are
// made anew on a grid.
void MakeCoarse(size_t triangles, Piece& p) {
  if (p.indices.size() / 3 <= triangles) return;
  std::vector<uint32_t> fewer(p.indices.size());
  const size_t count = meshopt_simplifySloppy(fewer.data(), p.indices.data(), p.indices.size(), &p.positions[0].x, p.positions.size(), sizeof(Vec3f), 3 * triangles, 1.0f, nullptr);
  if (count == 0) return;
  fewer.resize(count);
  p.indices = std::move(fewer);
  p.whole = true;
}

// Adds a piece to a level, without the vertices that no triangle has.
void Append(const Piece& p, BodyLevel& out) {
  const std::vector<uint32_t>& indices = p.indices;
  const std::vector<Vec3f> normals = SmoothNormals(p);
  std::vector<uint32_t> remap(p.positions.size());
  meshopt_optimizeVertexFetchRemap(remap.data(), indices.data(), indices.size(), p.positions.size());
  const auto first = static_cast<uint32_t>(out.mesh.positions.size());
  uint32_t used = 0;
  for (uint32_t r : remap) used = r == ~0u ? used : std::max(used, r + 1);
  out.mesh.positions.resize(first + used);
  out.mesh.uvs.resize(first + used);
  out.mesh.normals.resize(first + used);
  out.influences.resize(first + used);
  for (size_t v = 0; v < remap.size(); ++v) {
    if (remap[v] == ~0u) continue;
    out.mesh.positions[first + remap[v]] = p.positions[v];
    out.mesh.uvs[first + remap[v]] = p.uvs[v];
    out.influences[first + remap[v]] = p.influences[v];
    out.mesh.normals[first + remap[v]] = normals[v] == Vec3f{} ? Vec3f{0, 0, 1} : normals[v];
  }
  const auto start = static_cast<uint32_t>(out.mesh.triangles.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3)
    out.mesh.triangles.push_back({first + remap[indices[i]], first + remap[indices[i + 1]], first + remap[indices[i + 2]]});
  out.mesh.parts.push_back({start, static_cast<uint32_t>(out.mesh.triangles.size()) - start, p.material, kNoEntity});
}

}  // namespace

std::vector<std::vector<uint32_t>> SimplifyTogether(std::span<const Piece> pieces, size_t triangles, float most) {
  std::vector<std::vector<uint32_t>> out;
  const auto with = [&](float error) {
    out.clear();
    size_t sum = 0;
    for (const Piece& p : pieces) {
      std::vector<uint32_t> fewer = p.indices;
      if (!p.whole && error > 0) {
        const float scale = meshopt_simplifyScale(&p.positions[0].x, p.positions.size(), sizeof(Vec3f));
        fewer.resize(meshopt_simplify(fewer.data(), p.indices.data(), p.indices.size(), &p.positions[0].x, p.positions.size(),
                                      sizeof(Vec3f), 0, error / scale, 0, nullptr));
      }
      sum += fewer.size() / 3;
      out.push_back(std::move(fewer));
    }
    return sum;
  };
  if (with(0) <= triangles) return out;
  float low = 1e-5f, high = most;
  if (with(high) >= triangles) return out;
  for (int i = 0; i < 12; ++i) {
    const float middle = std::sqrt(low * high);
    (with(middle) > triangles ? low : high) = middle;
  }
  with(high);
  return out;
}

void DropCrumbs(float size, Piece& piece) {
  // Over uv seams: by vertex of the source mesh.
  std::vector<std::array<uint32_t, 3>> faces;
  for (size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
    const uint32_t* t = &piece.indices[i];
    faces.push_back({piece.source[t[0]], piece.source[t[1]], piece.source[t[2]]});
  }
  const size_t count = piece.source.empty() ? 0 : size_t{*std::ranges::max_element(piece.source)} + 1;
  const std::vector<uint32_t> part = ConnectedParts(count, faces);
  std::vector<Box3f> boxes(count);
  for (size_t v = 0; v < piece.positions.size(); ++v) boxes[part[piece.source[v]]].Add(piece.positions[v]);
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < faces.size(); ++i) {
    const Vec3f d = boxes[part[faces[i][0]]].size();
    if (std::max({d.x, d.y, d.z}) >= size) kept.insert(kept.end(), &piece.indices[3 * i], &piece.indices[3 * i] + 3);
  }
  piece.indices = std::move(kept);
}

BodyLevel MakeLevel(std::vector<Piece> pieces, size_t level) {
  // Brows and eyes are for near views.
  if (level >= 2) std::erase_if(pieces, [](const Piece& p) { return p.cloth == Cloth::kOther && p.layer == Layer::kLoose; });
  for (Piece& piece : pieces) {
    if (!piece.whole) DropCrumbs(kCrumb[level], piece);
  }
  std::erase_if(pieces, [](const Piece& p) { return p.indices.empty(); });
  TuckIn(pieces, kGap[level]);
  for (Piece& piece : pieces) {
    if (level >= 2 && piece.cloth == Cloth::kHair) MakeCoarse(level == 2 ? 250 : 36, piece);
    if (level >= 2 && piece.layer == Layer::kShoes) MakeCoarse(level == 2 ? 120 : 48, piece);
  }
  std::vector<std::vector<uint32_t>> simple = SimplifyTogether(pieces, kTrianglesOf[level], kMostError[level]);
  size_t all = 0;
  for (const auto& list : simple) all += list.size() / 3;
  // Suits of many seams are still too many: on a grid too, as many as their share.
  for (size_t k = 0; level >= 2 && all > kTrianglesOf[level] * 21 / 20 && k < pieces.size(); ++k) {
    // A grid leaves gaps where garments are narrow; a plain shirt needs none.
    constexpr size_t kPlain = 130;
    if (pieces[k].whole || simple[k].size() / 3 <= kPlain) continue;
    MakeCoarse(std::max(simple[k].size() / 3 * kTrianglesOf[level] / all, kPlain), pieces[k]);
    if (pieces[k].whole) simple[k] = pieces[k].indices;
  }
  BodyLevel out;
  for (size_t k = 0; k < pieces.size(); ++k) {
    pieces[k].indices = std::move(simple[k]);
    if (!pieces[k].indices.empty()) Append(pieces[k], out);
  }
  out.body_vertices = static_cast<uint32_t>(out.mesh.positions.size());
  return out;
}

}  // namespace airsim360::bake

#include "layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "airsim360/math/angles.h"
#include "airsim360/people/body/loft.h"
#include "airsim360/scene/scene.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::bake {
namespace {

// Vertices of the source mesh that a piece uses, numbered in a row.
struct Sources {
  std::vector<uint32_t> of_vertex;  // vertex -> number
  std::vector<uint32_t> first;      // number -> a vertex
  std::vector<std::vector<uint32_t>> neighbours;

  explicit Sources(const Piece& piece) : of_vertex(piece.positions.size()) {
    std::unordered_map<uint32_t, uint32_t> known;
    for (uint32_t v = 0; v < piece.positions.size(); ++v) {
      const auto [slot, fresh] = known.try_emplace(piece.source[v], static_cast<uint32_t>(first.size()));
      if (fresh) first.push_back(v);
      of_vertex[v] = slot->second;
    }
    neighbours.resize(first.size());
    for (size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = of_vertex[piece.indices[i + k]], b = of_vertex[piece.indices[i + (k + 1) % 3]];
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
      }
    }
  }
};

// Triangles in cells of 2.5 cm, for short rays.
class NearTriangles {
 public:
  void Add(const Piece& piece) {
    for (size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
      const uint32_t* v = &piece.indices[i];
      const std::array<Vec3f, 3> t{piece.positions[v[0]], piece.positions[v[1]], piece.positions[v[2]]};
      bones_.push_back({piece.influences[v[0]], piece.influences[v[1]], piece.influences[v[2]]});
      Box3f box;
      for (const Vec3f& p : t) box.Add(p);
      ForCells(box, [&](uint64_t cell) { cells_[cell].push_back(static_cast<uint32_t>(triangles_.size())); });
      triangles_.push_back(t);
    }
  }
  struct Hit {
    float t = 0, u = 0, v = 0;
    uint32_t triangle = 0;
  };
  // Of the outward faces that the line p + t n meets for t in [from, to]: that of the least t.
  std::optional<Hit> Along(Vec3f p, Vec3f n, float from, float to) const {
    std::optional<Hit> best;
    Box3f box;
    box.Add(p + n * from);
    box.Add(p + n * to);
    ForCells(box, [&](uint64_t cell) {
      const auto found = cells_.find(cell);
      if (found == cells_.end()) return;
      for (const uint32_t k : found->second) {
        std::optional<Hit> hit = Meets(triangles_[k], p, n);
        if (!hit || hit->t < from || hit->t > to || (best && hit->t >= best->t)) continue;
        best = hit;
        best->triangle = k;
      }
    });
    return best;
  }
  // Which bones the garment follows there.
  Influences BonesAt(const Hit& hit) const {
    const auto& bones = bones_[hit.triangle];
    const float u = std::clamp(hit.u, 0.0f, 1.0f), v = std::clamp(hit.v, 0.0f, 1.0f);
    if (u + v <= 0) return bones[0];
    return internal::MixBones(bones[0], internal::MixBones(bones[1], bones[2], v / (u + v)), std::min(1.0f, u + v));
  }
  bool empty() const { return triangles_.empty(); }

 private:
  static constexpr float kCell = 0.025f;

  template <class Do>
  static void ForCells(const Box3f& box, const Do& what) {
    const auto cell = [](float x) { return static_cast<int>(std::floor(x / kCell)) + 4096; };
    for (int x = cell(box.min.x); x <= cell(box.max.x); ++x) {
      for (int y = cell(box.min.y); y <= cell(box.max.y); ++y) {
        for (int z = cell(box.min.z); z <= cell(box.max.z); ++z)
          what(static_cast<uint64_t>(x) << 40 | static_cast<uint64_t>(y) << 20 | static_cast<uint64_t>(z));
      }
    }
  }
  static std::optional<Hit> Meets(const std::array<Vec3f, 3>& t, Vec3f p, Vec3f n) {
    const Vec3f a = t[1] - t[0], b = t[2] - t[0], normal = Cross(a, b);
    // Linings face inwards.
    if (Dot(normal, n) < 0.3f * Norm(normal)) return std::nullopt;
    const Vec3f q = Cross(n, b), s = p - t[0], r = Cross(s, a);
    const float d = Dot(a, q), u = Dot(s, q) / d, v = Dot(n, r) / d;
    constexpr float kEdge = 1e-3f;  // no line slips through between two triangles
    if (!(u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge)) return std::nullopt;
    return Hit{Dot(b, r) / d, u, v};
  }

  std::vector<std::array<Vec3f, 3>> triangles_;
  std::vector<std::array<Influences, 3>> bones_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
};

// How far each source vertex of a piece has to move inwards under what is over it. What is covered follows the bones
// of its cover, so that it stays under in any pose.
std::vector<float> GoUnder(const NearTriangles& over, float gap, const Sources& sources, Piece& piece) {
  constexpr float kSticksOut = 0.02f, kCovered = 0.03f;
  const std::vector<Vec3f> normals = SmoothNormals(piece);
  std::vector<float> depth(sources.first.size());
  std::vector<std::optional<Influences>> bones(sources.first.size());
  for (size_t s = 0; s < depth.size(); ++s) {
    const uint32_t v = sources.first[s];
    const auto hit = over.Along(piece.positions[v], normals[v], -kSticksOut, std::max(gap, kCovered));
    if (!hit) continue;
    depth[s] = std::max(0.0f, gap - hit->t);
    bones[s] = over.BonesAt(*hit);
  }
  for (size_t v = 0; v < piece.positions.size(); ++v) {
    if (const auto& b = bones[sources.of_vertex[v]]) piece.influences[v] = *b;
  }
  return depth;
}

std::shared_ptr<const RayTracer> TracerOf(std::span<const Piece> pieces) {
  SceneBuilder builder("pieces");
  builder.AddMaterial({});
  const EntityId entity = builder.AddEntity("person", builder.tree().At("human/person"));
  for (const Piece& piece : pieces) {
    if (piece.layer == Layer::kLoose || piece.indices.empty()) continue;
    Mesh mesh;
    mesh.positions = piece.positions;
    for (size_t i = 0; i + 2 < piece.indices.size(); i += 3)
      mesh.triangles.push_back({piece.indices[i], piece.indices[i + 1], piece.indices[i + 2]});
    builder.AddInstance({builder.AddMesh(std::move(mesh)), {}, entity});
  }
  return std::make_shared<RayTracer>(builder.Build());
}

// Directions even over the sphere (Fibonacci); half of them lead out of any surface.
std::array<Vec3f, 96> Directions() {
  std::array<Vec3f, 96> d;
  for (size_t k = 0; k < d.size(); ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(d.size()), r = std::sqrt(1 - z * z),
                 a = 2.399963229728653 * static_cast<double>(k);
    d[k] = VecCast<float>(Vec3d{r * std::cos(a), r * std::sin(a), z});
  }
  return d;
}

// Whether a way out of the half space over a vertex is free.
bool IsSeen(const RayTracer& tracer, Vec3f p, Vec3f n) {
  static const std::array<Vec3f, 96> kDirections = Directions();
  const Vec3f from = p + n * 0.0015f;
  return std::ranges::any_of(kDirections, [&](Vec3f d) { return Dot(d, n) > 0.1f && !tracer.Occluded(from + d * 1e-4f, from + d * 3); });
}

}  // namespace

std::vector<Vec3f> SmoothNormals(const Piece& piece) {
  std::unordered_map<uint32_t, Vec3f> sums;
  for (size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
    const uint32_t* t = &piece.indices[i];
    const Vec3f area = Cross(piece.positions[t[1]] - piece.positions[t[0]], piece.positions[t[2]] - piece.positions[t[0]]);
    for (size_t k = 0; k < 3; ++k) sums[piece.source[t[k]]] += area;
  }
  std::vector<Vec3f> normals(piece.positions.size());
  for (size_t v = 0; v < normals.size(); ++v) normals[v] = Normalized(sums[piece.source[v]]);
  return normals;
}

void TuckIn(std::vector<Piece>& pieces, float gap) {
  // From the outermost inwards, so that what lies under two garments goes under where the middle one went.
  for (const Layer layer : {Layer::kBottom, Layer::kShoes, Layer::kSocks, Layer::kSkin}) {
    NearTriangles over;
    for (const Piece& piece : pieces) {
      if (piece.layer > layer && piece.layer != Layer::kLoose) over.Add(piece);
    }
    if (over.empty()) continue;
    for (Piece& piece : pieces) {
      if (piece.layer != layer) continue;
      const Sources sources(piece);
      const std::vector<float> depth = GoUnder(over, gap, sources, piece);
      // No step beside what is covered: neighbours go along by half of it.
      std::vector<float> smooth = depth;
      for (size_t s = 0; s < depth.size(); ++s) {
        for (const uint32_t k : sources.neighbours[s]) smooth[s] = std::max(smooth[s], 0.5f * depth[k]);
      }
      const std::vector<Vec3f> normals = SmoothNormals(piece);
      for (size_t v = 0; v < piece.positions.size(); ++v) piece.positions[v] += normals[v] * -smooth[sources.of_vertex[v]];
    }
  }
}

void DropHidden(std::vector<Piece>& pieces) {
  const auto tracer = TracerOf(pieces);
  for (Piece& piece : pieces) {
    if (piece.layer == Layer::kLoose) continue;
    const Sources sources(piece);
    const std::vector<Vec3f> normals = SmoothNormals(piece);
    std::vector<char> hidden(sources.first.size());
    for (size_t s = 0; s < hidden.size(); ++s) hidden[s] = !IsSeen(*tracer, piece.positions[sources.first[s]], normals[sources.first[s]]);
    for (int ring = 0; ring < 2; ++ring) {
      const std::vector<char> before = hidden;
      for (size_t s = 0; s < hidden.size(); ++s)
        hidden[s] = before[s] && std::ranges::all_of(sources.neighbours[s], [&](uint32_t k) { return before[k] != 0; });
    }
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
      const uint32_t* t = &piece.indices[i];
      if (hidden[sources.of_vertex[t[0]]] && hidden[sources.of_vertex[t[1]]] && hidden[sources.of_vertex[t[2]]]) continue;
      kept.insert(kept.end(), t, t + 3);
    }
    piece.indices = std::move(kept);
  }
}

Piece TakeScalp(Piece& skin, const Piece& hair, Vec3f eyes, Vec3f head_top) {
  NearTriangles over;
  over.Add(hair);
  const std::vector<Vec3f> normals = SmoothNormals(skin);
  const auto under = [&](uint32_t v) {
    const Vec3f p = skin.positions[v];
    if (p.z < eyes.z - 0.6f * (head_top.z - eyes.z)) return false;  // from the nape up
    // A fringe hangs before a forehead, which stays skin.
    if (normals[v].x > 0.45f && p.z < eyes.z + 0.62f * (head_top.z - eyes.z)) return false;
    if (p.x > eyes.x - 0.035f && p.z < eyes.z + 0.4f * (head_top.z - eyes.z)) return false;
    return over.Along(p, normals[v], -0.01f, 0.02f).has_value();
  };
  std::vector<char> covered(skin.positions.size());
  for (uint32_t v = 0; v < skin.positions.size(); ++v) covered[v] = under(v);
  Piece scalp = skin;
  scalp.indices.clear();
  std::vector<uint32_t> kept;
  for (size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
    const uint32_t* t = &skin.indices[i];
    std::vector<uint32_t>& to = covered[t[0]] && covered[t[1]] && covered[t[2]] ? scalp.indices : kept;
    to.insert(to.end(), t, t + 3);
  }
  skin.indices = std::move(kept);
  return scalp;
}

void HangFromHips(Piece& piece, float band) {
  constexpr Joint kLegs[] = {Joint::kLeftHip,  Joint::kLeftKnee,  Joint::kLeftAnkle,  Joint::kLeftToes,
                             Joint::kRightHip, Joint::kRightKnee, Joint::kRightAnkle, Joint::kRightToes};
  for (size_t v = 0; v < piece.positions.size(); ++v) {
    Influences& in = piece.influences[v];
    float legs = 0, rest = 0;
    Influences trunk;
    size_t used = 0;
    for (size_t k = 0; k < 4; ++k) {
      if (in.weight[k] <= 0) continue;
      if (std::ranges::find(kLegs, static_cast<Joint>(in.joint[k])) != std::end(kLegs)) {
        legs += in.weight[k];
      } else if (used < 2) {
        trunk.joint[used] = in.joint[k];
        trunk.weight[used++] = in.weight[k];
        rest += in.weight[k];
      }
    }
    if (legs <= 0) continue;
    const float t = std::clamp(piece.positions[v].y / band + 0.5f, 0.0f, 1.0f), left = t * t * (3 - 2 * t);
    Influences mixed;
    size_t n = 0;
    const auto add = [&](uint8_t joint, float weight) {
      if (weight <= 0) return;
      mixed.joint[n] = joint;
      mixed.weight[n++] = weight / (legs + rest);
    };
    for (size_t k = 0; k < used; ++k) add(trunk.joint[k], trunk.weight[k]);
    add(static_cast<uint8_t>(Joint::kLeftHip), legs * left);
    add(static_cast<uint8_t>(Joint::kRightHip), legs * (1 - left));
    in = mixed;
  }
}

void MakeTaut(Piece& piece, float height) {
  constexpr size_t kWays = 72;
  constexpr float kSlice = 0.02f;  // half the height of what counts as one level
  std::array<Vec2f, kWays> way;
  for (size_t k = 0; k < kWays; ++k) {
    const double a = 2 * kPi * static_cast<double>(k) / kWays;
    way[k] = {static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))};
  }
  float middle = 0;
  for (const Vec3f& p : piece.positions) middle += p.x / static_cast<float>(piece.positions.size());
  const std::vector<Vec3f> before = piece.positions;
  for (Vec3f& p : piece.positions) {
    if (p.z > height) continue;
    // Tangents of what is as high as p, then outwards to the nearest of them.
    std::array<float, kWays> reach{};
    for (const Vec3f& q : before) {
      if (std::abs(q.z - p.z) > kSlice) continue;
      for (size_t k = 0; k < kWays; ++k) reach[k] = std::max(reach[k], (q.x - middle) * way[k].x + q.y * way[k].y);
    }
    const float r = std::hypot(p.x - middle, p.y);
    if (r < 1e-4f) continue;
    const Vec2f out{(p.x - middle) / r, p.y / r};
    float to = 1e9f;
    for (size_t k = 0; k < kWays; ++k) {
      const float c = out.x * way[k].x + out.y * way[k].y;
      if (c > 0.05f) to = std::min(to, reach[k] / c);
    }
    // Fades in over 4 cm, so that no edge runs around.
    const float t = std::clamp((height - p.z) / 0.04f, 0.0f, 1.0f), far = r + t * std::max(0.0f, to - r);
    p.x = middle + out.x * far;
    p.y = out.y * far;
  }
}

}  // namespace airsim360::bake

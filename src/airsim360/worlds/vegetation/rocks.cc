// Rocks: displaced icospheres cut by random planes, so that they have flat facets.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"
#include "airsim360/worlds/texture/texture_synth.h"
#include "airsim360/worlds/vegetation/branching.h"

namespace airsim360::internal {
namespace {

struct Sphere {
  std::vector<Vec3f> points;
  std::vector<Vec3u> triangles;
};

// Unit icosahedron, each triangle split into four `levels` times.
Sphere Icosphere(int levels) {
  const float t = 1.6180340f;
  Sphere s{{{-1, t, 0},
            {1, t, 0},
            {-1, -t, 0},
            {1, -t, 0},
            {0, -1, t},
            {0, 1, t},
            {0, -1, -t},
            {0, 1, -t},
            {t, 0, -1},
            {t, 0, 1},
            {-t, 0, -1},
            {-t, 0, 1}},
           {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
            {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  for (Vec3f& p : s.points) p = Normalized(p);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(s.points.size()));
      if (fresh) s.points.push_back(Normalized(s.points[a] + s.points[b]));
      return it->second;
    };
    std::vector<Vec3u> finer;
    for (Vec3u f : s.triangles) {
      const uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
    }
    s.triangles = std::move(finer);
  }
  return s;
}

// Weathered stone: grains, stains and a few cracks.
const TextureSet& RockTextures() {
  static const TextureSet set =
      SynthesizeTextures({"rock", 1.2f, 0.75f,
                          [](float u, float v) {
                            const WorleyResult cells = TilingWorley(81, u + 0.05f * TilingFbm(82, u, v, 6, 3), v, 5);
                            const float crack = std::clamp(
                                (cells.second - cells.first) * 9 + 1.6f * std::max(0.0f, TilingFbm(86, u, v, 4, 3) + 0.15f), 0.0f, 1.0f);
                            const float stains = TilingFbm(83, u, v, 4, 4), grain = TilingFbm(84, u, v, 48, 2);
                            Texel t;
                            t.color = Vec3f{1.0f, 0.97f, 0.93f} * ((0.82f + 0.18f * crack) * (1 + 0.28f * stains + 0.16f * grain));
                            t.height = 0.004f * crack + 0.010f * TilingFbm(85, u, v, 8, 5);
                            t.roughness = 0.85f;
                            return t;
                          }},
                         256);
  return set;
}

Model MakeRock(uint32_t variant, uint64_t seed) {
  PropBuilder b("rock");
  RngStream random(seed, "rock");
  const Vec3f radii[4] = {{0.55f, 0.42f, 0.42f}, {0.95f, 0.70f, 0.62f}, {0.42f, 0.50f, 0.30f}, {0.75f, 0.60f, 0.80f}};
  const Vec3f tones[4] = {{0.30f, 0.28f, 0.25f}, {0.24f, 0.23f, 0.22f}, {0.34f, 0.29f, 0.23f}, {0.27f, 0.265f, 0.26f}};
  Sphere s = Icosphere(4);

  // Cut by planes, then roughen.
  std::array<std::pair<Vec3f, float>, 40> planes;
  for (size_t i = 0; i < planes.size(); ++i) {
    auto& [n, distance] = planes[i];
    n = Normalized(Vec3f{static_cast<float>(random.Normal()), static_cast<float>(random.Normal()), static_cast<float>(random.Normal())});
    distance = static_cast<float>(&n < &planes[16].first ? random.Uniform(0.62, 0.88) : random.Uniform(0.80, 0.96));
  }
  for (Vec3f& p : s.points) {
    const Vec3f d = p;
    float r = 1.0f;
    for (const auto& [n, distance] : planes) {
      const float c = Dot(d, n);
      if (c > 0.2f) r = std::min(r, distance / c);
    }
    r *= 0.93f + 0.14f * Noise(d * 2.2f, seed) + 0.05f * Noise(d * 7.0f, seed + 7) + 0.02f * Noise(d * 19.0f, seed + 9);
    p = d * r * radii[variant];
  }
  // A third of it is in the ground.
  const float sink = radii[variant].z * 0.62f;
  std::vector<Vec3f> normals(s.points.size());
  for (Vec3u t : s.triangles) {
    const Vec3f n = Cross(s.points[t.y] - s.points[t.x], s.points[t.z] - s.points[t.x]);
    for (uint32_t i : {t.x, t.y, t.z}) normals[i] += n;
  }
  b.Use(Stone(tones[variant]), RockTextures().color, {1.2f, 1.2f}, &RockTextures().normal);
  for (Vec3u t : s.triangles) {
    const Vec3f up{0, 0, sink};
    const Vec3f p[3] = {s.points[t.x] + up, s.points[t.y] + up, s.points[t.z] + up};
    if (p[0].z < -0.15f && p[1].z < -0.15f && p[2].z < -0.15f) continue;
    // Facets stay crisp: half the face normal, half the smooth one.
    const Vec3f face = Normalized(Cross(p[1] - p[0], p[2] - p[0]));
    const auto n = [&](uint32_t i) { return Normalized(face * 1.6f + Normalized(normals[i])); };
    // The texture is laid on from the side that the face looks to.
    const int axis =
        std::abs(face.x) > std::abs(face.y) ? (std::abs(face.x) > std::abs(face.z) ? 0 : 2) : (std::abs(face.y) > std::abs(face.z) ? 1 : 2);
    const auto uv = [&](Vec3f q) { return Vec2f{q[(axis + 1) % 3], q[(axis + 2) % 3]}; };
    b.mesh().SmoothTriangle(p, {n(t.x), n(t.y), n(t.z)}, {uv(p[0]), uv(p[1]), uv(p[2])});
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> RockKinds() { return {{"rock", "nature/rock", 4, MakeRock, 0.9f, 0.35f, 1.5f, 5200}}; }

}  // namespace airsim360::internal

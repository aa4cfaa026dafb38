#include "airsim360/worlds/vegetation/plant_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/finishes.h"

namespace airsim360::internal {
namespace {

Vec3f Across(Vec3f axis) { return Normalized(Cross(axis, std::abs(axis.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0})); }

// Left and right border of a picture of the atlas, with a margin.
std::pair<float, float> CellRange(int cell) {
  const float w = 1.0f / kLeafCells, left = w * static_cast<float>(cell % kLeafCells);
  return {left + 0.08f * w, left + 0.92f * w};
}

// The side of a blade that looks up: its shading normal looks up more than the blade does, because lawns are lit from
// above. Corners turn around that side, which other renderers take for the front.
struct BladeFace {
  BladeFace(Vec3f side, Vec3f along) {
    const Vec3f facing = Normalized(Cross(side, along));
    upwards = facing.z >= 0;
    normal = Normalized((upwards ? facing : -facing) + Vec3f{0, 0, 0.6f});
  }
  Vec3u Turned(Vec3u t) const { return upwards ? t : Vec3u{t.x, t.z, t.y}; }
  Vec3f normal;
  bool upwards;
};

// One ring of a branch.
struct BarkRing {
  Vec3f p, axis, side;
  float radius, v;
};

int SidesFor(float radius) { return radius > 0.11f ? 12 : radius > 0.05f ? 8 : radius > 0.02f ? 5 : 3; }

// Joins rings to tubes; the number of sides falls with the radius, then a new run of rings starts at the same
// place.
void AddTube(PlantLayer& layer, const std::vector<BarkRing>& rings, float flare) {
  const float tiles = std::max(1.0f, std::round(kTauF * rings.front().radius / 0.5f));
  uint32_t previous = 0;
  int sides = 0;
  const auto add_ring = [&](const BarkRing& ring, int count) {
    const auto first = static_cast<uint32_t>(layer.positions.size());
    for (int k = 0; k <= count; ++k) {
      const float a = kTauF * static_cast<float>(k % count) / static_cast<float>(count);
      const Vec3f out = ring.side * std::cos(a) + Cross(ring.axis, ring.side) * std::sin(a);
      // The foot of a trunk widens into five buttresses.
      const float foot = flare > 0 ? std::exp(-std::max(0.0f, ring.p.z + 0.05f) / flare) : 0.0f;
      const float r = ring.radius * (1 + foot * (0.45f + 0.40f * foot * std::cos(5 * a + 1)));
      layer.Add(ring.p + out * r, out, {tiles * static_cast<float>(k) / static_cast<float>(count), -ring.v});
    }
    return first;
  };
  for (size_t i = 0; i < rings.size(); ++i) {
    const int wanted = SidesFor(rings[i].radius);
    if (i == 0) {
      sides = wanted;
      previous = add_ring(rings[i], sides);
      continue;
    }
    const uint32_t next = add_ring(rings[i], sides);
    for (uint32_t k = 0; k < static_cast<uint32_t>(sides); ++k) {
      layer.triangles.push_back({previous + k, previous + k + 1, next + k + 1});
      layer.triangles.push_back({previous + k, next + k + 1, next + k});
    }
    previous = next;
    if (wanted < sides && i + 1 < rings.size()) {
      sides = wanted;
      previous = add_ring(rings[i], sides);
    }
  }
}

}  // namespace

uint32_t PlantLayer::Add(Vec3f p, Vec3f n, Vec2f uv) {
  positions.push_back(p);
  shading_normals.push_back(n);
  uvs.push_back(uv);
  return static_cast<uint32_t>(positions.size() - 1);
}

PlantLayer BarkLayer(Vec3f color) {
  PlantLayer layer;
  layer.material = Stone(color, 0.9f);
  layer.material.name = "bark";
  layer.texture = &BarkTexture();
  layer.normals = &BarkNormals();
  return layer;
}

PlantLayer LeafLayer(const Texture& atlas, float transmission) {
  PlantLayer layer;
  layer.material = Leaf({1, 1, 1}, transmission);
  layer.texture = &atlas;
  return layer;
}

std::vector<PlantLayer> PlantLayers(Vec3f bark, const Texture& atlas, float transmission, float depth) {
  std::vector<PlantLayer> layers = {BarkLayer(bark)};
  for (float full : {0.46f, 0.72f, 1.0f}) {
    const float light = 1 - (1 - full) * depth;
    layers.push_back(LeafLayer(atlas, transmission));
    layers.back().material.base_color = {light, light, light * 0.97f};
  }
  return layers;
}

PlantLayer& LeavesAt(std::vector<PlantLayer>& layers, float openness) { return layers[openness < 0.36f ? 1 : openness < 0.68f ? 2 : 3]; }

Texture LeafAtlas(std::string name, std::span<const Vec3f> tones) {
  Image<Rgba8> image = Shade(kLeafCells * 32, 64, [&](float u, float v) {
    const float position = u * kLeafCells;
    const int cell = std::min(kLeafCells - 1, static_cast<int>(position));
    const float x = std::abs(2 * (position - static_cast<float>(cell)) - 1);
    const float value = 0.78f + 0.45f * TileNoise(static_cast<float>(cell) + 0.5f, 0.5f, 64, 64, 71);
    // Rib and side veins that rise towards the edge; darker and duller edge.
    const float rib = std::max(0.0f, 1 - x * 9), phase = (v + 0.35f * x) * 7,
                vein = std::max(0.0f, 1 - 7 * std::abs(phase - std::round(phase)));
    const float tone = value * (1 + 0.55f * rib + 0.20f * vein * (1 - x) - 0.22f * x);
    Vec3f c = tones[static_cast<size_t>(cell) % tones.size()];
    if (cell == kLeafCells - 1) c = c * 0.5f + Vec3f{0.16f, 0.13f, 0.022f};
    return c * tone;
  });
  Texture texture = Texture::FromImage(std::move(name), std::move(image), true);
  // Far away all cells mix: that is the crown's mean colour.
  texture.wrap_u = texture.wrap_v = Wrap::kClamp;
  return texture;
}

void AddLeaf(PlantLayer& layer, Vec3f base, Vec3f direction, Vec3f up, const LeafShape& shape, int cell, Vec3f soften) {
  const Vec3f side = Normalized(Cross(direction, up)), n = Cross(side, direction);
  const Vec3f lift = n * (shape.fold * shape.width), shading = Normalized(n + soften);
  const Vec3f middle = base + direction * (0.42f * shape.length) + lift, across = side * (shape.width / 2);
  const Vec3f tip = base + direction * shape.length - n * (shape.droop * shape.length);
  const auto [u0, u1] = CellRange(cell);
  const float u = (u0 + u1) / 2;
  const uint32_t a = layer.Add(base, shading, {u, 1});
  if (shape.form == LeafForm::kKite) {
    layer.Add(middle + across, shading, {u1, 0.58f});
    layer.Add(tip, shading, {u, 0});
    layer.Add(middle - across, shading, {u0, 0.58f});
    layer.triangles.push_back({a, a + 1, a + 2});
    layer.triangles.push_back({a, a + 2, a + 3});
    return;
  }
  // Two points a side: the side lobe and the notch.
  constexpr float kLow = 0.52f, kHigh = 0.56f, kWide = 0.5f, kNarrow = 0.20f;
  const Vec3f slack = n * (-0.35f * shape.droop * shape.length);
  const auto rim = [&](float along, float out) {
    return base + direction * (along * shape.length) + side * (out * shape.width) + lift + slack * (along * along);
  };
  layer.Add(rim(kLow, kWide), shading, {u1, 1 - kLow});
  layer.Add(rim(kHigh, kNarrow), shading, {0.3f * u0 + 0.7f * u1, 1 - kHigh});
  layer.Add(tip, shading, {u, 0});
  layer.Add(rim(kHigh, -kNarrow), shading, {0.7f * u0 + 0.3f * u1, 1 - kHigh});
  layer.Add(rim(kLow, -kWide), shading, {u0, 1 - kLow});
  layer.triangles.insert(layer.triangles.end(), {{a, a + 1, a + 2}, {a, a + 2, a + 4}, {a + 2, a + 3, a + 4}, {a, a + 4, a + 5}});
}

void AddBlade(PlantLayer& layer, Vec3f base, float height, float width, Vec3f lean, float turn, int cell) {
  const Vec3f side = Vec3f{std::cos(turn), std::sin(turn), 0} * (width / 2);
  const float bend = Norm(lean);
  const Vec3f middle = base + Vec3f{0, 0, height * 0.5f} + lean * (height * 0.15f);
  const Vec3f tip = base + Vec3f{0, 0, height * (1 - 0.3f * bend)} + lean * (height * 0.6f);
  const BladeFace face(side, tip - base);
  const auto [u0, u1] = CellRange(cell);
  const uint32_t a = layer.Add(base - side, face.normal, {u0, 1});
  layer.Add(base + side, face.normal, {u1, 1});
  layer.Add(middle + side * 0.85f, face.normal, {u1, 0.5f});
  layer.Add(middle - side * 0.85f, face.normal, {u0, 0.5f});
  layer.Add(tip, face.normal, {(u0 + u1) / 2, 0});
  for (const Vec3u t : {Vec3u{a, a + 1, a + 2}, Vec3u{a, a + 2, a + 3}, Vec3u{a + 3, a + 2, a + 4}})
    layer.triangles.push_back(face.Turned(t));
}

void AddCutBlade(PlantLayer& layer, Vec3f base, float cut, float width, Vec3f lean, float turn, int cell) {
  const Vec3f side = Vec3f{std::cos(turn), std::sin(turn), 0} * (width / 2), top = base + Vec3f{0, 0, cut} + lean * (0.7f * cut);
  const BladeFace face(side, top - base);
  const auto [u0, u1] = CellRange(cell);
  const uint32_t a = layer.Add(base - side, face.normal, {u0, 1});
  layer.Add(base + side, face.normal, {u1, 1});
  layer.Add(top + side * 0.85f, face.normal, {u1, 0.1f});
  layer.Add(top - side * 0.85f, face.normal, {u0, 0.1f});
  for (const Vec3u t : {Vec3u{a, a + 1, a + 2}, Vec3u{a, a + 2, a + 3}}) layer.triangles.push_back(face.Turned(t));
}

void AddNeedle(PlantLayer& layer, Vec3f base, Vec3f tip, Vec3f side, float width, Vec3f normal, int cell) {
  const auto [u0, u1] = CellRange(cell);
  const uint32_t a = layer.Add(base - side * (width / 2), normal, {u0, 1});
  layer.Add(base + side * (width / 2), normal, {u1, 1});
  layer.Add(tip, normal, {(u0 + u1) / 2, 0});
  const bool agrees = Dot(Cross(side, tip - base), normal) >= 0;
  layer.triangles.push_back(agrees ? Vec3u{a, a + 1, a + 2} : Vec3u{a, a + 2, a + 1});
}

void AddBark(PlantLayer& layer, const std::vector<BranchNode>& nodes, float min_radius, float flare) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    // A branch starts where a node is not the main child of its parent.
    const int parent = nodes[i].parent;
    const bool continues = parent >= 0 && nodes[static_cast<size_t>(parent)].main == static_cast<int>(i);
    if (continues || nodes[i].radius < min_radius) continue;
    std::vector<int> chain;
    if (parent >= 0) chain.push_back(parent);
    for (int k = static_cast<int>(i); k >= 0 && nodes[static_cast<size_t>(k)].radius >= min_radius; k = nodes[static_cast<size_t>(k)].main)
      chain.push_back(k);
    if (chain.size() < 2) continue;

    // Rings with frames carried along; thin branches skip every other joint.
    std::vector<BarkRing> rings;
    float v = 0;
    Vec3f last = nodes[static_cast<size_t>(chain[0])].p;
    for (size_t k = 0; k < chain.size(); ++k) {
      const BranchNode& node = nodes[static_cast<size_t>(chain[k])];
      const bool end = k == 0 || k + 1 == chain.size();
      if (!end && node.radius < 0.03f && k % 2 == 0) continue;
      const Vec3f before = nodes[static_cast<size_t>(chain[k > 0 ? k - 1 : 0])].p,
                  after = nodes[static_cast<size_t>(chain[std::min(k + 1, chain.size() - 1)])].p;
      const Vec3f axis = Normalized(after - before);
      const Vec3f s = rings.empty() ? Across(axis) : rings.back().side;
      v += Norm(node.p - last);
      last = node.p;
      // A side branch leaves its parent at its own width, not at the parent's.
      const float radius = k == 0 && parent >= 0 ? std::min(node.radius * 0.8f, nodes[i].radius * 1.3f) : node.radius;
      rings.push_back({node.p, axis, Normalized(s - axis * Dot(s, axis)), k + 1 == chain.size() ? radius * 0.6f : radius, v});
    }
    // The pipe model drops at every fork; wood closes such steps.
    for (int pass = 0; pass < 6; ++pass) {
      float before = rings.front().radius;
      for (size_t k = 1; k + 1 < rings.size(); ++k) {
        const float smooth = 0.25f * before + 0.5f * rings[k].radius + 0.25f * rings[k + 1].radius;
        before = std::exchange(rings[k].radius, smooth);
      }
    }
    AddTube(layer, rings, parent < 0 ? flare : 0.0f);
  }
}

Model JoinLayers(std::string name, std::span<const PlantLayer> layers) {
  Model model;
  model.mesh.name = std::move(name);
  Mesh& mesh = model.mesh;
  std::map<const Texture*, TextureId> known;
  const auto add = [&](const Texture* texture) {
    if (!texture) return kNoTexture;
    const auto [it, fresh] = known.try_emplace(texture, static_cast<TextureId>(model.textures.size()));
    if (fresh) model.textures.push_back(*texture);
    return it->second;
  };
  for (const PlantLayer& layer : layers) {
    if (layer.triangles.empty()) continue;
    Material material = layer.material;
    material.base_color_texture = add(layer.texture);
    material.normal_texture = add(layer.normals);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.parts.push_back({static_cast<uint32_t>(mesh.triangles.size()), static_cast<uint32_t>(layer.triangles.size()),
                          static_cast<MaterialId>(model.materials.size()), kNoEntity});
    mesh.positions.insert(mesh.positions.end(), layer.positions.begin(), layer.positions.end());
    mesh.normals.insert(mesh.normals.end(), layer.shading_normals.begin(), layer.shading_normals.end());
    mesh.uvs.insert(mesh.uvs.end(), layer.uvs.begin(), layer.uvs.end());
    for (Vec3u t : layer.triangles) mesh.triangles.push_back({t.x + first, t.y + first, t.z + first});
    model.materials.push_back(std::move(material));
  }
  return model;
}

}  // namespace airsim360::internal

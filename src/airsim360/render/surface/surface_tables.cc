#include "airsim360/render/surface/surface_tables.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>
#include <type_traits>

#include "airsim360/base/parallel.h"
#include "airsim360/image/color.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/noise.h"
#include "airsim360/render/surface/bent_normals.h"

namespace airsim360::internal {
namespace {

// The kernels know the kinds of surfaces and of wear by number.
static_assert(static_cast<float>(SurfaceKind::kFoliage) == kFoliage && static_cast<float>(SurfaceKind::kGlass) == kGlass &&
              static_cast<float>(SurfaceKind::kWater) == kWater);
static_assert(static_cast<int>(GroundWear::kAsphalt) == 1 && static_cast<int>(GroundWear::kPaving) == 3 &&
              static_cast<int>(GroundWear::kSoil) == 6 && static_cast<int>(GroundWear::kRoofRolls) == 8);

constexpr int kNoiseSize = 256;
constexpr int kOwnTextures = 2;

// std::lround where it is a call for each of millions of triangles: the sum is exact, for a double has room for it.
int Rounded(float x) {
  constexpr double kFits = 2e9;
  const double y = x;
  return std::fabs(y) < kFits ? static_cast<int>(y + std::copysign(0.5, y)) : static_cast<int>(std::lround(x));
}

uint32_t Pack16(float x, float y) {
  const auto quantize = [](float v) { return static_cast<uint32_t>(Rounded((std::clamp(v, -1.0f, 1.0f) * 0.5f + 0.5f) * 65534.0f)); };
  return quantize(x) | quantize(y) << 16;
}

// Hash of the middle of a triangle's longest edge: the diagonal, where two triangles make a rectangle.
uint32_t PaneHash(Vec3f a, Vec3f b, Vec3f c) {
  const float ab = Norm(b - a), bc = Norm(c - b), ca = Norm(a - c);
  const Vec3f middle = (ab >= bc && ab >= ca ? a + b : bc >= ca ? b + c : c + a) * 25.0f;
  return HashLattice(Rounded(middle.x), Rounded(middle.y), Rounded(middle.z));
}

// Imported coordinates may be anything; look-ups need numbers with a fraction.
Vec2f Sane(Vec2f uv) {
  const auto sane = [](float x) { return std::isfinite(x) ? std::clamp(x, -1e6f, 1e6f) : 0.0f; };
  return {sane(uv.x), sane(uv.y)};
}

// The rectangle that a right-angled triangle is half of, as a pane; false for other triangles.
bool MakePane(const Vec3f (&p)[3], const float (&uv)[6], Vec3f normal, PaneRecord& pane) {
  // The corner opposite the longest edge has the right angle.
  int corner = 0;
  for (int k = 1; k < 3; ++k) {
    const auto opposite = [&](int i) { return Norm(p[(i + 1) % 3] - p[(i + 2) % 3]); };
    if (opposite(k) > opposite(corner)) corner = k;
  }
  const Vec3f c = p[corner], one = p[(corner + 1) % 3], two = p[(corner + 2) % 3];
  const Vec3f e1 = one - c, e2 = two - c;
  const float l1 = Norm(e1), l2 = Norm(e2);
  if (!(l1 > 1e-3f) || !(l2 > 1e-3f) || std::fabs(Dot(e1, e2)) > 0.01f * l1 * l2) return false;

  // Upright is the side that climbs more; right follows from the face, so both halves agree.
  const bool first_up = std::fabs(e1.z) * l2 > std::fabs(e2.z) * l1;
  Vec3f up = first_up ? e1 * (1 / l1) : e2 * (1 / l2);
  if (up.z < 0 || (up.z == 0 && up.y < 0)) up = up * -1.0f;
  const Vec3f right = Normalized(Cross(up, normal));
  const Vec3f centre = (one + two) * 0.5f;
  pane.half_a = 0.5f * (first_up ? l2 : l1);
  pane.half_b = 0.5f * (first_up ? l1 : l2);
  for (int k = 0; k < 3; ++k) {
    pane.a[k] = Dot(p[k] - centre, right);
    pane.b[k] = Dot(p[k] - centre, up);
  }
  pane.right = PackDirection(right);
  pane.up = PackDirection(up);

  // Texture coordinates along a and b.
  const float a1 = pane.a[1] - pane.a[0], b1 = pane.b[1] - pane.b[0], a2 = pane.a[2] - pane.a[0], b2 = pane.b[2] - pane.b[0],
              det = a1 * b2 - a2 * b1;
  pane.u_per_a = ((uv[2] - uv[0]) * b2 - (uv[4] - uv[0]) * b1) / det;
  pane.v_per_b = ((uv[5] - uv[1]) * a1 - (uv[3] - uv[1]) * a2) / det;
  return std::isfinite(pane.u_per_a) && std::isfinite(pane.v_per_b);
}

TriangleRecord MakeTriangle(const Mesh& mesh, uint32_t index, uint32_t material, const UvTransform& transform) {
  const Vec3u t = mesh.triangles[index];
  const uint32_t corners[3] = {t.x, t.y, t.z};
  const Vec3f p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  const Vec3f e1 = p[1] - p[0], e2 = p[2] - p[0], cross = Cross(e1, e2);
  Vec3f normal = Normalized(cross);
  if (normal == Vec3f{}) normal = {0, 0, 1};
  TriangleRecord record{};
  record.material = material;
  record.geometric_normal = PackDirection(normal);
  record.area = Norm(cross);
  record.pane = PaneHash(p[0], p[1], p[2]);

  // Vertex normals and texture coordinates.
  Vec2f uv[3];
  Vec3f packed = normal;  // what was packed last: most triangles of a town are flat
  uint32_t packed_bits = record.geometric_normal;
  for (int k = 0; k < 3; ++k) {
    Vec3f n = mesh.normals.empty() ? normal : Normalized(mesh.normals[corners[k]]);
    if (!(Dot(n, n) > 0.5f)) n = normal;
    if (!(n == packed)) packed = n, packed_bits = PackDirection(n);
    record.normals[k] = packed_bits;
    if (!mesh.uvs.empty()) uv[k] = Sane(transform * mesh.uvs[corners[k]]);
    record.uv[2 * k] = uv[k].x;
    record.uv[2 * k + 1] = uv[k].y;
  }

  // Texture frame: p = p0 + tangent * u + ..., and how many uv units a metre has.
  const Vec2f d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
  const float det = d1.x * d2.y - d2.x * d1.y;
  Vec3f tangent = std::fabs(det) > 1e-20f ? Normalized((e1 * d2.y - e2 * d1.y) * (det > 0 ? 1.0f : -1.0f)) : Normalized(e1);
  if (tangent == Vec3f{}) tangent = {1, 0, 0};
  record.tangent = PackDirection(tangent);
  const float texels_log2 = 0.5f * std::log2(std::max(std::fabs(det), 1e-12f) / std::max(Norm(cross), 1e-12f));
  record.texels_log2 = std::isfinite(texels_log2) ? texels_log2 : 0;
  // Green of a normal map points against growing v.
  const Vec3f against_v = (e1 * d2.x - e2 * d1.x) * (det > 0 ? 1.0f : -1.0f);
  if (Dot(Cross(normal, tangent), against_v) < 0) record.material |= kMirroredUv;
  return record;
}

InstanceRecord MakeInstance(const Instance& instance, const AffineTransform& X_WM, uint32_t first_triangle, uint32_t index) {
  // Cofactors: the inverse transpose times the determinant, whose sign is taken back.
  const Mat3f& A = X_WM.A;
  const float det = A.determinant();
  const Vec3f rows[3] = {Cross(A.row(1), A.row(2)), Cross(A.row(2), A.row(0)), Cross(A.row(0), A.row(1))};
  const float scale = std::cbrt(std::max(std::fabs(det), 1e-30f));
  InstanceRecord record{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) record.normal_matrix[3 * i + j] = rows[i][j] * ((det < 0 ? -1.0f : 1.0f) / (scale * scale));
    record.tint[i] = instance.tint[i];
  }
  record.texels_log2 = -std::log2(scale);
  record.first_triangle = first_triangle;
  record.hash = HashLattice(static_cast<int>(index), 77, 3);
  return record;
}

int32_t TextureIndex(TextureId id, const Scene& scene) {
  return id == kNoTexture || scene.textures[id].levels.empty() || scene.textures[id].levels[0].empty() ? 0 : id + kOwnTextures;
}

// Mean of a texture, linear; white without one.
Vec3f MeanTexel(TextureId id, const Scene& scene) {
  if (TextureIndex(id, scene) == 0) return {1, 1, 1};
  const Texture& texture = scene.textures[id];
  const Rgba8 p = texture.levels.back()(0, 0);
  const auto decode = [&](uint8_t v) { return texture.srgb ? SrgbToLinear(v) : static_cast<float>(v) / 255.0f; };
  return {decode(p.r), decode(p.g), decode(p.b)};
}

MaterialRecord MakeMaterial(const Material& m, const Scene& scene) {
  MaterialRecord record{};
  for (int i = 0; i < 3; ++i) {
    record.base[i] = m.base_color[i];
    record.emission[i] = m.emission[i];
  }
  record.metallic = m.metallic;
  record.roughness = m.roughness;
  record.transmission = m.transmission;
  record.macro_variation = m.macro_variation;
  record.normal_scale = m.normal_scale;
  record.kind = static_cast<float>(m.kind);
  record.clear_coat = m.clear_coat;
  record.clear_coat_roughness = m.clear_coat_roughness;
  record.base_texture = TextureIndex(m.base_color_texture, scene);
  record.roughness_texture = TextureIndex(m.metallic_roughness_texture, scene);
  record.normal_texture = TextureIndex(m.normal_texture, scene);
  record.emission_texture = TextureIndex(m.emission_texture, scene);
  const Vec3f mean = MeanTexel(m.base_color_texture, scene);
  for (int i = 0; i < 3; ++i) record.mean[i] = mean[i];
  record.tile = 1 / std::max(std::fabs(m.uv_scale.x), 1e-6f);
  record.blend = m.blend_tiles ? 1.0f : 0.0f;
  record.unit_columns = m.units.x;
  record.unit_rows = m.units.y;
  record.ground = static_cast<float>(m.ground);
  record.interior = m.interior && m.kind == SurfaceKind::kGlass ? 1.0f : 0.0f;
  const bool window = m.kind == SurfaceKind::kGlass && m.lamp && record.emission_texture == 0;
  record.beam = m.beam == 0 && window && record.interior == 0 ? kWindowBeam : m.beam;
  return record;
}

TextureRecord MakeTexture(const Texture& texture) {
  TextureRecord record{};
  const int count = std::min<int>(static_cast<int>(texture.levels.size()), TextureRecord::kMaxLevels);
  for (int i = 0; i < count; ++i) {
    const Image<Rgba8>& level = texture.levels[i];
    record.levels[i] = {reinterpret_cast<const uint32_t*>(level.pixels().data()), static_cast<float>(level.width()),
                        static_cast<float>(level.height())};
  }
  if (count > 0) record.size_log2 = 0.5f * std::log2(record.levels[0].width * record.levels[0].height);
  record.last_level = static_cast<float>(std::max(0, count - 1));
  record.srgb = texture.srgb ? 1.0f : 0.0f;
  record.wrap_u = static_cast<uint8_t>(texture.wrap_u);
  record.wrap_v = static_cast<uint8_t>(texture.wrap_v);
  return record;
}

// resize() of an empty table, whose memory the system clears page by page at its first touch: on all threads, not on one.
template <class T>
void ResizeLarge(TableVector<T>& table, size_t count) {
  constexpr size_t kPiece = size_t{4} << 20;
  static_assert(std::is_trivially_copyable_v<T>);
  table.reserve(count);
  const size_t bytes = count * sizeof(T);
  auto* memory = reinterpret_cast<std::byte*>(table.data());
  ParallelFor(static_cast<int64_t>((bytes + kPiece - 1) / kPiece), [&](int64_t i) {
    const size_t begin = static_cast<size_t>(i) * kPiece;
    std::memset(memory + begin, 0, std::min(kPiece, bytes - begin));
  });
  table.resize(count);
}

// Three independent tiling noises of mean 1/2 in r, g, b.
uint32_t NoiseTexel(int x, int y) {
  uint32_t texel = 0xff000000u;
  for (int c = 0; c < 3; ++c) {
    float sum = 0;
    for (int octave = 0, period = 8; octave < 4; ++octave, period *= 2) {
      const float scale = static_cast<float>(period) / kNoiseSize;
      sum += (ValueNoise(static_cast<float>(x) * scale, static_cast<float>(y) * scale, 100 + 10 * c + octave, period) - 0.5f) /
             static_cast<float>(1 << octave);
    }
    texel |= static_cast<uint32_t>(std::clamp(0.5f + 0.75f * sum, 0.0f, 1.0f) * 255.0f + 0.5f) << (8 * c);
  }
  return texel;
}

TextureRecord PlainTexture(const uint32_t* texels, int size) {
  TextureRecord record{};
  record.levels[0] = {texels, static_cast<float>(size), static_cast<float>(size)};
  record.size_log2 = std::log2(static_cast<float>(size));
  return record;
}

}  // namespace

uint32_t PackDirection(Vec3f d) {
  const float sum = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
  if (!(sum > 0) || !std::isfinite(sum)) return PackDirection({0, 0, 1});
  float x = d.x / sum, y = d.y / sum;
  if (d.z < 0) {
    const float fx = (1 - std::fabs(y)) * (x < 0 ? -1.0f : 1.0f);
    y = (1 - std::fabs(x)) * (y < 0 ? -1.0f : 1.0f);
    x = fx;
  }
  return Pack16(x, y);
}

Vec3f UnpackDirection(uint32_t packed) {
  return scalar::octahedral_decode(static_cast<float>(packed & 0xffff) * kDirectionStep - 1,
                                   static_cast<float>(packed >> 16) * kDirectionStep - 1);
}

Vec3f GeometricNormal(const InstanceRecord& instance, const TriangleRecord& triangle) {
  const Vec3f n = UnpackDirection(triangle.geometric_normal);
  const float* m = instance.normal_matrix;
  return Normalized(
      Vec3f{m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z, m[6] * n.x + m[7] * n.y + m[8] * n.z});
}

SurfaceTables::SurfaceTables(const Scene& scene, bool lamps_on) {
  // Our own textures, then the scene's.
  own_texels_.assign(1 + static_cast<size_t>(kNoiseSize) * kNoiseSize, 0xffffffffu);
  ParallelFor(kNoiseSize, [&](int64_t y) {
    for (int x = 0; x < kNoiseSize; ++x) own_texels_[1 + static_cast<size_t>(y) * kNoiseSize + x] = NoiseTexel(x, static_cast<int>(y));
  });
  textures.push_back(PlainTexture(own_texels_.data(), 1));
  textures.push_back(PlainTexture(own_texels_.data() + 1, kNoiseSize));
  for (const Texture& texture : scene.textures) textures.push_back(MakeTexture(texture));

  std::vector<UvTransform> transforms;
  for (const Material& material : scene.materials) {
    MaterialRecord record = MakeMaterial(material, scene);
    if (material.lamp && !lamps_on) std::fill(std::begin(record.emission), std::end(record.emission), 0.0f);
    if (!lamps_on) record.beam = 0;  // by day no beam stands out
    materials.push_back(record);
    mean_colors.push_back(material.base_color * MeanTexel(material.base_color_texture, scene));
    mean_emissions.push_back(Vec3f{record.emission[0], record.emission[1], record.emission[2]} *
                             MeanTexel(material.emission_texture, scene));
    transforms.emplace_back(material);
  }

  // Triangles of all meshes in a row.
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    first_.push_back(static_cast<uint32_t>(count));
    count += mesh.triangles.size();
  }
  ResizeLarge(triangles, count);
  ParallelFor(static_cast<int64_t>(scene.meshes.size()), [&](int64_t m) {
    for (const MeshPart& part : scene.meshes[m].parts) {
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        triangles[first_[m] + k] = MakeTriangle(scene.meshes[m], k, part.material, transforms[part.material]);
      }
    }
  });
  AddPanes(scene);
  AddColors(scene);
  instances.reserve(scene.instances.size());
  for (size_t i = 0; i < scene.instances.size(); ++i)
    instances.push_back(Place(scene.instances[i], scene.instances[i].X_WM, static_cast<uint32_t>(i)));
  if (std::ranges::any_of(scene.instances, [](const Instance& i) { return !(i.glow == Vec3f{1, 1, 1}); })) {
    for (const Instance& instance : scene.instances) glows.push_back(instance.glow);
  }
}

Vec3f SurfaceTables::BeamOf(const InstanceRecord& instance, const MaterialRecord& material) const {
  if (material.beam == 0 || material.beam == kWindowBeam) return {};
  const Vec3f axis{0, material.beam > 0 ? -1.0f : 1.0f, material.beam > kLowBeam ? kBeamDrop : 0.0f};
  const float* m = instance.normal_matrix;
  const Vec3f row[3] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  return Normalized(Vec3f{Dot(row[0], axis), Dot(row[1], axis), Dot(row[2], axis)}) * std::fabs(material.beam);
}

InstanceRecord SurfaceTables::Place(const Instance& instance, const AffineTransform& X_WM, uint32_t index) const {
  InstanceRecord record = MakeInstance(instance, X_WM, first_[instance.mesh], index);
  record.first_color = first_color_[instance.mesh];
  return record;
}

void SurfaceTables::AddColors(const Scene& scene) {
  first_color_.resize(scene.meshes.size());
  size_t count = 0;
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].colors.empty()) continue;
    if (count == 0) count = 1;
    first_color_[m] = static_cast<uint32_t>(count);
    count += scene.meshes[m].triangles.size();
  }
  colors.resize(count);
  if (count > 0) std::memset(&colors[0], 0xff, sizeof colors[0]);
  ParallelFor(static_cast<int64_t>(scene.meshes.size()), [&](int64_t m) {
    const Mesh& mesh = scene.meshes[m];
    if (mesh.colors.empty()) return;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3u t = mesh.triangles[i];
      const VertexColor corners[3] = {mesh.colors[t.x], mesh.colors[t.y], mesh.colors[t.z]};
      static_assert(sizeof corners == sizeof TriangleColors::corner);
      std::memcpy(colors[first_color_[m] + i].corner, corners, sizeof corners);
    }
  });
}

Vec3f SurfaceTables::ColorAt(const InstanceRecord& instance, uint32_t triangle, float u, float v) const {
  if (instance.first_color == 0) return {1, 1, 1};
  const auto& corners = colors[instance.first_color + triangle].corner;
  Vec3f c[3];
  for (int k = 0; k < 3; ++k) c[k] = LinearColor({corners[k][0], corners[k][1], corners[k][2]});
  return scalar::corner_color(c[0], c[1], c[2], u, v);
}

const std::vector<uint32_t>& SurfaceTables::Welds(const Mesh& mesh, MeshId id) {
  const auto [entry, is_new] = welds_.try_emplace(id);
  if (is_new) entry->second = WeldVertices(mesh);
  return entry->second;
}

void SurfaceTables::SetTriangles(const Scene& scene, MeshId id, const Mesh& shape) {
  for (const MeshPart& part : shape.parts) {
    const UvTransform transform(scene.materials[part.material]);
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      TriangleRecord& record = triangles[first_[id] + k];
      const uint32_t pane = record.pane, window = record.window;  // as built, so that panes do not flicker
      record = MakeTriangle(shape, k, part.material, transform);
      record.pane = pane;
      record.window = window;
    }
  }
}

void SurfaceTables::Apply(const Scene& scene, std::span<const MovedInstance> moved, std::span<const DeformedMesh> deformed) {
  const auto place = [&](uint32_t i, const AffineTransform& X_WM) { instances[i] = Place(scene.instances[i], X_WM, i); };
  for (uint32_t i : moved_) place(i, scene.instances[i].X_WM);
  moved_.clear();
  for (const MovedInstance& m : moved) {
    place(m.instance, m.X_WM);
    moved_.push_back(m.instance);
  }

  for (MeshId id : deformed_) {
    if (!std::ranges::binary_search(deformed, id, {}, &DeformedMesh::mesh)) SetTriangles(scene, id, scene.meshes[id]);
  }
  deformed_.clear();
  for (const DeformedMesh& d : deformed) {
    deformed_.push_back(d.mesh);
    if (!scene.meshes[d.mesh].normals.empty()) Welds(scene.meshes[d.mesh], d.mesh);
  }
  ParallelFor(static_cast<int64_t>(deformed.size()), [&](int64_t k) {
    const DeformedMesh& d = deformed[static_cast<size_t>(k)];
    Mesh shape = scene.meshes[d.mesh];
    shape.positions = *d.positions;
    if (!shape.normals.empty()) BendNormals(shape, shape.positions, welds_.at(d.mesh), shape.normals);
    SetTriangles(scene, d.mesh, shape);
  });
}

void SurfaceTables::AddPanes(const Scene& scene) {
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (const MeshPart& part : mesh.parts) {
      if (materials[part.material].interior == 0) continue;
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        TriangleRecord& triangle = triangles[first_[m] + k];
        const Vec3u t = mesh.triangles[k];
        const Vec3f p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        PaneRecord pane{};
        if (!MakePane(p, triangle.uv, Normalized(Cross(p[1] - p[0], p[2] - p[0])), pane)) continue;
        pane.hash = triangle.pane;
        panes.push_back(pane);
        triangle.window = static_cast<uint32_t>(panes.size());
      }
    }
  }
  panes.shrink_to_fit();
}

}  // namespace airsim360::internal

// What grows and lies on the lawns: patches of blades, instanced everywhere, finer near the spawn.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/vegetation/plant_mesh.h"
#include "airsim360/worlds/vegetation/turf.h"

namespace airsim360::internal::park {
namespace {

constexpr float kNearEnd = 44, kMiddleEnd = 125;

// Blades relative to the lawn's colour, so that an instance's tint is the lawn there: dark foot, light tip;
// the last cell is dry. Stored at a quarter, because dry blades are brighter than the lawn.
constexpr float kAtlasScale = 0.24f;
const Texture& BladeAtlas() {
  static const Texture atlas = [] {
    Image<Rgba8> image = Shade(kLeafCells * 16, 32, [](float u, float v) {
      const int cell = std::min(kLeafCells - 1, static_cast<int>(u * kLeafCells));
      const float x = std::abs(2 * (u * kLeafCells - static_cast<float>(cell)) - 1);
      const float tone = 0.78f + 0.07f * static_cast<float>(cell);
      // A light rib, and one half in the other's shadow.
      const float rib = 1 + 0.16f * std::max(0.0f, 1 - 5 * x);
      const Vec3f hue = cell == kLeafCells - 1 ? Vec3f{2.3f, 1.65f, 3.0f} : Vec3f{1, 1, 1} * tone;
      return hue * ((0.58f + 0.80f * (1 - v)) * rib * kAtlasScale);
    });
    Texture texture = Texture::FromImage("lawn blades", std::move(image), true);
    texture.wrap_u = texture.wrap_v = Wrap::kClamp;
    return texture;
  }();
  return atlas;
}

struct PatchShape {
  const char* name;
  float radius;  // blades fall off towards it
  int blades;
  float low, high, width;
};
constexpr PatchShape kMiddle{"lawn middle", 1.0f, 620, 0.05f, 0.14f, 0.016f};
constexpr PatchShape kFar{"lawn far", 2.3f, 1500, 0.06f, 0.15f, 0.030f};
constexpr PatchShape kTuft{"tuft", 0.13f, 70, 0.12f, 0.34f, 0.008f};

Vec2f OnDisc(float radius, RngStream& rng) {
  const float r = radius * std::sqrt(static_cast<float>(rng.Uniform())), a = kTauF * static_cast<float>(rng.Uniform());
  return {r * std::cos(a), r * std::sin(a)};
}

PlantLayer BladeLayer() {
  PlantLayer layer = LeafLayer(BladeAtlas(), 0.7f);
  layer.material.name = "lawn blade";
  layer.material.ground = GroundWear::kLawn;
  const float one = 1 / kAtlasScale;
  layer.material.base_color = {one, one, one};
  layer.material.roughness = 0.6f;
  return layer;
}

Model MakePatch(const PatchShape& shape, uint64_t seed) {
  RngStream rng(seed, shape.name);
  std::array<PlantLayer, 1> layers = {BladeLayer()};
  for (int i = 0; i < shape.blades; ++i) {
    const Vec2f p = OnDisc(shape.radius, rng);
    const auto a = kTauF * static_cast<float>(rng.Uniform());
    const Vec3f lean = Vec3f{std::cos(a), std::sin(a), 0} * static_cast<float>(rng.Uniform(0.15, 0.9));
    const int cell = rng.Chance(0.06) ? kLeafCells - 1 : static_cast<int>(rng.Index(kLeafCells - 1));
    AddBlade(layers[0], {p.x, p.y, -0.02f}, static_cast<float>(rng.Uniform(shape.low, shape.high)),
             shape.width * static_cast<float>(rng.Uniform(0.7, 1.3)), lean, a + 1.57f, cell);
  }
  return JoinLayers(shape.name, layers);
}

// Near the spawn: as many blades as a lawn has, 12,000 a square metre where patches lie beside each other.
Model MakeNearPatch(uint64_t seed) {
  constexpr Turf kLawn{.low = 0.045f, .high = 0.125f, .mown = 0.085f};
  constexpr float kRadius = 0.44f;
  RngStream rng(seed, "lawn near");
  std::array<PlantLayer, 1> layers = {BladeLayer()};
  AddTurf(
      layers[0], kLawn, 2500,
      [&] {
        const Vec2f p = OnDisc(kRadius, rng);
        return Vec3f{p.x, p.y, -0.02f};
      },
      [](Vec3f p) { return 1.1f - 0.4f * std::hypot(p.x, p.y) / kRadius; }, rng);
  return JoinLayers("lawn near", layers);
}

// Clover: three leaflets on a stalk, some daisies; blades between.
Model MakeClover(uint64_t seed) {
  static const Vec3f tones[] = {{0.082f, 0.148f, 0.036f}, {0.094f, 0.164f, 0.042f}, {0.070f, 0.128f, 0.032f}};
  static const Texture leaves = LeafAtlas("leaves clover", tones);
  RngStream rng(seed, "clover");
  std::array<PlantLayer, 3> layers = {LeafLayer(leaves, 0.7f), PlantLayer{}, PlantLayer{}};
  layers[1].material = Leaf({0.62f, 0.60f, 0.55f}, 0.5f);
  layers[1].material.name = "daisy petal";
  layers[2].material = Leaf({0.60f, 0.40f, 0.04f}, 0.2f);
  layers[2].material.name = "daisy heart";
  for (PlantLayer& layer : layers) layer.material.ground = GroundWear::kLawn;
  for (int i = 0; i < 210; ++i) {
    const Vec2f p = OnDisc(0.40f, rng);
    const auto h = static_cast<float>(rng.Uniform(0.035, 0.085)), a = kTauF * static_cast<float>(rng.Uniform());
    for (int k = 0; k < 3; ++k) {
      const float b = a + kTauF * static_cast<float>(k) / 3;
      AddLeaf(layers[0], {p.x, p.y, h}, Normalized(Vec3f{std::cos(b), std::sin(b), 0.12f}), {0, 0, 1}, {0.026f, 0.022f, 0.1f, 0.1f},
              static_cast<int>(rng.Index(kLeafCells - 1)), {0, 0, 0.4f});
    }
    if (i % 13) continue;
    const Vec3f head{p.x, p.y, h + 0.035f};
    for (int k = 0; k < 8; ++k) {
      const float b = a + kTauF * static_cast<float>(k) / 8;
      AddLeaf(layers[1], head, Normalized(Vec3f{std::cos(b), std::sin(b), 0.2f}), {0, 0, 1}, {0.015f, 0.008f, 0, 0}, 0);
    }
    for (int k = 0; k < 4; ++k) {
      const float b = a + kTauF * static_cast<float>(k) / 4;
      AddLeaf(layers[2], head + Vec3f{0, 0, 0.002f}, Normalized(Vec3f{std::cos(b), std::sin(b), 0.1f}), {0, 0, 1}, {0.006f, 0.006f, 0, 0},
              0);
    }
  }
  return JoinLayers("clover", layers);
}

Model MakeReeds(uint64_t seed) {
  static const Vec3f tones[] = {{0.10f, 0.140f, 0.042f}, {0.13f, 0.160f, 0.055f}, {0.20f, 0.175f, 0.085f}};
  static const Texture leaves = LeafAtlas("leaves reed", tones);
  RngStream rng(seed, "reeds");
  std::array<PlantLayer, 1> layers = {LeafLayer(leaves, 0.6f)};
  for (int i = 0; i < 130; ++i) {
    const Vec2f p = OnDisc(0.7f, rng);
    const auto a = kTauF * static_cast<float>(rng.Uniform());
    const Vec3f lean = Vec3f{std::cos(a), std::sin(a), 0} * static_cast<float>(rng.Uniform(0.05, 0.5));
    AddBlade(layers[0], {p.x, p.y, -0.1f}, static_cast<float>(rng.Uniform(0.7, 1.7)), static_cast<float>(rng.Uniform(0.012, 0.024)), lean,
             a + 1.57f, static_cast<int>(rng.Index(kLeafCells - 1)));
  }
  return JoinLayers("reeds", layers);
}

// Bark chips: flat boxes heaped at random.
Model MakeChips(uint64_t seed) {
  static const Texture tones = Texture::FromImage("bark chips",
                                                  Shade(64, 8,
                                                        [](float u, float v) {
                                                          const float r = TileNoise(u * 16, v, 16, 1, 77);
                                                          return Mix(Vec3f{0.12f, 0.07f, 0.045f}, Vec3f{0.33f, 0.23f, 0.16f}, r * r);
                                                        }),
                                                  true);
  RngStream rng(seed, "chips");
  PlantLayer layer;
  layer.material = Stone({1, 1, 1}, 0.9f);
  layer.material.name = "bark chip";
  layer.texture = &tones;
  for (int i = 0; i < 150; ++i) {
    const Vec2f p = OnDisc(0.42f, rng);
    const Vec3f half{static_cast<float>(rng.Uniform(0.012, 0.036)), static_cast<float>(rng.Uniform(0.006, 0.014)),
                     static_cast<float>(rng.Uniform(0.003, 0.009))};
    const Vec3f up = Normalized(Vec3f{0.35f * static_cast<float>(rng.Normal()), 0.35f * static_cast<float>(rng.Normal()), 1});
    const AffineTransform X =
        PlaceTilted({p.x, p.y, static_cast<float>(rng.Uniform(0.0, 0.02))}, up, kTauF * static_cast<float>(rng.Uniform()), 1);
    const Vec2f uv{static_cast<float>(rng.Uniform(0.01, 0.99)), 0.5f};
    // Five faces; the lowest is never seen.
    for (int axis = 0; axis < 3; ++axis) {
      for (float sign : {-1.0f, 1.0f}) {
        if (axis == 2 && sign < 0) continue;
        Vec3f n{}, u{}, v{};
        n[axis] = sign;
        u[(axis + 1) % 3] = sign * half[(axis + 1) % 3];
        v[(axis + 2) % 3] = half[(axis + 2) % 3];
        const Vec3f c = n * half[axis], normal = Normalized(X.A * n);
        const uint32_t a = layer.Add(X * (c - u - v), normal, uv);
        layer.Add(X * (c + u - v), normal, uv);
        layer.Add(X * (c + u + v), normal, uv);
        layer.Add(X * (c - u + v), normal, uv);
        layer.triangles.insert(layer.triangles.end(), {{a, a + 1, a + 2}, {a, a + 2, a + 3}});
      }
    }
  }
  return JoinLayers("bark chips", std::span<const PlantLayer>(&layer, 1));
}

class Grower {
 public:
  explicit Grower(Park& park) : park_(park) {
    PropShelf& shelf = park.placer.shelf();
    for (uint64_t k = 0; k < 4; ++k) near_.push_back(shelf.Add(MakeNearPatch(park.seed + k)));
    for (uint64_t k = 0; k < 4; ++k) middle_.push_back(shelf.Add(MakePatch(kMiddle, park.seed + k)));
    for (uint64_t k = 0; k < 4; ++k) far_.push_back(shelf.Add(MakePatch(kFar, park.seed + k)));
    for (uint64_t k = 0; k < 3; ++k) tufts_.push_back(shelf.Add(MakePatch(kTuft, park.seed + k)));
    for (uint64_t k = 0; k < 2; ++k) clover_.push_back(shelf.Add(MakeClover(park.seed + k)));
    for (uint64_t k = 0; k < 2; ++k) reeds_.push_back(shelf.Add(MakeReeds(park.seed + k)));
    for (uint64_t k = 0; k < 4; ++k) chips_.push_back(shelf.Add(MakeChips(park.seed + k)));
  }

  // Rows of cells in parallel, added in order.
  void Lawns() {
    Rows(0.46f, 0, kNearEnd, [&](Vec2f p, RngStream& rng, std::vector<Instance>& out) { Near(p, rng, out); });
    Rows(1.15f, kNearEnd - 2, kMiddleEnd, [&](Vec2f p, RngStream& rng, std::vector<Instance>& out) {
      if (Fits(p, 0.95f)) {
        Put(middle_, p, rng, 1, out);
      } else {
        // The borders are filled with small patches.
        for (int k = 0; k < 4; ++k) Near(p + OnDisc(0.75f, rng), rng, out);
      }
    });
    Rows(2.6f, kMiddleEnd - 4, kParkRadius, [&](Vec2f p, RngStream& rng, std::vector<Instance>& out) {
      if (Fits(p, 2.2f)) {
        Put(far_, p, rng, 1, out);
      } else {
        for (int k = 0; k < 3; ++k) {
          const Vec2f q = p + OnDisc(1.6f, rng);
          if (Fits(q, 0.9f)) Put(middle_, q, rng, 1, out);
        }
      }
    });
  }

  // Long tufts, weeds and grass along the backs of pavements and in the beds; chips in the beds near the
  // spawn.
  void Verges() {
    RngStream rng(park_.seed, "verges");
    const Curve& main = park_.layout.main();
    const float middle = main.Find({0, 0}).s;
    std::vector<Instance> out;
    for (float s = middle - 170; s < middle + 170; s += 0.8f) {
      const float away = std::abs(s - middle);
      for (float hand : {-1.0f, 1.0f}) {
        const auto at = [&](float o, float along, float z) {
          const Vec2f p = main.At(s + along, hand * (kMainHalf + o));
          return Vec3f{p.x, p.y, park_.layout.Base(p) + z};
        };
        const auto jitter = [&] { return static_cast<float>(rng.Uniform(-0.5, 0.5)); };
        for (int k = 0; k < 5 && away < 110; ++k) {
          const Vec3f p = at(kVergeEnd + static_cast<float>(rng.Uniform(0.02, 0.30)), jitter(), 0.13f);
          if (!park_.lawns.IsLawn({p.x, p.y}) && park_.layout.PathDistance({p.x, p.y}, 3) < 1.4f) continue;
          if (park_.layout.BeyondRoad({p.x, p.y}) < 0.01f) continue;
          Raw(k < 3 ? near_ : tufts_, p, rng, k < 3 ? 0.35f : 0.3f + 0.5f * static_cast<float>(rng.Uniform()), out);
        }
        const float weeds = Fractal(s * 0.3f, hand, 2, 93);
        if (rng.Chance(0.5) && weeds > 0.5f) {
          const Vec3f p = at(static_cast<float>(rng.Uniform(0.3, 1.65)), jitter(), 0.11f);
          if (OnBed(p)) Raw(tufts_, p, rng, 0.3f + 0.6f * static_cast<float>(rng.Uniform()), out);
        }
        for (int k = 0; k < 6 && away < 95; ++k) {
          const Vec3f p = at(static_cast<float>(rng.Uniform(0.60, 1.35)), jitter(), 0.118f);
          if (OnBed(p)) Raw(chips_, p, rng, 0.8f + 0.3f * static_cast<float>(rng.Uniform()), out, {1, 1, 1});
        }
        for (int k = 0; k < 2; ++k) {
          if (!rng.Chance(0.3)) continue;
          const Vec3f p = k ? at(static_cast<float>(rng.Uniform(2.0, 3.7)), jitter(), 0.17f)
                            : at(static_cast<float>(rng.Uniform(0.3, 1.6)), jitter(), 0.125f);
          if (!k && !OnBed(p)) continue;
          Litter(p, 0.3f + 0.3f * static_cast<float>(rng.Uniform()), rng);
        }
      }
    }
    Add(out);
  }

  void Shore() {
    RngStream rng(park_.seed, "reeds");
    std::vector<Instance> out;
    for (int k = 0; k < 1400; ++k) {
      const float a = kTauF * static_cast<float>(rng.Uniform());
      const auto f = static_cast<float>(rng.Uniform(0.80, 1.10));
      const Vec2f p{kLakeCenter.x + kLakeRx * f * std::cos(a), kLakeCenter.y + kLakeRy * f * std::sin(a)};
      const float lake = park_.layout.Lake(p);
      if (lake < 0.93f || lake > 1.08f || Fractal(p.x / 12, p.y / 12, 2, 92) < 0.5f) continue;
      if (!park_.occupancy.IsFree({p, {0.5f, 0.5f}, 0})) continue;
      const float z = std::max(park_.layout.Ground(p), kLakeZ - 0.25f);
      Raw(reeds_, {p.x, p.y, z}, rng, static_cast<float>(rng.Uniform(0.6, 1.1)), out, {1, 1, 1});
    }
    Add(out);
  }

  void LitterUnder(const std::vector<Vec2f>& trees) {
    RngStream rng(park_.seed, "tree litter");
    for (Vec2f tree : trees) {
      for (int k = 0; k < 7; ++k) {
        const Vec2f p = tree + OnDisc(5, rng);
        if (!park_.lawns.IsLawn(p)) continue;
        Litter(park_.OnGround(p, -0.04f), 0.8f + 0.4f * static_cast<float>(rng.Uniform()), rng);
      }
    }
  }

 private:
  // A place of radius r all on the lawn, free of what stands there.
  bool Fits(Vec2f p, float r) const {
    return park_.lawns.IsLawn(p) && park_.layout.BeyondRoad(p) > r + 0.1f && park_.layout.PathDistance(p, r + 3) > kPathHalf + r &&
           park_.occupancy.IsFree({p, {0.05f, 0.05f}, 0});
  }

  void Near(Vec2f p, RngStream& rng, std::vector<Instance>& out) {
    if (!Fits(p, 0.22f)) return;
    // Dry places are thin, clover grows in clumps, tufts stand out.
    if (rng.Uniform() < 0.45 * park_.layout.Dry(p)) return;
    const bool clover = rng.Uniform() < 0.8 * park_.layout.Clover(p);
    const float scale = 0.8f + 0.4f * static_cast<float>(rng.Uniform());
    Put(clover ? clover_ : near_, p, rng, scale, out, clover);
    if (rng.Uniform() < 0.03 + 0.16 * Ramp(0.55f, 0.75f, Fractal(p.x / 2.3f, p.y / 2.3f, 2, 90)))
      Put(tufts_, p, rng, 0.5f + 0.5f * static_cast<float>(rng.Uniform()), out);
  }

  void Put(const std::vector<MeshId>& meshes, Vec2f p, RngStream& rng, float scale, std::vector<Instance>& out, bool own_color = false) {
    const AffineTransform X = PlaceTilted(park_.OnGround(p), park_.layout.Normal(p), kTauF * static_cast<float>(rng.Uniform()), scale);
    const float tone = 1.16f + 0.26f * static_cast<float>(rng.Uniform());
    const Vec3f tint = own_color ? Vec3f{tone, tone, tone} : park_.layout.LawnCoarse(p) * tone;
    out.push_back({meshes[rng.Index(static_cast<uint32_t>(meshes.size()))], X, park_.lawns.At(p), tint});
  }
  void Raw(const std::vector<MeshId>& meshes, Vec3f p, RngStream& rng, float scale, std::vector<Instance>& out) {
    Raw(meshes, p, rng, scale, out, park_.layout.LawnCoarse({p.x, p.y}));
  }
  // In beds and on the shore: tufts and reeds are plants of the place they stand on.
  void Raw(const std::vector<MeshId>& meshes, Vec3f p, RngStream& rng, float scale, std::vector<Instance>& out, Vec3f tint) {
    const AffineTransform X = PlaceUpright(p, kTauF * static_cast<float>(rng.Uniform()), scale);
    out.push_back({meshes[rng.Index(static_cast<uint32_t>(meshes.size()))], X, EntityAt(meshes, {p.x, p.y}), tint});
  }
  void Litter(Vec3f p, float scale, RngStream& rng) {
    if (litter_ == kNoEntity) litter_ = park_.AddEntity("fallen leaves", "vegetation/plant");
    park_.placer.shelf().PlaceAs(litter_, "leaf_litter", PlaceUpright(p, kTauF * static_cast<float>(rng.Uniform()), scale), rng.Index(12));
  }
  bool OnBed(Vec3f p) const {
    // Not on the mouths of side roads, where the kerb line leaves the main road.
    for (const Curve& side : park_.layout.side_roads())
      if (side.Distance({p.x, p.y}, 20) < kSideHalf + 8) return false;
    return true;
  }
  EntityId EntityAt(const std::vector<MeshId>& meshes, Vec2f p) {
    if (&meshes == &chips_) {
      const int place = static_cast<int>(std::floor(park_.layout.main().Find(p).s / 80));
      EntityId& entity = chip_beds_[place];
      if (entity == kNoEntity) entity = park_.AddEntity("bark chips", "ground/dirt");
      return entity;
    }
    if (&meshes == &reeds_) {
      if (reed_entity_ == kNoEntity) reed_entity_ = park_.AddEntity("reeds", "vegetation/plant");
      return reed_entity_;
    }
    if (park_.layout.BeyondRoad(p) > 0) return park_.lawns.At(p);
    if (weeds_ == kNoEntity) weeds_ = park_.AddEntity("weeds", "vegetation/grass_tuft");
    return weeds_;
  }

  template <class Visit>
  void Rows(float cell, float r0, float r1, const Visit& visit) {
    const int n = static_cast<int>(r1 / cell) + 1;
    std::vector<std::vector<Instance>> rows(static_cast<size_t>(2 * n + 1));
    ParallelFor(2 * n + 1, [&](int64_t row) {
      RngStream rng(park_.seed, "lawn rows", static_cast<uint64_t>(row) * 1000 + static_cast<uint64_t>(cell * 100));
      for (int i = -n; i <= n; ++i) {
        const Vec2f p{cell * (static_cast<float>(i) + static_cast<float>(rng.Uniform(-0.5, 0.5))),
                      cell * (static_cast<float>(row - n) + static_cast<float>(rng.Uniform(-0.5, 0.5)))};
        const float r = std::hypot(p.x, p.y);
        if (r >= r0 && r < r1) visit(p, rng, rows[static_cast<size_t>(row)]);
      }
    });
    for (const std::vector<Instance>& row : rows) Add(row);
  }
  void Add(const std::vector<Instance>& instances) {
    for (const Instance& instance : instances) park_.builder.AddInstance(instance);
  }

  Park& park_;
  std::vector<MeshId> near_, middle_, far_, tufts_, clover_, reeds_, chips_;
  std::map<int, EntityId> chip_beds_;
  EntityId litter_ = kNoEntity, reed_entity_ = kNoEntity, weeds_ = kNoEntity;
};

}  // namespace

void GrowLawns(Park& park, const std::vector<Vec2f>& trees) {
  Grower grower(park);
  grower.Lawns();
  grower.Verges();
  grower.Shore();
  grower.LitterUnder(trees);
}

}  // namespace airsim360::internal::park

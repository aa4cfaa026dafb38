// Trees, shrubs and rocks.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/vegetation/park_trees.h"

namespace airsim360::internal::park {
namespace {

constexpr float kMiddleFrom = 260, kFarFrom = 520, kWoodsEnd = 4200;

// Meshes of all individuals of all species in all levels of detail.
class Nursery {
 public:
  Nursery(PropShelf& shelf, uint64_t seed) {
    struct Job {
      ParkTree species;
      TreeDetail detail;
      int individual;
    };
    std::vector<Job> jobs;
    for (int detail = 0; detail < 3; ++detail) {
      for (int species = 0; species < static_cast<int>(ParkTree::kCount); ++species) {
        const auto tree = static_cast<ParkTree>(species);
        for (int i = 0; i < InfoOf(tree).individuals[detail]; ++i) jobs.push_back({tree, static_cast<TreeDetail>(detail), i});
      }
    }
    std::vector<Model> models(jobs.size());
    ParallelFor(static_cast<int64_t>(jobs.size()), [&](int64_t i) {
      const Job& job = jobs[static_cast<size_t>(i)];
      models[static_cast<size_t>(i)] = MakeParkTree(job.species, job.detail, job.individual, seed);
    });
    for (size_t i = 0; i < jobs.size(); ++i) meshes_[{jobs[i].species, jobs[i].detail}].push_back(shelf.Add(std::move(models[i])));
  }
  MeshId Pick(ParkTree species, TreeDetail detail, uint32_t number) const {
    const auto& list = meshes_.at({species, detail});
    return list[number % list.size()];
  }

 private:
  std::map<std::pair<ParkTree, TreeDetail>, std::vector<MeshId>> meshes_;
};

// Hue and brightness of an individual: most near the species' own, a few yellowish.
Vec3f LeafTint(RngStream& rng) {
  const auto hue = static_cast<float>(rng.Uniform()), value = static_cast<float>(rng.Uniform(0.86, 1.14));
  return Mix(Vec3f{0.86f, 0.90f, 0.98f}, Vec3f{1.36f, 1.12f, 0.95f}, hue * hue) * value;
}

// Keeps trees apart: each claims a circle.
class Spacing {
 public:
  bool IsFree(Vec2f p) const {
    for (int y = Cell(p.y) - 1; y <= Cell(p.y) + 1; ++y) {
      for (int x = Cell(p.x) - 1; x <= Cell(p.x) + 1; ++x) {
        const auto it = cells_.find(Key(x, y));
        if (it == cells_.end()) continue;
        for (Vec3f q : it->second)
          if (std::hypot(q.x - p.x, q.y - p.y) < q.z) return false;
      }
    }
    return true;
  }
  void Add(Vec2f p, float radius) { cells_[Key(Cell(p.x), Cell(p.y))].push_back({p.x, p.y, radius}); }

 private:
  static int Cell(float x) { return static_cast<int>(std::floor(x / 12)); }
  static int64_t Key(int x, int y) { return (static_cast<int64_t>(x) << 32) ^ static_cast<uint32_t>(y); }
  std::unordered_map<int64_t, std::vector<Vec3f>> cells_;  // looked up by key only
};

class Planter {
 public:
  explicit Planter(Park& park) : park_(park), nursery_(park.placer.shelf(), park.seed), rng_(park.seed, "park trees") {}

  // Room for a trunk with `margin` to roads and paths.
  bool IsFree(Vec2f p, float margin) const {
    if (park_.layout.BeyondRoad(p) < margin) return false;
    if (park_.layout.Lake(p) < 1.04f + 0.02f * margin && park_.layout.Island(p) < 0.7f) return false;
    return park_.layout.PathDistance(p, 5) > 1.5f + 0.6f * margin;
  }

  void Tree(ParkTree species, Vec2f p, float scale, uint32_t individual) {
    const float r = std::hypot(p.x, p.y);
    const TreeDetail detail = r < kMiddleFrom ? TreeDetail::kFull : TreeDetail::kMiddle;
    const EntityId entity = park_.AddEntity(std::string(InfoOf(species).name), InfoOf(species).category);
    const Vec3f up = Normalized(Vec3f{0.03f * static_cast<float>(rng_.Normal()), 0.03f * static_cast<float>(rng_.Normal()), 1});
    Place(nursery_.Pick(species, detail, individual), p, up, scale, entity);
    park_.placer.Reserve({p, {0.55f * scale, 0.55f * scale}, 0});
    if (r < 95) near_.push_back(p);
  }

  // The park's own trees: groves where the noise of woods is high, single ones elsewhere.
  void PlantPark() {
    for (int k = 0; k < 60000; ++k) {
      const float r = 18 + (kFarFrom - 18) * std::sqrt(Uniform()), a = kTauF * Uniform();
      const Vec2f p{r * std::cos(a), r * std::sin(a)};
      const float woods = Fractal(p.x / 60, p.y / 60, 3, 81);
      // Two open lawns before the spawn.
      if (std::hypot((p.x - 2) / 27, (p.y - 33) / 22) < 1 || std::hypot((p.x + 30) / 40, (p.y - 45) / 22) < 1) continue;
      // No shadow over the spawn: the low sun stands in the south-east.
      if (r < 36 && p.x > 0 && p.y < 0) continue;
      float wanted = 0.95f * Ramp(0.36f, 0.56f, woods) + 0.07f;
      if (r > 170) wanted = 0.25f + 0.75f * wanted;
      if (Uniform() > wanted || !IsFree(p, 1.8f) || !spacing_.IsFree(p)) continue;
      const float apart = Mix(9.5f, 5.2f, Ramp(0.40f, 0.62f, woods));
      const ParkTree species = Species(p);
      const float scale = static_cast<float>(rng_.Uniform(0.72, 1.18));
      if (!park_.occupancy.IsFree({p, {0.55f * scale, 0.55f * scale}, 0})) continue;
      spacing_.Add(p, apart);
      // The largest elm stays alone.
      const uint32_t individual = species == ParkTree::kElm ? 1 + rng_.Index(3) : rng_.Index(12);
      Tree(species, p, scale, individual);
    }
  }

  // Woods to the horizon, denser near the park; an entity a species and patch of 300 m.
  void PlantWoods() {
    std::map<std::tuple<int, int, ParkTree>, EntityId> patches;
    for (float r = kFarFrom - 2; r < kWoodsEnd;) {
      const float step = 6.5f + 0.0042f * (r - kFarFrom);
      const int n = static_cast<int>(kTauF * r / step);
      for (int i = 0; i < n; ++i) {
        const float a = kTauF * (static_cast<float>(i) + Uniform()) / static_cast<float>(n);
        const float q = r + step * (Uniform() - 0.5f);
        const Vec2f p{q * std::cos(a), q * std::sin(a)};
        const float woods = Fractal(p.x / 160, p.y / 160, 2, 86);
        if (woods < 0.42f && !(q < 700 && Uniform() < 0.25f)) continue;
        if (q < 800 && park_.layout.BeyondRoad(p) < 4) continue;
        if (!park_.occupancy.IsFree({p, {1, 1}, 0})) continue;
        const ParkTree species = Species(p);
        const auto cell = std::tuple(static_cast<int>(std::floor(p.x / 300)), static_cast<int>(std::floor(p.y / 300)), species);
        const auto [it, fresh] = patches.try_emplace(cell, kNoEntity);
        if (fresh) it->second = park_.AddEntity("wood of " + std::string(InfoOf(species).name), InfoOf(species).category);
        const float scale = static_cast<float>(rng_.Uniform(0.8, 1.25)) * (1 + 0.00018f * (q - kFarFrom));
        Place(nursery_.Pick(species, TreeDetail::kFar, rng_.Index(12)), p, {0, 0, 1}, scale, it->second);
      }
      r += step;
    }
  }

  void PlantShrubs() {
    for (int k = 0; k < 30000; ++k) {
      const float r = 12 + 420 * std::sqrt(Uniform()), a = kTauF * Uniform();
      const Vec2f p{r * std::cos(a), r * std::sin(a)};
      const float thicket = Fractal(p.x / 17 + 3, p.y / 17, 3, 88);
      const bool lawn = std::hypot((p.x - 2) / 24, (p.y - 30) / 18) < 1;
      if (thicket < (lawn ? 0.68f : 0.53f) && Uniform() > 0.02f) continue;
      if (r > 170 && Uniform() < 0.55f) continue;
      if (IsFree(p, 1.4f)) Shrub(p, static_cast<float>(rng_.Uniform(0.65, 1.6)));
    }
    // Around the foot of the solitary elm.
    for (int k = 0; k < 9; ++k) {
      const float a = kTauF * (static_cast<float>(k) + Uniform()) / 9, r = 0.9f + 0.9f * Uniform();
      Shrub({4 + r * std::cos(a), 19.5f + r * std::sin(a)}, 0.3f + 0.2f * Uniform());
    }
    for (int k = 0; k < 14; ++k) {
      const float a = kTauF * Uniform(), r = 6 * Uniform();
      Shrub({-60 + r * std::cos(a) * 1.2f, 88 + r * std::sin(a)}, 0.5f + 0.4f * Uniform());
    }
  }

  void ScatterRocks() {
    for (int k = 0; k < 900; ++k) {
      const bool shore = k < 500;
      const float a = kTauF * Uniform();
      Vec2f p;
      if (shore) {
        const float f = static_cast<float>(rng_.Uniform(0.98, 1.12));
        p = {kLakeCenter.x + kLakeRx * std::cos(a) * f, kLakeCenter.y + kLakeRy * std::sin(a) * f};
        const float lake = park_.layout.Lake(p);
        if (lake < 0.99f || lake > 1.10f || Noise(p.x / 9, p.y / 9, 95) < 0.62f) continue;
      } else {
        const float r = 20 + 400 * std::sqrt(Uniform());
        p = {r * std::cos(a), r * std::sin(a)};
        if (!IsFree(p, 1) || Noise(p.x / 25, p.y / 25, 96) < 0.66f) continue;
      }
      const auto scale = static_cast<float>(rng_.Uniform(0.35, 1.0));
      park_.placer.Try("rock", park_.OnGround(p, 0.12f * scale), kTauF * Uniform(), scale);
    }
  }

  void Solitary(ParkTree species, Vec2f p, float scale, uint32_t individual, float room) {
    spacing_.Add(p, room);
    Tree(species, p, scale, individual);
  }
  const std::vector<Vec2f>& near() const { return near_; }
  float Uniform() { return static_cast<float>(rng_.Uniform()); }

 private:
  // Each grove has its leading species.
  ParkTree Species(Vec2f p) {
    const float kind = Fractal(p.x / 40 + 50, p.y / 40, 2, 83), u = Uniform();
    if (kind > 0.56f) return u < 0.75f ? ParkTree::kPine : u < 0.9f ? ParkTree::kMaple : ParkTree::kPoplar;
    if (kind < 0.42f) return u < 0.62f ? ParkTree::kElm : u < 0.80f ? ParkTree::kMaple : ParkTree::kCork;
    return u < 0.62f   ? ParkTree::kMaple
           : u < 0.78f ? ParkTree::kElm
           : u < 0.88f ? ParkTree::kCork
           : u < 0.95f ? ParkTree::kPine
                       : ParkTree::kPoplar;
  }
  void Shrub(Vec2f p, float scale) { park_.placer.Try("shrub", park_.OnGround(p, 0.05f), kTauF * Uniform(), scale, LeafTint(rng_)); }
  void Place(MeshId mesh, Vec2f p, Vec3f up, float scale, EntityId entity) {
    const AffineTransform X = PlaceTilted(park_.OnGround(p, 0.10f), up, kTauF * Uniform(), scale);
    park_.builder.AddInstance({mesh, X, entity, LeafTint(rng_)});
  }

  Park& park_;
  Nursery nursery_;
  RngStream rng_;
  Spacing spacing_;
  std::vector<Vec2f> near_;
};

}  // namespace

std::vector<Vec2f> PlantTrees(Park& park) {
  Planter planter(park);
  planter.Solitary(ParkTree::kElm, {4, 19.5f}, 0.95f, 0, 9);
  uint32_t willow = 0;
  for (Vec2f p : {Vec2f{-88, 70}, Vec2f{-86, 92}, Vec2f{-66, 57}, Vec2f{-8, 114}, Vec2f{6, 90}, Vec2f{-60, 117}, Vec2f{-59, 88}}) {
    // By the water, not in it.
    while (park.layout.Lake(p) < 1.07f && park.layout.Island(p) < 0.6f) p = kLakeCenter + (p - kLakeCenter) * 1.02f;
    planter.Solitary(ParkTree::kWillow, p, 0.9f + 0.3f * planter.Uniform(), willow++, 7);
  }
  planter.PlantPark();
  planter.PlantShrubs();
  planter.ScatterRocks();
  planter.PlantWoods();
  return planter.near();
}

}  // namespace airsim360::internal::park

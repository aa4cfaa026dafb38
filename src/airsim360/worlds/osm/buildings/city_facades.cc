#include "airsim360/worlds/osm/buildings/city_facades.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/osm/buildings/osm_facade.h"
#include "airsim360/worlds/osm/data/line_index.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr double kShortest = 2.2, kLowest = 2.4;  // metres of a wall that is dressed
constexpr double kChunk = 120;                    // metres of one merged mesh

// Triangles of one upright plane, material and entity, in its own axes: u along the wall (to the right seen from
// outside), z up.
struct Plane {
  EntityId entity = kNoEntity;
  MaterialId material = 0;
  Vec2d out, zero;  // the direction that it faces; a point of it
  Patches triangles;
  Vec2d along() const { return {-out.y, out.x}; }
  Vec2d At(double u) const { return zero + along() * u; }
};

// What lies over the ground: the triangles of buildings that are not upright, seen from above.
class Cover {
 public:
  void Add(const Ring& ring, double top) {
    boxes_.Add(BoundsOf(ring), static_cast<uint32_t>(rings_.size()));
    rings_.emplace_back(ring, top);
  }
  double Top(Vec2d p) const {
    double top = -1e18;
    for (uint32_t i : boxes_.Find(p))
      if (InPolygon(rings_[i].first, p)) top = std::max(top, rings_[i].second);
    return top;
  }

 private:
  std::vector<std::pair<Ring, double>> rings_;
  BoxIndex boxes_;
};

// The largest rectangle below the lowest upper corner that stands on the highest lower one.
bool FacadeOf(const Patch& wall, Bounds2d& rect) {
  const Bounds2d box = BoundsOf(wall.outer);
  double low = box.min.y, high = box.max.y;
  for (size_t i = 0; i < wall.outer.size(); ++i) {
    const Vec2d a = wall.outer[i], b = wall.outer[(i + 1) % wall.outer.size()];
    if (b.x - a.x > 0.01) low = std::max({low, a.y, b.y});
    if (a.x - b.x > 0.01) high = std::min({high, a.y, b.y});
  }
  rect = {{box.min.x, low}, {box.max.x, high}};
  if (high - low < kLowest || box.max.x - box.min.x < kShortest) return false;
  const Patches whole{{{rect.min, {rect.max.x, rect.min.y}, rect.max, {rect.min.x, rect.max.y}}, {}}};
  const double area = Area(whole);
  return Area(Intersect(Patches{wall}, whole)) > 0.995 * area;
}

class Dresser {
 public:
  Dresser(const Scene& scene, uint64_t seed) : scene_(scene), seed_(seed), builder_(scene.name) {}

  std::shared_ptr<const Scene> Make() {
    FindPlanes();
    if (planes_.empty()) return nullptr;
    Copy();
    surfaces_ = AddSurfaces(builder_);
    balcony_ = AddBalconyMesh(builder_, surfaces_);
    window_box_ = AddWindowBoxMesh(builder_, surfaces_);
    FindStreetSides();
    for (auto& entry : planes_) Build(entry.second);
    for (auto& chunk : chunks_)
      if (!chunk.second.empty())
        builder_.AddInstance({builder_.AddMesh(chunk.second.Finish("facades " + std::to_string(chunk.first.first) + "," +
                                                                   std::to_string(chunk.first.second))),
                              {},
                              kNoEntity});
    return builder_.Build();
  }

 private:
  bool IsBuilding(EntityId entity) const { return scene_.tree[scene_.entity(entity).category].path == "construction/building"; }

  // Buildings with openings of their own: their boxes hold some.
  std::vector<bool> Detailed() const {
    BoxIndex openings;
    std::vector<Box3f> boxes;
    for (const Entity& entity : scene_.entities) {
      const std::string_view path = scene_.tree[entity.category].path;
      if ((path != "construction/window" && path != "construction/door") || entity.bounds.empty()) continue;
      const Vec3f c = entity.bounds.center();
      const Vec2d p{static_cast<double>(c.x), static_cast<double>(c.y)};
      openings.Add({p, p}, static_cast<uint32_t>(boxes.size()));
      boxes.push_back(entity.bounds);
    }
    std::vector<bool> detailed(scene_.entities.size() + 1, false);
    for (const Entity& entity : scene_.entities) {
      if (entity.bounds.empty() || !IsBuilding(entity.id)) continue;
      const auto flat = [](Vec3f p) { return Vec2d{static_cast<double>(p.x), static_cast<double>(p.y)}; };
      detailed[entity.id] = !openings.Find(Bounds2d{flat(entity.bounds.min), flat(entity.bounds.max)}).empty();
    }
    return detailed;
  }

  static std::array<Vec3d, 3> Corners(const Instance& instance, const Mesh& mesh, Vec3u t) {
    const auto at = [&](uint32_t i) { return VecCast<double>(instance.X_WM * mesh.positions[i]); };
    return {at(t.x), at(t.y), at(t.z)};
  }

  // Sorts the triangles of buildings: upright ones into planes, the others into the cover; what stays as it is.
  void FindPlanes() {
    const std::vector<bool> detailed = Detailed();
    kept_.resize(scene_.instances.size());
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      const Instance& instance = scene_.instances[i];
      const Mesh& mesh = scene_.meshes[instance.mesh];
      for (const MeshPart& part : mesh.parts) {
        const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
        const std::string_view path = entity == kNoEntity ? "" : std::string_view(scene_.tree[scene_.entity(entity).category].path);
        for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
          const auto c = Corners(instance, mesh, mesh.triangles[k]);
          const Vec3d n = Cross(c[1] - c[0], c[2] - c[0]);
          const double level = std::hypot(n.x, n.y);
          if (path.starts_with("construction/building") && std::abs(n.z) > 0.05 * level)
            cover_.Add({{c[0].x, c[0].y}, {c[1].x, c[1].y}, {c[2].x, c[2].y}}, std::max({c[0].z, c[1].z, c[2].z}));
          const bool wall = path == "construction/building" && !detailed[entity] && level > 1e-4 && std::abs(n.z) < 0.01 * level;
          if (!wall) {
            kept_[i].push_back(k);
            continue;
          }
          const Vec2d out{n.x / level, n.y / level};
          const double offset = out.x * c[0].x + out.y * c[0].y;
          const auto key = std::tuple(entity, part.material, std::lround(std::atan2(out.y, out.x) * 180 / M_PI), std::lround(offset / 0.1));
          Plane& plane = planes_.try_emplace(key, Plane{entity, part.material, out, out * offset, {}}).first->second;
          Ring ring;
          for (const Vec3d& p : c) ring.push_back({(p.x - plane.zero.x) * plane.along().x + (p.y - plane.zero.y) * plane.along().y, p.z});
          plane.triangles.push_back({ring, {}});
        }
      }
    }
  }

  // Everything but the walls, ids as they are.
  void Copy() {
    builder_.tree() = scene_.tree;
    builder_.environment() = scene_.environment;
    builder_.SetInteriorLight(scene_.interior_light);
    if (scene_.spawn) builder_.SetSpawn(*scene_.spawn, scene_.spawn_yaw_deg);
    for (const std::string& line : scene_.attributions) builder_.AddAttribution(line);
    for (const Texture& texture : scene_.textures) builder_.AddTexture(texture);
    for (const Material& material : scene_.materials) builder_.AddMaterial(material);
    for (const Entity& entity : scene_.entities) {
      if (entity.id == scene_.sky_entity)
        builder_.AddSky();
      else
        builder_.AddEntity(entity.name, entity.category);
    }
    std::map<MeshId, MeshId> whole;
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      Instance instance = scene_.instances[i];
      const Mesh& mesh = scene_.meshes[instance.mesh];
      if (kept_[i].empty()) continue;
      if (kept_[i].size() == mesh.triangles.size()) {
        const auto [it, fresh] = whole.try_emplace(instance.mesh, 0);
        if (fresh) it->second = builder_.AddMesh(mesh);
        instance.mesh = it->second;
      } else {
        instance.mesh = builder_.AddMesh(Without(mesh, kept_[i]));
      }
      builder_.AddInstance(instance);
    }
  }

  // Of a mesh the triangles `kept`.
  static Mesh Without(const Mesh& mesh, const std::vector<uint32_t>& kept) {
    Mesh rest = mesh;
    rest.triangles.clear();
    rest.parts.clear();
    size_t at = 0;
    for (const MeshPart& part : mesh.parts) {
      MeshPart own = part;
      own.first_triangle = static_cast<uint32_t>(rest.triangles.size());
      for (; at < kept.size() && kept[at] < part.first_triangle + part.triangle_count; ++at)
        rest.triangles.push_back(mesh.triangles[kept[at]]);
      own.triangle_count = static_cast<uint32_t>(rest.triangles.size()) - own.first_triangle;
      if (own.triangle_count > 0) rest.parts.push_back(own);
    }
    return rest;
  }

  // The longest wall of a building is its front.
  void FindStreetSides() {
    for (const auto& entry : planes_) {
      double u0 = 1e18, u1 = -1e18;
      for (const Patch& patch : entry.second.triangles)
        for (Vec2d p : patch.outer) {
          u0 = std::min(u0, p.x);
          u1 = std::max(u1, p.x);
        }
      auto& front = fronts_[entry.second.entity];
      if (u1 - u0 > front.first + 0.01) front = {u1 - u0, &entry.second};
    }
  }

  void Build(const Plane& plane) {
    const Vec2d at = plane.At(plane.triangles[0].outer[0].x);
    MeshBuilder& mesh = chunks_[{static_cast<int>(std::floor(at.x / kChunk)), static_cast<int>(std::floor(at.y / kChunk))}];
    for (const Patch& wall : Unite(plane.triangles)) {
      Bounds2d rect;
      Patches rest{wall};
      if (FacadeOf(wall, rect) && !IsHidden(plane, rect)) {
        Wall(mesh, plane, rect);
        rest = Subtract(rest, Patches{{{rect.min, {rect.max.x, rect.min.y}, rect.max, {rect.min.x, rect.max.y}}, {}}});
      }
      Plain(mesh, plane, rest);
    }
  }

  // Does a neighbour, or another part of the house, stand before it?
  bool IsHidden(const Plane& plane, const Bounds2d& rect) const {
    int covered = 0;
    for (double t : {0.12, 0.5, 0.88})
      covered += cover_.Top(plane.At(rect.min.x + (rect.max.x - rect.min.x) * t) + plane.out * 0.45) > rect.min.y + 0.5;
    return covered >= 2;
  }

  void Plain(MeshBuilder& mesh, const Plane& plane, const Patches& patches) {
    mesh.SetTransform({});
    mesh.SetEntity(plane.entity);
    mesh.SetMaterial(plane.material);
    for (const Patch& patch : patches) {
      std::vector<Vec2d> points = patch.outer;
      for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
      const auto point = [&](uint32_t i) {
        const Vec2d p = plane.At(points[i].x);
        return Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(points[i].y)};
      };
      const auto uv = [&](uint32_t i) { return Vec2f{static_cast<float>(points[i].x), static_cast<float>(-points[i].y)}; };
      const std::vector<uint32_t> t = Triangulate(patch);
      for (size_t i = 0; i + 2 < t.size(); i += 3)
        mesh.Triangle(point(t[i]), point(t[i + 1]), point(t[i + 2]), uv(t[i]), uv(t[i + 1]), uv(t[i + 2]));
    }
  }

  void Wall(MeshBuilder& mesh, const Plane& plane, const Bounds2d& rect) {
    const Entity& entity = scene_.entity(plane.entity);
    RngStream rng(seed_, entity.name);
    const auto height = static_cast<float>(rect.max.y - rect.min.y);
    BuildingPlan plan;
    plan.seed = rng.Bits();
    plan.style = PickFacadeStyle({}, "", static_cast<int>((entity.bounds.max.z - entity.bounds.min.z) / 3.3f), true, rng);
    plan.palette = static_cast<int>(rng.Index(static_cast<uint32_t>(MetricsOf(plan.style).palettes)));
    plan.roof = RoofKind::kHipTile;
    plan.shops = plan.canopies = false;
    plan.cornice = 0.45f;
    const bool tier = rect.min.y > static_cast<double>(entity.bounds.min.z) + 2;
    const float foot = tier ? 0.01f : MetricsOf(plan.style).ground_height, floor = MetricsOf(plan.style).floor_height;
    if (tier) plan.base = foot;
    plan.floors = std::max(0, static_cast<int>(std::lround((height - foot) / floor)));
    const float stretch = height / plan.height();
    const Dress dress = DressOf(plan);
    Surfaces own = surfaces_;
    // A colour that the file gives stays; the reader names its own materials after the type alone.
    if (scene_.materials[plane.material].name.find(' ') != std::string::npos)
      own = own.With(dress.wall, plane.material).With(dress.party, plane.material);
    const auto flat = [](Vec2d p) { return Vec2f{static_cast<float>(p.x), static_cast<float>(p.y)}; };
    const Vec2f a = flat(plane.At(rect.min.x)), b = flat(plane.At(rect.max.x)), in = flat(plane.out * -0.5);
    if (height < 4.4f || stretch < 0.72f || (tier && plan.floors == 0)) {
      BuildLowWall(mesh, own, dress, a, b, static_cast<float>(rect.min.y), height, plane.entity, rng);
      return;
    }
    const Vec3f middle = scene_.bounds.center();
    const double far = std::hypot(static_cast<double>(a.x - middle.x), static_cast<double>(a.y - middle.y));
    const bool front = fronts_.at(plane.entity).second == &plane && !tier;
    const FacadeDetail detail = far > kSimpleDetail           ? FacadeDetail::kFlat
                                : far > kFullDetail || !front ? FacadeDetail::kSimple
                                                              : FacadeDetail::kFull;
    plan.outline = {a, b, b + in, a + in};
    plan.edges = {front ? EdgeKind::kStreet : EdgeKind::kRear, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
    plan.party_height.assign(4, 1e6f);  // nothing there
    FacadeContext context{builder_, own, mesh, balcony_, window_box_};
    context.base = static_cast<float>(rect.min.y);
    context.stretch = stretch;
    context.reach = 0.6f;
    context.next_sign = static_cast<int>(plan.seed % kSignCount);
    BuildFacades(context, plan, plane.entity, {detail, FacadeDetail::kSimple, FacadeDetail::kSimple, FacadeDetail::kSimple});
  }

  const Scene& scene_;
  uint64_t seed_;
  SceneBuilder builder_;
  Surfaces surfaces_;
  MeshId balcony_ = 0, window_box_ = 0;
  std::map<std::tuple<EntityId, MaterialId, long, long>, Plane> planes_;
  std::map<EntityId, std::pair<double, const Plane*>> fronts_;
  std::vector<std::vector<uint32_t>> kept_;  // of each instance: triangles that are no walls
  Cover cover_;
  std::map<std::pair<int, int>, MeshBuilder> chunks_;
};

}  // namespace

std::shared_ptr<const Scene> WithFacades(std::shared_ptr<const Scene> scene, uint64_t seed) {
  auto dressed = Dresser(*scene, seed).Make();
  return dressed ? dressed : scene;
}

}  // namespace airsim360

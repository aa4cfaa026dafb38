#include "airsim360/people/body/skinning.h"

#include <algorithm>
#include <map>

#include "airsim360/base/parallel.h"
#include "airsim360/scene/scene_additions.h"

namespace airsim360 {
namespace {

// From the person frame at rest to the pose, as four columns of four numbers that the compiler keeps in vector
// registers.
struct alignas(16) BoneMatrix {
  float column[4][4];
};

BoneMatrix MakeBone(const RigidTransform& X_WJ, Vec3d p_PJ, Vec3d origin) {
  const Vec3d t = X_WJ.p - X_WJ.R * p_PJ - origin;
  BoneMatrix b{};
  for (int j = 0; j < 3; ++j) {
    const Vec3d c = X_WJ.R.column(j);
    for (int i = 0; i < 3; ++i) b.column[j][i] = static_cast<float>(c[i]);
  }
  for (int i = 0; i < 3; ++i) b.column[3][i] = static_cast<float>(t[i]);
  return b;
}

Vec3f Apply(const BoneMatrix& b, Vec3f p) {
  float out[4];
  for (int i = 0; i < 4; ++i) out[i] = b.column[0][i] * p.x + b.column[1][i] * p.y + b.column[2][i] * p.z + b.column[3][i];
  return {out[0], out[1], out[2]};
}

}  // namespace

void SkinBody(const Body& body, int level, const SkeletonPose& pose, Vec3d p_W_origin, std::vector<Vec3f>& positions) {
  const BodyLevel& shape = body.levels[static_cast<size_t>(level)];
  BoneMatrix bones[kJointCount + 1];
  for (size_t j = 0; j < kJointCount; ++j) bones[j] = MakeBone(pose.X_WJ[j], body.p_PJ[j], p_W_origin);
  bones[kRootInfluence] = MakeBone(pose.X_WP, {}, p_W_origin);

  // Blend the matrices, then move the vertex; most have one or two bones.
  const size_t count = shape.mesh.positions.size();
  positions.resize(count);
  for (size_t v = 0; v < count; ++v) {
    const Influences& in = shape.influences[v];
    const Vec3f p = shape.mesh.positions[v];
    if (in.weight[1] == 0) {
      positions[v] = Apply(bones[in.joint[0]], p);
      continue;
    }
    BoneMatrix mix;
    const float* a = bones[in.joint[0]].column[0];
    const float* b = bones[in.joint[1]].column[0];
    float* m = mix.column[0];
    for (int i = 0; i < 16; ++i) m[i] = a[i] * in.weight[0] + b[i] * in.weight[1];
    if (in.weight[2] != 0) {
      const float* c = bones[in.joint[2]].column[0];
      const float* d = bones[in.joint[3]].column[0];
      for (int i = 0; i < 16; ++i) m[i] += c[i] * in.weight[2] + d[i] * in.weight[3];
    }
    positions[v] = Apply(mix, p);
  }

  // Props that are not shown shrink to a millimetre inside the trunk, each at a place of its own: Embree cannot part
  // geometries that all are one point.
  constexpr float kShrunk = 1e-3f;
  const Vec3f inside = VecCast<float>(pose[Joint::kSpine2].p - p_W_origin);
  for (size_t k = 0; k < shape.props.size(); ++k) {
    const PropRange& prop = shape.props[k];
    if (pose.Shows(prop.prop)) continue;
    const Vec3f place = inside + Vec3f{0.006f, 0.008f, 0.010f} * static_cast<float>(k);
    const Vec3f* rest = &shape.mesh.positions[prop.first_vertex];
    for (uint32_t v = 0; v < prop.vertex_count; ++v) positions[prop.first_vertex + v] = place + (rest[v] - rest[0]) * kShrunk;
  }
}

namespace {

// Textures that are in the scene already, by the texture of a body.
using TextureIds = std::map<const Texture*, TextureId>;

TextureId SceneTexture(const Body& body, TextureId id, Scene& scene, TextureIds& known) {
  if (id == kNoTexture) return kNoTexture;
  const Texture* texture = body.textures[static_cast<size_t>(id)].get();
  const auto [place, fresh] = known.try_emplace(texture, static_cast<TextureId>(scene.textures.size()));
  if (fresh) scene.textures.push_back(*texture);
  return place->second;
}

EntityId AddEntity(Scene& scene, std::string name, std::string_view category) {
  const auto id = static_cast<EntityId>(scene.entities.size() + 1);
  scene.entities.push_back({id, std::move(name), scene.tree.At(category), {}});
  return id;
}

constexpr std::string_view kPropCategories[] = {"", "object/phone", "object/bag", "object/umbrella", "object/stroller"};

// One level of a person: a mesh whose parts and materials count on from those of the scene.
void AddLevel(const PersonInScene& person, int level, MaterialId first_material, float below, Scene& scene, PersonRef& ref) {
  Mesh mesh = person.body->levels[static_cast<size_t>(level)].mesh;
  mesh.name = person.name;
  for (MeshPart& part : mesh.parts) {
    part.material += first_material;
    const EntityId prop = part.entity;
    if (prop == 0) continue;
    if (ref.props[prop] == kNoEntity) {
      ref.props[prop] = AddEntity(scene, person.name + "/" + std::string(PropName(static_cast<Prop>(prop))), kPropCategories[prop]);
    }
    part.entity = ref.props[prop];
  }
  scene.instances.push_back({static_cast<MeshId>(scene.meshes.size()), {Mat3f{}, {0, 0, below}}, ref.entity});
  for (EntityId id = ref.entity; id <= scene.entities.size(); ++id) {
    Box3f& bounds = scene.entities[id - 1].bounds;
    for (const Vec3f& p : mesh.positions) bounds.Add(p + Vec3f{0, 0, below});
  }
  scene.meshes.push_back(std::move(mesh));
}

PersonRef AddPerson(const PersonInScene& person, Scene& scene, TextureIds& known) {
  const Body& body = *person.body;
  const int coarsest = static_cast<int>(body.levels.size()) - 1;
  int level = std::clamp(person.level, 0, coarsest);
  while (body.levels[static_cast<size_t>(level)].mesh.triangles.empty()) ++level;  // finer ones may be left out
  PersonRef ref{.instance = static_cast<uint32_t>(scene.instances.size()),
                .mesh = static_cast<MeshId>(scene.meshes.size()),
                .entity = AddEntity(scene, person.name, "human/person"),
                .level = level,
                .level_count = person.coarser ? coarsest - level + 1 : 1};
  const auto first_material = static_cast<MaterialId>(scene.materials.size());
  for (Material material : body.materials) {
    for (TextureId* id :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture, &material.emission_texture})
      *id = SceneTexture(body, *id, scene, known);
    scene.materials.push_back(std::move(material));
  }
  // Out of sight until a state shows it: below everything.
  const float below = (scene.bounds.min.z <= scene.bounds.max.z ? scene.bounds.min.z : 0) - 10;
  for (int k = 0; k < ref.level_count; ++k) AddLevel(person, level + k, first_material, below, scene, ref);
  return ref;
}

}  // namespace

std::shared_ptr<const Scene> AddPeople(std::shared_ptr<const Scene> scene, std::span<const PersonInScene> people,
                                       std::vector<PersonRef>& refs) {
  refs.clear();
  if (people.empty()) return scene;
  const std::shared_ptr<Scene> own = OwnScene(std::move(scene));
  // What is kept on disk of a scene is of the scene without people.
  own->cache_key.clear();
  TextureIds known;
  for (const PersonInScene& person : people) refs.push_back(AddPerson(person, *own, known));
  return own;
}

void HidePeople(std::span<const PersonRef> refs, SceneState& state) {
  for (const PersonRef& ref : refs) {
    for (int k = 0; k < ref.level_count; ++k) state.moved.push_back({ref.instance + static_cast<uint32_t>(k), {}, true});
  }
}

void AppendPeople(std::span<const PersonInScene> people, std::span<const PersonRef> refs, std::span<const SkeletonPose* const> poses,
                  std::span<const uint8_t> levels, SceneState& state) {
  const size_t moved = state.moved.size(), deformed = state.deformed.size();
  HidePeople(refs, state);
  std::vector<std::shared_ptr<std::vector<Vec3f>>> positions(refs.size());
  std::vector<size_t> places(refs.size());
  for (size_t i = 0, next = moved; i < refs.size(); next += static_cast<size_t>(refs[i++].level_count)) places[i] = next;
  ParallelFor(static_cast<int64_t>(refs.size()), [&](int64_t k) {
    const auto i = static_cast<size_t>(k);
    if (poses[i] == nullptr) return;
    const int level = refs[i].LevelFor(levels.empty() ? 0 : levels[i]);
    MovedInstance& place = state.moved[places[i] + static_cast<size_t>(level - refs[i].level)];
    place.hidden = false;
    // Vertices are relative to where the person stands, so that they are exact far from the origin too.
    place.X_WM.p = VecCast<float>(poses[i]->X_WP.p);
    positions[i] = std::make_shared<std::vector<Vec3f>>();
    SkinBody(*people[i].body, level, *poses[i], VecCast<double>(place.X_WM.p), *positions[i]);
  });
  for (size_t i = 0; i < refs.size(); ++i) {
    if (positions[i] == nullptr) continue;
    const int level = refs[i].LevelFor(levels.empty() ? 0 : levels[i]);
    state.deformed.push_back({refs[i].MeshOf(level), std::move(positions[i])});
  }
  const auto sort = [](auto& list, size_t from, auto key) {
    if (from > 0 && from < list.size() && list[from].*key < list[from - 1].*key) std::ranges::sort(list, {}, key);
  };
  sort(state.moved, moved, &MovedInstance::instance);
  sort(state.deformed, deformed, &DeformedMesh::mesh);
}

}  // namespace airsim360

#include "airsim360/worlds/props/props.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360 {
namespace {

// Equal for textures that look the same: name, pixels of the finest level (the others follow from it) and
// settings.
std::string TextureKey(const Texture& t) {
  std::string key =
      t.name + (t.srgb ? " srgb " : " linear ") + std::to_string(static_cast<int>(t.wrap_u)) + std::to_string(static_cast<int>(t.wrap_v));
  if (!t.levels.empty()) key += std::to_string(t.levels[0].width()) + " " + Sha256Hex(std::as_bytes(t.levels[0].pixels()));
  return key;
}

constexpr float kWhitest = 0.9f;  // albedo

// Turns, scales and paints a library model as its row asks.
void Adapt(Model& model, const LibraryModel& row) {
  const float height = model.mesh.Bounds().max.z;
  const float scale = row.height > 0 && height > 0 ? row.height / height : 1.0f;
  const AffineTransform X = PlaceUpright({}, row.turn_deg * std::numbers::pi_v<float> / 180, scale);
  for (Vec3f& p : model.mesh.positions) p = X * p;
  for (Vec3f& n : model.mesh.normals) n = Normalized(X.A * n);
  for (Material& m : model.materials) {
    // Panes that their author made blue or violet become neutral: here the sky gives them their colour.
    const Vec3f c = m.base_color;
    if (m.kind == SurfaceKind::kGlass && c.z > 1.5f * std::max(c.x, c.y)) m.base_color = {c.x, c.x, c.x};
    if (!row.paint.empty() && m.name == row.paint) {
      m.base_color = row.color;
      m.clear_coat = 1;
      m.clear_coat_roughness = 0.04f;
      m.roughness = std::max(m.roughness, 0.45f);
    }
  }
}

}  // namespace

const std::vector<PropKind>& PropKinds() {
  static const std::vector<PropKind> kinds = [] {
    using namespace internal;
    std::vector<PropKind> all;
    for (auto family :
         {BarrierKinds,    BusKinds,         CarKinds,       CycleKinds,       FountainKinds,     LampKinds,         RockKinds,
          RooftopKinds,    SeatingKinds,     ShadeKinds,     SignageKinds,     StreetKinds,       TrafficLightKinds, UtilityKinds,
          VendingKinds,    WasteKinds,       PlanterKinds,   GroundPlantKinds, ShrubKinds,        BroadleafKinds,    ConiferKinds,
          ParkKinds,       BillboardKinds,   LandmarkKinds,  NewYorkKinds,     SanFranciscoKinds, FurnishingKinds,   Cars1950sKinds,
          Signs1950sKinds, Street1950sKinds, Roofs1950sKinds}) {
      std::vector<PropKind> rows = family();
      std::move(rows.begin(), rows.end(), std::back_inserter(all));
    }
    std::sort(all.begin(), all.end(), [](const PropKind& a, const PropKind& b) { return a.name < b.name; });
    return all;
  }();
  return kinds;
}

const PropKind& FindPropKind(std::string_view name) {
  const auto& kinds = PropKinds();
  const auto it = std::lower_bound(kinds.begin(), kinds.end(), name, [](const PropKind& k, std::string_view n) { return k.name < n; });
  if (it != kinds.end() && it->name == name) return *it;
  std::vector<std::string> names;
  for (const PropKind& kind : kinds) names.emplace_back(kind.name);
  throw InputError(UnknownChoiceMessage("prop", name, names));
}

namespace {

Model MakeByDay(const PropKind& kind, uint32_t variant, uint64_t seed, const ModelSource* models) {
  variant %= static_cast<uint32_t>(kind.variants);
  if (models && variant < kind.library.size() && !kind.library[variant].name.empty()) {
    if (std::optional<Model> model = models->Load(kind.library[variant].name)) {
      Adapt(*model, kind.library[variant]);
      return *std::move(model);
    }
  }
  return kind.make(variant, MixBits(seed ^ HashName(kind.name)) + variant);
}

}  // namespace

Model MakeProp(const PropKind& kind, uint32_t variant, uint64_t seed, const ModelSource* models) {
  Model model = MakeByDay(kind, variant, seed, models);
  if (kind.category.starts_with("vehicle/")) internal::AddVehicleLamps(model, kind.name.starts_with("bus"));
  return model;
}

namespace {

// The green of an individual: most are near their kind's own, a few yellowish, as each has its soil, age and light. Hedges,
// which are planted a metre at a time, change slowly along their run.
Vec3f PlantTint(const PropKind& kind, Vec3f p) {
  const bool hedge = kind.category == "vegetation/hedge";
  if (!hedge && kind.category != "vegetation/shrub/bush" && !kind.category.starts_with("vegetation/tree")) return {1, 1, 1};
  if (hedge) {
    const float wave = 0.5f + 0.25f * (std::sin(0.11f * p.x + 0.07f * p.y) + std::sin(0.09f * p.y - 0.05f * p.x));
    return Vec3f{0.99f + 0.12f * wave, 1, 0.97f - 0.06f * wave} * (0.92f + 0.16f * wave);
  }
  const auto centimetres = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(std::lround(100 * v))); };
  RngStream random(MixBits(centimetres(p.x)) ^ centimetres(p.y), "plant tint");
  const auto yellow = static_cast<float>(random.Uniform()), light = static_cast<float>(random.Uniform(0.86, 1.12));
  const float share = yellow * yellow;
  return Vec3f{0.97f + 0.22f * share, 1 + 0.05f * share, 1 - 0.10f * share} * light;
}

bool IsPlanter(const PropKind& kind) { return kind.name == "pot" || kind.name == "green_pot" || kind.name == "planter"; }
bool DiffersFromNeighbours(const PropKind& kind) { return IsPlanter(kind) || kind.category.starts_with("vehicle/"); }

// What is no one's own: pots come in sizes, are turned as they were put down, faded and dirty each in its way. Long planters stay
// nearly as they were laid out, and all within the ground that their kind needs.
struct Own {
  AffineTransform X;
  Vec3f tint{1, 1, 1};
};
Own OwnLook(const PropKind& kind, Vec3f p) {
  if (!IsPlanter(kind)) return {};
  const auto centimetres = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(std::lround(100 * v))); };
  RngStream random(MixBits(centimetres(p.x)) ^ centimetres(p.y), "own look");
  const bool box = kind.name == "planter";
  const auto turn = static_cast<float>(random.Uniform(-1, 1)) * (box ? 0.025f : std::numbers::pi_v<float>),
             scale = static_cast<float>(random.Uniform(box ? 0.88 : 0.76, 1.0)), light = static_cast<float>(random.Uniform(0.78, 1.1)),
             warm = static_cast<float>(random.Uniform(-0.06, 0.06));
  return {PlaceUpright({}, turn, scale), Vec3f{1 + warm, 1, 1 - warm} * light};
}

}  // namespace

PropShelf::PropShelf(SceneBuilder& builder, const ModelSource* models, uint64_t seed) : builder_(builder), models_(models), seed_(seed) {}

EntityId PropShelf::Place(std::string_view kind, Vec3f p_W, float yaw, uint32_t variant, float scale, Vec3f tint, Engine engine) {
  const PropKind &asked = FindPropKind(kind), &found = StandInFor(asked);
  const std::string_view name = asked.category == found.category ? asked.name : found.name;
  const EntityId entity = builder_.AddEntity(std::string(name), builder_.tree().At(found.category));
  Stand(found, PlaceUpright(p_W, yaw, scale), variant, entity, tint, engine);
  return entity;
}

void PropShelf::PlaceAs(EntityId entity, std::string_view kind, const AffineTransform& X_WM, uint32_t variant, Vec3f tint) {
  Stand(StandInFor(FindPropKind(kind)), X_WM, variant, entity, tint, Engine::kOff);
}

void PropShelf::Stand(const PropKind& kind, const AffineTransform& placed, uint32_t variant, EntityId entity, Vec3f tint, Engine engine) {
  const Vec3f p = placed.p;
  const Own own = OwnLook(kind, p);
  const AffineTransform stands = IsPlanter(kind) ? placed * own.X : placed;
  builder_.AddInstance({Get(kind, Differing(kind, p, variant)), lay_ ? lay_(kind.name, stands) : stands, entity,
                        tint * PlantTint(kind, p) * own.tint, internal::EveningGlow(kind.name, kind.category, p, engine)});
}

// The individual `variant`, or the next that no neighbour of the kind is.
uint32_t PropShelf::Differing(const PropKind& kind, Vec3f p, uint32_t variant) {
  const auto count = static_cast<uint32_t>(kind.variants);
  variant %= count;
  if (!DiffersFromNeighbours(kind)) return variant;
  std::vector<Look>& looks = looks_[kind.name];
  const auto taken = [&](uint32_t v) {
    return std::ranges::any_of(looks, [&](const Look& look) { return look.variant == v && Norm(look.p_W - p) < kOwnLook; });
  };
  uint32_t own = variant;
  for (uint32_t k = 0; k < count && taken(own); ++k) own = (variant + k + 1) % count;
  looks.push_back({p, own});
  return own;
}

const PropKind& PropShelf::StandInFor(const PropKind& asked) const {
  const auto it = stand_ins_.find(asked.name);
  return it == stand_ins_.end() ? asked : *it->second;
}

MeshId PropShelf::Get(const PropKind& kind, uint32_t variant) {
  auto& meshes = meshes_[kind.name];
  if (meshes.empty()) {
    // Make in parallel, add in order.
    std::vector<Model> models(static_cast<size_t>(kind.variants));
    ParallelFor(kind.variants,
                [&](int64_t i) { models[static_cast<size_t>(i)] = MakeProp(kind, static_cast<uint32_t>(i), seed_, models_); });
    for (Model& model : models) meshes.push_back(Add(std::move(model)));
  }
  return meshes[variant % meshes.size()];
}

MeshId PropShelf::Add(Model model) {
  // Indices of the model become ids of the scene.
  std::vector<TextureId> texture_ids;
  for (Texture& texture : model.textures) texture_ids.push_back(AddTexture(std::move(texture)));
  if (model.materials.empty()) model.materials.emplace_back();
  std::vector<MaterialId> material_ids;
  for (Material& material : model.materials) {
    // No paint is whiter than snow, and a filtered white texture must not round to more than 1.
    const Vec3f c = material.base_color;
    if (material.kind == SurfaceKind::kStandard) material.base_color = c * std::min(1.0f, kWhitest / std::max({c.x, c.y, c.z, kWhitest}));
    for (TextureId* id :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture, &material.emission_texture}) {
      if (*id != kNoTexture) *id = texture_ids.at(static_cast<size_t>(*id));
    }
    material_ids.push_back(AddMaterial(material));
  }
  if (model.mesh.parts.empty()) model.mesh.parts.push_back({0, static_cast<uint32_t>(model.mesh.triangles.size()), 0, kNoEntity});
  for (MeshPart& part : model.mesh.parts) part.material = material_ids.at(part.material);
  if (!model.attribution.empty()) builder_.AddAttribution(std::move(model.attribution));
  return builder_.AddMesh(std::move(model.mesh));
}

TextureId PropShelf::AddTexture(Texture texture) {
  const auto [it, fresh] = textures_.try_emplace(TextureKey(texture), kNoTexture);
  if (fresh) it->second = builder_.AddTexture(std::move(texture));
  return it->second;
}

MaterialId PropShelf::AddMaterial(const Material& material) {
  const auto [first, last] = materials_.equal_range(material.name);
  for (auto it = first; it != last; ++it) {
    if (internal::SameMaterial(builder_.material(it->second), material)) return it->second;
  }
  return materials_.emplace(material.name, builder_.AddMaterial(material))->second;
}

}  // namespace airsim360

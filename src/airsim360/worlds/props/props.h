// The props of a world: furniture, vehicles and plants, procedural, each with optional ready-made models that
// replace it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"
#include "airsim360/worlds/props/evening.h"

namespace airsim360 {

/// A ready-made model that may stand in for a variant of a kind.
struct LibraryModel {
  std::string_view name;        ///< name to ask the ModelSource for; "" = this variant is always procedural
  float height = 0;             ///< metres; the model is scaled uniformly to it; 0 = as it comes
  float turn_deg = 0;           ///< counter-clockwise from above, so that its front looks towards -Y
  std::string_view paint = "";  ///< its material that gets `color`; "" = none
  Vec3f color{};
};

/// How one kind of prop is made. Models stand on z = 0, centred on the z axis, front towards -Y, metres.
/// Parts below the ground (roots, stakes) reach down to -0.3 m at most.
struct PropKind {
  std::string_view name;                                     ///< "bench_wood"
  std::string_view category;                                 ///< path in the semantic tree
  int variants = 1;                                          ///< different individuals
  Model (*make)(uint32_t variant, uint64_t seed) = nullptr;  ///< procedural individual, variant < variants
  float footprint_radius = 0.5f;                             ///< metres of ground it needs free of other props
  float min_height = 0, max_height = 0;                      ///< of all individuals, metres above the ground
  uint32_t max_triangles = 5000;                             ///< budget of one procedural individual
  std::vector<LibraryModel> library = {};                    ///< variant i asks for library[i]; past the end = procedural
};

/// All kinds, by name: the rows of the families in props/ and vegetation/.
const std::vector<PropKind>& PropKinds();
/// A kind by name; InputError naming the nearest.
const PropKind& FindPropKind(std::string_view name);
/// One individual: the ready-made model if `models` (may be null) has it, else the procedural one. `variant`
/// is taken modulo the kind's variants.
Model MakeProp(const PropKind& kind, uint32_t variant, uint64_t seed, const ModelSource* models);

/// Adds props to a scene: all variants of a kind are made at its first use (in parallel), once, and
/// instanced. Materials and textures that are equal are shared between props. No two vehicles, pots or planters within
/// kOwnLook metres of each other are the same individual while the kind has others; pots and planters have each their own size,
/// turn and tone as well.
class PropShelf {
 public:
  PropShelf(SceneBuilder& builder, const ModelSource* models, uint64_t seed);
  static constexpr float kOwnLook = 8;
  /// Places one prop as an entity of its own, named after the kind, and returns it. `variant` is taken modulo
  /// the kind's variants; where a neighbour looks like that, the next one is taken. `engine` matters to vehicles alone.
  EntityId Place(std::string_view kind, Vec3f p_W, float yaw = 0, uint32_t variant = 0, float scale = 1, Vec3f tint = {1, 1, 1},
                 Engine engine = Engine::kOff);
  /// Adds an instance of a kind to an existing entity (grass tufts of one lawn, say).
  void PlaceAs(EntityId entity, std::string_view kind, const AffineTransform& X_WM, uint32_t variant = 0, Vec3f tint = {1, 1, 1});
  /// From now on `by` is made where `kind` is asked for; numbers of individuals beyond those that it has begin again at 0. Who
  /// draws an individual draws among those of `kind`. Entities keep the name of `kind` where both are of one category.
  void Replace(std::string_view kind, std::string_view by) { stand_ins_[FindPropKind(kind).name] = &FindPropKind(by); }
  /// Everything placed from now on comes to stand where `lay` (kind, as placed) puts it: on a slope, say. Null = as placed.
  using Lay = std::function<AffineTransform(std::string_view kind, const AffineTransform& placed)>;
  void SetLay(Lay lay) { lay_ = std::move(lay); }
  /// Adds a model that is no kind of prop, with its materials and textures, for instances of the caller's own.
  MeshId Add(Model model);

 private:
  struct Look {
    Vec3f p_W;
    uint32_t variant;
  };
  const PropKind& StandInFor(const PropKind& asked) const;
  uint32_t Differing(const PropKind& kind, Vec3f p_W, uint32_t variant);
  void Stand(const PropKind& kind, const AffineTransform& placed, uint32_t variant, EntityId entity, Vec3f tint, Engine engine);
  MeshId Get(const PropKind& kind, uint32_t variant);
  TextureId AddTexture(Texture texture);
  MaterialId AddMaterial(const Material& material);

  SceneBuilder& builder_;
  const ModelSource* models_;
  uint64_t seed_;
  Lay lay_;
  std::map<std::string_view, const PropKind*> stand_ins_;   // by the name of the kind that is asked for
  std::map<std::string_view, std::vector<MeshId>> meshes_;  // kind -> one mesh a variant
  std::map<std::string_view, std::vector<Look>> looks_;     // kind -> who stands where, of kinds that differ from neighbours
  std::map<std::string, TextureId> textures_;               // by name and content
  std::multimap<std::string, MaterialId> materials_;        // by name, to find equal ones
};

}  // namespace airsim360

// Facades by grammar: ground floor of shops or windows, storeys of bays, cornice; every window a recessed
// opening.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/building/facade_pen.h"
#include "airsim360/worlds/building/massing.h"

namespace airsim360 {

/// How much geometry a wall gets.
enum class FacadeDetail {
  kFull,    ///< frames, glazing bars, sills, ornaments, shopfronts
  kSimple,  ///< recessed openings with a pane
  kFlat,    ///< a picture of windows
};

/// What facades add to the scene beside the merged mesh.
struct FacadeContext {
  SceneBuilder& builder;
  const Surfaces& surfaces;
  MeshBuilder& mesh;
  MeshId balcony;                                         ///< instanced railing of 1 m, scaled along x: iron balcony of a French window
  MeshId window_box;                                      ///< instanced air conditioner or flowers in a window
  std::optional<std::array<MeshId, 2>> fire_escape = {};  ///< a storey of one, both ways; without: none
  float escape_wall = 8;                                  ///< least length of the walls that may have one; at least 4.8 m
  EntityId building = kNoEntity;                          ///< the one being built
  int next_sign = 0;                                      ///< picture of the last shop sign, so that neighbours differ
  float base = 0, stretch = 1, reach = 1;                 ///< of the building: z of its ground, factors of FacadePen::SetScale
  /// How far the ground lies below that z at a point of the plan, metres; without: nowhere.
  std::function<float(Vec2f)> fall = nullptr;
  AffineTransform X_WB = {};  ///< where what is built in the mesh will lie: instances beside it go there at once
  AffineTransform Place(const AffineTransform& X) const { return X_WB == AffineTransform{} ? X : X_WB * X; }
};

/// Walls of one building on all its edges, as `entity`; awnings and shop signs become entities of their own.
/// `detail` says how much each edge gets.
void BuildFacades(FacadeContext& context, const BuildingPlan& building, EntityId entity, const std::vector<FacadeDetail>& detail);

/// The surface of a building's plain walls.
Surface WallSurfaceOf(const BuildingPlan& building);
/// Height of the parapet above the roof deck; 0 for pitched roofs.
float ParapetHeight(const BuildingPlan& building);

/// The meshes that facades repeat.
MeshId AddBalconyMesh(SceneBuilder& builder, const Surfaces& surfaces);
/// An air conditioner, or (`cooler` false) a box of flowers on the sill.
MeshId AddWindowBoxMesh(SceneBuilder& builder, const Surfaces& surfaces, bool cooler = true);
/// A landing of 4.4 m with railing and the flight up to the next, for storeys of 3.2 m.
MeshId AddFireEscapeMesh(SceneBuilder& builder, const Surfaces& surfaces, bool mirrored);
/// Where the stoop of a brownstone lies along a street wall of that length: its middle. It reaches 1.9 m out.
float StoopMiddle(float wall_length);

}  // namespace airsim360

// What the builders of one building share, and the builders of its parts.
#pragma once

#include <string>

#include "airsim360/worlds/interior/building_plan.h"
#include "airsim360/worlds/interior/finishes.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal {

/// Draws faces whose textures lie in place with the world, as entities with names.
class InteriorPen {
 public:
  InteriorPen(SceneBuilder& builder, const Finishes& finishes) : builder_(builder), finishes_(finishes) {}

  EntityId Start(std::string name, const char* category);
  void Resume(EntityId entity) { mesh_.SetEntity(entity); }
  void Use(Finish finish) { mesh_.SetMaterial(finishes_[finish]); }
  void Use(MaterialId material) { mesh_.SetMaterial(material); }
  /// A level rectangle that faces up or down.
  void Level(const PlanRect& r, float z, bool up);
  /// An upright one from `from` to `to` along x or y at `at`, which faces towards larger (`high`) or smaller coordinates.
  void Upright(bool along_x, float at, float from, float to, float z0, float z1, bool high);
  /// Both faces of a sheet of glass.
  void Pane(bool along_x, float at, float from, float to, float z0, float z1) { Upright(along_x, at, from, to, z0, z1, true); }
  void Box(Vec3f low, Vec3f high, unsigned sides = MeshBuilder::kAllSides);
  /// A box given along a wall: from … to along it, near … far across it.
  void WallBox(bool along_x, float from, float to, float near, float far, float z0, float z1);
  MeshBuilder& mesh() { return mesh_; }
  SceneBuilder& builder() { return builder_; }
  /// Adds all that was drawn as one instance.
  void Done(const char* name);

 private:
  SceneBuilder& builder_;
  const Finishes& finishes_;
  MeshBuilder mesh_;
};

/// Finishes of a room's floor, walls and ceiling.
struct RoomFinish {
  Finish floor, wall, ceiling;
  bool skirting;
};
RoomFinish FinishOf(const InteriorPlan& plan, int room);
/// Outside of the walls.
Finish FacadeOf(const InteriorPlan& plan);

/// Floors, ceilings, roof and walls with the frames and panes of their openings.
void BuildShell(const InteriorPlan& plan, InteriorPen& pen);
void BuildWalls(const InteriorPlan& plan, InteriorPen& pen);
/// The leaves of a door, as an entity "door 3 open"; a window or glazing with frame and panes.
void BuildDoor(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& opening, InteriorPen& pen);
void BuildWindow(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& opening, InteriorPen& pen);
/// Stairs with railings, ramps, escalators, columns, beams.
void BuildStairs(const InteriorPlan& plan, InteriorPen& pen);
void BuildStructure(const InteriorPlan& plan, InteriorPen& pen);

}  // namespace airsim360::internal

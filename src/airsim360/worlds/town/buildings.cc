#include "airsim360/worlds/town/buildings.h"

#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/building/roofs.h"

namespace airsim360::internal {
namespace {

// Full dress where a wall can be seen from close by, less beyond.
std::vector<FacadeDetail> DetailOf(const StreetPlan& plan, const BuildingPlan& building) {
  const GroundRect reach = plan.reach().Inset(-0.5f);
  std::vector<FacadeDetail> detail;
  for (size_t i = 0; i < building.outline.size(); ++i) {
    const Vec2f middle = (building.outline[i] + building.outline[(i + 1) % building.outline.size()]) * 0.5f;
    detail.push_back(reach.Contains(middle)              ? FacadeDetail::kFull
                     : reach.Inset(-40).Contains(middle) ? FacadeDetail::kSimple
                                                         : FacadeDetail::kFlat);
  }
  return detail;
}

}  // namespace

void BuildBuildings(District& d, const std::vector<BuildingPlan>& buildings, const BuildingExtras& extras) {
  MeshBuilder mesh;
  FacadeContext context{d.builder, d.surfaces, mesh, AddBalconyMesh(d.builder, d.surfaces),
                        AddWindowBoxMesh(d.builder, d.surfaces, extras.coolers)};
  if (extras.fire_escapes)
    context.fire_escape = {AddFireEscapeMesh(d.builder, d.surfaces, false), AddFireEscapeMesh(d.builder, d.surfaces, true)};
  context.escape_wall = extras.escape_wall;
  EntityId walls = kNoEntity;
  for (size_t i = 0; i < buildings.size(); ++i) {
    const BuildingPlan& building = buildings[i];
    if (building.base == 0)
      walls = d.builder.AddEntity(building.name.empty() ? "building" : building.name, d.builder.tree().At("construction/building"));
    const EntityId roof = d.builder.AddEntity("roof", d.builder.tree().At("construction/building/roof"));
    BuildFacades(context, building, walls, DetailOf(d.plan, building));
    BuildRoof(d.builder, mesh, d.surfaces, &d.placer.shelf(), building, walls, roof);
    const bool last = i + 1 == buildings.size() || buildings[i + 1].block != building.block;
    if (!last) continue;
    d.builder.AddInstance({d.builder.AddMesh(mesh.Finish("buildings of block " + std::to_string(building.block))), {}, kNoEntity});
  }
}

}  // namespace airsim360::internal

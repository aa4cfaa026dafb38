#include "airsim360/scene/entity_table.h"

#include <cmath>

namespace airsim360 {
namespace {

// The rotation nearest to an upright or scaled placement: columns made orthonormal in order z, x.
Mat3d RotationOf(const Mat3f& A) {
  const Vec3d z = Normalized(VecCast<double>(A.column(2)));
  const Vec3d x0 = VecCast<double>(A.column(0));
  const Vec3d x = Normalized(x0 - z * Dot(x0, z));
  if (!(Norm(z) > 0.5) || !(Norm(x) > 0.5)) return {};
  return Mat3d::FromColumns(x, Cross(z, x), z);
}

}  // namespace

std::vector<EntityRow> EntityTable(const Scene& scene) {
  std::vector<EntityRow> rows(scene.entities.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    const Entity& entity = scene.entities[i];
    const Category& category = scene.tree[entity.category];
    EntityRow& row = rows[i];
    row.id = entity.id;
    row.name = entity.name;
    row.category = entity.category;
    row.path = category.path;
    row.thing = category.thing;
    row.box = entity.bounds;
    row.has_box = !entity.bounds.empty();
    if (row.has_box) {
      const Vec3f c = entity.bounds.center();
      row.X_WE.p = {c.x, c.y, entity.bounds.min.z};
    }
  }
  // Those that are one placed mesh stand where it does.
  for (const Instance& instance : scene.instances) {
    if (instance.entity == kNoEntity || instance.entity > rows.size()) continue;
    EntityRow& row = rows[instance.entity - 1];
    if (++row.instances == 1) {
      row.X_WE = {RotationOf(instance.X_WM.A), VecCast<double>(instance.X_WM.p)};
    } else if (row.instances == 2 && row.has_box) {
      const Vec3f c = row.box.center();
      row.X_WE = {{}, {c.x, c.y, row.box.min.z}};
    }
  }
  return rows;
}

}  // namespace airsim360

#include "airsim360/render/reference/portals.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {

Portals::Portals(const RayTracer& built, const Enclosure& enclosure) : enclosure_(&enclosure) {
  if (!enclosure.any() || !built.has_clear_panes()) return;
  const Scene& scene = built.scene();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      if (!IsClearPane(scene.materials[part.material])) continue;
      for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
        const Vec3u& t = mesh.triangles[k];
        const Vec3f p = instance.X_WM * mesh.positions[t.x];
        const Vec3f a = instance.X_WM * mesh.positions[t.y] - p, b = instance.X_WM * mesh.positions[t.z] - p;
        const float area = 0.5f * Norm(Cross(a, b));
        Box3f box;
        box.Add(p), box.Add(p + a), box.Add(p + b);
        if (area > 1e-4f && enclosure.Touches(box)) panes_.push_back({p, a, b, Normalized(Cross(a, b)), area});
      }
    }
  }
  std::ranges::stable_sort(panes_, std::greater{}, &Pane::area);
  if (panes_.size() > kMost) panes_.resize(kMost);
}

// About the solid angle.
float Portals::Weight(const Pane& pane, Vec3f p) {
  const Vec3f to = pane.corner + (pane.a + pane.b) * (1.0f / 3) - p;
  const float d2 = Dot(to, to);
  return pane.area * (std::fabs(Dot(pane.normal, to)) / std::sqrt(std::max(d2, 1e-12f)) + 0.05f) / (d2 + 0.3f * pane.area);
}

Vec3f Portals::Sample(Vec3f p, Vec2f u) const {
  float weight[kMost], sum = 0;
  for (size_t i = 0; i < panes_.size(); ++i) sum += weight[i] = Weight(panes_[i], p);
  float at = u.x * sum;
  size_t chosen = 0;
  while (chosen + 1 < panes_.size() && at >= weight[chosen]) at -= weight[chosen++];
  const float rest = std::clamp(at / weight[chosen], 0.0f, 0.9999999f);
  const Pane& pane = panes_[chosen];
  const float root = std::sqrt(rest);
  const Vec3f to = pane.corner + pane.a * (root * (1 - u.y)) + pane.b * (root * u.y) - p;
  return Norm(to) > 1e-6f ? Normalized(to) : pane.normal;
}

float Portals::Pdf(Vec3f p, Vec3f d) const {
  float sum = 0, density = 0;
  for (const Pane& pane : panes_) {
    const float weight = Weight(pane, p);
    sum += weight;
    const float cosine = Dot(pane.normal, d);
    if (std::fabs(cosine) < 1e-5f) continue;
    const float t = Dot(pane.corner - p, pane.normal) / cosine;
    if (t <= 1e-4f) continue;
    const Vec3f x = p + d * t - pane.corner;
    // Barycentrics by the areas of its parts.
    const float whole = 2 * pane.area;
    const float v = Dot(Cross(pane.a, x), pane.normal) / whole, w = Dot(Cross(x, pane.b), pane.normal) / whole;
    if (v < 0 || w < 0 || v + w > 1) continue;
    density += weight * t * t / (pane.area * std::fabs(cosine));
  }
  return sum > 0 ? density / sum : 0;
}

}  // namespace airsim360::internal

// The node hierarchy.
#include <cmath>
#include <utility>

#include "airsim360/assets/gltf/gltf_parts.h"

namespace airsim360::internal {
namespace {

Mat3d Scaled(Mat3d R, double x, double y, double z) { return Mat3d::FromColumns(R.column(0) * x, R.column(1) * y, R.column(2) * z); }

TransformG LocalTransform(const JsonRef& node) {
  if (const auto matrix = node.Find("matrix")) {
    // Column-major.
    const std::vector<double> m = matrix->Numbers(16);
    return {Mat3d::FromColumns({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}), {m[12], m[13], m[14]}};
  }
  const std::vector<double> t = node.NumbersOr("translation", {0, 0, 0});
  const std::vector<double> q = node.NumbersOr("rotation", {0, 0, 0, 1});
  const std::vector<double> s = node.NumbersOr("scale", {1, 1, 1});
  return {Scaled(RotationOf(q[0], q[1], q[2], q[3], node), s[0], s[1], s[2]), {t[0], t[1], t[2]}};
}

// Every child gets its parent; nobody gets two.
void LinkChildren(const JsonRef& nodes, std::vector<GltfNode>& out) {
  for (size_t i = 0; i < out.size(); ++i) {
    const auto children = nodes[i].Find("children");
    for (size_t k = 0; children && k < children->size(); ++k) {
      const JsonRef child = (*children)[k];
      const uint64_t index = child.Uint();
      if (index >= out.size()) child.Fail("there are only " + std::to_string(out.size()) + " nodes");
      GltfNode& node = out[static_cast<size_t>(index)];
      if (node.parent >= 0) child.Fail("this node has two parents, or is its own ancestor");
      node.parent = static_cast<int64_t>(i);
      out[i].children.push_back(static_cast<uint32_t>(index));
    }
  }
}

}  // namespace

Mat3d RotationOf(double x, double y, double z, double w, const JsonRef& where) {
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 1e-9) || !std::isfinite(length)) where.Fail("the rotation quaternion has no direction");
  return ToMatrix(Quaternion{w / length, x / length, y / length, z / length});
}

std::vector<GltfNode> ReadNodes(const JsonRef& root, const ImportLimits& limits) {
  const auto nodes = root.Find("nodes");
  if (!nodes) return {};
  if (nodes->size() > limits.max_nodes) nodes->Fail("at most " + std::to_string(limits.max_nodes) + " nodes allowed");
  std::vector<GltfNode> out(nodes->size());
  LinkChildren(*nodes, out);

  // From the roots down, level by level; what is never reached hangs in a cycle.
  std::vector<uint32_t> level;
  for (uint32_t i = 0; i < out.size(); ++i) {
    if (out[i].parent < 0) level.push_back(i);
  }
  size_t reached = 0;
  for (int depth = 0; !level.empty(); ++depth) {
    std::vector<uint32_t> next;
    for (uint32_t i : level) {
      const JsonRef json = (*nodes)[i];
      if (depth > limits.max_depth) json.Fail("nodes nested deeper than " + std::to_string(limits.max_depth));
      const TransformG local = LocalTransform(json);
      out[i].X_G = out[i].parent < 0 ? local : out[static_cast<size_t>(out[i].parent)].X_G * local;
      next.insert(next.end(), out[i].children.begin(), out[i].children.end());
    }
    reached += level.size();
    level = std::move(next);
  }
  if (reached < out.size()) nodes->Fail("the hierarchy has a cycle: a node is its own ancestor");
  return out;
}

std::vector<TransformG> ReadGpuInstances(const JsonRef& extension, GltfBuffers& buffers, const ImportLimits& limits) {
  const JsonRef attributes = extension.At("attributes");
  std::vector<float> t, r, s;
  size_t count = SIZE_MAX;
  const auto read = [&](const char* name, size_t components, std::vector<float>& values) {
    const auto index = attributes.Find(name);
    if (!index) return;
    values = buffers.Floats(*index, static_cast<int>(components));
    if (count != SIZE_MAX && values.size() / components != count) index->Fail("the instance attributes differ in length");
    count = values.size() / components;
  };
  read("TRANSLATION", 3, t);
  read("ROTATION", 4, r);
  read("SCALE", 3, s);
  if (count == SIZE_MAX) return {};
  if (count > limits.max_nodes) attributes.Fail("at most " + std::to_string(limits.max_nodes) + " instances allowed");

  std::vector<TransformG> out;
  for (size_t i = 0; i < count; ++i) {
    TransformG X{};
    if (!r.empty()) X.A = RotationOf(r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3], attributes);
    if (!s.empty()) X.A = Scaled(X.A, s[3 * i], s[3 * i + 1], s[3 * i + 2]);
    if (!t.empty()) X.p = {t[3 * i], t[3 * i + 1], t[3 * i + 2]};
    out.push_back(X);
  }
  return out;
}

}  // namespace airsim360::internal

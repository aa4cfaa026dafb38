#include "airsim360/assets/importing/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "airsim360/assets/importing/place_model.h"
#include "airsim360/base/error.h"
#include "airsim360/math/box.h"
#include "airsim360/math/median.h"

namespace airsim360 {
namespace {

const std::array<std::string, 6> kAxes = {"x", "y", "z", "-x", "-y", "-z"};

std::string Short(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

// The file's coordinates with the named axis turned to +Z; the other two keep their order.
Mat3f TurnedUp(const std::string& up) {
  if (up == "y") return Mat3f::FromColumns({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
  if (up == "x") return Mat3f::FromColumns({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  if (up == "-x") return Mat3f::FromColumns({0, 0, -1}, {1, 0, 0}, {0, -1, 0});
  if (up == "-y") return Mat3f::FromColumns({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  if (up == "-z") return Mat3f::FromColumns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
  return {};
}

// Lowest z of all that the nodes show; infinite if nothing.
float Lowest(const internal::ImportedFile& file) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const internal::ImportedNode& node : file.nodes) {
    if (node.mesh < 0) continue;
    for (Vec3f p : file.meshes[static_cast<size_t>(node.mesh)].positions) lowest = std::min(lowest, (node.X_WM * p).z);
  }
  return lowest;
}

void Apply(const AffineTransform& X, internal::ImportedFile& file) {
  if (X == AffineTransform{}) return;
  for (internal::ImportedNode& node : file.nodes) node.X_WM = X * node.X_WM;
  if (file.written && file.written->spawn) file.written->spawn = X * *file.written->spawn;
}

}  // namespace

void ValidatePlacement(const ModelPlacement& placement, const std::string& where) {
  if (placement.scale && !(*placement.scale >= ModelPlacement::kLeastScale && *placement.scale <= ModelPlacement::kMostScale))
    throw InputError(where + "scale: " + Short(*placement.scale) + " is not in 1e-06 … 1e+06 metres a unit");
  if (!placement.up.empty() && std::find(kAxes.begin(), kAxes.end(), placement.up) == kAxes.end())
    throw InputError(where + "up: " + UnknownChoiceMessage("axis", placement.up, kAxes));
  for (double v : {placement.offset.x, placement.offset.y, placement.offset.z}) {
    if (!(std::abs(v) <= ModelPlacement::kMostOffset)) throw InputError(where + "offset: " + Short(v) + " is not in -1e+06 … 1e+06 metres");
  }
}

namespace internal {

void TurnUp(const std::string& up, const std::string& as_read, double scale, ImportedFile& file) {
  // Readers have turned the format's own up axis to +Z: that is undone first.
  const Mat3f R = up.empty() || up == as_read ? Mat3f{} : TurnedUp(up) * TurnedUp(as_read).transpose();
  const auto s = static_cast<float>(scale);
  Apply({R * Mat3f::FromColumns({s, 0, 0}, {0, s, 0}, {0, 0, s}), {}}, file);
}

void PlaceModel(const ModelPlacement& placement, const std::string& as_read, ImportedFile& file) {
  TurnUp(placement.up, as_read, placement.scale.value_or(1), file);
  const float lowest = placement.ground ? Lowest(file) : 0;
  Apply({{}, VecCast<float>(placement.offset) + Vec3f{0, 0, std::isfinite(lowest) ? -lowest : 0}}, file);
  if (placement.ground) AddPlain(file);
}

void AddPlain(ImportedFile& file) {
  constexpr float kHalf = 4000, kTile = 4;
  Mesh mesh;
  mesh.name = "plain";
  mesh.positions = {{-kHalf, -kHalf, 0}, {kHalf, -kHalf, 0}, {kHalf, kHalf, 0}, {-kHalf, kHalf, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 0}, {kHalf / kTile, 0}, {kHalf / kTile, kHalf / kTile}, {0, kHalf / kTile}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 2, static_cast<MaterialId>(file.materials.size()), kNoEntity}};
  Material material;
  material.name = "plain";
  material.base_color = {0.21f, 0.2f, 0.16f};
  material.roughness = 0.95f;
  material.macro_variation = 0.25f;
  file.materials.push_back(material);
  file.meshes.push_back(mesh);
  ImportedNode node;
  node.name = "plain";
  node.mesh = static_cast<int32_t>(file.meshes.size() - 1);
  node.category = "ground/terrain/landscape";
  node.added = true;
  file.nodes.push_back(node);
}

std::string GuessUnits(const std::vector<KnownSize>& sizes, double extent) {
  // How many times too large or small the things are whose size is known: the middle of all.
  std::vector<double> ratios;
  for (const KnownSize& size : sizes) {
    if (size.extent > 0) ratios.push_back(std::log10(size.extent / size.usual));
  }
  if (!ratios.empty()) {
    const double middle = UpperMedian(ratios);
    const KnownSize* example = &sizes[0];
    for (const KnownSize& size : sizes) {
      if (size.extent > 0 && std::log10(size.extent / size.usual) == middle) example = &size;
    }
    const std::string seen = "'" + example->name + "' (" + example->category + ") is " + Short(example->extent) + " m large: ";
    if (middle > 2.5) return seen + "looks like millimetres: use scale: 0.001";
    if (middle > 1.7) return seen + "looks like centimetres: use scale: 0.01";
    if (middle > 1.3) return seen + "looks like inches: use scale: 0.0254";
    if (middle < -1.7) return seen + "looks like units of 100 m: use scale: 100";
    return "";
  }
  constexpr double kWide = 2000;
  if (extent > kWide * 10) return "is " + Short(extent) + " m wide: looks like millimetres: use scale: 0.001";
  if (extent > kWide) return "is " + Short(extent) + " m wide: looks like centimetres: use scale: 0.01";
  return "";
}

}  // namespace internal
}  // namespace airsim360

#include "airsim360/assets/cityjson/cityjson_palette.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/assets/imported.h"
#include "airsim360/image/color.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostMaterials = 4096;

float Linear(double srgb) { return SrgbToLinear(static_cast<uint8_t>(std::lround(std::clamp(srgb, 0.0, 1.0) * 255))); }

constexpr CityType kTypes[] = {
    {"Building", "construction/building", {0.52f, 0.46f, 0.38f}},
    {"BuildingPart", "construction/building", {0.52f, 0.46f, 0.38f}},
    {"BuildingInstallation", "construction/building", {0.42f, 0.41f, 0.40f}},
    {"BuildingConstructiveElement", "construction/building", {0.42f, 0.41f, 0.40f}},
    {"BuildingFurniture", "furniture", {0.35f, 0.27f, 0.18f}},
    {"BuildingStorey", "construction/building", {0.52f, 0.46f, 0.38f}},
    {"BuildingRoom", "construction/building", {0.6f, 0.58f, 0.55f}},
    {"BuildingUnit", "construction/building", {0.52f, 0.46f, 0.38f}},
    {"Bridge", "construction/bridge", {0.40f, 0.39f, 0.37f}},
    {"BridgePart", "construction/bridge", {0.40f, 0.39f, 0.37f}},
    {"BridgeInstallation", "construction/bridge", {0.35f, 0.35f, 0.35f}},
    {"BridgeConstructionElement", "construction/bridge", {0.40f, 0.39f, 0.37f}},
    {"BridgeConstructiveElement", "construction/bridge", {0.40f, 0.39f, 0.37f}},
    {"CityFurniture", "furniture/misc", {0.25f, 0.26f, 0.27f}},
    {"CityObjectGroup", "object", {0.4f, 0.4f, 0.4f}},
    {"GenericCityObject", "object", {0.4f, 0.4f, 0.4f}},
    {"LandUse", "ground/terrain/landscape", {0.16f, 0.17f, 0.08f}},
    {"OtherConstruction", "construction", {0.42f, 0.40f, 0.37f}},
    {"PlantCover", "vegetation/shrub/bush", {0.08f, 0.13f, 0.04f}},
    {"Railway", "ground/gravel", {0.16f, 0.14f, 0.12f}},
    {"Road", "ground/road", {0.11f, 0.11f, 0.115f}},
    {"SolitaryVegetationObject", "vegetation/tree/broadleaf/generic", {0.07f, 0.12f, 0.035f}},
    {"TINRelief", "nature/terrain", {0.15f, 0.16f, 0.08f}},
    {"TransportSquare", "ground/pavement/modular", {0.28f, 0.27f, 0.25f}},
    {"Tunnel", "construction/tunnel", {0.38f, 0.37f, 0.35f}},
    {"TunnelPart", "construction/tunnel", {0.38f, 0.37f, 0.35f}},
    {"TunnelInstallation", "construction/tunnel", {0.35f, 0.35f, 0.35f}},
    {"TunnelConstructiveElement", "construction/tunnel", {0.35f, 0.35f, 0.35f}},
    {"WaterBody", "water/lake", {0.02f, 0.035f, 0.035f}},
    {"Waterway", "water/river", {0.02f, 0.035f, 0.035f}},
};

constexpr CitySurface kSurfaces[] = {
    {"RoofSurface", "roof", "construction/building/roof", {0.26f, 0.12f, 0.08f}},
    {"Window", "window", "construction/window", {0.035f, 0.045f, 0.05f}},
    {"Door", "door", "construction/door", {0.12f, 0.07f, 0.04f}},
    {"TrafficArea", "traffic", "", {0.11f, 0.11f, 0.115f}},
    {"AuxiliaryTrafficArea", "verge", "", {0.20f, 0.19f, 0.16f}},
};

}  // namespace

const CityType& CityTypeOf(std::string_view type) {
  for (const CityType& row : kTypes)
    if (row.type == type) return row;
  static constexpr CityType kOther{"", "object", {0.4f, 0.4f, 0.4f}};
  return kOther;
}

const CitySurface* CitySurfaceOf(std::string_view type) {
  for (const CitySurface& row : kSurfaces)
    if (row.type == type) return &row;
  return nullptr;
}

void CityPalette::Read(JsonRef appearance) {
  theme_ = appearance.TextOr("default-theme-material", "");
  const auto list = appearance.Find("materials");
  if (!list) return;
  if (list->size() > kMostMaterials) list->Fail("more than " + std::to_string(kMostMaterials) + " materials");
  for (size_t i = 0; i < list->size(); ++i) {
    const JsonRef source = (*list)[i];
    Material material;
    material.name = CleanName(source.TextOr("name", "material")) + " " + std::to_string(i);
    const std::vector<double> c = source.NumbersOr("diffuseColor", {0.8, 0.8, 0.8});
    material.base_color = {Linear(c[0]), Linear(c[1]), Linear(c[2])};
    material.roughness = 0.85f;
    if (source.NumberOr("transparency", 0) > 0.5) {
      material.kind = SurfaceKind::kGlass;
      material.roughness = 0.05f;
    }
    colours_.push_back(std::move(material));
  }
}

CityPalette::Choice CityPalette::ChoiceOf(const JsonRef& geometry) const {
  const auto material = geometry.Find("material");
  if (!material || colours_.empty()) return {};
  const std::vector<std::string> themes = material->Keys();
  if (themes.empty()) return {};
  const bool named = std::find(themes.begin(), themes.end(), theme_) != themes.end();
  const JsonRef theme = material->At(named ? theme_ : themes[0]);
  return {theme.Find("value"), theme.Find("values")};
}

MaterialId CityPalette::Get(const std::string& type, const CitySurface* surface, const std::optional<JsonRef>& colour) {
  const CityType& row = CityTypeOf(type);
  std::string name = surface ? std::string(surface->type) : row.type.empty() ? "other" : std::string(row.type);
  Material material;
  material.base_color = surface ? surface->colour : row.colour;
  material.roughness = 0.85f;
  material.macro_variation = 0.08f;
  if (row.type == "WaterBody" || row.type == "Waterway") {
    material.kind = SurfaceKind::kWater;
    material.roughness = 0.08f;
  }
  if (surface && surface->type == "Window") {
    material.kind = SurfaceKind::kGlass;
    material.roughness = 0.05f;
  }
  if (colour && !colour->IsNull() && !colours_.empty()) {
    const uint64_t index = colour->Uint();
    if (index >= colours_.size()) colour->Fail("there are " + std::to_string(colours_.size()) + " materials");
    // The kind of surface stays in the name, which parts are told by, and water stays water.
    name += " " + colours_[index].name;
    if (material.kind == SurfaceKind{}) material = colours_[index];
    material.base_color = colours_[index].base_color;
  }
  const auto [it, fresh] = ids_.try_emplace(name, static_cast<MaterialId>(materials_.size()));
  if (!fresh) return it->second;
  material.name = name;
  materials_.push_back(std::move(material));
  return it->second;
}

}  // namespace airsim360::internal

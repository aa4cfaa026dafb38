#include "airsim360/worlds/furnishings/furnishings.h"

#include <algorithm>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/props/families.h"

namespace airsim360 {
namespace internal {
namespace {

FurnishingRows AllRows() {
  FurnishingRows all;
  for (auto family : {BedRows,       StorageRows, SofaRows,       TableRows,     MediaRows,    KitchenRows, BathroomRows, TextileRows,
                      WallPieceRows, PlantRows,   SmallThingRows, HomeLampRows,  HallLampRows, OfficeRows,  DeviceRows,   RackRows,
                      WarehouseRows, ShopRows,    MallRows,       EscalatorRows, ServiceRows,  CarParkRows}) {
    FurnishingRows rows = family();
    std::move(rows.begin(), rows.end(), std::back_inserter(all));
  }
  std::sort(all.begin(), all.end(), [](const FurnishingRow& a, const FurnishingRow& b) { return a.kind.name < b.kind.name; });
  return all;
}

}  // namespace

std::vector<PropKind> FurnishingKinds() {
  std::vector<PropKind> kinds;
  for (FurnishingRow& row : AllRows()) kinds.push_back(std::move(row.kind));
  return kinds;
}

}  // namespace internal

std::span<const Furnishing> Furnishings() {
  static const std::vector<Furnishing> all = [] {
    std::vector<Furnishing> rows;
    for (const internal::FurnishingRow& row : internal::AllRows()) rows.push_back({row.kind.name, row.mount, row.sill});
    return rows;
  }();
  return all;
}

const Furnishing& FindFurnishing(std::string_view kind) {
  const auto all = Furnishings();
  const auto it = std::lower_bound(all.begin(), all.end(), kind, [](const Furnishing& f, std::string_view n) { return f.kind < n; });
  if (it != all.end() && it->kind == kind) return *it;
  std::vector<std::string> names;
  for (const Furnishing& f : all) names.emplace_back(f.kind);
  throw InputError(UnknownChoiceMessage("furnishing", kind, names));
}

Box3f FurnishingBox(std::string_view kind, uint32_t variant) {
  return MakeProp(FindPropKind(FindFurnishing(kind).kind), variant, 0, nullptr).mesh.Bounds();
}

}  // namespace airsim360

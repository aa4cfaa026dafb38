#include "airsim360/opening/world_city.h"

#include <numbers>

#include "airsim360/assets/importing/import.h"
#include "airsim360/base/error.h"
#include "airsim360/worlds/building/massing.h"

namespace airsim360 {
namespace {

void VisitCity(ConfigVisitor& v, CityOptions& city) {
  v.Field("style", "the time that it shows", city.style, kCityStyles);
  v.Field("height", "of towers, 1 = as built in", city.height, 0.3, 2.5);
  v.Field("traffic", "cars in lanes and bays", city.traffic, 0, 1.6);
  v.Field("trees", "street trees", city.trees, 0, 1.6);
  v.Field("furniture", "things on the pavements", city.furniture, 0, 2);
  v.Field("billboards", "more than those that instructions name", city.billboards);
  v.Field("styles", "facade styles of the lots; empty = all", city.styles);
}

void VisitProp(ConfigVisitor& v, PropFile& prop) {
  v.Field("model", "a .glb, .gltf or .obj file beside this one", prop.model);
  v.Field("label", "category path, of the tree or your own", prop.label);
  v.Field("name", "of the entity", prop.name);
  v.Field("x", "metres east", prop.x, -20000, 20000);
  v.Field("y", "metres north", prop.y, -20000, 20000);
  v.Field("z", "metres up: 0 is the pavement", prop.z, -1000, 5000);
  v.Field("yaw_deg", "counter-clockwise from above", prop.yaw_deg, -360, 360);
  v.Field("scale", "of the model", prop.scale, 0.001, 1000);
}

}  // namespace

bool WorldAdditions::no_city() const {
  const auto text = [](CityOptions city) { return DescribeConfig([&](ConfigVisitor& v) { VisitCity(v, city); }); };
  return text(city) == text({});
}

bool WorldAdditions::no_town() const {
  const auto text = [](TownSpec town) { return DescribeConfig([&](ConfigVisitor& v) { town.Visit(v); }); };
  return text(town) == text({});
}

bool WorldAdditions::no_building() const {
  const auto text = [](BuildingSpec building) { return DescribeConfig([&](ConfigVisitor& v) { building.Visit(v); }); };
  return text(building) == text({});
}

void WorldAdditions::Visit(ConfigVisitor& v) {
  v.Group("city", "measures of new_york_city and its variant", [&](ConfigVisitor& group) { VisitCity(group, city); });
  v.Group("town", "measures of the world town", [&](ConfigVisitor& group) { town.Visit(group); });
  v.Group("building", "measures of the world building", [&](ConfigVisitor& group) { building.Visit(group); });
  v.List("props", "models of your own", props, [](ConfigVisitor& entry, PropFile& prop) { VisitProp(entry, prop); });
}

void WorldAdditions::Resolve(const std::filesystem::path& file) {
  try {
    StylesOf(city.styles);
    town.Check("town: ");
    building.Check("building: ");
    for (PropFile& prop : props) {
      if (prop.model.empty()) throw InputError("props: an entry without 'model'");
      SemanticTree().Add(prop.label);
      if (prop.name.empty()) prop.name = std::filesystem::path(prop.model).stem().string();
      prop.model = (file.parent_path() / prop.model).string();
      if (!std::filesystem::exists(prop.model)) throw InputError("props: no file '" + prop.model + "'");
    }
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

void WorldAdditions::AddTo(CacheKey& key) const {
  WorldAdditions copy = *this;
  key.Add(DescribeConfig([&](ConfigVisitor& v) { VisitCity(v, copy.city); }));
  key.Add(DescribeConfig([&](ConfigVisitor& v) { copy.town.Visit(v); }));
  key.Add(DescribeConfig([&](ConfigVisitor& v) { copy.building.Visit(v); }));
  for (PropFile& prop : copy.props) {
    key.Add(DescribeConfig([&](ConfigVisitor& v) { VisitProp(v, prop); }));
    key.AddFile(prop.model);
  }
}

std::vector<PlacedModel> WorldAdditions::LoadModels() const {
  std::vector<PlacedModel> models;
  for (const PropFile& prop : props) {
    models.push_back({prop.name,
                      prop.label,
                      ImportModel(prop.model),
                      {static_cast<float>(prop.x), static_cast<float>(prop.y), static_cast<float>(prop.z)},
                      static_cast<float>(prop.yaw_deg * std::numbers::pi / 180),
                      static_cast<float>(prop.scale)});
  }
  return models;
}

}  // namespace airsim360

#include "airsim360/mission/things.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/math/place_text.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

using behaviour::Value;

constexpr double kFarthest = 100'000;  // metres of a place on the Earth from the origin
constexpr size_t kMostLooks = 64;      // candidates that are looked at, the nearest first
constexpr double kPersonHeight = 1.7;

std::string Quoted(const std::string& text) { return "'" + text.substr(0, 100) + "'"; }

std::vector<std::string> Parts(const std::string& text) {
  const char apart = text.find(';') != std::string::npos ? ';' : ',';
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(apart, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<double> NumberOf(std::string text) {
  while (text.starts_with(' ')) text.erase(text.begin());
  while (text.ends_with(' ')) text.pop_back();
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

Value PointOf(Vec3d p, bool has_height) {
  Value value;
  value.kind = Value::Kind::kPoint;
  value.point = CheckedPlace("the place", p);
  value.has_height = has_height;
  return value;
}

// Of two or three parts, the first two of which are a latitude and a longitude.
Value EarthPoint(const GeoPoint& place, double z, bool has_height, const std::string& text, const MissionWorld* world) {
  if (!world) return {};
  if (!world->earth) throw InputError(Quoted(text) + ": the world has no place on the Earth (maps have); give x;y;z in metres");
  Vec3d p = GeoFrame({world->earth->latitude_deg, world->earth->longitude_deg, 0}).ToWorld(place);
  if (!(std::hypot(p.x, p.y) <= kFarthest) || p.z < -kFarthest)
    throw InputError(Quoted(text) + " lies more than 100 km from the middle of the map");
  p.z = z;
  return PointOf(p, has_height);
}

std::optional<Value> ParsePlace(const std::string& text, const MissionWorld* world) {
  const std::vector<std::string> parts = Parts(text);
  if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
  const bool has_height = parts.size() == 3;
  const std::optional<double> third = NumberOf(has_height ? parts[2] : "0");
  if (const auto place = ParseLatitudeLongitude(parts[0], parts[1], Quoted(text))) {
    if (!third) throw InputError(Quoted(text) + ": the height '" + parts[2] + "' is not a number of metres");
    return EarthPoint(*place, *third, has_height, text, world);
  }
  const auto x = NumberOf(parts[0]), y = NumberOf(parts[1]);
  if (!x || !y || !third) return std::nullopt;
  return PointOf({*x, *y, *third}, has_height);
}

Value NumberedThing(Value::Kind kind, size_t index) {
  Value value;
  value.kind = kind;
  value.index = static_cast<uint32_t>(index);
  return value;
}

std::optional<Value> ParseName(const std::string& text, const SimModel& model, std::vector<std::string>* names) {
  const auto is_it = [&](const std::string& name) {
    if (names) names->push_back(name);
    return name == text;
  };
  if (model.people)
    for (size_t i = 0; i < model.people->cast.size(); ++i)
      if (is_it(model.people->cast[i].name) | is_it(model.people->crowd->people[i].name)) return NumberedThing(Value::Kind::kPerson, i);
  if (model.traffic)
    for (size_t i = 0; i < model.traffic->bodies.size(); ++i)
      if (is_it(model.traffic->bodies[i].name)) return NumberedThing(Value::Kind::kVehicle, i);
  for (const Entity& entity : model.tracer->scene().entities)
    if (!entity.bounds.empty() && is_it(entity.name)) return NumberedThing(Value::Kind::kEntity, entity.id);
  return std::nullopt;
}

std::optional<ThingNow> PersonNow(const SimModel& model, const SimState& state, size_t i) {
  if (!model.people || !state.people || i >= state.people->crowd.people.size()) return std::nullopt;
  const PersonState& person = state.people->crowd.people[i];
  if (!person.visible) return std::nullopt;
  const double later = 1e-9 * static_cast<double>(state.t_ns + model.people->epoch_ns - state.people->crowd.t_ns);
  return ThingNow{person.p_WP + person.v_WP * later + Vec3d{0, 0, kPersonHeight / 2}, {0.3, 0.3, kPersonHeight / 2}, person.v_WP};
}

std::optional<ThingNow> VehicleNow(const SimModel& model, const SimState& state, size_t i) {
  if (!model.traffic || !state.traffic || i >= state.traffic->vehicles.size()) return std::nullopt;
  const TrafficModel& traffic = model.traffic->model;
  const VehicleShape& shape = traffic.vehicles[i].shape;
  const RigidTransform X_WB = PoseOf(traffic, *state.traffic, i, state.t_ns + model.traffic->epoch_ns);
  const double reach = 0.5 * shape.length;
  return ThingNow{X_WB.p + Vec3d{0, 0, shape.height / 2}, {reach, reach, shape.height / 2}, VelocityOf(traffic, *state.traffic, i)};
}

// Whether the parts of `what` stand in a row in a path.
bool HasParts(const std::string& path, const std::string& what) {
  return !what.empty() && ("/" + path + "/").find("/" + what + "/") != std::string::npos;
}

// Those that are where the simulation has them, and not where the scene was built with them.
std::set<EntityId> MovingEntities(const SimModel& model) {
  std::set<EntityId> moving;
  if (model.people)
    for (const PersonRef& person : model.people->refs) moving.insert(person.entity);
  if (model.traffic)
    for (const TrafficBody& body : model.traffic->bodies) moving.insert(body.entity);
  for (const auto& drone : model.drones) moving.insert(drone->setup().entity);
  return moving;
}

}  // namespace

Value ParseThing(const std::string& text, const MissionWorld* world) {
  if (text.empty()) throw InputError("expected a place or a name, found ''");
  if (const auto place = ParsePlace(text, world)) return *place;
  if (!world) return {};
  if (const auto named = ParseName(text, *world->model, nullptr)) return *named;
  std::vector<std::string> names;
  ParseName(text, *world->model, &names);
  throw InputError("no thing, person or vehicle " + Quoted(text) + " in the world" + DidYouMean(text, names));
}

std::string NameOfThing(const SimModel& model, const Value& value) {
  if (value.kind == Value::Kind::kPerson && model.people && value.index < model.people->cast.size())
    return model.people->cast[value.index].name;
  if (value.kind == Value::Kind::kVehicle && model.traffic && value.index < model.traffic->bodies.size())
    return model.traffic->bodies[value.index].name;
  if (value.kind == Value::Kind::kEntity) return model.tracer->scene().entity(value.index).name;
  return {};
}

std::optional<ThingNow> FindThing(const SimModel& model, const SimState& state, const Value& value) {
  switch (value.kind) {
    case Value::Kind::kPoint:
      return ThingNow{value.point, {}, {}, value.has_height, true};
    case Value::Kind::kPerson:
      return PersonNow(model, state, value.index);
    case Value::Kind::kVehicle:
      return VehicleNow(model, state, value.index);
    case Value::Kind::kEntity: {
      const Box3f& box = model.tracer->scene().entity(value.index).bounds;
      return ThingNow{VecCast<double>(box.center()), VecCast<double>(box.max - box.min) * 0.5, {}};
    }
    default:
      return std::nullopt;
  }
}

double DistanceTo(const ThingNow& thing, Vec3d p_W) {
  const Vec3d low = thing.p_W - thing.half_size, high = thing.p_W + thing.half_size;
  return Norm(p_W - Min(Max(p_W, low), high));
}

bool IsInSight(const RayTracer& tracer, const ThingNow& thing, Vec3d p_W) {
  constexpr double kBefore = 0.02;  // metres: what the surface itself does not hide
  const Vec3d low = thing.p_W - thing.half_size, high = thing.p_W + thing.half_size, nearest = Min(Max(p_W, low), high);
  const Vec3f eye = VecCast<float>(p_W);
  // The nearest point of the box, and the middles of the sides that face the eye.
  std::vector<Vec3d> looks = {nearest};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d side = thing.p_W;
    if (p_W[axis] < low[axis])
      side[axis] = low[axis];
    else if (p_W[axis] > high[axis])
      side[axis] = high[axis];
    else
      continue;
    looks.push_back(side);
  }
  return std::ranges::any_of(looks, [&](Vec3d look) {
    const double distance = Norm(look - p_W);
    if (distance < 2 * kBefore) return true;
    return !tracer.Occluded(eye, VecCast<float>(look + (p_W - look) * (kBefore / distance)));
  });
}

std::optional<Value> FindInSight(const SimModel& model, const SimState& state, const std::string& what, Vec3d p_W, double distance) {
  struct Candidate {
    double distance;
    Value value;
  };
  std::vector<Candidate> candidates;
  const auto consider = [&](const Value& value) {
    const auto thing = FindThing(model, state, value);
    if (!thing) return;
    const double d = DistanceTo(*thing, p_W);
    if (d <= distance) candidates.push_back({d, value});
  };
  const Scene& scene = model.tracer->scene();
  if (const auto named = ParseName(what, model, nullptr)) consider(*named);
  const bool people = HasParts("human/person", what);
  for (size_t i = 0; people && model.people && i < model.people->cast.size(); ++i) consider(NumberedThing(Value::Kind::kPerson, i));
  for (size_t i = 0; model.traffic && i < model.traffic->bodies.size(); ++i)
    if (HasParts(model.traffic->bodies[i].kind, what)) consider(NumberedThing(Value::Kind::kVehicle, i));
  std::set<CategoryId> wanted;
  for (const auto& [id, category] : scene.tree.categories())
    if (HasParts(category.path, what)) wanted.insert(id);
  const std::set<EntityId> moving = MovingEntities(model);
  for (const Entity& entity : scene.entities)
    if (!wanted.empty() && wanted.contains(entity.category) && !entity.bounds.empty() && !moving.contains(entity.id))
      consider(NumberedThing(Value::Kind::kEntity, entity.id));
  std::ranges::stable_sort(candidates, {}, &Candidate::distance);
  for (size_t i = 0; i < std::min(candidates.size(), kMostLooks); ++i)
    if (IsInSight(*model.tracer, *FindThing(model, state, candidates[i].value), p_W)) return candidates[i].value;
  return std::nullopt;
}

}  // namespace airsim360

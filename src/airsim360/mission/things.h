// What a mission can name: places, and things that stand or move in a world.
#pragma once

#include <optional>
#include <string>

#include "airsim360/behaviour/tree.h"
#include "airsim360/math/geodesy.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

/// A world as missions see it.
struct MissionWorld {
  std::shared_ptr<const SimModel> model;
  std::optional<GeoPoint> earth = {};  ///< where W's origin lies, if anywhere
};

/// "x;y", "x;y;z" (also with commas), "60.17N;24.94E[;z]", or the name of a person, a driving vehicle or an entity. InputError
/// naming the nearest. `world` null: names and places on the Earth are taken as they are (kind kNone).
behaviour::Value ParseThing(const std::string& text, const MissionWorld* world);

/// A thing at one instant: the middle of its upright box, half its size, how it moves.
struct ThingNow {
  Vec3d p_W, half_size, v_W;
  bool has_height = true;  ///< false: a point over the ground without one
  bool is_point = false;
};
/// nullopt for somebody who is not in the world now, and for values that name no thing.
std::optional<ThingNow> FindThing(const SimModel& model, const SimState& state, const behaviour::Value& value);

/// What a value is called that names a person, an entity or a vehicle; "" for others.
std::string NameOfThing(const SimModel& model, const behaviour::Value& value);

/// Metres from a point to the box.
double DistanceTo(const ThingNow& thing, Vec3d p_W);
/// Whether nothing that stands is between the point and some part of the box that faces it.
bool IsInSight(const RayTracer& tracer, const ThingNow& thing, Vec3d p_W);

/// The nearest thing in sight within `distance` metres whose name is `what`, or whose category path has these parts in a row
/// ("tree", "vehicle/car"). nullopt: none.
std::optional<behaviour::Value> FindInSight(const SimModel& model, const SimState& state, const std::string& what, Vec3d p_W,
                                            double distance);

}  // namespace airsim360

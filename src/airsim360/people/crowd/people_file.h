// people.yaml as it stands in the file, with the lines that messages name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

inline constexpr double kMostInParties = 0.9;  ///< of the people of an area: sizes of a Poisson law would grow without bound

/// A value and where it stands ("people.yaml:12").
template <class T>
struct Placed {
  T value{};
  std::string where;
};

struct AreaEntry {
  std::string where;
  Placed<std::string> name;
  std::vector<Vec2d> polygon;
  std::string polygon_where;
  std::optional<double> count, density;
  std::string count_where;
  std::optional<double> parties;  ///< share of the people who are in one
  std::vector<std::pair<Placed<std::string>, double>> mix;
};

struct StateEntry {
  Placed<std::string> name, lower, upper, next;
  std::optional<double> speed, min_s, max_s, cooldown_s;
  std::optional<bool> stop;
};

struct TransitionEntry {
  std::string where;
  Placed<std::string> from, to, message;
  double chance = 1, rate_per_min = 0;
};

struct PersonEntry {
  std::string where;
  Placed<std::string> name, area, behaviour, sex;
  std::optional<Vec3d> at;
  bool has_height = false;
  std::string at_where;
  std::optional<double> age, stature, speed;
};

struct PeopleFile {
  std::string name;  ///< of the file, for messages
  std::optional<uint64_t> seed;
  std::vector<Placed<std::string>> trees;  ///< files
  std::vector<AreaEntry> areas;
  std::vector<StateEntry> states;
  std::vector<Placed<std::string>> messages;
  std::vector<TransitionEntry> transitions;
  std::vector<PersonEntry> people;
};

/// InputError "file:line: …" for a syntax error, an unknown or repeated key (naming the nearest), a value of the
/// wrong kind or range. At most 1 MiB, 200 areas, 1000 corners an area, 20000 single people.
PeopleFile ParsePeople(std::string_view text, std::string_view name);

}  // namespace airsim360::internal

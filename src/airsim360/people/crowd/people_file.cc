#include "airsim360/people/crowd/people_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMaxSize = size_t{1} << 20;

class Reader {
 public:
  explicit Reader(std::string_view name) : name_(name) {}

  std::string Where(const YAML::Node& node) const {
    return node.Mark().is_null() ? name_ : name_ + ":" + std::to_string(node.Mark().line + 1);
  }
  [[noreturn]] void Fail(const YAML::Node& node, const std::string& what) const { throw InputError(Where(node) + ": " + what); }
  static std::string Shown(const YAML::Node& node) {
    return node.IsScalar() ? "'" + node.Scalar().substr(0, 100) + "'" : node.IsNull() ? "nothing" : "a list or mapping";
  }

  using Key = std::pair<const char*, std::function<void(const YAML::Node&)>>;
  /// Every key of a mapping goes to its reader; InputError for others and for repeats.
  void Map(const YAML::Node& node, const std::string& what, const std::vector<Key>& keys) const {
    if (!node.IsMap()) Fail(node, what + ": expected 'key: value' lines, found " + Shown(node));
    std::vector<std::string> valid, seen;
    for (const Key& key : keys) valid.push_back(key.first);
    for (const auto& entry : node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      const auto found = std::find(valid.begin(), valid.end(), key);
      if (found == valid.end()) Fail(entry.first, what + ": " + UnknownChoiceMessage("key", key, valid));
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) Fail(entry.first, what + ": key '" + key + "' is given twice");
      seen.push_back(key);
      keys[static_cast<size_t>(found - valid.begin())].second(entry.second);
    }
  }
  void List(const YAML::Node& node, const std::string& what, size_t most, const std::function<void(const YAML::Node&)>& read) const {
    if (!node.IsSequence()) Fail(node, what + ": expected a list, found " + Shown(node));
    if (node.size() > most)
      Fail(node, what + ": " + std::to_string(node.size()) + " entries, at most " + std::to_string(most) + " are allowed");
    for (const auto& entry : node) read(entry);
  }

  double Number(const YAML::Node& node, const std::string& what, double low, double high) const {
    double value = NAN;
    try {
      if (node.IsScalar()) value = node.as<double>();
    } catch (const YAML::Exception&) {
    }
    char range[100];
    std::snprintf(range, sizeof(range), "a number from %g to %g", low, high);
    if (!(value >= low && value <= high)) Fail(node, what + ": expected " + range + ", found " + Shown(node));
    return value;
  }
  double Whole(const YAML::Node& node, const std::string& what, double low, double high) const {
    const double value = Number(node, what, low, high);
    if (value != std::floor(value)) Fail(node, what + ": expected a whole number, found " + Shown(node));
    return value;
  }
  bool Flag(const YAML::Node& node, const std::string& what) const {
    try {
      if (node.IsScalar()) return node.as<bool>();
    } catch (const YAML::Exception&) {
    }
    Fail(node, what + ": expected true or false, found " + Shown(node));
  }
  Placed<std::string> Word(const YAML::Node& node, const std::string& what) const {
    if (!node.IsScalar() || node.Scalar().empty() || node.Scalar().size() > 200)
      Fail(node, what + ": expected a name, found " + Shown(node));
    return {node.Scalar(), Where(node)};
  }
  /// [x, y] or [x, y, z]; the number of coordinates.
  int Point(const YAML::Node& node, const std::string& what, int most, Vec3d& p) const {
    if (!node.IsSequence() || node.size() < 2 || static_cast<int>(node.size()) > most)
      Fail(node, what + ": expected [x, y" + (most > 2 ? "] or [x, y, z]" : "]") + ", found " + Shown(node));
    for (size_t k = 0; k < node.size(); ++k) p[static_cast<int>(k)] = Number(node[k], what, -1e6, 1e6);
    return static_cast<int>(node.size());
  }

 private:
  std::string name_;
};

AreaEntry ReadArea(const Reader& r, const YAML::Node& node) {
  AreaEntry area;
  area.where = r.Where(node);
  r.Map(node, "area",
        {{"name", [&](const YAML::Node& v) { area.name = r.Word(v, "name"); }},
         {"polygon",
          [&](const YAML::Node& v) {
            area.polygon_where = r.Where(v);
            r.List(v, "polygon", 1000, [&](const YAML::Node& corner) {
              Vec3d p;
              r.Point(corner, "polygon", 2, p);
              area.polygon.push_back({p.x, p.y});
            });
            if (area.polygon.size() < 3) r.Fail(v, "polygon: needs at least three corners");
          }},
         {"count",
          [&](const YAML::Node& v) {
            area.count = r.Whole(v, "count", 0, 100000);
            area.count_where = r.Where(v);
          }},
         {"density",
          [&](const YAML::Node& v) {
            area.density = r.Number(v, "density", 0, 5);
            area.count_where = r.Where(v);
          }},
         {"parties", [&](const YAML::Node& v) { area.parties = r.Number(v, "parties", 0, kMostInParties); }},
         {"mix", [&](const YAML::Node& v) {
            if (!v.IsMap()) r.Fail(v, "mix: expected 'behaviour: weight' lines, found " + Reader::Shown(v));
            for (const auto& entry : v) area.mix.emplace_back(r.Word(entry.first, "mix"), r.Number(entry.second, "mix", 0, 1e6));
          }}});
  if (area.count && area.density) r.Fail(node, "area: count and density exclude each other");
  return area;
}

StateEntry ReadState(const Reader& r, const YAML::Node& node) {
  StateEntry state;
  const auto number = [&](const char* what, std::optional<double>& value, double high) {
    return [&r, what, &value, high](const YAML::Node& v) { value = r.Number(v, what, 0, high); };
  };
  r.Map(node, "state",
        {{"name", [&](const YAML::Node& v) { state.name = r.Word(v, "name"); }},
         {"lower", [&](const YAML::Node& v) { state.lower = r.Word(v, "lower"); }},
         {"upper", [&](const YAML::Node& v) { state.upper = r.Word(v, "upper"); }},
         {"next", [&](const YAML::Node& v) { state.next = r.Word(v, "next"); }},
         {"speed", number("speed", state.speed, 4)},
         {"min_s", number("min_s", state.min_s, 1e5)},
         {"max_s", number("max_s", state.max_s, 1e5)},
         {"cooldown_s", number("cooldown_s", state.cooldown_s, 1e5)},
         {"stop", [&](const YAML::Node& v) { state.stop = r.Flag(v, "stop"); }}});
  if (state.name.value.empty()) r.Fail(node, "state: needs a name");
  return state;
}

TransitionEntry ReadTransition(const Reader& r, const YAML::Node& node) {
  TransitionEntry transition;
  transition.where = r.Where(node);
  r.Map(node, "transition",
        {{"from", [&](const YAML::Node& v) { transition.from = r.Word(v, "from"); }},
         {"to", [&](const YAML::Node& v) { transition.to = r.Word(v, "to"); }},
         {"message", [&](const YAML::Node& v) { transition.message = r.Word(v, "message"); }},
         {"chance", [&](const YAML::Node& v) { transition.chance = r.Number(v, "chance", 0, 1); }},
         {"rate_per_min", [&](const YAML::Node& v) { transition.rate_per_min = r.Number(v, "rate_per_min", 0, 300); }}});
  if (transition.to.value.empty()) r.Fail(node, "transition: needs 'to'");
  if (transition.message.value.empty() == (transition.rate_per_min == 0))
    r.Fail(node, "transition: needs either 'message' or 'rate_per_min'");
  return transition;
}

PersonEntry ReadPerson(const Reader& r, const YAML::Node& node) {
  PersonEntry person;
  person.where = r.Where(node);
  r.Map(node, "person",
        {{"name", [&](const YAML::Node& v) { person.name = r.Word(v, "name"); }},
         {"area", [&](const YAML::Node& v) { person.area = r.Word(v, "area"); }},
         {"behaviour", [&](const YAML::Node& v) { person.behaviour = r.Word(v, "behaviour"); }},
         {"sex", [&](const YAML::Node& v) { person.sex = r.Word(v, "sex"); }},
         {"at",
          [&](const YAML::Node& v) {
            Vec3d p;
            person.has_height = r.Point(v, "at", 3, p) == 3;
            person.at = p;
            person.at_where = r.Where(v);
          }},
         {"age", [&](const YAML::Node& v) { person.age = r.Number(v, "age", 3, 100); }},
         {"stature", [&](const YAML::Node& v) { person.stature = r.Number(v, "stature", 0.8, 2.2); }},
         {"speed", [&](const YAML::Node& v) { person.speed = r.Number(v, "speed", 0.2, 4); }}});
  const std::string& sex = person.sex.value;
  if (!sex.empty() && sex != "female" && sex != "male")
    throw InputError(person.sex.where + ": " + UnknownChoiceMessage("sex", sex, std::vector<std::string>{"female", "male"}));
  return person;
}

}  // namespace

PeopleFile ParsePeople(std::string_view text, std::string_view name) {
  if (text.size() > kMaxSize) throw InputError(std::string(name) + ": larger than 1 MiB");
  PeopleFile file;
  file.name = name;
  const Reader r(name);
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    r.Map(root, "people file",
          {{"seed", [&](const YAML::Node& v) { file.seed = static_cast<uint64_t>(r.Number(v, "seed", 0, 9e15)); }},
           {"trees",
            [&](const YAML::Node& v) { r.List(v, "trees", 50, [&](const YAML::Node& e) { file.trees.push_back(r.Word(e, "trees")); }); }},
           {"areas",
            [&](const YAML::Node& v) { r.List(v, "areas", 200, [&](const YAML::Node& e) { file.areas.push_back(ReadArea(r, e)); }); }},
           {"states",
            [&](const YAML::Node& v) { r.List(v, "states", 48, [&](const YAML::Node& e) { file.states.push_back(ReadState(r, e)); }); }},
           {"messages",
            [&](const YAML::Node& v) {
              r.List(v, "messages", 48, [&](const YAML::Node& e) { file.messages.push_back(r.Word(e, "messages")); });
            }},
           {"transitions",
            [&](const YAML::Node& v) {
              r.List(v, "transitions", 500, [&](const YAML::Node& e) { file.transitions.push_back(ReadTransition(r, e)); });
            }},
           {"people", [&](const YAML::Node& v) {
              r.List(v, "people", 20000, [&](const YAML::Node& e) { file.people.push_back(ReadPerson(r, e)); });
            }}});
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : ":" + std::to_string(error.mark.line + 1);
    throw InputError(std::string(name) + line + ": " + error.msg);
  }
  return file;
}

}  // namespace airsim360::internal

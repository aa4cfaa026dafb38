#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/behaviour/plan.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/crowd/parties.h"
#include "airsim360/people/crowd/people_file.h"
#include "airsim360/people/crowd/placement.h"
#include "airsim360/people/crowd/traits.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr uint32_t kNoRoads = ~(1u << static_cast<int>(GroundKind::kRoad) | 1u << static_cast<int>(GroundKind::kCrossing) |
                                1u << static_cast<int>(GroundKind::kParking));
constexpr uint32_t kEverything = ~0u;
constexpr const char* kDefaultArea = "the default area";  // where its name stands

template <class T>
size_t IndexOf(const std::vector<T>& names, const T& name) {
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Index of a name in a list; InputError with the place and the nearest.
size_t Look(const std::vector<std::string>& names, const Placed<std::string>& word, const char* what) {
  const size_t i = IndexOf(names, word.value);
  if (i == names.size()) throw InputError(word.where + ": " + UnknownChoiceMessage(what, word.value, names));
  return i;
}

class Builder {
 public:
  Builder(const Scene& scene, std::shared_ptr<const NavMesh> mesh, const CrowdRequest& request)
      : scene_(scene), mesh_(std::move(mesh)), request_(request) {}

  std::shared_ptr<const CrowdModel> Run() {
    if (!request_.file.empty()) file_ = ParsePeople(ReadTextFile(request_.file, 1 << 20), request_.file.string());
    if (!mesh_) mesh_ = NavMesh::Build(scene_, {.region = RegionOfFile()});
    if (file_.areas.empty()) {
      AreaEntry all;
      all.name = {"around the spawn", kDefaultArea};
      all.where = all.count_where = request_.file.empty() ? "--people" : file_.name;
      if (request_.count) all.count = static_cast<double>(*request_.count);
      all.polygon = AroundSpawn(request_.count.value_or(0));
      file_.areas.push_back(all);
    }
    model_.seed = file_.seed.value_or(request_.seed);
    model_.navmesh = mesh_;
    for (size_t k = 0; k < file_.areas.size(); ++k)
      if (std::string& name = file_.areas[k].name.value; name.empty()) name = "area " + std::to_string(k + 1);
    SplitIntoRooms();
    States();
    Areas();
    Trees();
    plan_.places = FindPlaces(scene_, *mesh_, !ceilings_.empty());
    Placement placement(*mesh_, model_.seed);
    People(placement);
    if (!ceilings_.empty()) PlanBeginnings(model_, static_cast<PersonIndex>(file_.people.size()), in_rooms_, placement, plan_);
    model_.plan = std::make_shared<const CrowdPlan>(std::move(plan_));
    return std::make_shared<const CrowdModel>(std::move(model_));
  }

 private:
  /// The default region, widened to what the file's areas and people need of the world.
  Box3f RegionOfFile() const {
    constexpr float kAround = 24;  // metres: nobody stands at the very edge of the mesh
    Box3f region = NavMeshRegion(scene_, {});
    const auto add = [&](std::span<const Vec2d> points, const std::string& where) {
      Box3f box;
      for (const Vec2d p : points) box.Add(VecCast<float>(Vec3d{p.x, p.y, 0}));
      const Box3f& all = scene_.bounds;
      // Where there is no world nothing need be prepared; it is refused with its own words later.
      if (box.empty() || box.min.x > all.max.x || box.max.x < all.min.x || box.min.y > all.max.y || box.max.y < all.min.y) return;
      region.Add(box.min - Vec3f{kAround, kAround, 0});
      region.Add(box.max + Vec3f{kAround, kAround, 0});
      try {
        NavMeshRegion(scene_, {.region = region});
      } catch (const InputError& error) {
        throw InputError(where + ": " + error.what());
      }
    };
    for (const AreaEntry& entry : file_.areas) add(entry.polygon, entry.polygon_where);
    for (const PersonEntry& entry : file_.people)
      if (entry.at) add(std::array{Vec2d{entry.at->x, entry.at->y}}, entry.at_where);
    return region;
  }

  /// A circle around the world's spawn with about 80 m2 of ground a person, so that they meet; empty
  /// (= everywhere) where that is not to be had.
  std::vector<Vec2d> AroundSpawn(size_t count) const {
    const Vec3f spawn = scene_.spawn.value_or(mesh_->bounds().center());
    double radius = std::max(25.0, 1.3 * std::sqrt(static_cast<double>(count) * 80 / 3.14159));
    for (; radius < 250; radius *= 1.5) {
      std::vector<Vec2d> circle;
      for (int k = 0; k < 16; ++k)
        circle.push_back({spawn.x + radius * std::cos(k * 0.3926990817), spawn.y + radius * std::sin(k * 0.3926990817)});
      if (mesh_->AreaOf(circle, kNoRoads).square_metres >= std::max(300.0, 40.0 * static_cast<double>(count))) return circle;
    }
    return {};
  }

  bool IsUnderCeiling(const NavPoint& point) const {
    constexpr float kHighestCeiling = 30;  // metres: the glass over an atrium
    const Vec3f p = VecCast<float>(point.p_W);
    return point.valid() && std::ranges::any_of(ceilings_, [&](const Box3f& box) {
             return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y && box.max.z > p.z + 1.5f &&
                    box.min.z < p.z + kHighestCeiling;
           });
  }

  /// Whether an area lies under ceilings, by places in it.
  bool IsUnderCeilings(const NavArea& area) const {
    constexpr int kPlaces = 12;
    RngStream rng(1, "under ceilings", area.component);
    int under = 0;
    for (int k = 0; k < kPlaces && !ceilings_.empty(); ++k) under += IsUnderCeiling(mesh_->Pick(area, rng));
    return 2 * under > kPlaces;
  }

  /// The parts of the floors that hang together, the largest first; none where the world is not a building: a street with
  /// rooms behind some of its doors is lived in outdoors.
  std::vector<NavArea> RoomsOfBuilding() const {
    constexpr double kLeastRoom = 5;  // square metres
    if (ceilings_.empty()) return {};
    std::vector<NavArea> rooms = mesh_->AreasOf({}, kNoRoads, kLeastRoom);
    double all = 0, under = 0;
    for (const NavArea& area : rooms) all += area.square_metres;
    std::erase_if(rooms, [&](const NavArea& area) { return !IsUnderCeilings(area); });
    for (const NavArea& room : rooms) under += room.square_metres;
    const bool begins_inside = scene_.spawn && IsUnderCeiling(mesh_->Nearest(VecCast<double>(*scene_.spawn), 3));
    if (!begins_inside && 2 * under <= all) rooms.clear();
    return rooms;
  }

  /// An area without an outline means everywhere: in a building that is its rooms, and who lives behind a door that is shut
  /// stays there. Such an area becomes one for each part of the floors that hangs together; the first keeps the name.
  void SplitIntoRooms() {
    std::vector<AreaEntry> areas;
    std::set<std::string> names;
    for (const AreaEntry& entry : file_.areas) names.insert(entry.name.value);
    const std::vector<NavArea> rooms_of_all = RoomsOfBuilding();
    for (AreaEntry& entry : file_.areas) {
      const bool by_us = entry.name.where == kDefaultArea;
      std::vector<NavArea> rooms;
      if (entry.polygon.empty() || by_us) rooms = rooms_of_all;
      entries_.push_back({entry, std::max<size_t>(rooms.size(), 1)});
      if (rooms.empty()) {
        areas.push_back(std::move(entry));
        rooms_.emplace_back();
        continue;
      }
      size_t number = 1;
      double whole = 0, done = 0, given = 0;
      for (const NavArea& room : rooms) whole += room.square_metres;
      for (size_t k = 0; k < rooms.size(); ++k) {
        AreaEntry part = entry;
        part.polygon.clear();
        while (k > 0 && !names.insert(part.name.value = entry.name.value + " " + std::to_string(++number)).second) {
        }
        if (entry.count) {
          done += rooms[k].square_metres / whole;
          part.count = std::floor(done * *entry.count + 0.5) - given;
          given += *part.count;
        }
        areas.push_back(std::move(part));
        rooms_.push_back(std::move(rooms[k]));
      }
    }
    file_.areas = std::move(areas);
  }

  std::vector<std::string> StateNames() const {
    std::vector<std::string> names;
    for (const StateDef& state : plan_.states) names.push_back(state.name);
    return names;
  }
  static Behaviour BehaviourOf(const Placed<std::string>& word) {
    const std::vector<std::string> names(kBehaviourNames, kBehaviourNames + static_cast<size_t>(Behaviour::kCount));
    return static_cast<Behaviour>(Look(names, word, "behaviour"));
  }

  void States() {
    // The file's come on top of ours; one of the same name changes what it mentions.
    plan_.states = DefaultStates();
    plan_.messages = DefaultMessages();
    for (const Placed<std::string>& message : file_.messages)
      if (IndexOf(plan_.messages, message.value) == plan_.messages.size()) plan_.messages.push_back(message.value);
    for (const StateEntry& entry : file_.states) {
      if (IndexOf(StateNames(), entry.name.value) == plan_.states.size())
        plan_.states.push_back({.name = entry.name.value, .lower = {}, .upper = {}});
      if (plan_.states.size() > kMaxStates) throw InputError(entry.name.where + ": more than 48 states");
    }
    const std::vector<std::string> names = StateNames();
    for (const StateEntry& entry : file_.states) {
      StateDef& state = plan_.states[IndexOf(names, entry.name.value)];
      if (!entry.lower.value.empty()) state.lower = BehaviourOf(entry.lower);
      if (!entry.upper.value.empty()) state.upper = BehaviourOf(entry.upper);
      if (!entry.next.value.empty()) state.next = static_cast<uint8_t>(Look(names, entry.next, "state"));
      state.speed = entry.speed.value_or(state.speed);
      state.min_s = entry.min_s.value_or(state.min_s);
      state.max_s = entry.max_s.value_or(std::max(state.max_s, state.min_s));
      state.cooldown_s = entry.cooldown_s.value_or(state.cooldown_s);
      state.stop = entry.stop.value_or(state.stop);
      if (state.max_s < state.min_s) throw InputError(entry.name.where + ": max_s of state '" + state.name + "' is less than its min_s");
    }
    plan_.transitions = DefaultTransitions();
    if (!file_.transitions.empty()) plan_.transitions.clear();
    for (const TransitionEntry& entry : file_.transitions) {
      TransitionDef transition;
      if (!entry.from.value.empty() && entry.from.value != "any") transition.from = static_cast<uint8_t>(Look(names, entry.from, "state"));
      transition.to = static_cast<uint8_t>(Look(names, entry.to, "state"));
      if (!entry.message.value.empty()) transition.message = static_cast<uint8_t>(Look(plan_.messages, entry.message, "message"));
      transition.chance = entry.chance;
      transition.rate_per_min = entry.rate_per_min;
      plan_.transitions.push_back(transition);
    }
  }

  void Areas() {
    for (const AreaEntry& entry : file_.areas) {
      const std::string& name = entry.name.value;
      for (const CrowdArea& other : model_.areas)
        if (other.name == name) throw InputError(entry.where + ": two areas are called '" + name + "'");
      const size_t index = model_.areas.size();
      NavArea ground = index < rooms_.size() && !rooms_[index].polygons.empty() ? rooms_[index] : mesh_->AreaOf(entry.polygon, kNoRoads);
      if (ground.square_metres < 1) ground = mesh_->AreaOf(entry.polygon, kEverything);
      if (ground.square_metres < 1)
        throw InputError((entry.polygon_where.empty() ? entry.where : entry.polygon_where) + ": " + WhyEmpty(entry, name));
      in_rooms_.push_back((index < rooms_.size() && !rooms_[index].polygons.empty()) || IsUnderCeilings(ground));
      plan_.ground.push_back(std::move(ground));
      model_.areas.push_back({name, entry.polygon});
    }
  }

  std::string WhyEmpty(const AreaEntry& entry, const std::string& name) const {
    const Box3f box = mesh_->bounds();
    Vec2d low = entry.polygon[0], high = low;
    for (const Vec2d& p : entry.polygon) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    char text[300];
    if (high.x < box.min.x || low.x > box.max.x || high.y < box.min.y || low.y > box.max.y) {
      std::snprintf(text, sizeof(text), "area '%.80s' lies outside the world; people can walk within x %.1f … %.1f, y %.1f … %.1f",
                    name.c_str(), box.min.x, box.max.x, box.min.y, box.max.y);
      return text;
    }
    const NavPoint near = mesh_->Nearest({(low.x + high.x) / 2, (low.y + high.y) / 2, 0}, 60);
    std::snprintf(text, sizeof(text), "nobody can walk in area '%.80s'", name.c_str());
    std::string why = text;
    if (near.valid()) {
      std::snprintf(text, sizeof(text), "; the nearest walkable ground is at (%.1f, %.1f)", near.p_W.x, near.p_W.y);
      why += text;
    }
    return why;
  }

  void Trees() {
    std::vector<std::string> areas;
    for (const CrowdArea& area : model_.areas) areas.push_back(area.name);
    const ParsePort parse = PersonPorts({StateNames(), plan_.messages, std::move(areas)});
    ReadTrees(DefaultTreesXml(), "the default trees", PersonPalette(), parse, plan_.trees);
    const std::filesystem::path folder = request_.file.parent_path();
    for (const Placed<std::string>& tree : file_.trees) {
      const std::filesystem::path path = folder / tree.value;
      std::string text;
      try {
        text = ReadTextFile(path, 1 << 20);
      } catch (const InputError& error) {
        throw InputError(tree.where + ": " + error.what());
      }
      ReadTrees(text, path.string(), PersonPalette(), parse, plan_.trees);
    }
    for (const Tree& tree : plan_.trees.trees) tree_names_.push_back(tree.name);
  }

  void People(Placement& placement) {
    // How many in each area; a count asked for outside the file is shared out in proportion.
    std::vector<double> counts;
    for (size_t a = 0; a < file_.areas.size(); ++a) {
      const AreaEntry& entry = file_.areas[a];
      counts.push_back(entry.count ? *entry.count : entry.density ? std::floor(*entry.density * plan_.ground[a].square_metres + 0.5) : 0);
    }
    if (request_.count) {
      const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
      double done = 0, given = 0;
      for (double& count : counts) {
        done += sum > 0 ? count / sum : 1.0 / static_cast<double>(counts.size());
        count = std::floor(done * static_cast<double>(*request_.count) + 0.5) - given;
        given += count;
      }
    }

    // Single people first: they have their places.
    for (const PersonEntry& entry : file_.people) Single(entry, placement);
    uint32_t first = 0;
    for (const auto& [entry, parts] : entries_) {
      FillParts(entry, first, std::span(counts).subspan(first, parts), placement);
      first += static_cast<uint32_t>(parts);
    }
    const auto [trees, weights] = Mix(0);
    for (size_t k = 0; k < request_.reserve; ++k) Add(0, {}, trees, weights, true);
    plan_.party_of_person.resize(model_.people.size());
  }

  /// The people of one entry of the file in its rooms, from area `first` on. Who does not fit a room lives in another one.
  void FillParts(const AreaEntry& entry, uint32_t first, std::span<const double> counts, Placement& placement) {
    constexpr uint64_t kSecondRound = uint64_t{1} << 32;  // streams of places are numbered by area
    std::vector<std::vector<NavPoint>> starts(counts.size());
    size_t wanted = 0, left = 0;
    double square_metres = 0;
    for (uint32_t k = 0; k < counts.size(); ++k) {
      const auto count = static_cast<size_t>(counts[k]);
      wanted += count;
      square_metres += plan_.ground[first + k].square_metres;
      starts[k] = placement.Fill(plan_.ground[first + k], count + left, first + k);
      left += count - starts[k].size();
    }
    for (uint32_t k = 0; k + 1 < counts.size() && left > 0; ++k) {
      const std::vector<NavPoint> more = placement.Fill(plan_.ground[first + k], left, kSecondRound + first + k);
      starts[k].insert(starts[k].end(), more.begin(), more.end());
      left -= more.size();
    }
    if (left > 0)
      throw InputError((request_.count ? std::string("--people") : entry.count_where) + ": " + std::to_string(wanted) +
                       " people do not fit area '" + entry.name.value + "' (" + std::to_string(static_cast<int>(square_metres)) +
                       " m2); at most " + std::to_string(wanted - left) + " do");
    for (uint32_t k = 0; k < counts.size(); ++k) {
      const auto [trees, weights] = Mix(first + k);
      const auto first_person = static_cast<PersonIndex>(model_.people.size());
      for (const NavPoint& start : starts[k]) Add(first + k, start, trees, weights, false);
      FormParties(model_, plan_, placement, first_person, entry.parties.value_or(in_rooms_[first + k] ? 0 : kShareInParties));
    }
  }

  std::pair<std::vector<uint16_t>, std::vector<double>> Mix(uint32_t area) const {
    const AreaEntry& entry = file_.areas[area];
    std::pair<std::vector<uint16_t>, std::vector<double>> mix;
    for (const auto& [name, weight] : entry.mix) {
      mix.first.push_back(static_cast<uint16_t>(Look(tree_names_, name, "behaviour")));
      mix.second.push_back(weight);
    }
    if (std::accumulate(mix.second.begin(), mix.second.end(), 0.0) > 0) return mix;
    if (!entry.mix.empty()) throw InputError(entry.mix[0].first.where + ": all weights of the mix are 0");
    for (const auto& [name, weight] : DefaultMix(in_rooms_[area])) {
      mix.first.push_back(static_cast<uint16_t>(IndexOf(tree_names_, name)));
      mix.second.push_back(weight);
    }
    return mix;
  }

  void Add(uint32_t area, const NavPoint& start, const std::vector<uint16_t>& trees, const std::vector<double>& weights, bool reserve) {
    const auto i = static_cast<uint32_t>(model_.people.size());
    PersonTraits traits = DrawTraits(model_.seed, i);
    traits.area = area;
    traits.reserve = reserve;
    RngStream rng(model_.seed, "behaviour of person", i);
    double u = rng.Uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
    size_t k = 0;
    for (; k + 1 < weights.size() && u >= weights[k]; ++k) u -= weights[k];
    model_.people.push_back(std::move(traits));
    plan_.starts.push_back(start);
    plan_.tree_of_person.push_back(trees[k]);
  }

  void Single(const PersonEntry& entry, Placement& placement) {
    const auto i = static_cast<uint32_t>(model_.people.size());
    uint32_t area = 0;
    std::vector<std::string> areas;
    for (const CrowdArea& a : model_.areas) areas.push_back(a.name);
    if (!entry.area.value.empty()) area = static_cast<uint32_t>(Look(areas, entry.area, "area"));
    const auto [trees, weights] = Mix(area);

    NavPoint start;
    if (entry.at) {
      Vec3d p = *entry.at;
      if (!entry.has_height) p.z = mesh_->bounds().center().z;
      start = entry.has_height ? mesh_->Nearest(p, 0.5) : placement.AnyHeight(p, 0.5);
      if (!start.valid()) {
        const NavPoint near = placement.AnyHeight(p, 50);
        char text[100] = "";
        if (near.valid()) std::snprintf(text, sizeof(text), "; the nearest place is [%.2f, %.2f]", near.p_W.x, near.p_W.y);
        throw InputError(entry.at_where + ": nobody can stand there" + text);
      }
      if (!placement.Take(start)) throw InputError(entry.at_where + ": somebody else stands there already");
    } else {
      const std::vector<NavPoint> starts = placement.Fill(plan_.ground[area], 1, 1000000 + i);
      if (starts.empty()) throw InputError(entry.where + ": area '" + model_.areas[area].name + "' is full");
      start = starts[0];
    }
    Add(area, start, trees, weights, false);
    PersonTraits& traits = model_.people.back();
    if (entry.age || !entry.sex.value.empty())
      traits = DrawTraits(model_.seed, i, entry.age, entry.sex.value.empty() ? std::optional<bool>() : entry.sex.value == "female");
    traits.area = area;
    traits.stature = entry.stature.value_or(traits.stature);
    traits.free_speed = entry.speed.value_or(traits.free_speed);
    if (!entry.name.value.empty()) {
      for (const PersonTraits& other : model_.people)
        if (&other != &traits && other.name == entry.name.value)
          throw InputError(entry.name.where + ": two people are called '" + entry.name.value + "'");
      traits.name = entry.name.value;
    }
    if (!entry.behaviour.value.empty())
      plan_.tree_of_person.back() = static_cast<uint16_t>(Look(tree_names_, entry.behaviour, "behaviour"));
  }

  const Scene& scene_;
  std::shared_ptr<const NavMesh> mesh_;
  const CrowdRequest& request_;
  PeopleFile file_;
  CrowdModel model_;
  CrowdPlan plan_;
  std::vector<std::string> tree_names_;
  std::vector<NavArea> rooms_;                         // as the areas, where they are rooms
  std::vector<std::pair<AreaEntry, size_t>> entries_;  // of the file, and how many areas each became
  std::vector<char> in_rooms_;                         // of each area: it lies under ceilings
  const std::vector<Box3f> ceilings_ = Ceilings(scene_);
};

}  // namespace

std::shared_ptr<const CrowdModel> BuildCrowd(const Scene& scene, std::shared_ptr<const NavMesh> navmesh, const CrowdRequest& request) {
  return Builder(scene, std::move(navmesh), request).Run();
}

}  // namespace airsim360

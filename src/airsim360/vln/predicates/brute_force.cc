#include "airsim360/vln/predicates/brute_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

using Plan = std::complex<double>;  // seen from above
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-6;   // metres
constexpr double kFuzz = 2e-3;  // metres: vertices are floats, places rounded to millimetres

Plan OnPlan(Vec3d p) { return {p.x, p.y}; }
double Cross2(Plan a, Plan b) { return (std::conj(a) * b).imag(); }
double Dot2(Plan a, Plan b) { return (std::conj(a) * b).real(); }

double SquareToSegment(Plan p, Plan a, Plan b) {
  const double length = std::norm(b - a);
  const double t = length > 0 ? std::clamp(Dot2(b - a, p - a) / length, 0.0, 1.0) : 0;
  return std::norm(p - (a + t * (b - a)));
}

bool Under(Plan p, const std::array<Plan, 3>& t) {
  const double a = Cross2(t[1] - t[0], p - t[0]), b = Cross2(t[2] - t[1], p - t[1]), c = Cross2(t[0] - t[2], p - t[2]);
  if (std::abs(a + b + c) < 1e-12) return false;  // a wall seen from above: its edges count, the line through them does not
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// "lake 12" is "lake".
std::string WithoutNumber(const std::string& name) {
  const size_t end = name.find_last_not_of("0123456789");
  return end != std::string::npos && end + 1 < name.size() && end > 0 && name[end] == ' ' ? name.substr(0, end) : name;
}

bool IsCalled(const std::string& name, const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns) {
    const bool open = !pattern.empty() && pattern.back() == '*';
    if (open ? name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0 : name == pattern || WithoutNumber(name) == pattern)
      return true;
  }
  return false;
}

// `to`: real ahead, imaginary to the left; `rise`: metres higher.
bool IsInSector(const std::string& name, Plan to, double rise) {
  const double elevation = std::atan2(rise, std::abs(to)) / kDegree;
  if (name == "above") return elevation > kAboveElevation;
  if (name == "below") return elevation < -kAboveElevation;
  for (const Sector& sector : kSectors)
    if (name == sector.name) return std::abs(std::arg(to / std::polar(1.0, -sector.azimuth * kDegree))) / kDegree < sector.half_width;
  return false;
}

// Triangles of some parts of a scene, placed when they are looked at: those of all trees of a city would fill the memory.
class Triangles {
 public:
  struct Piece {
    const Instance* instance;
    const Mesh* mesh;
    uint32_t first, end;
  };
  class Iterator {
   public:
    using value_type = std::array<Vec3d, 3>;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const Piece* piece, const Piece* end) : piece_(piece), end_(end) { Enter(); }
    value_type operator*() const {
      const Vec3u corner = piece_->mesh->triangles[triangle_];
      const auto place = [&](uint32_t v) { return VecCast<double>(piece_->instance->X_WM * piece_->mesh->positions[v]); };
      return {place(corner.x), place(corner.y), place(corner.z)};
    }
    Iterator& operator++() {
      if (++triangle_ == piece_->end) {
        ++piece_;
        Enter();
      }
      return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(const Iterator& other) const { return piece_ == other.piece_ && triangle_ == other.triangle_; }

   private:
    void Enter() { triangle_ = piece_ == end_ ? 0 : piece_->first; }
    const Piece *piece_ = nullptr, *end_ = nullptr;
    uint32_t triangle_ = 0;
  };

  void Add(const Instance& instance, const Mesh& mesh, const MeshPart& part) {
    if (part.triangle_count == 0) return;
    pieces_.push_back({&instance, &mesh, part.first_triangle, part.first_triangle + part.triangle_count});
    size_ += part.triangle_count;
  }
  size_t size() const { return size_; }
  Iterator begin() const { return {pieces_.data(), pieces_.data() + pieces_.size()}; }
  Iterator end() const { return {pieces_.data() + pieces_.size(), pieces_.data() + pieces_.size()}; }

 private:
  std::vector<Piece> pieces_;
  size_t size_ = 0;
};

}  // namespace

bool BruteForceNames(const Scene& scene, const Entity& entity, const Noun& noun) {
  const std::string path = scene.tree[entity.category].path + "/";
  if (entity.id == scene.sky_entity || path.find("human/") == 0 || path.find("uav/") == 0) return false;
  bool fits = noun.categories.empty();
  for (const std::string& category : noun.categories) fits = fits || path.find(category + "/") == 0;
  return fits && (noun.names.empty() || IsCalled(entity.name, noun.names)) && !IsCalled(entity.name, noun.without);
}

struct BruteForce::Shape {
  std::vector<EntityId> entities;
  Triangles triangles;
  double low = kInfinity, high = -kInfinity;
  Vec3d middle;      // mean of the surface
  double reach = 0;  // from there to the farthest corner, seen from above

  /// No part of it can be nearer.
  double Least(Plan p) const { return std::abs(p - OnPlan(middle)) - reach - kTie; }

  double Distance(Plan p) const {
    double nearest = kInfinity;
    for (const auto& t : triangles) {
      const std::array<Plan, 3> flat = {OnPlan(t[0]), OnPlan(t[1]), OnPlan(t[2])};
      if (Under(p, flat)) return 0;
      for (int i = 0; i < 3; ++i) nearest = std::min(nearest, SquareToSegment(p, flat[i], flat[(i + 1) % 3]));
    }
    return std::sqrt(nearest);
  }

  /// Heights of its surface at a place.
  std::vector<double> HeightsAt(Plan p) const {
    std::vector<double> heights;
    for (const auto& t : triangles) {
      const std::array<Plan, 3> flat = {OnPlan(t[0]), OnPlan(t[1]), OnPlan(t[2])};
      const double area = Cross2(flat[1] - flat[0], flat[2] - flat[0]);
      if (std::abs(area) < 1e-9 || !Under(p, flat)) continue;
      const double u = Cross2(p - flat[0], flat[2] - flat[0]) / area, v = Cross2(flat[1] - flat[0], p - flat[0]) / area;
      heights.push_back((1 - u - v) * t[0].z + u * t[1].z + v * t[2].z);
    }
    return heights;
  }

  /// All of it lies left (right) of a line.
  bool LiesOnSide(Plan from, Plan along, bool left) const {
    return std::ranges::all_of(triangles, [&](const auto& t) {
      return std::ranges::all_of(t, [&](Vec3d p) { return (Cross2(along, OnPlan(p) - from) > 0) == left; });
    });
  }

  /// A place lies beside it, left (right) of its long axis, which runs towards `ahead`.
  bool HasOnSide(Plan place, Plan ahead, bool left) const {
    const Plan centre = OnPlan(middle);
    Plan square = 0;  // at the double angle of the long axis
    double width = 0;
    for (const auto& t : triangles)
      for (const Vec3d& p : t) square += std::pow(OnPlan(p) - centre, 2);
    Plan axis = std::polar(1.0, std::arg(square) / 2);
    if (Dot2(axis, ahead) < 0) axis = -axis;
    for (const auto& t : triangles)
      for (const Vec3d& p : t) width = std::max(width, std::abs(Cross2(axis, OnPlan(p) - centre)));
    return (left ? 1 : -1) * Cross2(axis, place - centre) > width;
  }

  /// A line ahead meets it, and all that it meets is ahead.
  bool IsEntered(Plan eye, Plan ahead) const {
    double first = kInfinity;
    for (const auto& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        const Plan a = (OnPlan(t[i]) - eye) / ahead, b = (OnPlan(t[(i + 1) % 3]) - eye) / ahead;
        if ((a.imag() > 0) == (b.imag() > 0)) continue;
        first = std::min(first, a.real() + (b.real() - a.real()) * a.imag() / (a.imag() - b.imag()));
      }
    }
    return first > 0 && first < kInfinity;
  }

  void Measure() {
    double area = 0;
    for (const auto& t : triangles) {
      const double a = 0.5 * Norm(Cross(t[1] - t[0], t[2] - t[0]));
      middle += (t[0] + t[1] + t[2]) * (a / 3);
      area += a;
      for (const Vec3d& p : t) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
      }
    }
    if (area > 0) middle = middle / area;
    for (const auto& t : triangles)
      for (const Vec3d& p : t) reach = std::max(reach, std::abs(OnPlan(p) - OnPlan(middle)));
  }
};

BruteForce::BruteForce(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)), parts_(internal::PartsByEntity(*scene_)) {}

BruteForce::~BruteForce() = default;

const BruteForce::Shape& BruteForce::ShapeOf(const std::vector<EntityId>& entities) {
  std::unique_ptr<Shape>& shape = shapes_[entities];
  if (shape) return *shape;
  shape = std::make_unique<Shape>();
  shape->entities = entities;
  for (const EntityId entity : entities) {
    for (const auto& [i, k] : parts_[entity]) {
      const Instance& instance = scene_->instances[i];
      const Mesh& mesh = scene_->meshes[instance.mesh];
      shape->triangles.Add(instance, mesh, mesh.parts[k]);
    }
  }
  shape->Measure();
  return *shape;
}

std::vector<const BruteForce::Shape*> BruteForce::All(const Noun& noun) {
  std::vector<std::vector<EntityId>> groups;
  for (const Entity& entity : scene_->entities) {
    if (!BruteForceNames(*scene_, entity, noun) || parts_[entity.id].empty()) continue;
    if (noun.whole && !groups.empty()) {
      groups[0].push_back(entity.id);
    } else {
      groups.push_back({entity.id});
    }
  }
  std::vector<const Shape*> shapes;
  for (const auto& group : groups) shapes.push_back(&ShapeOf(group));
  return shapes;
}

double BruteForce::Distance(const std::vector<EntityId>& entities, Vec3d p_W) { return ShapeOf(entities).Distance(OnPlan(p_W)); }

double BruteForce::HeightApart(const std::vector<EntityId>& entities, Vec3d p_W) {
  const Shape& shape = ShapeOf(entities);
  return std::max({shape.low - p_W.z, p_W.z - shape.high, 0.0});
}

bool BruteForce::Passes(const std::vector<EntityId>& entities, Vec3d from_W, Vec3d to_W) {
  const Shape& shape = ShapeOf(entities);
  const Plan a = OnPlan(from_W), b = OnPlan(to_W);
  const int steps = static_cast<int>(std::abs(b - a) / 0.25) + 1;
  for (int i = 0; i <= steps; ++i)
    if (shape.Distance(a + (b - a) * (static_cast<double>(i) / steps)) <= 1) return true;
  return false;
}

bool BruteForce::IsTall(const Shape& shape, const Noun& noun, const Predicate& predicate) {
  const auto extent = [&](const Shape& s) {
    if (predicate.sector != "width") return s.high - s.low;
    double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};
    for (const auto& t : s.triangles) {
      for (const Vec3d& p : t) {
        for (int i = 0; i < 2; ++i) {
          low[i] = std::min(low[i], p[i]);
          high[i] = std::max(high[i], p[i]);
        }
      }
    }
    return std::max(high[0] - low[0], high[1] - low[1]);
  };
  // As many of them, or more, are not higher.
  constexpr double kAlike = 2e-3;
  const double own = extent(shape);
  const auto all = All(noun);
  const auto higher = std::ranges::count_if(all, [&](const Shape* other) { return extent(*other) > own + kAlike; });
  const double share = predicate.share;
  const auto lower = static_cast<int64_t>(all.size()) - higher - 1;
  return lower >= static_cast<int64_t>(share * static_cast<double>(all.size()));
}

bool BruteForce::StandsOn(const Shape& shape, const Noun& of) {
  bool roof = false, high = false;
  const Plan foot = OnPlan(shape.middle);
  constexpr double kWalls = 15;  // metres from a place on a roof to a wall of its building
  for (const Shape* other : All(of)) {
    if (other == &shape || std::abs(OnPlan(other->middle) - foot) > 200 || other->Least(foot) > kWalls || other->Distance(foot) > kWalls)
      continue;
    high = high || other->low <= shape.low - 3;
    for (const double z : other->HeightsAt(foot)) roof = roof || std::abs(z - shape.low) <= 1.2;
  }
  return roof && high;
}

bool BruteForce::IsInOneStorey(const Shape& shape, const Noun& of) {
  if (shape.high - shape.low > 4.2) return false;
  const Plan at = OnPlan(shape.middle);
  for (const Shape* other : All(of))
    if (other->low <= shape.low + 0.5 && other->high >= shape.high - 0.5 && other->Least(at) <= 3 && other->Distance(at) <= 3) return true;
  return false;
}

bool BruteForce::IsSurrounded(const Shape& shape, const Predicate& predicate) {
  constexpr int kDirections = 24;
  const auto others = All(predicate.of);
  std::array<bool, kDirections> covered{};
  const Plan middle = OnPlan(shape.middle);
  for (const Shape* other : others) {
    if (other == &shape) continue;
    const Plan way = OnPlan(other->middle) - middle;
    const double most = predicate.within + 3;
    if (std::abs(way) > 400 || shape.Least(OnPlan(other->middle)) > most || shape.Distance(OnPlan(other->middle)) > most) continue;
    covered[static_cast<size_t>((std::arg(way) + std::numbers::pi) / (2 * std::numbers::pi) * kDirections) % kDirections] = true;
  }
  for (int d = 0; d < kDirections; ++d) {
    const Plan along = std::polar(1.0, 2 * std::numbers::pi * (d + 0.5) / kDirections - std::numbers::pi);
    for (double r = 1; !covered[d] && r < 200; r += 1) {
      const Plan at = middle + r * along;
      const double off = shape.Distance(at);
      if (off > predicate.within) break;
      const auto covers = [&](const Shape* o) {
        return o != &shape && o->triangles.size() < 4000 && o->Least(at) <= 0 && o->Distance(at) == 0;
      };
      covered[d] = off > 0.2 && std::ranges::any_of(others, covers);
    }
  }
  return static_cast<double>(std::ranges::count(covered, true)) >= predicate.share * kDirections;
}

bool BruteForce::Holds(const Predicate& predicate, const Noun& noun, const Shape& shape, const Viewpoint& view) {
  const Plan eye = OnPlan(view.p_W), ahead = std::polar(1.0, view.yaw);
  const Plan to = (OnPlan(shape.middle) - eye) / ahead;  // real: ahead, imaginary: to the left
  switch (predicate.kind) {
    case PredicateKind::kBearing:
      if (predicate.sector == "on_floor") return OnFloorBy(view.p_W.z, shape.low, shape.high) > 0;
      return IsInSector(predicate.sector, to, shape.middle.z - view.p_W.z);
    case PredicateKind::kHeightQuantile:
      return IsTall(shape, noun, predicate);
    case PredicateKind::kOppositeSide:
      return shape.Distance(eye) > 0.5;
    case PredicateKind::kSideOf:
      return predicate.side_of_axis ? shape.HasOnSide(eye, ahead, predicate.sector == "left")
                                    : shape.LiesOnSide(eye, ahead, predicate.sector == "left");
    case PredicateKind::kAcross:
      return shape.IsEntered(eye, ahead);
    case PredicateKind::kAlong:
      return to.real() > 1 && std::abs(to.imag()) < predicate.width;
    case PredicateKind::kOnTopOf:
      return StandsOn(shape, predicate.of);
    case PredicateKind::kStorey:
      return IsInOneStorey(shape, predicate.of);
    case PredicateKind::kSurroundedBy: {
      const std::string key = std::to_string(shape.entities.front()) + "/" + predicate.of.word + "/" + std::to_string(predicate.share) +
                              "/" + std::to_string(predicate.within);
      const auto found = surrounded_.find(key);
      return found != surrounded_.end() ? found->second : (surrounded_[key] = IsSurrounded(shape, predicate));
    }
    case PredicateKind::kNearest:
    case PredicateKind::kOrdinal:
      break;
  }
  return true;
}

std::vector<const BruteForce::Shape*> BruteForce::AllWithRivals(const Query& query) {
  std::vector<const Shape*> all = All(query.noun);
  if (all.empty() || !Names(query.rivals)) return all;
  const size_t own = all.size();
  for (const Shape* rival : All(query.rivals)) {
    const auto is_part = [&](const Shape* shape) {
      return std::ranges::find(shape->entities, rival->entities.front()) != shape->entities.end();
    };
    if (std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(own), is_part)) all.push_back(rival);
  }
  return all;
}

std::vector<std::vector<EntityId>> BruteForce::Answers(const Query& query, const Standpoint& standpoint) {
  // Whoever counts what stands farther aside has to find the same.
  Query narrow = query, wide = query;
  bool two = false;
  for (size_t i = 0; i < query.predicates.size(); ++i) {
    two = two || query.predicates[i].clear > query.predicates[i].width;
    narrow.predicates[i].clear = wide.predicates[i].clear = 0;
    wide.predicates[i].width = std::max(query.predicates[i].width, query.predicates[i].clear);
  }
  auto answers = AnswersOf(narrow, standpoint);
  if (!two || answers.empty()) return answers;
  for (auto& answer : AnswersOf(wide, standpoint))
    if (std::ranges::find(answers, answer) == answers.end()) answers.push_back(std::move(answer));
  return answers;
}

std::vector<std::vector<EntityId>> BruteForce::AnswersOf(const Query& query, const Standpoint& standpoint) {
  std::vector<const Shape*> left = AllWithRivals(query);
  for (const Predicate& predicate : query.predicates) {
    const Viewpoint& view = predicate.at_turn ? standpoint.turn.value() : standpoint.start;
    const Plan eye = OnPlan(view.p_W);
    double nearest = kInfinity;
    // What is surely farther than the nearest so far is not measured to the millimetre.
    const auto measure = [&](const Shape* shape) {
      if (predicate.kind == PredicateKind::kOrdinal) return ((OnPlan(shape->middle) - eye) / std::polar(1.0, view.yaw)).real();
      if (const double least = shape->Least(eye); least > nearest + NearestMargin(nearest) + 1) return least;
      const double distance = shape->Distance(eye);
      nearest = std::min(nearest, distance);
      return distance;
    };
    if (predicate.kind != PredicateKind::kNearest && predicate.kind != PredicateKind::kOrdinal) {
      std::erase_if(left, [&](const Shape* shape) { return !Holds(predicate, query.noun, *shape, view); });
      continue;
    }
    std::vector<double> values;
    for (const Shape* shape : left) values.push_back(measure(shape));
    std::ranges::sort(values);
    const size_t place = predicate.kind == PredicateKind::kNearest ? 0 : static_cast<size_t>(predicate.k - 1);
    if (place >= values.size()) return {};
    // What is hardly farther or, on the way, nearer competes with it.
    const double value = values[place], blur = NearestMargin(value) - kFuzz;
    std::erase_if(left, [&](const Shape* shape) { return std::abs(measure(shape) - value) > blur; });
  }
  std::vector<std::vector<EntityId>> answers;
  for (const Shape* shape : left) answers.push_back(shape->entities);
  return answers;
}

}  // namespace airsim360

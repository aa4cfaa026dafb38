#include "airsim360/people/crowd/steering.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/orca.h"

namespace airsim360::internal {
namespace {

constexpr double kHorizon = 2.0;        // seconds ahead for people
constexpr double kThrongHorizon = 0.5;  // the same in a dense crowd
constexpr double kWallHorizon = 0.3;    // and for walls, which do not move
constexpr double kSight = 3.0;          // metres; two cells
constexpr double kDensityRadius = 1.5;  // metres, as NavMesh::OpenShare
constexpr int kMaxNeighbours = 9, kMaxClose = 12, kMaxWalls = 6, kMaxVehicles = 3;
constexpr double kCloseRange = 2 * kBodyRadius + 0.35;
constexpr double kShareSlope = 0.6;                     // how fast the work of avoiding goes over to who has the other in front
constexpr double kNoShare = 0.05;                       // of avoiding: not worth a thought
constexpr double kArm = 2 * kBodyRadius + 0.036;        // metres: between the middles of people who touch or nearly do
constexpr double kYieldAfter = 0.4, kYieldSpeed = 0.3;  // seconds, m/s: who is stuck beside somebody nearer to a door
constexpr double kLoosenAfter = 4, kLoosenUntil = 4.6;  // seconds
constexpr double kSidestepAfter = 1;                    // seconds that someone who stands is in the way
constexpr double kLookOnRoad = 3, kLookOnCrossing = 2;  // seconds ahead at vehicles; on crossings drivers stop
constexpr double kPatience = 10;                        // seconds of waiting for them, then a smaller gap will do
constexpr double kCorner = 0.02;                        // metres
constexpr double kAcceleration = 4;                     // m/s^2
constexpr double kLevel = 1.6;                          // metres of height beyond which people are on different floors
constexpr int64_t kChunk = 128;                         // people a task

// People stand apart and away from walls, so a disc around one of them holds more people than one anywhere; both
// numbers come from the ring of steering_test.cc.
constexpr double kDensityFactor = 0.92;
constexpr double kSelfShare = 0.55;

Vec2d BodyOf(const Walker& w) { return Vec2d{w.at.p_W.x, w.at.p_W.y} + w.aside; }

/// How much of the avoiding is ours: who has the other more in front of them does more of it, and who is
/// followed nothing, so that those in front of a door do not wait for those behind. The shares of two people
/// make 1, as ORCA wants; two head on, or side by side, do half each.
double ShareOf(Vec2d to_other, Vec2d forward, Vec2d other_forward, bool other_still) {
  if (other_still) return 1;
  const double n = Norm(to_other);
  const bool one_is_idle = (forward.x == 0 && forward.y == 0) || (other_forward.x == 0 && other_forward.y == 0);
  if (n < 1e-9 || one_is_idle) return 0.5;
  return std::clamp(0.5 + kShareSlope * (Dot(to_other, forward) + Dot(to_other, other_forward)) / n, 0.0, 1.0);
}

/// Around somebody who stands in the way: past the nearer side of them, or the other if a wall is there.
Vec2d Sidestep(Vec2d forward, Vec2d to_other, std::span<const HalfPlane> walls) {
  Vec2d side = Vec2d{-forward.y, forward.x} * kYieldSpeed;
  if (Dot(side, to_other) > 0) side = side * -1;
  for (const HalfPlane& wall : walls)
    if (Dot(side - wall.point, wall.normal) < 0) return side * -1;
  return side;
}

/// WeidmannSpeed by steps of 1/64 per square metre.
struct SpeedTable {
  std::array<double, 64 * 8> speed;
  SpeedTable() {
    for (size_t i = 0; i < speed.size(); ++i) speed[i] = WeidmannSpeed(static_cast<double>(i) / 64);
  }
  double operator()(double density) const { return speed[std::min(speed.size() - 1, static_cast<size_t>(density * 64 + 0.5))]; }
};
const SpeedTable kSpeed;

}  // namespace

double WeidmannSpeed(double density) {
  if (density <= 0.05) return 1.34;
  return 1.34 * std::max(0.0, 1 - std::exp(-1.913 * (1 / density - 1 / 5.4)));
}

struct Steering::Plan {
  Vec2d v;
  bool waits = false;
  int close_count = 0;
  std::array<uint32_t, kMaxClose> close;  // walkers that may be touched within the step
};

/// The nearest people, and how many are around.
struct Steering::Company {
  struct Near {
    double rank;  // squared distance, more for who is behind
    const Seen* other;
  };
  std::array<Near, kMaxNeighbours + 1> near;
  int count = 0;
  double ahead = 0, in_disc = 0;  // people within kDensityRadius: weighted by how straight ahead they are, and all

  void Add(double rank, const Seen* other) {
    if (count == kMaxNeighbours && rank >= near[kMaxNeighbours - 1].rank) return;
    int at = count < kMaxNeighbours ? count++ : kMaxNeighbours - 1;
    for (; at > 0 && near[static_cast<size_t>(at - 1)].rank > rank; --at) near[static_cast<size_t>(at)] = near[static_cast<size_t>(at - 1)];
    near[static_cast<size_t>(at)] = {rank, other};
  }
};

/// What a walker's velocity must keep to, and what they notice on the way.
struct Steering::Limits {
  std::array<HalfPlane, kMaxWalls + kMaxVehicles + kMaxNeighbours + 4> planes;
  size_t hard = 0, used = 0;  // planes of walls come first
  double right = 0;           // share of the wanted velocity that goes to the right
  bool yields = false;
  Vec2d in_the_way;  // towards somebody who stands there; zero: nobody

  void AddWalls(const NavMesh& mesh, Vec2d p, double z, double range);
  void AddVehicles(Vec2d p, std::span<const CrowdVehicle* const> near);
  void AddPeople(const Seen& self, const Company& company, Vec2d wanted, double throng, double dt);
  void AddObstacles(const Seen& self, std::span<const SteeringObstacle> obstacles, double dt);
};

Steering::Steering() = default;
Steering::~Steering() = default;
Steering::Steering(const Steering&) {}
Steering& Steering::operator=(const Steering&) { return *this; }

void Steering::Step(const NavMesh& mesh, std::span<Walker> walkers, std::span<const SteeringObstacle> obstacles, double dt,
                    const Vehicles& vehicles) {
  // Where everybody wants to go is known only now.
  for (Seen& seen : seen_) {
    const Walker& walker = walkers[seen.index];
    const double speed = Norm(walker.wanted);
    seen.still = walker.still;
    seen.rest = walker.rest;
    seen.blocked = walker.blocked;
    seen.forward = walker.still || speed < 1e-6 ? Vec2d{} : walker.wanted * (1 / speed);
  }
  // Everybody chooses a velocity from where all stand now; then they move one after the other.
  plans_.resize(walkers.size());
  const auto n = static_cast<int64_t>(walkers.size());
  const auto chunk = [&](int64_t c) {
    for (int64_t k = c * kChunk; k < std::min(n, (c + 1) * kChunk); ++k) {
      if (static_cast<size_t>(k) < seen_.size()) Choose(mesh, walkers, obstacles, vehicles, static_cast<uint32_t>(k), dt);
    }
  };
  const int64_t chunks = (n + kChunk - 1) / kChunk;
  if (chunks > 1) {
    ParallelFor(chunks, chunk);
  } else if (chunks == 1) {
    chunk(0);
  }
  for (uint32_t i = 0; i < walkers.size(); ++i) {
    Walker& walker = walkers[i];
    if (!walker.present) continue;
    Advance(mesh, walkers, i, dt);
    walker.waits = plans_[i].waits;
    walker.waited = walker.waits ? walker.waited + dt : std::max(0.0, walker.waited - dt);
    const bool stands = !walker.waits && Dot(walker.v, walker.v) < 0.05 * 0.05 && Dot(walker.wanted, walker.wanted) > 0.01;
    walker.blocked = stands ? walker.blocked + dt : std::max(0.0, walker.blocked - 2 * dt);
    if (walker.blocked > kLoosenUntil) walker.blocked = kSidestepAfter;
  }
}

void Steering::Sort(std::span<const Walker> walkers) {
  // A grid over those who are here.
  Vec2d max{-1e18, -1e18};
  min_ = {1e18, 1e18};
  size_t present = 0;
  for (const Walker& w : walkers) {
    if (!w.present) continue;
    ++present;
    const Vec2d p = BodyOf(w);
    min_ = {std::min(min_.x, p.x), std::min(min_.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  seen_.resize(present);
  if (present == 0) return;
  cell_ = kSight / 2;
  columns_ = static_cast<int>((max.x - min_.x) / cell_) + 1;
  rows_ = static_cast<int>((max.y - min_.y) / cell_) + 1;

  // Counting sort by cell keeps the order of numbers within each.
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  cell_of_.resize(walkers.size());
  for (size_t i = 0; i < walkers.size(); ++i) {
    if (!walkers[i].present) continue;
    const Vec2d p = BodyOf(walkers[i]);
    const auto c = static_cast<uint32_t>((p.x - min_.x) / cell_), r = static_cast<uint32_t>((p.y - min_.y) / cell_);
    cell_of_[i] = r * static_cast<uint32_t>(columns_) + c;
    ++first_[cell_of_[i] + 1];
  }
  for (size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  for (uint32_t i = 0; i < walkers.size(); ++i) {
    const Walker& w = walkers[i];
    if (!w.present) continue;
    seen_[first_[cell_of_[i]]++] = {BodyOf(w), w.v, {}, w.at.p_W.z, 0, 0, i, false};
  }
  for (size_t k = first_.size() - 1; k > 0; --k) first_[k] = first_[k - 1];
  first_[0] = 0;
}

// People who press side by side into a door hold each other like the stones of an arch. All but the one nearest
// to the door step back a little.
bool Steering::YieldsTo(const Seen& self, const Seen& other, double d2) {
  if (self.blocked <= kYieldAfter || other.blocked <= kYieldAfter / 2 || other.still || d2 > kArm * kArm) return false;
  if (self.rest <= 0 || other.rest <= 0) return false;
  return other.rest < self.rest || (other.rest == self.rest && other.index < self.index);
}

Steering::Company Steering::LookAround(uint32_t k, bool only_close, Plan& plan) const {
  const Seen& self = seen_[k];
  Company company;
  const int column = static_cast<int>((self.p.x - min_.x) / cell_), row = static_cast<int>((self.p.y - min_.y) / cell_);
  const auto look = [&](int r, int c0, int c1) {
    if (r < 0 || r >= rows_) return;
    const size_t base = static_cast<size_t>(r) * static_cast<size_t>(columns_);
    const uint32_t from = first_[base + static_cast<size_t>(std::max(c0, 0))];
    const uint32_t to = first_[base + static_cast<size_t>(std::min(c1, columns_ - 1)) + 1];
    for (uint32_t i = from; i < to; ++i) {
      const Seen& other = seen_[i];
      const Vec2d d = other.p - self.p;
      const double d2 = Dot(d, d);
      if (d2 > kSight * kSight || i == k || std::abs(other.z - self.z) > kLevel) continue;
      // Only who is ahead counts, the more the straighter, on average once: the first of a queue see the way free.
      if (d2 < kDensityRadius * kDensityRadius) {
        ++company.in_disc;
        company.ahead += std::max(0.0, kPi * Dot(d, self.forward) / std::sqrt(d2 + 1e-12));
      }
      if (d2 < kCloseRange * kCloseRange && plan.close_count < kMaxClose) plan.close[static_cast<size_t>(plan.close_count++)] = other.index;
      // Those behind matter less.
      company.Add(Dot(d, self.v) < 0 ? 4 * d2 : d2, &other);
    }
  };
  for (int r = row - 1; r <= row + 1; ++r) look(r, column - 1, column + 1);
  if (only_close || company.count == kMaxNeighbours) return company;
  look(row - 2, column - 2, column + 2);
  look(row + 2, column - 2, column + 2);
  for (int r = row - 1; r <= row + 1; ++r) {
    if (column >= 2) look(r, column - 2, column - 2);
    if (column + 2 < columns_) look(r, column + 2, column + 2);
  }
  return company;
}

void Steering::Limits::AddWalls(const NavMesh& mesh, Vec2d p, double z, double range) {
  const std::span<const NavWall> walls = mesh.walls();
  for (const uint32_t w : mesh.WallsNear(p)) {
    const NavWall& wall = walls[w];
    const Vec2d edge = wall.b - wall.a, from_a = p - wall.a;
    if (edge.x * from_a.y - edge.y * from_a.x < -1e-4) continue;
    const double t = std::clamp(Dot(from_a, edge) / Dot(edge, edge), 0.0, 1.0);
    const Vec2d off = from_a - edge * t;
    const double d2 = Dot(off, off);
    if (d2 > range * range || std::abs(wall.za + t * (wall.zb - wall.za) - z) > kLevel) continue;
    // At the very end of a wall nothing is said about what is beyond it: a corner is turned there.
    const double d = std::sqrt(d2), length = Norm(edge);
    if (d < kCorner && std::min(t, 1 - t) * length < kCorner) continue;
    const Vec2d normal = d > 1e-4 ? off * (1 / d) : Vec2d{-edge.y / length, edge.x / length};
    if (hard < kMaxWalls) planes[hard++] = {normal * (-d / kWallHorizon), normal};
  }
  used = hard;
}

void Steering::Limits::AddVehicles(Vec2d p, std::span<const CrowdVehicle* const> near) {
  const size_t most = hard + kMaxVehicles;
  for (const CrowdVehicle* vehicle : near)
    if (hard < most && KeepOut(*vehicle, p, planes[hard])) ++hard;
  used = hard;
}

void Steering::Limits::AddPeople(const Seen& self, const Company& company, Vec2d wanted, double throng, double dt) {
  const double space = kSpaceRadius - (kSpaceRadius - kBodyRadius - 0.003) * throng;
  const double horizon = kHorizon - (kHorizon - kThrongHorizon) * throng;
  for (int i = 0; i < company.count; ++i) {
    const Seen& other = *company.near[static_cast<size_t>(i)].other;
    const Vec2d d = other.p - self.p;
    const double share = ShareOf(d, self.forward, other.forward, other.still);
    if (share < kNoShare) continue;
    yields |= share < 1 && YieldsTo(self, other, Dot(d, d));
    if (other.still && self.blocked > kSidestepAfter && Dot(d, d) < kArm * kArm && Dot(d, self.forward) > 0) in_the_way = d;
    planes[used++] = AvoidDisc(d, self.v, other.v, 2 * space, horizon, dt, share);
    // Towards someone who comes straight at them, walkers keep to the right.
    const double ahead = Dot(d, wanted), closing = Dot(other.v, wanted);
    if (closing < 0 && ahead > 0 && ahead * ahead > 0.85 * Dot(d, d) * Dot(wanted, wanted)) right = 0.12;
  }
}

void Steering::Limits::AddObstacles(const Seen& self, std::span<const SteeringObstacle> obstacles, double dt) {
  for (const SteeringObstacle& obstacle : obstacles) {
    const Vec2d d = obstacle.p - self.p;
    if (used < planes.size() && Dot(d, d) < 25 && std::abs(obstacle.z - self.z) < 2.2)
      planes[used++] = AvoidDisc(d, self.v, obstacle.v, kSpaceRadius + obstacle.radius, kHorizon, dt, 1);
  }
}

void Steering::Choose(const NavMesh& mesh, std::span<const Walker> walkers, std::span<const SteeringObstacle> obstacles,
                      const Vehicles& vehicles, uint32_t k, double dt) {
  const Seen& self = seen_[k];
  const Walker& walker = walkers[self.index];
  Plan& plan = plans_[self.index];
  plan.close_count = 0;
  plan.v = {};
  plan.waits = false;
  const Company company = LookAround(k, walker.still, plan);
  const std::vector<const CrowdVehicle*> driving = vehicles.Near(self.p, self.z);
  const bool sits = walker.aside.x != 0 || walker.aside.y != 0;
  if (walker.still && (sits || driving.empty())) return;

  // Walkers slow down in a crowd, all by the same law.
  const double wanted_speed = Norm(walker.wanted);
  const double disc = kPi * kDensityRadius * kDensityRadius * mesh.OpenShare(self.p);
  const double density = kDensityFactor * (company.ahead + kSelfShare) / disc;
  double cap = kSpeed(density) / 1.34 * std::max(walker.free_speed, wanted_speed);
  Vec2d wanted = wanted_speed > cap ? walker.wanted * (cap / wanted_speed) : walker.wanted;
  // In a throng they come closer and look less far ahead, else nobody would let anybody in at a door.
  double throng = std::clamp((kDensityFactor * (company.in_disc + kSelfShare) / disc - 0.8) / 1.2, 0.0, 1.0);
  throng = std::max(throng, walker.pressed);

  Limits limits;
  limits.AddWalls(mesh, self.p, self.z, std::max(0.3, cap * kWallHorizon + 0.1));  // first, for they do not give way
  limits.AddVehicles(self.p, driving);
  for (size_t i = 0; i < limits.hard; ++i) cap = std::max(cap, Dot(limits.planes[i].point, limits.planes[i].normal));
  limits.AddPeople(self, company, wanted, throng, dt);
  limits.AddObstacles(self, obstacles, dt);
  limits.yields |= self.blocked > kLoosenAfter;  // nothing has helped: let go for a moment, each at another time
  if (limits.yields) {
    wanted = self.forward * -kYieldSpeed;
    cap = std::max(cap, kYieldSpeed);
  } else if (limits.in_the_way.x != 0 || limits.in_the_way.y != 0) {
    wanted = Sidestep(self.forward, limits.in_the_way, {limits.planes.data(), limits.hard});
    cap = std::max(cap, kYieldSpeed);
  } else {
    wanted = wanted + Vec2d{wanted.y, -wanted.x} * limits.right;
  }
  if (!driving.empty()) {
    const double seconds = (mesh.CrossingAt(self.p) >= 0 ? kLookOnCrossing : kLookOnRoad) * (walker.waited > kPatience ? 0.5 : 1);
    const Dodge dodge = DodgeVehicles(driving, mesh, {walker.at, self.p, walker.still ? Vec2d{} : wanted, walker.rest, seconds});
    if (walker.still && !dodge.escapes) return;
    wanted = dodge.wanted;
    plan.waits = dodge.waits;
    if (dodge.escapes) cap = std::max(cap, Norm(wanted));
  }
  Vec2d v = SolveVelocity({limits.planes.data(), limits.used}, limits.hard, wanted, std::max(cap, 0.05));

  // Nobody starts or stops in no time.
  const Vec2d change = v - self.v;
  const double most = kAcceleration * dt, n = Norm(change);
  if (n > most) v = self.v + change * (most / n);
  plan.v = v;
}

void Steering::Advance(const NavMesh& mesh, std::span<Walker> walkers, uint32_t self, double dt) {
  Walker& walker = walkers[self];
  const Plan& plan = plans_[self];
  const Vec2d p{walker.at.p_W.x, walker.at.p_W.y};
  walker.v = plan.v;
  Vec2d move = plan.v * dt;
  const auto step_to = [&](double z, double speed) {  // kerbs are stepped over, not jumped
    const double most = std::max(1.0, speed) * dt;
    return walker.at.p_W.z + std::clamp(z - walker.at.p_W.z, -most, most);
  };
  const auto stay = [&] {
    walker.v = {};
    walker.at.p_W.z = step_to(mesh.GroundHeight(p.x, p.y, walker.at.p_W.z), 0);
  };
  if (Dot(move, move) < 1e-12) return stay();

  // Into nobody: what leads into a body is taken away, and who cannot go stays.
  const auto blocked = [&](Vec2d q) -> const Walker* {
    for (int i = 0; i < plan.close_count; ++i) {
      const Walker& other = walkers[plan.close[static_cast<size_t>(i)]];
      const Vec2d o = BodyOf(other);
      const double d2 = Dot(q - o, q - o);
      if (d2 < 4 * kBodyRadius * kBodyRadius && d2 < Dot(p - o, p - o)) return &other;
    }
    return nullptr;
  };
  NavPoint next = walker.at;
  bool moved = false;
  for (int attempt = 0; attempt < 3 && !moved; ++attempt) {
    next = mesh.Move(walker.at, p + move);
    const Walker* other = blocked({next.p_W.x, next.p_W.y});
    if (!other) {
      moved = true;
      break;
    }
    const Vec2d away = p - BodyOf(*other);
    const double n = Norm(away);
    if (n < 1e-9) break;
    const double into = Dot(move, away) / n;
    if (into < 0) move = move - away * (into / n * 1.0001);
  }
  if (!moved) return stay();
  walker.v = (Vec2d{next.p_W.x, next.p_W.y} - p) * (1 / dt);
  next.p_W.z = step_to(next.p_W.z, Norm(walker.v));
  walker.at = next;
}

}  // namespace airsim360::internal

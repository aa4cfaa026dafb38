#include "airsim360/flight/collision/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/flight/collision/contact_solver.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/test_drones.h"

namespace airsim360 {
namespace {

/// The inside of a box of sheets without thickness, and a vertical pole.
class Room : public ContactQuery {
 public:
  Vec3d low{-5, -5, 0}, high{5, 5, 6};
  double pole_x = 100, pole_y = 0, pole_radius = 0.01;
  mutable int questions = 0;

  std::optional<SurfacePoint> FirstHit(Vec3d from, Vec3d to) const override {
    ++questions;
    double best = 2;
    SurfacePoint hit;
    for (int axis = 0; axis < 3; ++axis) {
      for (double wall : {low[axis], high[axis]}) {
        const double a = from[axis] - wall, b = to[axis] - wall;
        if (a * b > 0 || a == b || a / (a - b) >= best) continue;
        best = a / (a - b);
        hit = {from + (to - from) * best, {}, 1};
        hit.normal_W[axis] = a > 0 ? 1 : -1;
      }
    }
    if (const double t = PoleHit(from, to); t < best) {
      best = t;
      hit = {from + (to - from) * t, {}, 2};
      hit.normal_W = Normalized(Vec3d{hit.p_W.x - pole_x, hit.p_W.y - pole_y, 0});
    }
    return best <= 1 ? std::optional(hit) : std::nullopt;
  }

  std::optional<SurfacePoint> Nearest(Vec3d p, double range) const override {
    ++questions;
    SurfacePoint nearest;
    double best = range;
    const auto offer = [&](Vec3d q, uint32_t entity) {
      if (const double d = Norm(q - p); d < best) best = d, nearest = {q, {}, entity};
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (double wall : {low[axis], high[axis]}) {
        Vec3d q = p;
        q[axis] = wall;
        offer(q, 1);
      }
    }
    const Vec3d out = Normalized(Vec3d{p.x - pole_x, p.y - pole_y, 0});
    offer({pole_x + pole_radius * out.x, pole_y + pole_radius * out.y, p.z}, 2);
    return best < range ? std::optional(nearest) : std::nullopt;
  }

 private:
  double PoleHit(Vec3d from, Vec3d to) const {
    const double dx = to.x - from.x, dy = to.y - from.y, fx = from.x - pole_x, fy = from.y - pole_y;
    const double a = dx * dx + dy * dy, b = fx * dx + fy * dy, c = fx * fx + fy * fy - pole_radius * pole_radius;
    const double d = b * b - a * c;
    if (a == 0 || d < 0) return 2;
    const double t = (-b - std::sqrt(d)) / a;
    return t >= 0 ? t : 2;
  }
};

/// Without drag, so that closed forms hold.
DroneModel Puck() {
  DroneModel m = AgiliciousDrone();
  m.quadratic_drag_B = {};
  for (RotorModel& r : m.rotors) r.in_plane_drag = 0;
  return m;
}

struct Experiment {
  DroneModel model = Puck();
  double dt = 1e-3;
  ContactProperties properties;
  Room room;
  RotorSpeeds commands{};
  DroneState state;
  ContactState contact;
  ContactReport report;

  void Step() {
    const DroneState before = state;
    dynamics.Step({}, commands, kAllRotorsWork, state);
    report = ResolveContacts(model, properties, room, before, dt, 0, state, contact);
  }
  void Run(double seconds) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) Step();
  }
  double Bottom() const { return state.p_WB.z - model.half_size_B.z; }

  explicit Experiment(DroneModel m = Puck(), double step = 1e-3) : model(std::move(m)), dt(step), dynamics(model, step) {}
  DroneDynamics dynamics;
};

TEST(Contact, ADroppedDroneComesToRestFlatOnTheFloor) {
  Experiment e;
  e.state.p_WB = {0, 0, 1};
  e.state.q_WB = ToQuaternion(BodyPose({}, 0.3, 0.2, -0.35).R);
  e.Run(6);
  EXPECT_NEAR(e.Bottom(), 0, 1e-4);
  EXPECT_LT(Norm(e.state.v_WB), 1e-3);
  EXPECT_LT(Norm(e.state.w_WB_B), 1e-3);
  EXPECT_NEAR(ToMatrix(e.state.q_WB).m[2][2], 1, 1e-6);
  const Vec3d rest = e.state.p_WB;
  e.Run(10);
  EXPECT_LT(Norm(e.state.p_WB - rest), 1e-4);
  EXPECT_TRUE(e.report.touching);
  EXPECT_EQ(e.report.point.entity, 1u);
}

TEST(Contact, SlidesAsFarAsCoulombSays) {
  Experiment e;
  e.properties.friction = 0.5;
  e.state.p_WB = {-2, 0, e.model.half_size_B.z};
  e.state.v_WB = {3, 0, 0};
  e.Run(2);
  EXPECT_NEAR(e.state.p_WB.x + 2, 9 / (2 * 0.5 * kGravity), 0.01);
  EXPECT_LT(Norm(e.state.v_WB), 1e-3);
}

TEST(Contact, BouncesToTheSquareOfTheRestitution) {
  Experiment e;
  e.properties.restitution = 0.6;
  e.state.p_WB = {0, 0, 1 + e.model.half_size_B.z};
  while (e.state.v_WB.z <= 0) e.Step();
  while (e.state.v_WB.z > 0) e.Step();
  EXPECT_NEAR(e.Bottom(), 0.36, 0.36 * 0.01);
}

TEST(Contact, NothingPassesAWallAtThirtyMetresASecond) {
  for (double dt : {1e-3, 2e-2}) {
    for (int i = 0; i < 40; ++i) {
      RngStream random(3, "bullet", i);
      Experiment e(Puck(), dt);
      e.state.p_WB = {0, 0, 3};
      e.state.v_WB = Normalized(Vec3d{random.Normal(), random.Normal(), random.Normal()}) * 30;
      e.state.w_WB_B = {random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-20, 20)};
      bool touched = false;
      for (double t = 0; t < 1; t += dt) {
        e.Step();
        touched |= e.report.touching;
        for (int a = 0; a < 3; ++a) {
          ASSERT_GT(e.state.p_WB[a], e.room.low[a]);
          ASSERT_LT(e.state.p_WB[a], e.room.high[a]);
        }
      }
      EXPECT_TRUE(touched);
      EXPECT_TRUE(e.contact.crashed);
    }
  }
}

TEST(Contact, EnergyNeverGrows) {
  for (int i = 0; i < 20; ++i) {
    RngStream random(4, "energy", i);
    Experiment e;
    e.properties.restitution = 0.9;
    e.state.p_WB = {0, 0, 1};
    e.state.v_WB = {random.Uniform(-5, 5), random.Uniform(-5, 5), random.Uniform(-5, 5)};
    e.state.w_WB_B = {random.Uniform(-10, 10), random.Uniform(-10, 10), random.Uniform(-10, 10)};
    double energy = internal::MechanicalEnergy(e.model, e.state);
    for (int k = 0; k < 4000; ++k) {
      e.Step();
      const double now = internal::MechanicalEnergy(e.model, e.state);
      ASSERT_LE(now, energy + 1e-9) << i << " step " << k;
      energy = now;
    }
  }
}

TEST(Contact, OnlyHardImpactsAreCrashes) {
  for (double height : {0.3, 0.8}) {  // 2.4 and 4.0 m/s
    Experiment e;
    e.state.p_WB = {0, 0, height + e.model.half_size_B.z};
    double hardest = 0;
    for (int i = 0; i < 1000; ++i) e.Step(), hardest = std::max(hardest, e.report.impact_speed);
    EXPECT_NEAR(hardest, std::sqrt(2 * kGravity * height), 0.02);
    EXPECT_EQ(e.contact.crashed, hardest > e.properties.crash_speed);
  }
}

TEST(Contact, APoleBetweenTheBoxsCornersStopsTheDrone) {
  for (double y : {0.0, 0.03, 0.055, 0.08, 0.12}) {
    Experiment e;
    e.room.pole_x = 1;
    e.room.pole_y = y;
    e.state.p_WB = {0, 0, 3};
    e.state.v_WB = {5, 0, 0};
    double deepest = 0;
    bool touched = false;
    for (int i = 0; i < 500; ++i) {
      e.Step();
      touched |= e.report.touching;
      const Vec3d to_pole = ToMatrix(e.state.q_WB).transpose() * Vec3d{1 - e.state.p_WB.x, y - e.state.p_WB.y, 0};
      const double in_x = e.model.half_size_B.x - std::abs(to_pole.x);
      const double in_y = e.model.half_size_B.y - std::abs(to_pole.y);
      if (std::abs(to_pole.z) < e.model.half_size_B.z) deepest = std::max(deepest, std::min(in_x, in_y));
    }
    EXPECT_TRUE(touched) << y;
    EXPECT_LT(deepest, 0.02) << y;
  }
}

TEST(Contact, FlyingFreelyAsksForNoSurfaces) {
  Experiment e;
  e.state.p_WB = {0, 0, 3};
  e.state.rotor_speeds.fill(HoverSpeed(e.model));
  e.commands = e.state.rotor_speeds;
  e.Run(1);
  EXPECT_LE(e.room.questions, 4);
}

TEST(Contact, AnHourOfRandomCommandsStaysInTheRoomAndFinite) {
  DroneModel model = DroneWithEveryTerm();
  Experiment e(model, 2e-2);
  RngStream random(6, "hour");
  for (int i = 0; i < 180000; ++i) {
    // Every 20 s thrown anew, or it would lie on its back for most of the hour.
    if (i % 1000 == 0) {
      e.state = DroneState{};
      e.contact = {};
      e.state.p_WB = {random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(0.5, 5)};
      e.state.v_WB = {random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-20, 20)};
      e.state.rotor_speeds.fill(HoverSpeed(model));
    }
    if (i % 10 == 0) {
      const double base = HoverSpeed(model) * random.Uniform(0.6, 1.4);
      for (double& c : e.commands) c = random.Chance(0.02) ? 1e9 : base * random.Uniform(0.9, 1.1);
    }
    e.Step();
    for (int a = 0; a < 3; ++a) {
      ASSERT_GT(e.state.p_WB[a], e.room.low[a]) << i;
      ASSERT_LT(e.state.p_WB[a], e.room.high[a]) << i;
    }
    ASSERT_TRUE(std::isfinite(Norm(e.state.v_WB) + Norm(e.state.w_WB_B) + e.state.q_WB.w)) << i;
  }
}

}  // namespace
}  // namespace airsim360

// Stairs in two flights, ramps between decks, escalators.
#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

constexpr float kLanding = 1.2f, kRail = 0.95f;

// One flight: `steps` treads of `tread` metres from y, towards `dir`, the first at z0 + rise.
struct Flight {
  float x0, x1, y, dir, z0, rise, tread;
  int steps;
};

void BuildFlight(const Flight& f, InteriorPen& pen) {
  pen.Use(Finish::kTread);
  for (int i = 0; i < f.steps; ++i) {
    const float a = f.y + f.dir * f.tread * static_cast<float>(i), b = a + f.dir * f.tread, z = f.z0 + f.rise * static_cast<float>(i + 1);
    pen.Box({f.x0, std::min(a, b), z - f.rise - 0.06f}, {f.x1, std::max(a, b), z});
  }
}

void BuildRail(Vec3f a, Vec3f b, InteriorPen& pen) {
  pen.Use(Finish::kFrameDark);
  pen.mesh().Tube(a + Vec3f{0, 0, kRail}, b + Vec3f{0, 0, kRail}, 0.022f, 0.022f, 8);
  const int posts = std::max(1, static_cast<int>(Norm(b - a) / 0.4f));
  for (int i = 0; i <= posts; ++i) {
    const Vec3f p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(posts));
    pen.mesh().Tube(p, p + Vec3f{0, 0, kRail}, 0.009f, 0.009f, 6, false, false);
  }
}

void BuildStair(const InteriorPlan& plan, const PlanStair& stair, InteriorPen& pen) {
  const PlanRoom& room = plan.rooms[static_cast<size_t>(stair.room)];
  const PlanRect r = room.clear;
  const int risers = 2 * static_cast<int>(std::ceil(stair.rise / 0.175f / 2)), half = risers / 2;
  const float rise = stair.rise / static_cast<float>(risers),
              tread = std::min(0.30f, (r.depth() - kLanding - 1.0f) / static_cast<float>(half - 1));
  const float z0 = room.floor_z, y_start = r.y0 + kLanding, y_turn = y_start + tread * static_cast<float>(half - 1), gap = 0.1f;
  const float xm = r.center().x, z_turn = z0 + rise * static_cast<float>(half), z1 = z0 + stair.rise;
  pen.Start("stairs " + room.name, "construction/stairs");
  BuildFlight({r.x0, xm - gap / 2, y_start, 1, z0, rise, tread, half - 1}, pen);
  BuildFlight({xm + gap / 2, r.x1, y_turn, -1, z_turn, rise, tread, half - 1}, pen);
  pen.Use(Finish::kConcreteFloor);
  pen.Box({r.x0, y_turn, z_turn - 0.2f}, {r.x1, r.y1, z_turn});
  pen.Box({r.x0, r.y0 - kHalfWall, z1 - kSlab}, {r.x1, y_start, z1});
  BuildRail({xm - gap / 2 - 0.03f, y_start, z0 + rise}, {xm - gap / 2 - 0.03f, y_turn, z_turn}, pen);
  BuildRail({xm + gap / 2 + 0.03f, y_turn, z_turn + rise}, {xm + gap / 2 + 0.03f, y_start, z1}, pen);
  // Where no further flight begins, a rail along the landing's edge.
  const bool last = room.storey + 2 >= static_cast<int>(plan.spec.storeys);
  if (last) BuildRail({r.x0 + 0.05f, y_start - 0.04f, z1}, {xm, y_start - 0.04f, z1}, pen);
}

void BuildRamp(const PlanSlope& ramp, InteriorPen& pen) {
  const PlanRect r = ramp.rect.Inset(kHalfWall);
  pen.Start("ramp", "ground/parking");
  pen.Use(Finish::kDeck);
  const Vec3f a{r.x0, ramp.rect.y0, ramp.z0 + 0.005f}, b{r.x1, ramp.rect.y0, ramp.z0 + 0.005f}, c{r.x1, ramp.rect.y1, ramp.z1},
      d{r.x0, ramp.rect.y1, ramp.z1};
  pen.mesh().Quad(a, b, c, d);
  const Vec3f down{0, 0, -kSlab};
  pen.Use(Finish::kConcreteWall);
  pen.mesh().Quad(d + down, c + down, b + down, a + down);
  // Kerbs along both sides, and a line in the middle.
  for (const auto& [x0, x1, z, finish] :
       {std::tuple{r.x0, r.x0 + 0.25f, 0.15f, Finish::kConcreteWall}, {r.x1 - 0.25f, r.x1, 0.15f, Finish::kConcreteWall}}) {
    pen.Use(finish);
    const Vec3f up{0, 0, z};
    const Vec3f p{x0, a.y, a.z}, q{x1, a.y, a.z}, s{x1, c.y, c.z}, t{x0, c.y, c.z};
    pen.mesh().Quad(p + up, q + up, s + up, t + up);
    pen.mesh().Quad(q, s, s + up, q + up);
    pen.mesh().Quad(t, p, p + up, t + up);
    pen.mesh().Quad(p, q, q + up, p + up);
    pen.mesh().Quad(s, t, t + up, s + up);
  }
}

void BuildEscalator(const PlanSlope& e, InteriorPen& pen) {
  const PlanRect r = e.rect;
  const float flat = 1.2f, x0 = r.x0 + flat, x1 = r.x1 - flat, dz = e.z1 - e.z0, y0 = r.y0 + 0.28f, y1 = r.y1 - 0.28f;
  const auto z_at = [&](float x) { return e.z0 + dz * std::clamp((x - x0) / (x1 - x0), 0.0f, 1.0f); };
  pen.Start("escalator", "construction/escalator");
  pen.Use(Finish::kFrameSteel);
  const int steps = static_cast<int>((x1 - x0) / 0.4f);
  for (int i = 0; i < steps; ++i) {
    const float a = x0 + (x1 - x0) * static_cast<float>(i) / static_cast<float>(steps),
                b = x0 + (x1 - x0) * static_cast<float>(i + 1) / static_cast<float>(steps);
    pen.Box({a, y0, z_at(a) - 0.1f}, {b, y1, z_at(b)});
  }
  pen.Box({r.x0, y0, e.z0 - 0.02f}, {x0, y1, e.z0 + 0.02f});
  pen.Box({x1, y0, e.z1 - 0.3f}, {r.x1, y1, e.z1 + 0.005f});
  // Skirts, glass and handrails along both sides; the belly below.
  const float knots[4] = {r.x0 + 0.3f, x0, x1, r.x1};
  for (const auto& [near, far] : {std::pair{r.y0, y0}, {y1, r.y1}}) {
    const float y = (near + far) / 2;
    for (int k = 0; k < 3; ++k) {
      const Vec3f a{knots[k], y, z_at(knots[k])}, b{knots[k + 1], y, z_at(knots[k + 1])};
      const auto sheet = [&](float at, float from, float to) {
        pen.mesh().Quad(Vec3f{a.x, at, a.z + from}, Vec3f{b.x, at, b.z + from}, Vec3f{b.x, at, b.z + to}, Vec3f{a.x, at, a.z + to});
      };
      const auto back = [&](float at, float from, float to) {
        pen.mesh().Quad(Vec3f{b.x, at, b.z + from}, Vec3f{a.x, at, a.z + from}, Vec3f{a.x, at, a.z + to}, Vec3f{b.x, at, b.z + to});
      };
      pen.Use(Finish::kFrameSteel);
      sheet(near, -0.55f, 0.22f);
      back(far, -0.55f, 0.22f);
      pen.mesh().Quad(Vec3f{a.x, near, a.z + 0.22f}, Vec3f{b.x, near, b.z + 0.22f}, Vec3f{b.x, far, b.z + 0.22f},
                      Vec3f{a.x, far, a.z + 0.22f});
      pen.Use(Finish::kGlassTinted);
      sheet(y, 0.22f, 0.92f);
      pen.Use(Finish::kRubber);
      pen.mesh().Tube(a + Vec3f{0, 0, 0.95f}, b + Vec3f{0, 0, 0.95f}, 0.04f, 0.04f, 8);
    }
  }
  pen.Use(Finish::kFrameSteel);
  for (int k = 0; k < 3; ++k) {
    const float za = std::max(z_at(knots[k]) - 0.55f, e.z0 + 0.001f), zb = std::max(z_at(knots[k + 1]) - 0.55f, e.z0 + 0.001f);
    pen.mesh().Quad({knots[k], r.y1, za}, {knots[k + 1], r.y1, zb}, {knots[k + 1], r.y0, zb}, {knots[k], r.y0, za});
  }
}

}  // namespace

void BuildStairs(const InteriorPlan& plan, InteriorPen& pen) {
  for (const PlanStair& stair : plan.stairs) BuildStair(plan, stair, pen);
  for (const PlanSlope& ramp : plan.ramps) BuildRamp(ramp, pen);
  for (const PlanSlope& escalator : plan.escalators) BuildEscalator(escalator, pen);
}

}  // namespace airsim360::internal

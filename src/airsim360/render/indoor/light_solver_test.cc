#include "airsim360/render/indoor/light_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/archive.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/indoor/indoor_kernels.h"
#include "airsim360/render/indoor/plain_lamps.h"
#include "airsim360/render/indoor/test_rooms.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/scene/luminance.h"

namespace airsim360 {
namespace {

using internal::IndoorCache, internal::IndoorOptions, internal::LightLink, internal::LightSolver, internal::Surfel;
using test::RoomScene, test::SolvedRoom;

// Which face of a box a surfel lies on, as RoomScene numbers them.
int FaceOf(const Surfel& s) {
  const int axis = std::fabs(s.n.x) > 0.5f ? 0 : std::fabs(s.n.y) > 0.5f ? 1 : 2;
  return 2 * axis + (s.n[axis] < 0);
}

// Walls of one sheet have surfels on their outer sides, too.
bool FacesInwards(const Surfel& s, Vec3f middle) { return Dot(s.n, middle - s.p) > 0; }

// Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11: equal rectangles x by y facing each other at z.
double Parallel(double x, double y, double z) {
  const double a = x / z, b = y / z, p = 1 + a * a, q = 1 + b * b;
  return 2 / (kPi * a * b) *
         (0.5 * std::log(p * q / (p + b * b)) + a * std::sqrt(q) * std::atan(a / std::sqrt(q)) +
          b * std::sqrt(p) * std::atan(b / std::sqrt(p)) - a * std::atan(a) - b * std::atan(b));
}

// The same, C-14: from w by l to h by l with the common edge l, at a right angle.
double Perpendicular(double w, double h, double l) {
  const double a = h / l, b = w / l, aa = a * a, bb = b * b, s = aa + bb;
  const double logs =
      std::log((1 + bb) * (1 + aa) / (1 + s)) + bb * std::log(bb * (1 + s) / ((1 + bb) * s)) + aa * std::log(aa * (1 + s) / ((1 + aa) * s));
  return (b * std::atan(1 / b) + a * std::atan(1 / a) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) + 0.25 * logs) / (kPi * b);
}

TEST(LightSolver, LinksHaveTheFormFactorsOfParallelAndPerpendicularPlates) {
  const double size[3] = {4, 3, 2.5};
  RoomScene room("plates");
  room.Box({0, 0, 0}, {4, 3, 2.5f}, room.Paint({0.5f, 0.5f, 0.5f}));
  const SolvedRoom solved(room.Build(), {.cell = 0.12f, .fine = false});
  const auto& surfels = solved.solver.coarse().surfels();
  double share[6][6] = {}, area[6] = {};
  for (uint32_t i = 0; i < surfels.size(); ++i) {
    if (!FacesInwards(surfels[i], {2, 1.5f, 1.25f})) continue;
    const int from = FaceOf(surfels[i]);
    area[from] += surfels[i].area;
    solved.solver.ForLinks(i, [&](uint32_t target, double s) {
      if (target < surfels.size()) share[from][FaceOf(surfels[target])] += s * surfels[i].area;
    });
  }
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2;
    EXPECT_NEAR(area[f], size[(axis + 1) % 3] * size[(axis + 2) % 3], 0.005 * area[f]);
    for (int g = 0; g < 6; ++g) {
      if (f == g) {
        EXPECT_NEAR(share[f][g] / area[f], 0, 1e-3);
        continue;
      }
      const int other = g / 2, edge = 3 - axis - other;
      const double expected = axis == other ? Parallel(size[(axis + 1) % 3], size[(axis + 2) % 3], size[axis])
                                            : Perpendicular(size[other], size[axis], size[edge]);
      EXPECT_NEAR(share[f][g] / area[f], expected, 0.01 * expected) << f << " to " << g;
    }
  }
}

// Mean light of the walls of a room of 3 x 3 x 3 m.
double MeanOfFurnace(const SolvedRoom& solved) {
  double sum = 0, area = 0;
  const auto& surfels = solved.solver.coarse().surfels();
  for (size_t i = 0; i < surfels.size(); ++i) {
    if (!FacesInwards(surfels[i], {1.5f, 1.5f, 1.5f})) continue;
    sum += solved.solver.coarse_light().light[i].x * surfels[i].area;
    area += surfels[i].area;
  }
  return sum / area;
}

TEST(LightSolver, WhiteFurnaceHasTheSeriesOfItsBounces) {
  for (const float albedo : {0.0f, 0.5f, 0.8f}) {
    RoomScene room("furnace");
    room.Box({0, 0, 0}, {3, 3, 3}, room.Paint({albedo, albedo, albedo}, {1, 1, 1}));
    const SolvedRoom solved(room.Build(), {.cell = 0.3f, .lamp_rays = 256, .fine = false});
    // Even the black wall reflects a little, as its skin does.
    const float kept = internal::Reflectance(solved.tables).Of(0, {albedo, albedo, albedo}).x;
    EXPECT_NEAR(MeanOfFurnace(solved), kPi / (1 - kept), 0.005 * kPi / (1 - kept)) << albedo;
  }
}

// A pane mirrors what it does not let through: one that takes nothing changes nothing where all sides are alike.
TEST(LightSolver, PanesThatTakeNothingLeaveAFurnaceAsItIs) {
  RoomScene room("furnace with a pane");
  room.Box({0, 0, 0}, {3, 3, 3}, room.Paint({0, 0, 0}, {1, 1, 1}));
  Material glass;
  glass.name = "glass";
  glass.kind = SurfaceKind::kGlass, glass.base_color = {1, 1, 1}, glass.transmission = 1, glass.roughness = 0;
  room.Quad({1.4f, 0, 0}, {1.4f, 3, 0}, {1.4f, 3, 3}, {1.4f, 0, 3}, room.builder().AddMaterial(glass), "construction/window");
  const SolvedRoom solved(room.Build(), {.cell = 0.3f, .lamp_rays = 256, .fine = false});
  const double expected = kPi / (1 - internal::Reflectance(solved.tables).Of(0, {0, 0, 0}).x);
  // Of what glows in a pane the light that it gives back is left out.
  EXPECT_NEAR(MeanOfFurnace(solved), expected, 0.015 * expected);
}

// Light on the floor of a room 4 m long with a lamp, whose end at x = 4 m is a mirror, or half of one twice as long with two lamps.
double LightOfFloor(bool mirror) {
  RoomScene room("mirror");
  const MaterialId dark = room.Paint({0.1f, 0.1f, 0.1f}), lamp = room.Paint({0, 0, 0}, {10, 10, 10});
  room.Box({0, 0, 0}, {mirror ? 4.0f : 8.0f, 3, 2.5f}, dark, true, mirror ? 2 : 0);
  for (const float x : {1.0f, 7.0f})
    if (x < 4 || !mirror) room.Quad({x - 0.3f, 1, 2.4f}, {x - 0.3f, 2, 2.4f}, {x + 0.3f, 2, 2.4f}, {x + 0.3f, 1, 2.4f}, lamp);
  Material silver;
  silver.name = "silver";
  silver.base_color = {1, 1, 1}, silver.metallic = 1, silver.roughness = 0.02f;
  if (mirror) room.Quad({4, 0, 0}, {4, 0, 2.5f}, {4, 3, 2.5f}, {4, 3, 0}, room.builder().AddMaterial(silver));
  const SolvedRoom solved(room.Build(), {.cell = 0.15f, .fine = false});
  const auto& surfels = solved.solver.coarse().surfels();
  double sum = 0, area = 0;
  for (size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    if (s.n.z < 0.9f || s.p.z > 0.01f || s.p.x < 2 || s.p.x > 3.9f) continue;
    sum += (solved.solver.coarse_light().light[i].y + solved.solver.coarse_light().lamps[i].y) * s.area, area += s.area;
  }
  return sum / area;
}

TEST(LightSolver, AMirrorLightsARoomAsTheRoomBehindItWould) {
  const double expected = LightOfFloor(false);
  EXPECT_NEAR(LightOfFloor(true), expected, 0.015 * expected);
}

TEST(IndoorCache, FurnaceLooksTheSameAtEveryPointOfItsWalls) {
  RoomScene room("furnace");
  room.Box({0, 0, 0}, {3, 3, 3}, room.Paint({0.5f, 0.5f, 0.5f}, {1, 1, 1}));
  const SolvedRoom solved(room.Build(), {.cell = 0.3f, .lamp_rays = 256});
  const IndoorCache cache(solved.solver);
  static const auto look_up = AIRSIM360_SELECT_KERNEL(LookUpIndoors);
  const float kept = internal::Reflectance(solved.tables).Of(0, {0.5f, 0.5f, 0.5f}).x;
  RngStream rng(1, "walls");
  auto s = std::make_unique<internal::SurfaceSet>();
  auto light = std::make_unique<internal::IndoorLight>();
  double sum = 0;
  int rough = 0;
  for (int i = 0; i < internal::kBatch; ++i) {
    Vec3f p{static_cast<float>(rng.Uniform(0, 3)), static_cast<float>(rng.Uniform(0, 3)), static_cast<float>(rng.Uniform(0, 3))}, n;
    p[i % 3] = i % 2 ? 0.0f : 3.0f, n[i % 3] = i % 2 ? 1.0f : -1.0f;
    s->px[i] = p.x, s->py[i] = p.y, s->pz[i] = p.z;
    s->nx[i] = s->gx[i] = n.x, s->ny[i] = s->gy[i] = n.y, s->nz[i] = s->gz[i] = n.z;
  }
  look_up(cache.view(), *s, internal::kBatch, *light);
  const double expected = kPi / (1 - kept);
  for (int i = 0; i < internal::kBatch; ++i) {
    EXPECT_NEAR(light->share[i], 1, 1e-5);
    sum += light->g[i];
    rough += std::fabs(light->g[i] - expected) > 0.05 * expected;
    // What bounced light meets there is its share and the glow is not.
    const auto radiance = cache.RadianceAt({s->px[i], s->py[i], s->pz[i]}, {s->nx[i], s->ny[i], s->nz[i]});
    ASSERT_TRUE(radiance.has_value());
    EXPECT_NEAR(radiance->y, kept * expected / kPi, 0.7 * kept * expected / kPi);
  }
  EXPECT_NEAR(sum / internal::kBatch, expected, 0.005 * expected);
  EXPECT_LE(rough, 0);
}

// A tube a hand's breadth under a ceiling lights a patch narrower than a cell: all that it sends up arrives there.
TEST(LightSolver, CeilingsGetAllTheLightOfTubesJustBelowThem) {
  constexpr float kHigh = 2.4f, kBelow = 0.12f, kTube = 0.02f;
  RoomScene room("tubes");
  room.Box({0, 0, 0}, {6, 6, kHigh}, room.Paint({0, 0, 0}));
  const MaterialId glow = room.Paint({0, 0, 0}, {100, 100, 100});
  double sent = 0;
  for (int k = 0; k < 9; ++k) {
    const float x = 1.3f + 1.63f * static_cast<float>(k % 3), y = 1.2f + 1.71f * static_cast<float>(k / 3), z = kHigh - kBelow;
    room.Quad({x - 0.5f, y - kTube, z}, {x + 0.5f, y - kTube, z}, {x + 0.5f, y + kTube, z}, {x - 0.5f, y + kTube, z}, glow);
    sent += 100 * kPi * 1 * 2 * kTube;
  }
  const auto tracer = room.Build();
  for (const float cell : {0.12f, 0.2f}) {
    const SolvedRoom solved(tracer, {.cell = cell, .fine = false});
    const auto& surfels = solved.solver.coarse().surfels();
    double got = 0;
    for (size_t i = 0; i < surfels.size(); ++i)
      if (surfels[i].n.z < -0.9f && surfels[i].p.z > kHigh - 0.01f)
        got += surfels[i].area * (solved.solver.coarse_light().light[i].y + solved.solver.coarse_light().lamps[i].y);
    // Walls get up to two per cent.
    EXPECT_NEAR(got / sent, 0.99, 0.02) << cell;
  }
}

// Two rooms with a wall of 3 cm between them; only the first one has a lamp.
std::shared_ptr<const RayTracer> BrightBesideDark() {
  RoomScene rooms("two rooms");
  const MaterialId white = rooms.Paint({0.8f, 0.8f, 0.8f});
  rooms.Box({0, 0, 0}, {3, 3, 2.5f}, white);
  rooms.Box({3.03f, 0, 0}, {6, 3, 2.5f}, white);
  const MaterialId lamp = rooms.Paint({0, 0, 0}, {10, 10, 10});
  rooms.Quad({1, 1, 2.49f}, {1, 2, 2.49f}, {2, 2, 2.49f}, {2, 1, 2.49f}, lamp);
  return rooms.Build();
}

// A hall with a hundred small lamps, about as many as a surfel sends rays to them: floors are even all the same; the table's shade stays.
TEST(LightSolver, ManySmallLampsLeaveNoPatchesAndKeepTheirShadows) {
  RoomScene hall("hall");
  const MaterialId white = hall.Paint({0.7f, 0.7f, 0.7f}), glow = hall.Paint({0, 0, 0}, {900, 900, 900});
  hall.Box({0, 0, 0}, {10, 10, 3}, white);
  hall.Box({4, 4, 0.5f}, {6, 6, 0.55f}, white, false);
  for (int k = 0; k < 100; ++k) {
    const float x = 0.5f + static_cast<float>(k % 10), y = 0.5f + static_cast<float>(k / 10), r = 0.05f, z = 2.95f;
    hall.Quad({x - r, y - r, z}, {x - r, y + r, z}, {x + r, y + r, z}, {x + r, y - r, z}, glow);
  }
  const auto tracer = hall.Build();
  const internal::SurfaceTables tables(tracer->scene(), true);
  const internal::LightTable lights(tracer->scene(), tables, tracer->scene().environment);
  const internal::LampGrid grid(*tracer, lights, 0);
  ASSERT_GT(grid.lamps(), 0u);
  const internal::Enclosure enclosure(*tracer);
  const internal::IndoorWorld world{*tracer, tables, nullptr, &lights, &grid, nullptr};
  const LightSolver few(world, enclosure, {.cell = 0.25f, .rays = 16, .fine = false});
  const LightSolver many(world, enclosure, {.cell = 0.25f, .rays = 16, .lamp_rays = 2000, .fine = false});
  const auto& surfels = few.coarse().surfels();
  double squares = 0, sum = 0, expected = 0, shade = 0;
  int open = 0, shaded = 0;
  for (size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    if (s.n.z < 0.9f || s.p.z > 0.1f) continue;
    const double own = Luminance(few.coarse_light().lamps[i]), right = Luminance(many.coarse_light().lamps[i]);
    const auto within = [&](float from, float to) { return s.p.x > from && s.p.x < to && s.p.y > from && s.p.y < to; };
    if (within(4.6f, 5.4f)) shade += own, ++shaded;
    if (within(3, 7) || !within(1, 9)) continue;
    squares += std::pow(own / right - 1, 2), sum += own, expected += right, ++open;
  }
  ASSERT_GT(open, 300);
  ASSERT_GT(shaded, 4);
  RecordProperty("rms", std::to_string(std::sqrt(squares / open)));
  EXPECT_NEAR(sum / expected, 1, 0.01);
  EXPECT_LT(std::sqrt(squares / open), 0.015);
  EXPECT_LT(shade / shaded, 0.35 * sum / open);
}

// Two rooms with a door between them, a lamp in one, and next to both a closed hall with two hundred brighter ones: the floor behind the door has
// the light that 4,096 rays find, as even and with as sharp a shade beside it, although lamps of the hall are as near.
TEST(LightSolver, LampsBehindWallsTakeNoRaysFromThoseThatAreSeen) {
  RoomScene rooms("rooms");
  const MaterialId white = rooms.Paint({0.6f, 0.6f, 0.6f});
  rooms.Box({0, 0, 0}, {10, 6, 3}, white);
  rooms.Box({0, 6.1f, 0}, {10, 16, 3}, white);
  rooms.Box({4.95f, 0, 0}, {5.05f, 2.5f, 3}, white, false);
  rooms.Box({4.95f, 3.5f, 0}, {5.05f, 6, 3}, white, false);
  const auto hang = [&](float x, float y, MaterialId glow) {
    constexpr float kHalf = 0.1f, kHigh = 2.4f;
    rooms.Quad({x - kHalf, y - kHalf, kHigh}, {x - kHalf, y + kHalf, kHigh}, {x + kHalf, y + kHalf, kHigh}, {x + kHalf, y - kHalf, kHigh},
               glow);
  };
  hang(2.5f, 3, rooms.Paint({0, 0, 0}, {300, 300, 300}));
  const MaterialId bright = rooms.Paint({0, 0, 0}, {3000, 3000, 3000});
  for (int k = 0; k < 200; ++k) hang(0.5f + 0.47f * static_cast<float>(k % 20), 6.6f + 0.95f * static_cast<float>(k / 20), bright);
  const auto tracer = rooms.Build();
  const internal::SurfaceTables tables(tracer->scene(), true);
  const internal::LightTable lights(tracer->scene(), tables, tracer->scene().environment);
  const internal::LampGrid grid(*tracer, lights, 0);
  const internal::IndoorWorld world{*tracer, tables, nullptr, &lights, &grid, nullptr};
  const LightSolver solver(world, internal::Enclosure(*tracer), {.cell = 0.2f, .rays = 16, .fine = false});
  const auto& surfels = solver.coarse().surfels();
  std::vector<std::pair<double, double>> lights_of;  // own, right
  double most = 0;
  for (size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    if (s.n.z < 0.9f || s.p.z > 0.1f || s.p.x < 5.2f || s.p.x > 9.8f || s.p.y > 5.8f || s.p.y < 0.2f) continue;
    const double right = Luminance(internal::LampsAround(world, s.InPlane(), s.n, {nullptr, 4096, 0}, static_cast<uint32_t>(i)).held);
    lights_of.emplace_back(Luminance(solver.coarse_light().lamps[i]), right);
    most = std::max(most, right);
  }
  double lit = 0, lit_right = 0, shade = 0, squares = 0;
  int of_lit = 0, of_shade = 0;
  for (const auto& [own, right] : lights_of) {
    if (right > 0.2 * most) lit += own, lit_right += right, squares += std::pow(own / right - 1, 2), ++of_lit;
    if (right < 1e-3 * most) shade += own, ++of_shade;
  }
  ASSERT_GT(of_lit, 50);
  ASSERT_GT(of_shade, 200);
  RecordProperty("rms", std::to_string(std::sqrt(squares / of_lit)));
  RecordProperty("lit", std::to_string(lit / lit_right));
  RecordProperty("shade", std::to_string(shade / of_shade / (lit / of_lit)));
  EXPECT_LT(std::sqrt(squares / of_lit), 0.05);
  EXPECT_NEAR(lit / lit_right, 1, 0.02);
  EXPECT_LT(shade / of_shade, 0.01 * lit / of_lit);
}

TEST(LightSolver, NoLightGetsThroughAWallOfThreeCentimetres) {
  const SolvedRoom solved(BrightBesideDark(), {.rays = 64, .fine_rays = 16});
  double bright = 0, dark = 0;
  int of_bright = 0, of_dark = 0;
  const auto look = [&](const internal::SurfelSet& set, const internal::LevelLight& light) {
    for (size_t i = 0; i < set.surfels().size(); ++i) {
      const Vec3f p = set.surfels()[i].p;
      const double e = Luminance(light.light[i] + light.lamps[i]);
      if (p.x < 3.015f)
        bright += e, ++of_bright;
      else if (FacesInwards(set.surfels()[i], {4.5f, 1.5f, 1.25f}))
        dark += e, ++of_dark;
    }
  };
  look(solved.solver.coarse(), solved.solver.coarse_light());
  look(*solved.solver.fine(), solved.solver.fine_light());
  EXPECT_GT(of_dark, 500);
  EXPECT_GT(bright / of_bright, 1);
  EXPECT_LT(dark / of_dark, 2e-4 * bright / of_bright);
}

// A panel of light in a frame of 12 mm with a bevel of 4 mm towards it, as they hang in offices; its middle at (x, y).
void HangPanel(RoomScene& room, float x, float y, float ceiling) {
  const MaterialId frame = room.Paint({0.76f, 0.76f, 0.75f}), glow = room.Paint({0, 0, 0}, {12, 12, 12});
  const float out = 0.3f, in = 0.286f, low = ceiling - 0.012f, lens = ceiling - 0.008f;
  const auto at = [&](float a, float r, float z, int turn) {
    const Vec2f q[4] = {{a, r}, {-r, a}, {-a, -r}, {r, -a}};
    return Vec3f{x + q[turn].x, y + q[turn].y, z};
  };
  for (int k = 0; k < 4; ++k) {
    room.Quad(at(-out, out, ceiling, k), at(out, out, ceiling, k), at(out, out, low, k), at(-out, out, low, k), frame);
    room.Quad(at(-out, out, low, k), at(out, out, low, k), at(in, in, low, k), at(-in, in, low, k), frame);
    room.Quad(at(-in, in, low, k), at(in, in, low, k), at(in - 0.004f, in - 0.004f, lens, k), at(-in + 0.004f, in - 0.004f, lens, k),
              frame);
  }
  room.Quad({x - in, y + in, lens}, {x + in, y + in, lens}, {x + in, y - in, lens}, {x - in, y - in, lens}, glow);
}

// Light of the ceiling around such panels, at places of surfels in many ways.
TEST(IndoorCache, CeilingsBesideLampsLookAsTheyDoElsewhere) {
  constexpr float kHigh = 2.6f;
  RoomScene room("panels");
  room.Box({0, 0, 0}, {9.2f, 9.2f, kHigh}, room.Paint({0.6f, 0.6f, 0.6f}));
  std::vector<Vec2f> middles;
  for (int k = 0; k < 9; ++k) middles.push_back({1.5f + 3.03f * static_cast<float>(k % 3), 1.5f + 3.05f * static_cast<float>(k / 3)});
  for (const Vec2f m : middles) HangPanel(room, m.x, m.y, kHigh);
  const SolvedRoom solved(room.Build(), {.cell = 0.24f});
  const IndoorCache cache(solved.solver);
  static const auto look_up = AIRSIM360_SELECT_KERNEL(LookUpIndoors);
  auto s = std::make_unique<internal::SurfaceSet>();
  auto light = std::make_unique<internal::IndoorLight>();
  for (const Vec2f m : middles) {
    int count = 0;
    double far = 0;
    for (int k = 0; k < 64; ++k) {
      // 16 places 0.7 m from the middle, then 48 at 2 to 8 cm from the frame.
      const float along = -0.3f + 0.6f * (static_cast<float>(k / 4 % 4) + 0.5f) / 4;
      const float across = k < 16 ? 0.7f : 0.32f + 0.03f * static_cast<float>((k - 16) / 16);
      const Vec2f q[4] = {{along, across}, {-across, along}, {-along, -across}, {across, -along}};
      const size_t i = static_cast<size_t>(count++);
      s->px[i] = m.x + q[k % 4].x, s->py[i] = m.y + q[k % 4].y, s->pz[i] = kHigh;
      s->nx[i] = s->gx[i] = s->ny[i] = s->gy[i] = 0, s->nz[i] = s->gz[i] = -1;
    }
    look_up(cache.view(), *s, count, *light);
    for (int i = 0; i < 16; ++i) far += light->g[i] / 16;
    for (int i = 16; i < count; ++i) EXPECT_NEAR(light->g[i] / far, 1, 0.3) << s->px[i] - m.x << " " << s->py[i] - m.y;
  }
}

// What lies under a mat of 6 mm has no light, and the floor beside it does not count it as its own.
TEST(LightSolver, WhatSomethingLiesOnIsNoPartOfTheFloorBesideIt) {
  RoomScene room("mat");
  room.Box({0, 0, 0}, {3, 3, 2.4f}, room.Paint({0.6f, 0.6f, 0.6f}));
  room.Box({1, 1, 0.002f}, {2.1f, 1.8f, 0.006f}, room.Paint({0.2f, 0.2f, 0.2f}), false);
  const SolvedRoom solved(room.Build(), {.cell = 0.2f, .rays = 16, .fine = false});
  int looked = 0;
  for (const Surfel& s : solved.solver.coarse().surfels()) {
    if (s.n.z < 0.9f || s.p.z > 0.001f || !FacesInwards(s, {1.5f, 1.5f, 1.2f})) continue;
    for (int k = 0; k < s.point_count; ++k, ++looked) {
      const Vec3f p = s.points[k];
      EXPECT_FALSE(p.z < 0.001f && p.x > 1.001f && p.x < 2.099f && p.y > 1.001f && p.y < 1.799f) << p.x << " " << p.y;
    }
  }
  EXPECT_GT(looked, 500);
}

// A hall lit by one bright spot on a wall: what few rays find of it, its neighbours' rays have found for all of them.
TEST(LightSolver, SmoothingLosesNoLight) {
  RoomScene hall("hall");
  hall.Box({0, 0, 0}, {14, 4, 3}, hall.Paint({0.5f, 0.5f, 0.5f}));
  hall.Quad({0.3f, 1.8f, 1.3f}, {0.3f, 1.8f, 1.7f}, {0.3f, 2.2f, 1.7f}, {0.3f, 2.2f, 1.3f}, hall.Paint({0, 0, 0}, {200, 200, 200}));
  const auto tracer = hall.Build();
  const SolvedRoom few(tracer, {.cell = 0.25f, .rays = 64, .fine = false}), many(tracer, {.cell = 0.25f, .rays = 512, .fine = false});
  double own = 0, right = 0, error = 0;
  for (size_t i = 0; i < few.solver.coarse().surfels().size(); ++i) {
    const Surfel& s = few.solver.coarse().surfels()[i];
    if (s.p.x < 4 || !FacesInwards(s, {7, 2, 1.5f})) continue;
    const double a = Luminance(few.solver.coarse_light().light[i]) * s.area, b = Luminance(many.solver.coarse_light().light[i]) * s.area;
    own += a, right += b, error += std::fabs(a - b);
  }
  RecordProperty("share", std::to_string(own / right));
  RecordProperty("error", std::to_string(error / right));
  EXPECT_NEAR(own / right, 1, 0.02);
  EXPECT_LT(error / right, 0.1);
}

Bytes BytesOf(const IndoorCache& cache) {
  ArchiveWriter archive;
  IndoorCache::Visit(archive, cache);
  return archive.Take();
}

TEST(IndoorCache, IsTheSameWithAnyNumberOfThreadsAndWhenReadBack) {
  const auto tracer = BrightBesideDark();
  const IndoorOptions options{.cell = 0.25f, .rays = 32, .fine_rays = 8, .lamp_rays = 8};
  Bytes one, many;
  {
    const ThreadLimit limit(1);
    one = BytesOf(IndoorCache(SolvedRoom(tracer, options).solver));
  }
  {
    const ThreadLimit limit(3);
    many = BytesOf(IndoorCache(SolvedRoom(tracer, options).solver));
  }
  EXPECT_EQ(one, many);
  ArchiveReader reader(one);
  IndoorCache read;
  IndoorCache::Visit(reader, read);
  EXPECT_TRUE(read.Sound());
  EXPECT_EQ(BytesOf(read), one);
}

TEST(IndoorCache, NumbersThatDoNotFitAreNotSound) {
  const IndoorOptions options{.cell = 0.4f, .rays = 16, .lamp_rays = 4, .fine = false};
  const Bytes good = BytesOf(IndoorCache(SolvedRoom(BrightBesideDark(), options).solver));
  int refused = 0;
  for (size_t at = 0; at + 8 < good.size(); at += 997) {
    Bytes bad = good;
    for (size_t k = 0; k < 8; ++k) bad[at + k] = std::byte{0xff};
    ArchiveReader reader(bad);
    IndoorCache read;
    try {
      IndoorCache::Visit(reader, read);
      if (!read.Sound()) ++refused;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_FALSE(IndoorCache().view().coarse.surfels != nullptr && IndoorCache().coarse_size() > 0);
}

TEST(Enclosure, KnowsRoomsFromYards) {
  RoomScene closed("closed"), yard("yard");
  closed.Box({0, 0, 0}, {4, 4, 3}, closed.Paint({0.5f, 0.5f, 0.5f}));
  yard.Box({0, 0, 0}, {4, 4, 3}, yard.Paint({0.5f, 0.5f, 0.5f}), true, 1u << 5);
  const auto room = closed.Build(), open = yard.Build();
  EXPECT_TRUE(internal::Enclosure(*room).any());
  EXPECT_TRUE(internal::Enclosure(*room).Holds(*room, {2, 2, 1.5f}));
  EXPECT_FALSE(internal::Enclosure(*room).Holds(*room, {20, 2, 1.5f}));
  EXPECT_FALSE(internal::Enclosure(*open).any());
}

}  // namespace
}  // namespace airsim360

// How bright the lamps of the five buildings make their rooms, through the light that pixels are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/render/indoor/light_solver.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/scene/luminance.h"
#include "built_worlds.h"

namespace airsim360 {
namespace {

using namespace airsim360::internal;

struct Place {
  const char* world;
  const char* room;
  float low, high;     // height over the floor of what is measured, m
  double least, most;  // lx
  float cell;          // m, of the surfels
};

// Part of a room that is asked for, at most 14 m each way about its middle.
Box3f Part(const RoomOutline& room) {
  Box3f box;
  for (const Vec2f c : room.corners) box.Add(Vec3f{c.x, c.y, room.floor_z});
  const Vec3f middle = box.center(), most{7, 7, 0};
  return {Max(box.min, middle - most), Min(box.max, middle + most) + Vec3f{0, 0, room.ceiling_z - room.floor_z}};
}

bool Within(const Box3f& box, Vec3f p, float margin) {
  return p.x > box.min.x - margin && p.y > box.min.y - margin && p.z > box.min.z - margin && p.x < box.max.x + margin &&
         p.y < box.max.y + margin && p.z < box.max.z + margin;
}

std::vector<SurfacePiece> PiecesIn(const std::vector<SurfacePiece>& all, const Box3f& box) {
  std::vector<SurfacePiece> pieces;
  std::copy_if(all.begin(), all.end(), std::back_inserter(pieces),
               [&](const SurfacePiece& piece) { return Within(box, piece.corner[0], 0.5f); });
  return pieces;
}

// Mean illuminance of level surfaces in the part, half a metre from walls.
double Lux(const LightSolver& solver, const Box3f& box, float low, float high) {
  double light = 0, area = 0;
  const auto& surfels = solver.coarse().surfels();
  for (size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    const float z = s.p.z - box.min.z;
    if (s.n.z < 0.95f || z < low || z > high || !Within(box, {s.p.x, s.p.y, box.center().z}, -0.5f)) continue;
    light += static_cast<double>(Luminance(solver.coarse_light().light[i])) * static_cast<double>(s.area);
    area += static_cast<double>(s.area);
  }
  EXPECT_GT(area, 0.5);
  return light / area / static_cast<double>(kLux);
}

// EN 12464-1:2011: writing in offices 500 lx, sales areas 300, parking areas 75, store rooms 100, racks 150 … 200; homes have no
// norm (IES Lighting Handbook: 30 … 300 in living rooms). From the maintained value, rooms are between 0.6 and 3 times as bright.
TEST(InteriorLight, LampsGiveTheIlluminancesOfStandards) {
  const Place places[] = {{"apartment", "living_room", -0.03f, 0.03f, 30, 300, 0.25f},
                          {"office", "open_office", 0.65f, 0.85f, 300, 1500, 0.25f},
                          {"warehouse", "warehouse_hall", -0.03f, 0.03f, 60, 600, 0.5f},
                          {"mall", "shop", -0.03f, 0.03f, 180, 1500, 0.25f},
                          {"car_park", "parking_deck", -0.03f, 0.03f, 45, 225, 0.25f}};
  for (const Place& place : places) {
    const auto scene = Built(place.world);
    Environment night = scene->environment;
    night.lamps = Lamps::kOn;
    const RayTracer tracer(scene);
    const SurfaceTables tables(*scene, true);
    const LightTable lights(*scene, tables, night);
    const IndoorWorld world{tracer, tables, nullptr, &lights, nullptr, nullptr};
    const BuildingRooms rooms = *RoomsOfWorld(place.world, {});
    const auto room = std::find_if(rooms.rooms.begin(), rooms.rooms.end(), [&](const RoomOutline& r) { return r.type == place.room; });
    ASSERT_NE(room, rooms.rooms.end());
    const Box3f box = Part(*room);
    const auto pieces = PiecesIn(EnclosedPieces(world, Enclosure(tracer), Reflectance(tables)), box);
    const LightSolver solver(world, pieces, {.cell = place.cell, .rays = 16, .lamp_rays = 16, .fine = false});
    const double lux = Lux(solver, box, place.low, place.high);
    RecordProperty(place.world, std::to_string(lux));
    EXPECT_GE(lux, place.least) << place.world;
    EXPECT_LE(lux, place.most) << place.world;
  }
}

}  // namespace
}  // namespace airsim360

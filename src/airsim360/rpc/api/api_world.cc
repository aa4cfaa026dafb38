// Geography, lines of sight, voxels, wind, plots.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/session/vehicle_state.h"
#include "airsim360/rpc/wire/limits.h"
#include "airsim360/sim/wind_limit.h"

namespace airsim360 {
namespace {

using Text = const std::string&;

GeoPoint FromWire(const airsim::GeoPoint& point) {
  CheckPlaceOnEarth(point.latitude, point.longitude);
  return {point.latitude, point.longitude, point.altitude};
}

bool Sees(const Snapshot& now, Vec3d from_W, Vec3d to_W) {
  return !now.model->tracer->Occluded(VecCast<float>(from_W), VecCast<float>(to_W));
}

// Occupied cells of a box as a binvox file (Min and Zhang's format: runs of value and count; y fastest, then
// z, then x). A cell is occupied when a surface is within half its diagonal of its centre.
std::string Binvox(const RayTracer& tracer, Vec3d centre_W, Vec3u cells, double size) {
  std::string text = "#binvox 1\ndim " + std::to_string(cells.x) + " " + std::to_string(cells.z) + " " + std::to_string(cells.y) +
                     "\ntranslate 0 0 0\nscale 1\ndata\n";
  const auto reach = static_cast<float>(size * std::sqrt(3.0) / 2);
  char value = 0;
  uint8_t run = 0;
  const auto flush = [&] {
    if (run > 0) text += value, text += static_cast<char>(run);
    run = 0;
  };
  const auto offset = [&](uint32_t i, uint32_t n) { return (i + 0.5 - n / 2.0) * size; };
  for (uint32_t x = 0; x < cells.x; ++x) {
    for (uint32_t z = 0; z < cells.z; ++z) {
      for (uint32_t y = 0; y < cells.y; ++y) {
        // Grid x is north, y east, z up.
        const Vec3d p = centre_W + Vec3d{offset(y, cells.y), offset(x, cells.x), offset(z, cells.z)};
        const char occupied = tracer.Clearance(VecCast<float>(p), reach) < reach ? 1 : 0;
        if (occupied != value || run == 255) flush();
        value = occupied;
        ++run;
      }
    }
  }
  flush();
  return text;
}

bool CreateVoxelGrid(const Session& session, const Snapshot& now, const airsim::Vector3r& position, Vec3u sizes, float resolution,
                     Text file) {
  constexpr double kMostCells = 2e7;
  if (!(resolution > 0)) throw std::invalid_argument("res must be positive");
  const auto count = [&](uint32_t metres) { return std::ceil(metres / static_cast<double>(resolution)); };
  const Vec3d counts{count(sizes.x), count(sizes.y), count(sizes.z)};
  // Each of them too: none of one kind may hide any number of another.
  if (counts.x * counts.y * counts.z > kMostCells || std::max({counts.x, counts.y, counts.z}) > kMostCells) {
    throw std::invalid_argument("more than 20 million cells");
  }
  const Vec3u cells = VecCast<uint32_t>(counts);
  // Only where the server was started: a client must not write elsewhere.
  CheckFileName("output_file", file);
  const std::filesystem::path path(file);
  if (path.extension() != ".binvox") {
    throw std::invalid_argument("output_file: '" + file + "' does not end in .binvox");
  }
  const Vec3d centre_W = session.origin_W() + NedFromWorld(airsim::FromVector(position));
  WriteFileAtomically(path, Binvox(*now.model->tracer, centre_W, cells, resolution));
  return true;
}

void AddSightCalls(Api& api) {
  api.Picture("simTestLineOfSightToPoint", [](ImageService&, const SnapshotPointer& now, const airsim::GeoPoint& point, Text vehicle) {
    const Vec3d eye = now->state.vehicles[now->Find(vehicle)].motion.X_WB.p;
    return Sees(*now, eye, now->model->world.frame.ToWorld(FromWire(point)));
  });
  api.Picture("simTestLineOfSightBetweenPoints",
              [](ImageService&, const SnapshotPointer& now, const airsim::GeoPoint& a, const airsim::GeoPoint& b) {
                const GeoFrame& earth = now->model->world.frame;
                return Sees(*now, earth.ToWorld(FromWire(a)), earth.ToWorld(FromWire(b)));
              });
  api.Read("simGetWorldExtents", [&api](const Snapshot& now) {
    const Box3f& bounds = api.session().objects().scene().bounds;
    return std::vector<airsim::GeoPoint>{GeoPointOf(now, VecCast<double>(bounds.min)), GeoPointOf(now, VecCast<double>(bounds.max))};
  });
}

// A plot is counted, not shown: there is no window.
void AddPlot(WorldView& world, size_t things, bool is_persistent) {
  world.plots.drawn += things;
  if (is_persistent) world.plots.persistent += things;
  NoticeOnce("simPlot...: counted, not shown (there is no window)");
}

}  // namespace

void AddWorldCalls(Api& api) {
  AddSightCalls(api);
  api.Change("simSetWind", [](Session& s, const airsim::Vector3r& wind) {
    CheckWind(airsim::FromVector(wind));
    const Vec3d wind_W = NedFromWorld(airsim::FromVector(wind));
    s.state().wind_W = wind_W;
  });
  api.Picture("simCreateVoxelGrid", [](ImageService& images, const SnapshotPointer& now, const airsim::Vector3r& position, uint32_t x,
                                       uint32_t y, uint32_t z, float resolution, Text file) {
    return CreateVoxelGrid(images.session(), *now, position, {x, y, z}, resolution, file);
  });
}

void AddPlotCalls(Api& api) {
  using Points = const std::vector<airsim::Vector3r>&;
  using Color = const std::vector<float>&;
  for (const char* name : {"simPlotPoints", "simPlotLineStrip", "simPlotLineList"}) {
    api.Change(name, [](Session& s, Points points, Color, float, airsim::Seconds, bool is_persistent) {
      AddPlot(s.world(), points.size(), is_persistent);
    });
  }
  api.Change("simPlotArrows", [](Session& s, Points from, Points, Color, float, float, airsim::Seconds, bool is_persistent) {
    AddPlot(s.world(), from.size(), is_persistent);
  });
  api.Change("simPlotStrings", [](Session& s, const std::vector<std::string>& texts, Points, float, Color, airsim::Seconds) {
    AddPlot(s.world(), texts.size(), false);
  });
  api.Change("simPlotTransforms", [](Session& s, const std::vector<airsim::Pose>& poses, float, float, airsim::Seconds,
                                     bool is_persistent) { AddPlot(s.world(), poses.size(), is_persistent); });
  api.Change("simPlotTransformsWithNames", [](Session& s, const std::vector<airsim::Pose>& poses, const std::vector<std::string>&, float,
                                              float, float, Color, airsim::Seconds) { AddPlot(s.world(), poses.size(), false); });
  api.Change("simFlushPersistentMarkers", [](Session& s) { s.world().plots.persistent = 0; });
  api.Read("simSetTraceLine", [](const Snapshot& now, Color, float, Text vehicle) {
    now.Find(vehicle);
    NoticeOnce("simSetTraceLine: there is no window to show it");
  });
}

}  // namespace airsim360

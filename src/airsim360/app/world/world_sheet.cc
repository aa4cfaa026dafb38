#include "airsim360/app/world/world_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/random.h"
#include "airsim360/eval/panorama_statistics.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/color.h"
#include "airsim360/image/draw.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/trace/surface_entity.h"
#include "airsim360/worlds/survey/world_survey.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

bool OnGround(const Scene& scene, const SurfaceRef& surface) {
  return scene.tree[scene.entity(EntityAt(scene, surface)).category].path.starts_with("ground/");
}

// Open places near the spawn: nothing but ground below, air around at every height.
std::vector<Vec3f> ChoosePlaces(Stage& stage, const SheetArguments& arguments, uint64_t seed) {
  const Scene& scene = stage.scene();
  const Vec3f spawn = FirstViewpoint(scene);
  RngStream rng(seed, "world sheet");
  std::vector<Vec3f> places;
  for (int tries = 0; tries < 4000 && static_cast<int>(places.size()) < arguments.poses; ++tries) {
    const double reach = 25 + 110.0 * static_cast<double>(places.size()) / arguments.poses;
    const Vec3f p{spawn.x + static_cast<float>(rng.Uniform(-reach, reach)), spawn.y + static_cast<float>(rng.Uniform(-reach, reach)), 0};
    const auto below = stage.tracer()->Intersect({p.x, p.y, spawn.z + 300}, {0, 0, -1});
    if (!below) continue;
    const float ground = spawn.z + 300 - below->distance;
    if (scene.sky_entity != kNoEntity && !OnGround(scene, below->surface)) continue;
    if (std::abs(ground) > 3 && scene.sky_entity != kNoEntity) continue;
    const bool clear = std::all_of(arguments.heights.begin(), arguments.heights.end(), [&](double h) {
      const float room = h < 3 ? 0.9f : 2.5f;
      return stage.tracer()->Clearance({p.x, p.y, ground + static_cast<float>(h)}, room) >= room;
    });
    const bool apart = std::all_of(places.begin(), places.end(), [&](Vec3f q) { return std::hypot(p.x - q.x, p.y - q.y) > 9; });
    if (clear && apart) places.push_back({p.x, p.y, ground});
  }
  return places;
}

// Means over the sphere of one or more panoramas.
struct PictureFigures {
  double weight = 0, luminance = 0, albedo = 0, albedo_weight = 0, dark = 0, bright = 0, void_pixels = 0;
  double frames = 0, albedo_errors = 0;
  PanoramaStatistics statistics;  // sums

  void Add(const Frame& frame) {
    const int h = frame.rgb.height();
    const PanoramaStatistics s = MeasurePanorama(frame.rgb);
    statistics = {statistics.slope + s.slope, statistics.flat + s.flat, statistics.gradient + s.gradient, statistics.entropy + s.entropy};
    frames += 1;
    for (int y = 0; y < h; ++y) {
      const double w = std::cos(std::numbers::pi * ((y + 0.5) / h - 0.5));
      for (int x = 0; x < frame.rgb.width(); ++x) {
        const Rgb8 c = frame.rgb(x, y);
        weight += w;
        luminance += w * (0.2126 * SrgbToLinear(c.r) + 0.7152 * SrgbToLinear(c.g) + 0.0722 * SrgbToLinear(c.b));
        dark += w * (std::max({c.r, c.g, c.b}) < 5);
        bright += w * (std::max({c.r, c.g, c.b}) > 250);
        void_pixels += frame.semantic(x, y) == kVoid || frame.entity(x, y) == kNoEntity;
        if (frame.range(x, y) <= 0) continue;
        const Rgb32f a = frame.albedo(x, y);
        if (!(std::min({a.r, a.g, a.b}) >= 0 && std::max({a.r, a.g, a.b}) <= 1)) {
          ++albedo_errors;
          continue;
        }
        albedo += w * (0.2126 * a.r + 0.7152 * a.g + 0.0722 * a.b);
        albedo_weight += w;
      }
    }
  }
  nlohmann::ordered_json Json() const {
    return {{"mean_luminance", luminance / weight},
            {"mean_albedo", albedo / std::max(albedo_weight, 1e-9)},
            {"below_5", dark / weight},
            {"above_250", bright / weight},
            {"unlabelled_pixels", void_pixels},
            {"albedo_errors", albedo_errors},
            {"slope", statistics.slope / frames},
            {"flat", statistics.flat / frames},
            {"gradient", statistics.gradient / frames},
            {"entropy", statistics.entropy / frames}};
  }
};

void CheckSheet(const SheetArguments& arguments, bool jpeg) {
  if (!jpeg && fs::path(arguments.out).extension() != ".png") throw InputError("--out: '" + arguments.out + "': give a .jpg or .png file");
  if (arguments.poses < 1 || arguments.poses > 64) throw InputError("--poses: " + std::to_string(arguments.poses) + " is not in 1 … 64");
  if (arguments.width < 128 || arguments.width > 2048 || arguments.width % 4)
    throw InputError("--width: " + std::to_string(arguments.width) + " is not a multiple of 4 in 128 … 2048");
  CheckRenderSettings(arguments.picture, "--");
}

/// Pictures of all places (rows) from all heights (columns), and what they show.
struct Sheet {
  Image<Rgb8> picture;
  std::vector<PictureFigures> by_height;
  PictureFigures all;
  std::map<CategoryId, size_t> most_visible;  // entities of a category in one picture, at most
  double render_ms = 0;

  void Count(const Frame& frame, size_t height) {
    by_height[height].Add(frame);
    all.Add(frame);
    std::map<CategoryId, std::set<EntityId>> seen;
    for (int y = 0; y < frame.semantic.height(); ++y)
      for (int x = 0; x < frame.semantic.width(); ++x) seen[frame.semantic(x, y)].insert(frame.entity(x, y));
    for (const auto& [category, entities] : seen) most_visible[category] = std::max(most_visible[category], entities.size());
  }
};

Sheet DrawSheet(Stage& stage, const SheetArguments& arguments, const std::vector<Vec3f>& places, uint64_t seed) {
  const int w = arguments.width, h = w / 2, gap = 4;
  const int columns = static_cast<int>(arguments.heights.size()), rows = static_cast<int>(places.size());
  Sheet sheet;
  sheet.picture = Image<Rgb8>(columns * (w + gap) + gap, rows * (h + gap) + gap);
  sheet.by_height.resize(arguments.heights.size());
  Frame frame;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3f p = places[static_cast<size_t>(row)];
      const double z = p.z + arguments.heights[static_cast<size_t>(column)];
      RenderRequest request{arguments.picture, Equirectangular{w, h}, BodyPose({p.x, p.y, z}, 0.6 * row, 0, 0) * CameraInBody()};
      request.products.albedo = true;
      request.seed = seed;
      sheet.render_ms += stage.renderer(request.tier).Render(request, frame).render_ms;
      sheet.Count(frame, static_cast<size_t>(column));
      const int left = gap + column * (w + gap), top = gap + row * (h + gap);
      Blit(frame.rgb, left, top, sheet.picture);
      char text[64];
      std::snprintf(text, sizeof text, "%.0f %.0f %.1f", static_cast<double>(p.x), static_cast<double>(p.y), z);
      DrawText(text, left + 4, top + 4, {255, 255, 255}, 1, sheet.picture);
    }
  }
  return sheet;
}

nlohmann::ordered_json HeightsJson(const Sheet& sheet, const std::vector<double>& heights) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (size_t i = 0; i < heights.size(); ++i) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", heights[i]);
    json[text] = sheet.by_height[i].Json();
  }
  json["all"] = sheet.all.Json();
  return json;
}

nlohmann::ordered_json VisibleJson(const Sheet& sheet, const Scene& scene) {
  std::map<std::string, size_t> by_path;
  for (const auto& [category, count] : sheet.most_visible) by_path[scene.tree[category].path] = count;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [path, count] : by_path) json[path] = count;
  return json;
}

}  // namespace

void RunWorldSheet(const SheetArguments& arguments, const GlobalOptions& globals) {
  const fs::path out = arguments.out;
  const bool jpeg = out.extension() == ".jpg" || out.extension() == ".jpeg";
  CheckSheet(arguments, jpeg);
  Stage stage(StageOptionsOf(arguments.world, globals));
  const std::vector<Vec3f> places = ChoosePlaces(stage, arguments, globals.seed);
  if (places.empty()) throw RuntimeError(arguments.world + ": no open place found around the spawn");
  const Sheet sheet = DrawSheet(stage, arguments, places, globals.seed);
  if (out.has_parent_path()) CreateWritableFolder(out.parent_path());
  WriteFileAtomically(out, jpeg ? EncodeJpeg(sheet.picture, 82) : EncodePng(sheet.picture));

  const nlohmann::ordered_json by_height = HeightsJson(sheet, arguments.heights);
  const double render_ms = sheet.render_ms / static_cast<double>(places.size() * arguments.heights.size());
  if (globals.json) {
    PrintJson({{"out", out.string()},
               {"places", places.size()},
               {"heights", by_height},
               {"most_visible_entities", VisibleJson(sheet, stage.scene())},
               {"render_ms", render_ms},
               {"load_ms", 1e3 * stage.load_seconds()},
               {"peak_rss_mib", PeakRssMib()}});
    return;
  }
  std::printf("%s: %zu places, %.0f ms a frame, world ready in %.1f s\n", out.c_str(), places.size(), render_ms, stage.load_seconds());
  for (const auto& [height, figure] : by_height.items()) std::printf("  %s m: %s\n", height.c_str(), figure.dump().c_str());
}

}  // namespace airsim360

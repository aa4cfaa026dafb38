// Light of rooms: tier `high` against `reference` in a building, by day or night. Draws places in its rooms, renders both and
// prints by kind of surface the ratio of mean light, what the reference's own noise makes of it, and the error of single pixels
// (relMSE) without that noise: two references of other seeds err independently.
// Usage: room_light [--world NAME] [--weather NAME] [--poses N] [--width W] [--paths N] [--out DIR]
// --keep DIR keeps references, so that a later call with the same rooms and numbers measures `high` alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/base/random.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/luminance.h"
#include "arguments.h"

namespace {

using namespace airsim360;

enum Kind { kWalls, kFloor, kCeiling, kThings, kAll, kKinds };
constexpr const char* kKindNames[] = {"walls", "floor", "ceiling", "things", "all"};
constexpr int kNone = -1;

// By the square root of the area of rooms: halls count more than closets, but not all.
Vec3d DrawPlace(const BuildingRooms& rooms, const RayTracer& tracer, RngStream& random) {
  double whole = 0;
  for (const RoomOutline& room : rooms.rooms) whole += std::sqrt(room.area_m2);
  for (;;) {
    double at = random.Uniform(0.0, whole);
    const RoomOutline* room = &rooms.rooms.front();
    for (const RoomOutline& r : rooms.rooms) {
      room = &r;
      if ((at -= std::sqrt(r.area_m2)) < 0) break;
    }
    const Vec3d p{random.Uniform(static_cast<double>(room->corners[0].x), static_cast<double>(room->corners[2].x)),
                  random.Uniform(static_cast<double>(room->corners[0].y), static_cast<double>(room->corners[2].y)),
                  static_cast<double>(room->floor_z) + 1.5};
    // Not inside of racks and shafts: something must be seen below.
    const Vec3f from = VecCast<float>(p);
    const auto below = tracer.Intersect(from, {0, 0, -1});
    if (below && below->distance < 1.6f && tracer.Clearance(from, 0.5f) >= 0.4f) return p;
  }
}

int KindOf(const Scene& scene, const BuildingRooms& rooms, const Frame& frame, int x, int y) {
  if (!(frame.range(x, y) > 0)) return kNone;
  const Vec3f n = frame.normal(x, y), p = frame.position(x, y);
  if (rooms.RoomAt(VecCast<double>(p + n * 0.02f)) == nullptr) return kNone;
  const Material& material = scene.materials[frame.material(x, y) - 1];
  if (material.emission != Vec3f{} || material.kind == SurfaceKind::kGlass) return kNone;
  const std::string& path = scene.tree[frame.semantic(x, y)].path;
  if (path.starts_with("construction/wall") || path.starts_with("construction/column")) return kWalls;
  if (path.starts_with("ground/")) return kFloor;
  if (path.starts_with("construction/ceiling")) return kCeiling;
  return kThings;
}

// Of pixels that show one kind alone: the reference's rays fill pixels, and a tube that a pixel's middle misses would outshine the
// ceiling around it.
Image<int> KindsOf(const Scene& scene, const BuildingRooms& rooms, Renderer& renderer, const RenderRequest& coarse, int width) {
  constexpr int kFiner = 8;
  RenderRequest request = coarse;
  request.camera = Equirectangular{width * kFiner, width * kFiner / 2};
  request.tier = Tier::kLabels;
  request.products.radiance = false;
  Frame fine;
  renderer.Render(request, fine);
  Image<int> kinds(width, width / 2);
  for (int y = 0; y < width / 2; ++y)
    for (int x = 0; x < width; ++x) {
      const int kind = KindOf(scene, rooms, fine, x * kFiner, y * kFiner);
      bool one = true;
      for (int k = 1; k < kFiner * kFiner && one; ++k)
        one = KindOf(scene, rooms, fine, x * kFiner + k % kFiner, y * kFiner + k / kFiner) == kind;
      kinds(x, y) = one ? kind : kNone;
    }
  return kinds;
}

// Pixels of one surface with all of their neighbours.
bool Inner(const Frame& frame, int x, int y) {
  const int w = frame.entity.width(), h = frame.entity.height();
  for (int k = 0; k < 9; ++k) {
    const int i = (x + k % 3 - 1 + w) % w, j = std::clamp(y + k / 3 - 1, 0, h - 1);
    if (frame.entity(i, j) != frame.entity(x, y) || Dot(frame.normal(i, j), frame.normal(x, y)) < 0.95f ||
        frame.material(i, j) != frame.material(x, y))
      return false;
  }
  return true;
}

struct Sums {
  double weight = 0, high = 0, a = 0, b = 0, inner = 0, error = 0;
};
using Table = std::array<Sums, kKinds>;

using Light = Image<Rgb32f>;

double Lum(const Rgb32f& c) { return Luminance({c.r, c.g, c.b}); }

// Means over the pixels beside one of the same kind.
double LocalMean(const Light& a, const Light& b, const Image<int>& kinds, int x, int y) {
  double sum = 0, count = 0;
  for (int k = 0; k < 25; ++k) {
    const int i = (x + k % 5 - 2 + a.width()) % a.width(), j = std::clamp(y + k / 5 - 2, 0, a.height() - 1);
    if (kinds(i, j) != kinds(x, y)) continue;
    sum += (Lum(a(i, j)) + Lum(b(i, j))) / 2, count += 1;
  }
  return sum / count;
}

void Compare(const Frame& high, const Light& a, const Light& b, const Image<int>& kinds, Table& table) {
  Table own;
  const auto weight = [&](int y) { return std::cos((0.5 - (y + 0.5) / a.height()) * M_PI); };
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      if (kinds(x, y) == kNone) continue;
      for (int k : {kinds(x, y), static_cast<int>(kAll)}) {
        Sums& s = own[static_cast<size_t>(k)];
        s.weight += weight(y), s.high += weight(y) * Lum(high.radiance(x, y));
        s.a += weight(y) * Lum(a(x, y)), s.b += weight(y) * Lum(b(x, y));
      }
    }
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      if (kinds(x, y) == kNone || !Inner(high, x, y)) continue;
      const Sums& kind = own[static_cast<size_t>(kinds(x, y))];
      const double mean = LocalMean(a, b, kinds, x, y), whole = (kind.a + kind.b) / (2 * kind.weight);
      const double h = Lum(high.radiance(x, y));
      const double error = (h - Lum(a(x, y))) * (h - Lum(b(x, y))) / (mean * mean + 0.01 * whole * whole);
      for (int k : {kinds(x, y), static_cast<int>(kAll)}) {
        Sums& s = own[static_cast<size_t>(k)];
        s.inner += weight(y), s.error += weight(y) * error;
      }
    }
  for (size_t k = 0; k < kKinds; ++k) {
    Sums& s = table[k];
    const Sums& o = own[k];
    s.weight += o.weight, s.high += o.high, s.a += o.a, s.b += o.b, s.inner += o.inner, s.error += o.error;
  }
}

// By material, those that take most of the light that is amiss first.
using Materials = std::map<std::string, Sums>;
void Add(const Scene& scene, const Frame& high, const Light& a, const Light& b, const Image<int>& kinds, Materials& materials) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      if (kinds(x, y) == kNone) continue;
      const double weight = std::cos((0.5 - (y + 0.5) / a.height()) * M_PI);
      Sums& s = materials[scene.materials[high.material(x, y) - 1].name];
      s.weight += weight, s.high += weight * Lum(high.radiance(x, y));
      s.a += weight * Lum(a(x, y)), s.b += weight * Lum(b(x, y));
    }
}
void Print(const Materials& materials) {
  std::vector<std::pair<std::string, Sums>> order(materials.begin(), materials.end());
  const auto amiss = [](const Sums& s) { return std::fabs(s.high - (s.a + s.b) / 2); };
  std::sort(order.begin(), order.end(), [&](const auto& x, const auto& y) { return amiss(x.second) > amiss(y.second); });
  double whole = 0;
  for (const auto& [name, s] : order) whole += (s.a + s.b) / 2;
  for (const auto& [name, s] : order)
    std::printf("  %-28s %5.1f %% of the light, %.3f ±%.3f\n", name.c_str(), 50 * (s.a + s.b) / whole, 2 * s.high / (s.a + s.b),
                std::fabs(s.a - s.b) / (s.a + s.b));
}

void Print(const char* name, const Table& table) {
  std::printf("%s", name);
  for (size_t k = 0; k < kKinds; ++k) {
    const Sums& s = table[k];
    if (s.weight == 0) continue;
    const double reference = (s.a + s.b) / 2;
    std::printf(" | %s %.3f ±%.3f relMSE %.4f", kKindNames[k], s.high / reference, std::fabs(s.a - s.b) / (2 * reference),
                s.inner > 0 ? s.error / s.inner : 0.0);
  }
  std::printf("\n");
  std::fflush(stdout);
}

// From the file, or rendered and kept there.
void Reference(Renderer& renderer, RenderRequest request, const std::string& file, Light& light, Image<Rgb8>* shown) {
  const auto bytes = static_cast<size_t>(light.width()) * light.height() * sizeof(Rgb32f);
  if (!file.empty() && std::filesystem::exists(file) && std::filesystem::file_size(file) == bytes) {
    const auto text = ReadFile(file);
    std::memcpy(&light(0, 0), text.data(), bytes);
    return;
  }
  Frame frame;
  renderer.Render(request, frame);
  light = frame.radiance;
  if (!file.empty()) WriteFileAtomically(file, std::string_view(reinterpret_cast<const char*>(&light(0, 0)), bytes));
  if (shown != nullptr) *shown = frame.rgb;
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "192"))) / 2 * 2;
  const int paths = std::max(1, std::atoi(Argument(argc, argv, "--paths", "256"))), poses = std::atoi(Argument(argc, argv, "--poses", "4"));
  const std::string world = Argument(argc, argv, "--world", "apartment"), weather = Argument(argc, argv, "--weather", "day");
  const std::string keep = Argument(argc, argv, "--keep", ""), out = Argument(argc, argv, "--out", "");
  const WorldRequest asked{.world = world};
  const std::optional<BuildingRooms> rooms = RoomsOf(asked);
  if (!rooms) {
    std::fprintf(stderr, "%s has no rooms\n", world.c_str());
    return 2;
  }
  const auto scene = LoadWorld(asked);
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh, .environment = ParseEnvironmentPreset(weather, scene->environment)});
  for (const std::string& folder : {keep, out})
    if (!folder.empty()) CreateWritableFolder(folder);
  RngStream random(0, "room light");
  Table table;
  Materials materials;
  for (int k = 0; k < poses; ++k) {
    const Vec3d p = DrawPlace(*rooms, *tracer, random);
    RenderRequest request = MakeRequest(Equirectangular{width, width / 2}, BodyPose(p, 0, 0, 0) * CameraInBody(), Tier::kHigh,
                                        {.normal = true, .position = true, .material = true, .radiance = true});
    Frame high;
    renderer->Render(request, high);
    const Image<int> kinds = KindsOf(*scene, *rooms, *renderer, request, width);
    const std::string name = world + "_" + weather + "_" + std::to_string(k);
    Light light[2] = {Light(width, width / 2), Light(width, width / 2)};
    Image<Rgb8> shown;
    request.tier = Tier::kReference, request.samples = paths;
    for (int half = 0; half < 2; ++half) {
      request.seed = static_cast<uint64_t>(half);
      Reference(*renderer, request,
                keep.empty()
                    ? ""
                    : keep + "/" + name + "_" + std::to_string(width) + "_" + std::to_string(paths) + "_" + std::to_string(half) + ".f32",
                light[half], half == 0 ? &shown : nullptr);
    }
    Table own;
    Compare(high, light[0], light[1], kinds, own);
    Compare(high, light[0], light[1], kinds, table);
    Add(*scene, high, light[0], light[1], kinds, materials);
    const RoomOutline* room = rooms->RoomAt(p);
    char text[200];
    std::snprintf(text, sizeof text, "%s %.2f,%.2f,%.2f %s", name.c_str(), p.x, p.y, p.z, room != nullptr ? room->name.c_str() : "");
    Print(text, own);
    if (out.empty()) continue;
    WriteFileAtomically(out + "/" + name + "_high.png", EncodePng(high.rgb));
    if (shown.width() > 0) WriteFileAtomically(out + "/" + name + "_reference.png", EncodePng(shown));
  }
  Print((world + " " + weather).c_str(), table);
  Print(materials);
}

// How close a frame of labels comes to the limit: bare Embree traversal of the same rays.
//
// World: terrain and towers, at least two million triangles in one mesh, an entity for each tower; with
// --trees also instanced trees (no alpha). One panorama is rendered by
//   raw16   rtcIntersect16 with COHERENT, the same rays in the same packets, nothing kept but a checksum
//   raw1    rtcIntersect1, the same rays in the same tiles
//   labels  our renderer: range, semantic, entity, normal
//   ids     our renderer: range, semantic, entity
// in alternating rounds, on one thread and on all; the table shows medians and ratios. All scenes are built
// with ROBUST and the same build quality. Compare ratios, not milliseconds.
#include <embree3/rtcore.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/render/renderer.h"
#include "median.h"
#include "scenes.h"

namespace {

using namespace airsim360;
using Clock = std::chrono::steady_clock;

struct Options {
  int width = 2048, rounds = 9, trees = 0;
  long triangles = 2'000'000;
  bool json = false;
  std::string isa;  // Embree's instruction set, for both sides; empty = the best of this machine
};

constexpr Vec3d kEye{0, 0, 30};

// The same scene handed to Embree with nothing around it.
class RawScene {
 public:
  RawScene(const Scene& scene, const std::string& isa)
      : device_(rtcNewDevice(isa.empty() ? nullptr : ("isa=" + isa).c_str())), scene_(NewScene()) {
    std::vector<RTCScene> subs(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
      RTCScene& sub = subs[instance.mesh];
      if (instance.X_WM == AffineTransform()) {
        Attach(scene_, scene.meshes[instance.mesh]);
        continue;
      }
      if (sub == nullptr) {
        Attach(sub = NewScene(), scene.meshes[instance.mesh]);
        rtcCommitScene(sub);
      }
      RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
      const Mat3f& A = instance.X_WM.A;
      const Vec3f columns[4] = {A.column(0), A.column(1), A.column(2), instance.X_WM.p};
      rtcSetGeometryInstancedScene(g, sub);
      rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
      rtcCommitGeometry(g);
      rtcAttachGeometry(scene_, g);
      rtcReleaseGeometry(g);
    }
    rtcCommitScene(scene_);
    for (RTCScene sub : subs) {
      if (sub != nullptr) rtcReleaseScene(sub);
    }
  }
  ~RawScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RTCScene get() const { return scene_; }

 private:
  RTCScene NewScene() {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
  }
  void Attach(RTCScene scene, const Mesh& mesh) {
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size() + 1);
    std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * 12);
    void* indices = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * 12);
    rtcSetGeometryBuildQuality(g, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
  }
  RTCDevice device_;
  RTCScene scene_;
};

// Directions of a level panorama that faces east, separable as in the renderer.
struct RayTables {
  int width, height;
  std::vector<float> sin_theta, cos_theta, sin_phi, cos_phi;
  explicit RayTables(int w) : width(w), height(w / 2) {
    for (int x = 0; x < width; ++x) {
      const double theta = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
      sin_theta.push_back(static_cast<float>(std::sin(theta)));
      cos_theta.push_back(static_cast<float>(std::cos(theta)));
    }
    for (int y = 0; y < height; ++y) {
      const double phi = std::numbers::pi * (0.5 - (y + 0.5) / height);
      sin_phi.push_back(static_cast<float>(std::sin(phi)));
      cos_phi.push_back(static_cast<float>(std::cos(phi)));
    }
  }
};

RTCIntersectContext Coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

// Sum of distances of a tile, so that nothing is optimised away.
float Raw16(RTCScene scene, const RayTables& t, int column, int row) {
  RTCIntersectContext context = Coherent();
  alignas(64) int valid[16];
  std::fill(valid, valid + 16, -1);
  RTCRayHit16 r;
  for (int k = 0; k < 16; ++k) {
    r.ray.org_x[k] = static_cast<float>(kEye.x);
    r.ray.org_y[k] = static_cast<float>(kEye.y);
    r.ray.org_z[k] = static_cast<float>(kEye.z);
    r.ray.tnear[k] = r.ray.time[k] = 0;
    r.ray.mask[k] = ~0u;
    r.ray.id[k] = r.ray.flags[k] = 0;
  }
  const bool rows = std::abs(0.5 - (row + 8.0) / t.height) > 1.0 / 3;
  float sum = 0;
  for (int p = 0; p < 16; ++p) {
    const int x0 = column + (rows ? 0 : (p & 3) * 4), y0 = row + (rows ? p : (p >> 2) * 4);
    for (int k = 0; k < 16; ++k) {
      const int x = x0 + (rows ? k : k & 3), y = y0 + (rows ? 0 : k >> 2);
      r.ray.dir_x[k] = t.cos_phi[y] * t.cos_theta[x];
      r.ray.dir_y[k] = -t.cos_phi[y] * t.sin_theta[x];
      r.ray.dir_z[k] = t.sin_phi[y];
      r.ray.tfar[k] = INFINITY;
      r.hit.geomID[k] = r.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene, &context, &r);
    for (int k = 0; k < 16; ++k) sum += r.ray.tfar[k] < 1e9f ? r.ray.tfar[k] : 0;
  }
  return sum;
}

float Raw1(RTCScene scene, const RayTables& t, int column, int row) {
  RTCIntersectContext context = Coherent();
  float sum = 0;
  for (int y = row; y < row + 16; ++y) {
    for (int x = column; x < column + 16; ++x) {
      RTCRayHit r;
      r.ray = {static_cast<float>(kEye.x),
               static_cast<float>(kEye.y),
               static_cast<float>(kEye.z),
               0,
               t.cos_phi[y] * t.cos_theta[x],
               -t.cos_phi[y] * t.sin_theta[x],
               t.sin_phi[y],
               0,
               INFINITY,
               ~0u,
               0,
               0};
      r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &r);
      sum += r.ray.tfar < 1e9f ? r.ray.tfar : 0;
    }
  }
  return sum;
}

template <class Tile>
double Frame16(const RayTables& t, Tile tile) {
  const int across = t.width / 16, tiles = across * (t.height / 16);
  std::vector<float> sums(static_cast<size_t>(tiles));
  ParallelFor(tiles / 4, [&](int64_t task) {
    const FlushDenormals flush;
    for (int i = static_cast<int>(task) * 4; i < static_cast<int>(task) * 4 + 4; ++i) {
      sums[static_cast<size_t>(i)] = tile(i % across * 16, i / across * 16);
    }
  });
  double sum = 0;
  for (float s : sums) sum += s;
  return sum;
}

double Milliseconds(const std::function<void()>& job) {
  const auto start = Clock::now();
  job();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Row {
  int threads;
  double raw16, raw1, labels, ids;
};

Row Measure(int threads, int rounds, const RawScene& raw, const RayTables& tables, Renderer& renderer) {
  const ThreadLimit limit(threads);
  RenderRequest request = MakeRequest(Equirectangular{tables.width, tables.height}, RigidTransform{{}, kEye} * CameraInBody(),
                                      Tier::kLabels, {.rgb = false, .range = true, .semantic = true, .entity = true, .normal = true});
  Frame frame, ids;
  std::vector<double> ms[4];
  double checksum[2] = {};
  for (int round = -1; round < rounds; ++round) {  // round -1 warms up
    const double t[4] = {Milliseconds([&] { checksum[0] = Frame16(tables, [&](int x, int y) { return Raw16(raw.get(), tables, x, y); }); }),
                         Milliseconds([&] { checksum[1] = Frame16(tables, [&](int x, int y) { return Raw1(raw.get(), tables, x, y); }); }),
                         (request.products.normal = true, Milliseconds([&] { renderer.Render(request, frame); })),
                         (request.products.normal = false, Milliseconds([&] { renderer.Render(request, ids); }))};
    if (round < 0) continue;
    for (int i = 0; i < 4; ++i) ms[i].push_back(t[i]);
  }
  // All looked at the same thing.
  double sum = 0;
  for (float range : frame.range.pixels()) sum += range;
  if (std::abs(sum / checksum[0] - 1) > 1e-3 || std::abs(sum / checksum[1] - 1) > 1e-3) {
    std::fprintf(stderr, "checksums differ: %g %g %g\n", sum, checksum[0], checksum[1]);
    std::exit(1);
  }
  return {ThreadCount(), Median(ms[0]), Median(ms[1]), Median(ms[2]), Median(ms[3])};
}

Options Parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const auto value = [&]() -> long { return i + 1 < argc ? std::atol(argv[++i]) : 0; };
    if (flag == "--json")
      options.json = true;
    else if (flag == "--width")
      options.width = static_cast<int>(value()) / 64 * 64;
    else if (flag == "--triangles")
      options.triangles = value();
    else if (flag == "--rounds")
      options.rounds = static_cast<int>(value());
    else if (flag == "--trees")
      options.trees = static_cast<int>(value());
    else if (flag == "--isa" && i + 1 < argc)
      options.isa = argv[++i];
    else {
      std::fprintf(stderr,
                   "traversal_bench [--json] [--isa sse4.2|avx2|avx512] [--width N] [--triangles N] [--trees "
                   "N] [--rounds N]\n");
      std::exit(2);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  const auto scene = bench::BuildCity({options.triangles, options.trees});
  std::shared_ptr<const RayTracer> tracer;
  const double build_ms = Milliseconds([&] { tracer = std::make_shared<const RayTracer>(scene, RayTracerOptions{options.isa}); });
  const auto renderer = MakeCpuRenderer(tracer);
  const RawScene raw(*scene, options.isa);
  const RayTables tables(options.width);

  std::vector<Row> rows = {Measure(1, options.rounds, raw, tables, *renderer)};
  rows.push_back(Measure(0, options.rounds, raw, tables, *renderer));
  const SceneCounts counts = scene->Count();
  if (options.json) {
    std::printf(
        "{\"unique_triangles\": %llu, \"instanced_triangles\": %llu, \"width\": %d, \"height\": %d, "
        "\"build_ms\": %.0f, \"rows\": [",
        static_cast<unsigned long long>(counts.unique_triangles), static_cast<unsigned long long>(counts.instanced_triangles), tables.width,
        tables.height, build_ms);
    for (size_t i = 0; i < rows.size(); ++i) {
      const Row& r = rows[i];
      std::printf(
          "%s{\"threads\": %d, \"raw16_ms\": %.2f, \"raw1_ms\": %.2f, \"labels_ms\": %.2f, \"ids_ms\": %.2f, "
          "\"labels_over_raw\": %.3f, \"ids_over_raw\": %.3f, \"packet_gain\": %.2f}",
          i ? ", " : "", r.threads, r.raw16, r.raw1, r.labels, r.ids, r.labels / r.raw16, r.ids / r.raw16, r.raw1 / r.raw16);
    }
    std::printf("]}\n");
    return 0;
  }
  std::printf("%llu unique triangles, %llu instanced, %dx%d, build %.2f s, median of %d rounds\n",
              static_cast<unsigned long long>(counts.unique_triangles), static_cast<unsigned long long>(counts.instanced_triangles),
              tables.width, tables.height, build_ms / 1e3, options.rounds);
  std::printf("threads  raw16 ms   raw1 ms  labels ms    ids ms  labels/raw16  ids/raw16  raw1/raw16\n");
  for (const Row& r : rows) {
    std::printf("%7d %9.1f %9.1f %10.1f %9.1f %13.3f %10.3f %11.2f\n", r.threads, r.raw16, r.raw1, r.labels, r.ids, r.labels / r.raw16,
                r.ids / r.raw16, r.raw1 / r.raw16);
  }
  return 0;
}

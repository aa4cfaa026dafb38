// What the surface kernel adds to a look-up: rooms, weather, tiles without repeat. Kernels of this machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "airsim360/base/random.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shading/stretched_surfaces.h"
#include "airsim360/render/shared/shading_kernels.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360 {
namespace {

namespace scalar = internal::scalar;

// A rectangle from `corner` along `u` and `v`, two triangles; uv in metres.
Mesh Rectangle(Vec3f corner, Vec3f u, Vec3f v) {
  Mesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.uvs = {{0, 0}, {Norm(u), 0}, {Norm(u), -Norm(v)}, {0, -Norm(v)}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A clear noon, made once: it takes a second.
const internal::Sky& ClearSky() {
  static const internal::Sky sky{Environment{}};
  return sky;
}

// One material on one rectangle, looked at through the kernels.
struct Sample {
  SceneBuilder builder{"test"};
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<internal::SurfaceTables> tables;
  internal::ShadeView view{};

  Sample(Mesh mesh, Material material, const Environment& environment = {}, Image<Rgba8> picture = {}) {
    builder.AddSky();
    const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
    if (!picture.empty()) material.base_color_texture = builder.AddTexture(Texture::FromImage("picture", std::move(picture), true));
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), entity});
    scene = builder.Build();
    tables = std::make_unique<internal::SurfaceTables>(*scene);
    view = internal::MakeShadeView(*scene, *tables, &ClearSky(), nullptr, &environment);
  }

  // Surfaces at points of the rectangle given by barycentric coordinates of their triangles, seen along `d`
  // from 4 m.
  struct Point {
    uint32_t triangle;
    float u, v;
  };
  std::unique_ptr<internal::SurfaceSet> See(const std::vector<Point>& points, Vec3f d, float width = 0.003f, bool stretched = false) const {
    auto rays = std::make_unique<internal::RaySet>();
    rays->count = internal::kBatch;
    const Mesh& mesh = scene->meshes[0];
    for (int i = 0; i < internal::kBatch; ++i) {
      const Point& at = points[std::min(static_cast<size_t>(i), points.size() - 1)];
      const Vec3u t = mesh.triangles[at.triangle];
      const Vec3f p = mesh.positions[t.x] * (1 - at.u - at.v) + mesh.positions[t.y] * at.u + mesh.positions[t.z] * at.v;
      const Vec3f o = p - d * 4.0f;
      rays->ox[i] = o.x, rays->oy[i] = o.y, rays->oz[i] = o.z;
      rays->dx[i] = d.x, rays->dy[i] = d.y, rays->dz[i] = d.z;
      rays->distance[i] = 4, rays->width[i] = width;
      rays->u[i] = at.u, rays->v[i] = at.v;
      rays->triangle[i] = at.triangle;
    }
    auto surfaces = std::make_unique<internal::SurfaceSet>();
    (stretched ? AIRSIM360_SELECT_KERNEL(PrepareStretched) : AIRSIM360_SELECT_KERNEL(PrepareSurfaces))(view, *rays, *surfaces);
    return surfaces;
  }
};

Material Plain(float albedo, float roughness = 0.9f) {
  Material m;
  m.base_color = {albedo, albedo, albedo};
  m.roughness = roughness;
  return m;
}

Material Window() {
  Material m = Plain(0.04f);
  m.kind = SurfaceKind::kGlass;
  m.interior = true;
  return m;
}

constexpr Vec3f kCorner{3, 7, 2}, kAcross{1.4f, 0, 0}, kUp{0, 0, 1.8f};

// Paving of 16 x 16 m in slabs of a quarter metre with dark joints of 3 cm, as a picture of one metre.
Image<Rgba8> Paving() {
  Image<Rgba8> picture(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool joint = x % 32 < 4 || y % 32 < 4;
      picture(x, y) = joint ? Rgba8{40, 40, 40, 255} : Rgba8{200, 200, 200, 255};
    }
  return picture;
}
constexpr float kPaved = 16;
Sample::Point PavedAt(float x, float y) {
  const float u = x / kPaved, v = y / kPaved;
  return u >= v ? Sample::Point{0, u - v, v} : Sample::Point{1, u, v - u};
}

// Means of base colours over the pixel's true footprint: 4 places across by 64 along it, each filtered over next to nothing.
float TrueMean(const Sample& paving, Vec2f at, Vec2f along, Vec3f d, float across, float length) {
  std::vector<Sample::Point> places;
  for (int i = 0; i < 64; ++i)
    for (int k = 0; k < 4; ++k) {
      const Vec2f p = at + along * (length * ((static_cast<float>(i) + 0.5f) / 64 - 0.5f)) +
                      Vec2f{-along.y, along.x} * (across * ((static_cast<float>(k) + 0.5f) / 4 - 0.5f));
      places.push_back(PavedAt(p.x, p.y));
    }
  const auto seen = paving.See(places, d, 1e-4f);
  float sum = 0;
  for (int i = 0; i < internal::kBatch; ++i) sum += seen->ag[i];
  return sum / internal::kBatch;
}

// From every side, with u and v either way round: the joints seen in slanted pixels are those of their footprints, where one wide
// look-up sees half of them or less.
TEST(Stretched, SlantedPavingKeepsTheJointsOfItsPixels) {
  constexpr float kWidth = 0.035f;
  for (const bool mirrored : {false, true}) {
    Mesh ground = Rectangle({0, 0, 0}, {kPaved, 0, 0}, {0, kPaved, 0});
    if (mirrored)
      for (Vec2f& uv : ground.uvs) uv.x = 0.13f - uv.x;
    const Sample paving(std::move(ground), Plain(1), {}, Paving());
    for (float slant : {0.45f, 0.16f}) {
      for (float azimuth : {0.0f, 0.5f, 1.1f, 1.5708f, 2.3f, 4.0f}) {
        const Vec2f along{std::cos(azimuth), std::sin(azimuth)};
        const float flat = std::sqrt(1 - slant * slant);
        const Vec3f d{along.x * flat, along.y * flat, -slant};
        std::vector<Sample::Point> pixels;
        std::vector<float> truth;
        RngStream random(4, "paving");
        for (int i = 0; i < 60; ++i) {
          const Vec2f at{static_cast<float>(random.Uniform(5, 11)), static_cast<float>(random.Uniform(5, 11))};
          pixels.push_back(PavedAt(at.x, at.y));
          truth.push_back(TrueMean(paving, at, along, d, kWidth, kWidth / slant));
        }
        const auto once = paving.See(pixels, d, kWidth), well = paving.See(pixels, d, kWidth, true);
        double mean = 0, spread = 0, error_once = 0, error_well = 0, mean_well = 0;
        for (size_t i = 0; i < 60; ++i) mean += truth[i] / 60.0, mean_well += well->ag[i] / 60.0;
        for (size_t i = 0; i < 60; ++i) {
          const double t = truth[i];
          spread += (t - mean) * (t - mean);
          error_once += (once->ag[i] - t) * (once->ag[i] - t);
          error_well += (well->ag[i] - t) * (well->ag[i] - t);
        }
        const double left = std::sqrt(error_well / spread), before = std::sqrt(error_once / spread);
        EXPECT_LT(left, 0.35) << "slant " << slant << ", azimuth " << azimuth << (mirrored ? ", mirrored" : "") << "; once " << before;
        EXPECT_NEAR(mean_well, mean, 0.03);
      }
    }
  }
}

// Where nothing is slanted, or patches are mixed, or there is no picture, both are the same to the bit.
TEST(Stretched, IsThePlainLookUpWhereThatIsEnough) {
  Material mixed = Plain(1);
  mixed.blend_tiles = true;
  const Mesh ground = Rectangle({0, 0, 0}, {kPaved, 0, 0}, {0, kPaved, 0});
  const Sample paving(ground, Plain(1), {}, Paving()), patches(ground, mixed, {}, Paving()), bare(ground, Plain(0.4f));
  std::vector<Sample::Point> points;
  RngStream random(9, "plain");
  for (int i = 0; i < internal::kBatch; ++i)
    points.push_back(PavedAt(static_cast<float>(random.Uniform(1, 15)), static_cast<float>(random.Uniform(1, 15))));
  const Vec3f down{0, 0, -1}, low = Normalized(Vec3f{1, 0.4f, -0.2f});
  for (const auto& [sample, d] : {std::pair{&paving, down}, {&patches, low}, {&bare, low}}) {
    const auto a = sample->See(points, d, 0.03f), b = sample->See(points, d, 0.03f, true);
    EXPECT_EQ(std::memcmp(a.get(), b.get(), sizeof(internal::SurfaceSet)), 0);
  }
  const auto a = paving.See(points, low, 0.03f), b = paving.See(points, low, 0.03f, true);
  EXPECT_NE(std::memcmp(a.get(), b.get(), sizeof(internal::SurfaceSet)), 0);
}

// Tints that vary over a pale surface would take it above 1 in places.
TEST(Tints, NeverMakeASurfaceGiveBackMoreThanItGets) {
  Material pale = Plain(0.97f);
  pale.macro_variation = 0.6f;
  const Sample field(Rectangle({}, {900, 0, 0}, {0, 900, 0}), pale);
  std::vector<Sample::Point> points;
  RngStream random(3, "tints", 0);
  for (int i = 0; i < internal::kBatch; ++i) {
    const auto u = static_cast<float>(random.Uniform(0, 1)), v = static_cast<float>(random.Uniform(0, 1));
    points.push_back(u + v < 1 ? Sample::Point{0, u, v} : Sample::Point{1, 1 - u, 1 - v});
  }
  const auto seen = field.See(points, {0, 0, -1});
  const auto [low, high] = std::minmax_element(seen->ag, seen->ag + internal::kBatch);
  EXPECT_LT(*low, 0.9f);
  EXPECT_EQ(*high, 1.0f);
}

// Points of the diagonal belong to both triangles.
TEST(Interior, BothTrianglesOfAPaneShowTheSameRoom) {
  const Sample pane(Rectangle(kCorner, kAcross, kUp), Window());
  for (Vec3f d : {Vec3f{0, 1, 0}, Vec3f{0.4f, 0.8f, -0.3f}, Vec3f{-0.6f, 0.5f, 0.2f}}) {
    std::vector<Sample::Point> first, second;
    for (int i = 1; i < 60; ++i) {
      const float t = static_cast<float>(i) / 60;
      first.push_back({0, 0, t});  // along 0 -> 2
      second.push_back({1, t, 0});
    }
    const auto a = pane.See(first, Normalized(d)), b = pane.See(second, Normalized(d));
    int different = 0;
    for (size_t i = 0; i < first.size(); ++i) different += std::fabs(a->ag[i] - b->ag[i]) > 1e-3f;
    EXPECT_LE(different, 1);  // a point may fall on an edge inside the room
  }
}

TEST(Interior, RoomsHaveDepth) {
  const Sample pane(Rectangle(kCorner, kAcross, kUp), Window());
  // The same point of the pane shows another part of the room from another direction.
  std::vector<Sample::Point> points;
  for (int i = 0; i < 60; ++i) points.push_back({0, 0.3f + 0.006f * static_cast<float>(i), 0.3f});
  const auto a = pane.See(points, {0, 1, 0}), b = pane.See(points, Normalized(Vec3f{0.7f, 1, -0.4f}));
  int different = 0;
  for (size_t i = 0; i < points.size(); ++i) different += std::fabs(a->ag[i] - b->ag[i]) > 1e-3f;
  EXPECT_GT(different, 30);
}

TEST(Interior, NeverReflectsMoreThanAWhiteWallWould) {
  for (int k = 0; k < 20000; ++k) {
    RngStream random(5, "room", k);
    const auto uniform = [&](double a, double b) { return static_cast<float>(random.Uniform(a, b)); };
    Vec3f day, lamp;
    float front, back_a, back_b;
    const float ha = uniform(0.2, 2), hb = uniform(0.2, 1.6);
    const Vec3f d = Normalized(Vec3f{uniform(-1, 1), uniform(-1, 1), uniform(0.03, 1)});
    scalar::interior_room(uniform(-1, 1) * ha, uniform(-1, 1) * hb, ha, hb, d.x, d.y, d.z, uniform(0, 1), Vec3f{}, day, lamp, front, back_a,
                          back_b);
    for (int c = 0; c < 3; ++c) {
      ASSERT_GE(day[c], 0);
      ASSERT_LE(day[c], 0.5f);
      ASSERT_EQ(lamp[c], 0);  // its lamps are off
    }
  }
}

// Correlated colour temperature of a linear sRGB colour: McCamy (1992), within 2 K of Planck's locus to 8000 K.
double TemperatureOf(Vec3f c) {
  const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
               z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z, sum = x + y + z;
  const double n = (x / sum - 0.3320) / (0.1858 - y / sum);
  return ((449 * n + 3525) * n + 6823.3) * n + 5520.33;
}

TEST(Interior, WhitesOfLampsHaveTheirTemperatureAndLuminanceOne) {
  for (float kelvin = 2200; kelvin <= 8000; kelvin += 100) {
    const Vec3f white = scalar::lamp_white(1e6f / kelvin);
    EXPECT_NEAR(0.2126f * white.x + 0.7152f * white.y + 0.0722f * white.z, 1, 1e-5);
    EXPECT_NEAR(TemperatureOf(white) / kelvin, 1, 0.065) << kelvin;
  }
}

TEST(Interior, LitRoomsInTheEveningSpreadOverADecadeOfLightAndFromWarmToBluish) {
  constexpr int kRooms = 20000;
  for (const float area : {0.8f, 1.5f, 4.0f}) {
    std::vector<double> light, kelvin;
    double windows = 0;
    for (int k = 0; k < kRooms; ++k) {
      const float room = (static_cast<float>(k) + 0.5f) / kRooms;
      const Vec3f c = scalar::evening_light(room, area), w = scalar::window_light(room, area);
      light.push_back(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
      kelvin.push_back(TemperatureOf(c));
      windows += (0.2126 * w.x + 0.7152 * w.y + 0.0722 * w.z) / kRooms;
      ASSERT_GT(light.back(), 10.0 / 500 * 0.9);
      ASSERT_LE(light.back(), 1.001);
    }
    std::sort(light.begin(), light.end()), std::sort(kelvin.begin(), kelvin.end());
    const auto at = [](const std::vector<double>& v, double share) { return v[static_cast<size_t>(share * kRooms)]; };
    EXPECT_GT(at(light, 0.95) / at(light, 0.07), 10);
    // Homes by far the most where panes are small, offices where they are large.
    EXPECT_NEAR(at(kelvin, 0.4), area < 2 ? 2850 : 4100, 450) << area;
    EXPECT_GT(at(kelvin, 0.97), 6500);
    if (area < 2) {
      EXPECT_NEAR(windows, 1, 0.3) << area;
    }
  }
}

TEST(Weather, WetAlbedoIsDarkerAndKeepsBlackAndWhite) {
  float last = 0;
  for (float a : {0.0f, 0.05f, 0.12f, 0.3f, 0.6f, 0.9f}) {
    const float wet = scalar::wet_albedo(a);
    EXPECT_LE(wet, a);
    EXPECT_GE(wet, last);
    last = wet;
  }
  // Lekner & Dorf: sand of albedo 0.4 falls to about 0.6 of that.
  EXPECT_NEAR(scalar::wet_albedo(0.4f) / 0.4f, 0.64f, 0.05f);
}

Environment Weather(double wetness, double snow) {
  Environment e;
  e.wetness = wetness;
  e.snow_depth = snow;
  e.rain_mm_h = wetness * 6;
  return e;
}

struct Mean {
  double albedo = 0, coat = 0, least_coat_roughness = 1;
};

Mean MeanOver(const Sample& sample, Vec3f d) {
  std::vector<Sample::Point> points;
  for (int i = 0; i < internal::kBatch; ++i)
    points.push_back({0, 0.03f + 0.9f * static_cast<float>(i % 16) / 16 * 0.5f, 0.03f + 0.9f * static_cast<float>(i / 16) / 16 * 0.5f});
  const auto s = sample.See(points, d);
  Mean mean;
  for (int i = 0; i < internal::kBatch; ++i) {
    mean.albedo += s->ag[i] / internal::kBatch;
    mean.coat += s->coat[i] / internal::kBatch;
    mean.least_coat_roughness = std::min<double>(mean.least_coat_roughness, s->coat_roughness[i]);
    EXPECT_LE(s->ar[i], 0.92f);
    EXPECT_LE(s->coat[i], 1.0f);
    EXPECT_NEAR(s->nx[i] * s->nx[i] + s->ny[i] * s->ny[i] + s->nz[i] * s->nz[i], 1, 1e-4);
  }
  return mean;
}

TEST(Weather, RainDarkensGroundMoreThanWallsAndMakesPuddles) {
  const Mesh ground = Rectangle({-30, -30, 0}, {60, 0, 0}, {0, 60, 0}), wall = Rectangle({-30, 0, 0}, {60, 0, 0}, {0, 0, 60});
  const Vec3f down = Normalized(Vec3f{0.2f, 0.3f, -1}), at = Normalized(Vec3f{0.1f, 1, 0.1f});
  const Mean dry = MeanOver({ground, Plain(0.3f)}, down), wet = MeanOver({ground, Plain(0.3f), Weather(1, 0)}, down);
  const Mean wet_wall = MeanOver({wall, Plain(0.3f), Weather(1, 0)}, at);
  EXPECT_NEAR(dry.albedo, 0.3, 1e-3);
  EXPECT_EQ(dry.coat, 0);
  EXPECT_LT(wet.albedo, 0.75 * dry.albedo);
  EXPECT_GT(wet_wall.albedo, 1.1 * wet.albedo);
  EXPECT_GT(wet.coat, 0.5);
  EXPECT_LT(wet.least_coat_roughness, 0.04);  // standing water somewhere
  EXPECT_GT(wet_wall.least_coat_roughness, 0.1);
}

TEST(Weather, DeepSnowWhitensWhatFacesUpAndLeavesWalls) {
  const Mesh ground = Rectangle({-30, -30, 0}, {60, 0, 0}, {0, 60, 0}), wall = Rectangle({-30, 0, 0}, {60, 0, 0}, {0, 0, 60});
  const Vec3f down = Normalized(Vec3f{0.2f, 0.3f, -1}), at = Normalized(Vec3f{0.1f, 1, 0.1f});
  double last = 0.1;
  for (double depth : {0.1, 0.25, 0.5}) {
    const double albedo = MeanOver({ground, Plain(0.1f), Weather(0, depth)}, down).albedo;
    EXPECT_GT(albedo, last);
    last = albedo;
  }
  EXPECT_GE(MeanOver({ground, Plain(0.1f), Weather(0, 1)}, down).albedo, last);
  EXPECT_GT(last, 0.78);
  EXPECT_NEAR(MeanOver({wall, Plain(0.1f), Weather(0, 1)}, at).albedo, 0.1, 0.01);
}

TEST(Weather, SnowLiesOnStandingBladesOfLawnsAndNotOnStandingLeaves) {
  const Mesh upright = Rectangle({-30, 0, 0}, {60, 0, 0}, {0, 0, 60});
  const Vec3f at = Normalized(Vec3f{0.1f, 1, 0.1f});
  Material leaf = Plain(0.1f), blade = leaf;
  leaf.kind = blade.kind = SurfaceKind::kFoliage;
  blade.ground = GroundWear::kLawn;
  EXPECT_NEAR(MeanOver({upright, leaf, Weather(0, 0.5)}, at).albedo, 0.1, 0.01);
  EXPECT_GT(MeanOver({upright, blade, Weather(0, 0.5)}, at).albedo, 0.6);
  // Nothing of what mowers do to a lawn is done to its blades again.
  EXPECT_EQ(MeanOver({upright, blade}, at).albedo, MeanOver({upright, leaf}, at).albedo);
}

TEST(Weather, DryAirChangesNothing) {
  const Mesh ground = Rectangle({-30, -30, 0}, {60, 0, 0}, {0, 60, 0});
  Material m = Plain(0.3f);
  m.clear_coat = 0.5f;
  m.clear_coat_roughness = 0.25f;
  const auto s = Sample(ground, m).See({{0, 0.2f, 0.3f}}, {0, 0, -1});
  EXPECT_EQ(s->ag[0], 0.3f);
  EXPECT_EQ(s->coat[0], 0.5f);
  EXPECT_EQ(s->coat_roughness[0], 0.25f);
}

// Noise of which mixing must keep mean and contrast.
TEST(Tiles, MixedPatchesKeepMeanAndContrastAndDoNotRepeat) {
  // Squares of eight texels, so that filtering takes little of the contrast.
  Image<Rgba8> noise(64, 64);
  RngStream random(7, "tiles");
  uint8_t squares[8][8];
  for (auto& row : squares) {
    for (uint8_t& v : row) v = static_cast<uint8_t>(70 + random.Index(110));
  }
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const uint8_t v = squares[y / 8][x / 8];
      noise(x, y) = {v, v, v, 255};
    }
  }
  const auto look = [&](bool blend) {
    Material m = Plain(1);
    m.blend_tiles = blend;
    Sample sample(Rectangle({0, 0, 0}, {64, 0, 0}, {0, 64, 0}), m, {}, noise);
    std::vector<float> seen;
    for (int row = 0; row < 24; ++row) {
      std::vector<Sample::Point> points;
      // Texel centres of a line through many tiles (the uv unit is a metre and a tile).
      for (int i = 0; i < internal::kBatch; ++i) {
        const float x = (static_cast<float>(i) * 8 + 0.5f) / 64 / 64,
                    y = (std::floor(static_cast<float>(row) * (64.0f / 24)) + 0.5f) / 64 / 64 + 1.0f / 64;
        points.push_back({0, x - y, y});
      }
      const auto s = sample.See(points, {0, 0, -1}, 1e-5f);
      seen.insert(seen.end(), s->ag, s->ag + internal::kBatch);
    }
    return seen;
  };
  const auto moments = [](const std::vector<float>& a, double& mean, double& sd) {
    mean = sd = 0;
    for (float x : a) mean += x / static_cast<double>(a.size());
    for (float x : a) sd += (x - mean) * (x - mean) / static_cast<double>(a.size());
    sd = std::sqrt(sd);
  };
  const auto plain = look(false), mixed = look(true);
  double mean_plain, sd_plain, mean_mixed, sd_mixed;
  moments(plain, mean_plain, sd_plain);
  moments(mixed, mean_mixed, sd_mixed);
  EXPECT_NEAR(mean_mixed, mean_plain, 0.04 * mean_plain);
  EXPECT_NEAR(sd_mixed, sd_plain, 0.25 * sd_plain);
  // Eight samples are one tile: the plain texture repeats, the mixed one does not.
  const auto correlation = [](const std::vector<float>& a, double mean, double sd) {
    double sum = 0;
    int n = 0;
    for (size_t i = 0; i + 8 < a.size(); ++i) {
      if (i % internal::kBatch + 8 >= internal::kBatch) continue;
      sum += (a[i] - mean) * (a[i + 8] - mean);
      ++n;
    }
    return sum / n / (sd * sd);
  };
  EXPECT_GT(correlation(plain, mean_plain, sd_plain), 0.95);
  EXPECT_LT(std::fabs(correlation(mixed, mean_mixed, sd_mixed)), 0.25);
}

// What lies in a vector beside a flat triangle differs between instruction sets: it must not move its normal.
TEST(SurfaceKernel, FlatTrianglesHaveTheirFacetsNormalBesideCurvedOnes) {
  Mesh mesh = Rectangle({-20, -20, -3}, {40, 1, 7}, {3, 40, -5});
  const Vec3f facet = Normalized(Cross(Vec3f{40, 1, 7}, Vec3f{3, 40, -5}));
  const Mesh beside = mesh;
  for (const Vec3u& t : beside.triangles) mesh.triangles.push_back({t.x + 4, t.y + 4, t.z + 4});
  mesh.positions.insert(mesh.positions.end(), beside.positions.begin(), beside.positions.end());
  mesh.uvs.insert(mesh.uvs.end(), beside.uvs.begin(), beside.uvs.end());
  mesh.normals = {facet, facet, facet, facet, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0.6f, 0.8f}};
  const Sample sample(mesh, Plain(0.4f));
  std::vector<Sample::Point> points;
  RngStream random(5, "flat");
  for (int i = 0; i < internal::kBatch; ++i) {
    points.push_back(
        {static_cast<uint32_t>(i) % 4, static_cast<float>(random.Uniform(0, 0.5)), static_cast<float>(random.Uniform(0, 0.5))});
  }
  const auto seen = sample.See(points, {0, 0, -1});
  int curved = 0;
  for (int i = 0; i < internal::kBatch; ++i) {
    const Vec3f n{seen->nx[i], seen->ny[i], seen->nz[i]}, g{seen->gx[i], seen->gy[i], seen->gz[i]};
    if (i % 4 < 2)
      EXPECT_EQ(n, g) << i;
    else
      curved += n != g ? 1 : 0;
  }
  EXPECT_EQ(curved, internal::kBatch / 2);
}

// Everything at once on all instruction sets of this machine.
TEST(SurfaceKernel, AllInstructionSetsAgreeOnRoomsWeatherAndMixedTiles) {
  using namespace internal;
  SceneBuilder builder("test");
  builder.AddSky();
  const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  Image<Rgba8> noise(32, 32);
  RngStream random(9, "isa");
  for (Rgba8& p : noise.pixels())
    p = {static_cast<uint8_t>(random.Index(256)), static_cast<uint8_t>(random.Index(256)), static_cast<uint8_t>(random.Index(256)), 255};
  const TextureId texture = builder.AddTexture(Texture::FromImage("noise", noise, true));
  int meshes = 0;
  const auto add = [&](Mesh mesh, Material m) {
    // Every second mesh has vertex colours.
    const auto level = [&] { return static_cast<uint16_t>(random.Index(65536)); };
    mesh.colors.resize(meshes++ % 2 == 1 ? mesh.positions.size() : 0);
    for (VertexColor& c : mesh.colors) c = {level(), level(), level()};
    mesh.parts = {{0, 2, builder.AddMaterial(m), kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), entity});
  };
  const Mesh ground = Rectangle({-20, -20, 0}, {40, 0, 0}, {0, 40, 0});
  for (int k = 0; k <= static_cast<int>(GroundWear::kRoofRolls); ++k) {
    Material m = Plain(0.5f);
    m.base_color_texture = m.normal_texture = texture;
    m.ground = static_cast<GroundWear>(k);
    m.blend_tiles = k % 2 == 1;
    m.units = k % 3 == 0 ? Vec2f{4, 6} : Vec2f{};
    m.clear_coat = k == 4 ? 1.0f : 0.0f;
    add(ground, m);
  }
  add(Rectangle(kCorner, kAcross, kUp), Window());
  Material leaf = Plain(0.2f);
  leaf.kind = SurfaceKind::kFoliage;
  leaf.transmission = 0.9f;
  add(ground, leaf);
  Material water = Plain(0.03f);
  water.kind = SurfaceKind::kWater;
  add(ground, water);
  const auto scene = builder.Build();
  const SurfaceTables tables(*scene);
  const Environment environment = Weather(0.9, 0.4);
  const ShadeView view = MakeShadeView(*scene, tables, &ClearSky(), nullptr, &environment);

  auto rays = std::make_unique<RaySet>();
  rays->count = kBatch;
  for (int i = 0; i < kBatch; ++i) {
    const auto uniform = [&](double a, double b) { return static_cast<float>(random.Uniform(a, b)); };
    const Vec3f d = Normalized(Vec3f{uniform(-1, 1), uniform(-1, 1), -0.5f});
    rays->ox[i] = uniform(-9, 9), rays->oy[i] = uniform(-9, 9), rays->oz[i] = 6;
    rays->dx[i] = d.x, rays->dy[i] = d.y, rays->dz[i] = d.z;
    rays->distance[i] = -6 / d.z, rays->width[i] = 0.003f * rays->distance[i];
    rays->u[i] = uniform(0, 0.5), rays->v[i] = uniform(0, 0.5);
    rays->instance[i] = static_cast<uint32_t>(random.Index(scene->instances.size()));
    rays->triangle[i] = static_cast<uint32_t>(i % 2);
  }
  struct Result {
    SurfaceSet surfaces{};
    LightSet light{};
  };
  const auto run = [&](auto prepare, auto shade) {
    auto result = std::make_unique<Result>();
    prepare(view, *rays, result->surfaces);
    shade(view, *rays, result->surfaces, result->light);
    return result;
  };
  const auto base = run(isa_sse42::PrepareSurfaces, isa_sse42::LightSurfaces),
             long_look = run(isa_sse42::PrepareStretched, isa_sse42::LightSurfaces);
  for (int i = 0; i < kBatch; ++i) ASSERT_TRUE(std::isfinite(base->light.g[i]) && std::isfinite(long_look->light.g[i]));
  if (CurrentKernelIsa() >= KernelIsa::kAvx2) {
    EXPECT_EQ(std::memcmp(base.get(), run(isa_avx2::PrepareSurfaces, isa_avx2::LightSurfaces).get(), sizeof(Result)), 0);
    EXPECT_EQ(std::memcmp(long_look.get(), run(isa_avx2::PrepareStretched, isa_avx2::LightSurfaces).get(), sizeof(Result)), 0);
  }
  if (CurrentKernelIsa() >= KernelIsa::kAvx512) {
    EXPECT_EQ(std::memcmp(base.get(), run(isa_avx512::PrepareSurfaces, isa_avx512::LightSurfaces).get(), sizeof(Result)), 0);
    EXPECT_EQ(std::memcmp(long_look.get(), run(isa_avx512::PrepareStretched, isa_avx512::LightSurfaces).get(), sizeof(Result)), 0);
  }
}

}  // namespace
}  // namespace airsim360

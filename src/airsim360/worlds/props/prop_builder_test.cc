#include "airsim360/worlds/props/prop_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/texture/srgb_codes.h"

namespace airsim360::internal {
namespace {

// Volume enclosed by the faces, by the divergence theorem: positive when they look outwards.
double SignedVolume(const Mesh& mesh) {
  double sum = 0;
  for (Vec3u t : mesh.triangles) {
    const Vec3d a = VecCast<double>(mesh.positions[t.x]), b = VecCast<double>(mesh.positions[t.y]),
                c = VecCast<double>(mesh.positions[t.z]);
    sum += Dot(a, Cross(b, c)) / 6;
  }
  return sum;
}

// True if every edge is walked once in each direction (positions rounded to a micrometre).
bool IsClosed(const Mesh& mesh) {
  using Key = std::tuple<long, long, long>;
  const auto key = [&](uint32_t i) {
    const Vec3f p = mesh.positions[i];
    return Key(std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6));
  };
  std::map<std::pair<Key, Key>, int> edges;
  for (Vec3u t : mesh.triangles) {
    const Key k[3] = {key(t.x), key(t.y), key(t.z)};
    for (int i = 0; i < 3; ++i) {
      ++edges[{k[i], k[(i + 1) % 3]}];
      --edges[{k[(i + 1) % 3], k[i]}];
    }
  }
  for (const auto& [edge, balance] : edges) {
    if (balance != 0) return false;
  }
  return true;
}

TEST(BevelBox, IsClosedAndLosesOnlyItsEdges) {
  PropBuilder b("box");
  b.Use(Rubber());
  b.BevelBox({-1, -2, 0}, {1, 2, 3}, 0.1f);
  const Mesh mesh = b.Finish().mesh;
  EXPECT_EQ(mesh.triangles.size(), 44u);
  EXPECT_TRUE(IsClosed(mesh));
  // A bevel of width c takes a prism of area c^2 / 2 off each edge between the corners, and at each corner
  // all of a cube of side c but the tetrahedron c^3 / 6 that its cut leaves.
  const double a = 2, d = 4, h = 3, c = 0.1;
  const double edges = 4 * (c * c / 2) * ((a - 2 * c) + (d - 2 * c) + (h - 2 * c)), corners = 8 * (c * c * c - c * c * c / 6);
  EXPECT_NEAR(SignedVolume(mesh), a * d * h - edges - corners, 1e-4);
}

TEST(Lathe, OfACylinderHasTheVolumeOfItsPrism) {
  PropBuilder b("cylinder");
  b.Use(Rubber());
  const Vec2f profile[] = {{0, 0}, {0.5f, 0}, {0.5f, 2}, {0, 2}};
  b.Lathe(profile, 24, {3, 1, 0});
  const Mesh mesh = b.Finish().mesh;
  EXPECT_TRUE(IsClosed(mesh));
  EXPECT_NEAR(SignedVolume(mesh), 12 * 0.25 * std::sin(2 * kPi / 24) * 2, 1e-5);
}

TEST(Lathe, KeepsSharpCornersSharpAndSmoothsBluntOnes) {
  PropBuilder b("turned");
  b.Use(Rubber());
  const Vec2f sharp[] = {{0, 0}, {1, 0}, {1, 1}};
  b.Lathe(sharp, 16);
  for (const Vec3f n : b.Finish().mesh.normals) EXPECT_TRUE(std::abs(n.z) < 1e-5f || n.z < -0.9999f);
  b.Use(Rubber());
  const Vec2f blunt[] = {{1, 0}, {1, 1}, {0.9f, 2}};
  b.Lathe(blunt, 16);
  const Mesh mesh = b.Finish().mesh;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].z == 1) {
      EXPECT_NEAR(mesh.normals[i].z, std::sin(0.5 * std::atan(0.1)), 1e-4);
    }
  }
}

TEST(Prism, OfARoundedRectangleIsClosedAndHasItsArea) {
  PropBuilder b("prism");
  b.Use(Rubber());
  b.Prism(RoundedRectangle({-1, -0.5f}, {1, 0.5f}, 0.2f, 16), 0, 1);
  const Mesh mesh = b.Finish().mesh;
  EXPECT_TRUE(IsClosed(mesh));
  EXPECT_NEAR(SignedVolume(mesh), 2 - (4 - kPi) * 0.04, 4e-4);
}

TEST(Bar, IsClosedAndAsLongAsItsPath) {
  PropBuilder b("bar");
  b.Use(Rubber());
  const Vec3f path[] = {{0, 0, 0}, {0, 0, 1}, {0, 0, 3}};
  b.Bar(path, 0.1f, 12);
  const Mesh mesh = b.Finish().mesh;
  EXPECT_TRUE(IsClosed(mesh));
  EXPECT_NEAR(SignedVolume(mesh), 6 * 0.01 * std::sin(2 * kPi / 12) * 3, 1e-6);
}

TEST(PropBuilder, GivesEqualMaterialsOneIndex) {
  PropBuilder b("two");
  for (float x : {0.0f, 2.0f}) {
    b.Use(Paint({0.1f, 0.2f, 0.3f}));
    b.BevelBox({x, 0, 0}, {x + 1, 1, 1}, 0.1f);
    UseWood(b);
    b.BevelBox({x, 2, 0}, {x + 1, 3, 1}, 0.1f);
  }
  const Model model = b.Finish();
  EXPECT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.textures.size(), 1u);
  EXPECT_EQ(model.mesh.parts.size(), 2u);
}

TEST(Turn, RotatesAboutXThenYThenZ) {
  const Vec3f v = Turn(90, 0, 90) * Vec3f{0, 1, 0};
  EXPECT_NEAR(v.z, 1, 1e-6);
  const Vec3f w = Turn(0, 0, 90, {1, 2, 3}) * Vec3f{1, 0, 0};
  EXPECT_NEAR(w.x, 1, 1e-6);
  EXPECT_NEAR(w.y, 3, 1e-6);
  EXPECT_NEAR(w.z, 3, 1e-6);
}

TEST(TileNoise, RepeatsAfterItsPeriodAndStaysWithinZeroAndOne) {
  for (int i = 0; i < 200; ++i) {
    const float x = 0.37f * static_cast<float>(i) - 20, y = 0.53f * static_cast<float>(i) - 31;
    const float n = TileNoise(x, y, 8, 4, 5);
    EXPECT_GE(n, 0);
    EXPECT_LE(n, 1);
    EXPECT_NEAR(n, TileNoise(x + 8, y - 4, 8, 4, 5), 1e-5);
  }
}

// Also right before, on and right after the border of two codes.
TEST(SrgbCodes, AreThoseOfTheFormula) {
  const SrgbCodes code;
  for (int k = 0; k < 255; ++k) {
    const auto border = static_cast<float>(SrgbDecode((k + 0.5) / 255));
    float c = border;
    for (int i = 0; i < 8; ++i) c = std::nextafter(c, -1.0f);
    for (int i = 0; i < 17; ++i, c = std::nextafter(c, 2.0f)) ASSERT_EQ(code(c), LinearToSrgb8(c)) << k << " " << c;
  }
  for (int i = -100; i < 4200; ++i) {
    const float c = static_cast<float>(i) / 4096 + 1e-5f;
    ASSERT_EQ(code(c), LinearToSrgb8(c)) << c;
  }
}

TEST(Canvas, ARectangleIsWhatFillsItsInside) {
  const Vec2f lo{0.123f, 0.27f}, hi{0.771f, 0.634f};
  Canvas quick(37, 21, {0.2f, 0.3f, 0.1f}), asked(37, 21, {0.2f, 0.3f, 0.1f});
  quick.Rectangle(lo, hi, {0.9f, 0.05f, 0.4f});
  const Vec2f a{lo.x * 37, lo.y * 21}, b{hi.x * 37, hi.y * 21};
  asked.Fill(a, b, [&](float x, float y) { return x >= a.x && x < b.x && y >= a.y && y < b.y; }, {0.9f, 0.05f, 0.4f});
  const Texture x = quick.Finish("quick"), y = asked.Finish("asked");
  EXPECT_TRUE(std::ranges::equal(x.levels[0].pixels(), y.levels[0].pixels()));
}

TEST(Canvas, ColumnsAreFoundByTheMiddlesThatPaintGives) {
  Canvas canvas(480, 3, {0, 0, 0});
  const Canvas::Columns columns(canvas, [](float u) { return u; });
  canvas.Paint([&](float u, float, Vec3f) {
    EXPECT_EQ(columns(u), u);
    return Vec3f{};
  });
}

TEST(Canvas, ADiscHasTheAreaOfACircle) {
  Canvas canvas(200, 200, {0, 0, 0});
  canvas.Disc({0.5f, 0.5f}, 0.3f, {1, 1, 1});
  const Texture t = canvas.Finish("disc");
  double white = 0;
  for (Rgba8 p : t.levels[0].pixels()) white += p.r == 255 ? 1.0 : p.r > 0 ? 0.5 : 0.0;
  EXPECT_NEAR(white / 40000, kPi * 0.09, 0.003);
}

TEST(Canvas, TextIsCentredAndAsHighAsAsked) {
  Canvas canvas(300, 100, {0, 0, 0});
  canvas.Letters("STOP", {0.5f, 0.5f}, 0.42f, {1, 1, 1});
  const Texture t = canvas.Finish("text");
  int top = 100, bottom = -1, left = 300, right = -1;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 300; ++x) {
      if (t.levels[0](x, y).r < 128) continue;
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  EXPECT_NEAR(bottom - top + 1, 42, 1);
  EXPECT_NEAR(left + right + 1, 300, 2);
  EXPECT_EQ(right - left + 1, 23 * 6);
}

TEST(NormalsFromHeight, OfARampLeanAgainstIt) {
  // Height rises along u by half a tile width a tile, within one period: the slope is 1/2 away from the wrap.
  const Texture t = NormalsFromHeight("ramp", 64, 64, 1, [](float u, float) { return 0.5f * u; });
  const Rgba8 p = t.levels[0](32, 32);
  const double nx = p.r / 255.0 * 2 - 1, nz = p.b / 255.0 * 2 - 1;
  EXPECT_NEAR(nx / nz, -0.5, 0.01);
  EXPECT_NEAR(p.g, 128, 1);
}

}  // namespace
}  // namespace airsim360::internal

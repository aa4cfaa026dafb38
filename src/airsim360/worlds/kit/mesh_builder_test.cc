// The shapes that all worlds are put together from, against closed forms.
#include "airsim360/worlds/kit/mesh_builder.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/test_mesh.h"

namespace airsim360 {
namespace {

using namespace internal;

// The area of a regular polygon in a circle of radius 1.
double Corners(int n) { return n * std::sin(2 * kPi / n) / 2; }

struct Solid {
  const char* name;
  std::function<void(MeshBuilder&)> build;
  double volume;
};
void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }

class EverySolid : public testing::TestWithParam<Solid> {};

INSTANTIATE_TEST_SUITE_P(MeshBuilder, EverySolid,
                         testing::Values(Solid{"Box",
                                               [](MeshBuilder& m) {
                                                 m.Box({1, 2, 3}, {3, 5, 7});
                                               },
                                               24},
                                         Solid{"Beam",
                                               [](MeshBuilder& m) {
                                                 m.Beam({0, 0, 1}, {2, 2, 2}, 0.5f);
                                               },
                                               3 * 0.25},
                                         Solid{"UprightBeam",
                                               [](MeshBuilder& m) {
                                                 m.Beam({1, 1, 0}, {1, 1, 4}, 0.1f);
                                               },
                                               0.04},
                                         Solid{"Tube",
                                               [](MeshBuilder& m) {
                                                 m.Tube({1, 0, 0}, {1, 0, 2}, 0.5f, 0.5f, 12);
                                               },
                                               0.5 * Corners(12)},
                                         Solid{"Frustum",
                                               [](MeshBuilder& m) {
                                                 m.Tube({0, 0, 0}, {3, 0, 0}, 1, 0.5f, 9);
                                               },
                                               Corners(9) * (1 + 0.5 + 0.25)},
                                         Solid{"Cone",
                                               [](MeshBuilder& m) {
                                                 m.Tube({0, 0, 1}, {0, 0, 4}, 2, 0, 8);
                                               },
                                               Corners(8) * 4},
                                         Solid{"ConeDownwards",
                                               [](MeshBuilder& m) {
                                                 m.Tube({0, 0, 4}, {0, 0, 1}, 0, 2, 8);
                                               },
                                               Corners(8) * 4},
                                         Solid{"Sphere",
                                               [](MeshBuilder& m) {
                                                 m.Sphere({1, 2, 3}, {1, 2, 3}, 40, 80);
                                               },
                                               8 * kPi * 0.9985},
                                         Solid{"Prism",
                                               [](MeshBuilder& m) {
                                                 const std::vector<Vec2f> l{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
                                                 m.Polygon(l, 2);
                                                 m.Polygon(l, 0.5f, false);
                                                 m.Walls(l, 0.5f, 2);
                                               },
                                               6 * 1.5}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EverySolid, LooksOutwardsAndHasItsVolume) {
  MeshBuilder builder;
  GetParam().build(builder);
  const Mesh mesh = builder.Finish("solid");
  EXPECT_EQ(FaultOf(mesh), "");
  EXPECT_NEAR(VolumeOf(mesh), GetParam().volume, 0.003 * GetParam().volume);
  EXPECT_TRUE(builder.empty());
}

// Volumes grow by the determinant, whatever turns, stretches or mirrors; a surface that is open would not
// obey.
TEST_P(EverySolid, StaysClosedAndOutwardsUnderAnyTransform) {
  const Mat3f turned = Mat3f::FromColumns({0.36f, 0.48f, -0.8f}, {-0.8f, 0.6f, 0}, {0.48f, 0.64f, 0.6f});
  for (const auto& [A, factor] : std::vector<std::pair<Mat3f, double>>{{turned, 1},
                                                                       {Mat3f::FromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1},
                                                                       {Mat3f::FromColumns({2, 0, 0}, {0, 1, 0}, {0, 0, 3}), 6},
                                                                       {Mat3f::FromColumns({0, 1, 0}, {1, 0, 0}, {0, 0, 0.5f}), 0.5}}) {
    MeshBuilder builder;
    builder.SetTransform({A, {5, -7, 9}});
    GetParam().build(builder);
    const Mesh mesh = builder.Finish("solid");
    EXPECT_NEAR(VolumeOf(mesh), factor * GetParam().volume, 0.004 * factor * GetParam().volume);
  }
}

TEST(MeshBuilder, ABoxHasTheSidesThatAreAskedFor) {
  constexpr Vec3f kOut[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (unsigned sides = 1; sides <= MeshBuilder::kAllSides; ++sides) {
    MeshBuilder builder;
    builder.Box({0, 0, 0}, {1, 2, 3}, sides);
    const TestRays box(builder.Finish("box"));
    for (int i = 0; i < 6; ++i) {
      const auto hit = box.First(Vec3f{0.5f, 1, 1.5f} + kOut[i] * 9.0f, -kOut[i]);
      const bool asked = (sides >> i & 1) != 0;
      EXPECT_EQ(hit && Dot(hit->n, kOut[i]) > 0.99f, asked) << "sides " << sides << ", side " << i;
    }
  }
}

TEST(MeshBuilder, PartsAreByMaterialAndEntityWhateverTheOrder) {
  MeshBuilder builder;
  for (int i = 0; i < 12; ++i) {
    builder.SetMaterial(static_cast<MaterialId>(i % 3));
    builder.SetEntity(static_cast<EntityId>(1 + i % 2));
    const auto z = static_cast<float>(i);
    builder.Quad({0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z});
  }
  const Mesh mesh = builder.Finish("parts");
  ASSERT_EQ(mesh.parts.size(), 6u);
  for (const MeshPart& part : mesh.parts) EXPECT_EQ(part.triangle_count, 4u);
  ForTriangles(mesh, [&](const MeshPart& part, Vec3f a, Vec3f, Vec3f) {
    EXPECT_EQ(part.material, static_cast<MaterialId>(a.z) % 3);
    EXPECT_EQ(part.entity, static_cast<EntityId>(a.z) % 2 + 1);
  });
}

TEST(MeshBuilder, TextureCoordinatesOfAQuadAreMetres) {
  MeshBuilder builder;
  builder.Quad({0, 0, 0}, {3, 0, 4}, {3, 7, 4}, {0, 7, 0});  // 5 m by 7 m
  const Mesh mesh = builder.Finish("quad");
  for (const Vec3u t : mesh.triangles) {
    for (const auto& [i, k] : {std::pair{t.x, t.y}, {t.y, t.z}, {t.z, t.x}}) {
      const Vec2f duv = mesh.uvs[k] - mesh.uvs[i];
      EXPECT_NEAR(std::hypot(duv.x, duv.y), Norm(mesh.positions[k] - mesh.positions[i]), 1e-5);
    }
  }
}

struct Outline {
  const char* name;
  std::vector<Vec2f> points;
};
void PrintTo(const Outline& outline, std::ostream* out) { *out << outline.name; }

std::vector<Vec2f> Star(int points, float inner) {
  std::vector<Vec2f> star;
  for (int i = 0; i < 2 * points; ++i) {
    const float a = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(points), r = i % 2 ? inner : 5.0f;
    star.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return star;
}

std::vector<Vec2f> Comb(int teeth) {
  std::vector<Vec2f> comb{{0, 0}, {static_cast<float>(2 * teeth), 0}};
  for (int i = teeth - 1; i >= 0; --i) {
    const auto x = static_cast<float>(2 * i);
    for (Vec2f p : {Vec2f{x + 2, 4}, {x + 1, 4}, {x + 1, 1}, {x, 1}}) comb.push_back(p);
  }
  comb.pop_back();
  comb.push_back({0, 1});
  return comb;
}

std::vector<Vec2f> Spiral() {
  std::vector<Vec2f> out, back;
  for (int i = 0; i <= 40; ++i) {
    const float a = 0.3f * static_cast<float>(i), r = 1 + 0.25f * a;
    out.push_back({(r + 0.6f) * std::cos(a), (r + 0.6f) * std::sin(a)});
    back.push_back({r * std::cos(a), r * std::sin(a)});
  }
  out.insert(out.end(), back.rbegin(), back.rend());
  return out;
}

class EveryOutline : public testing::TestWithParam<Outline> {};

INSTANTIATE_TEST_SUITE_P(Polygons, EveryOutline,
                         testing::Values(Outline{"Triangle", {{0, 0}, {3, 0}, {0, 4}}}, Outline{"Square", {{0, 0}, {5, 0}, {5, 5}, {0, 5}}},
                                         Outline{"WithCornersInARow", {{0, 0}, {1, 0}, {2, 0}, {5, 0}, {5, 5}, {5, 6}, {0, 6}}},
                                         Outline{"L", {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}},
                                         Outline{"U", {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
                                         Outline{"Arrow", {{0, 0}, {4, 0}, {2, 1}, {0, 4}}}, Outline{"Star5", Star(5, 2)},
                                         Outline{"Star17", Star(17, 0.7f)}, Outline{"Comb", Comb(9)}, Outline{"Spiral", Spiral()}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryOutline, IsCoveredOnceByTrianglesThatFaceUp) {
  const std::vector<Vec2f>& outline = GetParam().points;
  ASSERT_GT(Shoelace(outline), 0);
  const std::vector<Vec3u> triangles = TriangulatePolygon(outline);
  EXPECT_EQ(triangles.size(), outline.size() - 2);
  double sum = 0;
  for (const Vec3u t : triangles) {
    const double area = Shoelace({outline[t.x], outline[t.y], outline[t.z]});
    EXPECT_GE(area, -1e-6);
    sum += area;
  }
  EXPECT_NEAR(sum, Shoelace(outline), 1e-4 * sum);
}

TEST_P(EveryOutline, WallsStandAllAroundAndLookOut) {
  const std::vector<Vec2f>& outline = GetParam().points;
  MeshBuilder builder;
  builder.Walls(outline, -1, 2.5f);
  const Mesh mesh = builder.Finish("walls");
  EXPECT_EQ(FaultOf(mesh), "");
  double length = 0, seen = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f v = outline[(i + 1) % outline.size()] - outline[i];
    length += std::hypot(v.x, v.y);
  }
  // The flux of (x, y, 0) / 2 through closed walls is area times height.
  ForTriangles(mesh, [&](const MeshPart&, Vec3f a, Vec3f b, Vec3f c) {
    const Vec3f n = Cross(b - a, c - a), m = (a + b + c) * (1.0f / 3);
    EXPECT_NEAR(n.z, 0, 1e-5);
    seen += static_cast<double>(n.x * m.x + n.y * m.y) / 4;
  });
  EXPECT_NEAR(AreaOf(mesh, {0}), 3.5 * length, 1e-3 * length);
  EXPECT_NEAR(seen, 3.5 * Shoelace(outline), 1e-3 * length);
}

}  // namespace
}  // namespace airsim360

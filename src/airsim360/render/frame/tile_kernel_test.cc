#include "airsim360/render/frame/tile_kernel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "airsim360/render/frame/test_room.h"

namespace airsim360::internal {
namespace {

// Everything the kernels write for a whole picture, by one instruction set.
struct Picture {
  std::vector<float> range, directions;
  std::vector<uint32_t> entity;
  std::vector<uint16_t> category;
  std::vector<Vec3f> normal;
  std::vector<uint8_t> edges;
  friend bool operator==(const Picture&, const Picture&) = default;
};

#define AIRSIM360_DRAW(isa)                                                                                                                \
  [](const RayTracer& tracer, const CameraRays& rays, Vec3f eye) {                                                                         \
    const LabelTables tables(tracer);                                                                                                      \
    const LabelView view = tables.view();                                                                                                  \
    const RayField& field = rays.field();                                                                                                  \
    const size_t n = static_cast<size_t>(field.width) * field.height;                                                                      \
    Picture out{std::vector<float>(n),  {}, std::vector<uint32_t>(n), std::vector<uint16_t>(n), std::vector<Vec3f>(n),                     \
                std::vector<uint8_t>(n)};                                                                                                  \
    for (int row = 0; row < field.height; row += kTileSize) {                                                                              \
      for (int column = 0; column < field.width; column += kTileSize) {                                                                    \
        const PacketShape shape = row == 0 ? PacketShape::kRow : PacketShape::kBlock;                                                      \
        LabelTile tile;                                                                                                                    \
        RayHit16 packet;                                                                                                                   \
        alignas(64) int valid[16];                                                                                                         \
        isa::InitPacket(eye.x, eye.y, eye.z, packet);                                                                                      \
        for (int p = 0; p < kPackets; ++p) {                                                                                               \
          isa::FillPacket(field, column, row, p, shape, packet, valid);                                                                    \
          for (const auto& d : {packet.direction_x, packet.direction_y, packet.direction_z}) {                                             \
            out.directions.insert(out.directions.end(), d, d + 16);                                                                        \
          }                                                                                                                                \
          tracer.Intersect16(valid, packet, true);                                                                                         \
          isa::ResolvePacket(view, packet, valid, p, true, tile);                                                                          \
        }                                                                                                                                  \
        isa::StoreLabels(tile, {column, row, rays.column_shift(), field.width, field.height, shape, out.range.data(), out.category.data(), \
                                out.entity.data(), out.normal.data()});                                                                    \
      }                                                                                                                                    \
    }                                                                                                                                      \
    std::vector<uint8_t> luma(n);                                                                                                          \
    for (size_t i = 0; i < n; ++i) luma[i] = static_cast<uint8_t>(out.range[i] * 20);                                                      \
    for (int y = 1; y + 1 < field.height; ++y) {                                                                                           \
      const uint32_t* ids[3];                                                                                                              \
      const uint8_t* lumas[3];                                                                                                             \
      for (int k = 0; k < 3; ++k) {                                                                                                        \
        ids[k] = out.entity.data() + (y + k - 1) * field.width;                                                                            \
        lumas[k] = luma.data() + (y + k - 1) * field.width;                                                                                \
      }                                                                                                                                    \
      isa::MarkEdges(ids, lumas, field.width, true, 15, out.edges.data() + y * field.width);                                               \
    }                                                                                                                                      \
    return out;                                                                                                                            \
  }

TEST(TileKernel, InstructionSetsAgreeBitForBit) {
  RngStream rng(1, "kernel");
  for (const auto& scene : {test::MakeRoom(), test::MakeOpenSquare()}) {
    const RayTracer tracer(scene);
    for (const Camera& camera : {Camera(Equirectangular{150, 75}), Camera(Fisheye::Equidistant(90, 70, 3.3))}) {
      const RigidTransform X_WC = test::RandomPose(rng);
      CameraRays rays;
      rays.Update(camera, X_WC.R);
      const Vec3f eye = VecCast<float>(X_WC.p);
      const Picture base = AIRSIM360_DRAW(isa_sse42)(tracer, rays, eye);
      if (__builtin_cpu_supports("avx2")) {
        const Picture other = AIRSIM360_DRAW(isa_avx2)(tracer, rays, eye);
        EXPECT_TRUE(base == other);
      }
      if (CurrentKernelIsa() == KernelIsa::kAvx512) {
        const Picture other = AIRSIM360_DRAW(isa_avx512)(tracer, rays, eye);
        EXPECT_TRUE(base == other);
      }
    }
  }
}

TEST(CameraRays, TablesOfAPanoramaAreSymmetricBitForBit) {
  CameraRays rays;
  rays.Update(Equirectangular{64, 32}, (BodyPose({}, 0, 0, 0) * CameraInBody()).R);
  const RayField& f = rays.field();
  EXPECT_EQ(rays.column_shift(), 0);
  for (int c = 0; c < 64; ++c) {
    EXPECT_EQ(f.column_y[c], -f.column_y[63 - c]);
    EXPECT_EQ(f.column_x[c], f.column_x[63 - c]);
    EXPECT_EQ(f.column_x[c], -f.column_x[(c + 32) % 64]);
  }
  for (int r = 0; r < 32; ++r) {
    EXPECT_EQ(f.row_z[r], -f.row_z[31 - r]);
    EXPECT_EQ(f.row_scale[r], f.row_scale[31 - r]);
  }
}

TEST(CameraRays, DirectionsEqualTheProjectionToFloatPrecision) {
  RngStream rng(2, "rays");
  CameraRays rays;
  for (int i = 0; i < 20; ++i) {
    const Camera camera = i % 2 ? Camera(Equirectangular{120, 60}) : Camera(Pinhole{64, 48, 40, 40, 32, 24});
    const Mat3d R = test::RandomPose(rng).R;
    rays.Update(camera, R);
    for (int k = 0; k < 200; ++k) {
      const int x = static_cast<int>(rng.Index(64)), y = static_cast<int>(rng.Index(48));
      const double dx = rng.Uniform(-0.5, 0.5), dy = rng.Uniform(-0.5, 0.5);
      const int canonical = (x + rays.column_shift()) % Width(camera);
      Vec3d d;
      ASSERT_TRUE(rays.Direction(canonical, y, rays.MakeOffset(dx, dy), d));
      EXPECT_LT(Norm(d - R * *PixelToRay(camera, {x + 0.5 + dx, y + 0.5 + dy})), 2e-9);
    }
  }
}

}  // namespace
}  // namespace airsim360::internal

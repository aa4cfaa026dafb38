// Example 3: every surface of the procedural worlds on a panel that curves from ground to wall, rendered to a
// PNG.
//   build/bin/03_material_sheet [OUT.png [WETNESS [SNOW_DEPTH]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/render/renderer.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace {

using namespace airsim360;

constexpr int kColumns = 10;
constexpr float kWidth = 2.0f, kGap = 0.25f, kPitch = 3.4f;

// A strip of ground 1.2 m deep that bends up to a wall 0.8 m high; uv in metres.
Mesh Panel(MaterialId material, EntityId entity) {
  struct Profile {
    float y, z, ny, nz, along;
  };
  std::vector<Profile> profile = {{-1.2f, 0, 0, 1, 0}, {0, 0, 0, 1, 1.2f}};
  constexpr int kSteps = 12;
  constexpr float kRadius = 0.5f, kQuarter = 1.5707963f;
  for (int i = 1; i <= kSteps; ++i) {
    const float a = kQuarter * static_cast<float>(i) / kSteps;
    profile.push_back(
        {kRadius * std::sin(a), kRadius * (1 - std::cos(a)), -std::sin(a), std::cos(a), 1.2f + kRadius * a});
  }
  profile.push_back({kRadius, kRadius + 0.8f, -1, 0, 1.2f + kRadius * kQuarter + 0.8f});

  MeshBuilder mesh;
  mesh.SetMaterial(material);
  mesh.SetEntity(entity);
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const Profile &a = profile[i], &b = profile[i + 1];
    const Vec3f p[4] = {{0, a.y, a.z}, {kWidth, a.y, a.z}, {kWidth, b.y, b.z}, {0, b.y, b.z}};
    const Vec3f na{0, a.ny, a.nz}, nb{0, b.ny, b.nz};
    const Vec2f uv[4] = {{0, -a.along}, {kWidth, -a.along}, {kWidth, -b.along}, {0, -b.along}};
    mesh.SmoothTriangle({p[0], p[1], p[2]}, {na, na, nb}, {uv[0], uv[1], uv[2]});
    mesh.SmoothTriangle({p[0], p[2], p[3]}, {na, nb, nb}, {uv[0], uv[2], uv[3]});
  }
  return mesh.Finish("panel");
}

}  // namespace

int main(int argc, char** argv) {
  SceneBuilder builder("material sheet");
  builder.AddSky();
  Environment& environment = builder.environment();
  environment.sun_azimuth_deg = 225;
  environment.sun_elevation_deg = 40;
  environment.wetness = argc > 2 ? std::atof(argv[2]) : 0;
  environment.snow_depth = argc > 3 ? std::atof(argv[3]) : 0;

  // Panels in rows, every row a step higher than the one before it.
  const Surfaces surfaces = AddSurfaces(builder);
  const EntityId entity = builder.AddEntity("panels", builder.tree().At("construction/building"));
  constexpr int kCount = static_cast<int>(Surface::kCount), kRows = (kCount + kColumns - 1) / kColumns;
  for (int i = 0; i < kCount; ++i) {
    const auto column = static_cast<float>(i % kColumns), row = static_cast<float>(i / kColumns);
    const Vec3f at{column * (kWidth + kGap), row * kPitch, row * 1.1f};
    builder.AddInstance(
        {builder.AddMesh(Panel(surfaces[static_cast<Surface>(i)], entity)), {{}, at}, entity});
  }

  // Seen from the front and above.
  const double across = kColumns * (kWidth + kGap), middle = across / 2 - kGap / 2;
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(builder.Build()), {.tier = Tier::kFast});
  RenderRequest request{{},
                        Pinhole{1600, 1200, 2900, 2900, 800, 600},
                        BodyPose({middle, -24, 31}, 1.5707963, -0.63, 0) * CameraInBody()};
  request.edge_samples = 8;
  request.products = {};
  request.products.rgb = true;
  Frame frame;
  renderer->Render(request, frame);
  std::printf("%d surfaces in %d rows\n", kCount, kRows);
  if (argc > 1) WriteFileAtomically(argv[1], EncodePng(frame.rgb));
  return 0;
}

// Example 10: every piece of furniture and fitting of interiors on a flight of steps, each scaled to its place, rendered to a
// PNG; the places are printed row by row from below.
//   build/bin/10_furnishing_sheet [OUT.png [VARIANT]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/render/renderer.h"
#include "airsim360/worlds/furnishings/furnishings.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace {

using namespace airsim360;

constexpr int kColumns = 11;
constexpr float kPitch = 1.15f, kDepth = 1.2f, kStep = 0.72f, kYaw = 0.45f;

// Steps of one colour, a row of pieces on each.
Mesh Steps(int rows, MaterialId material, EntityId entity) {
  MeshBuilder mesh;
  mesh.SetMaterial(material);
  mesh.SetEntity(entity);
  const float width = kColumns * kPitch;
  for (int i = 0; i < rows; ++i) {
    const float y = kDepth * static_cast<float>(i), z = kStep * static_cast<float>(i);
    mesh.Box({-kPitch, y - kDepth / 2, z - kStep}, {width, y + kDepth / 2, z}, MeshBuilder::kFront | MeshBuilder::kTop);
  }
  const float y = kDepth * (static_cast<float>(rows) - 0.5f), z = kStep * static_cast<float>(rows - 1);
  mesh.Quad({-kPitch, y, z}, {width, y, z}, {width, y, z + 3}, {-kPitch, y, z + 3});
  return mesh.Finish("steps");
}

}  // namespace

int main(int argc, char** argv) {
  SceneBuilder builder("furnishing sheet");
  builder.AddSky();
  Environment& environment = builder.environment();
  environment.sun_azimuth_deg = 215;
  environment.sun_elevation_deg = 48;
  const auto variant = static_cast<uint32_t>(argc > 2 ? std::atoi(argv[2]) : 0);

  const auto all = Furnishings();
  const int rows = (static_cast<int>(all.size()) + kColumns - 1) / kColumns;
  Material paint;
  paint.name = "steps";
  paint.base_color = {0.42f, 0.42f, 0.41f};
  const EntityId steps = builder.AddEntity("steps", builder.tree().At("construction/stairs"));
  builder.AddInstance({builder.AddMesh(Steps(rows, builder.AddMaterial(paint), steps)), {}, steps});
  PropShelf shelf(builder, nullptr, 1);
  for (size_t i = 0; i < all.size(); ++i) {
    const int row = static_cast<int>(i) / kColumns, column = static_cast<int>(i) % kColumns;
    const Box3f box = FurnishingBox(all[i].kind, variant);
    const Vec3f size = box.size();
    // What is turned by kYaw takes this much of the picture across; nothing may hide the row behind.
    const float across = size.x * std::cos(kYaw) + size.y * std::sin(kYaw), deep = size.y * std::cos(kYaw) + size.x * std::sin(kYaw);
    const float scale = std::min({1.0f / across, 1.1f / deep, 0.95f / size.z});
    const AffineTransform centred = PlaceUpright({}, kYaw, scale);
    const Vec3f middle = centred.A * Vec3f{box.center().x, box.center().y, std::min(0.0f, box.min.z)};
    const Vec3f place{kPitch * static_cast<float>(column), kDepth * static_cast<float>(row), kStep * static_cast<float>(row)};
    shelf.Place(all[i].kind, place - middle, kYaw, variant, scale);
    std::printf("%s%s", std::string(all[i].kind).c_str(), column + 1 == kColumns || i + 1 == all.size() ? "\n" : ", ");
  }

  // Seen from the front and above, from so far that lines stay nearly parallel.
  const double middle = (kColumns - 1) * kPitch / 2, back = 60, pitch = -0.52;
  const double y = kDepth * (rows - 1) / 2, z = kStep * (rows - 1) / 2 + 0.15;
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(builder.Build()), {.tier = Tier::kFast});
  const int width = argc > 1 ? 1650 : 330, height = width * 9 / 10;
  const double focal = width * back / (kColumns * kPitch * 1.08);
  RenderRequest request{{},
                        Pinhole{width, height, focal, focal, width / 2.0, height / 2.0},
                        BodyPose({middle, y - back * std::cos(pitch), z - back * std::sin(pitch)}, 1.5707963, pitch, 0) * CameraInBody()};
  request.edge_samples = 8;
  request.products = {};
  request.products.rgb = true;
  Frame frame;
  renderer->Render(request, frame);
  if (argc > 1) WriteFileAtomically(argv[1], EncodePng(frame.rgb));
  return 0;
}

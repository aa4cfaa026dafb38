// Example 1: load a world, take one panorama, read every product of one pixel.
//   build/bin/01_capture [WORLD]
#include <cstdio>
#include <memory>

#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"

int main(int argc, char** argv) {
  using namespace airsim360;

  // A world by name (or by path to a .glb, .gltf, .obj or .yaml file), and a renderer for it.
  const std::shared_ptr<const Scene> scene = LoadWorld({.world = argc > 1 ? argv[1] : "box_room"});
  const std::unique_ptr<Renderer> renderer = MakeCpuRenderer(std::make_shared<RayTracer>(scene));

  // A drone 1.5 m above the ground that looks east; its panorama looks along the body's forward axis.
  const RigidTransform X_WB = BodyPose({0, 0, 1.5}, 0, 0, 0);
  const RenderRequest request = MakeRequest(Equirectangular{1024, 512}, X_WB * CameraInBody(), Tier::kFast);
  Frame frame;
  renderer->Render(request, frame);

  // Colour, range, category and entity of the pixel straight ahead all come from the same ray.
  const int x = 512, y = 256;
  const Entity& entity = scene->entity(frame.entity(x, y));
  std::printf("ahead: %s (%s) at %.3f m, colour %d %d %d\n", entity.name.c_str(),
              scene->tree[entity.category].path.c_str(), frame.range(x, y), frame.rgb(x, y).r,
              frame.rgb(x, y).g, frame.rgb(x, y).b);

  // A range image is a point cloud: p_W = X_WC * (range * ray).
  const Vec3d p_W = request.X_WC * (*PixelToRay(request.camera, {x + 0.5, y + 0.5}) *
                                    static_cast<double>(frame.range(x, y)));
  std::printf("that is the point (%.2f, %.2f, %.2f) of the world\n", p_W.x, p_W.y, p_W.z);
}

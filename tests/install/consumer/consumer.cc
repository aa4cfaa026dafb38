// A user's program: renders box_room and prints the range straight ahead.
#include <cstdio>
#include <memory>

#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"

int main() {
  using namespace airsim360;
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(LoadWorld({.world = "box_room"})));
  Frame frame;
  renderer->Render(MakeRequest(Equirectangular{128, 64}, BodyPose({0, 0, 3}, 0, 0, 0) * CameraInBody(), Tier::kFast), frame);
  std::printf("%.2f\n", static_cast<double>(frame.range(64, 32)));
}

// Example 2: turning the camera by k columns rolls the panorama by exactly k columns, byte for byte.
#include <cstdio>
#include <memory>
#include <numbers>

#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"

int main() {
  using namespace airsim360;
  constexpr int kWidth = 512, kColumns = 37;
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(LoadWorld({.world = "box_room"})));

  // The same place twice; the second time turned left by 37 columns, so everything moves 37 columns to the
  // right.
  Frame before, after;
  const double angle = kColumns * 2 * std::numbers::pi / kWidth;
  const auto capture = [&](double yaw, Frame& frame) {
    RenderRequest request;
    request.camera = Equirectangular{kWidth, kWidth / 2};
    request.X_WC = BodyPose({-1, 2, 1.5}, yaw, 0, 0) * CameraInBody();
    renderer->Render(request, frame);
  };
  capture(0, before);
  capture(angle, after);

  int different = 0;
  for (int y = 0; y < kWidth / 2; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int moved = (x + kColumns) % kWidth;
      different += before.entity(x, y) != after.entity(moved, y) ||
                   before.range(x, y) != after.range(moved, y) || before.rgb(x, y) != after.rgb(moved, y);
    }
  }
  std::printf("%d of %d pixels differ\n", different, kWidth * kWidth / 2);
  return different == 0 ? 0 : 1;
}

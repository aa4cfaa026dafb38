#include "airsim360/app/flags/camera_arguments.h"

#include <cstdlib>

namespace airsim360 {

void CameraArguments::AddTo(CLI::App& command) {
  command.add_option("--projection", projection, "erp, cube, pinhole or fisheye (default erp)");
  command.add_option("--size", size, "WxH; a cube face for cube (default 2048x1024, 512x512, 1024x768, 1024x1024)");
  // 0 stands for a flag that is not given.
  command.add_option("--fov", fov_deg, "field of view in degrees: pinhole across the width (90), fisheye across the shorter side (180)")
      ->check([](const std::string& text) {
        return std::strtod(text.c_str(), nullptr) == 0 ? "'" + text + "' is not in 1 … 179 (pinhole) or 1 … 360 (fisheye)" : std::string();
      });
  command.add_option("--cameras", cameras,
                     "instead: a rig of several cameras, a YAML or JSON file with their places and lenses, or a calibration of Kalibr, "
                     "COLMAP, OpenCV or ROS (docs/reference/cameras.md)");
}

}  // namespace airsim360

// Files in which calibration programs leave their cameras.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/projection/camera_model.h"

namespace airsim360 {

/// A camera as a file has it.
struct Calibration {
  std::string name = {};  ///< cam0, cam1, … of Kalibr; "cam" and the id of COLMAP; camera_name of ROS, else "camera"
  std::string model = {};            ///< as MakeCamera takes it
  int width = 0, height = 0;         ///< pixels
  std::vector<double> parameters = {};  ///< of the model; the centre of the first pixel is at (0.5, 0.5)
  std::optional<RigidTransform> X_IC = {};  ///< pose of the camera (right, down, forward) in the frame of the file
  size_t line = 0;                   ///< of the file, from 1
};

/// Whether the text of a file is one of those that ReadCalibrations reads (and not a rig of our own).
bool IsCalibration(std::string_view text, const std::filesystem::path& file);

/// Kalibr's camchain.yaml (camera_model pinhole, omni, ds or eucm; distortion_model radtan, equidistant, fov or none; the frame
/// is that of the IMU where the file has T_cam_imu, else cam0 looks forward and the others stand to it as T_cn_cnm1 says), COLMAP's
/// cameras.txt, and OpenCV's and ROS's YAML (camera_matrix, distortion_coefficients, image_width, image_height; distortion_model of
/// ROS, fisheye_model of OpenCV). InputError naming file, line and value for anything else in them. Files up to 1 MiB, up to 64
/// cameras.
std::vector<Calibration> ReadCalibrations(const std::filesystem::path& file);

}  // namespace airsim360

// Files in which calibration programs leave their cameras.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/projection/camera_model_names.h"

namespace airsim360 {

/// Of a calibration and of a rig of our own: bytes of the file, cameras in it.
inline constexpr uint64_t kMostRigBytes = uint64_t{1} << 20;
inline constexpr size_t kMostRigCameras = 64;

/// A camera as a file has it.
struct Calibration {
  std::string name =
      {};  ///< cam0, cam1, … of Kalibr; "cam" and the id of COLMAP; camera_name of ROS in the letters of names, else "camera"
  std::string model = {};                   ///< as MakeCamera takes it
  int width = 0, height = 0;                ///< pixels
  std::vector<double> parameters = {};      ///< of the model; the centre of the first pixel is at (0.5, 0.5)
  std::optional<RigidTransform> X_IC = {};  ///< pose of the camera (right, down, forward) in the frame of the file
  size_t line = 0;                          ///< of the file, from 1
  std::string file = {};                    ///< that it is from
  std::vector<size_t> lines = {};           ///< of each parameter
};

/// MakeCamera of it. InputError naming file, line and camera where a parameter is wrong.
Camera MakeCamera(const Calibration& calibration, std::optional<double> fov_deg);

/// Whether the text of a file is one that ReadCalibrations reads, or of a format that it knows and refuses with advice: no rig of
/// our own. InputError for binary data and errors of syntax.
bool IsCalibration(std::string_view text, const std::filesystem::path& file);

/// Kalibr's camchain.yaml (camera_model pinhole, omni, ds or eucm; distortion_model radtan, equidistant, fov or none; the frame
/// is that of the IMU where the file has T_cam_imu, or its inverse T_imu_cam as OpenVINS writes it; else the camera of the lowest
/// number looks forward and camera n stands to n - 1 as T_cn_cnm1 says, whatever their order in the file), COLMAP's cameras.txt, and
/// OpenCV's and ROS's YAML, JSON or XML (camera_matrix, distortion_coefficients, image_width, image_height; distortion_model of ROS,
/// fisheye_model of OpenCV). InputError naming file, line and value for anything else in them. Files up to 1 MiB, up to 64 cameras.
std::vector<Calibration> ReadCalibrations(const std::filesystem::path& file);

}  // namespace airsim360

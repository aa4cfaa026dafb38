// Names of camera models and their parameters in order, as calibrations and COLMAP write them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/projection/camera.h"

namespace airsim360 {

/// What is wrong with a lens, and which of its parameters says so.
class LensError : public InputError {
 public:
  static constexpr size_t kNone = static_cast<size_t>(-1);
  LensError(const std::string& what, size_t of) : InputError(what), parameter(of) {}
  size_t parameter;  ///< index into those of the model, or kNone
};

/// The camera of a model by its name: those of COLMAP (SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV,
/// SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, OPENCV_FISHEYE, THIN_PRISM_FISHEYE, RAD_TAN_THIN_PRISM_FISHEYE, SIMPLE_FISHEYE,
/// FISHEYE, FOV, EUCM) and OPENCV_THIN_PRISM, DOUBLE_SPHERE, OMNI, F_THETA; docs/reference/cameras.md has their parameters and
/// formulas. A Pinhole or a Fisheye where its numbers are those of one, so that both make the same bytes. `fov_deg`: nothing
/// beyond half of it from the axis is seen; without it all is that the lens can show. InputError for an unknown model (naming
/// the nearest), a wrong number of parameters, values out of range, a principal point further than 10 pictures from the picture, a
/// focal length below a thousandth or above a thousand times its longer side, a lens that no pixel sees through, and a distortion
/// that folds over inside of the picture, or of fov_deg: LensError where parameters are wrong. FOV with omega = 0 is PINHOLE.
Camera MakeCamera(std::string_view model, int width, int height, std::span<const double> parameters, std::optional<double> fov_deg = {});

/// The same with its field as it was written down, radians; nothing is searched for.
Camera RestoreCamera(std::string_view model, int width, int height, std::span<const double> parameters, double max_theta);

/// What a camera is called and its parameters.
struct CameraModel {
  std::string name;                ///< with two focal lengths: PINHOLE, OPENCV, …
  std::vector<double> parameters;  ///< fx fy cx cy, then those of the model
  bool colmap = false;             ///< COLMAP has it
};
/// The simplest model that says all of a pinhole, a fisheye or a calibrated lens but its field; nullopt for others.
std::optional<CameraModel> ModelOf(const Camera& camera);

/// The same lens before a picture of other pixels: x and y larger or smaller, each by the ratio of its own side.
/// InputError unless the height is within a pixel of what the ratio of the widths makes of it.
Camera Resized(const Camera& camera, int width, int height);

}  // namespace airsim360

// The picture that a camera makes of a capture's light.
#pragma once

#include <cstdint>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/look/camera_look.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

/// Where and how a picture is taken.
struct PhotoRequest {
  Camera camera;
  Mat3d R_WC;              ///< orientation of the camera in W
  float exposure = 1;      ///< fixed daylight exposure, as Frame::exposure without stops
  double exposure_ev = 0;  ///< stops on top of what is metered, or of the fixed exposure
  Daylight daylight;
  uint64_t seed = 0, frame = 0;  ///< of what is drawn and of the noise
};

/// What a camera chose, and what was drawn.
struct PhotoFigures {
  double exposure_ev = 0;               ///< stops on top of the fixed daylight exposure, all together
  double white_cd_m2 = 0;               ///< luminance that comes out as white
  double gain = 1;                      ///< of the sensor, see CameraLook::full_well
  double red = 1, green = 1, blue = 1;  ///< of the white balance, errors included
  double contrast = 0;
  double sun_seen = 0;  ///< share of the sun's disc; 0 also where it is outside of the picture
};

/// `light` is Frame::light; the sun's disc in it is clipped, for its light is that of `daylight`. A panorama rolled by
/// whole columns gives the picture rolled, byte for byte; so does any number of threads. Pixels that a fisheye does not
/// see are black. A picture that is not a panorama is scattered in its plane, with mirrors for borders.
PhotoFigures TakePhoto(const CameraLook& look, const PhotoRequest& request, Image<Rgb32f>& light, Image<Rgb8>& rgb);

namespace internal {

/// Encoded value, [0, 1], of light in units of white: highlights compressed by `shoulder`, sRGB, S-shaped contrast.
/// Middle grey (0.18) stays where it is without contrast.
double EncodeTone(double shoulder, double contrast, double light);
/// Light that EncodeTone makes white: 1 where shoulder is 0.
double ClipOfShoulder(double shoulder);

}  // namespace internal
}  // namespace airsim360

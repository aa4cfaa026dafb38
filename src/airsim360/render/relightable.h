// Renderers that can follow the weather.
#pragma once

#include "airsim360/scene/environment.h"

namespace airsim360 {

/// What a Renderer may be besides.
class Relightable {
 public:
  virtual ~Relightable() = default;
  /// The environment of pictures from now on, instead of the one it was made for; the pictures are those of a renderer made
  /// for it, byte for byte. What it shares with the last ones is not computed again. False: not done, make a new renderer.
  virtual bool SetEnvironment(const Environment& environment) = 0;
};

}  // namespace airsim360

#include "airsim360/render/high/high_buffers.h"

#include "airsim360/render/high/fit_image.h"

namespace airsim360::internal {
void HighBuffers::Resize(int width, int height) {
  Fit(range, width, height);
  Fit(entity, width, height);
  Fit(normal, width, height);
  Fit(light, width, height);
  Fit(light_samples, width, height);
  Fit(sun_seen, width, height);
  Fit(sun_smooth, width, height);
  Fit(penumbra, width, height);
  Fit(luma, width, height);
  Fit(edges, width, height);
  terms.resize(static_cast<size_t>(across()) * down());
  smooth.resize(terms.size());
}

}  // namespace airsim360::internal

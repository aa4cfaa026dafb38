#include "airsim360/render/high/high_buffers.h"

namespace airsim360::internal {
namespace {

template <class Pixel>
void Fit(Image<Pixel>& image, int width, int height) {
  if (image.width() != width || image.height() != height) image = Image<Pixel>(width, height);
}

}  // namespace

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

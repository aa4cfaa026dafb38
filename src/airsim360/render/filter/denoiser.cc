#include "airsim360/render/filter/denoiser.h"

#include <iterator>
#include <map>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/filter/filter_buffers.h"
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/light_history.h"

namespace airsim360::internal {
namespace {

// Rows of a task, all of the same remainder, so that the three rows a level reads stay in the cache.
constexpr int kTaskRows = 16;

struct Kernels {
  decltype(&isa_sse42::GatherRow) gather = AIRSIM360_SELECT_KERNEL(GatherRow);
  decltype(&isa_sse42::WindowRow) window = AIRSIM360_SELECT_KERNEL(WindowRow);
  decltype(&isa_sse42::VarianceRow) variance = AIRSIM360_SELECT_KERNEL(VarianceRow);
  decltype(&isa_sse42::AtrousRow) atrous = AIRSIM360_SELECT_KERNEL(AtrousRow);
};

/// Calls body(y) for every row; those of a task are `step` apart.
template <class Body>
void ForRows(int height, int step, const Body& body) {
  const int chunks = (height + step * kTaskRows - 1) / (step * kTaskRows);
  ParallelFor(int64_t{step} * chunks, [&](int64_t task) {
    const int first = static_cast<int>(task / step) * step * kTaskRows + static_cast<int>(task % step);
    for (int k = 0, y = first; k < kTaskRows && y < height; ++k, y += step) body(y);
  });
}

template <class Pixel>
void CheckSize(const char* name, const Image<Pixel>* image, const Camera& camera) {
  if (image == nullptr) throw InputError(std::string("denoiser: no image ") + name);
  if (image->width() == Width(camera) && image->height() == Height(camera)) return;
  throw InputError(std::string("denoiser: image ") + name + " has " + std::to_string(image->width()) + "x" +
                   std::to_string(image->height()) + " pixels, the camera " + std::to_string(Width(camera)) + "x" +
                   std::to_string(Height(camera)));
}

void Check(const FilterGuides& guides, const LightSignal& signal) {
  if (guides.camera == nullptr) throw InputError("denoiser: no camera");
  CheckSize("range", guides.range, *guides.camera);
  CheckSize("entity", guides.entity, *guides.camera);
  CheckSize("normal", guides.normal, *guides.camera);
  CheckSize("light", signal.light, *guides.camera);
  if (guides.geometric_normal != nullptr) CheckSize("geometric_normal", guides.geometric_normal, *guides.camera);
  if (signal.samples != nullptr) CheckSize("samples", signal.samples, *guides.camera);
}

/// Of the levels of the wavelet. Taps one step apart meet what the two levels before have mixed.
constexpr int kSteps[] = {1, 2, 5, 12};

/// Levels up to one whose step is the radius or more, or all.
int LevelCount(float radius_px) {
  int count = 1;
  while (count < std::ssize(kSteps) && static_cast<float>(kSteps[count - 1]) < radius_px) ++count;
  return count;
}

}  // namespace

struct Denoiser::Impl {
  void EstimateNoise();

  FilterBuffers buffers;
  Kernels kernels;
  std::map<int, LightHistory> histories;
};

Denoiser::Denoiser() : impl_(std::make_unique<Impl>()) {}
Denoiser::Denoiser(Denoiser&&) noexcept = default;
Denoiser::~Denoiser() = default;

void Denoiser::Impl::EstimateNoise() {
  const FilterPlanes& f = buffers.planes();
  // Near the poles pixels are narrower than high: first make them square.
  ParallelFor(f.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    const int columns = buffers.PixelsAcross(y);
    if (columns == 1) return;
    kernels.gather(f, y, columns);
    buffers.RepeatLight(y, 0);
    buffers.RepeatSamples(y);
  });
  ForRows(f.height, 1, [&](int y) {
    kernels.window(f, y, buffers.StepX(y, 1));
    buffers.RepeatStatistics(y);
  });
  ForRows(f.height, 3, [&](int y) { kernels.variance(f, y, buffers.StepX(y, 3)); });
}

void Denoiser::Run(const FilterGuides& guides, const LightSignal& signal, bool temporal, int slot) {
  Check(guides, signal);
  Impl& impl = *impl_;
  FilterBuffers& buffers = impl.buffers;
  const int levels = LevelCount(signal.radius_px);
  buffers.Load(guides, signal, kSteps[levels - 1]);
  if (temporal) impl.histories[slot].Accumulate(guides, buffers);
  impl.EstimateNoise();

  const FilterPlanes& f = buffers.planes();
  for (int level = 0; level < levels; ++level) {
    const int step = kSteps[level], in = level & 1;
    ForRows(f.height, step, [&](int y) {
      impl.kernels.atrous(f, y, step, buffers.StepX(y, step), in);
      buffers.RepeatLight(y, 1 - in);
    });
  }
  buffers.Store(levels & 1, *signal.light);
}

}  // namespace airsim360::internal

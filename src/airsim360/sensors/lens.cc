#include "airsim360/sensors/lens.h"

#include <algorithm>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

constexpr int kBandRows = 16;

/// Mean of n x n pixels.
Image<Rgb32f> Reduce(const Image<Rgb32f>& image, int n) {
  if (n == 1) return image;
  Image<Rgb32f> result(image.width() / n, image.height() / n);
  const float scale = 1.0f / static_cast<float>(n * n);
  ParallelFor(result.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < result.width(); ++x) {
      Rgb32f sum;
      for (int k = 0; k < n * n; ++k) {
        const Rgb32f c = image(x * n + k % n, y * n + k / n);
        sum.r += c.r, sum.g += c.g, sum.b += c.b;
      }
      result(x, y) = {sum.r * scale, sum.g * scale, sum.b * scale};
    }
  });
  return result;
}

/// Tier fast has no antialiased radiance: its sensors are rendered twice as fine.
int Oversampling(Tier tier) { return tier == Tier::kFast ? 2 : 1; }

/// The exposed light of one sensor, row by row at its own time.
Image<Rgb32f> RenderSensor(const Real360& lens, const RenderRequest& settings, const PoseAt& X_WC, bool moving, float exposure, bool rear,
                           const Fisheye& camera, Renderer& renderer, RenderStats& stats) {
  const int n = Oversampling(settings.tier);
  const Fisheye fine{camera.width * n, camera.height * n, camera.fx * n, camera.fy * n, camera.cx * n, camera.cy * n, {}, camera.max_theta};
  RenderRequest request = settings;
  request.products = {.rgb = false, .range = false, .semantic = false, .entity = false, .radiance = true};
  request.auto_exposure = false;
  request.X_WC_next.reset();
  Image<Rgb32f> light(fine.width, fine.height);
  Frame frame;
  const int step = moving && lens.readout > 0 ? kBandRows * n : fine.height;
  for (int first = 0; first < fine.height; first += step) {
    Fisheye band = fine;
    band.height = std::min(step, fine.height - first);
    band.cy = fine.cy - first;
    const double t = ((first + 0.5 * band.height) / fine.height - 0.5) * lens.readout;
    request.camera = band;
    request.X_WC = X_WC(t) * internal::SensorPose(lens, rear);
    const RenderStats part = renderer.Render(request, frame);
    stats.rays += part.rays;
    stats.render_ms += part.render_ms;
    if (frame.radiance.empty()) throw InputError("lens real360: this tier or renderer gives no radiance");
    std::transform(frame.radiance.pixels().begin(), frame.radiance.pixels().end(), &light(0, first), [exposure](Rgb32f c) {
      return Rgb32f{c.r * exposure, c.g * exposure, c.b * exposure};
    });
  }
  return Reduce(light, n);
}

}  // namespace

Real360 Real360::Perfect() {
  Real360 lens;
  lens.baseline = lens.vignetting = lens.mismatch_ev = lens.read_noise = lens.readout = lens.fringe = 0;
  lens.full_well = 1e12;
  lens.jpeg_quality = 0;
  return lens;
}

void Real360::Visit(ConfigVisitor& v) {
  v.Field("fov_deg", "field of view of each fisheye, degrees", fov_deg, 180, 220);
  v.Field("baseline", "metres between the optical centres", baseline, 0, 1);
  v.Field("blend_deg", "width of the blended seam, degrees", blend_deg, 0.01, 40);
  v.Field("vignetting", "share of light missing at the rim", vignetting, 0, 1);
  v.Field("mismatch_ev", "stops by which the rear picture is brighter", mismatch_ev, -2, 2);
  v.Field("full_well", "photo-electrons of a pixel at white", full_well, 10, 1e12);
  v.Field("read_noise", "electrons, standard deviation", read_noise, 0, 1e4);
  v.Field("readout", "seconds from the first row to the last", readout, 0, 1);
  v.Field("fringe", "lateral colour: magnification of red", fringe, 0, 0.05);
  v.Field("jpeg_quality", "1 to 100, 0 = not compressed", jpeg_quality, 0, 100);
}

void CheckReal360(const Real360& lens) {
  if (!(lens.fov_deg >= 180 + lens.blend_deg && lens.fov_deg <= 220)) {
    throw InputError("real360: fov_deg " + std::to_string(lens.fov_deg) + " is not in 180 + blend_deg (" +
                     std::to_string(180 + lens.blend_deg) + ") … 220");
  }
  if (!(lens.full_well > 0)) throw InputError("real360: full_well must be positive");
}

double NoiseVariance(const Real360& lens, double signal) {
  const double read = lens.read_noise / lens.full_well;
  return std::max(signal, 0.0) / lens.full_well + read * read;
}

RenderStats RenderReal360(const Real360& lens, const RenderRequest& request, const PoseAt& X_WC, bool moving, float exposure,
                          uint64_t frame, const Equirectangular& target, Renderer& renderer, const DevelopLight& develop,
                          Image<Rgb8>& rgb) {
  CheckReal360(lens);
  const Fisheye camera = internal::SensorCamera(lens, target);
  RenderStats stats;
  Image<Rgb32f> sensors[2];
  for (const bool rear : {false, true}) {
    Image<Rgb32f>& light = sensors[rear ? 1 : 0];
    light = RenderSensor(lens, request, X_WC, moving, exposure, rear, camera, renderer, stats);
    internal::ExposeSensor(lens, camera, rear, request.seed, frame, light);
  }
  Image<Rgb32f> light = internal::StitchSensors(lens, camera, sensors[0], sensors[1], target);
  develop(light, rgb);
  if (lens.jpeg_quality < 1) return stats;
  const Image<Rgba8> coded = DecodeRgba8(EncodeJpeg(rgb, static_cast<int>(lens.jpeg_quality)), "picture of real360");
  std::transform(coded.pixels().begin(), coded.pixels().end(), rgb.pixels().begin(), [](Rgba8 c) { return Rgb8{c.r, c.g, c.b}; });
  return stats;
}

}  // namespace airsim360

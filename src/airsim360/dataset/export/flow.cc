// Optical flow of panoramas as Middlebury's .flo, with what is hidden in the next picture.
#include <cstring>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

// "PIEH", width, height, then (u, v) float32 row by row.
Bytes EncodeFlo(const Image<float>& u, const Image<float>& v) {
  Bytes bytes(12 + u.size() * 8);
  const int32_t size[] = {u.width(), u.height()};
  std::memcpy(bytes.data(), "PIEH", 4);
  std::memcpy(bytes.data() + 4, size, 8);
  for (size_t i = 0; i < u.size(); ++i) {
    const float uv[] = {u.pixels()[i], v.pixels()[i]};
    std::memcpy(bytes.data() + 12 + 8 * i, uv, 8);
  }
  return bytes;
}

}  // namespace

void ExportFlow(ExportJob& job) {
  job.NeedColour();
  job.Need(job.data.Has("flow"), "optical flow", "--products flow (and --fps 10, so that frames see the same things)");
  job.EachFrame([&](const NativeFrame& frame) {
    for (const View& view : job.data.views()) {
      const std::string stem = frame.stem + view.suffix;
      const Bytes stored = job.data.Read(frame, view, "flow");
      const auto channel = [&](const char* name) { return DecodeExrChannel(stored, "flow/" + stem + ".exr", name); };
      const Image<float> occluded = channel("occluded");
      Image<uint8_t> mask(occluded.width(), occluded.height());
      std::ranges::transform(occluded.pixels(), mask.pixels().begin(), [](float o) { return o > 0.5f ? 255 : 0; });
      job.out.Write("images/" + job.data.FileName(frame, view, "rgb"), job.data.Read(frame, view, "rgb"));
      job.out.Write("flow/" + stem + ".flo", EncodeFlo(channel("dx"), channel("dy")));
      job.out.Write("occlusion/" + stem + ".png", EncodePng(mask));
    }
  });
}

}  // namespace airsim360::internal

// A dataset as videos: colour and depth to look at, semantics and entities without loss.
#include <cmath>
#include <limits>
#include <optional>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/lossless_video.h"
#include "airsim360/video/video_writer.h"

namespace airsim360::internal {
namespace {

struct Pictures {
  Image<Rgb8> colour, semantic, entity;
  Image<float> range;
};

// Ids as red, green, blue: R + 256 G + 65536 B.
template <class Id>
Image<Rgb8> IdPicture(const Image<Id>& ids) {
  Image<Rgb8> picture(ids.width(), ids.height());
  std::ranges::transform(ids.pixels(), picture.pixels().begin(), [](uint32_t id) {
    return Rgb8{static_cast<uint8_t>(id), static_cast<uint8_t>(id >> 8), static_cast<uint8_t>(id >> 16)};
  });
  return picture;
}

// Range between which gray is logarithmic: 1 at the nearest, 255 at the farthest, 0 = sky.
struct LogScale {
  double nearest = std::numeric_limits<double>::max(), farthest = 0;
  Image<Rgb8> Picture(const Image<float>& range) const {
    Image<Rgb8> picture(range.width(), range.height());
    const double scale = farthest > nearest ? 254 / std::log(farthest / nearest) : 0;
    std::ranges::transform(range.pixels(), picture.pixels().begin(), [&](float r) {
      if (r <= 0) return Rgb8{};
      const auto gray = static_cast<uint8_t>(std::lround(1 + std::clamp(scale * std::log(r / nearest), 0.0, 254.0)));
      return Rgb8{gray, gray, gray};
    });
    return picture;
  }
};

LogScale FindScale(const ExportJob& job, const View& view) {
  LogScale scale;
  job.EachFrame(
      [&](const NativeFrame& frame) {
        float nearest = std::numeric_limits<float>::max(), farthest = 0;
        const Image<float> range = job.data.Range(frame, view);
        for (const float r : range.pixels()) {
          if (r > 0) nearest = std::min(nearest, r), farthest = std::max(farthest, r);
        }
        return std::pair(nearest, farthest);
      },
      [&](const NativeFrame&, std::pair<float, float> ends) {
        scale.nearest = std::min<double>(scale.nearest, ends.first);
        scale.farthest = std::max<double>(scale.farthest, ends.second);
      });
  return scale;
}

double FrameRate(const ExportJob& job) {
  const size_t count = job.data.size();
  const int64_t span = job.data.Frame(count - 1).t_ns - job.data.Frame(0).t_ns;
  return count > 1 && span > 0 ? std::clamp(1e9 * static_cast<double>(count - 1) / static_cast<double>(span), 0.001, 1000.0) : 10.0;
}

}  // namespace

void ExportVideo(ExportJob& job) {
  job.NeedColour();
  const View& view = job.OneView();
  const int width = Width(view.camera), height = Height(view.camera);
  const double rate = FrameRate(job);
  const VideoOptions options{.frame_rate = rate, .spherical = view.projection == Projection::kErp};
  CheckVideo({width, height}, options);
  const LogScale scale = FindScale(job, view);
  VideoWriter colour(job.out.Place("colour.mp4"), width, height, options), depth(job.out.Place("depth.mp4"), width, height, options);
  LosslessVideo semantic(job.out.Place("semantic.mkv"), width, height, rate), entity(job.out.Place("entity.mkv"), width, height, rate);
  std::string times = "frame,t_ns\n";
  job.EachFrame(
      [&](const NativeFrame& frame) {
        return Pictures{job.data.Rgb(frame, view), IdPicture(job.data.Semantic(frame, view)), IdPicture(job.data.Entity(frame, view)),
                        job.data.Range(frame, view)};
      },
      [&](const NativeFrame& frame, const Pictures& pictures) {
        colour.Add(pictures.colour, frame.t_ns);
        depth.Add(scale.Picture(pictures.range), frame.t_ns);
        semantic.Add(pictures.semantic);
        entity.Add(pictures.entity);
        times += std::to_string(frame.index) + "," + std::to_string(frame.t_ns) + "\n";
      });
  colour.Finish();
  depth.Finish();
  semantic.Finish();
  entity.Finish();
  job.out.Write("times.csv", times);
  job.out.Write("depth.json",
                Pretty({{"gray", "0 = sky; 1 … 255: range = nearest * (farthest / nearest) ^ ((gray - 1) / 254), metres along the ray"},
                        {"nearest", scale.nearest},
                        {"farthest", scale.farthest}}));
  job.notes["frame_rate"] = rate;
}

}  // namespace airsim360::internal

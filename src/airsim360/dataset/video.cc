#include "airsim360/dataset/video.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/shot_source.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using ParsedJson = nlohmann::json;

// How often pictures come: the mean over all of them.
double RateOf(int64_t first_ns, int64_t last_ns, size_t pictures, double otherwise) {
  if (pictures < 2 || last_ns <= first_ns) return otherwise;
  return static_cast<double>(pictures - 1) / (static_cast<double>(last_ns - first_ns) * 1e-9);
}

VideoResult ResultOf(const VideoWriter& writer, int64_t first_ns, int64_t last_ns, double rate) {
  return {writer.pictures(), static_cast<double>(last_ns - first_ns) * 1e-9 + 1 / rate, writer.encoder()};
}

// A frame of a dataset: its picture and its time.
struct Picture {
  fs::path path;
  int64_t t_ns;
};

std::vector<Picture> PicturesOf(const fs::path& folder, const std::string& extension) {
  std::vector<Picture> pictures;
  std::istringstream lines(ReadTextFile(folder / "frames.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    const ParsedJson frame = ParsedJson::parse(line, nullptr, false);
    const std::string place = (folder / "frames.jsonl").string() + ":" + std::to_string(pictures.size() + 1);
    if (!frame.is_object() || !frame.contains("stem") || !frame["stem"].is_string() || !frame.contains("t_ns") ||
        !frame["t_ns"].is_number_integer() || !frame.contains("sha256"))
      throw InputError(place + ": not a frame");
    if (!frame["sha256"].contains("rgb")) throw InputError(place + ": the frame has no colour picture, or several");
    // Of frames at one instant (more frames than steps) each is shown for a moment.
    constexpr int64_t kMomentNs = 1'000'000;
    int64_t t_ns = frame["t_ns"].get<int64_t>();
    if (!pictures.empty()) t_ns = std::max(t_ns, pictures.back().t_ns + kMomentNs);
    pictures.push_back({folder / "rgb" / (frame["stem"].get<std::string>() + extension), t_ns});
  }
  if (pictures.empty()) throw InputError("'" + folder.string() + "' has no frames");
  return pictures;
}

Image<Rgb8> ReadPicture(const fs::path& path) {
  const Image<Rgba8> full = DecodeRgba8(ReadFile(path), path.string());
  Image<Rgb8> picture(full.width(), full.height());
  for (size_t i = 0; i < full.size(); ++i) picture.pixels()[i] = {full.pixels()[i].r, full.pixels()[i].g, full.pixels()[i].b};
  return picture;
}

// How long the video will take, once its first picture is rendered.
void TellEstimate(const DatasetSpec& spec, size_t pictures, double first_ms) {
  LogInfo("video: " + std::to_string(pictures) + " pictures of " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
          ", some " + ClockText(1e-3 * first_ms * static_cast<double>(pictures)));
}

}  // namespace

VideoResult FilmFlight(const CollectInput& input, Renderer& renderer, const fs::path& file, const VideoOptions& options) {
  const std::vector<Shot>& shots = input.flight.shots;
  if (shots.empty()) throw InputError("video: the flight is too short for a picture");
  VideoWriter writer(file, input.spec.width, input.spec.height, options);
  internal::ShotSource source(input);
  const std::vector<View> views = Views(input.spec);
  const Products products{.range = false, .semantic = false, .entity = false};
  std::vector<Capture> captures(views.size());
  ProgressBar progress("video", static_cast<int64_t>(shots.size()));
  double render_ms = 0;
  for (size_t i = 0; i < shots.size(); ++i) {
    source.Take(i, views, products, renderer, captures);
    render_ms += captures.front().stats.render_ms;
    // ffmpeg encodes while the next picture is rendered.
    writer.Add(captures.front().frame.rgb, shots[i].t_ns);
    progress.Update(static_cast<int64_t>(i) + 1);
    if (i == 0) TellEstimate(input.spec, shots.size(), render_ms);
  }
  writer.Finish();
  VideoResult result = ResultOf(writer, shots.front().t_ns, shots.back().t_ns, options.frame_rate);
  result.render_ms = render_ms;
  return result;
}

VideoResult FilmDataset(const fs::path& folder, const fs::path& file, VideoOptions options, std::optional<double> frame_rate) {
  if (!fs::exists(folder / kMetaName)) throw InputError("'" + folder.string() + "' is not a dataset: it has no " + kMetaName);
  if (!fs::exists(folder / "frames.jsonl"))
    throw InputError("'" + folder.string() + "' is not complete: run its collection again to finish it");
  const ParsedJson meta = ParsedJson::parse(ReadTextFile(folder / kMetaName), nullptr, false);
  const ParsedJson parameters = meta.is_object() ? meta.value("parameters", ParsedJson::object()) : ParsedJson::object();
  const bool jpeg = parameters.value("rgb_format", std::string("png")) == "jpg";
  std::vector<Picture> pictures = PicturesOf(folder, jpeg ? ".jpg" : ".png");
  options.spherical = parameters.value("projection", std::string("erp")) == "erp";
  if (frame_rate) {
    for (size_t i = 0; i < pictures.size(); ++i) pictures[i].t_ns = std::llround(static_cast<double>(i) * 1e9 / *frame_rate);
    options.frame_rate = *frame_rate;
  } else {
    options.frame_rate = RateOf(pictures.front().t_ns, pictures.back().t_ns, pictures.size(), options.frame_rate);
  }
  std::optional<VideoWriter> writer;
  ProgressBar progress("video", static_cast<int64_t>(pictures.size()));
  for (size_t i = 0; i < pictures.size(); ++i) {
    const Image<Rgb8> picture = ReadPicture(pictures[i].path);
    if (!writer) writer.emplace(file, picture.width(), picture.height(), options);
    writer->Add(picture, pictures[i].t_ns);
    progress.Update(static_cast<int64_t>(i) + 1);
  }
  writer->Finish();
  return ResultOf(*writer, pictures.front().t_ns, pictures.back().t_ns, options.frame_rate);
}

}  // namespace airsim360

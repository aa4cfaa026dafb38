// airsim360 video DIR: the colour pictures of a dataset as a 360 degree video.
#include <cstdio>
#include <memory>
#include <optional>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/video_arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/video.h"

namespace airsim360 {
namespace {

struct VideoCommandArguments {
  std::string folder, out;
  std::optional<double> fps;
  VideoArguments video;
};

void RunVideo(const VideoCommandArguments& arguments, bool json) {
  CheckVideoPath(arguments.out);
  const VideoOptions options = arguments.video.Options(arguments.fps.value_or(VideoOptions{}.frame_rate));
  const VideoResult result = FilmDataset(arguments.folder, arguments.out, options, arguments.fps);
  if (json) {
    PrintJson({{"out", arguments.out}, {"pictures", result.pictures}, {"seconds", result.seconds}, {"encoder", result.encoder}});
    return;
  }
  std::printf("%s: %lld pictures, %.2f s (%s)\n", arguments.out.c_str(), static_cast<long long>(result.pictures), result.seconds,
              result.encoder.c_str());
}

}  // namespace

void AddVideoCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("video", "a 360 degree video (MP4) of the colour pictures of a dataset; needs the program ffmpeg");
  auto arguments = std::make_shared<VideoCommandArguments>();
  command->add_option("DIR", arguments->folder, "folder of the dataset")->required();
  command->add_option("--out", arguments->out, "the file, FILE.mp4")->required();
  command->add_option("--fps", arguments->fps, "pictures a second, evenly (default: at the times of the flight)");
  arguments->video.AddTo(*command);
  command->callback([arguments, &globals] { RunVideo(*arguments, globals.json); });
}

}  // namespace airsim360

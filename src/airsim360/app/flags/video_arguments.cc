#include "airsim360/app/flags/video_arguments.h"

#include "airsim360/base/error.h"

namespace airsim360 {

void VideoArguments::AddTo(CLI::App& command) {
  command.add_option("--encoder", encoder,
                     "auto (NVENC or VA-API where one works, else libx264; default), libx264 (the same bytes everywhere), libx265, "
                     "h264_nvenc, hevc_nvenc, h264_vaapi or hevc_vaapi");
  command.add_option("--quality", quality, "0 (best) … 51: CRF, CQ or QP of the encoder (default 18)");
}

VideoOptions VideoArguments::Options(double frame_rate) const {
  const VideoOptions options{.frame_rate = frame_rate, .encoder = encoder, .quality = quality};
  try {
    CheckVideoOptions(options);
  } catch (const InputError& error) {
    // The first word of its messages about values is the flag without its dashes.
    const std::string text = error.what();
    const bool about_flag = text.starts_with("encoder:") || text.starts_with("quality:") || text.starts_with("fps:");
    throw InputError((about_flag ? "--" : "") + text);
  }
  return options;
}

}  // namespace airsim360

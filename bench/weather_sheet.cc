// Every weather at four heights of the sun in one world, opened once: a panorama each from its first viewpoint as a camera takes it
// (`--look photo`, tier `fast`), on one sheet with a row for each weather and a column for each time, and what light there is.
// Usage: weather_sheet [--world W] [--weathers A,B] [--times A,B] [--width W] [--without-rooms] [--out FILE.png]
//   --without-rooms   rooms have the light of probes, which takes seconds instead of minutes for each picture
// Prints mean luminance (cd/m2) of the sky and of what stands before it, luminance of white and gain of the camera, processor seconds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_environment.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/cpu/cpu_renderer.h"
#include "airsim360/render/relightable.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/scene/luminance.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sensors/rig.h"
#include "arguments.h"
#include "clock.h"

namespace {

using namespace airsim360;

struct Time {
  const char *name, *sun;
};
constexpr Time kTimes[] = {{"dawn", "95,4"}, {"noon", "195,52"}, {"dusk", "290,-4"}, {"night", "330,-25"}};

std::vector<std::string> Words(const char* list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

double ProcessorSeconds() { return SecondsOf(CLOCK_PROCESS_CPUTIME_ID); }

// A name of clouds, or else of weather.
Environment Under(const std::string& word, const char* sun, int row, const Environment& base) {
  const std::vector<std::string> clouds = CloudPresetNames();
  const bool known = std::find(clouds.begin(), clouds.end(), word) != clouds.end();
  EnvironmentFlags flags{.sun = sun, .sky_seed = std::to_string(100 + row)};
  (known ? flags.clouds : flags.weather) = word;
  return ApplyFlags(flags, base);
}

// Mean luminance by solid angle of pixels with a surface or without.
double MeanLuminance(const Frame& frame, bool surfaces) {
  double sum = 0, whole = 0;
  for (int y = 0; y < frame.radiance.height(); ++y) {
    const double weight = std::sin((y + 0.5) / frame.radiance.height() * M_PI);
    for (int x = 0; x < frame.radiance.width(); ++x) {
      if ((frame.range(x, y) > 0) != surfaces) continue;
      const Rgb32f c = frame.radiance(x, y);
      sum += weight * Luminance({c.r, c.g, c.b}), whole += weight;
    }
  }
  return whole > 0 ? sum / whole * internal::kLuxPerUnit : 0;
}

void Paste(const Image<Rgb8>& picture, int left, int top, Image<Rgb8>& sheet) {
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sheet(left + x, top + y) = picture(x, y);
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "512"))) / 2 * 2;
  const std::vector<std::string> weathers =
      Words(Argument(argc, argv, "--weathers", "clear,day,broken,overcast,haze,fog,mist,rain,storm,snow,winter"));
  std::vector<Time> times;
  for (const std::string& word : Words(Argument(argc, argv, "--times", "dawn,noon,dusk,night")))
    for (const Time& time : kTimes)
      if (word == time.name) times.push_back(time);
  const bool rooms = std::none_of(argv, argv + argc, [](const char* a) { return std::strcmp(a, "--without-rooms") == 0; });

  const auto scene = LoadWorld({.world = Argument(argc, argv, "--world", "downtown_west")});
  const auto renderer =
      (rooms ? MakeCpuRenderer : MakeCpuRendererWithoutRooms)(std::make_shared<const RayTracer>(scene), {.tier = Tier::kFast});
  PanoramicRig rig;
  rig.camera = Equirectangular{width, width / 2};
  rig.tier = Tier::kFast, rig.look = Look::kPhoto;
  rig.products.radiance = true;
  const RigidTransform X_WB{{}, VecCast<double>(FirstViewpoint(*scene))};
  Image<Rgb8> sheet(width * static_cast<int>(times.size()), width / 2 * static_cast<int>(weathers.size()));
  Capture capture;
  for (int column = 0; column < static_cast<int>(times.size()); ++column) {
    for (int row = 0; row < static_cast<int>(weathers.size()); ++row) {
      const std::string& weather = weathers[static_cast<size_t>(row)];
      const Time& time = times[static_cast<size_t>(column)];
      const double before = ProcessorSeconds();
      dynamic_cast<Relightable&>(*renderer).SetEnvironment(Under(weather, time.sun, row, scene->environment));
      CaptureRig(rig, {X_WB, {}, {}}, 0, *renderer, capture);
      Paste(capture.frame.rgb, column * width, row * width / 2, sheet);
      std::printf("%-14s %-6s sky %10.4f, before it %10.4f, white %9.2f cd/m2, gain %4.1f, %.1f s\n", weather.c_str(), time.name,
                  MeanLuminance(capture.frame, false), MeanLuminance(capture.frame, true), capture.photo->white_cd_m2, capture.photo->gain,
                  ProcessorSeconds() - before);
      std::fflush(stdout);
    }
  }
  WriteFileAtomically(Argument(argc, argv, "--out", "weather_sheet.png"), EncodePng(sheet));
}

#include "airsim360/opening/world_environment.h"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/scene/environment_sampler.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

class WorldEnvironment : public testing::Test {
 protected:
  WorldEnvironment() : folder_(fs::temp_directory_path() / ("airsim360_env_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~WorldEnvironment() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, const std::string& text) {
    WriteFileAtomically(folder_ / name, std::string_view(text));
    return folder_ / name;
  }
  fs::path folder_;
};

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(WorldEnvironment, AWorldFileSetsWhatItNamesAndKeepsTheRest) {
  const fs::path file = Write("w.yaml", "world: box_room\nenvironment:\n  weather: rain\n  rain_mm_h: 12\n  lamps: on\n");
  const Environment e = LoadWorld({.world = file})->environment;
  EXPECT_EQ(e.rain_mm_h, 12);
  EXPECT_EQ(e.cloud_cover, 1);
  EXPECT_EQ(e.wetness, 1);
  EXPECT_EQ(e.lamps, Lamps::kOn);
  EXPECT_EQ(e.turbidity, LoadWorld({.world = "box_room"})->environment.turbidity);
}

// A sky picture may be a gigabyte, and a file that changes between two readings is two files.
TEST_F(WorldEnvironment, AWorldFileAndItsSkyAreReadOnce) {
  WriteFileAtomically(folder_ / "sky.exr", EncodeExr(Image<Rgb32f>(16, 8, {1, 2, 3})));
  const fs::path file = Write("w.yaml", "world: box_room\nenvironment: {weather: rain, hdri: sky.exr}\n");
  const int watch = inotify_init1(IN_NONBLOCK);
  ASSERT_GE(watch, 0);
  ASSERT_GE(inotify_add_watch(watch, folder_.c_str(), IN_OPEN), 0);
  const Environment e = LoadWorld({.world = file})->environment;
  EXPECT_TRUE(e.hdri);
  EXPECT_EQ(e.wetness, 1);

  std::map<std::string, int> opened;
  alignas(inotify_event) char events[16384];
  const ssize_t size = read(watch, events, sizeof events);
  close(watch);
  for (ssize_t at = 0; at < size;) {
    inotify_event event;
    std::memcpy(&event, events + at, sizeof event);
    if (event.len > 0) ++opened[events + at + sizeof event];
    at += static_cast<ssize_t>(sizeof event + event.len);
  }
  EXPECT_EQ(opened["w.yaml"], 1);
  EXPECT_EQ(opened["sky.exr"], 1);
}

TEST_F(WorldEnvironment, AWorldFileCanTellTimeAndPlace) {
  const fs::path file = Write("w.yaml",
                              "world: box_room\nenvironment:\n  date: 2003-10-17\n  time: '12:30:30-07:00'\n"
                              "  latitude: 39.742476\n  longitude: -105.1786\n");
  const Environment e = LoadWorld({.world = file})->environment;
  EXPECT_NEAR(e.sun_azimuth_deg, 194.340, 0.05);
  EXPECT_NEAR(e.sun_elevation_deg, 39.888, 0.05);
}

TEST_F(WorldEnvironment, MistakesInAWorldFileAreNamed) {
  const auto error = [&](const std::string& lines) {
    const fs::path file = Write("bad.yaml", "world: box_room\nenvironment:\n" + lines);
    return ErrorOf([&] { LoadWorld({.world = file}); });
  };
  EXPECT_NE(error("  cloud_cove: 1\n").find("cloud_cover"), std::string::npos);
  EXPECT_NE(error("  cloud_cover: 2\n").find("bad.yaml:3"), std::string::npos);
  EXPECT_NE(error("  weather: rainy\n").find("'rain'"), std::string::npos);
  EXPECT_NE(error("  date: 2026-01-01\n").find("bad.yaml: environment: date and time belong together"), std::string::npos);
  EXPECT_NE(error("  hdri: none.exr\n").find("none.exr"), std::string::npos);
}

TEST_F(WorldEnvironment, FlagsComeInOrderAndNameThemselvesInErrors) {
  Environment base;
  base.turbidity = 5;
  const Environment e = ApplyFlags({.weather = "overcast", .sun = "10,20", .settings = "cloud_cover=0.5,lamps=off"}, base);
  EXPECT_EQ(e.turbidity, 5);
  EXPECT_EQ(e.sun_azimuth_deg, 10);
  EXPECT_EQ(e.cloud_cover, 0.5);
  EXPECT_EQ(e.lamps, Lamps::kOff);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.weather = "dey"}, {}); }).find("--weather"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.sun = "10"}, {}); }).find("--sun"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.sun = "10,95"}, {}); }).find("--sun: sun_elevation_deg is 95"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "rain_mm_h=151"}, {}); }).find("--environment: rain_mm_h is 151"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.time = "2026-01-01T10:00"}, {}); }).find("--place"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "haze=1,lamps=on,haze=2"}, {}); }).find("haze: is there twice"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "lamps=on,lamps=off"}, {}); }).find("lamps: is there twice"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "haze=1,"}, {}); }).find("'' is not name=value"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "clouds=1"}, {}); }).find("cloud_cover"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.hdri = "a.png"}, {}); }).find("--hdri"), std::string::npos);
}

TEST_F(WorldEnvironment, CloudsAreAPresetOverWeatherAndUnderSingleValues) {
  const Environment e = ApplyFlags({.weather = "sunset", .settings = "cirrus_cover=0.5", .clouds = "stratocumulus", .sky_seed = "41"}, {});
  EXPECT_EQ(e.sun_elevation_deg, 1.5);
  EXPECT_EQ(e.cloud_type, CloudType::kStratocumulus);
  EXPECT_EQ(e.cloud_cover, 0.75);
  EXPECT_EQ(e.cirrus_cover, 0.5);
  EXPECT_EQ(e.sky_seed, 41);
  EXPECT_EQ(ApplyFlags({.weather = "rain"}, e).sky_seed, 41);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.clouds = "brokn"}, {}); }).find("'broken'"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.sky_seed = "a"}, {}); }).find("--sky-seed"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.sky_seed = "1.5"}, {}); }).find("whole number"), std::string::npos);
  EXPECT_NE(ErrorOf([] { ApplyFlags({.settings = "cloud_type=cumulos"}, {}); }).find("cloud_type"), std::string::npos);
  const fs::path file = Write("w.yaml", "world: box_room\nenvironment: {clouds: overcast, sky_seed: 7}\n");
  EXPECT_EQ(LoadWorld({.world = file})->environment.cloud_type, CloudType::kStratus);
  EXPECT_EQ(LoadWorld({.world = file})->environment.sky_seed, 7);
}

TEST_F(WorldEnvironment, ASampledTextSetsWhatWasSampled) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Environment sampled = SampleEnvironment(seed);
    const std::string text = DescribeEnvironment(sampled);
    EXPECT_EQ(DescribeEnvironment(ApplyFlags({.settings = text}, {})), text);
  }
}

TEST_F(WorldEnvironment, ASkyPictureIsReadAndMustBeAWholeSky) {
  const auto write = [&](const char* name, int width, int height) {
    WriteFileAtomically(folder_ / name, EncodeExr(Image<Rgb32f>(width, height, {1, 2, 3})));
    return folder_ / name;
  };
  const auto picture = LoadSkyPicture(write("a.exr", 64, 32));
  EXPECT_EQ(picture->pixels(5, 5).g, 2);
  EXPECT_EQ(picture->name.rfind("a.exr sha256:", 0), 0u);
  EXPECT_THROW(LoadSkyPicture(write("b.exr", 64, 48)), InputError);
  const auto error = [&](float value, bool everywhere) {
    Image<Rgb32f> image(64, 32, everywhere ? Rgb32f{value, value, value} : Rgb32f{1, 2, 3});
    image(7, 3).g = value;
    WriteFileAtomically(folder_ / "c.exr", EncodeExr(image));
    return ErrorOf([&] { LoadSkyPicture(folder_ / "c.exr"); });
  };
  EXPECT_NE(error(std::numeric_limits<float>::quiet_NaN(), false).find("c.exr: pixel (7, 3) holds nan"), std::string::npos);
  EXPECT_NE(error(std::numeric_limits<float>::infinity(), false).find("pixel (7, 3) holds inf"), std::string::npos);
  EXPECT_EQ(error(-1e-3f, false), "no error");  // as filters leave them
  EXPECT_NE(error(-1, true).find("no pixel has light"), std::string::npos);
  EXPECT_NE(DescribeEnvironment(ApplyFlags({.hdri = (folder_ / "a.exr").string()}, {})).find("hdri=a.exr"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

// Videos: the boxes by formulas of our own, whole files decoded again by ffmpeg.
#include "airsim360/video/video_writer.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/video/mp4_boxes.h"
#include "airsim360/video/spherical_mp4.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::AppendBox;
using internal::AppendNumber;
using internal::GetNumber;
using internal::Mp4Box;
using internal::ParseBoxes;

#define AIRSIM360_NEEDS_FFMPEG() \
  if (!HasFfmpeg()) GTEST_SKIP() << "ffmpeg is not installed (apt-get install ffmpeg)"

class Video : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "airsim360-video-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Smooth, different in every frame.
  static Image<Rgb8> Picture(int width, int height, int frame) {
    Image<Rgb8> picture(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double a = 2 * M_PI * (x + 3 * frame) / width, b = M_PI * y / height;
        const auto value = [](double v) { return static_cast<uint8_t>(std::lround(127.5 + 127.5 * v)); };
        picture(x, y) = {value(std::sin(a)), value(std::cos(a) * std::sin(b)), value(std::cos(b))};
      }
    }
    return picture;
  }
  fs::path Write(const std::string& name, int width, int height, const std::vector<int64_t>& times, const VideoOptions& options = {}) {
    VideoWriter writer(folder_ / name, width, height, options);
    for (size_t i = 0; i < times.size(); ++i) writer.Add(Picture(width, height, static_cast<int>(i)), times[i]);
    writer.Finish();
    return folder_ / name;
  }
  // What a program prints.
  static std::string Run(const std::string& command) {
    std::string text;
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    char part[4096];
    for (size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
    ::pclose(pipe);
    return text;
  }
  static bool Has(const char* program) { return std::system((std::string("command -v ") + program + " >/dev/null").c_str()) == 0; }
  // The pictures of a video as ffmpeg decodes them.
  std::vector<Image<Rgb8>> Decode(const fs::path& video, int width, int height) {
    const fs::path raw = folder_ / "raw";
    Run("ffmpeg -y -loglevel error -i " + video.string() +
        " -vsync passthrough -f rawvideo -pix_fmt rgb24 -sws_flags bicubic+accurate_rnd+full_chroma_int " + raw.string());
    const Bytes bytes = ReadFile(raw);
    const size_t one = static_cast<size_t>(width) * static_cast<size_t>(height) * 3;
    std::vector<Image<Rgb8>> pictures;
    for (size_t at = 0; at + one <= bytes.size(); at += one) {
      Image<Rgb8>& picture = pictures.emplace_back(width, height);
      std::memcpy(picture.pixels().data(), bytes.data() + at, one);
    }
    return pictures;
  }
  static double Psnr(const Image<Rgb8>& a, const Image<Rgb8>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
      for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b}) sum += d * d;
    }
    return 10 * std::log10(255.0 * 255 * 3 * static_cast<double>(a.size()) / sum);
  }
  fs::path folder_;
};

Mp4Box Leaf(const std::string& type, std::initializer_list<std::pair<int, uint64_t>> numbers) {
  Mp4Box box{type, {}, {}};
  for (const auto& [size, value] : numbers) AppendNumber(box.head, size, value);
  return box;
}

// A movie as ffmpeg writes it for `n` pictures, with one chunk at 1000.
Bytes Movie(uint64_t n, bool reordered = false) {
  Mp4Box samples{"stbl", {}, {}};
  Mp4Box entry{"avc1", Bytes(78), {}}, descriptions = Leaf("stsd", {{4, 0}, {4, 1}});
  entry.children.push_back(Leaf("avcC", {{4, 7}}));
  descriptions.children.push_back(entry);
  samples.children = {descriptions, Leaf("stts", {{4, 0}, {4, 1}, {4, n}, {4, 3000}}), Leaf("stsz", {{4, 0}, {4, 9}, {4, n}}),
                      Leaf("stco", {{4, 0}, {4, 1}, {4, 1000}})};
  if (reordered) samples.children.push_back(Leaf("ctts", {{4, 0}, {4, 0}}));
  Mp4Box information{"minf", {}, {samples}};
  Mp4Box media{"mdia", {}, {Leaf("mdhd", {{4, 0}, {4, 0}, {4, 0}, {4, 90000}, {4, 1}, {4, 0}}), information}};
  Mp4Box track{"trak", {}, {Leaf("tkhd", {{4, 3}, {4, 0}, {4, 0}, {4, 1}, {4, 0}, {4, 1}}), media}};
  Mp4Box movie{"moov", {}, {Leaf("mvhd", {{4, 0}, {4, 0}, {4, 0}, {4, 1000}, {4, 1}}), track}};
  Bytes bytes;
  AppendBox(movie, bytes);
  return bytes;
}

TEST_F(Video, BoxesComeBackAsTheyWere) {
  const Bytes movie = Movie(3);
  Bytes again;
  for (const Mp4Box& box : ParseBoxes(movie)) AppendBox(box, again);
  EXPECT_EQ(again, movie);
}

TEST_F(Video, DamagedBoxesAreRefused) {
  const Bytes movie = Movie(3);
  const std::vector<int64_t> times = {0, 1, 2};
  for (size_t cut = 0; cut < movie.size(); ++cut) {
    const std::span<const std::byte> part(movie.data(), cut);
    EXPECT_THROW(internal::EditMovie(part, true, times, 1, 0), RuntimeError) << cut;
  }
  for (size_t i = 0; i < movie.size(); ++i) {
    Bytes damaged = movie;
    damaged[i] = std::byte{0xff};
    try {
      internal::EditMovie(damaged, true, times, 1, 0);
    } catch (const RuntimeError&) {
    }
  }
}

TEST_F(Video, TheSphereIsInTheSampleEntryAndInTheTrack) {
  const std::vector<int64_t> times = {0, 33'000'000, 67'000'000};
  std::vector<Mp4Box> boxes = ParseBoxes(internal::EditMovie(Movie(3), true, times, 1, 0));
  Mp4Box* const track = boxes[0].Find("trak");
  Mp4Box& entry = track->Find("mdia")->Find("minf")->Find("stbl")->Find("stsd")->children[0];
  ASSERT_EQ(entry.children.size(), 3u);
  EXPECT_EQ(entry.children[0].type, "avcC");
  EXPECT_EQ(entry.children[1].head, Bytes(5));  // version, flags, stereo_mode 0: one eye
  // sv3d { svhd { source } proj { prhd { yaw, pitch, roll = 0 } equi { bounds = 0: the whole sphere } } }
  const std::vector<Mp4Box> inside = ParseBoxes(entry.children[2].head);
  ASSERT_EQ(inside.size(), 2u);
  EXPECT_EQ(inside[0].type, "svhd");
  EXPECT_EQ(AsText(inside[0].head).substr(4), std::string_view("AirSim360\0", 10));
  const std::vector<Mp4Box> projection = ParseBoxes(inside[1].head);
  ASSERT_EQ(projection.size(), 2u);
  EXPECT_EQ(projection[0].type, "prhd");
  EXPECT_EQ(projection[0].head, Bytes(16));
  EXPECT_EQ(projection[1].type, "equi");
  EXPECT_EQ(projection[1].head, Bytes(20));
  const Mp4Box* const xml = track->Find("uuid");
  ASSERT_NE(xml, nullptr);
  EXPECT_NE(AsText(xml->head).find("<GSpherical:Spherical>true<"), std::string_view::npos);
  // An ordinary video says nothing of the kind.
  EXPECT_EQ(ParseBoxes(internal::EditMovie(Movie(3), false, times, 1, 0))[0].Find("trak")->Find("uuid"), nullptr);
}

TEST_F(Video, PicturesHaveTheTimesOfTheSimulation) {
  const std::vector<int64_t> times = {500'000'000, 600'000'000, 700'000'000, 720'000'000};
  EXPECT_EQ(internal::TicksOf(times, 90000, 1), (std::vector<uint64_t>{0, 9000, 18000, 19800, 21600}));
  EXPECT_EQ(internal::TicksOf(std::vector<int64_t>{7}, 90000, 40'000'000), (std::vector<uint64_t>{0, 3600}));
  std::vector<Mp4Box> boxes = ParseBoxes(internal::EditMovie(Movie(4), true, times, 1, 234));
  Mp4Box* const media = boxes[0].Find("trak")->Find("mdia");
  Mp4Box* const samples = media->Find("minf")->Find("stbl");
  const Bytes& table = samples->Find("stts")->head;
  std::vector<uint64_t> numbers;
  for (size_t at = 4; at < table.size(); at += 4) numbers.push_back(GetNumber(table, at, 4));
  EXPECT_EQ(numbers, (std::vector<uint64_t>{2, 2, 9000, 2, 1800}));
  EXPECT_EQ(GetNumber(media->Find("mdhd")->head, 16, 4), 21600u);
  EXPECT_EQ(GetNumber(boxes[0].Find("mvhd")->head, 16, 4), 240u);  // its clock has 1000 Hz
  EXPECT_EQ(GetNumber(boxes[0].Find("trak")->Find("tkhd")->head, 20, 4), 240u);
  EXPECT_EQ(GetNumber(samples->Find("stco")->head, 8, 4), 1234u);
}

TEST_F(Video, LostOrReorderedPicturesAreAnError) {
  const std::vector<int64_t> times = {0, 1, 2};
  EXPECT_THROW(internal::EditMovie(Movie(2), true, times, 1, 0), RuntimeError);
  EXPECT_THROW(internal::EditMovie(Movie(3, true), true, times, 1, 0), RuntimeError);
}

TEST_F(Video, DecodedPicturesAreThoseThatWereGiven) {
  AIRSIM360_NEEDS_FFMPEG();
  const fs::path file = Write("a.mp4", 128, 64, {0, 33'000'000, 67'000'000, 100'000'000, 200'000'000});
  const std::vector<Image<Rgb8>> decoded = Decode(file, 128, 64);
  ASSERT_EQ(decoded.size(), 5u);
  // A wrong range or matrix would give less than 30 dB; the mean of colours would be off by several steps.
  for (int i = 0; i < 5; ++i) EXPECT_GT(Psnr(decoded[static_cast<size_t>(i)], Picture(128, 64, i)), 36) << i;
  EXPECT_LT(Psnr(decoded[0], Picture(128, 64, 4)), 30) << "pictures in the order in which they came";
}

TEST_F(Video, FfprobeSeesASphereItsColoursAndItsTimes) {
  AIRSIM360_NEEDS_FFMPEG();
  if (!Has("ffprobe")) GTEST_SKIP() << "ffprobe is not installed (apt-get install ffmpeg)";
  const fs::path file = Write("a.mp4", 128, 64, {0, 33'000'000, 67'000'000, 100'000'000, 200'000'000});
  const std::string seen = Run("ffprobe -v error -show_streams -show_frames -show_entries frame=pts_time " + file.string());
  for (const char* what :
       {"codec_name=h264", "pix_fmt=yuv420p", "color_range=tv", "color_space=bt709", "color_primaries=bt709", "has_b_frames=0",
        "side_data_type=Spherical Mapping", "projection=equirectangular", "nb_frames=5", "side_data_type=Stereo 3D", "type=2D",
        "pts_time=0.033000", "pts_time=0.067000", "pts_time=0.200000", "duration=0.300000"})
    EXPECT_NE(seen.find(what), std::string::npos) << what << "\n" << seen;
  // Without the side data of a sphere where it is none.
  const std::string plain = Run("ffprobe -v error -show_streams " + Write("b.mp4", 128, 64, {0}, {.spherical = false}).string());
  EXPECT_EQ(plain.find("Spherical"), std::string::npos);
  EXPECT_NE(plain.find("duration=0.033"), std::string::npos) << plain;
}

TEST_F(Video, TheSamePicturesGiveTheSameBytes) {
  AIRSIM360_NEEDS_FFMPEG();
  const std::vector<int64_t> times = {0, 40'000'000, 80'000'000};
  EXPECT_EQ(ReadFile(Write("a.mp4", 256, 128, times)), ReadFile(Write("b.mp4", 256, 128, times)));
}

TEST_F(Video, MoviesBeginWithTheirTables) {
  AIRSIM360_NEEDS_FFMPEG();
  const Bytes file = ReadFile(Write("a.mp4", 128, 64, {0, 40'000'000}));
  std::vector<std::string> types;
  for (const Mp4Box& box : ParseBoxes(file)) types.push_back(box.type);
  EXPECT_EQ(types, (std::vector<std::string>{"ftyp", "moov", "mdat"}));
}

TEST_F(Video, OddSizesBecomeEven) {
  AIRSIM360_NEEDS_FFMPEG();
  const fs::path file = Write("a.mp4", 130, 65, {0, 40'000'000});
  EXPECT_EQ(Decode(file, 130, 66).size(), 2u);
}

TEST_F(Video, NothingIsLeftOfOneThatIsNotFinished) {
  AIRSIM360_NEEDS_FFMPEG();
  {
    VideoWriter writer(folder_ / "a.mp4", 128, 64, {});
    writer.Add(Picture(128, 64, 0), 0);
    EXPECT_TRUE(fs::is_empty(folder_)) << "the file has no name before it is whole";
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  VideoWriter none(folder_ / "b.mp4", 128, 64, {});
  EXPECT_THROW(none.Finish(), RuntimeError);
}

TEST_F(Video, WrongPicturesAndOptionsAreNamed) {
  AIRSIM360_NEEDS_FFMPEG();
  VideoWriter writer(folder_ / "a.mp4", 128, 64, {});
  writer.Add(Picture(128, 64, 0), 5);
  EXPECT_THROW(writer.Add(Picture(128, 64, 0), 5), InputError);
  EXPECT_THROW(writer.Add(Picture(64, 32, 0), 6), InputError);
  EXPECT_THROW(VideoWriter(folder_ / "a.mp4", 8, 4, {}), InputError);
  EXPECT_THROW(VideoWriter(folder_, 128, 64, {}), InputError);
  EXPECT_THROW(CheckVideoPath("flight.webm"), InputError);
  EXPECT_THROW(CheckVideoOptions({.encoder = "x264"}), InputError);
  EXPECT_THROW(CheckVideoOptions({.quality = 52}), InputError);
  EXPECT_THROW(CheckVideoOptions({.frame_rate = NAN}), InputError);
}

// A stand-in for ffmpeg that does what the test wants.
class Stub {
 public:
  Stub(const fs::path& folder, const std::string& script) {
    const fs::path path = folder / "stub";
    std::ofstream(path) << "#!/bin/sh\n" << script;
    fs::permissions(path, fs::perms::owner_all);
    ::setenv("AIRSIM360_FFMPEG", path.c_str(), 1);
  }
  ~Stub() { ::unsetenv("AIRSIM360_FFMPEG"); }
};

TEST_F(Video, AFailingFfmpegIsQuoted) {
  const Stub stub(folder_, "echo 'Unknown encoder' >&2; echo second >&2; exit 3");
  VideoWriter writer(folder_ / "a.mp4", 512, 256, {});
  std::string message;
  try {
    for (int i = 0; i < 100; ++i) writer.Add(Picture(512, 256, i), i);
    writer.Finish();
  } catch (const RuntimeError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "ffmpeg (libx264): Unknown encoder; second");
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
}

TEST_F(Video, AnFfmpegThatWritesNoMovieIsNoticed) {
  const Stub stub(folder_, "cat >/dev/null");
  VideoWriter writer(folder_ / "a.mp4", 128, 64, {});
  writer.Add(Picture(128, 64, 0), 0);
  EXPECT_THROW(writer.Finish(), RuntimeError);
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
}

TEST_F(Video, AMissingFfmpegNamesThePackage) {
  ::setenv("AIRSIM360_FFMPEG", "/nowhere/ffmpeg", 1);
  EXPECT_FALSE(HasFfmpeg());
  try {
    CheckVideoOptions({});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("apt-get install ffmpeg"), std::string::npos);
  }
  ::unsetenv("AIRSIM360_FFMPEG");
}

}  // namespace
}  // namespace airsim360

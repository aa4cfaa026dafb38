#include "airsim360/eval/files/picture_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/image/exr_metadata.h"

namespace airsim360 {
namespace {

TEST(DepthPictures, OfSeveralChannelsNeedOneThatIsNamedAsDepth) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "depth_channels.exr";
  const auto read = [&](const std::vector<const char*>& channels) {
    std::vector<float> pixels;
    for (int pixel = 0; pixel < 2; ++pixel) {
      for (size_t c = 0; c < channels.size(); ++c) pixels.push_back(static_cast<float>(c + 1));
    }
    WriteFileAtomically(path, EncodeExr(pixels, 2, 1, channels, {}));
    return ReadDepthPicture(path, {}).values[0];
  };
  EXPECT_EQ(read({"Y"}), 1);
  EXPECT_EQ(read({"distance"}), 1);
  EXPECT_EQ(read({"A", "range"}), 2);
  EXPECT_EQ(read({"A", "Z"}), 2);
  for (const std::vector<const char*>& channels : {std::vector<const char*>{"X", "Y", "Z"}, {"B", "G", "R"}, {"dx", "dy"}}) {
    try {
      read(channels);
      ADD_FAILURE() << channels[0];
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(channels[1]), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("depth_channels.exr"), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/worlds/texture/kept_textures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace airsim360::internal {
namespace {

Texture Checkers(const char* name, uint8_t tone) {
  Image<Rgba8> image(4, 2);
  for (size_t i = 0; i < image.size(); ++i)
    image.pixels()[i] = {tone, static_cast<uint8_t>(40 * i), 7, i % 2 == 0 ? uint8_t{255} : uint8_t{0}};
  Texture texture = Texture::FromImage(name, std::move(image), true);
  texture.wrap_v = Wrap::kClamp;
  return texture;
}

TEST(KeptTextures, AreMadeOnceForAllRunsAndReadBackAsMade) {
  const auto folder = std::filesystem::temp_directory_path() / ("airsim360_textures_" + std::to_string(::getpid()));
  const DiskCache cache(folder);
  int made = 0;
  const auto make = [&] {
    ++made;
    return std::vector{Checkers("red", 200), Texture{}, Checkers("dark", 3)};
  };
  const std::vector<Texture> first = KeptTextures(cache, "checkers", make), second = KeptTextures(cache, "checkers", make);
  EXPECT_EQ(made, 1);
  ASSERT_EQ(second.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(second[i].name, first[i].name);
    EXPECT_EQ(second[i].srgb, first[i].srgb);
    EXPECT_EQ(second[i].wrap_u, first[i].wrap_u);
    EXPECT_EQ(second[i].wrap_v, first[i].wrap_v);
    EXPECT_EQ(second[i].levels, first[i].levels);
  }
  EXPECT_FALSE(first[0].levels.empty());
  KeptTextures(cache, "others", make);
  EXPECT_EQ(made, 2);
  // Nothing is kept without a folder.
  KeptTextures(DiskCache(""), "checkers", make);
  EXPECT_EQ(made, 3);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace airsim360::internal

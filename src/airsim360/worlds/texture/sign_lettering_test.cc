#include "airsim360/worlds/texture/sign_lettering.h"

#include <gtest/gtest.h>

#include <string>

namespace airsim360::internal {
namespace {

// Ink of a line on a raster of 48 rows, as text.
std::string Raster(const SignLettering& line) {
  std::string out;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < static_cast<int>(line.width() * 48); ++x)
      out += line.Inked((static_cast<float>(x) + 0.5f) / 48, (static_cast<float>(y) + 0.5f) / 48) ? '#' : '.';
  return out;
}

TEST(SignLettering, EveryLetterIsDrawnAndLooksLikeNoOther) {
  const std::string letters = "ABCDEFGHIJKLMNPQRSTUVWXYZ123456789&.,-+!'/%";
  for (char a : letters) {
    const std::string ink = Raster(SignLettering(std::string(1, a)));
    EXPECT_NE(ink.find('#'), std::string::npos) << a;
    for (char b : letters) {
      if (a < b) {
        EXPECT_NE(ink, Raster(SignLettering(std::string(1, b)))) << a << " " << b;
      }
    }
  }
}

TEST(SignLettering, AnLIsAStemAndAFoot) {
  const SignLettering line("L", 0.2f);
  EXPECT_TRUE(line.Inked(0.1f, 0.02f));
  EXPECT_TRUE(line.Inked(0.1f, 0.98f));
  EXPECT_TRUE(line.Inked(line.width() - 0.02f, 0.9f));
  EXPECT_FALSE(line.Inked(line.width() - 0.02f, 0.7f));
  EXPECT_FALSE(line.Inked(0.1f, 1.01f));
  EXPECT_FALSE(line.Inked(-0.01f, 0.5f));
}

TEST(SignLettering, LettersStandApartAndSpacesStayBare) {
  const SignLettering line("H H");
  const float middle = line.width() / 2;
  for (float y = 0.05f; y < 1; y += 0.1f) EXPECT_FALSE(line.Inked(middle, y));
  EXPECT_EQ(SignLettering("").width(), 0);
  EXPECT_FALSE(SignLettering("").Inked(0, 0.5f));
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/eval/files/class_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

std::string Refusal(const std::string& text) {
  try {
    ParseClassFile(text, "c.txt", false);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClassFile, AByteOrderMarkIsNoPartOfTheFirstId) {
  const auto classes = ParseClassFile(
      "\xef\xbb\xbf"
      "3 road\n7 sky\n",
      "c.txt", false);
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_EQ(classes[0].id, 3u);
  EXPECT_EQ(classes[0].name, "road");
}

TEST(ClassFile, LinesOfOneKindAreReadAndOthersAreRefusedByNumber) {
  EXPECT_EQ(ParseClassFile("road\nside walk\n", "c.txt", false)[1].id, 1u);
  EXPECT_EQ(ParseClassFile("side walk 4\nroad 2\n", "c.txt", false)[0].id, 4u);
  EXPECT_EQ(ParseClassFile("# ids\n4: side walk 2\n", "c.txt", false)[0].name, "side walk 2");
  EXPECT_NE(Refusal("-1 x\n").find("c.txt:1: '-1 x' begins with a number that is no id"), std::string::npos) << Refusal("-1 x\n");
  EXPECT_NE(Refusal("0 a\n99999999999 b\n").find("c.txt:2"), std::string::npos);
  EXPECT_NE(Refusal("1.5 x\n").find("no id"), std::string::npos);
  EXPECT_NE(Refusal("3\n4\n").find("number without a name"), std::string::npos);
  EXPECT_NE(Refusal("3 road\n\nsky\n").find("c.txt:3: 'sky' is of another kind"), std::string::npos) << Refusal("3 road\n\nsky\n");
  EXPECT_NE(Refusal("3 road\nsky 7\n").find("another kind"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/base/checksum.h"

#include <gtest/gtest.h>

#include <string>

#include "airsim360/base/file.h"

namespace airsim360 {
namespace {

// Values of the xxHash reference implementation.
TEST(Checksum, IsXxh64) {
  EXPECT_EQ(Checksum({}), 0xEF46DB3751D8E999);
  EXPECT_EQ(Checksum(AsBytes("a")), 0xD24EC4F1A98C6E5B);
  EXPECT_EQ(Checksum(AsBytes("abc")), 0x44BC2CF5AD770999);
  EXPECT_EQ(Checksum(AsBytes("Nobody inspects the spammish repetition")), 0xFBCEA83C8A378BF1);
}

TEST(Checksum, EveryBitOfEveryLengthCounts) {
  for (size_t size : {1, 3, 4, 7, 8, 31, 32, 33, 63, 100}) {
    std::string text(size, 'x');
    const uint64_t whole = Checksum(AsBytes(text));
    for (size_t bit = 0; bit < 8 * size; ++bit) {
      text[bit / 8] = static_cast<char>(text[bit / 8] ^ 1 << bit % 8);
      EXPECT_NE(Checksum(AsBytes(text)), whole) << size << " " << bit;
      text[bit / 8] = static_cast<char>(text[bit / 8] ^ 1 << bit % 8);
    }
    EXPECT_NE(Checksum(AsBytes(text + 'x')), whole);
  }
}

}  // namespace
}  // namespace airsim360

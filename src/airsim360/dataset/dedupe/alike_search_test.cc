#include "airsim360/dataset/dedupe/alike_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/dedupe/onnx_header.h"

namespace airsim360::internal {
namespace {

TEST(AlikeSearch, TheLargestProductIsThatOfAllAndTheFirstOfEquals) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (const size_t length : {2, 15, 16, 67}) {
    constexpr size_t kRows = 5000;
    std::vector<float> rows(kRows * length), row(length);
    for (float& v : rows) v = normal(random);
    for (float& v : row) v = normal(random);
    size_t best = 0;
    double largest = -1e9;
    for (size_t r = 0; r < kRows; ++r) {
      double product = 0;
      for (size_t i = 0; i < length; ++i) product += double{rows[r * length + i]} * double{row[i]};
      if (product > largest) best = r, largest = product;
    }
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      const auto found = LargestProduct(rows, row);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->first, best);
      EXPECT_NEAR(found->second, largest, 1e-4);
      // The same row thrice, in tasks of different threads.
      std::vector<float> same = rows;
      for (const size_t r : {1000, 2500, 4999})
        std::ranges::transform(row, same.begin() + static_cast<ptrdiff_t>(r * length), [](float v) { return 100 * v; });
      EXPECT_EQ(LargestProduct(same, row)->first, 1000u);
    }
  }
  EXPECT_FALSE(LargestProduct({}, std::vector<float>{1, 2}));
}

// AveragePool and Flatten over 1 x 3 x 32 x 64, opset 9: tests/formats/sscd_test.py writes it.
std::vector<std::byte> SmallNetwork() {
  const std::string hex =
      "08041204746573743ab9010a4d0a0770696374757265120563656c6c731a0563656c6c73220b41766572616765506f6f6c2a150a0c6b"
      "65726e656c5f736861706540084008a001072a100a077374726964657340084008a001070a270a0563656c6c731203726f771a03726f"
      "772207466c617474656e2a0b0a04617869731801a001021204706f6f6c5a210a077069637475726512160a14080112100a0208010a02"
      "08030a0208200a02084062160a03726f77120f0a0d080112090a0208010a0312016e42040a001009";
  std::vector<std::byte> bytes;
  for (size_t i = 0; i < hex.size(); i += 2) bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

TEST(OnnxHeader, TellsTheSizeOfThePicture) {
  const OnnxHeader header = ReadOnnxHeader(SmallNetwork(), "net.onnx");
  EXPECT_EQ(header.opset, 9);
  EXPECT_EQ(header.width, 64);
  EXPECT_EQ(header.height, 32);
}

TEST(OnnxHeader, NoDamagedFileGivesASizeOutOfRangeOrAnotherError) {
  const std::vector<std::byte> whole = SmallNetwork();
  const auto read = [](const std::vector<std::byte>& bytes) {
    try {
      const OnnxHeader header = ReadOnnxHeader(bytes, "net.onnx");
      for (const int side : {header.width, header.height}) EXPECT_TRUE(side == 0 || (side >= kLeastSide && side <= kMostSide)) << side;
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("net.onnx"), 0u);
      return false;
    }
  };
  // Every byte with every value; every length.
  for (size_t at = 0; at < whole.size(); ++at) {
    std::vector<std::byte> damaged = whole;
    for (int value = 0; value < 256; ++value) {
      damaged[at] = static_cast<std::byte>(value);
      read(damaged);
    }
    EXPECT_FALSE(read({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(at)})) << at;
  }
}

}  // namespace
}  // namespace airsim360::internal

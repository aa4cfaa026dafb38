#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <vector>

#include "airsim360/base/base64.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/json_depth.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

TEST(Hash, MatchesThePublishedVector) {
  // FIPS 180-4 example: SHA-256("abc").
  EXPECT_EQ(Sha256Hex(AsBytes("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Random, StreamsDependOnlyOnTheirKeyAndAreUniform) {
  RngStream a(1, "people", 7), b(1, "people", 7), c(1, "people", 8);
  EXPECT_EQ(a.Bits(), b.Bits());
  EXPECT_NE(a.Bits(), c.Bits());
  double sum = 0, square = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double u = a.Uniform();
    sum += u;
    square += u * u;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.005);           // 5 standard errors of the mean of U(0,1)
  EXPECT_NEAR(square / kCount, 1.0 / 3.0, 0.005);  // second moment
}

TEST(Parallel, EveryIndexIsVisitedExactlyOnceWithAnyThreadCount) {
  for (int threads : {1, 2, 0}) {
    ThreadLimit limit(threads);
    std::vector<std::atomic<int>> visits(1000);
    ParallelFor(1000, [&](int64_t i) { ++visits[static_cast<size_t>(i)]; });
    for (const auto& v : visits) EXPECT_EQ(v.load(), 1);
  }
}

TEST(Parallel, ExceptionsReachTheCaller) {
  EXPECT_THROW(ParallelFor(8,
                           [](int64_t i) {
                             if (i == 3) throw InputError("three");
                           }),
               InputError);
}

TEST(File, AnUnwritableTargetLeavesTheOldFileAndNoTemporary) {
  const auto folder = std::filesystem::temp_directory_path() / "airsim360_file_test";
  CreateWritableFolder(folder / "target");  // a folder cannot be renamed over by a file
  EXPECT_THROW(WriteFileAtomically(folder / "target", "x"), RuntimeError);
  EXPECT_FALSE(std::filesystem::exists(folder / "target.tmp"));
  WriteFileAtomically(folder / "text", "hello");
  EXPECT_EQ(ReadTextFile(folder / "text"), "hello");
  EXPECT_THROW(ReadFile(folder / "text", 4), InputError);
  std::filesystem::remove_all(folder);
}

TEST(File, AMissingFileNamesTheNearOneBesideItAndNoneWhereNothingIsNear) {
  const auto folder = std::filesystem::temp_directory_path() / "airsim360_near_file_test";
  CreateWritableFolder(folder);
  WriteFileAtomically(folder / "calibration.yaml", "x");
  const auto message = [&](const char* name) {
    try {
      ReadFile(folder / name);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("calibratoin.yaml"),
            (folder / "calibratoin.yaml").string() + ": no such file; did you mean '" + (folder / "calibration.yaml").string() + "'?");
  EXPECT_EQ(message("q"), (folder / "q").string() + ": no such file");
  std::filesystem::remove_all(folder);
}

TEST(JsonDepth, CountsOpenBracketsOutsideOfStrings) {
  const std::pair<const char*, int> cases[] = {
      {"", 0},     {"7", 0},  {"[]", 1}, {R"({"a": [1, {"b": []}]})", 4}, {R"("[[[")", 0}, {R"(["\"[[", {}])", 2}, {R"(["\\", [[]]])", 3},
      {"]]][", 0}, {"[[[", 3}};
  for (const auto& [text, depth] : cases) EXPECT_EQ(JsonDepth(text), depth) << text;
}

TEST(Base64, IsThatOfRfc4648) {
  const std::pair<const char*, const char*> cases[] = {{"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
                                                       {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}};
  for (const auto& [bytes, text] : cases) EXPECT_EQ(Base64(bytes), text);
  for (const auto& [bytes, text] : cases) EXPECT_EQ(FromBase64(text), bytes);
}

TEST(Base64, IsReadBackAndWhatIsNoneIsRefused) {
  std::string every;
  for (int i = 0; i < 256; ++i) every += static_cast<char>(255 - i);
  for (size_t size = 250; size <= every.size(); ++size) EXPECT_EQ(FromBase64(Base64(every.substr(0, size))), every.substr(0, size));
  for (const char* text : {"Z", "Zg", "Zg=", "Zg==Zg==", "Z===", "====", "Zm9v Zm9v", "Zm9-", "=m9v"})
    EXPECT_EQ(FromBase64(text), std::nullopt) << text;
}

}  // namespace
}  // namespace airsim360

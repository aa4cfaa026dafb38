#include "airsim360/base/disk_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

class DiskCacheTest : public ::testing::Test {
 protected:
  DiskCacheTest() : folder_(fs::temp_directory_path() / ("airsim360_cache_" + std::to_string(::getpid()))) { fs::remove_all(folder_); }
  ~DiskCacheTest() override { fs::remove_all(folder_); }

  fs::path OnlyFile() const { return fs::directory_iterator(folder_)->path(); }
  static std::string Text(const std::optional<CacheContent>& found) { return found ? std::string(AsText(found->bytes())) : "missing"; }

  fs::path folder_;
};

TEST_F(DiskCacheTest, GivesBackWhatWasStoredUnderTheSameKeyOnly) {
  const DiskCache cache(folder_);
  const CacheKey key = CacheKey("probes", 1).Add("city").Add(2.5);
  EXPECT_EQ(Text(cache.Load(key)), "missing");
  cache.Store(key, AsBytes("light"));
  EXPECT_EQ(Text(DiskCache(folder_).Load(CacheKey("probes", 1).Add("city").Add(2.5))), "light");
  for (const CacheKey& other : {CacheKey("probes", 2).Add("city").Add(2.5), CacheKey("sky", 1).Add("city").Add(2.5),
                                CacheKey("probes", 1).Add("city").Add(2.0), CacheKey("probes", 1).Add("ci").Add("ty").Add(2.5)}) {
    EXPECT_EQ(Text(cache.Load(other)), "missing");
  }
  cache.Store(key, AsBytes("other light"));
  EXPECT_EQ(Text(cache.Load(key)), "other light");
  cache.Store(key, {});
  EXPECT_EQ(Text(cache.Load(key)), "");
}

TEST_F(DiskCacheTest, DamagedAndCutOffEntriesCountAsMissing) {
  const DiskCache cache(folder_);
  const CacheKey key("probes", 1);
  cache.Store(key, AsBytes("some content"));
  const Bytes good = ReadFile(OnlyFile());
  for (size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{1};
    WriteFileAtomically(folder_ / (key.Name() + ".cache"), bad);
    EXPECT_EQ(Text(cache.Load(key)), "missing") << i;
    bad.assign(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i));
    WriteFileAtomically(folder_ / (key.Name() + ".cache"), bad);
    EXPECT_EQ(Text(cache.Load(key)), "missing") << i;
  }
}

TEST_F(DiskCacheTest, AChangedByteAnywhereInALargeEntryIsFoundAndAWholeOneComesBackByteForByte) {
  std::string content(5'000'001, 0);
  for (size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 2654435761u >> 13);
  const DiskCache cache(folder_);
  const CacheKey key("scene", 1);
  cache.Store(key, AsBytes(content));
  EXPECT_TRUE(Text(cache.Load(key)) == content);
  const Bytes good = ReadFile(OnlyFile());
  for (size_t at : {good.size() - 1, good.size() / 2, good.size() - content.size(), size_t{1} << 20}) {
    Bytes bad = good;
    bad[at] ^= std::byte{4};
    WriteFileAtomically(folder_ / (key.Name() + ".cache"), bad);
    EXPECT_TRUE(Text(cache.Load(key)) == "missing") << at;
  }
  // Two blocks that have changed places.
  Bytes bad = good;
  const auto first = bad.end() - static_cast<std::ptrdiff_t>(content.size());
  std::swap_ranges(first, first + (1 << 20), first + (1 << 20));
  WriteFileAtomically(folder_ / (key.Name() + ".cache"), bad);
  EXPECT_TRUE(Text(cache.Load(key)) == "missing");
}

TEST_F(DiskCacheTest, OverItsLimitTheLongestUnusedEntriesGo) {
  const std::string content(1000, 'x');
  const DiskCache cache(folder_, 3500);
  std::vector<CacheKey> keys;
  for (int i = 0; i < 4; ++i) {
    keys.push_back(CacheKey("probes", i));
    cache.Store(keys.back(), AsBytes(content));
    // Times of files are coarse: set them apart by hand, the first one used last.
    for (int k = 0; k <= i; ++k) {
      const fs::path path = folder_ / (keys[static_cast<size_t>(k)].Name() + ".cache");
      if (fs::exists(path)) fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(k == 0 ? 1 : 10 - k));
    }
  }
  EXPECT_NE(Text(cache.Load(keys[0])), "missing");
  EXPECT_EQ(Text(cache.Load(keys[1])), "missing");
  EXPECT_NE(Text(cache.Load(keys[2])), "missing");
  EXPECT_NE(Text(cache.Load(keys[3])), "missing");
  cache.Store(CacheKey("huge", 1), AsBytes(std::string(5000, 'y')));
  EXPECT_EQ(Text(cache.Load(CacheKey("huge", 1))), "missing");
  EXPECT_NE(Text(cache.Load(keys[0])), "missing");
}

TEST_F(DiskCacheTest, WithoutAFolderOrAPlaceToWriteItKeepsNothingAndDoesNotFail) {
  const CacheKey key("probes", 1);
  const DiskCache none((fs::path()));
  none.Store(key, AsBytes("light"));
  EXPECT_EQ(Text(none.Load(key)), "missing");
  const DiskCache nowhere("/proc/airsim360");
  nowhere.Store(key, AsBytes("light"));
  EXPECT_EQ(Text(nowhere.Load(key)), "missing");
  ::setenv("AIRSIM360_CACHE", folder_.c_str(), 1);
  EXPECT_EQ(DiskCache::OfUser().folder(), folder_);
  ::unsetenv("AIRSIM360_CACHE");
}

TEST_F(DiskCacheTest, ProgramsShareEntriesOnlyWhereTheyAreToldThatTheyAreOne) {
  const char* const before = std::getenv("AIRSIM360_CACHE_PROGRAM");
  const std::string kept = before ? before : "";
  const auto name = [] { return CacheKey("scene", 1).AddProgram().Name(); };
  ::unsetenv("AIRSIM360_CACHE_PROGRAM");
  const std::string own = name();
  ::setenv("AIRSIM360_CACHE_PROGRAM", "one", 1);
  const std::string one = name();
  EXPECT_EQ(one, CacheKey("scene", 1).Add("one").Name());  // of whatever program
  EXPECT_NE(one, own);
  ::setenv("AIRSIM360_CACHE_PROGRAM", "other", 1);
  EXPECT_NE(name(), one);
  before ? ::setenv("AIRSIM360_CACHE_PROGRAM", kept.c_str(), 1) : ::unsetenv("AIRSIM360_CACHE_PROGRAM");
}

}  // namespace
}  // namespace airsim360

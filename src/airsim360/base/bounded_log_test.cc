#include "airsim360/base/bounded_log.h"

#include <gtest/gtest.h>

namespace airsim360 {
namespace {

TEST(BoundedLog, WritesTheFirstLinesOfAPeriodAndThenHowManyWereLeftOut) {
  BoundedLog log;
  const BoundedLog::Clock::time_point start = BoundedLog::Clock::now();
  size_t written = 0;
  for (int i = 0; i < 500; ++i) written += log.LineAt("again", start + std::chrono::milliseconds(i)) == "again";
  EXPECT_EQ(written, BoundedLog::kLines);
  EXPECT_EQ(log.LineAt("again", start + BoundedLog::kPeriod), "again (495 more such lines were left out)");
  EXPECT_EQ(log.LineAt("again", start + BoundedLog::kPeriod), "again");
}

}  // namespace
}  // namespace airsim360

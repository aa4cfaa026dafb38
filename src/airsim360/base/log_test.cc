#include "airsim360/base/log.h"

#include <gtest/gtest.h>

#include <thread>

namespace airsim360 {
namespace {

using std::chrono::milliseconds;

// gtest's capture is a file: no terminal.
TEST(Progress, OffATerminalWorkThatTakesLongIsToldInLines) {
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("collect", 100, milliseconds(5));
    bar.Update(37);
    std::this_thread::sleep_for(milliseconds(200));
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("collect: 37/100, 0:0"), std::string::npos) << told;
  EXPECT_NE(told.find(" left\n"), std::string::npos) << told;
  EXPECT_EQ(told.find('\r'), std::string::npos);
  EXPECT_GE(std::count(told.begin(), told.end(), '\n'), 2);
}

TEST(Progress, AStepThatTakesLongIsToldWhileItLasts) {
  testing::internal::CaptureStderr();
  {
    const LongTask task("building x", milliseconds(5));
    std::this_thread::sleep_for(milliseconds(100));
    EXPECT_GE(task.seconds(), 0.1);
  }
  EXPECT_NE(testing::internal::GetCapturedStderr().find("building x: 0 s\n"), std::string::npos);
}

TEST(Progress, WhatIsOverSoonIsNotTold) {
  testing::internal::CaptureStderr();
  for (int i = 0; i < 20; ++i) {
    const LongTask task("building x");
    ProgressBar bar("collect", i);
    bar.Update(i);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ClockText, IsForPeople) {
  EXPECT_EQ(ClockText(0), "0:00");
  EXPECT_EQ(ClockText(59.6), "1:00");
  EXPECT_EQ(ClockText(187), "3:07");
  EXPECT_EQ(ClockText(3727), "1:02:07");
  EXPECT_EQ(ClockText(-1), "0:00");
  EXPECT_EQ(ClockText(1e300), ClockText(1e9));
}

}  // namespace
}  // namespace airsim360

// How many steps are due: in lockstep and by the wall clock, when paused, and until what calls have asked
// for.
#include "airsim360/rpc/session/pacer.h"

#include <gtest/gtest.h>

#include <thread>

namespace airsim360 {
namespace {

using namespace std::chrono_literals;

constexpr int64_t kMs = 1'000'000;

// A reply that counts its answers.
Reply Counting(int& answers) {
  return Reply(
      1, "simContinueForTime", 1, [&answers](WireBlocks) { ++answers; }, [] { return true; });
}

class EveryDuration : public testing::TestWithParam<int64_t> {};

INSTANTIATE_TEST_SUITE_P(Pacer, EveryDuration, testing::Values(0, 1, 3 * kMs, kFrameNs, 250 * kMs, 3'600'000 * kMs));

TEST_P(EveryDuration, InLockstepPassesAtOnceAndNoFurther) {
  Pacer pacer(true, 1);
  int answers = 0;
  const int64_t start = 7 * kMs, end = start + GetParam();
  EXPECT_TRUE(pacer.paused());
  EXPECT_EQ(pacer.Due(start), start);
  pacer.Continue(start, GetParam(), Counting(answers));
  EXPECT_FALSE(pacer.paused());
  EXPECT_EQ(pacer.Due(start), end);
  EXPECT_FALSE(pacer.NextDue(start, kMs).has_value());
  if (GetParam() > 0) {
    EXPECT_TRUE(pacer.Reached(end - 1).empty());
  }
  std::vector<Reply> due = pacer.Reached(end);
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(answers, 0) << "answering is for the caller";
  due[0].Nil();
  EXPECT_EQ(answers, 1);
  EXPECT_TRUE(pacer.paused());
  EXPECT_EQ(pacer.Due(end), end);
  EXPECT_TRUE(pacer.Reached(end).empty()) << "once";
}

TEST_P(EveryDuration, BeforeItsEndAPauseAnswersIt) {
  for (bool lockstep : {false, true}) {
    Pacer pacer(lockstep, 1);
    int answers = 0;
    pacer.Continue(0, GetParam() + 1, Counting(answers));
    pacer.Pause(true, 0);
    EXPECT_EQ(answers, 1);
    EXPECT_TRUE(pacer.paused());
    EXPECT_EQ(pacer.Due(0), 0);
    EXPECT_TRUE(pacer.Reached(GetParam() + 1).empty());
  }
}

TEST_P(EveryDuration, ALaterOneReplacesTheEndAndBothAreAnsweredThere) {
  Pacer pacer(true, 1);
  int first = 0, second = 0;
  pacer.Continue(0, 100 * kMs, Counting(first));
  pacer.Continue(10 * kMs, GetParam(), Counting(second));
  EXPECT_EQ(pacer.Due(10 * kMs), 10 * kMs + GetParam());
  for (const Reply& reply : pacer.Reached(10 * kMs + GetParam())) reply.Nil();
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
}

class EverySpeed : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Pacer, EverySpeed, testing::Values(0.1, 0.5, 1.0, 3.0, 10.0));

// No bound from above is a matter of the machine alone: what is due lies between the clock's readings before
// and after.
TEST_P(EverySpeed, TimePassesByTheWallClockTimesTheSpeed) {
  Pacer pacer(false, GetParam());
  const auto before = Pacer::Clock::now();
  EXPECT_EQ(pacer.Due(5 * kMs) / kMs, 5);  // starts here
  const auto started = Pacer::Clock::now();
  std::this_thread::sleep_for(4ms);
  const auto asked = Pacer::Clock::now();
  const double due = static_cast<double>(pacer.Due(5 * kMs) - 5 * kMs) * 1e-9;
  const auto answered = Pacer::Clock::now();
  const auto seconds = [](auto d) { return std::chrono::duration<double>(d).count(); };
  EXPECT_GE(due, std::min(0.25, GetParam() * seconds(asked - started)) - 1e-6);
  EXPECT_LE(due, std::min(0.25, GetParam() * seconds(answered - before)) + 1e-6);
}

TEST_P(EverySpeed, TheNextStepIsDueAStepLaterOnTheSlowedClock) {
  Pacer pacer(false, GetParam());
  EXPECT_FALSE(pacer.NextDue(0, kMs).has_value()) << "nothing runs yet";
  pacer.Due(0);
  const auto one = pacer.NextDue(0, 30 * kMs), two = pacer.NextDue(30 * kMs, 30 * kMs);
  ASSERT_TRUE(one && two);
  EXPECT_NEAR(std::chrono::duration<double>(*two - *one).count(), 0.03 / GetParam(), 1e-6);
  pacer.Pause(true, 0);
  EXPECT_FALSE(pacer.NextDue(0, kMs).has_value());
}

// What the machine could not keep up with is given up: never more than a quarter of a second at once.
TEST_P(EverySpeed, NeverMakesUpForMoreThanAQuarterOfASecond) {
  Pacer pacer(false, 1000 * GetParam());
  pacer.Due(0);
  std::this_thread::sleep_for(3ms);
  EXPECT_LE(pacer.Due(0), 250 * kMs);
  std::this_thread::sleep_for(1ms);
  EXPECT_LE(pacer.Due(0), 250 * kMs);
}

TEST_P(EverySpeed, AContinueEndsWhereItWasAskedToHoweverLateItIs) {
  Pacer pacer(false, 1000 * GetParam());
  int answers = 0;
  pacer.Continue(0, 2 * kMs, Counting(answers));
  std::this_thread::sleep_for(3ms);
  EXPECT_EQ(pacer.Due(0), 2 * kMs);
}

TEST(Pacer, APausedClockStandsStillAndGoesOnFromThere) {
  Pacer pacer(false, 1);
  EXPECT_FALSE(pacer.paused());
  pacer.Due(0);
  pacer.Pause(true, 40 * kMs);
  std::this_thread::sleep_for(3ms);
  EXPECT_EQ(pacer.Due(40 * kMs), 40 * kMs);
  const auto before = Pacer::Clock::now();
  pacer.Pause(false, 40 * kMs);
  const double due = static_cast<double>(pacer.Due(40 * kMs) - 40 * kMs) * 1e-9;
  EXPECT_GE(due, 0);
  EXPECT_LE(due, std::chrono::duration<double>(Pacer::Clock::now() - before).count() + 1e-6);
  EXPECT_EQ(pacer.real_time_factor(), 1);
}

}  // namespace
}  // namespace airsim360

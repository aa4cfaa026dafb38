// Jobs that wait for a thread: order, waiting, and the end.
#include "airsim360/base/work_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace airsim360 {
namespace {

using namespace std::chrono_literals;

TEST(WorkQueue, GivesJobsOutInTheirOrder) {
  WorkQueue<int> queue;
  for (int i = 0; i < 5; ++i) queue.Post(i);
  EXPECT_EQ(queue.Next(), 0);
  EXPECT_EQ(queue.NextWithin(0s), 1);
  EXPECT_EQ(queue.TakeAll(), (std::vector<int>{2, 3, 4}));
  EXPECT_TRUE(queue.TakeAll().empty());
  EXPECT_EQ(queue.NextWithin(0s), std::nullopt);
}

TEST(WorkQueue, EveryJobIsDoneOnceByWhateverThread) {
  WorkQueue<int> queue;
  std::atomic<int> sum = 0, done = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      while (const auto job = queue.Next()) {
        sum += *job;
        ++done;
      }
    });
  }
  constexpr int kJobs = 1000;
  for (int i = 1; i <= kJobs; ++i) queue.Post(i);
  while (done < kJobs) std::this_thread::yield();
  queue.Stop();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sum, kJobs * (kJobs + 1) / 2);
}

TEST(WorkQueue, StopWakesThoseWhoWaitAndDropsWhatIsLeft) {
  WorkQueue<int> queue;
  std::thread waits([&] { EXPECT_EQ(queue.Next(), std::nullopt); });
  std::thread waits_too([&] { queue.WaitUntil(std::nullopt); });
  queue.Stop();
  waits.join();
  waits_too.join();
  queue.Post(7);
  EXPECT_TRUE(queue.stopped());
  EXPECT_EQ(queue.Next(), std::nullopt);
  EXPECT_TRUE(queue.TakeAll().empty());
}

TEST(WorkQueue, WaitingEndsWithAJobOrWithTheTime) {
  WorkQueue<int> queue;
  const auto time = WorkQueue<int>::Clock::now() + 20ms;
  queue.WaitUntil(time);
  EXPECT_GE(WorkQueue<int>::Clock::now(), time);
  queue.Post(1);
  queue.WaitUntil(std::nullopt);  // would never return without the job
  EXPECT_EQ(queue.TakeAll().size(), 1u);
}

}  // namespace
}  // namespace airsim360

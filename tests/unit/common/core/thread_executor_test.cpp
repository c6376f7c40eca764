#include "common/core/thread_executor.h"

#include <condition_variable>
#include <latch>
#include <mutex>

#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Something that a test waits for, with a limit that only a hang reaches.
class Signal {
 public:
  void raise() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
  }
  [[nodiscard]] bool waitFor(int count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, seconds(20), [&] { return count_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

/// The steady clock, pushed forward by a test.
class SkippingClock final : public Clock {
 public:
  [[nodiscard]] Stamp now() const override { return steady_.now() + Duration(skipped_ns_.load()); }
  void skip(Duration d) { skipped_ns_ += d.count(); }

 private:
  SteadyClock steady_;
  std::atomic<std::int64_t> skipped_ns_{0};
};

TEST(ThreadExecutor, RunsEachTickAndEndsThemAtStop) {
  const SteadyClock clock;
  ThreadExecutor executor(clock, 1);
  Signal fast, slow;
  executor.every(milliseconds(1), "fast", kPriorityControl, [&](Stamp) { fast.raise(); });
  executor.every(milliseconds(2), "slow", kPriorityMission, [&](Stamp) { slow.raise(); });
  executor.start();
  EXPECT_TRUE(fast.waitFor(5));
  EXPECT_TRUE(slow.waitFor(3));
  executor.stop();  // joins: no tick runs after this
  const auto before = executor.statistics();
  ASSERT_EQ(before.size(), 2U);
  EXPECT_EQ(before[0].name, "fast");
  EXPECT_GE(before[0].ticks, 5U);
  EXPECT_GE(before[1].ticks, 3U);
}

TEST(ThreadExecutor, CountsMissedPeriodsAsSlipsAndDoesNotCatchUp) {
  SkippingClock clock;
  ThreadExecutor executor(clock, 0);
  Signal ticked;
  std::atomic<int> ticks{0};
  executor.every(milliseconds(10), "control", kPriorityControl, [&](Stamp) {
    if (++ticks == 1) clock.skip(milliseconds(1000));  // as if this tick had taken a second
    ticked.raise();
  });
  executor.start();
  ASSERT_TRUE(ticked.waitFor(2));
  executor.stop();
  const TickStatistics statistics = executor.statistics().at(0);
  EXPECT_GE(statistics.slips, 98U);  // 1000 ms / 10 ms, less the period that was due and rounding
  EXPECT_GT(statistics.worst_late_s, 0.9);
  EXPECT_LT(statistics.ticks, 50U) << "missed ticks are not made up for in a burst";
}

TEST(ThreadExecutor, DeliversJobsFromThePool) {
  const SteadyClock clock;
  ThreadExecutor executor(clock, 2);
  executor.start();
  Signal delivered;
  EXPECT_TRUE(executor.post(
      {"a", {}, [&](std::stop_token) -> Delivery { return [&] { delivered.raise(); }; }}));
  EXPECT_TRUE(executor.post(
      {"b", {}, [&](std::stop_token) -> Delivery { return [&] { delivered.raise(); }; }}));
  EXPECT_TRUE(delivered.waitFor(2));
}

// With real-time priority where the machine gives it: the kernel wakes by priority, so a tick that
// can take the pool's wake-up takes it each time.
TEST(ThreadExecutor, RunsEveryJobBesideTicksThatWait) {
  const SteadyClock clock;
  ThreadExecutor executor(clock, 1);
  for (const char* name : {"control", "arm", "mission"})
    executor.every(seconds(30), name, kPriorityControl, [](Stamp) {});
  executor.every(milliseconds(8), "busy", kPriorityControl, [](Stamp) {});
  executor.start();
  Signal delivered;
  constexpr int kJobs = 1000;
  for (int i = 1; i <= kJobs; ++i) {
    const Job job{
        "job", {}, [&](std::stop_token) -> Delivery { return [&] { delivered.raise(); }; }};
    while (!executor.post(job)) std::this_thread::yield();  // delivered, not yet taken off the list
    ASSERT_TRUE(delivered.waitFor(i)) << "job " << i << " lies";
  }
}

TEST(ThreadExecutor, KeepsOneJobOfAKindInFlightAndCountsTheRefused) {
  const SteadyClock clock;
  ThreadExecutor executor(clock, 1);
  std::latch release(1);
  Signal running, done;
  executor.start();
  const Job scan{"scan", {}, [&](std::stop_token) -> Delivery {
                   running.raise();
                   release.wait();
                   return [&] { done.raise(); };
                 }};
  ASSERT_TRUE(executor.post(scan));
  ASSERT_TRUE(running.waitFor(1));
  EXPECT_FALSE(executor.post(scan)) << "one is running";
  const Job heat{"heat", {}, [&](std::stop_token) -> Delivery { return [&] { done.raise(); }; }};
  EXPECT_TRUE(executor.post(heat)) << "another kind is no obstacle";
  EXPECT_FALSE(executor.post(heat)) << "one is waiting";
  EXPECT_EQ(executor.droppedJobs(), 2U);
  release.count_down();
  EXPECT_TRUE(done.waitFor(2));
}

TEST(ThreadExecutor, AsksARunningJobToStop) {
  const SteadyClock clock;
  Signal running;
  bool asked = false;
  {
    ThreadExecutor executor(clock, 1);
    executor.start();
    executor.post({"long", {}, [&](std::stop_token stop) -> Delivery {
                     std::mutex mutex;
                     std::condition_variable_any wake;
                     std::unique_lock lock(mutex);
                     running.raise();
                     wake.wait_for(lock, stop, seconds(20), [] { return false; });
                     asked = stop.stop_requested();
                     return {};
                   }});
    ASSERT_TRUE(running.waitFor(1));
  }  // the destructor stops and joins
  EXPECT_TRUE(asked);
}

}  // namespace
}  // namespace kiln

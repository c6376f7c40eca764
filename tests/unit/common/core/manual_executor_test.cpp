#include "common/core/manual_executor.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

Stamp at(int ms) { return Stamp{milliseconds(ms)}; }

class ManualExecutorTest : public ::testing::Test {
 protected:
  void note(const std::string& what) {
    log_.push_back(fmt::format("{}@{}", what, toNanoseconds(clock_.now()) / 1'000'000));
  }
  Job job(const std::string& kind, int latency_ms) {
    return {kind, milliseconds(latency_ms), [this, kind](std::stop_token) -> Delivery {
              note("run " + kind);
              return [this, kind] { note("deliver " + kind); };
            }};
  }
  ManualClock clock_;
  ManualExecutor executor_{clock_};
  std::vector<std::string> log_;
};

TEST_F(ManualExecutorTest, OrdersEventsByTimeThenPriorityThenSequence) {
  executor_.at(at(2), 5, [this] { note("late"); });
  executor_.at(at(1), 9, [this] { note("unimportant"); });
  executor_.at(at(1), 1, [this] { note("first"); });
  executor_.at(at(1), 1, [this] { note("second"); });
  executor_.runUntil(at(2));
  EXPECT_THAT(log_, ElementsAre("first@1", "second@1", "unimportant@1", "late@2"));
}

TEST_F(ManualExecutorTest, RunsRateGroupsInOrderOfPriorityAtTheSameInstant) {
  executor_.every(milliseconds(10), "telemetry", kPriorityTelemetry,
                  [this](Stamp) { note("telemetry"); });
  executor_.every(milliseconds(5), "control", kPriorityControl, [this](Stamp) { note("control"); });
  executor_.every(milliseconds(10), "mission", kPriorityMission,
                  [this](Stamp) { note("mission"); });
  ASSERT_TRUE(executor_.post(job("look", 10)));
  executor_.runUntil(at(10));
  EXPECT_THAT(log_, ElementsAre("run look@0", "control@5", "deliver look@10", "mission@10",
                                "control@10", "telemetry@10"));
}

TEST_F(ManualExecutorTest, TicksGetTheirOwnTimeAndTheClockEndsWhereAsked) {
  std::vector<Stamp> ticks;
  executor_.every(milliseconds(4), "tick", kPriorityControl, [&](Stamp now) {
    ticks.push_back(now);
    EXPECT_EQ(now, clock_.now());
  });
  executor_.runUntil(at(10));
  EXPECT_THAT(ticks, ElementsAre(at(4), at(8)));
  EXPECT_EQ(clock_.now(), at(10));
  EXPECT_EQ(executor_.nextEvent(), at(12));
  EXPECT_EQ(executor_.statistics().at(0).ticks, 2U);
}

TEST_F(ManualExecutorTest, DeliversAResultExactlyAtPostPlusLatency) {
  executor_.runUntil(at(3));
  ASSERT_TRUE(executor_.post(job("scan", 7)));
  executor_.runUntil(Stamp{milliseconds(10) - Duration(1)});
  EXPECT_THAT(log_, ElementsAre("run scan@3"));
  executor_.runUntil(at(10));
  EXPECT_THAT(log_, ElementsAre("run scan@3", "deliver scan@10"));
}

TEST_F(ManualExecutorTest, KeepsOneJobOfAKindInFlightAndCountsTheRefused) {
  EXPECT_TRUE(executor_.post(job("scan", 10)));
  EXPECT_FALSE(executor_.post(job("scan", 10)));
  EXPECT_TRUE(executor_.post(job("heat", 10)));  // another kind is no obstacle
  EXPECT_EQ(executor_.droppedJobs(), 1U);
  executor_.runUntil(at(10));
  EXPECT_TRUE(executor_.post(job("scan", 10)));
}

TEST_F(ManualExecutorTest, ADeliveryMayPostTheNextJobOfItsKind) {
  executor_.post({"chain", milliseconds(1), [this](std::stop_token) -> Delivery {
                    return [this] { EXPECT_TRUE(executor_.post(job("chain", 1))); };
                  }});
  executor_.runUntil(at(2));
  EXPECT_THAT(log_, ElementsAre("run chain@1", "deliver chain@2"));
}

TEST_F(ManualExecutorTest, AJobMayHaveNothingToDeliver) {
  EXPECT_TRUE(
      executor_.post({"quiet", milliseconds(1), [](std::stop_token) -> Delivery { return {}; }}));
  executor_.runUntil(at(1));
  EXPECT_TRUE(executor_.post(job("quiet", 1))) << "its kind is free again";
}

TEST(ManualExecutor, NothingPendingSaysSo) {
  ManualClock clock;
  EXPECT_EQ(ManualExecutor(clock).nextEvent(), Stamp::max());
}

}  // namespace
}  // namespace kiln

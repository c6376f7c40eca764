#include "common/client/command_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

Monotonic::time_point at(double s) {
  return Monotonic::time_point(
      std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(s)));
}
CommandAck ack(std::uint64_t nonce, AckOutcome outcome) {
  CommandAck out;
  out.nonce = nonce;
  out.command = "pause";
  out.outcome = outcome;
  return out;
}

TEST(CommandTracker, SilenceIsUnknownAndALateAnswerStillCounts) {
  CommandTracker tracker(1.0);
  EXPECT_EQ(tracker.sent(5, Pause{}, at(0)).state, CommandState::Sent);
  EXPECT_TRUE(tracker.expire(at(0.9)).empty());
  const auto expired = tracker.expire(at(1.1));
  ASSERT_EQ(expired.size(), 1u);
  EXPECT_EQ(expired[0].state, CommandState::Unknown);
  EXPECT_TRUE(tracker.expire(at(2.0)).empty());  // said once
  const auto late = tracker.answered(ack(5, AckOutcome::Done), at(3.0));
  EXPECT_EQ(late.state, CommandState::Done);
  EXPECT_NEAR(late.answered_after_s, 3.0, 1e-9);
}

TEST(CommandTracker, AcceptedIsFollowedToItsEnd) {
  CommandTracker tracker(1.0);
  static_cast<void>(tracker.sent(5, Pause{}, at(0)));
  EXPECT_EQ(tracker.answered(ack(5, AckOutcome::Accepted), at(0.1)).state, CommandState::Accepted);
  EXPECT_TRUE(tracker.expire(at(20)).empty());  // it has been answered: not unknown
  EXPECT_EQ(tracker.answered(ack(5, AckOutcome::Failed), at(30)).state, CommandState::Failed);
}

TEST(CommandTracker, RefusedSetpointsComeThroughWithoutBeingFollowed) {
  CommandTracker tracker(1.0);
  const auto update = tracker.answered(ack(77, AckOutcome::Refused), at(0.1));
  EXPECT_EQ(update.nonce, 77u);
  EXPECT_EQ(update.state, CommandState::Refused);
}

}  // namespace
}  // namespace kiln

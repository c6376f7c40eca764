#include "robot/missions/common/pool_question.h"

#include <gtest/gtest.h>

#include "common/core/manual_executor.h"

namespace kiln {
namespace {

class PoolQuestionTest : public ::testing::Test {
 protected:
  void pass(double seconds) { executor.runUntil(clock.now() + fromSeconds(seconds)); }
  ManualClock clock{Stamp{std::chrono::seconds(1)}};
  ManualExecutor executor{clock};
  PoolQuestion<int> question{executor, "sum", 0.1};
};

TEST_F(PoolQuestionTest, TheAnswerComesWithATickAfterItsLatency) {
  question.ask([] { return 4; });
  question.tick();
  EXPECT_FALSE(question.answer().has_value());
  pass(0.2);
  EXPECT_FALSE(question.answer().has_value()) << "nothing changes between two ticks";
  question.tick();
  EXPECT_EQ(question.answer(), 4);
}

TEST_F(PoolQuestionTest, AnOlderAnswerIsDroppedAndWhatThePoolRefusedIsAskedAgain) {
  question.ask([] { return 1; });
  question.ask([] { return 2; });  // the pool is at work on the first one still
  pass(0.2);
  question.tick();
  EXPECT_FALSE(question.answer().has_value());
  pass(0.2);
  question.tick();
  EXPECT_EQ(question.answer(), 2);
}

TEST_F(PoolQuestionTest, WhatIsClearedIsNotAnswered) {
  question.ask([] { return 1; });
  question.clear();
  pass(0.2);
  question.tick();
  EXPECT_FALSE(question.answer().has_value());
}

/// The answer may come when nobody is there any more.
TEST_F(PoolQuestionTest, MayEndBeforeItsWork) {
  {
    PoolQuestion<int> brief(executor, "brief", 0.1);
    brief.ask([] { return 1; });
  }
  pass(0.2);
}

}  // namespace
}  // namespace kiln

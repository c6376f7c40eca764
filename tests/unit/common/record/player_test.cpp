#include "common/record/player.h"

#include <gtest/gtest.h>

#include "tests/unit/common/record/sample_recording.h"

namespace kiln::test {
namespace {

class PlayerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    writeSample(folder_.file("a.mcap"), 20.0);
    auto reader = RecordReader::open(folder_.file("a.mcap"));
    ASSERT_TRUE(reader) << reader.error();
    player_ = std::make_unique<Player>(*reader, std::vector<std::string>{}, wall_);
  }
  std::vector<std::string> poll(double after_s = 0.0) {
    wall_.advanceBy(fromSeconds(after_s));
    std::vector<std::string> got;
    const auto polled = player_->poll([&](const RecordedMessage& m) { got.emplace_back(m.data); });
    EXPECT_TRUE(polled);
    return got;
  }
  RecordFolder folder_;
  ManualClock wall_{at(500.0)};
  std::unique_ptr<Player> player_;
};

TEST_F(PlayerTest, StandsUntilItIsStartedAndThenKeepsThePace) {
  EXPECT_EQ(player_->position(), at(10.0));
  EXPECT_EQ(poll(3.0).size(), 2u);  // what lies exactly at its place
  player_->play();
  EXPECT_EQ(poll(0.5).size(), 50u);
  EXPECT_EQ(player_->position(), at(10.5));
  EXPECT_EQ(poll(0.0).size(), 0u);
}

TEST_F(PlayerTest, SpeedAndPauseHoldFromWhereItStands) {
  player_->play();
  poll(1.0);
  player_->setSpeed(10.0);
  poll(0.5);
  EXPECT_EQ(player_->position(), at(16.0));
  player_->pause();
  EXPECT_EQ(poll(2.0).size(), 0u);
  EXPECT_EQ(player_->position(), at(16.0));
  player_->setSpeed(0.01);
  EXPECT_EQ(player_->speed(), Player::kMinSpeed);
  player_->play();
  poll(1.0);
  EXPECT_EQ(player_->position(), at(16.1));
}

TEST_F(PlayerTest, SeekShowsWhatWasThereAtOnce) {
  player_->seek(at(15.505));
  EXPECT_EQ(player_->position(), at(15.505));
  const auto got = poll();
  ASSERT_EQ(got.size(), 2u);
  EXPECT_EQ(got[0], "/slow 5");
  EXPECT_EQ(got[1], "/fast 550");
  player_->play();
  const auto next = poll(0.01);
  ASSERT_EQ(next.size(), 1u);
  EXPECT_EQ(next[0], "/fast 551");
  player_->seek(at(11.0));  // back
  EXPECT_EQ(poll().size(), 2u);
  EXPECT_TRUE(player_->playing());
  player_->seek(at(-5.0));
  EXPECT_EQ(player_->position(), at(10.0));
}

TEST_F(PlayerTest, StepsForwardsAndBack) {
  player_->seek(at(12.0));
  poll();
  player_->step(std::chrono::milliseconds(100));
  EXPECT_EQ(poll().size(), 10u);
  EXPECT_EQ(player_->position(), at(12.1));
  player_->step(-std::chrono::milliseconds(600));
  EXPECT_EQ(player_->position(), at(11.5));
  EXPECT_EQ(poll().size(), 2u);
}

TEST_F(PlayerTest, EndsAtTheEndAndCanGoBack) {
  player_->play();
  player_->seek(at(29.0));
  poll();
  EXPECT_EQ(poll(5.0).size(), 99u);
  EXPECT_TRUE(player_->ended());
  EXPECT_FALSE(player_->playing());
  EXPECT_EQ(player_->position(), player_->end());
  player_->play();
  EXPECT_FALSE(player_->playing());
  player_->seek(at(20.0));
  player_->play();
  poll();
  EXPECT_EQ(poll(0.1).size(), 10u);
}

TEST_F(PlayerTest, SlowConsumerSlowsThePlayback) {
  player_->play();
  wall_.advanceBy(std::chrono::seconds(10));
  std::size_t got = 0;
  ASSERT_TRUE(player_->poll([&](const RecordedMessage&) { ++got; }, 100));
  EXPECT_EQ(got, 100u);
  EXPECT_LT(player_->position(), at(11.0));
  // Goes on from there, not from the nine seconds that were missed: ten of /fast, one of /slow.
  EXPECT_EQ(poll(0.1).size(), 11u);
}

}  // namespace
}  // namespace kiln::test

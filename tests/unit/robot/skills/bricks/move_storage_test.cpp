#include "robot/skills/bricks/move_storage.h"

#include <cmath>

#include <gtest/gtest.h>

namespace kiln {
namespace {

class ToldStorage final : public Storage {
 public:
  [[nodiscard]] std::optional<StorageState> state() const override { return now; }
  Result<void> write(std::span<const double> targets_m) override {
    for (const double target : targets_m)
      if (!std::isfinite(target)) return makeError(ErrorCode::InvalidInput, "not finite");
    written.assign(targets_m.begin(), targets_m.end());
    ++writes;
    return {};
  }
  std::optional<StorageState> now;
  std::vector<double> written;
  int writes = 0;
};

class MoveStorageTest : public ::testing::Test {
 protected:
  void stands(double position_m, bool moving = false, bool blocked = false) {
    StorageState state;
    state.stamp = clock;
    state.compartments = {
        {position_m, storage.written.empty() ? 0.0 : storage.written[0], 0.0, moving, blocked}};
    storage.now = state;
  }
  SkillStatus poll(double after_s = 0.02) {
    clock += fromSeconds(after_s);
    if (storage.now) storage.now->stamp = clock;
    return skill.poll(clock);
  }
  Stamp clock{std::chrono::seconds(5)};
  ToldStorage storage;
  MoveStorage skill{{}, storage, {"compartment 1"}};
};

TEST_F(MoveStorageTest, IsThereWhenItStandsAtItsTargetAndIsToldAtEachPoll) {
  stands(0.0);
  skill.start({0.2}, clock);
  EXPECT_EQ(poll().phase, SkillPhase::Running);
  stands(0.199, true);
  EXPECT_EQ(poll().phase, SkillPhase::Running) << "it still moves";
  stands(0.199);
  EXPECT_EQ(poll().phase, SkillPhase::Done);
  EXPECT_EQ(storage.writes, 3);
  EXPECT_EQ(storage.written, std::vector<double>{0.2});
  EXPECT_EQ(poll().phase, SkillPhase::Done);
  EXPECT_EQ(storage.writes, 3) << "told no more once it stands";
}

TEST_F(MoveStorageTest, AJamIsNamed) {
  stands(0.0);
  skill.start({0.2}, clock);
  (void)poll();
  stands(0.11, false, true);
  const SkillStatus status = poll();
  EXPECT_EQ(status.failure_code, "jammed");
  EXPECT_NE(status.text.find("compartment 1"), std::string::npos) << status.text;
}

/// Blocked by an earlier target: what it is told now it may still do.
TEST_F(MoveStorageTest, AnOldJamIsNotOfThisTravel) {
  stands(0.11, false, true);
  storage.now->compartments[0].target_m = 0.3;
  skill.start({0.2}, clock);
  EXPECT_EQ(poll().phase, SkillPhase::Running);
}

TEST_F(MoveStorageTest, SilenceRefusalAndDelayEndIt) {
  skill.start({0.2}, clock);
  EXPECT_EQ(poll().phase, SkillPhase::Running);
  EXPECT_EQ(poll(0.6).failure_code, "no_state");
  skill.start({NAN}, clock);
  EXPECT_EQ(poll().failure_code, "refused");
  stands(0.0);
  skill.start({0.2}, clock);
  EXPECT_EQ(poll(30.0).failure_code, "timeout");
}

}  // namespace
}  // namespace kiln

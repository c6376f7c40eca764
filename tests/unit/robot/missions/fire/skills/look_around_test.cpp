#include "robot/missions/fire/skills/look_around.h"

#include <gmock/gmock.h>

namespace kiln {
namespace {

/// Does what it is told at the next poll; remembers the orders.
class ObedientArm final : public ArmMotion {
 public:
  void setTerms(ArmMoveTerms) override {}
  void startJoints(const Vector6d&, Stamp) override { orders.push_back("joints"); }
  void startTimed(const Vector6d&, double, Stamp) override { orders.push_back("timed"); }
  void startPose(const Eigen::Isometry3d& X, Stamp) override {
    orders.push_back("pose");
    goal = X;
  }
  void startCartesian(std::vector<Eigen::Isometry3d> X, bool, Stamp) override {
    orders.push_back("cartesian " + std::to_string(X.size()));
  }
  void startBack(double, Stamp) override { orders.push_back("back"); }
  [[nodiscard]] SkillStatus poll(Stamp) override {
    return {failure.empty() ? SkillPhase::Done : SkillPhase::Failed, 1.0, failure,
            std::exchange(failure, {})};
  }
  void cancel() override { orders.push_back("cancel"); }
  [[nodiscard]] Result<Vector6d> check(const Eigen::Isometry3d& X) const override {
    if (allowed && !allowed(X)) return makeError(ErrorCode::Refused, "no");
    return Vector6d::Zero().eval();
  }
  std::function<bool(const Eigen::Isometry3d&)> allowed;
  std::vector<std::string> orders;
  std::string failure;
  Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();
};

class LookAroundTest : public testing::Test {
 protected:
  void start() {
    look.start(Eigen::Isometry3d::Identity(), {2.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, Stamp{});
  }
  RobotGeometry robot;
  ObedientArm arm;
  LookAround look{SearchConfig{}, robot, arm};
};

TEST_F(LookAroundTest, GoesToTheFirstCornerThenSweepsWithoutStopping) {
  start();
  EXPECT_FALSE(look.sweeping());
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Running);
  EXPECT_TRUE(look.sweeping());
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Done);
  EXPECT_THAT(arm.orders, testing::ElementsAre("pose", "cartesian 5"));
  // Camera on the flange (default geometry): 1 m before the place, top left.
  EXPECT_TRUE(arm.goal.translation().isApprox(Eigen::Vector3d(1.0, 0.25, 1.12)));
}

TEST_F(LookAroundTest, ShrinksAndMovesTheRectangleUntilItIsReachable) {
  arm.allowed = [](const Eigen::Isometry3d& X) {
    return std::abs(X.translation().y()) < 0.16 && X.translation().x() < 0.95;
  };
  start();
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Running);
  EXPECT_LT(arm.goal.translation().y(), 0.16);
  EXPECT_NEAR(arm.goal.translation().x(), 0.9, 1e-9) << "10 cm farther off";
}

TEST_F(LookAroundTest, SaysWhenNothingIsReachable) {
  arm.allowed = [](const Eigen::Isometry3d&) { return false; };
  start();
  const SkillStatus status = look.poll(Stamp{});
  EXPECT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(status.failure_code, "unreachable");
  EXPECT_TRUE(arm.orders.empty()) << "the arm was not moved";
}

TEST_F(LookAroundTest, VisitsTheCornersWhenStraightLinesAreNotPossible) {
  start();
  (void)look.poll(Stamp{});
  arm.failure = "unreachable";
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Running);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Running);
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Done);
  EXPECT_THAT(arm.orders,
              testing::ElementsAre("pose", "cartesian 5", "pose", "pose", "pose", "pose", "pose"));
}

TEST_F(LookAroundTest, AContactEndsIt) {
  start();
  (void)look.poll(Stamp{});
  arm.failure = "contact";
  const SkillStatus status = look.poll(Stamp{});
  EXPECT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(look.poll(Stamp{}).failure_code, "contact") << "and it stays ended";
}

TEST_F(LookAroundTest, CancelStopsTheArm) {
  start();
  look.cancel();
  EXPECT_EQ(arm.orders.back(), "cancel");
  EXPECT_EQ(look.poll(Stamp{}).phase, SkillPhase::Idle);
}

}  // namespace
}  // namespace kiln

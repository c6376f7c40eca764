#include "robot/missions/wall/skills/lidar_sweep.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

/// Takes half a second to the beginning and the wanted time for the sweep; fails when told.
class TimedArm final : public ArmMotion {
 public:
  void setTerms(ArmMoveTerms) override {}
  void startJoints(const Vector6d&, Stamp now) override { begin(0.5, now); }
  void startTimed(const Vector6d&, double duration_s, Stamp now) override {
    begin(duration_s, now);
    sweeping = true;
  }
  void startPose(const Eigen::Isometry3d&, Stamp now) override { begin(0.5, now); }
  void startCartesian(std::vector<Eigen::Isometry3d>, bool, Stamp now) override { begin(0.5, now); }
  void startBack(double, Stamp now) override { begin(0.5, now); }
  SkillStatus poll(Stamp now) override {
    const double share = toSeconds(now - began_) / duration_s_;
    if (sweeping && share >= fail_at) return {SkillPhase::Failed, share, "touched", "contact"};
    if (share < 1.0) return {SkillPhase::Running, share, "moving", {}};
    return {SkillPhase::Done, 1.0, "there", {}};
  }
  void cancel() override { ++cancels; }
  Result<Vector6d> check(const Eigen::Isometry3d&) const override {
    return Vector6d::Zero().eval();
  }
  /// 0..1 of the sweep.
  [[nodiscard]] double share(Stamp now) const {
    return sweeping ? std::clamp(toSeconds(now - began_) / duration_s_, 0.0, 1.0) : 0.0;
  }
  double fail_at = 2.0;
  int cancels = 0;
  bool sweeping = false;

 private:
  void begin(double duration_s, Stamp now) {
    began_ = now;
    duration_s_ = duration_s;
  }
  Stamp began_;
  double duration_s_ = 1.0;
};

class LidarSweepTest : public ::testing::Test {
 protected:
  static constexpr double kFrom_deg = 5.0, kTo_deg = 25.0;
  Eigen::Isometry3d X_base_lidar(Stamp t) const {
    const double tilt = kFrom_deg + arm.share(t) * (kTo_deg - kFrom_deg);
    return makePose({0.8 + 0.01 * tilt, 0, 1.5}, {0, tilt * kDeg, 0});
  }
  /// A scan each 0.1 s with two points, one with a time in its middle; delivered as it ends.
  void scanEnds() {
    const Stamp begin = now - std::chrono::milliseconds(100);
    auto scan = std::make_shared<PointCloud>();
    scan->stamp = begin;
    scan->frame = "base";
    scan->push(2.0F, 0.0F, 0.5F, 10, 3, 0.02F);
    scan->push(2.0F, 0.1F, 0.5F, 10, 4, 0.05F);
    auto track = std::make_shared<PoseTrack>();
    for (int k = 0; k <= 25; ++k)
      track->push(begin + std::chrono::milliseconds(4 * k),
                  X_base_lidar(begin + std::chrono::milliseconds(4 * k)));
    ScanWindow::Entry entry{scan, Eigen::Isometry3d::Identity(), track->at(begin)};
    entry.lidar_track = track;
    entry.X_odom_base = odom;
    scans.push_back(entry);
    if (scans.size() > 7) scans.pop_front();
  }
  SkillStatus run(double limit_s = 10.0) {
    sweep.start({Vector6d::Zero(), Vector6d::Ones(), 4.2}, now);
    SkillStatus status;
    const Stamp end = now + fromSeconds(limit_s);
    for (int tick = 0; now < end; ++tick) {
      now += std::chrono::milliseconds(20);
      if (tick % 5 == 4 && !(drop && arm.share(now) > 0.3)) scanEnds();
      if (each) each();
      status = sweep.poll(now);
      if (status.phase != SkillPhase::Running) break;
    }
    return status;
  }
  Stamp now{std::chrono::seconds(100)};
  TimedArm arm;
  std::deque<ScanWindow::Entry> scans;
  Pose2 odom{3.0, 1.0, 0.4};
  bool drop = false;
  std::function<void()> each;
  LidarSweep sweep{{}, arm, [this] { return scans; }};
};

TEST_F(LidarSweepTest, GathersTheScansOfTheMotionAlone) {
  const SkillStatus status = run();
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.text;
  const SweepCloud& cloud = sweep.cloud();
  EXPECT_GE(cloud.scans, 40);
  EXPECT_LE(cloud.scans, 43);
  EXPECT_EQ(cloud.missing, 0);
  EXPECT_LE(toSeconds(cloud.end - cloud.begin) + 0.1, 5.0);
  EXPECT_EQ(cloud.sweep.size(), 2U * static_cast<std::size_t>(cloud.scans));
  EXPECT_NEAR(cloud.coverage.step_deg, (kTo_deg - kFrom_deg) / 42.0, 0.02);
  EXPECT_LT(cloud.coverage.widest_gap_deg, 0.6);
}

/// Points are in base already; each has the LiDAR's place of its own time, not of its scan's.
TEST_F(LidarSweepTest, GivesEachFiringTheLidarOfItsTime) {
  ASSERT_EQ(run().phase, SkillPhase::Done);
  const SweepCloud& cloud = sweep.cloud();
  const std::size_t i = 20;  // first point of the eleventh scan
  const Stamp begin = cloud.begin + std::chrono::milliseconds(1000);
  EXPECT_TRUE(cloud.sweep.points[i].isApprox(Eigen::Vector3f(2.0F, 0.0F, 0.5F)));
  for (const auto& [k, ms] : {std::pair{i, 20}, std::pair{i + 1, 50}}) {
    const Eigen::Vector3d expected =
        X_base_lidar(begin + std::chrono::milliseconds(ms)).translation();
    EXPECT_LT((cloud.sweep.origins[k].cast<double>() - expected).norm(), 1e-4);
  }
}

TEST_F(LidarSweepTest, RefusesASweepDuringWhichTheBaseMoved) {
  each = [this] {
    if (arm.share(now) > 0.4) odom.x_m = 3.012;
  };
  const SkillStatus status = run();
  ASSERT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(status.failure_code, "base_moved");
  EXPECT_NE(status.text.find("12 mm"), std::string::npos) << status.text;
  EXPECT_EQ(arm.cancels, 1);
}

TEST_F(LidarSweepTest, ABaseThatMovesBeforeOrAfterDoesNoHarm) {
  each = [this] {
    if (!arm.sweeping) odom.y_m += 0.01;
  };
  EXPECT_EQ(run().phase, SkillPhase::Done);
}

TEST_F(LidarSweepTest, SaysThatTooFewScansCame) {
  drop = true;
  const SkillStatus status = run();
  ASSERT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(status.failure_code, "too_few_scans");
  EXPECT_NE(status.text.find("expected"), std::string::npos) << status.text;
}

TEST_F(LidarSweepTest, HandsOnWhyTheArmStopped) {
  arm.fail_at = 0.5;
  const SkillStatus status = run();
  ASSERT_EQ(status.phase, SkillPhase::Failed);
  EXPECT_EQ(status.failure_code, "contact");
  EXPECT_NE(status.text.find("stopped during the sweep"), std::string::npos) << status.text;
  arm.fail_at = 2.0;
  arm.sweeping = false;
  EXPECT_EQ(run().phase, SkillPhase::Done) << "a new start forgets it";
}

TEST_F(LidarSweepTest, CancelHoldsTheArm) {
  sweep.start({}, now);
  EXPECT_EQ(sweep.poll(now).phase, SkillPhase::Running);
  sweep.cancel();
  EXPECT_EQ(arm.cancels, 1);
  EXPECT_EQ(sweep.poll(now).phase, SkillPhase::Idle);
}

}  // namespace
}  // namespace kiln

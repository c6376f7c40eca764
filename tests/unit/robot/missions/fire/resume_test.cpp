#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

class FireResume : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("kiln_resume_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "fire.checkpoint").string();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  std::string path_;
};

TEST_F(FireResume, KilledInAnyStateTheMissionGoesOnToItsEnd) {
  for (const char* state : {"EnterBuilding", "DriveToLocation", "ArmSearch", "AimHose", "StartPump",
                            "SpraySteady", "SprayPattern", "StopPump", "ParkArm"}) {
    FireRig rig({.checkpoint_path = path_});
    ASSERT_TRUE(rig.runToState(state)) << state;
    rig.run(0.5);
    const double litres = rig.mission->belief().sprayed_l_est;
    const double elapsed_s = rig.missionTime();
    rig.killAndResume();
    EXPECT_FALSE(rig.pumpsRun()) << state;
    EXPECT_NEAR(rig.mission->belief().sprayed_l_est, litres, 0.02)
        << state << ": at most 0.2 s are forgotten";
    EXPECT_NEAR(rig.missionTime(), elapsed_s + 1.0, 0.1) << state << ": the clock ran on";
    EXPECT_EQ(rig.status().mission_uuid, "test-uuid");
    ASSERT_TRUE(rig.runToEnd()) << state << " -> " << rig.state();
    EXPECT_EQ(rig.state(), "Finished") << state;
    EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.15) << state;
    EXPECT_FALSE(rig.drove_extended) << state;
  }
}

TEST_F(FireResume, WhileSprayingStartsWithTheArmsPose) {
  FireRig rig({.checkpoint_path = path_});
  ASSERT_TRUE(rig.runToState("SprayPattern"));
  rig.run(3.0);
  rig.killAndResume();
  EXPECT_EQ(rig.state(), "StartPump") << "Phase 2 names it as the state in which a resume starts";
  rig.run(0.1);
  EXPECT_EQ(rig.state(), "AimHose") << "and the pumps wait until the nozzle is aimed";
  EXPECT_FALSE(rig.pumpsRun());
}

TEST_F(FireResume, RefusesADamagedCheckpointAndStartsNothing) {
  {
    FireRig rig({.checkpoint_path = path_});
    rig.run(5.0);
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  FireRig rig({.checkpoint_path = path_, .start = false});
  const auto saved = loadCheckpoint(path_);
  ASSERT_FALSE(saved.has_value());
  EXPECT_EQ(saved.error().code, ErrorCode::Truncated);
  rig.run(1.0);
  EXPECT_FALSE(rig.status().running);
  EXPECT_FALSE(rig.base.moving() || rig.arm.moving());
}

TEST_F(FireResume, ADiskThatRefusesRaisesAnAlarmAndStopsNothing) {
  std::filesystem::remove_all(folder_);
  FireRig rig({.checkpoint_path = path_});
  rig.run(2.0);
  rig.host->flushCheckpoint();
  rig.run(0.02);
  ASSERT_TRUE(rig.host->storageProblem().has_value());
  EXPECT_NE(rig.host->storageProblem()->message.find(path_), std::string::npos)
      << rig.host->storageProblem()->message;
  ASSERT_TRUE(rig.runToState("DriveToLocation"));
  std::filesystem::create_directories(folder_);
  rig.run(1.0);
  rig.host->flushCheckpoint();
  rig.run(0.02);
  EXPECT_FALSE(rig.host->storageProblem().has_value());
  EXPECT_TRUE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace kiln

#include "robot/app/mission_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/machine_mission.h"
#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

struct Reported : Fixture {
  StopLatch stop;
  MachineMission mission{machine};
  RobotBelief belief;
  MissionHost host{mission, belief, stop, clock};
  MissionReport report{clock.now()};

  void tickTo(double s) {
    run(s);
    host.tick(clock.now());
  }
  [[nodiscard]] nlohmann::json json() const {
    return nlohmann::json::parse(report.toJson(host, belief.resets, clock.now()));
  }
};

TEST(MissionReport, SaysHowTheMissionEnded) {
  Reported r;
  r.kettle.switched_on = false;
  EXPECT_EQ(r.json()["outcome"], "unfinished");
  EXPECT_EQ(r.json()["mission"], "kettle");
  r.tickTo(2.0);  // ready, not started
  r.host.start(r.clock.now());
  r.tickTo(1.0);
  ASSERT_EQ(r.force("Spilt").outcome, ChangeStateOutcome::Ok);
  r.tickTo(0.5);
  EXPECT_EQ(r.json()["outcome"], "failed");
  ASSERT_EQ(r.json()["states"].size(), 2U);
  EXPECT_EQ(r.json()["states"][0]["enter"], 0.0) << "counted from the mission's start";
  EXPECT_EQ(r.json()["states"][1]["cause"], "operator");
  EXPECT_NEAR(r.json()["mission_s"].get<double>(), 1.5, 0.1);
}

TEST(MissionReport, KeepsTheTrackFiveTimesASecond) {
  Reported r;
  for (int i = 0; i < 50; ++i) {
    MissionReport::TrackRecord record;
    record.stamp = r.clock.now() + std::chrono::milliseconds(20) * i;
    r.report.addTrack(record);
  }
  EXPECT_EQ(r.json()["track"].size(), 5U);
  r.report.begin();
  EXPECT_TRUE(r.json()["track"].empty()) << "another mission";
}

}  // namespace
}  // namespace kiln::kettle

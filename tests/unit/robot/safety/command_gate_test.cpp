#include "robot/safety/command_gate.h"

#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

/// A gate with the lease at "anna" (epoch 3), in teleop with a fresh view, at time 100 s.
struct Desk {
  CommandGate gate{CommandGate::Config{}};
  LeaseStatus lease;
  GateSituation situation;
  Stamp now = at(100.0);
  std::uint64_t nonce = 0;
  MissionInfo mission;

  Desk() {
    CommandSpec nudge{"nudge_place", "Move place", "", Confirmation::Hold, true};
    nudge.target = "place";
    nudge.arguments = {{"x", "m", -0.5, 0.5}, {"yaw", "deg", -30.0, 30.0}};
    CommandSpec go_on{"continue_despite", "Go on", "", Confirmation::Hold};
    go_on.needs_live = true;
    go_on.target = "place";
    mission.commands = {nudge, go_on, {"skip", "Skip", ""}};
    mission.actuators = {{"pumps", "Both pumps"}};
    situation.mission = &mission;
    lease.holder_client = "anna";
    lease.holder_name = "Anna";
    lease.epoch = 3;
    situation.mode = Mode::Teleop;
    situation.view_age_s = 0.1;
  }
  ReceivedCommand make(CommandBody body) {
    ReceivedCommand received;
    received.command = {"anna", "Anna", ++nonce, 3, now - fromSeconds(0.02), 1, std::move(body)};
    received.received = now;
    received.rtt_s = 0.01;
    return received;
  }
  GateDecision decide(const ReceivedCommand& received) {
    return gate.decide(received, lease, situation, now);
  }
  std::string code(CommandBody body) { return decide(make(std::move(body))).code; }
};
const JogBase kForward{{0.3, 0.0, 0.0}};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CommandGate, SaysInWordsWhatItDoesNotObey) {
  Desk desk;
  EXPECT_EQ(desk.decide(desk.make(SetSpeedScale{2.0})).reason, "speed scale is 2; allowed 0 to 1");
  EXPECT_EQ(desk.decide(desk.make(HoldActuator{"pumps", 1.5})).reason,
            "pumps is 1.5; allowed 0 to 1");
  desk.situation.mode = Mode::Autonomous;
  const std::string reason = desk.decide(desk.make(kForward)).reason;
  EXPECT_NE(reason.find("; jog only in Teleop: change the mode first"), std::string::npos)
      << reason;
}

TEST(CommandGate, LetsAFreshCommandOfTheHolderPass) {
  Desk desk;
  const auto decision = desk.decide(desk.make(kForward));
  EXPECT_TRUE(decision.accepted) << decision.reason;
  EXPECT_EQ(decision.speed_scale, 1.0);
}

TEST(CommandGate, NamesEachRefusalByACodeOfItsOwn) {
  Desk desk;
  std::set<std::string> codes;
  const auto expect = [&](const ReceivedCommand& received, const char* code) {
    const auto decision = desk.decide(received);
    EXPECT_FALSE(decision.accepted);
    EXPECT_EQ(decision.code, code) << decision.reason;
    EXPECT_FALSE(decision.reason.empty());
    codes.insert(decision.code);
  };
  auto viewer = desk.make(kForward);
  viewer.role = ClientRole::Viewer;
  expect(viewer, "viewer");
  auto stranger = desk.make(kForward);
  stranger.command.client_id = "ben";
  expect(stranger, "no_lease");
  auto old_lease = desk.make(kForward);
  old_lease.command.lease_epoch = 2;
  expect(old_lease, "old_lease");
  const auto twice = desk.make(kForward);
  EXPECT_TRUE(desk.decide(twice).accepted);
  expect(twice, "replayed");
  auto late = desk.make(kForward);
  late.command.issued = desk.now - fromSeconds(0.31);
  expect(late, "too_old");
  auto future = desk.make(kForward);
  future.command.issued = desk.now + fromSeconds(0.2);
  expect(future, "in_future");
  expect(desk.make(JogBase{{kNan, 0, 0}}), "not_finite");
  expect(desk.make(JogBase{{50.0, 0, 0}}), "out_of_range");
  desk.situation.mode = Mode::Autonomous;
  expect(desk.make(kForward), "wrong_mode");
  desk.situation.mode = Mode::Teleop;
  desk.situation.view_age_s = 0.6;
  expect(desk.make(kForward), "stale_view");
  desk.situation.view_age_s = 0.1;
  auto slow = desk.make(kForward);
  slow.rtt_s = 0.51;
  expect(slow, "link_slow");
  desk.situation.protective_stop = true;
  JogArm arm;
  arm.velocity[0] = 0.1;
  expect(desk.make(arm), "protective_stop");
  desk.situation.stop_latched = true;
  expect(desk.make(kForward), "stopped");
  EXPECT_EQ(codes.size(), 13u);
}

TEST(CommandGate, RefusesASetpointThatWasOvertaken) {
  Desk desk;
  const auto first = desk.make(kForward);
  const auto second = desk.make(kForward);
  EXPECT_TRUE(desk.decide(second).accepted);
  EXPECT_EQ(desk.decide(first).code, "out_of_order");
}

TEST(CommandGate, AgeLimitsDependOnTheKind) {
  Desk desk;
  const auto aged = [&](CommandBody body, double age_s) {
    auto received = desk.make(std::move(body));
    received.command.issued = desk.now - fromSeconds(age_s);
    return desk.decide(received).code;
  };
  EXPECT_EQ(aged(kForward, 0.29), "");
  EXPECT_EQ(aged(kForward, 0.31), "too_old");
  EXPECT_EQ(aged(SetMode{Mode::Teleop}, 0.9), "");
  EXPECT_EQ(aged(SetMode{Mode::Teleop}, 1.1), "too_old");
  EXPECT_EQ(aged(ChangeState{"A", 1, "B"}, 1.9), "");
  EXPECT_EQ(aged(ChangeState{"A", 1, "B"}, 2.1), "too_old");
  // The age counts until it is decided, not until it was received: what waited in a queue is old.
  auto queued = desk.make(kForward);
  desk.now += fromSeconds(0.4);
  EXPECT_EQ(desk.decide(queued).code, "too_old");
}

TEST(CommandGate, EveryNonFiniteNumberIsRefusedWhereverItStands) {
  Desk desk;
  for (const double wrong :
       {kNan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(desk.code(JogBase{{0, wrong, 0}}), "not_finite");
    EXPECT_EQ(desk.code(JogBase{{0, 0, wrong}}), "not_finite");
    for (int i = 0; i < 6; ++i) {
      JogArm jog;
      jog.velocity[i] = wrong;
      EXPECT_EQ(desk.code(jog), "not_finite");
    }
    EXPECT_EQ(desk.code(HoldActuator{"pumps", wrong}), "not_finite");
    EXPECT_EQ(desk.code(SetSpeedScale{wrong}), "not_finite");
  }
  EXPECT_EQ(desk.code(HoldActuator{"pumps", 1.1}), "out_of_range");
  EXPECT_EQ(desk.code(HoldActuator{"pumps", -0.1}), "out_of_range");
  EXPECT_EQ(desk.code(HoldActuator{"magnet", 1.0}), "no_such_actuator");
  EXPECT_EQ(desk.code(HoldActuator{"magnet", kNan}), "no_such_actuator");
}

/// architecture.md section 6, cell by cell.
TEST(CommandGate, FollowsTheModeTable) {
  const CommandBody transition = ChangeState{"A", 1, "B"};
  const CommandBody macro = HoldMacro{"arm park", false};
  const CommandBody pump = HoldActuator{"pumps", 1.0};
  struct Row {
    Mode mode;
    bool transition, macro, jog, pump;
  };
  for (const Row& row :
       {Row{Mode::Autonomous, true, false, false, false},
        Row{Mode::Supervised, true, false, false, false}, Row{Mode::Teleop, true, true, true, true},
        Row{Mode::Stopped, false, false, false, false}}) {
    Desk desk;
    desk.situation.mode = row.mode;
    desk.situation.stop_latched = row.mode == Mode::Stopped;
    EXPECT_EQ(desk.decide(desk.make(transition)).accepted, row.transition) << toString(row.mode);
    EXPECT_EQ(desk.decide(desk.make(macro)).accepted, row.macro) << toString(row.mode);
    EXPECT_EQ(desk.decide(desk.make(kForward)).accepted, row.jog) << toString(row.mode);
    EXPECT_EQ(desk.decide(desk.make(pump)).accepted, row.pump) << toString(row.mode);
  }
}

TEST(CommandGate, RefusesPumpsByHandWhereThereAreNone) {
  Desk desk;
  EXPECT_EQ(desk.code(HoldActuator{"pumps", 1.0}), "");
  desk.mission.actuators.clear();
  EXPECT_EQ(desk.code(HoldActuator{"pumps", 1.0}), "no_such_actuator");
  EXPECT_EQ(desk.code(HoldMacro{"arm park", false}), "");
}

TEST(CommandGate, LatencySlowsJogsInSteps) {
  Desk desk;
  const auto scale = [&](double rtt_s) {
    auto received = desk.make(kForward);
    received.rtt_s = rtt_s;
    return desk.decide(received).speed_scale;
  };
  EXPECT_EQ(scale(0.10), 1.0);
  EXPECT_EQ(scale(0.20), 0.5);
  EXPECT_EQ(scale(0.40), 0.2);
}

TEST(CommandGate, ReleasesAlwaysPassForTheHolder) {
  Desk desk;
  desk.situation.stop_latched = true;
  desk.situation.view_age_s = 100.0;
  for (const CommandBody& zero : {CommandBody(ReleaseAll{}), CommandBody(JogBase{}),
                                  CommandBody(JogArm{}), CommandBody(HoldActuator{"pumps"}),
                                  CommandBody(HoldActuator{"magnet"}), CommandBody(HoldMacro{})}) {
    auto received = desk.make(zero);
    received.command.issued = desk.now - fromSeconds(5.0);
    EXPECT_TRUE(desk.decide(received).accepted) << commandName(zero);
  }
}

TEST(CommandGate, StopIsClearedOnlyWhenNothingIsHeld) {
  Desk desk;
  EXPECT_EQ(desk.code(ClearStop{}), "not_stopped");
  desk.situation.stop_latched = true;
  desk.situation.anything_held = true;
  EXPECT_EQ(desk.code(ClearStop{}), "still_held");
  desk.situation.anything_held = false;
  EXPECT_EQ(desk.code(ClearStop{}), "");
  desk.situation.stop_generation = 8;  // somebody pressed again while this clear was on its way
  EXPECT_EQ(desk.code(ClearStop{7}), "newer_stop");
  EXPECT_EQ(desk.code(ClearStop{8}), "");
}

TEST(CommandGate, MissionCommandsNeedTheirPremises) {
  Desk desk;
  EXPECT_EQ(desk.code(StartMission{}), "wrong_mode");
  desk.situation.mode = Mode::Autonomous;
  EXPECT_EQ(desk.code(Pause{}), "not_running");
  EXPECT_EQ(desk.code(Resume{}), "not_paused");
  desk.situation.ready = false;
  desk.situation.not_ready_reason = "LiDAR: no scan for 2.1 s";
  const auto decision = desk.decide(desk.make(StartMission{}));
  EXPECT_EQ(decision.code, "not_ready");
  EXPECT_THAT(decision.reason, HasSubstr("LiDAR"));
  desk.situation.ready = true;
  EXPECT_EQ(desk.code(StartMission{}), "");
  desk.situation.phase = MissionPhase::Running;
  EXPECT_EQ(desk.code(StartMission{}), "already_running");
  EXPECT_EQ(desk.code(ReleaseProtectiveStop{}), "no_protective_stop");
  desk.situation.phase = MissionPhase::Held;
  EXPECT_EQ(desk.code(Resume{}), "");
  desk.situation.position_lost = "position lost: no wall fits";
  EXPECT_EQ(desk.code(Resume{}), "position_lost");
  EXPECT_EQ(desk.code(SetMode{Mode::Stopped}), "out_of_range");
}

TEST(CommandGate, APoseIsSetAtRestAndNotUnderARunningMission) {
  Desk desk;
  const SetPose pose{{1.0, 2.0, 0.5}};
  EXPECT_EQ(desk.code(pose), "");
  desk.situation.base_moving = true;
  EXPECT_EQ(desk.code(pose), "moving");
  desk.situation.base_moving = false;
  desk.situation.phase = MissionPhase::Running;
  EXPECT_EQ(desk.code(pose), "mission_running");
  desk.situation.phase = MissionPhase::Held;
  EXPECT_EQ(desk.code(pose), "");
  EXPECT_EQ(desk.code(SetPose{{kNan, 0, 0}}), "not_finite");
  EXPECT_EQ(desk.code(SetPose{{0, 1e6, 0}}), "out_of_range");
}

MissionCommand nudge(double x_m, double yaw_deg) {
  return {"nudge_place", "place 1", {{"x", x_m}, {"yaw", yaw_deg}}};
}
const MissionCommand kGoOn{"continue_despite", "place 1", {}};

TEST(CommandGate, AMissionsCommandIsJudgedByItsDescription) {
  Desk desk;
  EXPECT_EQ(desk.code(nudge(0.2, -5.0)), "");
  EXPECT_EQ(desk.code(nudge(0.6, 0.0)), "out_of_range");
  EXPECT_EQ(desk.code(nudge(0.0, 31.0)), "out_of_range");
  EXPECT_EQ(desk.code(nudge(0.0, kNan)), "not_finite");
  EXPECT_EQ(desk.code(MissionCommand{"jump", "place 1", {}}), "no_such_command");
  EXPECT_EQ(desk.code(MissionCommand{"nudge_place", "", {{"x", 0}, {"yaw", 0}}}), "bad_arguments");
  EXPECT_EQ(desk.code(MissionCommand{"nudge_place", "place 1", {{"x", 0}}}), "bad_arguments");
  EXPECT_EQ(desk.code(MissionCommand{"nudge_place", "place 1", {{"x", 0}, {"x", 0}}}),
            "bad_arguments");
  EXPECT_EQ(desk.code(MissionCommand{"skip", "place 1", {}}), "bad_arguments");
  EXPECT_EQ(desk.code(MissionCommand{"skip", "", {}}), "");
  for (const CommandBody& body :
       {CommandBody(SetPose{}), CommandBody(nudge(0, 0)), CommandBody(kGoOn)}) {
    auto stranger = desk.make(body);
    stranger.command.client_id = "ben";
    EXPECT_EQ(desk.decide(stranger).code, "no_lease") << commandName(body);
  }
  desk.situation.mission = nullptr;
  EXPECT_EQ(desk.code(nudge(0.2, -5.0)), "no_such_command");
  EXPECT_EQ(desk.code(HoldActuator{"pumps", 1.0}), "no_such_actuator");
}

TEST(CommandGate, AMissionsCommandNeedsItsPremises) {
  Desk desk;
  EXPECT_EQ(desk.code(kGoOn), "not_running");
  desk.situation.phase = MissionPhase::Running;
  EXPECT_EQ(desk.code(kGoOn), "");
  desk.situation.stop_latched = true;
  EXPECT_EQ(desk.code(kGoOn), "stopped");
  EXPECT_EQ(desk.code(MissionCommand{"skip", "", {}}), "stopped");
  EXPECT_EQ(desk.code(nudge(0.2, -5.0)), "") << "it moves nothing";
}

}  // namespace
}  // namespace kiln

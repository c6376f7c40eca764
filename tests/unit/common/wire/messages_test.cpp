#include <random>

#include <gtest/gtest.h>

#include "common/wire/command.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"

namespace kiln::wire {
namespace {

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

std::vector<CommandBody> everyBody() {
  JogArm arm{JogFrame::Tool, {}};
  arm.velocity << 0.1, -0.2, 0.3, -0.4, 0.5, -0.6;
  return {AcquireLease{true},
          ReleaseLease{},
          StartMission{},
          Pause{},
          Resume{},
          ChangeState{"A", 7, "B"},
          SetMode{Mode::Teleop},
          ClearStop{7},
          ReleaseProtectiveStop{},
          ResetRobot{},
          SetSpeedScale{0.0},
          CancelMacro{},
          AcknowledgeAlarm{"arm.x"},
          SetRecording{true},
          SetPose{{1.5, -2.5, 0.7}},
          MissionCommand{"nudge_place", "place 1", {{"x", 0.05}, {"yaw", -2.0}}},
          JogBase{{0.1, -0.2, 0.3}},
          arm,
          HoldActuator{"pumps", 1.0},
          HoldMacro{"spray fire 1", true},
          ReleaseAll{}};
}

TEST(Messages, EveryCommandKindComesBackAsItself) {
  const auto bodies = everyBody();
  ASSERT_EQ(bodies.size(), std::variant_size_v<CommandBody>);
  for (const CommandBody& body : bodies) {
    const Command sent{"client", "anna", 42, 3, at(12.5), 5, body};
    const auto message = decodeToRobot(encode(ToRobot{sent}));
    ASSERT_TRUE(message.has_value()) << commandName(body) << ": " << message.error();
    const auto& back = std::get<Command>(*message);
    EXPECT_EQ(back.body.index(), body.index()) << commandName(body);
    EXPECT_EQ(back.nonce, 42u);
    EXPECT_EQ(back.issued, sent.issued);
    EXPECT_EQ(back.press, 5u);
    // The message is its own proof: encoding again yields the same bytes.
    EXPECT_EQ(encode(ToRobot{back}), encode(ToRobot{sent})) << commandName(body);
  }
}

TEST(Messages, NotANumberReachesTheGate) {
  const Command sent{"client", "anna", 1, 1, at(0), 1, JogBase{{std::nan(""), 0, 0}}};
  const auto message = decodeToRobot(encode(ToRobot{sent}));
  ASSERT_TRUE(message.has_value());
  EXPECT_TRUE(std::isnan(std::get<JogBase>(std::get<Command>(*message).body).twist.vx_mps));
}

TEST(Messages, HelloOfAnotherProtocolIsReadableWhateverItsRoles) {
  Hello hello;
  hello.protocol = kProtocolVersion + 5;
  hello.role = static_cast<ClientRole>(17);
  EXPECT_TRUE(decodeToRobot(encode(ToRobot{hello})).has_value());
  hello.protocol = kProtocolVersion;
  EXPECT_FALSE(decodeToRobot(encode(ToRobot{hello})).has_value());
}

TEST(Messages, RobotStatusKeepsEveryField) {
  RobotStatus s;
  s.stamp = at(3.25);
  s.seq = 9;
  s.mode = Mode::Teleop;
  s.word = StatusWord::Teleop;
  s.checks = {{"lidar", false, "no scan", "check its cable"},
              {"disk", true, "1 GB", "make room", true}};
  s.lease = {"id", "anna", 4, 1.5, "id2", "ben", 8.0};
  s.stop = {true, "operator ben", at(2.0), 7, true, false, true, false};
  s.phase = MissionPhase::Held;
  s.holds = {{HoldReason::Stop, "STOP by ben"}, {HoldReason::PositionLost, "position lost"}};
  s.X_map_base = {1.0, 2.0, 0.5};
  s.twist = {0.1, 0.2, 0.3};
  s.arm.q << 1, 2, 3, 4, 5, 6;
  s.arm.safety = ArmSafetyMode::ProtectiveStop;
  s.wheel_steer_rad = {0.1, 0.2, 0.3, 0.4};
  s.figures = {{"water.left", 8.5, 0.1}, {"score", 6.0, 0.0}};
  s.macro = {"arm park", 1, 2, "arm to park", 0.4, "done"};
  s.alarms = {{"a.b", AlarmLevel::Warning, "text", "action", at(1.0), true, false}};
  s.drops = {{"cloud", 3}};
  s.operators = {"anna", "ben"};
  const auto back = decodeRobotStatus(encode(s));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(encode(*back), encode(s));
  EXPECT_EQ(back->lease.requested_by_name, "ben");
  EXPECT_EQ(back->checks.at(0).action, "check its cable");
  EXPECT_FALSE(back->checks.at(0).warn);
  EXPECT_TRUE(back->checks.at(1).warn);
  ASSERT_NE(findFigure(back->figures, "score"), nullptr);
  EXPECT_EQ(findFigure(back->figures, "score")->value, 6.0);
}

TEST(Messages, ThermalCountsComeBackExactly) {
  std::mt19937 random(4);
  ThermalImage image;
  image.counts.resize(160 * 120);
  for (auto& c : image.counts) c = static_cast<std::uint16_t>(random());
  image.ffc = FfcState::Running;
  const auto back = decodeThermal(encode(image));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->counts, image.counts);
  EXPECT_EQ(back->ffc, FfcState::Running);
}

TEST(Messages, SceneAndGraphComeBack) {
  Scene scene;
  SceneItem line;
  line.id = "jet";
  line.layer = "fire.jet";
  line.points = {{1, 0, 0}, {2, 0, 0}};
  line.width_px = 4.0;
  SceneItem estimate;
  estimate.shape = SceneItem::Shape::Estimate;
  estimate.style = ItemStyle::Target;
  estimate.X_map_item.translation() = Eigen::Vector3d(1, 2, 3);
  estimate.covariance = Eigen::Matrix3d::Random();
  estimate.label = "place 1 · 0.86 m";
  estimate.detail = "127 °C peak";
  SceneItem arrow = line, cylinder;
  arrow.shape = SceneItem::Shape::Arrow;
  cylinder.shape = SceneItem::Shape::Cylinder;
  cylinder.size = {0.1, 0.2, 0.3};
  scene.items = {line, estimate, arrow, cylinder};
  scene.detail = {at(1), "kiln.fire.v1.FireSite", "bytes"};
  scene.planned.waypoints_map = {{1, 2, 3}};
  scene.arena.push_back({"wall", makePose({1, 2, 3}, {0, 0, 1}), {1, 1, 1}, 0xff00ff});
  const auto back = decodeScene(encode(scene));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_TRUE(back->items.at(1).covariance.isApprox(estimate.covariance));
  EXPECT_EQ(back->items.at(1).style, ItemStyle::Target);
  EXPECT_EQ(back->items.at(2).shape, SceneItem::Shape::Arrow);
  EXPECT_EQ(back->items.at(3).shape, SceneItem::Shape::Cylinder);
  EXPECT_EQ(encode(*back), encode(scene));

  FsmStatus status;
  status.guards = {{"Estimate within 3 cm", true, "2.1 cm", 0.2}};
  status.history = {{3, "AimHose", at(1), at(2), TransitionCause::Operator, "anna"}};
  const auto fsm = decodeFsmStatus(encode(status));
  ASSERT_TRUE(fsm.has_value()) << fsm.error();
  EXPECT_EQ(encode(*fsm), encode(status));
}

TEST(Messages, ARecordingThatDoesNotTellHowLongTheMachineWasHeldIsRead) {
  FsmStatus status;
  status.state = "AimHose";
  status.entered = at(2);
  status.stamp = at(30);
  const std::string before = encode(status);
  status.paused_in_state = Duration{};
  EXPECT_NE(encode(status), before) << "not held is not the same as not told";
  const auto old = decodeFsmStatus(before);
  ASSERT_TRUE(old.has_value()) << old.error();
  EXPECT_FALSE(old->paused_in_state);
  EXPECT_EQ(timeInState(*old), fromSeconds(28.0));
  status.paused_in_state = fromSeconds(20.5);
  const auto told = decodeFsmStatus(encode(status));
  ASSERT_TRUE(told.has_value()) << told.error();
  EXPECT_EQ(told->paused_in_state, fromSeconds(20.5));
  EXPECT_EQ(timeInState(*told), fromSeconds(7.5));
}

TEST(Messages, AnItemThatCannotBeDrawnIsRefused) {
  const auto refused = [](auto spoil) {
    Scene scene;
    scene.items.resize(1);
    spoil(scene.items[0]);
    return !decodeScene(encode(scene)).has_value();
  };
  EXPECT_FALSE(refused([](SceneItem&) {}));
  EXPECT_TRUE(refused([](SceneItem& item) { item.points = {{std::nan(""), 0, 0}}; }));
  EXPECT_TRUE(refused([](SceneItem& item) { item.width_px = 1e9; }));
  EXPECT_TRUE(refused([](SceneItem& item) { item.width_px = std::nan(""); }));
  EXPECT_TRUE(refused([](SceneItem& item) { item.size.x() = std::nan(""); }));
  EXPECT_TRUE(refused([](SceneItem& item) { item.shape = static_cast<SceneItem::Shape>(9); }));
}

TEST(Messages, WhatAMissionBringsComesBack) {
  MissionInfo info;
  info.mission = "fire";
  info.mission_uuid = "abc";
  info.title = "Fire in the kitchen";
  FigureSpec water{"water.left", "Water", "l", 1, 0.0, 10.0, 2.0};
  water.estimated = water.top_bar = true;
  FigureSpec peak{"thermal.peak", "Peak", "°C", 0, 20.0, 60.0};
  peak.caution_above = 200.0;
  peak.plot = true;
  info.figures = {water, peak};
  info.layers = {{"fire.jet", "Jet"}};
  CommandSpec nudge{"nudge_place", "Move place", "It is moved.", Confirmation::Hold, true};
  nudge.target = "place";
  nudge.arguments = {{"x", "m", -0.5, 0.5, "along x"}};
  info.commands = {nudge};
  info.actuators = {{"pumps", "Both pumps"}};
  info.panels = {"fire.thermal"};
  const auto back = decodeMissionInfo(encode(info));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_TRUE(*back == info);
  info.commands[0].arguments[0].high = 0.4;
  EXPECT_FALSE(*back == info);
  EXPECT_EQ(figureText(info.figures[0], 4.24), "est. 4.2 l");
  EXPECT_EQ(figureText(info.figures[1], std::nan("")), "–");
}

TEST(Messages, AMissionThatBringsTooMuchIsRefused) {
  MissionInfo info;
  info.panels.assign(64, "fire.thermal");
  EXPECT_TRUE(decodeMissionInfo(encode(info)));
  info.panels.resize(65);
  EXPECT_FALSE(decodeMissionInfo(encode(info)));
  info.panels.clear();
  info.figures.resize(501);
  EXPECT_FALSE(decodeMissionInfo(encode(info)));
}

TEST(Messages, LocalizationComesBackWithWhatIsUnknown) {
  LocalizationStatus status;
  status.health = LocalizationHealth::Degraded;
  status.reason = "odometry alone for 2.1 s";
  status.submap = "indoor";
  status.X_map_base.translation() << 1.0, 2.0, -0.3;
  status.covariance = Eigen::Vector3d(1e-4, 4e-4, 1e-5).asDiagonal();
  status.tracking_error_m = 0.02;
  const auto back = decodeLocalization(encode(status));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(encode(*back), encode(status));
  EXPECT_EQ(back->health, LocalizationHealth::Degraded);
  EXPECT_TRUE(back->tracking_error_m.has_value());
  EXPECT_FALSE(back->tracking_error_yaw_rad.has_value());
}

TEST(Messages, MapLayerIsWithinHalfACentimetreAndKeepsItsParts) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-40.0f, 40.0f);
  MapLayer layer;
  layer.name = "kitchen";
  layer.version = 0xfeedULL;
  layer.submaps = {"outdoor", "indoor"};
  for (int i = 0; i < 2000; ++i) {
    layer.points_map.emplace_back(place(random), place(random), place(random));
    layer.submap_of.push_back(static_cast<std::uint8_t>(i % 2));
  }
  layer.points_map.emplace_back(5000.0f, 0.0f, 0.0f);  // out of reach: left out
  layer.submap_of.push_back(0);
  const auto back = decodeMapLayer(encode(layer));
  ASSERT_TRUE(back.has_value()) << back.error();
  ASSERT_EQ(back->points_map.size(), 2000u);
  EXPECT_EQ(back->version, layer.version);
  EXPECT_EQ(back->submaps, layer.submaps);
  for (std::size_t i = 0; i < back->points_map.size(); ++i) {
    EXPECT_LT((back->points_map[i] - layer.points_map[i]).cwiseAbs().maxCoeff(), 0.0051f);
    EXPECT_EQ(back->submap_of[i], layer.submap_of[i]);
  }
}

TEST(Messages, TrajectoryKeepsItsLegs) {
  const Trajectory driven{at(4), {{0, {{1, 2, 0.5}, {1.5, 2, 0.5}}}, {1, {{0, 0, 0}}}}};
  const auto back = decodeTrajectory(encode(driven));
  ASSERT_TRUE(back.has_value()) << back.error();
  ASSERT_EQ(back->legs.size(), 2u);
  EXPECT_EQ(back->legs[1].resets, 1);
  EXPECT_EQ(encode(*back), encode(driven));
}

TEST(Messages, LogTextWithBrokenCharactersStillArrives) {
  const LogBatch batch{{{at(1), 3, "io", "caf\xe9 \xf0\x9f\x94\xa5 ok"}}, 2};
  const auto back = decodeLogBatch(encode(batch));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->lines.at(0).text, "caf? \xf0\x9f\x94\xa5 ok");
}

}  // namespace
}  // namespace kiln::wire

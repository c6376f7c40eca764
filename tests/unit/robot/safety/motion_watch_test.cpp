#include "robot/safety/motion_watch.h"

#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

/// A base at 50 Hz that follows its command late, with noisy wheels, and a localisation beside it.
struct Drive {
  MotionWatch watch{{}};
  double delay_s = 0.15;
  Twist2 push;        ///< what the wheels do beside the command
  double slip = 0.0;  ///< share of the wheels' way that is not covered
  Pose2 jump;         ///< of the localisation at jump_at
  double jump_at = 1e9;
  bool localised = true;

  std::string run(double seconds, const std::function<Twist2(double)>& command) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.02);
    Pose2 odom, map{3, 1, 0.5};
    const Pose2 map_at_start = map;
    for (double t = 0.0; t < seconds; t += 0.02) {
      const Twist2 c = command(t), late = t > delay_s ? command(t - delay_s) : Twist2{};
      const Twist2 v{late.vx_mps + push.vx_mps, late.vy_mps + push.vy_mps,
                     late.wz_radps + push.wz_radps};
      odom = odom * Pose2{v.vx_mps * 0.02, v.vy_mps * 0.02, v.wz_radps * 0.02};
      const double k = 1.0 - slip;
      map = map * Pose2{k * v.vx_mps * 0.02, k * v.vy_mps * 0.02, v.wz_radps * 0.02};
      if (t >= jump_at && t < jump_at + 0.02) map = map * jump;
      Pose2 seen = map;
      seen.x_m += 0.5 * noise(random);
      seen.y_m += 0.5 * noise(random);
      const std::string wrong = watch.step(
          {Stamp{} + fromSeconds(t),
           c,
           {v.vx_mps + noise(random), v.vy_mps + noise(random), v.wz_radps + noise(random)},
           odom,
           localised ? std::optional(seen) : std::nullopt});
      if (!wrong.empty()) return wrong + fmt(t);
    }
    (void)map_at_start;
    return {};
  }
  static std::string fmt(double t) { return " at " + std::to_string(t); }
};

Twist2 lively(double t) {
  return {0.8 * std::sin(1.3 * t), 0.5 * std::sin(0.9 * t + 1), 0.5 * std::sin(1.7 * t)};
}

TEST(MotionWatch, LeavesALivelyDriveAlone) {
  Drive drive;
  EXPECT_EQ(drive.run(60.0, lively), "");
  Drive steps;  // full stick, let go, reverse
  EXPECT_EQ(steps.run(30.0,
                      [](double t) {
                        return Twist2{static_cast<int>(t) % 3 == 0 ? 1.0 : -0.6, 0, 0};
                      }),
            "");
}

TEST(MotionWatch, StopsTheRunawayOfThePaper) {
  Drive drive;  // nothing is commanded, the wheels turn
  drive.push = {0.6, 0, 0};
  const std::string wrong = drive.run(5.0, [](double) { return Twist2{}; });
  EXPECT_NE(wrong.find("0.00 m/s are commanded"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("at 0.3"), std::string::npos) << "within half a second: " << wrong;
  Drive sideways;  // driven ahead, it goes sideways
  sideways.push = {0, 0.7, 0};
  EXPECT_NE(sideways.run(5.0, [](double) { return Twist2{0.5, 0, 0}; }), "");
  Drive turning;
  turning.push = {0, 0, 0.5};
  EXPECT_NE(turning.run(5.0, [](double) { return Twist2{}; }).find("turns"), std::string::npos);
}

/// The default jog is 0.21 m/s and 0.21 rad/s (35 %).
TEST(MotionWatch, ASlowJogThatRunsAtTwiceItsSpeedIsStopped) {
  for (const double v : {0.1, 0.21, 0.5, 1.0}) {
    Drive straight;
    straight.push = {1.2 * v, 0, 0};
    EXPECT_NE(straight.run(3.0, [&](double) { return Twist2{v, 0, 0}; }), "") << v;
    Drive honest;
    EXPECT_EQ(honest.run(3.0, [&](double) { return Twist2{v, 0, 0}; }), "") << v;
  }
  for (const double w : {0.21, 0.5}) {
    Drive turning;
    turning.push = {0, 0, 1.2 * w};
    EXPECT_NE(turning.run(3.0, [&](double) { return Twist2{0, 0, w}; }), "") << w;
  }
}

/// A drive that is stuck ends by itself within 2 s and the mission tries again; who goes on longer
/// is stopped.
TEST(MotionWatch, WheelsThatSlipForAMomentAreTheMissionsBusiness) {
  const auto slipping_for = [](double seconds) {
    Drive drive;
    drive.slip = 1.0;
    return drive.run(6.0, [=](double t) { return Twist2{t < seconds ? 0.4 : 0.0, 0, 0}; });
  };
  EXPECT_EQ(slipping_for(2.2), "");
  EXPECT_NE(slipping_for(4.0).find("slip"), std::string::npos);
}

TEST(MotionWatch, SeesWheelsThatTurnInVainAndALocalisationThatJumps) {
  Drive slipping;
  slipping.slip = 0.7;
  EXPECT_NE(slipping.run(10.0,
                         [](double) {
                           return Twist2{0.8, 0, 0};
                         })
                .find("slip"),
            std::string::npos);
  Drive jumping;
  jumping.jump = {0.6, 0, 0};
  jumping.jump_at = 4.0;
  EXPECT_NE(jumping.run(10.0,
                        [](double) {
                          return Twist2{0.2, 0, 0};
                        })
                .find("position is wrong"),
            std::string::npos);
  Drive corrected;  // an ordinary correction
  corrected.jump = {0.08, 0.05, 0.03};
  corrected.jump_at = 4.0;
  EXPECT_EQ(corrected.run(10.0, lively), "");
  Drive lost;
  lost.slip = 0.7;
  lost.localised = false;
  EXPECT_EQ(lost.run(10.0, lively), "") << "a lost position is somebody else's business";
}

TEST(MotionWatch, RefusesNumbersThatAreNone) {
  MotionWatch watch{{}};
  MotionWatch::Input input;
  input.measured.vx_mps = NAN;
  EXPECT_NE(watch.step(input), "");
}

}  // namespace
}  // namespace kiln

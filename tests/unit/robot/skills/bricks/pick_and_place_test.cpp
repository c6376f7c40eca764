// Pick and place on the simulator's own physics: world wall_lab, bricks that slip and fall.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/unit/robot/skills/bricks/handling_rig.h"

namespace kiln {
namespace {

constexpr double kQuarter = 0.5 * M_PI;

class PickAndPlaceTest : public ::testing::Test {
 protected:
  SkillStatus pickUp(std::size_t brick) {
    pick.start({rig.known(brick), rig.around(brick), {}, 0.0}, rig.rig.now);
    return rig.work(pick, 60.0);
  }
  SkillStatus setDown(const Eigen::Isometry3d& X_base_slot, std::size_t brick,
                      std::optional<Eigen::Vector3d> towards = std::nullopt) {
    place.start({*pick.held(), X_base_slot, rig.around(brick), towards, {}}, rig.rig.now);
    return rig.work(place, 90.0);
  }

  HandlingRig rig;
  PickBrick pick{{}, rig.parts};
  PlaceBrick place{{}, rig.parts};
};

TEST_F(PickAndPlaceTest, ARedBrickIsLiftedAndSetDownElsewhere) {
  const std::size_t red = rig.rig.first(BrickKind::Red);
  rig.lay(red, lying(1.05, 0.05, 0, kQuarter + 0.1));
  rig.run(0.5);
  const SkillStatus picked = pickUp(red);
  ASSERT_EQ(picked.phase, SkillPhase::Done) << picked.failure_code << ": " << picked.text;
  EXPECT_EQ(pick.tries(), 1);
  EXPECT_EQ(rig.rig.bricks().grip().held, red);
  EXPECT_GT(rig.rig.height(red), 0.2);
  EXPECT_NEAR(pick.held()->weighed_kg, 1.0, 0.15);
  const Eigen::Isometry3d X_base_slot = lying(0.5, 0.8, 0, 0.0);
  const SkillStatus placed = setDown(X_base_slot, red);
  ASSERT_EQ(placed.phase, SkillPhase::Done) << placed.failure_code << ": " << placed.text;
  rig.run(0.5);
  EXPECT_FALSE(rig.rig.bricks().grip().held.has_value());
  const Eigen::Isometry3d off = X_base_slot.inverse() * rig.X_base_brick(red);
  EXPECT_LT(off.translation().norm(), 0.005) << off.translation().transpose();
  EXPECT_EQ(rig.collided(), "");
}

/// Signed errors of a placed brick in its slot's axes.
struct PlaceError {
  double x_m = 0.0, y_m = 0.0, yaw_deg = 0.0;
};

PlaceError errorOf(const Eigen::Isometry3d& X_base_slot, const Eigen::Isometry3d& X_base_brick) {
  const Eigen::Isometry3d off = X_base_slot.inverse() * X_base_brick;
  const double yaw = std::atan2(off.linear()(1, 0), off.linear()(0, 0));
  return {off.translation().x(), off.translation().y(), std::remainder(yaw, M_PI) / kDeg};
}

/// The paper's table "End-to-end brick manipulation precision", mean of x, y and yaw.
struct PaperRow {
  BrickKind kind;
  double x_m, y_m, yaw_deg;
};
constexpr PaperRow kPaper[] = {{BrickKind::Red, 0.0152, 0.0149, 1.26},
                               {BrickKind::Green, 0.0194, 0.0067, 1.26},
                               {BrickKind::Blue, 0.0182, 0.0053, 0.76}};

/// The paper's lab experiment without its perception: the brick on top of a stack before the robot,
/// off by up to 5 cm and 10 deg, to the floor on the left. KILN_PLACES=N: so many of each.
TEST(PickAndPlace, EachColourLiesWhereItShould) {
  const char* wanted = std::getenv("KILN_PLACES");
  const int runs = wanted != nullptr ? std::max(1, std::atoi(wanted)) : 3;
  for (const PaperRow& paper : kPaper) {
    double x = 0.0, y = 0.0, yaw = 0.0;
    for (int run = 0; run < runs; ++run) {
      HandlingRig rig(static_cast<std::uint64_t>(run) + 1);
      PickBrick pick({}, rig.parts);
      PlaceBrick place({}, rig.parts);
      const std::size_t brick = rig.nth(paper.kind, 0), below = rig.nth(paper.kind, 1);
      const double share = runs > 1 ? 2.0 * run / (runs - 1) - 1.0 : 0.0;  // -1 to 1
      const double off = 0.05 * share, turn = 10.0 * kDeg * share;
      rig.lay(below, lying(1.0 + off, off, 0, kQuarter - turn));
      rig.lay(brick, lying(1.0 + off + 0.005, off - 0.005, 1, kQuarter - turn + 0.02));
      rig.run(0.5);
      pick.start({rig.known(brick), rig.around(brick), {}, 0.0}, rig.rig.now);
      const SkillStatus picked = rig.work(pick, 90.0);
      ASSERT_EQ(picked.phase, SkillPhase::Done) << picked.failure_code << ": " << picked.text;
      const Eigen::Isometry3d X_base_slot = lying(0.45, 0.8, 0, 0.0);
      place.start({*pick.held(), X_base_slot, rig.around(brick), {}, {}}, rig.rig.now);
      const SkillStatus placed = rig.work(place, 120.0);
      ASSERT_EQ(placed.phase, SkillPhase::Done) << placed.failure_code << ": " << placed.text;
      rig.run(0.5);
      const PlaceError e = errorOf(X_base_slot, rig.X_base_brick(brick));
      const PlaceError told = errorOf(place.placement()->X_base_brick, rig.X_base_brick(brick));
      EXPECT_LT(std::hypot(told.x_m, told.y_m), 0.003) << "the database's pose after the release";
      EXPECT_EQ(rig.collided(), "");
      x += std::abs(e.x_m) / runs;
      y += std::abs(e.y_m) / runs;
      yaw += std::abs(e.yaw_deg) / runs;
    }
    std::printf("%s: mean x %.2f mm, y %.2f mm, yaw %.3f deg of %d\n",
                std::string(brickShape(paper.kind).name).c_str(), 1e3 * x, 1e3 * y, yaw, runs);
    EXPECT_LE(x, std::max(0.5 * paper.x_m, 0.005));
    EXPECT_LE(y, std::max(0.5 * paper.y_m, 0.005));
    EXPECT_LE(yaw, std::max(0.5 * paper.yaw_deg, 0.3));
  }
}

/// Believed 8 mm farther from its neighbour than it is: set against it by force, a joint apart, and
/// the neighbour stays where it lay.
TEST_F(PickAndPlaceTest, IsSetAgainstItsNeighbourAndDoesNotPushIt) {
  const std::size_t red = rig.nth(BrickKind::Red, 0), beside = rig.nth(BrickKind::Red, 1);
  rig.lay(red, lying(1.0, 0.05, 0, kQuarter));
  rig.lay(beside, lying(0.35, 0.8, 0, 0.0));
  rig.run(0.5);
  const SkillStatus picked = pickUp(red);
  ASSERT_EQ(picked.phase, SkillPhase::Done) << picked.failure_code << ": " << picked.text;
  const Eigen::Isometry3d X_before = rig.X_base_brick(beside);
  const Eigen::Isometry3d X_base_slot = lying(0.35 + 0.3 + 0.011, 0.8, 0, 0.0);
  const SkillStatus placed = setDown(X_base_slot, red, -Eigen::Vector3d::UnitX());
  ASSERT_EQ(placed.phase, SkillPhase::Done) << placed.failure_code << ": " << placed.text;
  EXPECT_TRUE(place.placement()->neighbour_felt);
  rig.run(0.5);
  const Eigen::Vector3d pushed = (X_before.inverse() * rig.X_base_brick(beside)).translation();
  const double lengths =
      rig.rig.arena.wall.bricks[red].size_m.x() + rig.rig.arena.wall.bricks[beside].size_m.x();
  const double gap = (rig.X_base_brick(red).translation() - rig.X_base_brick(beside).translation())
                         .head<2>()
                         .norm() -
                     0.5 * lengths;
  std::printf("neighbour moved by %.2f mm, joint %.2f mm\n", 1e3 * pushed.norm(), 1e3 * gap);
  EXPECT_LT(pushed.norm(), 0.001);
  EXPECT_NEAR(gap, 0.003, 0.0015);
  EXPECT_EQ(rig.collided(), "");
}

TEST_F(PickAndPlaceTest, WithoutANeighbourItLiesInItsSlotAllTheSame) {
  const std::size_t red = rig.nth(BrickKind::Red, 0);
  rig.lay(red, lying(1.0, 0.05, 0, kQuarter));
  rig.run(0.5);
  ASSERT_EQ(pickUp(red).phase, SkillPhase::Done);
  const Eigen::Isometry3d X_base_slot = lying(0.6, 0.8, 0, 0.0);
  ASSERT_EQ(setDown(X_base_slot, red, -Eigen::Vector3d::UnitX()).phase, SkillPhase::Done);
  EXPECT_FALSE(place.placement()->neighbour_felt);
  const PlaceError e = errorOf(X_base_slot, rig.X_base_brick(red));
  EXPECT_LT(std::hypot(e.x_m, e.y_m), 0.005);
}

/// Knocked off the face on the way: known within 0.3 s, by name, and the arm carries nothing more.
TEST_F(PickAndPlaceTest, ABrickKnockedOffInFlightIsNoticedWithin300Ms) {
  for (const double after_s : {0.3, 1.1, 1.9}) {
    const std::size_t green = rig.nth(BrickKind::Green, 0);
    rig.lay(green, lying(1.0, 0.05, 0, kQuarter));
    rig.run(0.5);
    const SkillStatus picked = pickUp(green);
    ASSERT_EQ(picked.phase, SkillPhase::Done) << picked.failure_code << ": " << picked.text;
    place.start({*pick.held(), lying(0.5, 0.8, 0, 0.0), rig.around(green), {}, {}}, rig.rig.now);
    const Stamp knock = rig.rig.now + fromSeconds(after_s);
    SkillStatus status = rig.work(place, 60.0, [&] { return rig.rig.now >= knock; });
    ASSERT_EQ(status.phase, SkillPhase::Running) << status.failure_code << ": " << status.text;
    rig.rig.bricks().letGo();
    Eigen::Isometry3d X_map_brick = rig.rig.bricks().state(green).X_map_brick;
    X_map_brick.translation().z() -= 0.01;  // the blow
    rig.rig.bricks().place(green, X_map_brick);
    const Stamp torn = rig.rig.now;
    status = rig.work(place, 5.0);
    EXPECT_EQ(status.failure_code, "dropped") << status.text;
    ASSERT_TRUE(place.drop().has_value());
    std::printf("dropped, noticed after %.3f s: %s\n", toSeconds(place.drop()->noticed - torn),
                place.drop()->why.c_str());
    EXPECT_LE(toSeconds(place.drop()->noticed - torn), 0.3);
    EXPECT_EQ(place.drop()->name, rig.rig.arena.wall.bricks[green].name);
    const Eigen::Vector3d p = place.drop()->X_base_brick.translation();
    rig.run(1.5);
    EXPECT_LT((p - rig.X_base_brick(green).translation()).head<2>().norm(), 0.3) << "below it";
    EXPECT_NEAR(rig.arm.payloads.back().mass_kg, 5.0, 1e-9);
    rig.parts.gripper.write({});
    rig.run(0.2);
  }
}

/// The magnets lose their power.
TEST_F(PickAndPlaceTest, MagnetsThatFailAreNoticedWithin300Ms) {
  const std::size_t red = rig.nth(BrickKind::Red, 0);
  rig.lay(red, lying(1.0, 0.05, 0, kQuarter));
  rig.run(0.5);
  ASSERT_EQ(pickUp(red).phase, SkillPhase::Done);
  place.start({*pick.held(), lying(0.5, 0.8, 0, 0.0), rig.around(red), {}, {}}, rig.rig.now);
  const Stamp fault = rig.rig.now + fromSeconds(1.0);
  (void)rig.work(place, 60.0, [&] { return rig.rig.now >= fault; });
  for (std::size_t i = 0; i < kMagnets; ++i) rig.rig.gripper->setBroken(i, true);
  const Stamp torn = rig.rig.now;
  EXPECT_EQ(rig.work(place, 5.0).failure_code, "dropped");
  ASSERT_TRUE(place.drop().has_value());
  EXPECT_LE(toSeconds(place.drop()->noticed - torn), 0.3);
}

/// The brick stays on the face, and nothing moves until somebody releases the arm.
TEST_F(PickAndPlaceTest, AProtectiveStopKeepsTheBrickAndWaits) {
  const std::size_t red = rig.nth(BrickKind::Red, 0);
  rig.lay(red, lying(1.0, 0.05, 0, kQuarter));
  rig.run(0.5);
  ASSERT_EQ(pickUp(red).phase, SkillPhase::Done);
  const Eigen::Isometry3d X_base_slot = lying(0.5, 0.8, 0, 0.0);
  place.start({*pick.held(), X_base_slot, rig.around(red), {}, {}}, rig.rig.now);
  const Stamp fault = rig.rig.now + fromSeconds(1.0);
  (void)rig.work(place, 60.0, [&] { return rig.rig.now >= fault; });
  rig.rig.arm->protectiveStop();
  const SkillStatus status = rig.work(place, 5.0);
  EXPECT_EQ(status.failure_code, "protective_stop");
  const Vector6d q = rig.arm.state()->q;
  rig.run(5.0);
  EXPECT_EQ(rig.rig.bricks().grip().held, red);
  EXPECT_LT((rig.arm.state()->q - q).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_EQ(place.poll(rig.rig.now).failure_code, "protective_stop") << "nothing by itself";
  ASSERT_TRUE(rig.controller.releaseProtectiveStop().has_value());
  rig.run(0.5);
  const SkillStatus again = setDown(X_base_slot, red);
  EXPECT_EQ(again.phase, SkillPhase::Done) << again.failure_code << ": " << again.text;
}

/// The plate is not where it is believed to be: found on the spiral, or given up after some tries.
TEST_F(PickAndPlaceTest, WhatDoesNotHangIsTriedBesideAndWhatIsNotThereIsGivenUp) {
  const std::size_t red = rig.nth(BrickKind::Red, 0);
  rig.lay(red, lying(1.0, 0.05, 0, kQuarter));
  rig.run(0.5);
  KnownBrick wrong = rig.known(red);
  wrong.X_frame_brick.translation().z() += 0.05;  // led 2 cm beyond the plate, it is 5 cm away
  PickBrick::Config two;
  two.max_tries = 2;
  PickBrick brief(two, rig.parts);
  brief.start({wrong, rig.around(red), {}, 0.0}, rig.rig.now);
  const SkillStatus status = rig.work(brief, 90.0);
  EXPECT_EQ(status.failure_code, "no_contact") << status.text;
  EXPECT_EQ(brief.tries(), 2);
  EXPECT_TRUE(rig.gripper.state()->on.none());
  EXPECT_FALSE(brief.held().has_value());
}

}  // namespace
}  // namespace kiln

// A brick into a bin and out of it again, on the simulator's own physics.
#include "tests/unit/robot/skills/bricks/handling_rig.h"

namespace kiln {
namespace {

/// Set in upright from the front a little above the floor, it slides back into its place, and is
/// taken from there by what is known of the bin alone (paper, "Storage System").
TEST(Storing, ARedBrickIsSetIntoABinAndTakenOutAgain) {
  HandlingRig rig;
  PickBrick pick({}, rig.parts);
  PlaceBrick::Config known;
  known.beyond_m = 0.006;  // a bin stands where it is known to; below its floor is the deck
  PlaceBrick place(known, rig.parts);
  const StorageRoom room{rig.rig.robot.storage, rig.rig.robot.body, {}};
  const Seat seat{0, 0, 0.0};
  const Eigen::Isometry3d X_seat = X_base_stored(room, {0.0}, seat, BrickKind::Red);
  const Eigen::Vector3d front = X_seat.linear().col(2), up = X_seat.linear().col(0);
  const std::size_t red = rig.nth(BrickKind::Red, 0);
  rig.lay(red, lying(1.0, 0.05, 0, 0.5 * M_PI));
  rig.run(0.5);
  pick.start({rig.known(red), rig.around(red), {}, 0.0}, rig.rig.now);
  SkillStatus status = rig.work(pick, 60.0);
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;

  const auto before = [&](double out_m, double up_m) {
    return Eigen::Translation3d(out_m * front + up_m * up) * X_seat;
  };
  place.start({*pick.held(),
               before(0.01, 0.0),
               rig.around(red),
               {},
               {before(0.35, 0.05), before(0.02, 0.05)}},
              rig.rig.now);
  status = rig.work(place, 120.0);
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  rig.run(2.0);
  const Eigen::Isometry3d off = X_seat.inverse() * rig.X_base_brick(red);
  std::printf("off its seat by %.1f, %.1f, %.1f mm, %.2f deg\n", 1e3 * off.translation().x(),
              1e3 * off.translation().y(), 1e3 * off.translation().z(), rotationAngle(off) / kDeg);
  EXPECT_LT(off.translation().norm(), 0.006);
  EXPECT_EQ(rig.collided(), "");

  const KnownBrick stored{rig.known(red).name, BrickKind::Red, X_seat};
  pick.start({stored, rig.around(red), Eigen::Vector3d::UnitZ(), 0.3}, rig.rig.now);
  status = rig.work(pick, 60.0);
  ASSERT_EQ(status.phase, SkillPhase::Done) << status.failure_code << ": " << status.text;
  EXPECT_EQ(rig.rig.bricks().grip().held, red);
  EXPECT_EQ(rig.collided(), "");
}

}  // namespace
}  // namespace kiln

#include "robot/planning/storage/storage_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robot/planning/build_order/build_time.h"
#include "robot/scene/blueprint.h"
#include "tests/unit/robot/planning/storage/rooms.h"

namespace kiln {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using enum BrickKind;
using testing::bobRoom;
using testing::marioRoom;

/// The kinds of one leg in the order of its best build order.
std::vector<BrickKind> sequenceOf(const Blueprint& wall, WallLeg leg) {
  const auto slots = wallSlots(wall);
  const auto problem = makeLegProblem(slots, leg);
  EXPECT_TRUE(problem.has_value()) << problem.error();
  const auto order = planOptimalOrder(*problem, {});
  EXPECT_TRUE(order.has_value()) << order.error();
  std::vector<BrickKind> kinds;
  for (const BuildPosition& position : order->positions)
    for (const std::size_t slot : position.slots) kinds.push_back(slots[slot].kind);
  return kinds;
}

std::string faultOf(const StorageRoom& room, const StoragePlan& plan) {
  const auto checked = checkStoragePlan(room, {}, plan);
  return checked ? "nothing" : checked.error().message;
}

TEST(StoragePlan, TakesAllMixedBricksOfTheOfficialWallAtOnce) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto sequence = sequenceOf(randomBlueprint(seed), WallLeg::Mixed);
    ASSERT_EQ(sequence.size(), 35U);
    const auto plan = planStorage(bobRoom(), {}, sequence);
    ASSERT_TRUE(plan.has_value()) << plan.error();
    EXPECT_EQ(faultOf(bobRoom(), *plan), "nothing");
    EXPECT_EQ(plan->mixed_bins, 0);
    // Sorted by kind alone, a row each, nearly each change of kind would be a stop.
    EXPECT_LE(plan->unload_stops, 12) << "seed " << seed;
  }
}

TEST(StoragePlan, TakesTheTenOrangeBricksAtOnce) {
  const auto sequence = sequenceOf(randomBlueprint(1), WallLeg::Orange);
  ASSERT_EQ(sequence.size(), 10U);
  const auto plan = planStorage(bobRoom(), {}, sequence);
  ASSERT_TRUE(plan.has_value()) << plan.error();
  EXPECT_EQ(faultOf(bobRoom(), *plan), "nothing");
}

TEST(StoragePlan, TakesTheElevenOfTheLabIntoFiveBins) {
  const auto wall = parseBlueprint("R R G B\nG B R R\nB G G\n", "lab");
  ASSERT_TRUE(wall.has_value()) << wall.error();
  const auto sequence = sequenceOf(*wall, WallLeg::Mixed);
  ASSERT_EQ(sequence.size(), 11U);
  const auto plan = planStorage(marioRoom(), {}, sequence);
  ASSERT_TRUE(plan.has_value()) << plan.error();
  EXPECT_EQ(faultOf(marioRoom(), *plan), "nothing");
  // Of one kind each they take 1 + 2 + 3 bins.
  EXPECT_GE(plan->mixed_bins, 1);
  EXPECT_LE(plan->mixed_bins, 2);
}

TEST(StoragePlan, OfNothingIsEmpty) {
  const auto plan = planStorage(bobRoom(), {}, {});
  ASSERT_TRUE(plan.has_value()) << plan.error();
  EXPECT_EQ(faultOf(bobRoom(), *plan), "nothing");
}

TEST(StoragePlan, NamesTheBrickThatDoesNotFit) {
  std::vector<BrickKind> sequence(6, Blue);
  const auto plan = planStorage(marioRoom(), {}, sequence);
  ASSERT_FALSE(plan.has_value());
  EXPECT_THAT(plan.error().message, AllOf(HasSubstr("blue brick number 6"), HasSubstr("5 bins")));
  // Each orange brick takes a bin; there are 15.
  const auto oranges = planStorage(bobRoom(), {}, std::vector<BrickKind>(16, Orange));
  ASSERT_FALSE(oranges.has_value());
  EXPECT_THAT(oranges.error().message, HasSubstr("orange brick number 16"));
  RobotGeometry short_arm = testing::robot("bob_wall");
  short_arm.X_base_armbase.xyz_m = {5.0, 0.0, 0.62};
  StorageRoom out_of_reach = bobRoom();
  out_of_reach.robot = &short_arm;
  const auto far = planStorage(out_of_reach, {}, std::vector<BrickKind>{Red});
  ASSERT_FALSE(far.has_value());
  EXPECT_THAT(far.error().message, HasSubstr("brick 1 of the build order (red)"));
  StorageRoom none = bobRoom();
  none.rows.clear();
  EXPECT_FALSE(planStorage(none, {}, std::vector<BrickKind>{Red}).has_value());
}

TEST(StoragePlan, RefusesMorePosturesThanItCanLookAt) {
  StorageConfig fine;
  fine.travel_step_m = 0.01;  // 61 positions of three rows
  const auto plan = planStorage(bobRoom(), fine, std::vector<BrickKind>{Red});
  ASSERT_FALSE(plan.has_value());
  EXPECT_THAT(plan.error().message, HasSubstr("travel_step_m"));
}

class CheckedPlan : public ::testing::Test {
 protected:
  CheckedPlan() {
    const std::vector<BrickKind> sequence{Green, Red,   Red,  Green, Blue, Red,
                                          Green, Green, Blue, Blue,  Red};
    const auto plan = planStorage(marioRoom(), {}, sequence);
    EXPECT_TRUE(plan.has_value()) << plan.error();
    if (plan) good_ = *plan;
  }
  /// The step that takes the first brick of a bin with two or more.
  [[nodiscard]] std::size_t lowest() const {
    for (std::size_t i = 0; i < good_.load.size(); ++i)
      if (good_.load[i].seat.height_m > 0.0) return i;
    return 0;
  }
  StoragePlan good_;
};

TEST_F(CheckedPlan, FindsWhatWasMovedOrForgotten) {
  ASSERT_EQ(faultOf(marioRoom(), good_), "nothing");
  StoragePlan bad = good_;
  std::swap(bad.unload[0], bad.unload[1]);
  EXPECT_THAT(faultOf(marioRoom(), bad),
              AllOf(HasSubstr("unload step 1"), HasSubstr("wants brick 1 now")));
  bad = good_;
  bad.load.pop_back();
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("loads 10 and unloads 11"));
  bad = good_;
  bad.load[1] = bad.load[0];
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("set in twice"));
  bad = good_;
  bad.load[lowest()].seat.height_m += 0.3;
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("is filled up to"));
  bad = good_;
  bad.unload[0].seat.bin = (bad.unload[0].seat.bin + 1) % 5;
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("is not there"));
  bad = good_;
  bad.unload[3].posture[0] = 0.4;
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("beyond its travel"));
  bad = good_;
  bad.load[0].seat.bin = 5;
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("a seat that is not there"));
  bad = good_;
  bad.load[0].brick = 99;
  EXPECT_THAT(faultOf(marioRoom(), bad), HasSubstr("none of the build order"));
}

TEST_F(CheckedPlan, NoticesAnOrderThatItWasNotMadeFor) {
  // The paper's third run in the lab: bricks came in another order than the storage expected.
  StoragePlan bad = good_;
  std::size_t upper = lowest();
  const StorageStep above = good_.load[upper];
  for (std::size_t i = 0; i < upper; ++i)
    if (good_.load[i].seat.bin == above.seat.bin) std::swap(bad.load[i], bad.load[upper]);
  EXPECT_NE(faultOf(marioRoom(), bad), "nothing");
}

}  // namespace
}  // namespace kiln

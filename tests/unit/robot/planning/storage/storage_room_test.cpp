#include "robot/planning/storage/storage_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/robot/planning/storage/rooms.h"

namespace kiln {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using enum BrickKind;
using testing::bobRoom;
using testing::marioRoom;

std::string fault(const std::vector<BrickKind>& stack) {
  return stackFault(bobRoom(), {}, 0, stack);
}

TEST(StackRule, GivesTheCapacityOfThePaper) {
  EXPECT_EQ(fault({Red, Red, Red, Red}), "");
  EXPECT_THAT(fault({Red, Red, Red, Red, Red}), HasSubstr("tip over"));  // centre at 1.35 m
  EXPECT_EQ(fault({Green, Green}), "");
  EXPECT_THAT(fault({Green, Green, Green}), HasSubstr("1.50 m high"));
  EXPECT_EQ(fault({Blue}), "");
  EXPECT_NE(fault({Blue, Blue}), "");
  EXPECT_EQ(fault({Orange}), "");
  EXPECT_NE(fault({Orange, Orange}), "");
}

TEST(StackRule, MixedStacksHaveTheLongBrickOnTop) {
  EXPECT_EQ(fault({Red, Red, Blue}), "");  // 1.8 m high, centre of the blue one at 1.2 m
  EXPECT_NE(fault({Blue, Red, Red}), "");  // a red one at 1.65 m
  EXPECT_NE(fault({Red, Red, Red, Blue}), "");
  EXPECT_THAT(fault({Red, Orange}), HasSubstr("2.1 m high"));
  // 1.1 m + 0.1 m / tan(15 deg + atan(0.2)): 1.30 m at 2 m/s2, less with harder brakes
  StorageConfig hard;
  hard.brake_mps2 = 2.6;
  EXPECT_NE(stackFault(bobRoom(), hard, 0, std::vector{Red, Red, Red, Red, Red}), "");
  hard.brake_mps2 = 0.0;
  EXPECT_EQ(stackFault(bobRoom(), hard, 0, std::vector{Red, Red, Red, Red, Red}), "");
}

TEST(StorageRoom, OfBothRobotsIsFreeOfCollisions) {
  for (const StorageRoom& room : {bobRoom(), marioRoom()}) {
    const auto checked = checkRoom(room, {});
    EXPECT_TRUE(checked.has_value()) << checked.error();
  }
}

TEST(StorageRoom, NamesWhatTouchesWhat) {
  const auto faultOf = [](const StorageRoom& room, const StorageConfig& config = {}) {
    const auto checked = checkRoom(room, config);
    return checked ? std::string("nothing") : checked.error().message;
  };
  StorageRoom room = bobRoom();
  room.rows[1].xyz_m[0] = -0.05;  // 17 cm behind the first; a row is 20.5 cm deep
  EXPECT_THAT(faultOf(room), AllOf(HasSubstr("compartment 2"), HasSubstr("compartment 1")));
  room = bobRoom();
  room.rows[0].xyz_m[2] = 0.62;
  EXPECT_THAT(faultOf(room), AllOf(HasSubstr("compartment 1"), HasSubstr("deck")));
  room = bobRoom();
  BoxConfig mast;
  mast.name = "camera mast";
  mast.center.xyz_m = {-0.85, 0.62, 1.2};
  mast.size_m = {0.06, 0.06, 1.2};
  room.body.push_back(mast);  // beside the third row, within its travel
  EXPECT_THAT(faultOf(room), AllOf(HasSubstr("compartment 3"), HasSubstr("camera mast")));
  room = bobRoom();
  room.rows[2].bin_width_m = 0.203;
  EXPECT_THAT(faultOf(room), AllOf(HasSubstr("compartment 3"), HasSubstr("203.0 mm wide")));
  StorageConfig fast;
  fast.brake_mps2 = 3.0;  // 17 deg
  EXPECT_THAT(faultOf(bobRoom(), fast), HasSubstr("slide out"));
  fast.brake_mps2 = std::nan("");
  EXPECT_NE(faultOf(bobRoom(), fast), "nothing");
}

TEST(StorageRoom, StoredBricksStandUprightWithThePlateToTheFront) {
  const StorageRoom room = marioRoom();
  const Seat seat{0, 2, 0.3};
  const Eigen::Isometry3d X = X_base_stored(room, {0.1}, seat, Green);
  const double lean = 15.0 * M_PI / 180.0;
  EXPECT_TRUE(
      X.linear().col(0).isApprox(Eigen::Vector3d(-std::sin(lean), 0, std::cos(lean)), 1e-9));
  EXPECT_TRUE(X.linear().col(2).isApprox(Eigen::Vector3d(std::cos(lean), 0, std::sin(lean)), 1e-9));
  EXPECT_NEAR(X.linear().determinant(), 1.0, 1e-9);
  // The middle of the bin's front edge, 0.6 m up the walls and 0.1 m back. Y of the row is -Y of base.
  const Eigen::Vector3d expected =
      Eigen::Vector3d(-0.12, -0.1, 0.665) + 0.6 * X.linear().col(0) - 0.1 * X.linear().col(2);
  EXPECT_TRUE(X.translation().isApprox(expected, 1e-9)) << X.translation().transpose();
}

TEST(StorageRoom, RowsInFrontBarTheOnesBehind) {
  const StorageRoom room = bobRoom();
  const Seat middle{1, 2, 0.0};
  EXPECT_THAT(accessFault(room, {}, {0, 0, 0}, middle, Red),
              HasSubstr("compartment 1 stands in the way"));
  // Y of the rows points to -Y of base: the front one to one side, the other to the other.
  EXPECT_EQ(accessFault(room, {}, {0.3, -0.3, 0}, middle, Red), "");
  EXPECT_EQ(accessFault(room, {}, {0, 0, 0}, {0, 2, 0.0}, Red), "");
}

TEST(StorageRoom, ASeatIsInReachWhereTheArmCanLeadTheBrickIntoIt) {
  const RobotGeometry bob = testing::robot("bob_wall"), mario = testing::robot("mario");
  const StorageRoom bobs = StorageRoom::of(bob), marios = StorageRoom::of(mario);
  // The last row is too far for what is gripped higher up, the one before it is not.
  EXPECT_EQ(armFault(bobs, {}, 0.0, {2, 2, 0.0}, Blue), "");
  EXPECT_NE(armFault(bobs, {}, 0.0, {2, 2, 0.0}, Orange), "");
  EXPECT_EQ(armFault(bobs, {}, 0.0, {1, 2, 0.0}, Orange), "");
  // Straight before the arm it cannot fold so far; a step aside it can.
  EXPECT_NE(armFault(marios, {}, 0.0, {0, 2, 0.0}, Green), "");
  EXPECT_EQ(armFault(marios, {}, 0.0, {0, 0, 0.0}, Green), "");
  EXPECT_EQ(armFault(marios, {}, 0.0, {0, 2, 0.6}, Blue), "");
}

TEST(StorageRoom, WhatStandsBeforeABinBarsItUntilTheRowHasTravelled) {
  StorageRoom room = marioRoom();
  BoxConfig post;
  post.name = "post";
  post.center.xyz_m = {0.1, 0.0, 1.2};  // before the middle bin
  post.size_m = {0.05, 0.05, 1.0};
  room.body.push_back(post);
  ASSERT_TRUE(checkRoom(room, {}).has_value());
  EXPECT_THAT(accessFault(room, {}, {0.0}, {0, 2, 0.0}, Red), HasSubstr("post stands in the way"));
  EXPECT_EQ(accessFault(room, {}, {0.15}, {0, 2, 0.0}, Red), "");
}

TEST(StorageRoom, BoxesOfFullBinsTouchNothing) {
  const StorageRoom room = bobRoom();
  std::vector<StoredBrick> stored;
  for (std::size_t c = 0; c < 3; ++c)
    for (int bin = 0; bin < 5; ++bin)
      for (int level = 0; level < 4; ++level) stored.push_back({Red, {c, bin, 0.3 * level}});
  const auto boxes = storageBoxes(room, {0.3, -0.3, 0.1}, stored);
  ASSERT_EQ(boxes.size(), 3U * 8U + 60U);
  for (std::size_t i = 24; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (boxes[i].bounds.intersects(boxes[k].bounds)) {
        EXPECT_GT(distance(boxes[i], boxes[k]), -1e-6) << boxes[i].name << ", " << boxes[k].name;
      }
}

}  // namespace
}  // namespace kiln

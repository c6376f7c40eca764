#include "robot/world_model/world_model.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{} + fromSeconds(s); }

WorldState twoPlaces() {
  WorldState world;
  world.places.resize(2);
  return world;
}

TEST(WorldModel, SnapshotShowsOnlyWhatWasPublished) {
  WorldModel world(twoPlaces());
  world.edit().places[0].visited = true;
  EXPECT_FALSE(world.snapshot()->places[0].visited);
  const auto before = world.snapshot();
  world.publish();
  EXPECT_TRUE(world.snapshot()->places[0].visited);
  EXPECT_FALSE(before->places[0].visited) << "a snapshot never changes";
}

TEST(WorldModel, NextPlaceIsTheFirstNotVisited) {
  WorldState world = twoPlaces();
  EXPECT_EQ(world.nextPlace(), 0);
  world.places[0].visited = true;
  EXPECT_EQ(world.nextPlace(), 1);
  world.places[1].visited = true;
  EXPECT_EQ(world.nextPlace(), -1);
}

TEST(WorldModel, NoPlaceIsCurrentWithAnIndexOutOfRange) {
  WorldModel world(twoPlaces());
  EXPECT_EQ(world.currentPlace(), nullptr);
  world.edit().current_place = 1;
  EXPECT_EQ(world.currentPlace(), &world.edit().places[1]);
  world.edit().current_place = 2;
  EXPECT_EQ(world.currentPlace(), nullptr);
}

TEST(WorldModel, ClockStartsOnce) {
  WorldModel world(twoPlaces());
  EXPECT_EQ(world.state().elapsedS(at(50.0)), 0.0);
  world.startClock(at(100.0));
  world.startClock(at(150.0));
  EXPECT_NEAR(world.state().elapsedS(at(160.0)), 60.0, 1e-9);
}

TEST(WorldModel, DowntimeCountsWhenRobotTimeRanOn) {
  WorldModel before(twoPlaces());
  before.startClock(at(100.0));
  WorldModel after(twoPlaces());
  after.restore(before.state(), at(160.0), at(170.0));
  EXPECT_NEAR(after.state().elapsedS(at(170.0)), 70.0, 1e-9);
}

TEST(WorldModel, ClockGoesOnFromItsStandWhenRobotTimeBeganAnew) {
  WorldModel before(twoPlaces());
  before.startClock(at(100.0));
  WorldModel after(twoPlaces());
  after.restore(before.state(), at(160.0), at(5.0));  // the computer was restarted
  EXPECT_NEAR(after.state().elapsedS(at(5.0)), 60.0, 1e-9);
  EXPECT_NEAR(after.state().elapsedS(at(15.0)), 70.0, 1e-9);
}

}  // namespace
}  // namespace kiln

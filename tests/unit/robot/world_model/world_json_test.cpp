#include "robot/world_model/world_json.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

/// Every field differs from its default.
WorldState fullWorld() {
  WorldState world;
  world.clock_started = true;
  world.clock_start = stampFromNanoseconds(123456789012345);
  world.resets = 2;
  FirePlace place;
  place.name = "place \"1\"";
  place.p_plate_map = {12.1, 2.8, 1.0};
  place.facing_rad = 3.14;
  place.visited = place.extinguished = true;
  place.litres_est = 3.9;
  place.searches = 1;
  place.losses = 2;
  place.pump_faults = 3;
  place.arm_faults = 4;
  place.drive_faults = 5;
  place.outcome = "sprayed";
  place.estimate = FireEstimate{Stamp{} + fromSeconds(9),
                                {1, 2, 3},
                                Eigen::Matrix3d::Random(),
                                7,
                                380.5,
                                0.9,
                                0.8,
                                "place 1"};
  world.places = {place, FirePlace{}};
  world.current_place = 1;
  world.at_place = 0;
  world.search_round = 2;
  world.inside = true;
  world.X_map_base = {1.5, -2.5, 0.25};
  world.pose_stamp = Stamp{} + fromSeconds(11);
  world.sprayed_l_est = 4.1;
  world.tank_l_est = {2.9, 3.1};
  world.pump_usable = {false, true};
  world.entry_faults = 1;
  world.blocked_in_row = 3;
  return world;
}

TEST(WorldJson, ComesBackAsItWas) {
  const nlohmann::json once = worldToJson(fullWorld());
  const auto back = worldFromJson(nlohmann::json::parse(once.dump()));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(worldToJson(*back).dump(), once.dump());
  EXPECT_EQ(back->clock_start, fullWorld().clock_start);
  EXPECT_EQ(back->places[0].name, "place \"1\"");
  EXPECT_FALSE(back->places[1].estimate.has_value());
  EXPECT_EQ(back->X_map_base.yaw_rad, 0.25);
  EXPECT_EQ(back->places[0].estimate->views, 7);
}

TEST(WorldJson, RefusesEachMissingKeyByName) {
  const nlohmann::json whole = worldToJson(fullWorld());
  for (const auto& item : whole.items()) {
    nlohmann::json damaged = whole;
    damaged.erase(item.key());
    const auto back = worldFromJson(damaged);
    ASSERT_FALSE(back.has_value()) << item.key();
    EXPECT_EQ(back.error().code, ErrorCode::InvalidInput);
    EXPECT_NE(back.error().message.find(item.key()), std::string::npos) << back.error().message;
  }
}

TEST(WorldJson, RefusesWrongTypesAndNumbersThatAreNone) {
  nlohmann::json wrong = worldToJson(fullWorld());
  wrong["places"] = "none";
  EXPECT_FALSE(worldFromJson(wrong).has_value());
  WorldState nan = fullWorld();
  nan.X_map_base.x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(worldFromJson(nlohmann::json::parse(worldToJson(nan).dump())).has_value());
}

}  // namespace
}  // namespace kiln

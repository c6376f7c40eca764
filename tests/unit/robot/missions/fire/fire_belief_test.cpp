#include "robot/missions/fire/fire_belief.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

/// Every field differs from its default.
FireBelief fullBelief() {
  FireBelief belief;
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
  belief.places = {place, FirePlace{}};
  belief.current_place = 1;
  belief.at_place = 0;
  belief.search_round = 2;
  belief.inside = true;
  belief.sprayed_l_est = 4.1;
  belief.tank_l_est = {2.9, 3.1};
  belief.pump_usable = {false, true};
  belief.entry_faults = 1;
  belief.blocked_in_row = 3;
  return belief;
}

TEST(FireBelief, ComesBackAsItWas) {
  const nlohmann::json once = fireBeliefToJson(fullBelief());
  const auto back = fireBeliefFromJson(nlohmann::json::parse(once.dump()), 2);
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(fireBeliefToJson(*back).dump(), once.dump());
  EXPECT_EQ(back->places[0].name, "place \"1\"");
  EXPECT_FALSE(back->places[1].estimate.has_value());
  EXPECT_EQ(back->places[0].estimate->views, 7);
}

TEST(FireBelief, RefusesEachMissingKeyByName) {
  const nlohmann::json whole = fireBeliefToJson(fullBelief());
  for (const auto& item : whole.items()) {
    nlohmann::json damaged = whole;
    damaged.erase(item.key());
    const auto back = fireBeliefFromJson(damaged, 2);
    ASSERT_FALSE(back.has_value()) << item.key();
    EXPECT_EQ(back.error().code, ErrorCode::InvalidInput);
    EXPECT_NE(back.error().message.find(item.key()), std::string::npos) << back.error().message;
  }
}

TEST(FireBelief, RefusesWrongTypesAndNumbersThatAreNone) {
  nlohmann::json wrong = fireBeliefToJson(fullBelief());
  wrong["places"] = "none";
  EXPECT_FALSE(fireBeliefFromJson(wrong, 2).has_value());
  FireBelief nan = fullBelief();
  nan.sprayed_l_est = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      fireBeliefFromJson(nlohmann::json::parse(fireBeliefToJson(nan).dump()), 2).has_value());
}

TEST(FireBelief, RefusesWhatIsOutOfRange) {
  const auto refusal = [](const std::function<void(FireBelief&)>& damage) {
    FireBelief belief = fullBelief();
    damage(belief);
    const auto back = fireBeliefFromJson(fireBeliefToJson(belief), 2);
    return back ? std::string() : back.error().message;
  };
  EXPECT_EQ(refusal([](FireBelief&) {}), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.places.pop_back(); }), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.current_place = 2; }), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.at_place = -2; }), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.sprayed_l_est = -1.0; }), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.tank_l_est[1] = -0.1; }), "");
  EXPECT_NE(refusal([](FireBelief& b) { b.places[0].litres_est = -3.0; }), "");
}

TEST(FireBelief, NextPlaceIsTheFirstNotVisited) {
  FireBelief belief;
  belief.places.resize(2);
  EXPECT_EQ(belief.nextPlace(), 0);
  belief.places[0].visited = true;
  EXPECT_EQ(belief.nextPlace(), 1);
  belief.places[1].visited = true;
  EXPECT_EQ(belief.nextPlace(), -1);
}

TEST(FireBelief, NoPlaceIsCurrentWithAnIndexOutOfRange) {
  FireBelief belief;
  belief.places.resize(2);
  EXPECT_EQ(belief.currentPlace(), nullptr);
  belief.current_place = 1;
  EXPECT_EQ(belief.currentPlace(), &belief.places[1]);
  belief.current_place = 2;
  EXPECT_EQ(belief.currentPlace(), nullptr);
}

}  // namespace
}  // namespace kiln

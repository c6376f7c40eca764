#include "robot/scene/wall_site_map.h"

#include <gtest/gtest.h>

#include "common/config/resources.h"

namespace kiln {
namespace {

ArenaMap arena(const std::string& file) {
  ArenaMap map;
  EXPECT_TRUE(loadConfig(*resourcePath("config/" + file), map).has_value());
  return map;
}

TEST(WallSiteMap, TheShippedSitesAreWhatTheScenarioSays) {
  const auto site = loadWallSite(arena("arena_wall.yaml"));
  ASSERT_TRUE(site.has_value()) << site.error();
  EXPECT_NEAR(site->layout().length(), 4.2, 1e-9);
  const Pose2 X_pile_wall = inverse(site->pile.pose()) * site->marker.pose();
  EXPECT_GT(std::hypot(X_pile_wall.x_m - 2.1, X_pile_wall.y_m), 12.0);
  EXPECT_LT(std::hypot(X_pile_wall.x_m - 2.1, X_pile_wall.y_m), 20.0);
  const auto lab = loadWallSite(arena("arena_wall_lab.yaml"));
  ASSERT_TRUE(lab.has_value()) << lab.error();
  int bricks = 0;
  for (const BrickStackConfig& stack : lab->stacks) bricks += stack.bricks;
  EXPECT_EQ(bricks, 11);
  EXPECT_NEAR(lab->layout().length(), 2.3, 1e-9);
}

/// Perception is tried on the layouts in the code, the world stands as the files say.
TEST(WallSiteMap, TheShippedSitesAreThePilesThatPerceptionIsTriedOn) {
  for (const auto& [file, nominal] :
       {std::pair{"arena_wall.yaml", arenaPile()}, std::pair{"arena_wall_lab.yaml", labPile()}}) {
    const auto shipped = loadWallSite(arena(file))->layout().slots(), slots = nominal.slots();
    ASSERT_EQ(shipped.size(), slots.size()) << file;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      EXPECT_EQ(shipped[i].kind, slots[i].kind);
      EXPECT_TRUE(shipped[i].X_pile_brick.isApprox(slots[i].X_pile_brick)) << file << i;
    }
  }
}

TEST(WallSiteMap, FixturesAreTheStacksWhereTheyAreBelieved) {
  const auto site = loadWallSite(arena("arena_wall_lab.yaml"));
  const SiteFixtures fixtures = site->fixtures();
  ASSERT_EQ(fixtures.boxes.size(), 3U);
  const BoxConfig& green = fixtures.boxes[1];
  EXPECT_NEAR(green.center.xyz_m[0], site->pile.xy_m[0] + 0.3 + 0.1 + 0.3, 1e-9);
  EXPECT_NEAR(green.center.xyz_m[2], 0.4, 1e-9);
  EXPECT_EQ(green.size_m, (std::vector<double>{0.6, 0.2, 0.8}));
  ASSERT_EQ(fixtures.stands.size(), 2U);
  const Pose2 X_pile_stand = inverse(site->pile.pose()) * fixtures.stands[0].pose();
  EXPECT_NEAR(X_pile_stand.x_m, 1.15, 1e-9);
  EXPECT_LT(X_pile_stand.y_m, -1.0) << "before line 1, not between the lines";
  EXPECT_NEAR(X_pile_stand.yaw_rad, 1.5708, 1e-4) << "and looks at it";
}

TEST(WallSiteMap, AnArenaWithoutOneHasNoStacks) {
  const auto none = loadWallSite(arena("arena_kitchen.yaml"));
  ASSERT_TRUE(none.has_value());
  EXPECT_TRUE(none->stacks.empty());
}

TEST(WallSiteMap, APileOutsideTheSearchAreaIsRefusedInWords) {
  WallSiteMap site = *loadWallSite(arena("arena_wall_lab.yaml"));
  EXPECT_TRUE(site.validate().has_value());
  site.pile.xy_m = {40, 0};
  const auto refused = site.validate();
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message,
            "pile at (40, 0) lies outside search_area; move one of the two");
}

}  // namespace
}  // namespace kiln

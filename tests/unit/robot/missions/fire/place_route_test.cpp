#include "robot/missions/fire/place_route.h"

#include <gtest/gtest.h>

#include "robot/missions/common/route.h"
#include "tests/support/kitchen.h"

namespace kiln {
namespace {

// Circumscribed circle of 1.9 x 1.4 m and the configured clearance.
constexpr double kRadius_m = 1.18 + 0.35;

TEST(PlaceRoute, RoutesBetweenPlacesAreClearAndEndAtTheWorkPose) {
  const auto [arena, site] = loadWholeKitchen();
  const Pose2 hub = arena.entry_path.back().pose();
  const Pose2 work[] = {site.places[0].work_pose.pose(), site.places[1].work_pose.pose()};
  const struct {
    Pose2 here;
    int from;
    int to;
  } cases[] = {{hub, -1, 0}, {hub, -1, 1}, {work[0], 0, 1}, {work[1], 1, 0}};
  for (const auto& c : cases) {
    const auto route = routeToPlace(arena, site, c.here, c.from, c.to, kRadius_m);
    ASSERT_FALSE(route.empty());
    EXPECT_EQ(route.back().x_m, work[c.to].x_m);
    EXPECT_EQ(route.back().yaw_rad, work[c.to].yaw_rad);
    Pose2 at = c.here;
    for (const Pose2& next : route) {
      EXPECT_TRUE(straightIsClear(arena, at, next, 1.18)) << c.from << " -> " << c.to;
      at = next;
    }
  }
}

TEST(PlaceRoute, AtTheSamePlaceOnlyTheWorkPoseIsLeft) {
  const auto [arena, site] = loadWholeKitchen();
  const Pose2 work = site.places[1].work_pose.pose();
  EXPECT_EQ(routeToPlace(arena, site, work, 1, 1, kRadius_m).size(), 1u);
}

}  // namespace
}  // namespace kiln

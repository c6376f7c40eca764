#include <QImage>
#include <QPainter>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/robot_shape.h"
#include "gui/views/scene3d/scene_colors.h"
#include "gui/views/scene3d/scene_labels.h"
#include "gui/views/scene3d/scene_overlay.h"
#include "gui/views/scene3d/scene_state.h"
#include "gui/views/scene3d/scene_tile.h"
#include "gui/views/scene3d/top_view.h"
#include "tests/gui/views/sample_world.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

Stamp at(double seconds) { return Stamp{fromSeconds(seconds)}; }

struct Fixture {
  SampleWorld world;
  SceneState state{{}, world.robot()};
};

RobotStatus statusAt(double seconds, double x_m, int resets = 0) {
  RobotStatus s;
  s.stamp = at(seconds);
  s.X_map_base = {x_m, 0, 0};
  s.resets = resets;
  return s;
}

std::shared_ptr<PointCloud> onePoint(const char* frame, double seconds) {
  auto cloud = std::make_shared<PointCloud>();
  cloud->frame = frame;
  cloud->stamp = at(seconds);
  cloud->push(1, 0, 0, 0, 0, 0);
  return cloud;
}

TEST(SceneState, PlacesACloudWhereTheRobotWasWhenItWasTaken) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, 5.0));
  f.state.setStatus(statusAt(2.0, 6.0));
  f.state.setStatus(statusAt(3.0, 7.0));
  f.state.setCloud(onePoint("base", 1.9));
  EXPECT_DOUBLE_EQ(f.state.snapshot().X_map_cloud.translation().x(), 6.0);
  f.state.setCloud(onePoint("map", 1.9));
  EXPECT_DOUBLE_EQ(f.state.snapshot().X_map_cloud.translation().x(), 0.0);
}

// In a recording that stands no second cloud comes to replace a misplaced one.
TEST(SceneState, ACloudThatComesBeforeThePoseMovesToTheRobotWithIt) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, 5.0));
  f.state.restart();
  f.state.setCloud(onePoint("base", 9.0));
  f.state.setStatus(statusAt(9.05, 8.0));
  EXPECT_DOUBLE_EQ(f.state.snapshot().X_map_cloud.translation().x(), 8.0);
  f.state.setStatus(statusAt(9.15, 8.5));
  EXPECT_DOUBLE_EQ(f.state.snapshot().X_map_cloud.translation().x(), 8.0) << "placed once";
}

TEST(SceneState, PutsALidarCloudAtTheHeadOfTheArm) {
  Fixture f;
  RobotStatus s = statusAt(1.0, 2.0);
  s.arm.q = RobotGeometry::radians(f.world.robot().q_drive_deg);
  f.state.setStatus(s);
  f.state.setCloud(onePoint("lidar", 1.0));
  const Eigen::Isometry3d expected = toIsometry(s.X_map_base) *
                                     f.world.robot().X_base_flange(s.arm.q) *
                                     f.world.robot().X_flange_lidar.pose();
  EXPECT_TRUE(f.state.snapshot().X_map_cloud.isApprox(expected));
}

TEST(SceneState, RefusesACloudInAnUnknownFrameAndKeepsTheLast) {
  Fixture f;
  f.state.setCloud(onePoint("map", 1.0));
  const PointCloudPtr before = f.state.snapshot().cloud;
  f.state.setCloud(onePoint("odom", 2.0));
  EXPECT_EQ(f.state.snapshot().cloud, before);
  EXPECT_NE(f.state.cloudRefusal().find("odom"), std::string::npos);
}

TEST(SceneState, StartsANewTrailAfterAReset) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, 0.0));
  f.state.setStatus(statusAt(1.1, 0.01));  // less than the trail's step: not kept
  f.state.setStatus(statusAt(1.2, 0.20));
  ASSERT_EQ(f.state.snapshot().driven.size(), 1U);
  EXPECT_EQ(f.state.snapshot().driven[0].size(), 2U);
  f.state.setStatus(statusAt(2.0, 0.0, 1));
  EXPECT_EQ(f.state.snapshot().driven.size(), 2U);
}

TEST(SceneState, BoundsTheTrail) {
  Fixture f;
  SceneState state({.trail_points = 50}, f.world.robot());
  for (int i = 0; i < 200; ++i) state.setStatus(statusAt(i, 0.1 * i));
  ASSERT_EQ(state.snapshot().driven.size(), 1U);
  EXPECT_EQ(state.snapshot().driven[0].size(), 50U);
  EXPECT_NEAR(state.snapshot().driven[0].back().x(), 19.9, 1e-9);
}

TEST(SceneState, IgnoresAPoseThatIsNoNumber) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, NAN));
  EXPECT_FALSE(f.state.snapshot().robot_known);
}

TEST(SceneState, TheRobotAndItsScanStandOnTheSlope) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, 2.0));
  LocalizationStatus where;
  where.X_map_base = toIsometry(Pose2{2.0, 0, 0});
  where.X_map_base.translation().z() = -0.4;
  where.X_map_base.linear() = Eigen::AngleAxisd(-0.07, Eigen::Vector3d::UnitY()).toRotationMatrix();
  f.state.setLocalization(where);
  EXPECT_TRUE(f.state.snapshot().robotPose().isApprox(where.X_map_base, 1e-9));
  f.state.setStatus(statusAt(1.1, 2.1));  // the plane of the next status goes with the same slope
  EXPECT_NEAR(f.state.snapshot().robotPose().translation().z(), -0.4, 1e-9);
  f.state.setCloud(onePoint("base", 1.1));
  EXPECT_LT(f.state.snapshot().X_map_cloud.translation().z(), -0.39);
}

TEST(SceneState, TheRobotsMemoryOfItsWayReplacesTheStations) {
  Fixture f;
  f.state.setStatus(statusAt(1.0, 5.0, 1));
  f.state.setTrajectory({at(1.0), {{0, {{0, 0, 0}, {1, 0, 0}}}, {1, {{4, 0, 0}, {5, 0, 0}}}}});
  ASSERT_EQ(f.state.snapshot().driven.size(), 2U);
  f.state.setStatus(statusAt(1.2, 5.5, 1));  // goes on with the last leg
  ASSERT_EQ(f.state.snapshot().driven.size(), 2U);
  EXPECT_EQ(f.state.snapshot().driven.back().size(), 3U);
  f.state.setStatus(statusAt(1.4, 0.0, 2));  // a reset begins another
  EXPECT_EQ(f.state.snapshot().driven.size(), 3U);
  f.state.restart();
  EXPECT_TRUE(f.state.snapshot().driven.empty());
}

TEST(SceneState, KnowsThePartOfTheMapInUseWhicheverComesFirst) {
  auto map = std::make_shared<MapLayer>();
  map->submaps = {"outdoor", "indoor"};
  LocalizationStatus where;
  where.submap = "indoor";
  Fixture early, late;
  early.state.setMap(map);
  early.state.setLocalization(where);
  late.state.setLocalization(where);
  late.state.setMap(map);
  EXPECT_EQ(early.state.snapshot().submap, 1);
  EXPECT_EQ(late.state.snapshot().submap, 1);
  where.submap = "cellar";
  late.state.setLocalization(where);
  EXPECT_EQ(late.state.snapshot().submap, -1);
}

TEST(OrbitCamera, APixelOfTheGroundIsThePointThatIsDrawnThere) {
  for (const OrbitCamera::Mode mode : {OrbitCamera::Mode::Top, OrbitCamera::Mode::Free}) {
    OrbitCamera camera;
    camera.reset({3.0, 1.0, 0.0});
    camera.setMode(mode);
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(3.0, 1.0), {4.5, -0.5}, {2.2, 2.0}}) {
      const auto pixel = camera.project({p.x(), p.y(), 0.0}, 800, 500);
      ASSERT_TRUE(pixel.has_value());
      const auto back = camera.groundPoint(*pixel, 800, 500);
      ASSERT_TRUE(back.has_value());
      EXPECT_LT((*back - p).norm(), 1e-6);
    }
  }
}

TEST(OrbitCamera, TheSkyIsNoGround) {
  OrbitCamera camera;
  camera.reset({0, 0, 0});
  camera.setMode(OrbitCamera::Mode::Free);
  for (int i = 0; i < 60; ++i) camera.orbit(0, -10, 500);  // down to the horizon
  EXPECT_FALSE(camera.groundPoint({400, 0}, 800, 500).has_value());
  EXPECT_FALSE(camera.groundPoint({400, 250}, 0, 0).has_value());
}

TEST(SceneState, LayersAgeAtTheirLimits) {
  Fixture f;
  const auto freshness = [&](double age_s) {
    f.state.setAge(SceneLayer::Lidar, age_s);
    return f.state.snapshot().layer(SceneLayer::Lidar).freshness;
  };
  EXPECT_EQ(freshness(-1), Freshness::Missing);
  EXPECT_EQ(freshness(1.49), Freshness::Fresh);
  EXPECT_EQ(freshness(1.5), Freshness::Aging);
  EXPECT_EQ(freshness(3.0), Freshness::Stale);
}

TEST(OrbitCamera, LooksAtTheRobotAndKeepsItWhileItDrives) {
  OrbitCamera camera;
  camera.reset({3, 4, 0});
  const auto middle = camera.project({3, 4, 0.6}, 800, 600);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 400, 1e-6);
  EXPECT_NEAR(middle->y(), 300, 1e-6);
  camera.robotAt({9, -2, 0});
  EXPECT_NEAR(camera.project({9, -2, 0.6}, 800, 600)->x(), 400, 1e-6);
  camera.pan(50, 0, 600);
  EXPECT_EQ(camera.mode(), OrbitCamera::Mode::Free);
  camera.robotAt({0, 0, 0});
  EXPECT_NEAR(camera.project({9, -2, 0.6}, 800, 600)->x(), 450,
              1e-6);  // moved with the mouse, and stayed
}

TEST(OrbitCamera, TopHasMapXUpAndYToTheLeft) {
  OrbitCamera camera;
  camera.setMode(OrbitCamera::Mode::Top);
  camera.robotAt({0, 0, 0});
  const auto ahead = camera.project({1, 0, 0}, 800, 600),
             left = camera.project({0, 1, 0}, 800, 600);
  ASSERT_TRUE(ahead && left);
  EXPECT_LT(ahead->y(), 300);
  EXPECT_NEAR(ahead->x(), 400, 1e-6);
  EXPECT_LT(left->x(), 400);
}

TEST(OrbitCamera, DoesNotProjectWhatIsBehindIt) {
  OrbitCamera camera;
  camera.reset({0, 0, 0});
  EXPECT_FALSE(camera.project(2.0 * camera.position() - camera.target(), 800, 600));
}

TEST(RobotShape, HasAPoseForEveryPartAndMovesHeadAndWheels) {
  const SampleWorld world;
  const RobotShape shape(world.robot());
  Vector6d q = RobotGeometry::radians(world.robot().q_drive_deg);
  const auto rest = shape.poses(q, {});
  ASSERT_EQ(rest.size(), shape.parts().size());
  q[0] += 0.5;
  const auto moved = shape.poses(q, {0.3, 0, 0, 0});
  const std::size_t head = rest.size() - 2, first_wheel = world.robot().body.size();
  EXPECT_GT((moved[head].translation() - rest[head].translation()).norm(), 0.1);
  EXPECT_NEAR(rotationAngle(rest[first_wheel].inverse() * moved[first_wheel]), 0.3, 1e-9);
  EXPECT_TRUE(moved[first_wheel + 1].isApprox(rest[first_wheel + 1]));
  // The nozzle ends where the jet begins.
  const Eigen::Vector3d exit =
      (world.robot().X_base_flange(q) * world.robot().X_flange_nozzle.pose()).translation();
  const RobotPart& nozzle = shape.parts().back();
  EXPECT_LT((moved.back() * Eigen::Vector3d(0, 0, 0.5 * nozzle.size.z()) - exit).norm(), 1e-9);
}

TEST(ItemCard, SaysThatAnUncertaintyIsDrawnLarger) {
  SceneItem item;
  item.shape = SceneItem::Shape::Estimate;
  item.label = "place 1 · 0.86 m";
  item.detail = "127 °C peak";
  item.covariance =
      Eigen::Vector3d(1e-4, 2.5e-5, 2.5e-5).asDiagonal();  // 1 cm standard deviation at most
  EXPECT_EQ(itemCard(item).title, QString("place 1 · 0.86 m"));
  EXPECT_TRUE(itemCard(item).detail.startsWith("127 °C peak, "));
  EXPECT_TRUE(itemCard(item).detail.contains("×4"));  // 2 cm drawn as 8 cm
  item.covariance.setConstant(NAN);
  EXPECT_EQ(itemCard(item).detail, QString("127 °C peak"));
}

TEST(SceneState, TheMissionsLayersComeAndGoAndStayHidden) {
  Fixture f;
  MissionInfo info;
  info.layers = {{"a", "Layer A"}, {"b", "Layer B"}};
  f.state.setMission(info);
  EXPECT_TRUE(f.state.snapshot().layer("a").visible);
  EXPECT_TRUE(f.state.snapshot().layer("unknown").visible) << "nothing of the robot's is lost";
  f.state.setVisible("a", false);
  f.state.setMissionAge(2.0);
  EXPECT_EQ(f.state.snapshot().layer("b").freshness, Freshness::Aging);
  info.layers = {{"a", "Layer A"}};
  f.state.setMission(info);
  EXPECT_FALSE(f.state.snapshot().layer("a").visible) << "as the operator left it";
  EXPECT_EQ(f.state.snapshot().mission_layers.size(), 1U);
}

TEST_F(StationTest, TopViewDrawsTheRobotAndHidesALayer) {
  Fixture f;
  const RobotStatus robot = f.world.status(at(1), 9.0);
  f.state.setStatus(robot);
  f.state.setAge(SceneLayer::Robot, 0.0);
  OrbitCamera camera;
  camera.setMode(OrbitCamera::Mode::Top);
  camera.robotAt({robot.X_map_base.x_m, robot.X_map_base.y_m, 0});
  const RobotShape shape(f.world.robot());
  const SceneColors colors = SceneColors::of(theme);
  const auto draw = [&] {
    QImage image(400, 300, QImage::Format_RGB32);
    QPainter painter(&image);
    paintTopView(painter, f.state.snapshot(), camera, colors, shape, image.size());
    return image;
  };
  const QImage shown = draw();
  f.state.setVisible(SceneLayer::Robot, false);
  const QImage hidden = draw();
  EXPECT_NE(shown, hidden);
  EXPECT_NE(shown.pixel(205, 150), qRgb(colors.ground.r, colors.ground.g, colors.ground.b));
  EXPECT_EQ(hidden.pixel(205, 155), qRgb(colors.ground.r, colors.ground.g, colors.ground.b));
}

/// A picture from above of items alone: how many of its pixels are drawn.
struct ItemPicture {
  explicit ItemPicture(Theme& theme) : colors(SceneColors::of(theme)) {
    camera.setMode(OrbitCamera::Mode::Top);
    camera.robotAt({0, 0, 0});
  }
  int drawn(const SceneItem& item) {
    SceneSnapshot snapshot;
    snapshot.items = {item};
    QImage image(400, 300, QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    paintSceneOverlay(painter, snapshot, {}, camera, colors, image.size());
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += image.pixel(x, y) != qRgb(0, 0, 0) ? 1 : 0;
    return count;
  }
  SceneColors colors;
  OrbitCamera camera;
};

TEST_F(StationTest, AnArrowHasAHeadAndACylinderIsRound) {
  ItemPicture picture(theme);
  SceneItem item;
  item.points = {{0, 0, 0}, {2, 0, 0}};
  const int line = picture.drawn(item);
  EXPECT_GT(line, 10);
  item.shape = SceneItem::Shape::Arrow;
  EXPECT_GT(picture.drawn(item), line);
  SceneItem box;
  box.shape = SceneItem::Shape::Box;
  box.size = {2, 2, 0.01};
  SceneItem cylinder = box;
  cylinder.shape = SceneItem::Shape::Cylinder;
  EXPECT_GT(picture.drawn(cylinder), 10);
  EXPECT_LT(picture.drawn(cylinder), picture.drawn(box)) << "a circle is shorter than its square";
}

TEST_F(StationTest, AClickNamesTheLabelledItemNearestToIt) {
  SceneSnapshot snapshot;
  SceneItem left, right, nameless;
  left.id = "left";
  left.label = "place 1";
  right.id = "right";
  right.label = "place 2";
  right.X_map_item.translation().x() = 2.0;
  nameless.X_map_item.translation().x() = 1.0;
  snapshot.items = {left, nameless, right};
  OrbitCamera camera;
  camera.setMode(OrbitCamera::Mode::Top);
  camera.robotAt({0, 0, 0});
  const QSize size(800, 600);
  const auto pixel = [&](const SceneItem& item) {
    const auto p = camera.project(item.X_map_item.translation(), size.width(), size.height());
    return QPointF(p->x(), p->y());
  };
  ASSERT_NE(itemAt(snapshot, camera, size, pixel(left)), nullptr);
  EXPECT_EQ(itemAt(snapshot, camera, size, pixel(left) + QPointF(5, 5))->id, "left");
  EXPECT_EQ(itemAt(snapshot, camera, size, pixel(right))->id, "right");
  EXPECT_EQ(itemAt(snapshot, camera, size, pixel(nameless)), nullptr);
}

TEST_F(StationTest, TheScenesHeaderSaysLiveOnlyWhileItIs) {
  const SceneTile tile(ui, models, RobotGeometry{}, false);
  EXPECT_TRUE(tile.headerText().endsWith("live")) << tile.headerText().toStdString();
  link.time.advanceBy(std::chrono::milliseconds(900));
  feed(false);  // the LiDAR is silent, the robot is not
  EXPECT_TRUE(tile.headerText().endsWith("cloud 0.90 s old")) << tile.headerText().toStdString();
  link.time.advanceBy(std::chrono::seconds(9));
  emit models.aged();
  EXPECT_TRUE(tile.headerText().endsWith("last heard 9.0 s ago"))
      << tile.headerText().toStdString();
  EXPECT_FALSE(tile.headerText().contains("live"));
}

}  // namespace
}  // namespace kiln::gui

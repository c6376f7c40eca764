#include "common/wire/fire/codec/fire_codec.h"
#include "gui/panels/fire/aim_marks.h"
#include "gui/panels/fire/thermal_tile.h"
#include "gui/panels/fire/work_pose.h"
#include "tests/gui/views/sample_world.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

/// 160 x 120, pixel (u, v) at 20 + u / 2 + v / 10 degrees: every pixel has its own value.
std::shared_ptr<ThermalImage> ramp(Stamp stamp, std::uint32_t counter) {
  auto image = std::make_shared<ThermalImage>();
  image->stamp = stamp;
  image->seq = image->frame_counter = counter;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u)
      image->counts.push_back(
          static_cast<std::uint16_t>(std::lround((20.0 + u / 2.0 + v / 10.0 + 273.15) * 100.0)));
  return image;
}

TEST(PerceptualMap, HeatGetsLighterWithEveryStep) {
  const PerceptualMap map = PerceptualMap::heat();
  for (std::size_t i = 8; i < map.table().size(); ++i)
    EXPECT_GT(lightness(map.table()[i]), lightness(map.table()[i - 8])) << "at " << i;
  EXPECT_LT(lightness(map.at(0.0)), 0.2);
  EXPECT_GT(lightness(map.at(1.0)), 0.9);
}

TEST(PerceptualMap, StepsLookEqual) {
  for (const PerceptualMap& map :
       {PerceptualMap::heat(), PerceptualMap::height(true), PerceptualMap::height(false)}) {
    const double step = (lightness(map.at(1.0)) - lightness(map.at(0.0))) / 8.0;
    for (int i = 0; i < 8; ++i)  // 8-bit rounding leaves about 1 %
      EXPECT_NEAR(lightness(map.at((i + 1) / 8.0)) - lightness(map.at(i / 8.0)), step, 0.02);
  }
}

TEST(PerceptualMap, ClampsAndSurvivesNan) {
  const PerceptualMap map = PerceptualMap::heat();
  EXPECT_EQ(map.at(-3.0), map.table().front());
  EXPECT_EQ(map.at(7.0), map.table().back());
  EXPECT_EQ(map.at(NAN), map.table().front());
}

TEST(ThermalScale, AutomaticScaleFitsThePictureAndIsNeverNarrow) {
  const auto image = ramp({}, 1);
  const ThermalScale scale = ThermalScale::fitted(*image);
  EXPECT_TRUE(scale.automatic);
  EXPECT_NEAR(scale.high_c, 20.0 + 159 / 2.0 + 119 / 10.0, 0.01);
  ThermalImage flat = *image;
  flat.counts.assign(flat.counts.size(), 30000);
  const ThermalScale narrow = ThermalScale::fitted(flat);
  EXPECT_GE(narrow.high_c - narrow.low_c, 10.0);
}

TEST_F(StationTest, HoverReadsThePixelUnderTheMouse) {
  ThermalView view(ui);
  view.resize(500, 240);
  view.show(ramp({}, 1), nullptr, {});
  const QRectF picture = view.pictureRect();
  const double pixel = picture.width() / 160.0;
  const auto at = [&](int u, int v) {
    return QPoint(static_cast<int>(picture.left() + (u + 0.5) * pixel),
                  static_cast<int>(picture.top() + (v + 0.5) * pixel));
  };
  EXPECT_EQ(view.readingAt(at(0, 0)), QString("20.0 °C at (0, 0)"));
  EXPECT_EQ(view.readingAt(at(98, 50)), QString("74.0 °C at (98, 50)"));
  EXPECT_EQ(view.readingAt(at(159, 119)), QString("111.4 °C at (159, 119)"));
  EXPECT_EQ(view.readingAt(QPoint(499, 1)), QString());  // on the scale
}

TEST_F(StationTest, CountsThatAreNoTemperaturesAreNotReadAsSuch) {
  auto image = ramp(link.time.now(), 1);
  image->tlinear = false;
  EXPECT_FALSE(celsiusAt(*image, 3, 3));
  EXPECT_FALSE(peakCelsius(*image));
  ThermalTile tile(ui, models);
  emit link.thermal(image);
  models.flush();
  EXPECT_TRUE(tile.refusal().contains("TLinear"));
}

TEST_F(StationTest, AFrozenCameraIsNamedAlthoughFramesKeepComing) {
  ThermalTile tile(ui, models);
  emit link.thermal(ramp(link.time.now(), 7));
  models.flush();
  EXPECT_EQ(tile.refusal(), QString());
  for (int i = 0; i < 12; ++i) {
    link.time.advanceBy(std::chrono::milliseconds(114));
    emit link.thermal(ramp(link.time.now(), 7));  // the camera's own counter stands still
  }
  models.flush();
  EXPECT_TRUE(tile.refusal().startsWith("frozen")) << tile.refusal().toStdString();
}

TEST_F(StationTest, ACutOffPictureIsRefused) {
  auto image = ramp(link.time.now(), 1);
  image->counts.resize(1000);
  EXPECT_TRUE(colorize(*image, {}, PerceptualMap::heat()).isNull());
  ThermalTile tile(ui, models);
  emit link.thermal(image);
  models.flush();
  EXPECT_TRUE(tile.refusal().contains("1000 of 19200"));
  tile.view().setAutomaticScale(true);
}

FireSite twoPlaces() {
  FireSite site;
  site.places = {{"place 1", {5, 0, 1}, M_PI, false, {}, Pose2{3.0, 0.0, 0.0}},
                 {"place 2", {5, 4, 1}, M_PI, false, {}, Pose2{3.0, 4.0, 0.0}}};
  return site;
}

TEST(WorkPose, TellsTheWayToTheNearestInTheRobotsOwnWords) {
  FireSite site = twoPlaces();
  const Pose2 looks_left{3.1, 0.42, M_PI / 2};
  const auto way = nearestWorkPose(site, looks_left);
  ASSERT_TRUE(way);
  EXPECT_EQ(workText(*way), "place 1: 0.42 m back, 0.10 m left, turn 90° right");
  EXPECT_EQ(nearestWorkPose(site, {3.0, 3.0, 0.0})->place, "place 2");
  site.places[1].visited = true;
  EXPECT_EQ(nearestWorkPose(site, {3.0, 3.0, 0.0})->place, "place 1") << "the one still to do";
  EXPECT_EQ(workText(*nearestWorkPose(site, {3.05, -0.05, 0.03})), "place 1: at its work pose ✓");
  EXPECT_FALSE(nearestWorkPose(site, {3.0, 0.0, 0.1})->reached()) << "more than 5 degrees";
  site.places.clear();
  EXPECT_FALSE(nearestWorkPose(site, {}));
}

TEST_F(StationTest, TheWayIsThatOfNowAndUnknownWithoutALink) {
  WorkPoseLine line(ui, models);
  Scene scene;
  scene.detail = wire::encodeDetail(twoPlaces());
  emit link.scene(std::make_shared<Scene>(scene));
  status.X_map_base = {2.0, 0.0, 0.0};
  feed();
  EXPECT_EQ(line.text(), "place 1: 1.00 m ahead, 0.00 m left, turn 0° left");
  status.X_map_base = {2.5, 0.0, 0.0};
  feed();
  EXPECT_TRUE(line.text().startsWith("place 1: 0.50 m ahead")) << line.text().toStdString();
  link.time.advanceBy(std::chrono::seconds(2));
  EXPECT_EQ(line.text(), "way to the work pose: not known");
}

TEST(PictureMarks, StandWhereTheCameraSeesThem) {
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const auto middle = placeInPicture({0, 0, 2}, X, 1.0, {160, 120});
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 0.5, 1e-9);
  EXPECT_NEAR(middle->y(), 0.5, 1e-9);
  const auto edge = placeInPicture({std::tan(0.499), 0, 1}, X, 1.0, {160, 120});
  ASSERT_TRUE(edge);
  EXPECT_GT(edge->x(), 0.99);
  EXPECT_FALSE(placeInPicture({std::tan(0.51), 0, 1}, X, 1.0, {160, 120})) << "beside the picture";
  EXPECT_FALSE(placeInPicture({0, 0, -2}, X, 1.0, {160, 120})) << "behind the camera";
}

TEST(AimMarks, SayByHowMuchThePlateIsMissed) {
  EXPECT_EQ(aimText({{}, "place 1", 0.02, -0.03}), "place 1: on the plate");
  EXPECT_EQ(aimText({{}, "place 1", -0.12, 0.05}), "place 1: 12 cm right, 5.0 cm high");
  EXPECT_EQ(aimText({{}, "", 0.0, 0.0}), "the jet ends here");
}

TEST_F(StationTest, TheThermalPictureMarksWhereTheJetHits) {
  const SampleWorld world;
  ThermalTile tile(ui, models, world.robot());
  status.arm.q = RobotGeometry::radians(world.robot().q_drive_deg);
  status.X_map_base = {1.0, 2.0, 0.5};
  FireSite site;
  const Eigen::Isometry3d X_map_camera = toIsometry(status.X_map_base) *
                                         world.robot().X_base_flange(status.arm.q) *
                                         world.robot().X_flange_thermal.pose();
  site.jet_map = {X_map_camera.translation(), X_map_camera * Eigen::Vector3d(0, 0, 1.5)};
  Scene scene;
  scene.detail = wire::encodeDetail(site);
  emit link.scene(std::make_shared<Scene>(scene));
  emit link.thermal(ramp(link.time.now(), 1));
  feed();
  ASSERT_EQ(tile.view().marks().size(), 1U);
  EXPECT_NEAR(tile.view().marks()[0].share.x(), 0.5, 1e-6);
  EXPECT_EQ(tile.view().marks()[0].label, "the jet ends here");
  link.time.advanceBy(std::chrono::seconds(3));
  emit models.aged();
  EXPECT_TRUE(tile.view().marks().empty()) << "an old picture and an old aim do not fit";
}

}  // namespace
}  // namespace kiln::gui

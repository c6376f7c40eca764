#include "gui/panels/fire/thermal_tile.h"
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

}  // namespace
}  // namespace kiln::gui

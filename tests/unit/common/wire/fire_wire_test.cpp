#include <algorithm>

#include <gmock/gmock.h>

#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"

namespace kiln {
namespace {

FireSite site() {
  FireSite out;
  out.stamp = Stamp{fromSeconds(3)};
  out.fires.push_back(
      {out.stamp, {1, 2, 3}, 1e-4 * Eigen::Matrix3d::Identity(), 31, 400.15, 0.86, 1.1, "place 2"});
  out.places = {{"place 1", {4, 5, 1}, 0.5, true, {0.1, -0.1, 0.05}},
                {"place 2", {6, 5, 1}, 0.0, false, {}}};
  out.jet_map = {{1, 0, 0}, {2, 0, 0}};
  out.spraying = true;
  PlaceCheck seen;
  seen.place = "place 1";
  seen.X_map_sensed = makePose({1, 2, 0}, {0, 0, 0});
  seen.verdict = PlaceVerdict::Misplaced;
  seen.reason = "18 cm off";
  PlaceCheck unseen;
  unseen.place = "place 2";
  out.place_checks = {seen, unseen};
  return out;
}

TEST(FireWire, ASiteAndDetectionsComeBack) {
  const MissionDetail detail = wire::encodeDetail(site());
  EXPECT_EQ(detail.schema, fire::kSiteSchema);
  const auto back = wire::decodeFireSite(detail.data);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(wire::encodeDetail(*back).data, detail.data);
  EXPECT_TRUE(back->place_checks.at(0).X_map_sensed.has_value());
  EXPECT_FALSE(back->place_checks.at(1).X_map_sensed.has_value());
  HeatDetections heat;
  heat.image_seq = 7;
  heat.blobs.resize(2);
  heat.blobs[1].rejection = HeatRejection::Reflection;
  const auto found = wire::decodeHeat(wire::encodeDetail(heat).data);
  ASSERT_TRUE(found) << found.error();
  EXPECT_EQ(found->blobs.at(1).rejection, HeatRejection::Reflection);
}

std::vector<SceneItem> itemsOf(SceneItem::Shape shape, ItemStyle style) {
  std::vector<SceneItem> out;
  for (const SceneItem& item : fire::sceneItems(site()))
    if (item.shape == shape && item.style == style) out.push_back(item);
  return out;
}

TEST(FireView, DrawsWhatTheOperatorNeeds) {
  using Shape = SceneItem::Shape;
  const auto fires = itemsOf(Shape::Estimate, ItemStyle::Target);
  ASSERT_EQ(fires.size(), 1u);
  EXPECT_EQ(fires[0].label, "place 2 · 0.86 m · ±2.0 cm") << "two standard deviations";
  EXPECT_EQ(fires[0].detail, "127 °C peak, 31 views");
  const auto jet = itemsOf(Shape::Polyline, ItemStyle::Active);
  ASSERT_EQ(jet.size(), 1u) << "it sprays";
  EXPECT_EQ(jet[0].points.size(), 2u);
  EXPECT_EQ(itemsOf(Shape::Polyline, ItemStyle::Suspected).size(), 1u) << "not visited: place 2";
  EXPECT_EQ(itemsOf(Shape::Box, ItemStyle::Caution).size(), 1u) << "sensed elsewhere: place 1";
  EXPECT_EQ(itemsOf(Shape::Box, ItemStyle::Configured).size(), 2u);
  const auto names = itemsOf(Shape::Text, ItemStyle::Normal);
  ASSERT_EQ(names.size(), 1u) << "place 2 is named by its fire";
  EXPECT_EQ(names[0].label, "place 1 · visited");
}

TEST(FireView, EveryItemAndFigureIsDeclared) {
  const MissionInfo info = fire::missionInfo(0.5, 30.0);
  for (const SceneItem& item : fire::sceneItems(site()))
    EXPECT_TRUE(std::any_of(info.layers.begin(), info.layers.end(), [&](const LayerSpec& layer) {
      return layer.id == item.layer;
    })) << item.layer;
  const WaterLevels water{{0.5, 1.0}, {2.0, 2.1}, {4.0, 4.5}, 0.7};
  const std::vector<Figure> figures = fire::figures(water, 4.2, 400.15);
  ASSERT_EQ(figures.size(), info.figures.size());
  for (const FigureSpec& spec : info.figures)
    EXPECT_NE(findFigure(figures, spec.id), nullptr) << spec.id;
  EXPECT_DOUBLE_EQ(findFigure(figures, "water.left")->value, 8.5);
  EXPECT_NEAR(findFigure(figures, "thermal.peak")->value, 127.0, 1e-9);
  const WaterLevels back = fire::waterLevels(figures);
  EXPECT_EQ(back.tank_l_est, water.tank_l_est);
  EXPECT_EQ(back.current_a, water.current_a);
  EXPECT_EQ(back.duty, water.duty);
  EXPECT_EQ(back.sprayed_l_est, water.sprayed_l_est);
}

}  // namespace
}  // namespace kiln

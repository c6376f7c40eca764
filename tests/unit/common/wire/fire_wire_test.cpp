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
  out.places[0].X_map_work = out.places[1].X_map_work = Pose2{7.5, 5.0, M_PI};
  out.footprint_m = {1.9, 1.4};
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
  ASSERT_TRUE(back->places.at(1).X_map_work.has_value());
  EXPECT_DOUBLE_EQ(back->places.at(1).X_map_work->x_m, 7.5);
  EXPECT_EQ(back->footprint_m, site().footprint_m);
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
  ASSERT_EQ(jet.size(), 4u) << "it sprays: the jet, and a cross where it hits";
  EXPECT_EQ(jet[0].points.size(), 2u);
  EXPECT_EQ(itemsOf(Shape::Polyline, ItemStyle::Suspected).size(), 1u) << "not visited: place 2";
  EXPECT_EQ(itemsOf(Shape::Box, ItemStyle::Caution).size(), 1u) << "sensed elsewhere: place 1";
  EXPECT_EQ(itemsOf(Shape::Box, ItemStyle::Configured).size(), 2u);
  const auto names = itemsOf(Shape::Text, ItemStyle::Normal);
  ASSERT_EQ(names.size(), 1u) << "place 2 is named by its fire";
  EXPECT_EQ(names[0].label, "place 1 · visited");
}

TEST(FireView, OutlinesTheWorkPoseOfAPlaceThatWasNotVisited) {
  const auto lines = itemsOf(SceneItem::Shape::Polyline, ItemStyle::Planned);
  ASSERT_EQ(lines.size(), 2u) << "outline and arrow of place 2";
  EXPECT_EQ(lines[0].id, "place 2");
  ASSERT_EQ(lines[0].points.size(), 5u);
  for (const Eigen::Vector3d& p : lines[0].points) {
    EXPECT_NEAR(std::abs(p.x() - 7.5), 0.95, 1e-9);
    EXPECT_NEAR(std::abs(p.y() - 5.0), 0.7, 1e-9);
  }
}

TEST(FireView, TheAimIsWhereTheJetCrossesAPlate) {
  FireSite there = site();  // place 2: plate at (6, 5, 1), looks along X
  there.fires.clear();
  there.jet_map = {{7.0, 4.8, 1.3}, {6.5, 4.8, 1.2}, {5.5, 4.8, 1.0}};
  const auto aim = fire::jetAim(there);
  ASSERT_TRUE(aim);
  EXPECT_EQ(aim->place, "place 2");
  EXPECT_NEAR((aim->p_map - Eigen::Vector3d(6.0, 4.8, 1.1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(aim->up_m, 0.1, 1e-9);
  EXPECT_NEAR(aim->left_m, 0.2, 1e-9);  // who looks along -X has -Y at the left
  FireEstimate found;  // the plate stands where its heat was found, not where it was configured
  found.place = "place 2";
  found.p_map = Eigen::Vector3d(6.0, 4.8, 1.1);
  there.fires = {found};
  EXPECT_NEAR(std::hypot(fire::jetAim(there)->left_m, fire::jetAim(there)->up_m), 0.0, 1e-9);
  there.jet_map = {{7.0, 8.0, 1.3}, {6.5, 8.0, 0.4}};
  EXPECT_EQ(fire::jetAim(there)->place, "");
  EXPECT_EQ(fire::jetAim(there)->p_map, there.jet_map.back());
  there.jet_map.clear();
  EXPECT_FALSE(fire::jetAim(there));
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

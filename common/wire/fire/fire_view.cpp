#include "common/wire/fire/fire_view.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

namespace kiln::fire {
namespace {

constexpr double kZeroCelsius_k = 273.15;
constexpr double kTank_l = 5.0, kTankLow_l = 0.7, kWaterLow_l = 2.0;
constexpr double kGround_m = 0.02;
constexpr double kPlateRadius_m = 0.075;
constexpr const char* kPlaces = "fire.places";
constexpr const char* kFires = "fire.estimate";
constexpr const char* kJet = "fire.jet";

FigureSpec figureSpec(const std::string& id, const std::string& label, const std::string& unit,
                      int decimals, double high) {
  FigureSpec spec;
  spec.id = id;
  spec.label = label;
  spec.unit = unit;
  spec.decimals = decimals;
  spec.high = high;
  return spec;
}

std::vector<FigureSpec> figureSpecs() {
  FigureSpec water = figureSpec("water.left", "Water", "l", 1, 2.0 * kTank_l);
  water.caution_below = kWaterLow_l;
  water.estimated = water.top_bar = true;
  water.doc = "left in both tanks by the pump model; there is no flow sensor";
  FigureSpec sprayed = figureSpec("water.sprayed", "Sprayed", "l", 2, 0.0);
  sprayed.estimated = true;
  sprayed.doc = "in this mission, by the pump model";
  FigureSpec score = figureSpec("score", "Score", "", 1, 0.0);
  score.estimated = score.top_bar = true;
  score.doc = "points of Challenge 3 for the water that the pump model has counted";
  FigureSpec peak = figureSpec("thermal.peak", "Peak", "°C", 0, 60.0);
  peak.low = 20.0;
  peak.plot = true;
  peak.doc = "hottest pixel of the thermal image";
  std::vector<FigureSpec> specs{water, sprayed, score, peak};
  for (const char* side : {"left", "right"}) {
    FigureSpec tank =
        figureSpec(fmt::format("tank.{}", side), fmt::format("Tank {}", side), "l", 1, kTank_l);
    tank.caution_below = kTankLow_l;
    tank.estimated = true;
    specs.push_back(tank);
    specs.push_back(
        figureSpec(fmt::format("pump.{}.duty", side), fmt::format("Pump {}", side), "", 2, 1.0));
    specs.push_back(figureSpec(fmt::format("pump.{}.current", side),
                               fmt::format("Pump {} current", side), "A", 1, 10.0));
  }
  return specs;
}

SceneItem polyline(const char* layer, std::string id, ItemStyle style, double width_px,
                   std::vector<Eigen::Vector3d> points) {
  SceneItem item;
  item.id = std::move(id);
  item.layer = layer;
  item.style = style;
  item.width_px = width_px;
  item.points = std::move(points);
  return item;
}

std::vector<Eigen::Vector3d> circle(double radius, const Eigen::Vector3d& center,
                                    const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  constexpr int kSteps = 28;
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = 2.0 * M_PI * i / kSteps;
    line.emplace_back(center + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return line;
}

/// A configured place: the plate's outline, the way it looks, a stem to the ground, and the paper's
/// red rectangle where it may burn.
void addPlace(const FirePlaceInfo& place, bool named_by_fire, std::vector<SceneItem>& out) {
  const Eigen::Vector3d away(std::cos(place.yaw_rad), std::sin(place.yaw_rad), 0.0);
  const Eigen::Vector3d side(-away.y(), away.x(), 0.0), up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d tip = place.p_map + 0.35 * away;
  const ItemStyle mark = place.visited ? ItemStyle::Done : ItemStyle::Normal;
  const auto add = [&](std::vector<Eigen::Vector3d> points) {
    out.push_back(polyline(kPlaces, place.name, mark, 1.0, std::move(points)));
  };
  add(circle(kPlateRadius_m, place.p_map, side, up));
  add({place.p_map, tip});
  out.back().shape = SceneItem::Shape::Arrow;
  add({place.p_map, Eigen::Vector3d(place.p_map.x(), place.p_map.y(), 0.0)});
  Eigen::Isometry3d X = frontOf(place);
  X.translation().z() = kGround_m;
  std::vector<Eigen::Vector3d> outline;
  const double h = 0.5 * FireSite::kBox_m, deep = -FireSite::kBox_m;
  for (const auto& [x, y] : {std::pair{deep, -h}, {0.0, -h}, {0.0, h}, {deep, h}, {deep, -h}})
    outline.emplace_back(X * Eigen::Vector3d(x, y, 0.0));
  out.push_back(polyline(kPlaces, place.name,
                         place.visited ? ItemStyle::Done : ItemStyle::Suspected,
                         place.visited ? 1.5 : 2.5, std::move(outline)));
  if (named_by_fire) return;
  SceneItem name;
  name.id = place.name;
  name.layer = kPlaces;
  name.shape = SceneItem::Shape::Text;
  name.X_map_item.translation() = place.p_map + Eigen::Vector3d(0, 0, 0.5);
  name.label = place.name + (place.visited ? " · visited" : "");
  out.push_back(std::move(name));
}

/// Where the base is to stand: its footprint, and an arrow to its front.
void addWorkPose(const FirePlaceInfo& place, const Eigen::Vector2d& footprint_m,
                 std::vector<SceneItem>& out) {
  if (!place.X_map_work || place.visited || footprint_m.minCoeff() <= 0.0) return;
  const Eigen::Isometry3d X = toIsometry(*place.X_map_work);
  const double l = 0.5 * footprint_m.x(), w = 0.5 * footprint_m.y();
  const auto add = [&](const std::vector<std::pair<double, double>>& corners) {
    std::vector<Eigen::Vector3d> line;
    for (const auto& [x, y] : corners) line.emplace_back(X * Eigen::Vector3d(x, y, kGround_m));
    out.push_back(polyline(kPlaces, place.name, ItemStyle::Planned, 1.5, std::move(line)));
  };
  add({{l, w}, {-l, w}, {-l, -w}, {l, -w}, {l, w}});
  add({{l - 0.3, 0.3}, {l, 0.0}, {l - 0.3, -0.3}});
}

/// Where the robot has found the heat of a place; else its plate as configured.
Eigen::Vector3d plateOf(const FirePlaceInfo& place, const FireSite& site) {
  for (const FireEstimate& fire : site.fires)
    if (fire.place == place.name && fire.p_map.allFinite()) return fire.p_map;
  return place.p_map;
}

/// A cross where the jet hits, seen through everything.
void addAim(const JetAim& aim, ItemStyle style, std::vector<SceneItem>& out) {
  constexpr double kArm_m = 0.08;
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(Eigen::Vector3d::UnitX()), Eigen::Vector3d(Eigen::Vector3d::UnitY()),
        Eigen::Vector3d(Eigen::Vector3d::UnitZ())})
    out.push_back(
        polyline(kJet, "aim", style, 2.5, {aim.p_map - kArm_m * d, aim.p_map + kArm_m * d}));
}

void addCheck(const PlaceCheck& check, std::vector<SceneItem>& out) {
  const auto add = [&](std::vector<SceneItem> items) {
    for (SceneItem& item : items) out.push_back(std::move(item));
  };
  add(boxItems(check.place, check.X_map_configured, ItemStyle::Configured, 1.2));
  if (!check.X_map_sensed) return;
  const bool off = check.verdict == PlaceVerdict::Misplaced;
  const ItemStyle style = off ? ItemStyle::Caution : ItemStyle::Sensed;
  add(boxItems(check.place, *check.X_map_sensed, style, off ? 2.5 : 1.2));
  out.push_back(
      polyline(kPlaces, check.place, style, off ? 2.5 : 1.2,
               {check.X_map_configured.translation(), check.X_map_sensed->translation()}));
}

/// Two standard deviations along the worst axis, in words.
std::string spreadText(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return "± unknown";
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  const double spread_m = 2.0 * std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
  return fmt::format("±{:.{}f} cm", 100.0 * spread_m, spread_m < 0.0995 ? 1 : 0);
}

SceneItem fireItem(const FireEstimate& fire) {
  SceneItem item;
  item.id = fire.place;
  item.layer = kFires;
  item.shape = SceneItem::Shape::Estimate;
  item.style = ItemStyle::Target;
  item.X_map_item.translation() = fire.p_map;
  item.covariance = fire.covariance;
  item.label = fmt::format("{} · {:.2f} m · {}", fire.place.empty() ? "heat source" : fire.place,
                           fire.range_m, spreadText(fire.covariance));
  item.detail = fmt::format("{:.0f} °C peak, {} views", fire.peak_k - kZeroCelsius_k, fire.views);
  return item;
}

}  // namespace

MissionInfo missionInfo(double max_nudge_m, double max_nudge_deg) {
  MissionInfo info;
  info.title = "Challenge 3, fire in the kitchen";
  info.figures = figureSpecs();
  info.layers = {{kPlaces, "Fire places"}, {kFires, "Fire estimate"}, {kJet, "Jet"}};
  CommandSpec nudge;
  nudge.name = kNudgePlace;
  nudge.text = "Move place";
  nudge.consequence = "The robot then drives and aims by the moved place.";
  nudge.confirmation = Confirmation::Hold;
  nudge.while_stopped = true;
  nudge.target = "place";
  nudge.arguments = {{"x", "m", -max_nudge_m, max_nudge_m, "along x of the map"},
                     {"y", "m", -max_nudge_m, max_nudge_m, "along y of the map"},
                     {"yaw", "deg", -max_nudge_deg, max_nudge_deg, "about the plate's vertical"}};
  CommandSpec go_on;
  go_on.name = kContinueDespite;
  go_on.text = "Go on anyway";
  go_on.consequence = "The mission goes on with the place as it is configured.";
  go_on.confirmation = Confirmation::Hold;
  go_on.needs_live = true;
  go_on.target = "place";
  info.commands = {nudge, go_on};
  info.panels = {"fire.thermal", "fire.water", "fire.places", "fire.aim"};
  return info;
}

std::vector<Figure> figures(const WaterLevels& water, double score, double peak_k) {
  std::vector<Figure> out{{"water.left", water.tank_l_est[0] + water.tank_l_est[1]},
                          {"water.sprayed", water.sprayed_l_est},
                          {"score", score},
                          {"thermal.peak", peak_k - kZeroCelsius_k}};
  const char* sides[] = {"left", "right"};
  for (std::size_t i = 0; i < 2; ++i) {
    out.push_back({fmt::format("tank.{}", sides[i]), water.tank_l_est[i]});
    out.push_back({fmt::format("pump.{}.duty", sides[i]), water.duty[i]});
    out.push_back({fmt::format("pump.{}.current", sides[i]), water.current_a[i]});
  }
  return out;
}

WaterLevels waterLevels(const std::vector<Figure>& figures) {
  const auto value = [&](std::string_view id) {
    const Figure* figure = findFigure(figures, id);
    return figure ? figure->value : 0.0;
  };
  WaterLevels water;
  water.tank_l_est = {value("tank.left"), value("tank.right")};
  water.duty = {value("pump.left.duty"), value("pump.right.duty")};
  water.current_a = {value("pump.left.current"), value("pump.right.current")};
  water.sprayed_l_est = value("water.sprayed");
  return water;
}

std::vector<SceneItem> sceneItems(const FireSite& site) {
  std::vector<SceneItem> out;
  for (const FirePlaceInfo& place : site.places)
    addPlace(place,
             std::any_of(site.fires.begin(), site.fires.end(),
                         [&](const FireEstimate& fire) { return fire.place == place.name; }),
             out);
  for (const FirePlaceInfo& place : site.places) addWorkPose(place, site.footprint_m, out);
  for (const PlaceCheck& check : site.place_checks) addCheck(check, out);
  for (const FireEstimate& fire : site.fires)
    if (fire.p_map.allFinite()) out.push_back(fireItem(fire));
  if (!site.jet_map.empty())
    out.push_back(polyline(kJet, "jet", site.spraying ? ItemStyle::Active : ItemStyle::Planned,
                           site.spraying ? 4.0 : 1.0, site.jet_map));
  if (const auto aim = jetAim(site))
    addAim(*aim, site.spraying ? ItemStyle::Active : ItemStyle::Planned, out);
  return out;
}

std::optional<JetAim> jetAim(const FireSite& site) {
  if (site.jet_map.empty()) return std::nullopt;
  JetAim best{site.jet_map.back(), {}};
  double nearest_m = kNearPlate_m;
  for (const FirePlaceInfo& place : site.places) {
    const Eigen::Vector3d out_of_plate(std::cos(place.yaw_rad), std::sin(place.yaw_rad), 0.0);
    const Eigen::Vector3d p_plate = plateOf(place, site);
    for (std::size_t i = 1; i < site.jet_map.size(); ++i) {
      const Eigen::Vector3d &from = site.jet_map[i - 1], &to = site.jet_map[i];
      const double before_m = out_of_plate.dot(from - p_plate),
                   after_m = out_of_plate.dot(to - p_plate);
      if (before_m < 0.0 || after_m >= 0.0) continue;
      const Eigen::Vector3d at = from + before_m / (before_m - after_m) * (to - from);
      const Eigen::Vector3d miss = at - p_plate;
      if (miss.norm() > nearest_m) continue;
      nearest_m = miss.norm();
      const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(-out_of_plate);
      best = {at, place.name, left.dot(miss), miss.z()};
    }
  }
  return best;
}

Eigen::Isometry3d frontOf(const FirePlaceInfo& place) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(place.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = place.p_map + X.linear().col(0) * FireSite::kRecess_m;
  return X;
}

std::vector<SceneItem> boxItems(const std::string& id, const Eigen::Isometry3d& X_map_front,
                                ItemStyle style, double width_px) {
  SceneItem box;
  box.id = id;
  box.layer = kPlaces;
  box.shape = SceneItem::Shape::Box;
  box.style = style;
  box.width_px = width_px;
  box.X_map_item = X_map_front * Eigen::Translation3d(-0.5 * FireSite::kBox_m, 0, 0);
  box.size = Eigen::Vector3d::Constant(FireSite::kBox_m);
  return {box, polyline(kPlaces, id, style, width_px,
                        {X_map_front.translation(), X_map_front * Eigen::Vector3d(0.25, 0, 0)})};
}

}  // namespace kiln::fire

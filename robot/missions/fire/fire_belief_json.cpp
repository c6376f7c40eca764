#include <cmath>

#include <nlohmann/json.hpp>

#include "robot/missions/fire/fire_belief.h"

namespace kiln {
namespace {
using nlohmann::json;

json toJson(const FireEstimate& estimate) {
  std::vector<double> covariance(estimate.covariance.data(), estimate.covariance.data() + 9);
  return {{"stamp_ns", toNanoseconds(estimate.stamp)},
          {"p_map", {estimate.p_map.x(), estimate.p_map.y(), estimate.p_map.z()}},
          {"covariance_m2", covariance},
          {"views", estimate.views},
          {"peak_k", estimate.peak_k},
          {"range_m", estimate.range_m},
          {"baseline_range_m", estimate.baseline_range_m},
          {"place", estimate.place}};
}

Eigen::Vector3d vectorFrom(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

FireEstimate estimateFrom(const json& j) {
  FireEstimate out;
  out.stamp = stampFromNanoseconds(j.at("stamp_ns").get<std::int64_t>());
  out.p_map = vectorFrom(j.at("p_map"));
  for (std::size_t i = 0; i < 9; ++i)
    out.covariance.data()[i] = j.at("covariance_m2").at(i).get<double>();
  out.views = j.at("views").get<int>();
  out.peak_k = j.at("peak_k").get<double>();
  out.range_m = j.at("range_m").get<double>();
  out.baseline_range_m = j.at("baseline_range_m").get<double>();
  out.place = j.at("place").get<std::string>();
  return out;
}

json toJson(const FirePlace& place) {
  json out = {
      {"name", place.name},
      {"p_plate_map", {place.p_plate_map.x(), place.p_plate_map.y(), place.p_plate_map.z()}},
      {"facing_rad", place.facing_rad},
      {"nudges", place.nudges},
      {"nudge", {place.nudge.x_m, place.nudge.y_m, place.nudge.yaw_rad}},
      {"visited", place.visited},
      {"extinguished", place.extinguished},
      {"litres_est", place.litres_est},
      {"searches", place.searches},
      {"losses", place.losses},
      {"pump_faults", place.pump_faults},
      {"arm_faults", place.arm_faults},
      {"drive_faults", place.drive_faults},
      {"outcome", place.outcome}};
  if (place.estimate) out["estimate"] = toJson(*place.estimate);
  return out;
}

FirePlace placeFrom(const json& j) {
  FirePlace out;
  out.name = j.at("name").get<std::string>();
  out.p_plate_map = vectorFrom(j.at("p_plate_map"));
  out.facing_rad = j.at("facing_rad").get<double>();
  out.nudges = j.at("nudges").get<int>();
  const Eigen::Vector3d nudge = vectorFrom(j.at("nudge"));
  out.nudge = {nudge.x(), nudge.y(), nudge.z()};
  out.visited = j.at("visited").get<bool>();
  out.extinguished = j.at("extinguished").get<bool>();
  out.litres_est = j.at("litres_est").get<double>();
  out.searches = j.at("searches").get<int>();
  out.losses = j.at("losses").get<int>();
  out.pump_faults = j.at("pump_faults").get<int>();
  out.arm_faults = j.at("arm_faults").get<int>();
  out.drive_faults = j.at("drive_faults").get<int>();
  out.outcome = j.at("outcome").get<std::string>();
  if (j.contains("estimate")) out.estimate = estimateFrom(j.at("estimate"));
  return out;
}

FireBelief beliefFrom(const json& j) {
  FireBelief out;
  for (const json& place : j.at("places")) out.places.push_back(placeFrom(place));
  out.current_place = j.at("current_place").get<int>();
  out.at_place = j.at("at_place").get<int>();
  out.search_round = j.at("search_round").get<int>();
  out.inside = j.at("inside").get<bool>();
  out.sprayed_l_est = j.at("sprayed_l_est").get<double>();
  out.tank_l_est = {j.at("tank_l_est").at(0).get<double>(), j.at("tank_l_est").at(1).get<double>()};
  out.pump_usable = {j.at("pump_usable").at(0).get<bool>(), j.at("pump_usable").at(1).get<bool>()};
  out.entry_faults = j.at("entry_faults").get<int>();
  out.blocked_in_row = j.at("blocked_in_row").get<int>();
  return out;
}

/// What is wrong with it; empty: nothing.
std::string outOfRange(const FireBelief& belief, std::size_t places) {
  if (belief.places.size() != places)
    return fmt::format("it knows {} fire places, the arena has {}", belief.places.size(), places);
  const int count = static_cast<int>(places);
  const auto isPlace = [count](int index) { return index >= -1 && index < count; };
  if (!isPlace(belief.current_place) || !isPlace(belief.at_place))
    return fmt::format("it stands at place {} of {}", belief.current_place + 1, count);
  for (const double litres : {belief.sprayed_l_est, belief.tank_l_est[0], belief.tank_l_est[1]})
    if (litres < 0.0) return fmt::format("{:.1f} l of water are less than none", litres);
  for (const FirePlace& place : belief.places)
    if (place.litres_est < 0.0) return place.name + " got less than no water";
  return {};
}

}  // namespace

json fireBeliefToJson(const FireBelief& belief) {
  json places = json::array();
  for (const FirePlace& place : belief.places) places.push_back(toJson(place));
  return {{"places", places},
          {"current_place", belief.current_place},
          {"at_place", belief.at_place},
          {"search_round", belief.search_round},
          {"inside", belief.inside},
          {"sprayed_l_est", belief.sprayed_l_est},
          {"tank_l_est", {belief.tank_l_est[0], belief.tank_l_est[1]}},
          {"pump_usable", {belief.pump_usable[0], belief.pump_usable[1]}},
          {"entry_faults", belief.entry_faults},
          {"blocked_in_row", belief.blocked_in_row}};
}

// JSON writes NaN as null, which is then of the wrong type: a non-finite number cannot come back.
Result<FireBelief> fireBeliefFromJson(const json& j, std::size_t places) {
  try {
    FireBelief belief = beliefFrom(j);
    if (const std::string wrong = outOfRange(belief, places); !wrong.empty())
      return makeError(ErrorCode::InvalidInput, "{}", wrong);
    return belief;
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput, "what is known of the fires is damaged: {}",
                     e.what());
  }
}

}  // namespace kiln

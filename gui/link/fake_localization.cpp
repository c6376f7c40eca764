#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gui/link/fake_robot.h"

/// What the fake robot tells of where it is, and what it is told about it.
namespace kiln::gui {

namespace {
constexpr double kTrailStep_m = 0.1;
constexpr double kDoor_m = 6.0;  ///< x of the doorway: the map's parts meet there
constexpr double kMapSpacing_m = 0.08;
constexpr double kRecess_m = 0.1;  ///< of a plate behind its box's front
constexpr double kTolerance_m = 0.15;

Eigen::Isometry3d frontOf(const FirePlaceInfo& place) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(place.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = place.p_map + kRecess_m * X.linear().col(0);
  return X;
}
}  // namespace

LocalizationStatus FakeRobot::localization() const {
  LocalizationStatus s;
  s.stamp = now_;
  s.health = health_;
  s.method = health_ == LocalizationHealth::Good ? "surfel map" : "odometry";
  s.submap = pose_.x_m < kDoor_m ? "outdoor" : "indoor";
  s.X_map_base = toIsometry(pose_);
  const bool good = health_ == LocalizationHealth::Good;
  s.sigma_m = good ? 0.009 : health_ == LocalizationHealth::Degraded ? 0.21 : 0.62;
  s.sigma_yaw_rad = good ? 0.004 : 0.03;
  s.covariance = Eigen::Vector3d(s.sigma_m * s.sigma_m, 0.3 * s.sigma_m * s.sigma_m,
                                 s.sigma_yaw_rad * s.sigma_yaw_rad)
                     .asDiagonal();
  s.match_age_s = good ? 0.1 : 6.4;
  s.inlier_fraction = good ? 0.87 : 0.21;
  s.observable_directions = good ? 6 : 5;
  s.matches = static_cast<std::uint64_t>(10.0 * toSeconds(now_));
  if (state_ == "EnterBuilding" || state_ == "DriveToLocation")
    s.tracking_error_m = 0.012 + 0.008 * std::sin(toSeconds(now_));
  if (health_ == LocalizationHealth::Degraded)
    s.reason = "odometry alone for 6.4 s: 21 % of the scan fits the map; drive slowly";
  if (health_ == LocalizationHealth::Lost)
    s.reason = "no scan fits the map within 1 m; set the pose on the map";
  s.resets = static_cast<int>(legs_.size()) - 1;
  return s;
}

Trajectory FakeRobot::trajectory() const { return {now_, legs_}; }

void FakeRobot::leaveTrail() {
  auto& line = legs_.back().X_map_base;
  if (!line.empty() &&
      std::hypot(line.back().x_m - pose_.x_m, line.back().y_m - pose_.y_m) < kTrailStep_m) {
    return;
  }
  line.push_back(pose_);
}

std::vector<Check> FakeRobot::checks() const {
  const double litres = tank_[0] + tank_[1];
  std::vector<Check> rows{{"Transforms", true, "14 of 14"},
                          {"Clock offset", true, "3 ms"},
                          {"Arm powered", true, "normal"},
                          {"LiDAR", true, "10.0 Hz"},
                          {"Thermal camera", true, "8.8 Hz"},
                          {"Map against scan", true, "87 % fits"},
                          {"Pump current", true, "0.0 A at rest"},
                          {"Controller limits", true, "as configured"},
                          {"Battery", true, "28.9 V"},
                          {"Water", litres > 1.0, fmt::format("{:.1f} l est.", litres)},
                          {"Disk", true, "41 GB free"}};
  if (!checks_fail_) return rows;
  rows[0] = {"Transforms", false, "arm_base -> flange missing",
             "The arm's driver does not report joints: look at its power and cable."};
  rows[3] = {"LiDAR", false, "no scan for 2.1 s", "Check the LiDAR's cable and power."};
  rows[5] = {"Map against scan", false, "31 % fits",
             "Is this the right map? Else set the robot's pose on the map."};
  return rows;
}

std::vector<FirePlaceInfo> FakeRobot::places() const {
  std::vector<FirePlaceInfo> places{
      {"place 1", {12.1, 2.8, 1.0}, M_PI, at_ >= 5, nudges_[0]},
      {"place 2", {10.6, -4.6, 1.0}, M_PI / 2, terminal_, nudges_[1]}};
  for (FirePlaceInfo& place : places) {
    place.p_map += Eigen::Vector3d(place.nudge.x_m, place.nudge.y_m, 0.0);
    place.yaw_rad += place.nudge.yaw_rad;
  }
  return places;
}

std::vector<PlaceCheck> FakeRobot::placeChecks() const {
  const std::array<Pose2, 2> truth{Pose2{0.03, -0.02, 0.01}, Pose2{0.16, 0.09, 0.05}};
  const auto configured = places();
  std::vector<PlaceCheck> checks;
  for (std::size_t i = 0; i < 2; ++i) {
    if (at_ < (i == 0 ? 3U : 7U) || (!running_ && !terminal_)) continue;
    FirePlaceInfo seen = configured[i];
    seen.p_map += Eigen::Vector3d(truth[i].x_m - nudges_[i].x_m, truth[i].y_m - nudges_[i].y_m, 0);
    seen.yaw_rad += truth[i].yaw_rad - nudges_[i].yaw_rad;
    PlaceCheck check;
    check.stamp = now_;
    check.place = seen.name;
    check.X_map_configured = frontOf(configured[i]);
    check.X_map_sensed = frontOf(seen);
    const Pose2 by = check.correction();
    check.offset_m = std::hypot(by.x_m, by.y_m);
    check.yaw_offset_rad = by.yaw_rad;
    check.coverage = 0.74;
    check.points = 412;
    const bool off = check.offset_m > kTolerance_m;
    check.verdict = off ? PlaceVerdict::Misplaced : PlaceVerdict::Fits;
    if (off)
      check.reason =
          "The box does not stand where it is configured: the arm would hit it. Move "
          "the place or look and go on.";
    checks.push_back(std::move(check));
  }
  return checks;
}

FakeRobot::Ack FakeRobot::setPose(const SetPose& pose) {
  if (running_ && !paused_) {
    return {AckOutcome::Refused, "mission_running",
            "the pose is not set under a running mission; pause it first"};
  }
  pose_ = pose.X_map_base;
  health_ = LocalizationHealth::Good;
  legs_.back().X_map_base.clear();
  say(2, fmt::format("pose set by {}", holder_name_));
  return {AckOutcome::Done, "", ""};
}

FakeRobot::Ack FakeRobot::nudge(const MissionCommand& nudge) {
  const auto known = places();
  const auto place = std::find_if(known.begin(), known.end(),
                                  [&](const FirePlaceInfo& p) { return p.name == nudge.target; });
  if (place == known.end()) {
    return {AckOutcome::Refused, "no_such_place",
            fmt::format("there is no fire place '{}'", nudge.target)};
  }
  Pose2& sum = nudges_[static_cast<std::size_t>(place - known.begin())];
  for (const auto& [name, value] : nudge.arguments) {
    if (name == "x") sum.x_m += value;
    if (name == "y") sum.y_m += value;
    if (name == "yaw") sum.yaw_rad += value * M_PI / 180.0;
  }
  say(3, fmt::format("{} moved by {}", nudge.target, holder_name_));
  return {AckOutcome::Done, "", ""};
}

MapLayer makeFakeMap() {
  MapLayer map;
  map.name = "kitchen";
  map.version = 1;
  map.submaps = {"outdoor", "indoor"};
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, 0.012f);
  for (const SceneBox& box : makeFakeArena()) {
    for (const int axis : {0, 1}) {  // the upright faces, which a scan sees
      for (const double side : {-1.0, 1.0}) {
        const int along = 1 - axis;
        for (double u = -box.half_extent[along]; u < box.half_extent[along]; u += kMapSpacing_m) {
          for (double z = -box.half_extent.z(); z < box.half_extent.z(); z += 2 * kMapSpacing_m) {
            Eigen::Vector3d p;
            p[axis] = side * box.half_extent[axis];
            p[along] = u;
            p.z() = z;
            p = box.X_map_box * p;
            if (map.points_map.size() >= kMaxMapLayerPoints) return map;
            map.points_map.emplace_back(p.cast<float>() +
                                        Eigen::Vector3f(noise(random), noise(random), 0.0f));
            map.submap_of.push_back(p.x() < kDoor_m ? 0 : 1);
          }
        }
      }
    }
  }
  return map;
}

}  // namespace kiln::gui

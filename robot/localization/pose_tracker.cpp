#include "robot/localization/pose_tracker.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/core/units.h"

namespace kiln {
namespace {

double squared(double v) { return v * v; }

bool finite(const Pose2& X) {
  return std::isfinite(X.x_m) && std::isfinite(X.y_m) && std::isfinite(X.yaw_rad);
}

/// Covariance of (x, y, yaw) out of one of (x, y, z, roll, pitch, yaw).
Eigen::Matrix3d planar(const Eigen::Matrix<double, 6, 6>& covariance) {
  constexpr int kRows[3] = {0, 1, 5};
  Eigen::Matrix3d out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) out(r, c) = covariance(kRows[r], kRows[c]);
  }
  return out;
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, wrapAngle(a.yaw_rad - b.yaw_rad)};
}

}  // namespace

std::string_view toString(Submap submap) { return submap == Submap::Indoor ? "indoor" : "outdoor"; }

std::string_view toString(PoseHealth health) {
  switch (health) {
    case PoseHealth::Lost:
      return "lost";
    case PoseHealth::Degraded:
      return "degraded";
    case PoseHealth::Good:
      return "good";
  }
  return "lost";
}

void PoseTracker::Config::visit(ConfigArchive& a) {
  a.field("start_sigma_m", start_sigma_m, "m", 0, 10, "1-sigma of where the robot is put down");
  a.field("start_sigma_deg", start_sigma_deg, "deg", 0, 180, "1-sigma of how it is turned then");
  a.field("drift_per_metre", drift_per_metre, "m/m", 0, 1, "position drift of the odometry");
  a.field("yaw_drift_per_metre_deg", yaw_drift_per_metre_deg, "deg/m", 0, 45,
          "yaw drift of the odometry");
  a.field("yaw_drift_per_turn", yaw_drift_per_turn, "rad/rad", 0, 1, "yaw drift while turning");
  a.field("walk_sigma_m", walk_sigma_m, "m", 0, 1, "random walk of the position in one second");
  a.field("walk_sigma_deg", walk_sigma_deg, "deg", 0, 10, "random walk of the yaw in one second");
  a.field("gate_sigmas", gate_sigmas, "", 1, 100, "fixes further off are refused");
  a.field("search_after_rejections", search_after_rejections, "", 1, 1000, "scans");
  a.field("lost_after_rejections", lost_after_rejections, "", 1, 10000, "scans");
  a.field("carried_m", carried_m, "m", 0.01, 10, "a search that ends so far off: carried, lost");
  a.field("carried_deg", carried_deg, "deg", 0.1, 180, "the same for the heading");
  a.field("carried_inlier_fraction", carried_inlier_fraction, "", 0, 1,
          "share of a scan that the map must explain there");
  a.field("correction_rate_mps", correction_rate_mps, "m/s", 0.01, 10, "slew of the correction");
  a.field("correction_rate_deg_s", correction_rate_deg_s, "deg/s", 0.1, 360,
          "slew of the correction");
  a.field("good_sigma_m", good_sigma_m, "m", 0.001, 10, "above: degraded");
  a.field("good_age_s", good_age_s, "s", 0.1, 600, "above: degraded");
  a.field("lost_age_s", lost_age_s, "s", 0.1, 3600, "above: lost");
  a.field("lost_sigma_m", lost_sigma_m, "m", 0.01, 100, "above: lost");
  a.field("lost_distance_m", lost_distance_m, "m", 0.01, 1000, "driven since the last fix");
  a.field("history_s", history_s, "s", 0.2, 60, "odometry kept for late scans");
  a.field("odometry_only", odometry_only, "take no fixes: to compare with");
}

void PoseTracker::reset(const Eigen::Isometry3d& X_map_base_3d, Stamp now) {
  const Pose2 X_map_base = projectToGround(X_map_base_3d);
  ground_point_ = X_map_base_3d.translation();
  ground_normal_ = X_map_base_3d.linear().col(2);
  last_failure_.clear();
  odometry_.clear();
  X_map_base_reset_ = X_map_base;
  X_map_odom_ = X_map_odom_control_ = X_map_base;
  anchored_ = has_fix_ = false;
  covariance_ = Eigen::Vector3d(squared(config_.start_sigma_m), squared(config_.start_sigma_m),
                                squared(config_.start_sigma_deg * kDeg))
                    .asDiagonal();
  last_fix_ = now;
  distance_since_fix_m_ = 0.0;
  rejected_in_a_row_ = 0;
  carried_ = false;
  ++epoch_;
}

void PoseTracker::addOdometry(Stamp stamp, const Pose2& X_odom_base) {
  if (!finite(X_odom_base) || (!odometry_.empty() && stamp <= odometry_.back().stamp)) return;
  if (!anchored_) {
    X_map_odom_ = X_map_odom_control_ = X_map_base_reset_ * inverse(X_odom_base);
    anchored_ = true;
  } else {
    const double dt_s = toSeconds(stamp - odometry_.back().stamp);
    predict(inverse(odometry_.back().X_odom_base) * X_odom_base, dt_s);
    slew(dt_s);
  }
  odometry_.push_back({stamp, X_odom_base});
  while (stamp - odometry_.front().stamp > fromSeconds(config_.history_s)) odometry_.pop_front();
}

/// The error of (x, y, yaw) in map after a step of odometry: a yaw error turns into a sideways one.
void PoseTracker::predict(const Pose2& X_old_new, double dt_s) {
  const double yaw = (X_map_odom_ * odometry_.back().X_odom_base).yaw_rad;
  const double dx = std::cos(yaw) * X_old_new.x_m - std::sin(yaw) * X_old_new.y_m;
  const double dy = std::sin(yaw) * X_old_new.x_m + std::cos(yaw) * X_old_new.y_m;
  const double distance = std::hypot(dx, dy);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -dy;
  F(1, 2) = dx;
  // Errors of successive steps are taken as independent over one metre, hence distance and not its
  // square.
  const double position =
      squared(config_.drift_per_metre) * distance + squared(config_.walk_sigma_m) * dt_s;
  const double heading = squared(config_.yaw_drift_per_metre_deg * kDeg) * distance +
                         squared(config_.yaw_drift_per_turn) * std::abs(X_old_new.yaw_rad) +
                         squared(config_.walk_sigma_deg * kDeg) * dt_s;
  covariance_ = F * covariance_ * F.transpose();
  covariance_.diagonal() += Eigen::Vector3d(position, position, heading);
  distance_since_fix_m_ += distance;
}

/// Moves the control pose towards the filter's pose, measured at the base: a yaw correction must
/// not swing the base about a far-away odometry origin.
void PoseTracker::slew(double dt_s) {
  const Pose2 X_odom_base = odometry_.back().X_odom_base;
  const Pose2 target = X_map_odom_ * X_odom_base;
  const Pose2 current = X_map_odom_control_ * X_odom_base;
  const Eigen::Vector3d error = difference(target, current);
  const double distance = error.head<2>().norm();
  const double reach = config_.correction_rate_mps * dt_s;
  const double turn = config_.correction_rate_deg_s * kDeg * dt_s;
  const double part = distance > reach ? reach / distance : 1.0;
  const Pose2 moved{current.x_m + part * error.x(), current.y_m + part * error.y(),
                    wrapAngle(current.yaw_rad + std::clamp(error.z(), -turn, turn))};
  X_map_odom_control_ = moved * inverse(X_odom_base);
}

std::optional<Pose2> PoseTracker::odometryAt(Stamp t) const {
  if (odometry_.empty() || t < odometry_.front().stamp) return std::nullopt;
  const auto after =
      std::lower_bound(odometry_.begin(), odometry_.end(), t,
                       [](const OdometrySample& sample, Stamp at) { return sample.stamp < at; });
  if (after == odometry_.end()) return odometry_.back().X_odom_base;
  if (after == odometry_.begin()) return after->X_odom_base;
  const OdometrySample& before = *std::prev(after);
  const double s = toSeconds(t - before.stamp) / toSeconds(after->stamp - before.stamp);
  const Eigen::Vector3d step = difference(after->X_odom_base, before.X_odom_base);
  return Pose2{before.X_odom_base.x_m + s * step.x(), before.X_odom_base.y_m + s * step.y(),
               wrapAngle(before.X_odom_base.yaw_rad + s * step.z())};
}

std::optional<AlignmentPrior> PoseTracker::priorAt(Stamp t) const {
  const auto X_odom_base = odometryAt(t);
  if (!X_odom_base) return std::nullopt;
  if (config_.odometry_only) return std::nullopt;
  const Pose2 X_map_base = X_map_odom_ * *X_odom_base;
  return AlignmentPrior{t,
                        *X_odom_base,
                        X_map_base,
                        onGround(X_map_base),
                        !has_fix_ || rejected_in_a_row_ >= config_.search_after_rejections,
                        epoch_};
}

/// The base on the plane that it stands on: its yaw, that plane's tilt.
Eigen::Isometry3d PoseTracker::onGround(const Pose2& X_map_base) const {
  const Eigen::Vector2d step(X_map_base.x_m - ground_point_.x(),
                             X_map_base.y_m - ground_point_.y());
  const double z_m = ground_point_.z() - ground_normal_.head<2>().dot(step) / ground_normal_.z();
  const Eigen::Vector3d heading(std::cos(X_map_base.yaw_rad), std::sin(X_map_base.yaw_rad), 0.0);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(X_map_base.x_m, X_map_base.y_m, z_m);
  // Forward lies in the plane, above the heading.
  const Eigen::Vector3d forward =
      (heading - Eigen::Vector3d::UnitZ() * ground_normal_.dot(heading) / ground_normal_.z())
          .normalized();
  X.linear().col(0) = forward;
  X.linear().col(2) = ground_normal_;
  X.linear().col(1) = ground_normal_.cross(forward);
  return X;
}

bool PoseTracker::addFix(const AlignmentPrior& prior, const ScanMatch& match) {
  if (prior.epoch != epoch_) return false;
  const Pose2 X_map_base = projectToGround(match.X_map_base);
  const Eigen::Matrix3d match_covariance = planar(match.covariance);
  // The error of X_map_odom does not change while a scan is being aligned, so the fix is applied
  // where it was taken.
  const Pose2 predicted = X_map_odom_ * prior.X_odom_base;
  const Eigen::Vector3d innovation = difference(X_map_base, predicted);
  const Eigen::Matrix3d S = covariance_ + match_covariance;
  const Eigen::Matrix3d S_inverse = S.inverse();
  const double mahalanobis_squared = innovation.dot(S_inverse * innovation);
  const bool plausible =
      innovation.allFinite() && mahalanobis_squared <= squared(config_.gate_sigmas);
  // What a wide search found replaces a belief that has failed; anything else must agree with it.
  if (!plausible && !prior.search) {
    last_failure_ = fmt::format("the scan says {:.2f} m and {:.1f} deg elsewhere",
                                innovation.head<2>().norm(), std::abs(innovation.z()) / kDeg);
    ++rejected_;
    ++rejected_in_a_row_;
    return false;
  }
  if (!innovation.allFinite()) return false;
  if (!plausible && has_fix_ && match.inlier_fraction < config_.carried_inlier_fraction) {
    addFailure(prior, fmt::format("where the scan fits best the map explains {:.0f} % of it",
                                  100.0 * match.inlier_fraction));
    return false;
  }
  const bool lost = !has_fix_ || carried_ || rejected_in_a_row_ >= config_.lost_after_rejections;
  const double off_m = innovation.head<2>().norm(), off_rad = std::abs(innovation.z());
  if (!plausible && !lost && (off_m > config_.carried_m || off_rad > config_.carried_deg * kDeg)) {
    carried_ = true;
    last_failure_ =
        fmt::format("the scan says {:.2f} m and {:.1f} deg elsewhere", off_m, off_rad / kDeg);
    ++rejected_;
    ++rejected_in_a_row_;
    return false;
  }
  if (plausible) {
    const Eigen::Matrix3d K = covariance_ * S_inverse;
    const Eigen::Vector3d delta = K * innovation;
    const Pose2 corrected{predicted.x_m + delta.x(), predicted.y_m + delta.y(),
                          wrapAngle(predicted.yaw_rad + delta.z())};
    X_map_odom_ = corrected * inverse(prior.X_odom_base);
    const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - K;
    covariance_ = rest * covariance_ * rest.transpose() + K * match_covariance * K.transpose();
  } else {
    X_map_odom_ = X_map_base * inverse(prior.X_odom_base);
    covariance_ = match_covariance;
  }
  // Nothing moves by the old belief: there was none, or the robot stands because it is lost.
  if (lost) X_map_odom_control_ = X_map_odom_;
  ground_point_ = match.X_map_base.translation();
  ground_normal_ = match.X_map_base.linear().col(2);
  inlier_fraction_ = match.inlier_fraction;
  observable_directions_ = match.observable_directions;
  last_failure_.clear();
  has_fix_ = true;
  last_fix_ = prior.stamp;
  distance_since_fix_m_ = 0.0;
  rejected_in_a_row_ = 0;
  carried_ = false;
  ++fixes_;
  return true;
}

void PoseTracker::addFailure(const AlignmentPrior& prior, const std::string& why) {
  if (prior.epoch != epoch_) return;
  last_failure_ = why;
  ++rejected_;
  ++rejected_in_a_row_;
}

TrackedPose PoseTracker::pose(Stamp now) const {
  TrackedPose out;
  out.stamp = odometry_.empty() ? now : odometry_.back().stamp;
  out.X_map_odom = X_map_odom_control_;
  out.X_map_base =
      odometry_.empty() ? X_map_base_reset_ : X_map_odom_control_ * odometry_.back().X_odom_base;
  out.age_s = has_fix_ ? toSeconds(now - last_fix_) : -1.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> position(covariance_.topLeftCorner<2, 2>());
  out.sigma_m = std::sqrt(std::max(0.0, position.eigenvalues().maxCoeff()));
  out.sigma_yaw_rad = std::sqrt(covariance_(2, 2));
  out.distance_since_fix_m = distance_since_fix_m_;
  out.fixes = fixes_;
  out.rejected = rejected_;
  out.covariance = covariance_;
  out.inlier_fraction = inlier_fraction_;
  out.observable_directions = observable_directions_;
  out.X_map_base_3d = onGround(out.X_map_base);
  out.health = health(out, out.reason);
  return out;
}

PoseHealth PoseTracker::health(const TrackedPose& pose, std::string& reason) const {
  if (config_.odometry_only) return PoseHealth::Good;
  const auto because = [&](std::string what) {
    reason = last_failure_.empty() ? std::move(what)
                                   : fmt::format("{}: {}", std::move(what), last_failure_);
  };
  if (!has_fix_) {
    because("no scan matched yet");
  } else if (carried_) {
    because("the robot was carried, or its wheels slipped");
  } else if (rejected_in_a_row_ >= config_.lost_after_rejections) {
    because(fmt::format("{} scans in a row did not match", rejected_in_a_row_));
  } else if (pose.age_s > config_.lost_age_s) {
    because(fmt::format("no scan matched for {:.0f} s", pose.age_s));
  } else if (pose.distance_since_fix_m > config_.lost_distance_m) {
    because(fmt::format("drove {:.1f} m on odometry alone", pose.distance_since_fix_m));
  } else if (pose.sigma_m > config_.lost_sigma_m) {
    because(fmt::format("position known to {:.2f} m only", pose.sigma_m));
  } else if (pose.age_s > config_.good_age_s) {
    because(fmt::format("on odometry for {:.1f} s", pose.age_s));
    return PoseHealth::Degraded;
  } else if (pose.sigma_m > config_.good_sigma_m) {
    because(fmt::format("position known to {:.2f} m", pose.sigma_m));
    return PoseHealth::Degraded;
  } else {
    return PoseHealth::Good;
  }
  return PoseHealth::Lost;
}

}  // namespace kiln

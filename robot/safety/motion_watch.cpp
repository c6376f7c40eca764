#include "robot/safety/motion_watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln {
namespace {

bool isFinite(const Twist2& t) { return std::isfinite(t.vx_mps + t.vy_mps + t.wz_radps); }
bool isFinite(const Pose2& p) { return std::isfinite(p.x_m + p.y_m + p.yaw_rad); }

double speedOf(const Twist2& t) { return std::hypot(t.vx_mps, t.vy_mps); }

/// How far `v` lies outside the interval [low, high].
double outside(double v, double low, double high) {
  return v < low ? low - v : v > high ? v - high : 0.0;
}

}  // namespace

void MotionWatch::Config::visit(ConfigArchive& a) {
  a.field("lag_s", lag_s, "s", 0, 3, "the wheels may follow a command within this time");
  a.field("speed_tolerance_mps", speed_tolerance_mps, "m/s", 0.02, 4, "wheels against command");
  a.field("yaw_tolerance_radps", yaw_tolerance_radps, "rad/s", 0.02, 4, "wheels against command");
  a.field("share", share, "", 0, 2, "or so much of the commanded speed, whichever is more");
  a.field("hold_s", hold_s, "s", 0, 5, "a disagreement counts after this long");
  a.field("window_s", window_s, "s", 0.2, 20, "wheels against localisation over this time");
  a.field("way_tolerance_m", way_tolerance_m, "m", 0.05, 5, "wheels against localisation");
  a.field("way_share", way_share, "", 0, 2, "and so much of the way");
  a.field("turn_tolerance_deg", turn_tolerance_deg, "deg", 1, 90, "wheels against localisation");
  a.field("way_hold_s", way_hold_s, "s", 0, 20,
          "wheels against localisation counts after this long; a drive that is stuck ends before");
}

void MotionWatch::restart() {
  samples_.clear();
  disagree_since_.reset();
  slips_since_.reset();
}

/// Each component must lie between the least and the greatest command of the last lag_s: a base
/// that only lags is never blamed.
std::string MotionWatch::wheelsAgainstCommand(const Input& input) {
  Twist2 low = input.commanded, high = input.commanded;
  for (const Sample& sample : samples_) {
    if (toSeconds(input.stamp - sample.stamp) > config_.lag_s) continue;
    const Twist2& c = sample.commanded;
    low = {std::min(low.vx_mps, c.vx_mps), std::min(low.vy_mps, c.vy_mps),
           std::min(low.wz_radps, c.wz_radps)};
    high = {std::max(high.vx_mps, c.vx_mps), std::max(high.vy_mps, c.vy_mps),
            std::max(high.wz_radps, c.wz_radps)};
  }
  const double speed = std::max(speedOf(low), speedOf(high));
  const double off = std::hypot(outside(input.measured.vx_mps, low.vx_mps, high.vx_mps),
                                outside(input.measured.vy_mps, low.vy_mps, high.vy_mps));
  const double turn = outside(input.measured.wz_radps, low.wz_radps, high.wz_radps);
  const double rate = std::max(std::abs(low.wz_radps), std::abs(high.wz_radps));
  const bool drives = off > std::max(config_.speed_tolerance_mps, config_.share * speed);
  const bool turns = turn > std::max(config_.yaw_tolerance_radps, config_.share * rate);
  if (!lasts(disagree_since_, drives || turns, config_.hold_s, input.stamp)) return {};
  return drives ? fmt::format("the base moves at {:.2f} m/s where {:.2f} m/s are commanded",
                              speedOf(input.measured), speedOf(input.commanded))
                : fmt::format("the base turns at {:.2f} rad/s where {:.2f} rad/s are commanded",
                              input.measured.wz_radps, input.commanded.wz_radps);
}

std::string MotionWatch::wheelsAgainstLocalisation(const Input& input) const {
  if (samples_.empty() || !input.X_map_base) return {};
  const Sample& begin = samples_.front();
  if (!begin.X_map_base || toSeconds(input.stamp - begin.stamp) < 0.9 * config_.window_s) return {};
  double way = 0.0;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (!samples_[i].X_map_base) return {};
    way += std::hypot(samples_[i].X_odom_base.x_m - samples_[i - 1].X_odom_base.x_m,
                      samples_[i].X_odom_base.y_m - samples_[i - 1].X_odom_base.y_m);
  }
  const Pose2 by_wheels = inverse(begin.X_odom_base) * input.X_odom_base;
  const Pose2 by_map = inverse(*begin.X_map_base) * *input.X_map_base;
  const double off = std::hypot(by_wheels.x_m - by_map.x_m, by_wheels.y_m - by_map.y_m);
  const double turn = std::abs(wrapAngle(by_wheels.yaw_rad - by_map.yaw_rad));
  if (off > config_.way_tolerance_m + config_.way_share * way)
    return fmt::format(
        "in {:.1f} s the wheels went {:.2f} m and localisation {:.2f} m: they slip, "
        "or the position is wrong",
        toSeconds(input.stamp - begin.stamp), std::hypot(by_wheels.x_m, by_wheels.y_m),
        std::hypot(by_map.x_m, by_map.y_m));
  if (turn > config_.turn_tolerance_deg * kDeg)
    return fmt::format(
        "in {:.1f} s the wheels turned {:.0f} deg and localisation {:.0f} deg: they "
        "slip, or the position is wrong",
        toSeconds(input.stamp - begin.stamp), by_wheels.yaw_rad / kDeg, by_map.yaw_rad / kDeg);
  return {};
}

/// Notes since when something is so. @return whether that is `hold_s` ago.
bool MotionWatch::lasts(std::optional<Stamp>& since, bool now_so, double hold_s, Stamp now) {
  if (!now_so)
    since.reset();
  else if (!since)
    since = now;
  return since && toSeconds(now - *since) >= hold_s;
}

std::string MotionWatch::step(const Input& input) {
  if (!isFinite(input.measured) || !isFinite(input.commanded) || !isFinite(input.X_odom_base) ||
      (input.X_map_base && !isFinite(*input.X_map_base)))
    return "the motion of the base is not a number";
  if (!samples_.empty() && input.stamp < samples_.back().stamp) restart();
  std::string wrong = wheelsAgainstCommand(input);
  const std::string slips = wheelsAgainstLocalisation(input);
  if (lasts(slips_since_, !slips.empty(), config_.way_hold_s, input.stamp) && wrong.empty())
    wrong = slips;
  samples_.push_back({input.stamp, input.commanded, input.X_odom_base, input.X_map_base});
  while (toSeconds(input.stamp - samples_.front().stamp) >
         std::max(config_.window_s, config_.lag_s))
    samples_.pop_front();
  return wrong;
}

}  // namespace kiln

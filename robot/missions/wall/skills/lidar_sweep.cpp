#include "robot/missions/wall/skills/lidar_sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/core/check.h"
#include "common/core/units.h"

namespace kiln {

void LidarSweep::Config::visit(ConfigArchive& a) {
  a.field("scan_period_s", scan_period_s, "s", 0.02, 1, "of the LiDAR");
  a.field("min_share", min_share, "", 0.1, 1, "of the scans that the motion has time for");
  a.field("wait_s", wait_s, "s", 0.1, 5, "for the last scans, after the arm has stopped");
  a.field("max_gather_s", max_gather_s, "s", 0.5, 60, "from the first scan to the last one's end");
  a.field("max_base_m", max_base_m, "m", 0, 0.1, "the base may move by no more meanwhile");
  a.field("max_base_deg", max_base_deg, "deg", 0, 5, "and turn by no more");
}

std::string SweepCloud::text() const {
  return fmt::format(
      "{} scans in {:.1f} s, {} points, tilt {:.1f} to {:.1f} deg, a line each {:.2f} deg", scans,
      toSeconds(end - begin), sweep.size(), coverage.tilt_from_deg, coverage.tilt_to_deg,
      coverage.line_gap_deg);
}

LidarSweep::LidarSweep(const Config& config, ArmMotion& arm, Scans scans)
    : config_(config), arm_(arm), scans_(std::move(scans)) {}

void LidarSweep::start(const SweepMotion& motion, Stamp now) {
  motion_ = motion;
  cloud_ = {};
  ahead_.clear();
  last_.reset();
  stage_ = Stage::Approach;
  arm_.startJoints(motion_.q_from, now);
}

SkillStatus LidarSweep::poll(Stamp now) {
  if (stage_ == Stage::Idle) return {};
  if (stage_ == Stage::Done || stage_ == Stage::Failed) return ended_;
  SkillStatus arm;
  if (stage_ != Stage::Wait) {
    arm = arm_.poll(now);
    if (arm.phase == SkillPhase::Failed)
      return fail(arm.failure_code, (stage_ == Stage::Tilt ? "the arm stopped during the sweep: "
                                                           : "the sweep's beginning: ") +
                                        arm.text);
  }
  if (stage_ == Stage::Approach) {
    if (arm.phase != SkillPhase::Done)
      return {SkillPhase::Running, 0.0, "moving to where the sweep begins", {}};
    stage_ = Stage::Tilt;
    tilt_began_ = now;
    arm_.startTimed(motion_.q_to, motion_.duration_s, now);
    return {SkillPhase::Running, 0.0, "sweeping", {}};
  }
  if (stage_ == Stage::Tilt && arm.phase == SkillPhase::Done) {
    stage_ = Stage::Wait;
    tilt_ended_ = now;
  }
  if (!gather()) {
    arm_.cancel();
    return fail("base_moved", movedText());
  }
  if (stage_ == Stage::Tilt)
    return {SkillPhase::Running, arm.progress, fmt::format("sweeping, {} scans", cloud_.scans), {}};
  // All have come when one is there that began after the motion.
  const bool complete = last_ && *last_ >= tilt_ended_;
  if (!complete && now - tilt_ended_ < fromSeconds(config_.wait_s))
    return {SkillPhase::Running, 1.0, "waiting for the last scans", {}};
  return finish();
}

bool LidarSweep::gather() {
  for (const ScanWindow::Entry& entry : scans_()) {
    const Stamp stamp = entry.scan_base->stamp;
    if (stamp < tilt_began_ || (last_ && stamp <= *last_)) continue;
    if (cloud_.scans > 0) {
      const Pose2 moved = inverse(X_odom_first_) * entry.X_odom_base;
      const auto far = [](const Pose2& X) {
        return std::hypot(X.x_m, X.y_m) + std::abs(X.yaw_rad);
      };
      if (far(moved) > far(cloud_.base_moved)) cloud_.base_moved = moved;
      if (std::hypot(moved.x_m, moved.y_m) > config_.max_base_m ||
          std::abs(moved.yaw_rad) > config_.max_base_deg * kDeg)
        return false;
    }
    last_ = stamp;
    const bool ended = stage_ == Stage::Wait && stamp >= tilt_ended_;
    const bool late =
        cloud_.scans > 0 && stamp + fromSeconds(config_.scan_period_s) - cloud_.begin >
                                fromSeconds(config_.max_gather_s);
    if (!ended && !late && entry.lidar_track) take(entry);
  }
  return true;
}

void LidarSweep::take(const ScanWindow::Entry& entry) {
  const Stamp stamp = entry.scan_base->stamp;
  if (cloud_.scans == 0) {
    cloud_.begin = stamp;
    X_odom_first_ = entry.X_odom_base;
  } else {
    const double periods = toSeconds(stamp - cloud_.end) / config_.scan_period_s;
    cloud_.missing += std::max(0, static_cast<int>(std::lround(periods)) - 1);
  }
  cloud_.end = stamp;
  ++cloud_.scans;
  cloud_.sweep.addPrepared(*entry.scan_base, *entry.lidar_track);
  // A turn begins at the rear.
  ahead_.push_back(entry.lidar_track->at(stamp + fromSeconds(0.5 * config_.scan_period_s)));
}

SkillStatus LidarSweep::finish() {
  const int expected =
      static_cast<int>(toSeconds(tilt_ended_ - tilt_began_) / config_.scan_period_s);
  if (cloud_.scans < 2 || cloud_.scans < config_.min_share * expected)
    return fail("too_few_scans",
                fmt::format("{} scans came during the sweep of {:.1f} s, {} expected; check the "
                            "LiDAR's cable and the load of the computer",
                            cloud_.scans, toSeconds(tilt_ended_ - tilt_began_), expected));
  cloud_.coverage = coverageOf(ahead_);
  stage_ = Stage::Done;
  ended_ = {SkillPhase::Done, 1.0, cloud_.text(), {}};
  return ended_;
}

std::string LidarSweep::movedText() const {
  const Pose2& moved = cloud_.base_moved;
  return fmt::format(
      "the base moved by {:.0f} mm and {:.2f} deg during the sweep, {:.0f} mm and {:.2f} deg are "
      "allowed; its cloud is blurred, sweep again",
      1e3 * std::hypot(moved.x_m, moved.y_m), std::abs(moved.yaw_rad) / kDeg,
      1e3 * config_.max_base_m, config_.max_base_deg);
}

SkillStatus LidarSweep::fail(std::string code, std::string text) {
  stage_ = Stage::Failed;
  ended_ = {SkillPhase::Failed, 0.0, std::move(text), std::move(code)};
  return ended_;
}

void LidarSweep::cancel() {
  if (stage_ == Stage::Approach || stage_ == Stage::Tilt) arm_.cancel();
  stage_ = Stage::Idle;
}

const SweepCloud& LidarSweep::cloud() const {
  KILN_CHECK(stage_ == Stage::Done, "no cloud: the sweep is not done");
  return cloud_;
}

}  // namespace kiln

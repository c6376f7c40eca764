#include "robot/skills/bricks/held_brick_watch.h"

#include <fmt/format.h>

namespace kiln {

void HeldBrickWatch::Config::visit(ConfigArchive& a) {
  a.field("open_s", open_s, "s", 0, 0.2, "contact switch open for so long: dropped");
  a.field("missing_share", missing_share, "", 0.1, 1, "of the weight not felt: dropped");
  a.field("missing_s", missing_s, "s", 0, 0.2, "weight missing for so long");
  a.field("force_filter_s", force_filter_s, "s", 0, 0.1, "low-pass of the weight");
  a.field("max_age_s", max_age_s, "s", 0.05, 1, "an older state of the gripper says nothing");
}

double upForce(const RobotGeometry& robot, const ArmState& arm) {
  return (robot.X_base_armbase.pose().linear() * arm.wrench_tool.head<3>()).z();
}

void HeldBrickWatch::begin(const HeldBrick& brick, Stamp now) {
  brick_ = brick;
  supported_ = false;
  up_n_ = 0.0;
  last_ = now;
  open_since_.reset();
  missing_since_.reset();
}

void HeldBrickWatch::setSupported(bool supported) {
  supported_ = supported;
  missing_since_.reset();
}

std::string HeldBrickWatch::blind(const std::optional<GripperState>& gripper, Stamp now) const {
  if (!gripper) return "the gripper has not reported yet";
  const double age_s = toSeconds(now - gripper->stamp);
  if (age_s <= config_.max_age_s) return {};
  return fmt::format("the gripper has not reported for {:.1f} s; check its link", age_s);
}

std::optional<BrickDrop> HeldBrickWatch::poll(const std::optional<GripperState>& gripper,
                                              const std::optional<ArmState>& arm, Stamp now) {
  if (!brick_) return std::nullopt;
  const double dt_s = std::max(0.0, toSeconds(now - std::exchange(last_, now)));
  std::string why;
  const auto lasts = [&](std::optional<Stamp>& since, bool sign, double for_s) {
    if (!sign) since.reset();
    if (sign && !since) since = now;
    return since && toSeconds(now - *since) >= for_s - 1e-9;
  };
  if (gripper && blind(gripper, now).empty() &&
      lasts(open_since_, !gripper->contact, config_.open_s))
    why = "the contact switch has opened";
  if (arm && arm->wrench_tool.allFinite()) {
    // What was told and is not there is felt as a force upwards.
    up_n_ += (upForce(robot_, *arm) - up_n_) * dt_s / (config_.force_filter_s + dt_s);
    const bool missing = !supported_ && up_n_ > config_.missing_share * brick_->weight_n();
    if (lasts(missing_since_, missing, config_.missing_s) && why.empty())
      why = fmt::format("{:.0f} N of its {:.0f} N are missing", up_n_, brick_->weight_n());
  }
  if (why.empty()) return std::nullopt;
  BrickDrop drop{brick_->name, now, why, {}};
  if (arm && arm->q.allFinite())
    drop.X_base_brick =
        robot_.X_base_flange(arm->q) * robot_.X_flange_tool.pose() * brick_->X_tool_brick;
  end();
  return drop;
}

}  // namespace kiln

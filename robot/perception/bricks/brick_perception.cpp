#include "robot/perception/bricks/brick_perception.h"

namespace kiln {

void BrickPerception::Config::visit(ConfigArchive& a) {
  a.field("margin_m", margin_m, "m", 0.1, 5, "around the bricks: where to look");
  a.section("preparation", preparation, "from the sweep to surface points");
  a.section("rough", rough, "the target as a whole");
  a.section("bricks", bricks, "individual bricks");
}

BrickPerception::BrickPerception(const Config& config, const Clock* clock)
    : config_(config), rough_(config.rough), bricks_(config.bricks, clock) {}

Result<BrickSight> BrickPerception::perceive(const BrickSweep& sweep, const BrickTarget& target,
                                             bool individual) {
  if (target.bricks.empty())
    return makeError(ErrorCode::InvalidInput, "no brick to look for: the target is empty");
  if (!isFinite(target.X_base_target))
    return makeError(ErrorCode::InvalidInput, "the target's expected pose is not finite");
  const auto prepared = prepareSweep(sweep, RoughPoseEstimator::region(target, config_.margin_m),
                                     config_.preparation);
  if (!prepared) return tl::make_unexpected(prepared.error());
  BrickSight out;
  out.ground = prepared->ground;
  auto rough = rough_.estimate(*prepared, target);
  if (!rough) return tl::make_unexpected(rough.error());
  out.target = *rough;
  if (!individual) return out;
  auto bricks = bricks_.estimate(*prepared, target, rough->X_level_target);
  if (!bricks) return tl::make_unexpected(bricks.error());
  out.bricks = std::move(*bricks);
  return out;
}

}  // namespace kiln

#include "robot/missions/wall/wall_plan.h"

#include <filesystem>

#include "common/config/resources.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/missions/wall/wall_config.h"
#include "robot/scene/blueprint.h"

namespace kiln {
namespace {

Result<WallLoad> planLoad(const WallConfig& config, const RobotGeometry& robot,
                          const std::vector<WallSlot>& slots, WallLeg leg) {
  const auto problem = makeLegProblem(slots, leg);
  if (!problem) return tl::make_unexpected(problem.error());
  WallLoad load;
  load.leg = leg;
  auto order = planFastestOrder(*problem, config.build_order, config.build_time);
  if (!order) return tl::make_unexpected(order.error());
  load.order = std::move(*order);
  if (auto ok = checkBuildOrder(*problem, config.build_order, load.order, LayerRule::OneRun); !ok)
    return tl::make_unexpected(ok.error());
  std::vector<BrickKind> kinds;
  for (const BuildPosition& position : load.order.positions)
    for (const std::size_t slot : position.slots) {
      load.slots.push_back(slot);
      kinds.push_back(slots[slot].kind);
    }
  const StorageRoom room = StorageRoom::of(robot);
  auto storage = planStorage(room, config.storage, kinds);
  if (!storage) return tl::make_unexpected(storage.error());
  load.storage = std::move(*storage);
  if (auto ok = checkStoragePlan(room, config.storage, load.storage); !ok)
    return tl::make_unexpected(ok.error());
  load.expected_s = expectedTime(*problem, load.order, config.build_time);
  return load;
}

}  // namespace

Result<WallPlan> planWall(const WallConfig& config, const RobotGeometry& robot) {
  std::string path = config.blueprint;
  if (!std::filesystem::exists(path)) {
    auto shipped = resourcePath(config.blueprint);
    if (!shipped) return tl::make_unexpected(shipped.error());
    path = *shipped;
  }
  auto blueprint = loadBlueprint(path, {config.mirrored, config.bottom_first});
  if (!blueprint) return tl::make_unexpected(blueprint.error());
  WallPlan plan;
  plan.blueprint = std::move(*blueprint);
  plan.slots = wallSlots(plan.blueprint);
  std::vector<WallLeg> legs{WallLeg::Mixed};
  if (plan.blueprint.orange_leg) legs.insert(legs.begin(), WallLeg::Orange);
  for (const WallLeg leg : legs) {
    auto load = planLoad(config, robot, plan.slots, leg);
    if (!load)
      return makeError(load.error().code, "{} cannot be built as configured: {}", path,
                       load.error().message);
    plan.loads.push_back(std::move(*load));
  }
  return plan;
}

}  // namespace kiln

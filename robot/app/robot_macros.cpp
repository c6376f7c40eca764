#include "robot/app/robot_macros.h"

#include <filesystem>
#include <utility>

#include "common/config/resources.h"

namespace kiln {

Result<std::vector<Macro>> robotMacros(const RobotGeometry& robot, MoveArm& arm,
                                       const MacroConfig& config, const Mission& mission,
                                       const std::string& mission_name) {
  const auto folder = resourcePath("macros");
  if (!folder) return tl::make_unexpected(folder.error());
  std::vector<std::string> folders{*folder};
  const std::string of_mission = *folder + "/" + mission_name;
  if (std::filesystem::is_directory(of_mission)) folders.push_back(of_mission);
  MacroStepKinds kinds = robotMacroSteps({robot, robot.X_flange_nozzle.pose(), arm, config});
  for (MacroStepKind& kind : mission.macroSteps(config)) kinds.push_back(std::move(kind));
  return loadMacros(folders, kinds);
}

}  // namespace kiln

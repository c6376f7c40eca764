#include "robot/app/operator_desk.h"

#include <filesystem>
#include <utility>

#include "common/config/resources.h"
#include "robot/app/run_recorder.h"

namespace kiln {

Result<void> OperatorDesk::open(Hooks hooks) {
  auto macros = readMacros();
  if (!macros) return tl::make_unexpected(macros.error());
  macros_.emplace(MacroRunner::Parts{body_.pose,
                                     [this](const std::string& place) {
                                       return mission_.mission().workPose(place);
                                     },
                                     [this] { return authority_.epoch().value(); }},
                  std::move(*macros));
  RunRecorder* recorder = body_.options.recorder;
  control_.emplace(MissionControl::Parts{
      mission_.host(), authority_, teleop_, *macros_, alarms_, body_.stop, body_.devices.arm,
      body_.arm, body_.devices.arena, body_.pose, std::move(hooks.situation),
      std::move(hooks.set_pose),
      recorder ? [recorder](bool on) { recorder->set(on); } : std::function<void(bool)>()});
  return {};
}

Result<std::vector<Macro>> OperatorDesk::readMacros() const {
  const auto folder = resourcePath("macros");
  if (!folder) return tl::make_unexpected(folder.error());
  std::vector<std::string> folders{*folder};
  const std::string of_mission = *folder + "/" + body_.options.mission;
  if (std::filesystem::is_directory(of_mission)) folders.push_back(of_mission);
  const MacroConfig& config = body_.settings.macros;
  MacroStepKinds kinds =
      robotMacroSteps({body_.robot, body_.robot.X_flange_nozzle.pose(), body_.move_arm, config});
  for (MacroStepKind& kind : mission_.mission().macroSteps(config))
    kinds.push_back(std::move(kind));
  return loadMacros(folders, kinds);
}

void OperatorDesk::handleCommands(Stamp now) {
  control_->observeStop(now);
  if (!link_) return;
  const Authority::Step step =
      authority_.step(link_->takeCommands(), link_->operators(), *control_, now);
  for (const CommandAck& ack : step.acks) link_->acknowledge(ack);
  for (const std::string& event : step.events) log_.info("{}", event);
}

}  // namespace kiln

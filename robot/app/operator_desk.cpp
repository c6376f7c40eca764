#include "robot/app/operator_desk.h"

#include <utility>

#include "robot/app/robot_macros.h"
#include "robot/app/run_recorder.h"

namespace kiln {

Result<void> OperatorDesk::open(Hooks hooks) {
  auto macros = robotMacros(body_.robot, body_.move_arm, body_.settings.macros, mission_.mission(),
                            body_.options.mission);
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

void OperatorDesk::handleCommands(Stamp now) {
  control_->observeStop(now);
  if (!link_) return;
  const Authority::Step step =
      authority_.step(link_->takeCommands(), link_->operators(), *control_, now);
  for (const CommandAck& ack : step.acks) link_->acknowledge(ack);
  for (const std::string& event : step.events) log_.info("{}", event);
}

}  // namespace kiln

#pragma once

#include <string>

#include "robot/app/live_surroundings.h"
#include "robot/app/localization_settings.h"
#include "robot/app/operator_link.h"
#include "robot/app/perception_jobs.h"
#include "robot/app/preflight.h"
#include "robot/app/run_recorder.h"
#include "robot/app/teleop.h"
#include "robot/missions/catalog.h"
#include "robot/safety/authority.h"
#include "robot/safety/motion_watch.h"
#include "robot/skills/drive_to.h"
#include "robot/skills/macro_steps.h"
#include "robot/skills/move_arm.h"

namespace kiln {

/// Everything about one robot that can be configured: resources/config/robot.yaml. Each section is
/// the Config of the part that it configures, with that part's defaults.
struct RobotSettings {
  std::string name = "Bob";
  std::string geometry = "robot_model/bob.yaml";    ///< resource
  std::string arena = "config/arena_kitchen.yaml";  ///< resource
  bool flat_ground = false;                         ///< the arena without its ramp and edge
  double checkpoint_period_s = 0.2;                 ///< between actions
  double camera_rate_hz = 10.0;
  int jpeg_quality = 75;
  ArmController::Config arm;
  BaseController::Config base;
  PumpController::Config pumps;
  DriveTo::Config drive_to;
  MoveArm::Config move_arm;
  SelfFilter::Config self_filter;
  PerceptionJobs::Config perception;
  LiveSurroundings::Config surroundings;
  MotionWatch::Config motion_watch;
  LocalizationSettings localization;
  MissionConfigs missions = missionConfigs();
  Authority::Config authority;
  MacroConfig macros;
  Teleop::Config teleop;
  PreflightLimits preflight;
  OperatorLink::Config link;  ///< endpoint: of the command line; robot_name: `name`
  RunRecorder::Config recording;
  void visit(ConfigArchive& a);
};

}  // namespace kiln

#pragma once

#include "robot/missions/fire/skills/aim_solver.h"
#include "robot/missions/fire/skills/search_rectangle.h"
#include "robot/missions/fire/skills/spray_pattern.h"
#include "robot/missions/fire/skills/warming_trend.h"

namespace kiln {

struct FireDriveConfig {
  double clearance_m =
      0.35;  ///< beside the robot's circumscribed circle when a way-point is left out
  double stow_tolerance_deg = 2.0;  ///< arm counts as in its drive pose
  double time_limit_s = 120.0;      ///< for one drive
  int max_faults = 1;               ///< retries a place
  double rest_s = 1.0;              ///< before a retry
  void visit(ConfigArchive& a);
};

/// Configured against sensed, before the arm moves before a place.
struct FireCheckConfig {
  int max_looks = 3;  ///< until a place counts as misplaced or not to be seen
  double between_looks_s = 0.6;
  double look_timeout_s = 4.0;  ///< for one answer
  double wait_s = 120.0;        ///< for the operator, then the place is left out
  void visit(ConfigArchive& a);
};

struct FireSearchConfig {
  SearchConfig motion;
  WarmingConfig warming;
  int max_searches = 2;  ///< of a plate that is hot and was glimpsed, a place
  int max_rounds = 2;    ///< over all places while no fire was found
  double place_gate_m =
      0.5;  ///< an estimate farther from the configured plate is another heat source
  double image_timeout_s = 1.5;  ///< without thermal images
  double time_limit_s = 60.0;
  void visit(ConfigArchive& a);
};

struct FireAimConfig {
  AimSolverConfig solver;
  double step_m = 0.10;        ///< the paper's steps
  double max_turn_deg = 15.0;  ///< a step
  int settle_views = 3;        ///< new sightings awaited after a step
  double settle_s = 1.0;       ///< at most this long
  double lost_after_s = 2.0;   ///< of usable images without the heat source
  int max_losses = 1;          ///< searches anew a place
  double max_sigma_m = 0.03;   ///< "Estimate within 3 cm"
  double position_tolerance_m = 0.01;
  double angle_tolerance_deg = 1.0;
  double hold_tolerance_m = 0.03;  ///< the arm still counts as at its spray pose
  double hold_tolerance_deg = 5.0;
  double time_limit_s = 60.0;
  void visit(ConfigArchive& a);
};

struct FireSprayConfig {
  double litres_per_fire = 4.0;  ///< about 4 l per fire (paper, section "Challenge 3")
  double steady_share = 0.5;     ///< phase 1: first half of the water steady
  double duty = 1.0;
  double min_current_a = 1.0;  ///< "Pump draws current"
  double start_timeout_s = 3.0;
  double idle_fault_s = 1.0;         ///< pumps that stay off so long while spraying are a fault
  double off_current_a = 0.3;        ///< the pumps have stopped
  double min_start_l = 0.2;          ///< a tank with less is not started
  double delivered_share = 0.9;      ///< of the water: the place counts as extinguished
  double phase_limit_factor = 3.0;   ///< of the time that the pump model expects
  double flow_lpm = 3.2;             ///< both pumps, for that expectation
  double tank_l = 5.0;               ///< each tank when full
  double macro_check_after_s = 1.0;  ///< a pump without current by then fails a macro's step
  SprayPatternConfig pattern;
  void visit(ConfigArchive& a);
};

struct FireFaultConfig {
  double pump_rest_s = 1.5;  ///< before a retry
  int max_pump_faults = 1;   ///< retries a place
  double back_off_s = 1.0;   ///< after a contact the arm goes back so much of its way
  double arm_rest_s = 0.5;
  int max_arm_faults = 1;       ///< retries a place
  int max_blocked_in_row = 4;   ///< then the arm is given up
  double release_rest_s = 1.0;  ///< after the operator released a protective stop
  void visit(ConfigArchive& a);
};

/// How far an operator may move a place at a time: one that is off by more was configured wrongly.
struct NudgeConfig {
  double max_m = 0.5;  ///< each axis
  double max_deg = 30.0;
  void visit(ConfigArchive& a);
};

struct FireClockConfig {
  double limit_s = 900.0;   ///< 15 min
  double wrap_up_s = 30.0;  ///< before it: stop the pumps, park the arm, end
  double park_limit_s = 25.0;
  void visit(ConfigArchive& a);
};

/// Everything that can be set of the fire mission: resources/config/fire_mission.yaml.
struct FireConfig {
  FireDriveConfig drive;
  FireCheckConfig check;
  FireSearchConfig search;
  FireAimConfig aim;
  FireSprayConfig spray;
  FireFaultConfig faults;
  NudgeConfig nudge;
  FireClockConfig clock;
  void visit(ConfigArchive& a);
};

}  // namespace kiln

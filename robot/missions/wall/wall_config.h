#pragma once

#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "robot/missions/wall/marker_task.h"
#include "robot/missions/wall/pile_task.h"
#include "robot/missions/wall/sweep_look.h"
#include "robot/perception/bricks/brick_perception.h"
#include "robot/planning/build_order/build_time.h"
#include "robot/planning/storage/storage_room.h"

namespace kiln {

/// From where the pile is looked for, and how often.
struct PileLookConfig {
  double distance_m = 3.2;  ///< of the base from the middle of line 1
  double settle_s = 1.0;    ///< at rest, so that scans from there are gathered
  int max_looks = 3;        ///< in the middle, then from both ends of the pile
  void visit(ConfigArchive& a);
};

/// The bricks of the pile, each by itself.
struct BrickLookConfig {
  double wheels_m = 0.03, wheels_deg = 1.0;  ///< one sigma, of a drive since the pile was found
  double trusted = 0.7;                      ///< confidence of a brick that may be gripped
  double latency_s = 0.3;                    ///< modelled in lockstep
  void visit(ConfigArchive& a);
};

/// From where the marker is looked for, and how the head moves there.
struct MarkerLookConfig {
  double distance_m = 4.0;                   ///< of the base from the leg of the blueprint
  double pan_deg = 25.0;                     ///< the head looks to both sides by so much
  int stops = 5;                             ///< from one side to the other
  double rest_s = 0.5;                       ///< at each of them
  std::vector<double> tilt_deg{18.0, 36.0};  ///< below the horizon, one round each
  int max_looks = 3;                         ///< from places beside each other
  void visit(ConfigArchive& a);
};

/// Section `wall` of the robot's configuration.
struct WallConfig {
  std::string blueprint = "blueprints/lab.txt";  ///< resource, or the path of a file
  bool mirrored = false;
  bool bottom_first = false;
  PileLookConfig pile_look;
  BrickLookConfig brick_look;
  MarkerLookConfig marker_look;
  SweepLook::Config look;
  PileTask::Config pile;
  BrickPerception::Config bricks;
  MarkerTask::Config marker;
  BuildOrderConfig build_order;
  BuildTimeConfig build_time;
  StorageConfig storage;
  double stow_tolerance_deg = 2.0;
  double rest_s = 1.0;  ///< before a drive is tried once more
  int max_drive_faults = 2;
  double limit_s = 1500.0;  ///< mission clock
  void visit(ConfigArchive& a);
};

}  // namespace kiln

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
#include "robot/skills/bricks/move_storage.h"
#include "robot/skills/bricks/pick_brick.h"
#include "robot/skills/bricks/place_brick.h"

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
  double level_deg = 1.5;  ///< bricks that seem to lean by no more are taken as level
  double far_m = 4.5;      ///< bricks beyond that from the base are not asked for
  double trusted = 0.7;    ///< confidence of a brick that may be gripped
  double latency_s = 0.3;  ///< modelled in lockstep
  void visit(ConfigArchive& a);
};

/// How the bricks of the pile come into the storage.
struct LoadingConfig {
  /// So many of the plan's are taken; fewer than all: nothing is built; 0: nothing is touched.
  int bricks = 0;
  double look_m = 2.3;    ///< of the base's middle from the stack that it looks at
  double reach_m = 1.15;  ///< of the base's middle from the stack that it takes from
  double left_m = 0.05;   ///< and the brick so far to the left of the arm's middle
  double same_m = 0.15;   ///< nearer to its stand the base need not drive
  double same_deg = 10.0;
  /// What meets a wall of its bin is set in beside it, and turned so that its ends are so far beside:
  /// a bin has 2.5 mm to spare on each side.
  double aside_m = 0.002, most_aside_m = 0.008, askew_m = 0.0025;
  int max_tries = 25;
  double back_s = 3.0;  ///< and is drawn back by what the arm did that long
  int max_faults = 3;   ///< of pick or store in a row
  PickBrick::Config pick;
  PlaceBrick::Config store;
  MoveStorage::Config travel;
  /// A bin stands where it is known to, and how long a brick hangs below the face is not.
  LoadingConfig() {
    store.beyond_m = 0.014;
    store.early_m = 0.06;
  }
  void visit(ConfigArchive& a);
};

/// How the bricks come out of the storage and into the wall.
struct BuildingConfig {
  double distance_m = 1.05;  ///< of the base's middle from the middle of the leg that it builds
  double out_m = 0.35;       ///< what was taken from a bin is led so far before it
  double back_s = 4.0;       ///< what met something is drawn back by what the arm did that long
  int max_faults = 3;        ///< of taking out, setting or looking in a row
  PickBrick::Config take_out;
  PlaceBrick::Config set;
  /// Where it stands in its bin is known.
  BuildingConfig() {
    take_out.lift_m = 0.04;
    take_out.beyond_m = 0.01;
  }
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
  LoadingConfig loading;
  BuildingConfig building;
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

#pragma once

#include <string>

#include "common/config/config_archive.h"

namespace kiln::sim {

/// The force rule of the magnets on a brick's plate of 0.6 mm (scenario.md section 2).
struct MagnetConfig {
  double flush_n = 85.0;       ///< pull of all eight together, flush
  double half_gap_m = 0.0001;  ///< half the pull at this distance
  double shear_n = 20.0;       ///< that all eight hold sideways, flush and without a pull
  double radius_m = 0.0175;    ///< of a pole; what of it is beside the plate does not pull
  double rise_s = 0.02;        ///< time constant of the field
  double current_a = 0.35;     ///< of each, switched on
  double current_noise_a = 0.01;
  void visit(ConfigArchive& a);
};

/// Belt drives of the compartments and their own fail-safe.
struct StorageDeviceConfig {
  double compartment_kg = 8.0;  ///< without bricks
  double belt_n = 150.0;        ///< the most that a drive pushes with
  double rotor_kg = 20.0;       ///< inertia of motor and gear, at the belt
  double amperes_per_n = 0.01, idle_a = 0.1, current_noise_a = 0.02;
  double accel_mps2 = 0.2;
  double friction = 0.15;    ///< of bricks on plates: they slide down 15 deg (paper)
  double jam_s = 0.3;        ///< so long at full push without motion: blocked, and at rest
  double watchdog_s = 0.25;  ///< stops so long after the last target
  void visit(ConfigArchive& a);
};

/// What differs between the true bricks and the nominal site, and how bricks behave (scenario.md
/// sections 1, 2 and 4).
struct WallConfig {
  double site_m = 1.0, site_deg = 10.0;     ///< pile and marker, uniform, +-
  double stack_m = 0.05, stack_deg = 10.0;  ///< each stack, uniform, +-
  double brick_m = 0.01, brick_deg = 1.5;   ///< each brick on its stack, uniform, +-
  double plate_m = 0.003;                   ///< plates off-centre, uniform, +- an axis
  double friction = 0.6;                    ///< of bricks on anything
  bool freeze = true;   ///< bricks at rest far from all that moves cost no physics
  double thaw_m = 0.3;  ///< nearer than this to robot, held brick or a moving brick: awake
  double support_n = 60.0, side_n = 20.0;  ///< a planned placement presses and touches no harder
  std::string blueprint;  ///< official format, below resources/; empty: drawn by seed
  /// Beginning of the bricks of the aerial robots, one layer: distractors; none without `aerial`.
  bool aerial = false;
  double aerial_x_m = 0.0, aerial_y_m = 0.0, aerial_deg = 0.0;
  MagnetConfig magnets;
  StorageDeviceConfig storage;
  void visit(ConfigArchive& a);
};

}  // namespace kiln::sim

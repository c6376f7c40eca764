#pragma once

#include <string>
#include <vector>

#include "common/config/config_archive.h"

namespace kiln {

/// One step of a macro, as it stands in YAML. Which keys it may have depends on `do`:
///   arm     pose: park | drive, or q_deg: six joints
///   nozzle  xyz_m, yaw_deg, pitch_deg: nozzle exit in base and where it looks (pitch up positive)
///   aim     place, standoff_m: nozzle before a fire place so that the jet passes its opening
///   spray   duty, seconds, pattern: steady | hourglass, tilt_deg
///   wait    seconds
struct MacroStep {
  std::string action = "wait";
  std::string pose;
  std::vector<double> q_deg;
  std::vector<double> xyz_m{1.3, 0.0, 1.1};
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  std::string place;
  double standoff_m = 0.8;
  double duty = 1.0;
  double seconds = 1.0;
  std::string pattern = "steady";
  double tilt_deg = 2.0;  ///< hourglass: to either side
  void visit(ConfigArchive& a);
};

/// A fallback by hand: a list of steps that runs on the robot while the operator holds it.
struct Macro {
  std::string name;  ///< "spray fire 1"
  std::string doc;
  std::string place;  ///< start condition: the base stands at this place's work pose; empty = any
  double start_tolerance_m = 0.10;
  double start_tolerance_deg = 5.0;
  std::vector<MacroStep> steps;
  void visit(ConfigArchive& a);
  /// What the visitor cannot see: steps that lack something.
  [[nodiscard]] Result<void> validate(const std::string& file) const;
};

/// All *.yaml of a folder, by file name. Error with file:line for the first one that is wrong, or
/// for a name that two files share.
[[nodiscard]] Result<std::vector<Macro>> loadMacros(const std::string& folder);

}  // namespace kiln

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln {

/// When kiln-robotd is killed (SIGKILL) and started again with --resume: whichever comes first. The
/// world's trace is followed at 10 Hz while both run as fast as they can: up to 0.2 s late.
struct Kill {
  double at_s = 1e9;    ///< the world's time
  double at_x_m = 1e9;  ///< the base's true place in map
};

/// One mission in the simulator, each side in a process of its own.
struct MissionRunOptions {
  std::string programs;  ///< folder of kiln-sim and kiln-robotd; empty = beside this program
  std::string mission;   ///< empty = the first of the catalogue
  int seed = 1;
  bool lockstep = true;
  std::string world;                    ///< world file; empty = the mission's default
  std::vector<std::string> world_args;  ///< passed on to kiln-sim, e.g. --fault
  std::vector<std::string> robot_args;  ///< passed on to kiln-robotd
  double wall_limit_s = 600.0;          ///< a run that takes longer is ended and counted as failed
  bool trace = false;        ///< also collect the truth trace (10 Hz), for accuracy figures
  std::optional<Kill> kill;  ///< with `trace`
};

struct MissionRun {
  bool success = false;
  std::string report_json;      ///< deterministic: same seed, build and machine give the same bytes
  std::string robot_json;       ///< the daemon's own report, with every heat estimate
  std::string trace_jsonl;      ///< truth at 10 Hz, if asked for
  std::string checkpoint_json;  ///< the last one
  std::optional<Kill> killed;   ///< when and where it truly was
  double wall_s = 0.0;
  double simulated_s = 0.0;
  double sim_cpu_s = 0.0;
  double robot_cpu_s = 0.0;
  std::vector<double> locate_s;  ///< wall time of each scan that the robot located
  [[nodiscard]] double realTimeFactor() const { return wall_s > 0 ? simulated_s / wall_s : 0.0; }
};

/// The world without ramp and edge, for which no map is shipped.
[[nodiscard]] inline bool isFlat(const std::string& world) {
  return world.find("fire_flat") != std::string::npos;
}

/// Starts kiln-sim and kiln-robotd on private sockets, waits for both, merges what the robot says
/// of itself with what the world knows. Success = mission ended as finished, no collision, and what
/// the mission's rule asks for (evaluation.cpp).
[[nodiscard]] Result<MissionRun> runMission(const MissionRunOptions& options);

}  // namespace kiln

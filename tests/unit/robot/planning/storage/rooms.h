#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "robot/planning/storage/storage_room.h"
#include "tests/support/paths.h"

namespace kiln::testing {

inline CompartmentConfig row(const std::string& name, double x_m, double y_m) {
  CompartmentConfig config;
  config.name = name;
  config.xyz_m = {x_m, y_m, 0.665};
  return config;
}

inline BoxConfig deck(double length_m, double width_m) {
  BoxConfig box;
  box.name = "deck";
  box.center.xyz_m = {0, 0, 0.36};
  box.size_m = {length_m, width_m, 0.48};
  return box;
}

inline RobotGeometry robot(const std::string& name) {
  RobotGeometry out;
  const auto loaded = loadConfig(sourceDir() + "/resources/robot_model/" + name + ".yaml", out);
  if (!loaded) throw std::runtime_error(loaded.error().message);
  return out;
}

/// Bob with three rows behind the arm, each 6 cm beside the one before it.
inline StorageRoom bobRoom() {
  return {{row("compartment 1", 0.12, -0.06), row("compartment 2", -0.16, 0.0),
           row("compartment 3", -0.44, 0.06)},
          {deck(1.9, 1.4)}};
}

/// Mario with its only row.
inline StorageRoom marioRoom() { return {{row("compartment 1", -0.12, 0.0)}, {deck(1.08, 0.78)}}; }

}  // namespace kiln::testing

#pragma once

#include <string>
#include <vector>

#include "common/config/config_archive.h"

namespace kiln::testing {

/// One field of each kind.
struct Limits {
  double voxel_size_m = 0.05;
  int tries = 3;
  void visit(ConfigArchive& a) {
    a.field("voxel_size_m", voxel_size_m, "m", 0.01, 1.0, "edge of a cell");
    a.field("tries", tries, "", 1, 10, "before giving up");
  }
};
struct SampleConfig {
  std::string name = "Bob";
  bool enabled = true;
  std::vector<double> xyz_m{1, 2, 3};
  std::vector<double> free_m;
  Limits limits;
  std::vector<Limits> steps;
  void visit(ConfigArchive& a) {
    a.field("name", name, "for people");
    a.field("enabled", enabled, "on or off");
    a.field("xyz_m", xyz_m, "m", -10, 10, "three numbers");
    a.field("free_m", free_m, "m", -10, 10, "any number of numbers", false);
    a.section("limits", limits, "what is allowed");
    a.list("steps", steps, "one after the other");
  }
};

[[nodiscard]] inline Result<void> loadText(const std::string& text, SampleConfig& config) {
  return loadYamlText(text, "sample.yaml", {[&config](ConfigArchive& a) { config.visit(a); }});
}

}  // namespace kiln::testing

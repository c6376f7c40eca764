// The shipped map comes from its scenario: a recorded mission in the full world, scans and odometry
// alone.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/map_command.h"
#include "robot/evaluation/mission_run.h"
#include "robot/localization/surfel_map_file.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
constexpr int kSeed = 1;  // of the run that resources/maps/kitchen.map was made from
constexpr std::uintmax_t kMaxBytes = 1 << 20;

std::string shippedMap() { return sourceDir() + "/resources/maps/kitchen.map"; }

std::string recordedRun(const ScratchFolder& scratch) {
  MissionRunOptions options;
  options.programs = binaryDir() + "/bin";
  options.seed = kSeed;
  options.robot_args = {"--record", scratch.file("runs"), "--localization", "walls"};
  fs::create_directories(scratch.file("runs"));
  const auto run = runMission(options);
  EXPECT_TRUE(run.has_value()) << run.error();
  for (const auto& entry : fs::directory_iterator(scratch.file("runs"))) {
    if (entry.path().extension() == ".mcap") return entry.path().string();
  }
  return {};
}

/// Share of the finest surfels of `a` that `b` has within 2 cm along the normal.
double agreement(const SurfelMap& a, const SurfelMap& b) {
  SurfelMap::Neighbours near;
  int all = 0, same = 0;
  for (const Surfel& surfel : a.surfels(0)) {
    b.gather(0, surfel.mean, surfel.normal, near);
    ++all;
    for (int i = 0; i < near.size; ++i) {
      if (std::abs(near.surfels[i]->normal.dot(surfel.mean - near.surfels[i]->mean)) < 0.02F) {
        ++same;
        break;
      }
    }
  }
  return all > 0 ? static_cast<double>(same) / all : 0.0;
}

TEST(ShippedMap, ComesFromItsScenarioAndFitsIntoAMebibyte) {
  const auto shipped = loadMap(shippedMap());
  ASSERT_TRUE(shipped.has_value()) << shipped.error();
  EXPECT_LE(fs::file_size(shippedMap()), kMaxBytes);
  const ScratchFolder scratch("map");
  MapCommandOptions options;
  options.recordings = {recordedRun(scratch)};
  ASSERT_FALSE(options.recordings[0].empty());
  options.out = scratch.file("kitchen.map");
  const auto report = makeMap(options);
  ASSERT_TRUE(report.has_value()) << report.error();
  const auto made = loadMap(options.out);
  ASSERT_TRUE(made.has_value()) << made.error();
  for (const char* name : {"outdoor", "indoor"}) {
    ASSERT_NE(shipped->find(name), nullptr) << name;
    ASSERT_NE(made->find(name), nullptr) << name;
    // Not the same bytes: another compiler rounds otherwise.
    EXPECT_GT(agreement(*made->find(name), *shipped->find(name)), 0.95) << name << "\n" << *report;
    EXPECT_GT(agreement(*shipped->find(name), *made->find(name)), 0.95) << name << "\n" << *report;
  }
}

}  // namespace
}  // namespace kiln

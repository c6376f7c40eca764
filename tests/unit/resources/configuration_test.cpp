#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "common/config/config_archive.h"
#include "robot/app/robot_settings.h"
#include "robot/missions/fire/skills/spray_calibration.h"
#include "robot/scene/fire_site_map.h"
#include "robot/scene/wall_site_map.h"
#include "robot/sim/world_config.h"
#include "tests/support/paths.h"

/// Every YAML file that is shipped can be read by the program that it is for, and the reference of
/// all keys in the documents is the one that the structs give.
namespace kiln {
namespace {

namespace fs = std::filesystem;
const fs::path kResources = fs::path(kiln::sourceDir()) / "resources";

template <class T>
Result<void> readAs(const fs::path& path) {
  T value;
  return loadConfig(path.string(), value);
}

/// Readers by folder and beginning of the name.
const std::map<std::string, std::function<Result<void>(const fs::path&)>>& readers() {
  static const std::map<std::string, std::function<Result<void>(const fs::path&)>> kReaders{
      {"config/arena_", readAs<ArenaMap>},
      {"config/fire_site_", readAs<FireSiteMap>},
      {"config/wall_site_", readAs<WallSiteMap>},
      {"config/robot", readAs<RobotSettings>},
      {"config/spray_calibration", readAs<SprayCalibration>},
      {"robot_model/", readAs<RobotGeometry>},
      {"worlds/",
       [](const fs::path& path) -> Result<void> {
         auto world = sim::WorldConfig::load(path.string());
         if (!world) return tl::make_unexpected(world.error());
         return {};
       }},
      // Their kinds of steps come from parts of the robot: the test ShippedMacros reads and runs
      // all.
      {"macros/", [](const fs::path&) { return Result<void>{}; }},
  };
  return kReaders;
}

TEST(ShippedYaml, EveryFileIsReadByItsProgram) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kResources)) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    const std::string relative = fs::relative(entry.path(), kResources).generic_string();
    bool known = false;
    for (const auto& [beginning, read] : readers()) {
      if (relative.rfind(beginning, 0) != 0) continue;
      known = true;
      const auto result = read(entry.path());
      EXPECT_TRUE(result.has_value()) << relative << ": " << result.error();
    }
    EXPECT_TRUE(known) << relative << " is read by nobody: add its reader here, or remove it";
  }
  EXPECT_GE(files, 5);
}

template <class T>
std::string sectionFor(const std::string& title, const std::string& file) {
  T defaults;
  return "\n## " + title + "\n\n`" + file + "`\n\n" +
         referenceTable({[&](ConfigArchive& a) { defaults.visit(a); }});
}

TEST(ConfigurationReference, IsWhatTheStructsSay) {
  const std::string expected =
      "# Configuration\n\nEvery key that can stand in a file of `resources/`, with its default. A "
      "key that is missing "
      "keeps its default; an\nunknown key or a value out of range is refused with file and line. "
      "This page is made from "
      "the code:\n`KILN_UPDATE_DOCS=1 build/tests/resources_test`.\n" +
      sectionFor<RobotSettings>("Robot", "resources/config/robot.yaml") +
      sectionFor<ArenaMap>("Arena", "resources/config/arena_kitchen.yaml") +
      sectionFor<FireSiteMap>("Fire places", "resources/config/fire_site_kitchen.yaml") +
      sectionFor<WallSiteMap>("Site of the wall", "resources/config/wall_site_arena.yaml") +
      sectionFor<RobotGeometry>("Geometry of the robot", "resources/robot_model/bob.yaml") +
      sectionFor<sim::WorldConfig>("World", "resources/worlds/fire.yaml");
  const fs::path page = kResources / "docs/configuration.md";
  if (std::getenv("KILN_UPDATE_DOCS") != nullptr) std::ofstream(page) << expected;
  std::ifstream in(page);
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_TRUE(text.str() == expected) << "resources/docs/configuration.md is old; run "
                                         "KILN_UPDATE_DOCS=1 build/tests/resources_test";
}

}  // namespace
}  // namespace kiln

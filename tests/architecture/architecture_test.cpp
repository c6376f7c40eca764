#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/include_rules.h"
#include "tests/support/paths.h"

namespace kiln::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path);
  EXPECT_TRUE(in.good()) << path;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

class ArchitectureTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto table = RoomTable::parse(read(root_ / "tests/architecture/rooms.txt"));
    ASSERT_TRUE(table.has_value()) << table.error();
    table_ = *table;
  }
  [[nodiscard]] std::vector<std::string> check(const std::string& path,
                                               const std::string& text) const {
    return violations(table_, path, text);
  }
  const std::filesystem::path root_ = kiln::sourceDir();
  RoomTable table_;
};

TEST_F(ArchitectureTest, TheTreeKeepsToTheTable) {
  for (const std::string& violation : violationsBelow(table_, root_)) ADD_FAILURE() << violation;
}

TEST_F(ArchitectureTest, TheTableKeepsTheWallsThatMatterMost) {
  for (const auto& [room, allowed] : table_.allowed) {
    EXPECT_EQ(allowed.count("robot/sim"), 0U) << room << ": the truth lives in another process";
    for (const std::string& other : allowed) {
      const bool crosses =
          (startsWith(room, "gui/") && startsWith(other, "robot/")) ||
          (startsWith(room, "robot/") && startsWith(other, "gui/")) ||
          (startsWith(room, "common/") && !startsWith(other, "common/") && other != "proto");
      EXPECT_FALSE(crosses) << room << " -> " << other;
    }
  }
  for (const char* room :
       {"robot/perception", "robot/planning", "robot/control", "robot/missions"}) {
    for (const char* device : {"robot/drivers", "robot/sim_link", "common/transport"})
      EXPECT_EQ(table_.allowed.at(room).count(device), 0U) << room << " -> " << device;
  }
  // A mission writes its own details; what it works with knows no bytes.
  for (const char* room : {"robot/perception", "robot/planning", "robot/control"})
    EXPECT_EQ(table_.allowed.at(room).count("common/wire"), 0U) << room;
}

TEST_F(ArchitectureTest, ReportsForbiddenFilesOfATree) {
  const auto tree = std::filesystem::path(::testing::TempDir()) / "kiln_architecture_test";
  std::filesystem::create_directories(tree / "robot/planning");
  std::filesystem::create_directories(tree / "gui/views/scene3d");
  std::ofstream(tree / "robot/planning/path.cpp")
      << "#include <vector>\n\n#include \"robot/drivers/ur/codec.h\"\n";
  std::ofstream(tree / "gui/views/scene3d/view.h") << "#include \"robot/scene/arena_map.h\"\n";
  std::ofstream(tree / "gui/views/scene3d/notes.txt") << "#include \"robot/scene/arena_map.h\"\n";
  const auto found = violationsBelow(table_, tree);
  std::filesystem::remove_all(tree);
  EXPECT_THAT(
      found, ElementsAre("gui/views/scene3d/view.h:1: gui/views may not include robot/scene: "
                         "#include \"robot/scene/arena_map.h\"",
                         "robot/planning/path.cpp:3: robot/planning may not include robot/drivers: "
                         "#include \"robot/drivers/ur/codec.h\""));
}

TEST_F(ArchitectureTest, AllowsWhatTheTableAllowsAlsoThroughOthers) {
  EXPECT_THAT(check("robot/missions/fire/aim.cpp",
                    "#include <cmath>\n#include <Eigen/Core>\n#include \"common/core/stamp.h\"\n"
                    "#include \"robot/control/arm_controller.h\"\n"),
              IsEmpty());
  EXPECT_THAT(check("common/wire/sensor.cpp", "#include \"kiln/v1/sensor.pb.h\"\n"), IsEmpty());
  EXPECT_THAT(check("gui/views/scene3d/view.cpp", "#include <QWidget>\n#include <vtkActor.h>\n"),
              IsEmpty());
}

TEST_F(ArchitectureTest, RefusesHeavyHeadersInHeadersOnly) {
  for (const char* include :
       {"<pcl/point_types.h>", "<ceres/ceres.h>", "<vtkActor.h>", "<QVTKOpenGLNativeWidget.h>",
        "<embree3/rtcore.h>", "<mujoco/mujoco.h>", "<opencv2/core.hpp>", "<zmq.hpp>",
        "<yaml-cpp/yaml.h>"}) {
    const std::string text = std::string("#include ") + include + "\n";
    EXPECT_THAT(check("gui/views/thing.h", text), ElementsAre(HasSubstr("heavy header")))
        << include;
    EXPECT_THAT(check("gui/views/thing.cpp", text), IsEmpty()) << include;
  }
}

TEST_F(ArchitectureTest, RefusesQtOutsideTheStation) {
  EXPECT_THAT(check("robot/app/main.cpp", "#include <QObject>\n"),
              ElementsAre(HasSubstr("Qt outside gui/")));
  EXPECT_THAT(check("common/client/session.cpp", "#include <QtCore/QTimer>\n"),
              ElementsAre(HasSubstr("Qt outside gui/")));
}

TEST_F(ArchitectureTest, RefusesTheMachinesClockOutsideCoreAndTransport) {
  const std::string reads = "const auto t = std::chrono::steady_clock::now();\n";
  EXPECT_THAT(check("robot/control/base.cpp", reads),
              ElementsAre(HasSubstr("robot/control/base.cpp:1: reads")));
  EXPECT_THAT(
      check("gui/app/main.cpp", "using C = std::chrono::system_clock;\nauto t = C::now ( );\n"),
      ElementsAre(HasSubstr(":2: reads")));
  EXPECT_THAT(check("common/core/clock.cpp", reads), IsEmpty());
  EXPECT_THAT(check("common/transport/heartbeat.cpp", reads), IsEmpty());
  EXPECT_THAT(check("robot/fsm/state.cpp",
                    "Stamp AnyState::now() const {\nreturn clock_.now();\n// C::now()\n"),
              IsEmpty());
}

TEST_F(ArchitectureTest, RefusesUnknownRoomsTestsAndRelativePaths) {
  EXPECT_THAT(check("robot/cellar/wine.cpp", ""), ElementsAre(HasSubstr("in no room")));
  EXPECT_THAT(check("robot/app/main.cpp", "#include \"common/attic/box.h\"\n"),
              ElementsAre(HasSubstr("common/attic is in no room")));
  EXPECT_THAT(check("robot/app/main.cpp", "#include \"tests/support/data_dir.h\"\n"),
              ElementsAre(HasSubstr("may not include its tests")));
  EXPECT_THAT(check("robot/app/main.cpp", "#include \"robot.h\"\n"),
              ElementsAre(HasSubstr("start at the root")));
}

TEST(RoomTable, RefusesCirclesAndStrangers) {
  EXPECT_FALSE(RoomTable::parse("a/x: a/y\na/y: a/x\n").has_value());
  EXPECT_FALSE(RoomTable::parse("a/x: a/unknown\n").has_value());
  EXPECT_FALSE(RoomTable::parse("a/x a/y\n").has_value());
}

}  // namespace
}  // namespace kiln::architecture

#include "robot/skills/macro.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/unit/robot/skills/macro_steps_for_tests.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

class MacroFolder {
 public:
  MacroFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("kiln-macros-{}", ::getpid())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "more");
  }
  ~MacroFolder() { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }
  [[nodiscard]] Result<std::vector<Macro>> load() {
    return loadMacros({path_.string(), (path_ / "more").string()}, testSteps(robot_, arm_, light_));
  }
  [[nodiscard]] std::string errorOf(const std::string& text) {
    write("m.yaml", text);
    const auto macros = load();
    return macros ? "" : macros.error().message;
  }

 private:
  std::filesystem::path path_;
  RobotGeometry robot_;
  ScriptedArm arm_;
  bool light_ = false;
};

TEST(Macro, ReadsStepsWithTheKeysOfTheirKind) {
  MacroFolder folder;
  folder.write("a.yaml",
               "name: try\nsteps:\n  - { do: arm, pose: park }\n"
               "  - { do: light, seconds: 3, colour: red }\n");
  const auto macros = folder.load();
  ASSERT_TRUE(macros.has_value()) << macros.error();
  ASSERT_EQ(macros->size(), 1u);
  EXPECT_EQ((*macros)[0].steps[0]->text(), "arm to park");
  EXPECT_EQ((*macros)[0].steps[1]->text(), "red light");
  MacroEstimate estimate;
  (*macros)[0].steps[1]->addTo(estimate);
  EXPECT_EQ(estimate.duration_s, 3.0);
}

TEST(Macro, ErrorsNameFileLineAndTheNearestWord) {
  MacroFolder folder;
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: armm, pose: park }\n"),
              HasSubstr("m.yaml:3: 'do' is 'armm'; allowed: arm, tool, wait, light; did you mean "
                        "'arm'?"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: light, colour: red }\n"
                             "  - { do: light, color: red }\n"),
              HasSubstr("m.yaml:4: unknown key 'color'; did you mean 'colour'?"));
  EXPECT_THAT(
      folder.errorOf("name: x\nsteps:\n  - { do: wait, seconds: 1 }\n  - { do: wait, duty: 1 }\n"),
      HasSubstr("m.yaml:4: unknown key 'duty'"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: light, seconds: 500 }\n"),
              HasSubstr("m.yaml:3: 'seconds' is 500 s; allowed 0.1 to 120"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: wait, seconds: .nan }\n"),
              HasSubstr("'seconds'"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: light }\n"),
              HasSubstr("step 1: light: 'colour' is missing"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { pose: park }\n"), HasSubstr("'pose'"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - {}\n"), HasSubstr("'do' is missing"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: arm }\n"),
              HasSubstr("step 1: arm: give either"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: arm, q_deg: [1, 2] }\n"),
              HasSubstr("six angles"));
  EXPECT_THAT(folder.errorOf("name: x\n"), HasSubstr("'steps' is missing"));
  EXPECT_THAT(folder.errorOf("steps:\n  - { do: wait }\n"), HasSubstr("'name' is missing"));
}

TEST(Macro, TwoFilesOfAnyFolderCannotShareAName) {
  MacroFolder folder;
  for (const char* file : {"a.yaml", "more/b.yaml"})
    folder.write(file, "name: same\nsteps:\n  - { do: wait }\n");
  const auto macros = folder.load();
  ASSERT_FALSE(macros.has_value());
  EXPECT_THAT(macros.error().message, HasSubstr("rename one"));
}

TEST(Macro, MissingFolderIsSaid) {
  const auto macros = loadMacros({"/no/such/folder"}, {});
  ASSERT_FALSE(macros.has_value());
  EXPECT_THAT(macros.error().message, HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace kiln

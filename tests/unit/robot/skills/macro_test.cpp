#include "robot/skills/macro.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;

class MacroFolder {
 public:
  MacroFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("kiln-macros-{}", ::getpid())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~MacroFolder() { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }
  [[nodiscard]] Result<std::vector<Macro>> load() const { return loadMacros(path_.string()); }
  [[nodiscard]] std::string errorOf(const std::string& text) const {
    write("m.yaml", text);
    const auto macros = load();
    return macros ? "" : macros.error().message;
  }

 private:
  std::filesystem::path path_;
};

TEST(Macro, ReadsStepsWithTheKeysOfTheirKind) {
  const MacroFolder folder;
  folder.write("a.yaml",
               "name: try\nsteps:\n  - { do: arm, pose: park }\n"
               "  - { do: spray, seconds: 3, pattern: hourglass, tilt_deg: 4 }\n");
  const auto macros = folder.load();
  ASSERT_TRUE(macros.has_value()) << macros.error();
  ASSERT_EQ(macros->size(), 1u);
  EXPECT_EQ((*macros)[0].steps[0].pose, "park");
  EXPECT_EQ((*macros)[0].steps[1].tilt_deg, 4.0);
}

TEST(Macro, ErrorsNameFileAndLine) {
  const MacroFolder folder;
  EXPECT_THAT(
      folder.errorOf("name: x\nsteps:\n  - { do: armm, pose: park }\n"),
      HasSubstr(
          "m.yaml:3: 'do' is 'armm'; allowed: arm, nozzle, aim, spray, wait; did you mean 'arm'?"));
  EXPECT_THAT(
      folder.errorOf("name: x\nsteps:\n  - { do: wait, seconds: 1 }\n  - { do: wait, duty: 1 }\n"),
      HasSubstr("m.yaml:4: unknown key 'duty'"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: spray, seconds: 500 }\n"),
              HasSubstr("allowed 0.1 to 120"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: spray, duty: .nan }\n"),
              HasSubstr("'duty'"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: arm }\n"),
              HasSubstr("step 1 (arm): give either"));
  EXPECT_THAT(folder.errorOf("name: x\nsteps:\n  - { do: arm, q_deg: [1, 2] }\n"),
              HasSubstr("six angles"));
  EXPECT_THAT(folder.errorOf("name: x\n"), HasSubstr("'steps' is missing"));
  EXPECT_THAT(folder.errorOf("steps:\n  - { do: wait }\n"), HasSubstr("'name' is missing"));
}

TEST(Macro, TwoFilesCannotShareAName) {
  const MacroFolder folder;
  for (const char* file : {"a.yaml", "b.yaml"})
    folder.write(file, "name: same\nsteps:\n  - { do: wait }\n");
  const auto macros = folder.load();
  ASSERT_FALSE(macros.has_value());
  EXPECT_THAT(macros.error().message, HasSubstr("rename one"));
}

TEST(Macro, MissingFolderIsSaid) {
  const auto macros = loadMacros("/no/such/folder");
  ASSERT_FALSE(macros.has_value());
  EXPECT_THAT(macros.error().message, HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace kiln

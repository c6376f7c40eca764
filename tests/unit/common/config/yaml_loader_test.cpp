#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/common/config/sample_config.h"

namespace kiln {
namespace {

using ::testing::ElementsAre;
using testing::loadText;
using testing::SampleConfig;

TEST(YamlLoader, ReadsEveryKindOfFieldOverTheDefaults) {
  SampleConfig config;
  const auto loaded = loadText(R"(
name: Mario
enabled: false
xyz_m: [4, -5.5, 6e-1]
limits:
  tries: 10
steps:
  - { voxel_size_m: 0.2 }
  - { tries: 1 }
)",
                               config);
  ASSERT_TRUE(loaded.has_value()) << loaded.error();
  EXPECT_EQ(config.name, "Mario");
  EXPECT_FALSE(config.enabled);
  EXPECT_THAT(config.xyz_m, ElementsAre(4, -5.5, 0.6));
  EXPECT_EQ(config.limits.tries, 10);
  EXPECT_DOUBLE_EQ(config.limits.voxel_size_m, 0.05) << "not in the file: the default stays";
  ASSERT_EQ(config.steps.size(), 2U);
  EXPECT_DOUBLE_EQ(config.steps[0].voxel_size_m, 0.2);
  EXPECT_EQ(config.steps[1].tries, 1);
}

TEST(YamlLoader, RefusesAFileThatSaysNothing) {
  for (const char* text : {"", "\n", "# a comment\n", "---\n"}) {
    SampleConfig config;
    const auto loaded = loadText(text, config);
    ASSERT_FALSE(loaded.has_value()) << text;
    EXPECT_THAT(loaded.error().message, ::testing::HasSubstr("says nothing"));
  }
}

TEST(YamlLoader, RefusesAKeyThatStandsTwice) {
  SampleConfig config;
  const auto loaded = loadText("name: a\nenabled: true\nname: b\n", config);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, ::testing::HasSubstr(":3: key 'name' stands twice"));
}

struct BadText {
  const char* name;
  const char* text;
  const char* message;
};

class YamlLoaderRefuses : public ::testing::TestWithParam<BadText> {};

TEST_P(YamlLoaderRefuses, WithFileLineAndReason) {
  SampleConfig config;
  const auto loaded = loadText(GetParam().text, config);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_EQ(loaded.error().code, ErrorCode::InvalidInput);
  EXPECT_EQ(loaded.error().message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Texts, YamlLoaderRefuses,
    ::testing::Values(
        BadText{"MissingSuffix", "limits:\n  voxel_size: 0.1\n",
                "sample.yaml:2: unknown key 'voxel_size'; did you mean 'voxel_size_m'?"},
        BadText{"Misspelt", "enabeld: true\n",
                "sample.yaml:1: unknown key 'enabeld'; did you mean 'enabled'?"},
        BadText{"NothingNear", "name: x\ncompletely_different: 1\n",
                "sample.yaml:2: unknown key 'completely_different'"},
        BadText{"UnknownInAListItem", "steps:\n  - { tries: 1 }\n  - { trys: 1 }\n",
                "sample.yaml:3: unknown key 'trys'; did you mean 'tries'?"},
        BadText{"TooLarge", "\n\nlimits: { voxel_size_m: 7 }\n",
                "sample.yaml:3: 'voxel_size_m' is 7 m; allowed 0.01 to 1"},
        BadText{"Nan", "xyz_m: [0, .nan, 0]\n",
                "sample.yaml:1: 'xyz_m' is nan m; allowed -10 to 10"},
        BadText{"Infinite", "limits: { voxel_size_m: .inf }\n",
                "sample.yaml:1: 'voxel_size_m' is inf m; allowed 0.01 to 1"},
        BadText{"TextForNumber", "limits: { voxel_size_m: wide }\n",
                "sample.yaml:1: 'voxel_size_m' must be a number"},
        BadText{"NothingForNumber", "limits: { voxel_size_m: }\n",
                "sample.yaml:1: 'voxel_size_m' must be a number"},
        BadText{"FractionForInteger", "limits: { tries: 1.5 }\n",
                "sample.yaml:1: 'tries' must be a whole number"},
        BadText{"OverflowForInteger", "limits: { tries: 99999999999 }\n",
                "sample.yaml:1: 'tries' must be a whole number"},
        BadText{"WordForSwitch", "enabled: maybe\n",
                "sample.yaml:1: 'enabled' must be true or false"},
        BadText{"ListForText", "name: [a, b]\n", "sample.yaml:1: 'name' must be a text"},
        BadText{"WrongLength", "xyz_m: [1, 2]\n",
                "sample.yaml:1: 'xyz_m' has 2 entries; it needs 3"},
        BadText{"NumberForList", "xyz_m: 1\n", "sample.yaml:1: 'xyz_m' must be a list of numbers"},
        BadText{"MappingForList", "steps: { tries: 1 }\n", "sample.yaml:1: 'steps' must be a list"},
        BadText{"NumberForSection", "limits: 4\n",
                "sample.yaml:1: 'limits' must be a mapping of keys to values"},
        BadText{"NotAMapping", "- 1\n- 2\n", "sample.yaml:1: expected 'key: value' lines"}),
    [](const auto& sample) { return sample.param.name; });

TEST(YamlLoader, PutsALineToASyntaxError) {
  SampleConfig config;
  const auto loaded = loadText("name: x\nxyz_m: [1, 2\nenabled: true\n", config);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, ::testing::MatchesRegex("sample.yaml:[0-9]+: .+"));
}

TEST(YamlLoader, SurvivesKeysThatAreNoWords) {
  SampleConfig config;
  EXPECT_FALSE(loadText("? [a, b]\n: 1\n", config).has_value());
  EXPECT_FALSE(loadText("? {a: 1}\n: 1\n", config).has_value());
}

TEST(YamlLoader, NamesAFileThatIsNotThere) {
  SampleConfig config;
  const auto missing = loadConfig("no/such/file.yaml", config);
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
  EXPECT_THAT(missing.error().message, ::testing::HasSubstr("no/such/file.yaml"));
  EXPECT_EQ(loadConfig(std::filesystem::temp_directory_path().string(), config).error().code,
            ErrorCode::InvalidInput)
      << "a folder is no file";
}

TEST(NearestName, PrefersTheNearestAndRefusesTheFar) {
  EXPECT_EQ(nearestName("max_sped_mps", {"min_speed_mps", "max_speed_mps"}), "max_speed_mps");
  EXPECT_EQ(nearestName("q", {"completely_different"}), "");
  EXPECT_EQ(nearestName("x", {}), "");
}

}  // namespace
}  // namespace kiln

#include "common/config/resources.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(ResourcePath, FindsTheShippedFiles) {
  const auto path = resourcePath("robot_model/bob.yaml");
  ASSERT_TRUE(path.has_value()) << path.error();
  EXPECT_TRUE(std::filesystem::is_regular_file(*path));
}

TEST(ResourcePath, NamesEveryPlaceItLookedAt) {
  const auto path = resourcePath("robot_model/nobody.yaml");
  ASSERT_FALSE(path.has_value());
  EXPECT_EQ(path.error().code, ErrorCode::NotFound);
  EXPECT_THAT(path.error().message, ::testing::HasSubstr("resources/robot_model/nobody.yaml"));
  EXPECT_THAT(path.error().message, ::testing::HasSubstr("KILN_RESOURCES"));
}

TEST(ResourcePath, KilnResourcesStandsAloneWhereItIsSet) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "kiln_resources_test";
  std::filesystem::create_directories(folder / "robot_model");
  std::ofstream(folder / "robot_model/bob.yaml") << "length_m: 1\n";
  ::setenv("KILN_RESOURCES", folder.c_str(), 1);
  const auto mine = resourcePath("robot_model/bob.yaml");
  const auto missing = resourcePath("macros");
  ::unsetenv("KILN_RESOURCES");
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(mine.has_value());
  EXPECT_EQ(*mine, (folder / "robot_model/bob.yaml").string());
  ASSERT_FALSE(missing.has_value()) << "another tree's: " << *missing;
  EXPECT_THAT(missing.error().message, ::testing::HasSubstr((folder / "macros").string()));
}

}  // namespace
}  // namespace kiln

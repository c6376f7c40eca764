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

TEST(ResourcePath, LooksIntoKilnResourcesFirst) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "kiln_resources_test";
  std::filesystem::create_directories(folder / "robot_model");
  std::ofstream(folder / "robot_model/bob.yaml") << "length_m: 1\n";
  ::setenv("KILN_RESOURCES", folder.c_str(), 1);
  const auto mine = resourcePath("robot_model/bob.yaml");
  const auto shipped = resourcePath("config/arena_kitchen.yaml");
  ::unsetenv("KILN_RESOURCES");
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(mine.has_value());
  EXPECT_EQ(*mine, (folder / "robot_model/bob.yaml").string());
  EXPECT_TRUE(shipped.has_value()) << "what is not there is still found in the tree";
}

}  // namespace
}  // namespace kiln

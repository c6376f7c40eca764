#include "common/config/required_keys.h"

#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

namespace kiln {
namespace {

Result<void> check(const std::string& text) {
  const std::string path = testing::TempDir() + "/required_keys.yaml";
  std::ofstream(path) << text;
  auto out = requireKeys(path, {"geofence", "length_m"});
  std::remove(path.c_str());
  return out;
}

TEST(RequiredKeys, EachMustStandInTheFileAndSaySomething) {
  EXPECT_TRUE(check("geofence: [1]\nlength_m: 2\n").has_value());
  for (const char* text : {"{}", "length_m: 2\n", "geofence:\nlength_m: 2\n",
                           "geofence: []\nlength_m: 2\n", "- geofence\n- length_m\n"}) {
    const auto checked = check(text);
    ASSERT_FALSE(checked.has_value()) << text;
    EXPECT_NE(checked.error().message.find("required_keys.yaml: 'geofence' is missing"),
              std::string::npos)
        << checked.error();
  }
  EXPECT_FALSE(check("geofence: [1\n").has_value());
}

}  // namespace
}  // namespace kiln

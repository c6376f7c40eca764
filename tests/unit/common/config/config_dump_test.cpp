#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/common/config/sample_config.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;
using testing::loadText;
using testing::SampleConfig;

TEST(ConfigDump, LoadsBackToTheSameValues) {
  SampleConfig config;
  config.name = "a: #tricky 'text', true\n";
  config.xyz_m = {0.1 + 0.2, 1.0 / 3.0, -9.999999999999998};  // must survive to the last bit
  config.free_m = {1, 2, 3, 4};
  config.limits.tries = 9;
  config.steps.resize(2);
  config.steps[1].voxel_size_m = 0.125;
  SampleConfig back;
  const auto loaded = loadText(dumpConfig(config), back);
  ASSERT_TRUE(loaded.has_value()) << loaded.error() << "\n" << dumpConfig(config);
  EXPECT_EQ(back.name, config.name);
  EXPECT_EQ(back.xyz_m, config.xyz_m);
  EXPECT_EQ(back.free_m, config.free_m);
  EXPECT_EQ(back.limits.tries, 9);
  ASSERT_EQ(back.steps.size(), 2U);
  EXPECT_EQ(back.steps[1].voxel_size_m, 0.125);
  EXPECT_EQ(dumpConfig(back), dumpConfig(config));
}

TEST(ReferenceTable, HasARowForEachKeyWithUnitAndRange) {
  SampleConfig config;
  config.steps.resize(1);
  const std::string table = referenceTable({[&](ConfigArchive& a) { config.visit(a); }});
  EXPECT_THAT(table,
              HasSubstr("| `limits.voxel_size_m` | 0.05 | m | 0.01 to 1 | edge of a cell |"));
  EXPECT_THAT(table, HasSubstr("| `steps[].tries` | 3 |"));
  EXPECT_THAT(table, HasSubstr("| `enabled` | true |"));
}

}  // namespace
}  // namespace kiln

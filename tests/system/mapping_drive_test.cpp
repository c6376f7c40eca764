// The mapping drive, from its start to its start in the full world, and the map made of its
// recording: the loop is closed, and the map is true. The shipped map is the one of seed 1.
#include "robot/evaluation/mapping_drive.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/figures.h"
#include "robot/evaluation/map_command.h"
#include "robot/localization/surfel_map_file.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
constexpr int kSeed = 1;  // of the drive that resources/maps/kitchen.map was made from
constexpr std::uintmax_t kMaxBytes = 1 << 20;

std::string shippedMap() { return sourceDir() + "/resources/maps/kitchen.map"; }

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

/// One drive for all tests: it costs a quarter of a minute.
class MappingDriveTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>("mapping");
    auto drive = driveForMap(kSeed, scratch_->path(), binaryDir() + "/bin");
    ASSERT_TRUE(drive.has_value()) << drive.error();
    drive_ = std::make_unique<MappingDrive>(std::move(*drive));
    MapCommandOptions options;
    options.recordings = {drive_->recording};
    options.out = scratch_->file("kitchen.map");
    auto made = makeMap(options);
    ASSERT_TRUE(made.has_value()) << made.error();
    made_ = std::make_unique<MadeMap>(std::move(*made));
  }
  static void TearDownTestSuite() {
    made_.reset();
    drive_.reset();
    scratch_.reset();
  }
  void SetUp() override { ASSERT_NE(made_, nullptr) << "there is no map to look at"; }

  static inline std::unique_ptr<ScratchFolder> scratch_;
  static inline std::unique_ptr<MappingDrive> drive_;
  static inline std::unique_ptr<MadeMap> made_;
};

TEST_F(MappingDriveTest, TheLoopIsClosedAndPullsTheReturnOntoTheStart) {
  const MapReport& report = made_->built.report;
  EXPECT_GE(report.loops, 4) << made_->text;
  EXPECT_LT(report.loop.rms_m, report.loop_before.rms_m) << made_->text;
  EXPECT_LT(report.loop.rms_m, 0.005) << made_->text;
  // What there was to close: the wheels alone are far off after the round.
  EXPECT_GT(odometryErrorAtReturn(drive_->run).value_or(0.0), 0.3);
  const KeyframeErrors errors = keyframeErrors(made_->built, BaseTrace(drive_->run.trace_jsonl));
  ASSERT_GE(errors.return_m.size(), 2U) << "it came back";
  EXPECT_LT(median(errors.return_m), 0.05);
}

TEST_F(MappingDriveTest, KeyframesLieWhereTheRobotTrulyWas) {
  const KeyframeErrors errors = keyframeErrors(made_->built, BaseTrace(drive_->run.trace_jsonl));
  ASSERT_GT(errors.position_m.size(), 40U);
  EXPECT_LT(median(errors.position_m), 0.02);
  EXPECT_LT(quantile(errors.position_m, 0.95), 0.05);
  EXPECT_LT(quantile(errors.yaw_deg, 0.95), 0.5);
}

TEST_F(MappingDriveTest, TheShippedMapIsMadeOfItAndFitsIntoAMebibyte) {
  const auto shipped = loadMap(shippedMap());
  ASSERT_TRUE(shipped.has_value()) << shipped.error();
  EXPECT_LE(fs::file_size(shippedMap()), kMaxBytes);
  const auto made = loadMap(scratch_->file("kitchen.map"));
  ASSERT_TRUE(made.has_value()) << made.error();
  for (const char* name : {"outdoor", "indoor"}) {
    ASSERT_NE(shipped->find(name), nullptr) << name;
    ASSERT_NE(made->find(name), nullptr) << name;
    // Not the same bytes: another compiler rounds otherwise.
    EXPECT_GT(agreement(*made->find(name), *shipped->find(name)), 0.95) << name << made_->text;
    EXPECT_GT(agreement(*shipped->find(name), *made->find(name)), 0.95) << name << made_->text;
  }
}

}  // namespace
}  // namespace kiln

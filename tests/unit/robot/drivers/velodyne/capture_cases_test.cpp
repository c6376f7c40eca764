// Captures as people bring them: what is wrong with a few packets costs these packets, and is said.
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>

#include "common/core/manual_executor.h"
#include "robot/drivers/velodyne/device/velodyne_file_lidar.h"
#include "tests/support/data_dir.h"
#include "tests/support/lidar_cases.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;
using testing::LidarCase;

struct Played {
  Result<void> opened;
  LidarDefects defects;
  std::vector<PointCloudPtr> clouds;  ///< of two seconds
};

Played play(const std::string& path) {
  ManualClock clock;
  ManualExecutor executor(clock);
  auto lidar = VelodyneFileLidar::open(path, executor);
  if (!lidar) return {tl::make_unexpected(lidar.error()), {}, {}};
  Played out;
  out.defects = (*lidar)->defects();
  out.opened = (*lidar)->start([&](PointCloudPtr c) { out.clouds.push_back(std::move(c)); });
  executor.runUntil(Stamp{std::chrono::seconds(2)});
  return out;
}

class CaptureCases : public ::testing::TestWithParam<LidarCase> {};

TEST_P(CaptureCases, HasItsOutcome) {
  const LidarCase& c = GetParam();
  const auto path = std::filesystem::temp_directory_path() /
                    ("kiln_case_" + std::to_string(::getpid()) + "_" + c.name);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(c.bytes.data()),
             static_cast<std::streamsize>(c.bytes.size()));
  const Played played = play(path.string());
  std::filesystem::remove(path);
  ASSERT_EQ(played.opened.has_value(), c.refusal.empty())
      << (played.opened ? "played" : played.opened.error().message);
  if (!played.opened) {
    EXPECT_THAT(played.opened.error().message, HasSubstr(c.refusal));
    EXPECT_THAT(played.opened.error().message, HasSubstr(c.name));
    return;
  }
  EXPECT_EQ(played.defects.text.empty(), c.defects.empty());
  EXPECT_THAT(played.defects.text, HasSubstr(c.defects));
  // A revolution each time through, of 904 firing sequences at 1200 rpm, less what was lost.
  EXPECT_GE(played.clouds.size(), 12u);
  for (const PointCloudPtr& cloud : played.clouds) EXPECT_GT(cloud->size(), 11000u);
}

INSTANTIATE_TEST_SUITE_P(Generated, CaptureCases, ::testing::ValuesIn(testing::lidarCases()),
                         [](const auto& param) { return param.param.name; });

TEST(CaptureCasesOnDisk, HaveTheirOutcomes) {
  const auto folder = testing::dataFile("../cases/lidar");
  if (!folder) GTEST_SKIP() << "no cases here: set KILN_DATA_DIR";
  const std::map<std::string, std::string> refused{{"only_position.pcap", "40 position packets"},
                                                   {"zipped.pcap.gz", "unzip it first"}};
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    const Played played = play(entry.path().string());
    const auto refusal = refused.find(entry.path().filename().string());
    ASSERT_EQ(played.opened.has_value(), refusal == refused.end())
        << entry.path() << (played.opened ? "" : played.opened.error().message);
    if (!played.opened) {
      EXPECT_THAT(played.opened.error().message, HasSubstr(refusal->second));
    } else {
      EXPECT_GE(played.clouds.size(), 10u) << entry.path();
    }
    std::printf(
        "%-28s %3zu clouds  %s\n", entry.path().filename().c_str(), played.clouds.size(),
        played.opened ? played.defects.text.c_str() : played.opened.error().message.c_str());
  }
}

}  // namespace
}  // namespace kiln

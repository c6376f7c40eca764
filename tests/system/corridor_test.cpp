// Somebody steps into the way of the driving robot, stands there and goes away again. In the full
// world, lockstep; what the operator was told is read from the recording, where everybody stood
// from the world's trace. The same without the corridor guard: only the guard made it wait.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/core/atomic_file.h"
#include "common/record/record_reader.h"
#include "common/record/run_topics.h"
#include "common/wire/fsm.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "robot/evaluation/pose_accuracy.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// Two metres behind the door, before the robot gets there (at about 11 s, seed 1).
constexpr const char* kPerson = "person_in_way=6.6,0@5:9";
constexpr double kThere_s = 7.0, kGone_s = 14.0;
// What stood low and near, where the LiDAR is blind, is remembered so long (obstacles.keep_s), and
// the person needs 2 s for the way back.
constexpr double kForgotten_s = kGone_s + 2.0 + 20.0;
constexpr double kPersonRadius_m = 0.22, kHalfLength_m = 0.95, kHalfWidth_m = 0.7;

struct Encounter {
  std::vector<PoseSample> track;
  std::vector<FsmStatus> told;
  double nearest_m = 1e9;  ///< between the robot's outline and the person
  json collisions;

  [[nodiscard]] double driven(double from_s, double to_s) const {
    double sum = 0.0;
    for (std::size_t i = 1; i < track.size(); ++i) {
      if (track[i].t_s <= from_s || track[i].t_s > to_s) continue;
      const Pose2 &a = track[i - 1].odometry, &b = track[i].odometry;
      sum += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
    return sum;
  }
  /// Share of what the operator was told in (from, to] that says `words`.
  [[nodiscard]] double share(double from_s, double to_s, const std::string& words) const {
    int all = 0, with = 0;
    for (const FsmStatus& status : told) {
      const double t = toSeconds(status.stamp);
      if (t <= from_s || t > to_s) continue;
      ++all;
      with += status.display_text.find(words) != std::string::npos ? 1 : 0;
    }
    return all > 0 ? static_cast<double>(with) / all : 0.0;
  }
};

double clearance(const Pose2& base, double x, double y) {
  const double c = std::cos(base.yaw_rad), s = std::sin(base.yaw_rad);
  const double dx = x - base.x_m, dy = y - base.y_m;
  return std::hypot(std::max(0.0, std::abs(c * dx + s * dy) - kHalfLength_m),
                    std::max(0.0, std::abs(-s * dx + c * dy) - kHalfWidth_m)) -
         kPersonRadius_m;
}

std::vector<FsmStatus> statusesIn(const std::string& folder) {
  std::vector<FsmStatus> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".mcap") continue;
    auto reader = RecordReader::open(entry.path().string());
    if (!reader) continue;
    RecordCursor cursor = reader->messages({run::topicName(Topic::FsmStatus)});
    for (auto message = cursor.next(); message && *message; message = cursor.next()) {
      if (const auto status = wire::decodeFsmStatus((*message)->data)) out.push_back(*status);
    }
  }
  return out;
}

Encounter meet(double until_s, const std::vector<std::string>& robot_args) {
  const ScratchFolder scratch("corridor");
  MissionRunOptions options;
  options.programs = binaryDir() + "/bin";
  options.world_args = {"--fault", kPerson};
  options.robot_args = {"--until-s", std::to_string(until_s), "--record", scratch.path()};
  options.robot_args.insert(options.robot_args.end(), robot_args.begin(), robot_args.end());
  options.trace = true;
  const auto run = runMission(options);
  Encounter out;
  EXPECT_TRUE(run.has_value()) << run.error();
  if (!run) return out;
  out.track = poseSamples(*run);
  out.told = statusesIn(scratch.path());
  out.collisions = json::parse(run->report_json).at("collisions");
  std::istringstream lines(run->trace_jsonl);
  for (std::string line; std::getline(lines, line);) {
    const json row = json::parse(line, nullptr, false);
    if (!row.is_object() || !row.contains("people") || row["people"].empty()) continue;
    const double t = row["t"].get<double>();
    const auto at = std::min_element(out.track.begin(), out.track.end(),
                                     [&](const PoseSample& a, const PoseSample& b) {
                                       return std::abs(a.t_s - t) < std::abs(b.t_s - t);
                                     });
    if (at == out.track.end()) continue;
    const json& feet = row["people"][0];
    out.nearest_m =
        std::min(out.nearest_m, clearance(at->truth, feet[0].get<double>(), feet[1].get<double>()));
  }
  return out;
}

TEST(Corridor, ThePersonInTheWayIsWaitedForByNameAndPassedWhenGone) {
  const Encounter met = meet(kForgotten_s + 3.0, {});
  ASSERT_FALSE(met.track.empty());
  ASSERT_GT(met.told.size(), 50U);
  EXPECT_LT(met.driven(kGone_s - 2.0, kGone_s), 0.02) << "it waits while they stand there";
  EXPECT_EQ(met.share(kGone_s - 2.0, kGone_s, "path blocked by something"), 1.0);
  EXPECT_EQ(met.share(0.0, kThere_s - 2.5, "path blocked"), 0.0) << "nobody was there yet";
  EXPECT_GT(met.driven(kGone_s + 1.0, kForgotten_s + 3.0), 0.5) << "it goes on by itself";
  EXPECT_EQ(met.share(kForgotten_s + 2.0, kForgotten_s + 3.0, "path blocked"), 0.0);
  for (const FsmStatus& status : met.told) ASSERT_NE(status.state, "DriveBlocked");
  EXPECT_GT(met.nearest_m, 0.25) << "nobody was touched";
  EXPECT_TRUE(met.collisions.empty()) << met.collisions.dump();
}

TEST(Corridor, WithoutTheGuardTheRobotWouldHaveRunThemOver) {
  const ScratchFolder scratch("unguarded");
  const std::string config = scratch.file("robot.yaml");
  ASSERT_TRUE(writeFileAtomically(config, "drive_to:\n  guard:\n    enabled: false\n"));
  const Encounter met = meet(16.0, {"--config", config});
  ASSERT_FALSE(met.track.empty());
  EXPECT_EQ(met.share(0.0, 16.0, "path blocked"), 0.0);
  EXPECT_LT(met.nearest_m, 0.0);
}

}  // namespace
}  // namespace kiln

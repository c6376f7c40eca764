#include "robot/missions/common/mission_checkpoint.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

MissionCheckpoint sample() {
  MissionCheckpoint out;
  out.stamp = stampFromNanoseconds(987654321);
  out.fsm = {"fire", "uuid", 12, "AimHose", "AimHose"};
  out.robot.X_map_base = {1.25, -0.1, 1.0 / 3.0};
  out.holds = {{HoldReason::Stop, "STOP by Ann"}};
  out.log = std::make_shared<const nlohmann::json>(nlohmann::json{{"begun_ns", 5}});
  out.mission =
      std::make_shared<const nlohmann::json>(nlohmann::json{{"passed", 7}, {"share", 0.1}});
  return out;
}

TEST(MissionCheckpoint, ComesBackAsItWas) {
  const auto back = decodeCheckpoint(encodeCheckpoint(sample()), "f");
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->stamp, sample().stamp);
  EXPECT_EQ(back->fsm.step, 12u);
  EXPECT_EQ(back->fsm.state, "AimHose");
  EXPECT_EQ(back->robot.X_map_base.yaw_rad, 1.0 / 3.0);
  ASSERT_EQ(back->holds.size(), 1U);
  EXPECT_EQ(back->holds[0].text, "STOP by Ann");
  EXPECT_EQ(*back->log, *sample().log);
  EXPECT_EQ(*back->mission, *sample().mission);
}

TEST(MissionCheckpoint, EveryTruncationIsRefused) {
  const std::string whole = encodeCheckpoint(sample());
  for (std::size_t length = 0; length + 2 < whole.size();
       ++length) {  // the last byte is a line end
    const auto cut = decodeCheckpoint(whole.substr(0, length), "fire.checkpoint");
    ASSERT_FALSE(cut.has_value()) << length;
    EXPECT_EQ(cut.error().code, ErrorCode::Truncated) << length;
    EXPECT_NE(cut.error().message.find("fire.checkpoint"), std::string::npos);
  }
}

TEST(MissionCheckpoint, AnotherVersionOrFormatIsRefusedByName) {
  std::string newer = encodeCheckpoint(sample());
  newer.replace(newer.find("\"version\": 2"), 12, "\"version\": 3");
  const auto result = decodeCheckpoint(newer, "f");
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::VersionMismatch);
  EXPECT_NE(result.error().message.find("version 3"), std::string::npos) << result.error().message;
  EXPECT_EQ(decodeCheckpoint("{}", "f").error().code, ErrorCode::VersionMismatch);
  EXPECT_EQ(decodeCheckpoint("[1, 2]", "f").error().code, ErrorCode::Truncated);
}

// Edited by hand or flipped on the disk: nothing of it is believed.
TEST(MissionCheckpoint, EveryChangedDigitIsRefused) {
  const std::string whole = encodeCheckpoint(sample());
  int changed = 0;
  for (std::size_t i = whole.find("\"body\""); i < whole.find("\"format\""); ++i) {
    if (whole[i] < '0' || whole[i] > '9') continue;
    std::string damaged = whole;
    damaged[i] = damaged[i] == '9' ? '1' : static_cast<char>(damaged[i] + 1);
    const auto read = decodeCheckpoint(damaged, "fire.checkpoint");
    // Behind the last digit that a double keeps, a change is none.
    if (read && encodeCheckpoint(*read) == whole) continue;
    ++changed;
    ASSERT_FALSE(read.has_value()) << damaged.substr(i - 10, 20);
    EXPECT_NE(read.error().message.find("fire.checkpoint: the checkpoint is damaged"),
              std::string::npos)
        << read.error().message;
  }
  EXPECT_GT(changed, 30);
}

}  // namespace
}  // namespace kiln

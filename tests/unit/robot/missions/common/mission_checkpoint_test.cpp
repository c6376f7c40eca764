#include "robot/missions/common/mission_checkpoint.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

MissionCheckpoint sample() {
  MissionCheckpoint out;
  out.stamp = stampFromNanoseconds(987654321);
  out.fsm = {"fire", "uuid", 12, "AimHose", "AimHose"};
  out.world.places.resize(2);
  out.world.places[1].name = "place 2";
  return out;
}

TEST(MissionCheckpoint, ComesBackAsItWas) {
  const auto back = decodeCheckpoint(encodeCheckpoint(sample()), "f");
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->stamp, sample().stamp);
  EXPECT_EQ(back->fsm.step, 12u);
  EXPECT_EQ(back->fsm.state, "AimHose");
  EXPECT_EQ(back->world.places[1].name, "place 2");
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
  newer.replace(newer.find("\"version\": 1"), 12, "\"version\": 2");
  const auto result = decodeCheckpoint(newer, "f");
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::VersionMismatch);
  EXPECT_NE(result.error().message.find("version 2"), std::string::npos) << result.error().message;
  EXPECT_EQ(decodeCheckpoint("{}", "f").error().code, ErrorCode::VersionMismatch);
  EXPECT_EQ(decodeCheckpoint("[1, 2]", "f").error().code, ErrorCode::Truncated);
}

TEST(MissionCheckpoint, ADamagedFieldIsRefused) {
  std::string damaged = encodeCheckpoint(sample());
  damaged.replace(damaged.find("\"step\": 12"), 10, "\"step\": {}");
  EXPECT_EQ(decodeCheckpoint(damaged, "f").error().code, ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln

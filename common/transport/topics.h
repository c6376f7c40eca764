#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace kiln {

/// Everything a robot publishes.
enum class Topic : std::uint8_t {
  RobotStatus,
  FsmStatus,
  FsmInfo,
  MissionInfo,
  Localization,
  Scene,
  Trajectory,
  Macros,
  Log,
  Cloud,
  Thermal,
  MissionStream,  ///< what the mission's perception says of each picture or cloud
  HeadCamera,
  OperatorCamera,
  MapLayer,
};
inline constexpr std::size_t kTopicCount = 15;

/// Which PUB socket carries a topic, so that a cloud never delays a status.
enum class Lane : std::uint8_t { Status, Streams };

/// Quality of service of one topic.
struct TopicInfo {
  Topic topic;
  std::string_view name;    ///< on the wire
  std::string_view schema;  ///< full name of its Protobuf message
  Lane lane;
  std::size_t queue;   ///< messages waiting for the link thread; the oldest is dropped and counted
  bool latched;        ///< the newest is kept: sent again to each new subscriber and every repeat_s
  double max_rate_hz;  ///< more than this is dropped and counted; 0 = no cap
  double repeat_s = 2.0;  ///< of a latched topic
};

/// The table: one row a topic, in the order of the enum.
[[nodiscard]] const std::array<TopicInfo, kTopicCount>& topicTable();
[[nodiscard]] const TopicInfo& topicInfo(Topic topic);
[[nodiscard]] std::optional<Topic> topicByName(std::string_view name);

}  // namespace kiln

#include "common/transport/topics.h"

namespace kiln {
namespace {

// Rates are caps against a runaway publisher, about twice what the robot means to send.
constexpr std::array<TopicInfo, kTopicCount> kTable{{
    {Topic::RobotStatus, "robot_status", Lane::Status, 2, false, 25.0},
    {Topic::FsmStatus, "fsm_status", Lane::Status, 2, false, 25.0},
    {Topic::FsmInfo, "fsm_info", Lane::Status, 1, true, 5.0},
    {Topic::Localization, "localization", Lane::Status, 2, false, 25.0},
    {Topic::Scene, "scene", Lane::Status, 1, true, 10.0},
    {Topic::Trajectory, "trajectory", Lane::Status, 1, true, 2.0},
    {Topic::Macros, "macros", Lane::Status, 1, true, 5.0},
    {Topic::Log, "log", Lane::Status, 8, false, 5.0},
    {Topic::Cloud, "cloud", Lane::Streams, 2, false, 20.0},
    {Topic::Thermal, "thermal", Lane::Streams, 2, false, 20.0},
    {Topic::Heat, "heat", Lane::Streams, 2, false, 20.0},
    {Topic::HeadCamera, "head_camera", Lane::Streams, 1, false, 20.0},
    {Topic::OperatorCamera, "operator_camera", Lane::Streams, 1, false, 20.0},
    {Topic::MapLayer, "map_layer", Lane::Streams, 1, true, 1.0, 20.0},
}};

}  // namespace

const std::array<TopicInfo, kTopicCount>& topicTable() { return kTable; }

const TopicInfo& topicInfo(Topic topic) { return kTable[static_cast<std::size_t>(topic)]; }

std::optional<Topic> topicByName(std::string_view name) {
  for (const TopicInfo& row : kTable) {
    if (row.name == name) return row.topic;
  }
  return std::nullopt;
}

}  // namespace kiln

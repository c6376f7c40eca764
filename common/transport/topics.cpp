#include "common/transport/topics.h"

namespace kiln {
namespace {

// Rates are caps against a runaway publisher, about twice what the robot means to send.
constexpr std::array<TopicInfo, kTopicCount> kTable{{
    {Topic::RobotStatus, "robot_status", "kiln.v1.RobotStatus", Lane::Status, 2, false, 25.0},
    {Topic::FsmStatus, "fsm_status", "kiln.v1.FsmStatus", Lane::Status, 2, false, 25.0},
    {Topic::FsmInfo, "fsm_info", "kiln.v1.FsmInfo", Lane::Status, 1, true, 5.0},
    {Topic::MissionInfo, "mission_info", "kiln.v1.MissionInfo", Lane::Status, 1, true, 5.0},
    {Topic::Localization, "localization", "kiln.v1.LocalizationStatus", Lane::Status, 2, false,
     25.0},
    {Topic::Scene, "scene", "kiln.v1.Scene", Lane::Status, 1, true, 10.0},
    {Topic::Trajectory, "trajectory", "kiln.v1.Trajectory", Lane::Status, 1, true, 2.0},
    {Topic::Macros, "macros", "kiln.v1.MacroList", Lane::Status, 1, true, 5.0},
    {Topic::Log, "log", "kiln.v1.LogBatch", Lane::Status, 8, false, 5.0},
    {Topic::Cloud, "cloud", "kiln.v1.Cloud", Lane::Streams, 2, false, 20.0},
    {Topic::Thermal, "thermal", "kiln.v1.ThermalFrame", Lane::Streams, 2, false, 20.0},
    {Topic::MissionStream, "mission_stream", "kiln.v1.MissionDetail", Lane::Streams, 2, false,
     20.0},
    {Topic::HeadCamera, "head_camera", "kiln.v1.ColourFrame", Lane::Streams, 1, false, 20.0},
    {Topic::OperatorCamera, "operator_camera", "kiln.v1.ColourFrame", Lane::Streams, 1, false,
     20.0},
    {Topic::MapLayer, "map_layer", "kiln.v1.MapLayer", Lane::Streams, 1, true, 1.0, 20.0},
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

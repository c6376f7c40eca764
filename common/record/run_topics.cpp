#include "common/record/run_topics.h"

#include "common/record/printable.h"

namespace kiln::run {

std::string topicName(Topic topic) {
  if (topic == Topic::HeadCamera) return std::string(kHeadCamera);
  if (topic == Topic::OperatorCamera) return std::string(kOperatorCamera);
  return "/kiln/" + std::string(topicInfo(topic).name);
}

std::optional<Topic> publishedTopic(std::string_view name) {
  for (const TopicInfo& info : topicTable()) {
    if (topicName(info.topic) == name) return info.topic;
  }
  return std::nullopt;
}

std::string_view schemaName(Topic topic) {
  switch (topic) {
    case Topic::RobotStatus:
      return "kiln.v1.RobotStatus";
    case Topic::FsmStatus:
      return "kiln.v1.FsmStatus";
    case Topic::FsmInfo:
      return "kiln.v1.FsmInfo";
    case Topic::Scene:
      return "kiln.v1.Scene";
    case Topic::Macros:
      return "kiln.v1.MacroList";
    case Topic::Log:
      return "kiln.v1.LogBatch";
    case Topic::Cloud:
      return "kiln.v1.Cloud";
    case Topic::Thermal:
      return "kiln.v1.ThermalFrame";
    case Topic::Heat:
      return "kiln.v1.HeatDetections";
    case Topic::Localization:
      return "kiln.v1.LocalizationStatus";
    case Topic::Trajectory:
      return "kiln.v1.Trajectory";
    case Topic::MapLayer:
      return "kiln.v1.MapLayer";
    case Topic::HeadCamera:
    case Topic::OperatorCamera:
      return "foxglove.CompressedImage";
  }
  return "";
}

Result<RecordedMessage> requireMessages(const RecordReader& reader, std::string_view topic) {
  auto cursor = reader.messages({std::string(topic)});
  std::optional<Error> damage;
  for (;;) {
    auto message = cursor.next();
    if (message && *message) return std::move(**message);
    if (message) break;
    if (!damage) damage = message.error();
  }
  if (damage) return tl::make_unexpected(*damage);
  std::string others;
  for (const RecordedTopic& has : reader.topics()) {
    const std::string_view name = has.topic;
    if (name.starts_with("/kiln/") || name == kLidarScan) {
      const char* what = topic == kLidarScan ? "LiDAR scans" : "joints and wheels";
      return makeError(ErrorCode::InvalidInput,
                       "{}: no {} ({}) are in this recording; give a file that kiln-robotd "
                       "--record wrote",
                       reader.path(), what, topic);
    }
    if (others.size() < 100) others += (others.empty() ? "" : ", ") + printable(name);
  }
  if (others.empty())
    return makeError(ErrorCode::InvalidInput, "{}: no messages are in this recording",
                     reader.path());
  return makeError(ErrorCode::InvalidInput,
                   "{}: a recording of another robot (it has {}); give a file that kiln-robotd "
                   "--record wrote",
                   reader.path(), others);
}

}  // namespace kiln::run

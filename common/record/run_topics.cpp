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
  if (topic == Topic::HeadCamera || topic == Topic::OperatorCamera)
    return "foxglove.CompressedImage";
  return topicInfo(topic).schema;
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
  for (const RecordedTopic& has : reader.topics()) {
    const std::string_view name = has.topic;
    if (name.starts_with("/kiln/") || name == kLidarScan) {
      const char* what = topic == kLidarScan ? "LiDAR scans" : "joints and wheels";
      return makeError(ErrorCode::InvalidInput,
                       "{}: no {} ({}) are in this recording; give a file that kiln-robotd "
                       "--record wrote",
                       reader.path(), what, topic);
    }
  }
  return tl::make_unexpected(notOurs(reader));
}

Error notOurs(const RecordReader& reader) {
  std::string others;
  for (const RecordedTopic& has : reader.topics()) {
    const std::string_view name = has.topic;
    if (others.size() < 100) others += (others.empty() ? "" : ", ") + printable(name);
  }
  const auto error =
      others.empty()
          ? makeError(ErrorCode::InvalidInput, "{}: no messages are in this recording",
                      reader.path())
          : makeError(ErrorCode::InvalidInput,
                      "{}: a recording of another robot (it has {}); give a file that kiln-robotd "
                      "--record wrote",
                      reader.path(), others);
  return error.value();
}

}  // namespace kiln::run

#include "common/record/run_replay.h"

#include <nlohmann/json.hpp>

#include "common/record/foxglove.h"
#include "common/record/run_topics.h"
#include "common/wire/sensor.h"

namespace kiln {
namespace {

std::vector<std::string> publishedTopics() {
  std::vector<std::string> out;
  for (const TopicInfo& info : topicTable()) out.push_back(run::topicName(info.topic));
  return out;
}

bool isPicture(Topic topic) { return topic == Topic::HeadCamera || topic == Topic::OperatorCamera; }

}  // namespace

RunInfo runInfo(const RecordReader& reader) {
  RunInfo info;
  const auto text = reader.attachment(std::string(run::kRunAttachment));
  if (!text) return info;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return info;
  const auto get = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  info.robot_name = get("robot_name");
  info.version = get("version");
  info.mission_uuid = get("mission_uuid");
  info.environment = get("environment");
  info.started_utc = get("started_utc");
  return info;
}

Result<RunReplay> RunReplay::open(const std::string& path, const Clock& wall) {
  auto reader = RecordReader::open(path);
  if (!reader) return tl::make_unexpected(reader.error());
  bool any = false;
  for (const RecordedTopic& topic : reader->topics())
    any = any || run::publishedTopic(topic.topic).has_value();
  if (!any || reader->empty()) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: no run of Kiln is in this recording; give a file that kiln-robotd wrote",
                     path);
  }
  return RunReplay(std::make_unique<Player>(std::move(*reader), publishedTopics(), wall));
}

std::vector<Topic> RunReplay::silentTopics() const {
  std::vector<Topic> out;
  for (const std::string& name : player_->silentTopics())
    if (const auto topic = run::publishedTopic(name)) out.push_back(*topic);
  return out;
}

Result<std::size_t> RunReplay::poll(const Sink& sink, std::size_t limit) {
  std::optional<Error> bad_picture;
  const auto polled = player_->poll(
      [&](const RecordedMessage& message) {
        const auto topic = run::publishedTopic(message.topic);
        if (!topic) return;
        if (!isPicture(*topic)) return sink(*topic, message.data, message.published);
        auto picture = foxglove::decodeCompressedImage(message.data);
        if (!picture) {
          bad_picture = picture.error();
          return;
        }
        picture->seq = message.sequence;
        sink(*topic, wire::encode(*picture), message.published);
      },
      limit);
  if (bad_picture) return tl::make_unexpected(*bad_picture);
  return polled;
}

}  // namespace kiln

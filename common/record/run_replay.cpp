#include "common/record/run_replay.h"

#include <nlohmann/json.hpp>

#include "common/record/foxglove.h"
#include "common/record/run_topics.h"
#include "common/wire/fire/codec/protocol2.h"
#include "common/wire/sensor.h"

namespace kiln {
namespace {

std::vector<std::string> publishedTopics() {
  std::vector<std::string> out;
  for (const TopicInfo& info : topicTable()) out.push_back(run::topicName(info.topic));
  out.emplace_back(run::kProtocol2Detections);
  return out;
}

std::optional<Topic> topicOf(std::string_view name) {
  if (name == run::kProtocol2Detections) return Topic::MissionStream;
  return run::publishedTopic(name);
}

/// What stood on `topic` up to protocol 2, as a message of today.
Result<std::string> upgraded(Topic topic, std::string_view data) {
  switch (topic) {
    case Topic::RobotStatus:
      return wire::protocol2::upgradeStatus(data);
    case Topic::Scene:
      return wire::protocol2::upgradeScene(data);
    case Topic::Macros:
      return wire::protocol2::upgradeMacros(data);
    case Topic::MissionStream:
      return wire::protocol2::upgradeHeat(data);
    default:
      return std::string(data);
  }
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
  bool any = false, ours = false;
  bool protocol2 = true;
  for (const RecordedTopic& topic : reader->topics()) {
    any = any || run::publishedTopic(topic.topic).has_value();
    ours = ours || any || topic.topic == run::kLidarScan;
    protocol2 = protocol2 && topic.topic != run::topicName(Topic::MissionInfo);
  }
  if (!ours || reader->empty()) return tl::make_unexpected(run::notOurs(*reader));
  if (!any) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: sensors alone, nothing that a station was shown; give a file that "
                     "kiln-robotd --record wrote",
                     path);
  }
  return RunReplay(std::make_unique<Player>(std::move(*reader), publishedTopics(), wall),
                   protocol2);
}

std::vector<Topic> RunReplay::silentTopics() const {
  std::vector<Topic> out;
  for (const std::string& name : player_->silentTopics()) {
    const bool other_protocol = protocol2_ ? name == run::topicName(Topic::MissionInfo) ||
                                                 name == run::topicName(Topic::MissionStream)
                                           : name == run::kProtocol2Detections;
    if (const auto topic = topicOf(name); topic && !other_protocol) out.push_back(*topic);
  }
  return out;
}

Result<void> RunReplay::handOver(const RecordedMessage& message, const Sink& sink) const {
  const auto topic = topicOf(message.topic);
  if (!topic) return {};
  if (isPicture(*topic)) {
    auto picture = foxglove::decodeCompressedImage(message.data);
    if (!picture) return tl::make_unexpected(picture.error());
    picture->seq = message.sequence;
    sink(*topic, wire::encode(*picture), message.published);
    return {};
  }
  if (!protocol2_) {
    sink(*topic, message.data, message.published);
    return {};
  }
  const auto today = upgraded(*topic, message.data);
  if (!today) return tl::make_unexpected(today.error());
  sink(*topic, *today, message.published);
  if (*topic != Topic::FsmInfo) return {};
  const auto info = wire::protocol2::missionInfo(message.data);
  if (!info) return tl::make_unexpected(info.error());
  sink(Topic::MissionInfo, *info, message.published);
  return {};
}

void RunReplay::scan(const std::vector<std::string>& names, const Sink& sink, const Other& other,
                     const std::function<bool()>& goOn) const {
  RecordCursor cursor = player_->reader().messages(names);
  while (goOn()) {
    const auto next = cursor.next();
    if (!next) continue;  // a damaged chunk; the cursor stands behind it
    if (!next->has_value()) return;
    const RecordedMessage& message = **next;
    if (!topicOf(message.topic))
      other(message);
    else if (const auto done = handOver(message, sink); !done)
      continue;  // poll() tells of it
  }
}

Result<std::size_t> RunReplay::poll(const Sink& sink, std::size_t limit) {
  std::optional<Error> bad;
  const auto polled = player_->poll(
      [&](const RecordedMessage& message) {
        if (auto done = handOver(message, sink); !done) bad = done.error();
      },
      limit);
  if (bad) return tl::make_unexpected(*bad);
  return polled;
}

}  // namespace kiln

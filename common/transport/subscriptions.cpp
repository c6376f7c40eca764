#include "common/transport/subscriptions.h"

#include <algorithm>

namespace kiln {

bool Subscriptions::covers(std::string_view prefix, Topic topic) const {
  const TopicInfo& info = topicInfo(topic);
  return info.lane == lane_ && info.name.starts_with(prefix);
}

bool Subscriptions::wants(Topic topic) const {
  return std::any_of(prefixes_.begin(), prefixes_.end(),
                     [&](const std::string& prefix) { return covers(prefix, topic); });
}

std::vector<Topic> Subscriptions::take(std::string_view message) {
  if (message.empty() || (message[0] != 0 && message[0] != 1)) return {};
  const std::string_view prefix = message.substr(1);
  if (message[0] == 0) {
    if (const auto at = prefixes_.find(prefix); at != prefixes_.end()) prefixes_.erase(at);
    return {};
  }
  std::vector<Topic> fresh;
  bool known = false;
  for (const TopicInfo& info : topicTable()) {
    if (!covers(prefix, info.topic)) continue;
    known = true;
    if (!wants(info.topic)) fresh.push_back(info.topic);
  }
  if (known) prefixes_.emplace(prefix);
  return fresh;
}

}  // namespace kiln

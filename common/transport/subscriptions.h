#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/transport/topics.h"

namespace kiln {

/// What one subscriber wants of one lane, from its subscription messages: a byte 1 or 0 and a
/// prefix of topic names. Other messages, and prefixes of no topic of this lane, are nothing and
/// cost nothing. Confined to one thread.
class Subscriptions {
 public:
  explicit Subscriptions(Lane lane) : lane_(lane) {}

  /// @return topics that it did not want before.
  std::vector<Topic> take(std::string_view message);
  [[nodiscard]] bool wants(Topic topic) const;

 private:
  [[nodiscard]] bool covers(std::string_view prefix, Topic topic) const;

  Lane lane_;
  std::set<std::string, std::less<>> prefixes_;  // bounded: each is one of some topic's name
};

}  // namespace kiln

#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/record/player.h"
#include "common/transport/topics.h"

namespace kiln {

/// What a recording says of the run that it holds (its attachment run.json). Fields are empty where
/// the file does not say.
struct RunInfo {
  std::string robot_name;
  std::string version;  ///< of the daemon that wrote it
  std::string mission_uuid;
  std::string environment;  ///< "live", "sim" or "replay"
  std::string started_utc;  ///< wall time, ISO 8601
};
[[nodiscard]] RunInfo runInfo(const RecordReader& reader);

/// A recorded run as a station would have seen it: what the robot published, as the very wire
/// messages (TopicSubscribers of common/client takes them), under a player's control.
/// Example, on the station's link thread:
///   auto replay = RunReplay::open(path, wall_clock);
///   replay->player().play();
///   each 10 ms: replay->poll([&](Topic topic, std::string_view payload, Stamp published) { ... });
/// A recording of an older protocol is handed over as messages of today. Stamps inside are robot
/// time; player().clock() is the robot's clock of that moment.
/// Thread-compatible.
class RunReplay {
 public:
  using Sink = std::function<void(Topic topic, std::string_view payload, Stamp published)>;

  /// Error: as RecordReader::open; InvalidInput when it is an MCAP file without a Kiln run.
  [[nodiscard]] static Result<RunReplay> open(const std::string& path, const Clock& wall);

  [[nodiscard]] Player& player() { return *player_; }
  [[nodiscard]] const Player& player() const { return *player_; }
  [[nodiscard]] RunInfo info() const { return runInfo(player_->reader()); }
  /// What the robot had not published yet at the place of the last seek.
  [[nodiscard]] std::vector<Topic> silentTopics() const;
  using Other = std::function<void(const RecordedMessage&)>;
  /// All messages on `names` from the beginning, unpaced, in the order of time: what the robot
  /// published to `sink`, the rest to `other`. What is damaged is left out. Beside poll(), on any
  /// thread; `goOn` is asked before each message.
  void scan(const std::vector<std::string>& names, const Sink& sink, const Other& other,
            const std::function<bool()>& goOn) const;
  /// As Player::poll. A picture that cannot be read is an Error too; polling again goes on.
  [[nodiscard]] Result<std::size_t> poll(const Sink& sink, std::size_t limit = 500);

 private:
  RunReplay(std::unique_ptr<Player> player, bool protocol2)
      : player_(std::move(player)), protocol2_(protocol2) {}
  [[nodiscard]] Result<void> handOver(const RecordedMessage& message, const Sink& sink) const;
  std::unique_ptr<Player> player_;
  bool protocol2_;  ///< recorded before missions told of themselves
};

}  // namespace kiln

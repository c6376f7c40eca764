#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "common/core/clock.h"
#include "common/record/record_reader.h"

namespace kiln {

/// Recording time as a Clock: it stands while paused and goes back after a seek. Thread-safe.
class RecordingClock final : public Clock {
 public:
  [[nodiscard]] Stamp now() const override { return stampFromNanoseconds(now_ns_.load()); }
  void set(Stamp t) { now_ns_.store(toNanoseconds(t)); }

 private:
  std::atomic<std::int64_t> now_ns_{0};
};

/// Plays a recording: poll() delivers what has become due since the last poll, at `speed` times the
/// pace at which it was recorded. After a seek the newest message of every topic before that place
/// comes first, so that a viewer is complete at once. Thread-compatible; clock() may be read from
/// anywhere.
class Player {
 public:
  using Sink = std::function<void(const RecordedMessage&)>;
  static constexpr double kMinSpeed = 0.1, kMaxSpeed = 10.0;

  /// Stands at the beginning, paused. `topics` empty: all. `wall` paces the playback and must
  /// outlive the player.
  Player(RecordReader reader, std::vector<std::string> topics, const Clock& wall);

  void play();
  void pause();
  [[nodiscard]] bool playing() const { return playing_; }
  /// The last message has been delivered; play() does nothing until a seek.
  [[nodiscard]] bool ended() const { return ended_; }
  void setSpeed(double speed);  ///< clamped to kMinSpeed .. kMaxSpeed
  [[nodiscard]] double speed() const { return speed_; }
  /// Clamped to start() .. end(). Keeps playing or paused.
  void seek(Stamp t);
  /// Topics without a message at or before the place of the last seek: there is nothing to show.
  [[nodiscard]] const std::vector<std::string>& silentTopics() const { return silent_; }
  /// Pauses and goes on by `d`: poll() then delivers what lies within. Negative: back (a seek).
  void step(Duration d);

  [[nodiscard]] Stamp start() const { return start_; }
  [[nodiscard]] Stamp end() const { return end_; }
  [[nodiscard]] Stamp position() const { return clock_.now(); }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] const RecordReader& reader() const { return reader_; }
  /// Its topics from the beginning, unpaced.
  [[nodiscard]] RecordCursor messages() const { return reader_.messages(topics_, start_); }

  /// Delivers what is due, in order; at most `limit` messages, so that a slow consumer slows the
  /// playback down instead of falling behind it. @return how many. Error: a chunk was damaged and
  /// is left out; polling again goes on behind it.
  [[nodiscard]] Result<std::size_t> poll(const Sink& sink, std::size_t limit = 2000);

 private:
  [[nodiscard]] Stamp due() const;
  void anchor(Stamp t);

  RecordReader reader_;
  std::vector<std::string> topics_;
  const Clock& wall_;
  Stamp start_, end_;
  RecordCursor cursor_;
  RecordingClock clock_;
  std::vector<std::string> silent_;
  std::deque<RecordedMessage> snapshot_;  ///< to be delivered first after a seek
  double speed_ = 1.0;
  bool playing_ = false;
  bool ended_ = false;
  Stamp anchor_recording_, anchor_wall_;  ///< while playing: recording time at a wall time
  Stamp target_;                          ///< while paused: deliver up to here
};

}  // namespace kiln

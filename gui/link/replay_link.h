#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "common/core/error.h"
#include "gui/link/link.h"

namespace kiln::gui {

/// Where a replay stands. Times are robot time.
struct Playback {
  QString file;
  Stamp start, end, position;
  bool playing = false;
  bool ended = false;
  double speed = 1.0;
  QString run;      ///< what the recording says of itself: "Bob, 0.1.0, simulator, 2026-11-22 ..."
  QString problem;  ///< damage that was left out, else empty
};

/// A recorded run in place of a robot: the same signals, under a player's control. Its clock is the
/// recording's, so that nothing grows old while it stands. Nothing can be commanded: send() answers
/// 0. Reading and decoding run on a thread of its own.
class ReplayLink : public Link {
  Q_OBJECT
 public:
  static constexpr double kSlowest = 0.1, kFastest = 10.0;

  /// Error: the file cannot be read or holds no run of Kiln.
  [[nodiscard]] static Result<std::unique_ptr<ReplayLink>> open(const std::string& path);
  ~ReplayLink() override;

  void open() override;  ///< begins to play
  void close() override;
  [[nodiscard]] const Clock& clock() const override;
  [[nodiscard]] std::optional<Stamp> robotNow() const override;
  [[nodiscard]] QString clientId() const override { return QStringLiteral("replay"); }
  [[nodiscard]] QString operatorName() const override { return QStringLiteral("replay"); }
  [[nodiscard]] bool readOnly() const override { return true; }
  std::uint64_t send(const CommandBody&) override { return 0; }
  void startSetpoint(const CommandBody&, std::uint64_t) override {}
  [[nodiscard]] std::uint64_t press() override { return 0; }
  void releaseSetpoint(const CommandBody&) override {}
  void releaseSetpoints() override {}
  void stop() override { setPlaying(false); }  ///< the key that stops a robot pauses a recording

  void setPlaying(bool playing);
  void setSpeed(double speed);  ///< clamped to kSlowest .. kFastest
  void seek(Stamp position);    ///< clamped to the recording; the newest wish wins
  void step(double seconds);    ///< pauses; negative: back
  [[nodiscard]] const Playback& playback() const { return shown_; }

 signals:
  void playbackChanged(const kiln::gui::Playback& playback);

 private:
  struct Impl;
  explicit ReplayLink(std::unique_ptr<Impl> impl);
  Playback shown_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::gui

#pragma once

#include <deque>

#include "gui/models/model.h"

namespace kiln::gui {

/// Newest RobotStatus. Amber at 1.5 s, red at 3 s.
class StatusModel : public Model {
  Q_OBJECT
 public:
  explicit StatusModel(Link& link, QObject* parent = nullptr);
  /// nullptr before the first status.
  [[nodiscard]] const RobotStatus* status() const { return status_.get(); }
  /// The one large word: NoLink when nothing is known or the last status is older than 3 s,
  /// whatever it said.
  [[nodiscard]] StatusWord word() const;
  [[nodiscard]] QString robotName() const;

 private:
  std::shared_ptr<const RobotStatus> status_;
  HelloReply hello_;
};

/// Newest LinkHealth. Never stale itself: the link layer reports at 5 Hz even when the robot is
/// silent.
class LinkModel : public Model {
  Q_OBJECT
 public:
  explicit LinkModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const LinkHealth& health() const { return health_; }
  [[nodiscard]] bool usable() const {
    return health_.state == LinkState::Up || health_.state == LinkState::Degraded;
  }

 private:
  LinkHealth health_;
};

/// What macros the robot has and what one is running.
class MacroModel : public Model {
  Q_OBJECT
 public:
  explicit MacroModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const std::vector<MacroInfo>& macros() const { return macros_; }
  [[nodiscard]] const MacroStatus& running() const { return running_; }

 private:
  std::vector<MacroInfo> macros_;
  MacroStatus running_;
};

/// The newest lines of the robot's and the station's log, oldest first, bounded.
class LogModel : public Model {
  Q_OBJECT
 public:
  static constexpr std::size_t kCapacity = 2000;
  explicit LogModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const std::deque<LogLine>& lines() const { return lines_; }
  /// Lines ever added; lines().size() of them are still here.
  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// A line of the station itself (logger "station"); stamped with robot time as far as known.
  void addOwn(int level, const QString& text);

 private:
  void add(LogLine line);
  std::deque<LogLine> lines_;
  std::uint64_t total_ = 0;
};

}  // namespace kiln::gui

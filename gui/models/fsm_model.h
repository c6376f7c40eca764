#pragma once

#include <QHash>
#include <QString>
#include <vector>

#include "gui/models/model.h"

namespace kiln::gui {

/// The mission's graph and where it stands, with what the station has seen of it so far.
class FsmModel : public Model {
  Q_OBJECT
 public:
  struct Visit {
    std::uint64_t step = 0;
    QString state;
    Stamp entered;
    Stamp left;  ///< == Stamp{} while current
    TransitionCause cause = TransitionCause::Normal;
    QString note;
  };
  struct StateRecord {
    int visits = 0;
    double total_s = 0.0;  ///< of finished visits
    double last_s = 0.0;   ///< of the last finished visit
  };
  static constexpr std::size_t kMaxVisits = 1000;

  explicit FsmModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const FsmInfo* info() const { return info_.get(); }  ///< nullptr until received
  [[nodiscard]] const FsmStatus* status() const {
    return status_.get();
  }  ///< nullptr until received
  [[nodiscard]] std::shared_ptr<const FsmInfo> sharedInfo() const { return info_; }
  [[nodiscard]] const FsmStateInfo* state(const QString& name) const;
  [[nodiscard]] const FsmEdgeInfo* edge(const QString& from, const QString& to) const;
  [[nodiscard]] QString label(const QString& name) const;  ///< the name itself if unknown
  [[nodiscard]] QString current() const;
  /// Seconds in the current state, as of now.
  [[nodiscard]] double timeInStateS() const;
  /// Every visit since the station joined (and what the robot's history told of before), oldest
  /// first.
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }
  [[nodiscard]] StateRecord record(const QString& name) const { return records_.value(name); }
  /// How often this station saw `from` -> `to` taken.
  [[nodiscard]] int timesTaken(const QString& from, const QString& to) const;
  /// 0 = current, 1..3 = that many states ago, -1 = longer ago or never.
  [[nodiscard]] int recency(const QString& name) const;

 signals:
  void missionChanged();                   ///< a new graph (mission UUID)
  void stateEntered(const QString& name);  ///< at once, not paced

 private:
  void onStatus(std::shared_ptr<const FsmStatus> status);
  void merge(const FsmHistoryEntry& entry);
  void recount();

  std::shared_ptr<const FsmInfo> info_;
  std::shared_ptr<const FsmStatus> status_;
  Duration paused_{};  ///< of the time in the present state, as far as this station has seen it
  std::vector<Visit> visits_;
  QHash<QString, StateRecord> records_;
  QHash<QString, int> taken_;
};

}  // namespace kiln::gui

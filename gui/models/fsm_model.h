#pragma once

#include <QHash>
#include <QString>
#include <memory>
#include <vector>

#include "gui/link/run_history.h"
#include "gui/link/visit_log.h"
#include "gui/models/model.h"

namespace kiln::gui {

/// The mission's graph and where it stands, with what the station has seen of it so far.
class FsmModel : public Model {
  Q_OBJECT
 public:
  struct StateRecord {
    int visits = 0;
    double total_s = 0.0;  ///< of finished visits
    double last_s = 0.0;   ///< of the last finished visit
  };
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
  /// Seconds in the current state, as of knownUntil().
  [[nodiscard]] double timeInStateS() const;
  /// Up to when it is known what the machine did: now, or shortly after it was heard last.
  [[nodiscard]] Stamp knownUntil() const;
  /// Every visit since the station joined (and what the robot's history told of before), oldest
  /// first.
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_.visits(); }
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
  [[nodiscard]] Duration pausedInState() const;
  void recount();

  std::shared_ptr<const FsmInfo> info_;
  std::shared_ptr<const FsmStatus> status_;
  Duration paused_{};  ///< of the time in the present state, as far as this station has seen it
  std::shared_ptr<const RunHistory> whole_;  ///< of a recording
  VisitLog visits_;
  QHash<QString, StateRecord> records_;
  QHash<QString, int> taken_;
};

}  // namespace kiln::gui

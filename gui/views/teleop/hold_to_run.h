#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <map>

#include "gui/models/station_models.h"

namespace kiln::gui {

/// What can be held. Each kind has one setpoint stream.
enum class HoldKind { Base, Arm, Actuator, Macro };

/// The one place through which the operator's hand moves the robot: joins the holds of all views
/// (sticks, keys, actuators, macros), checks before and during each that it is allowed, and lets go
/// of everything at once when it is not. One per station, shared by the views. GUI thread only.
///
/// A hold belongs to one press of its control: what ends it here or on the robot ends it for good,
/// and only a new press moves something again. A hold is renewed from the GUI thread at 25 Hz, so
/// that a GUI that hangs goes silent and the robot's dead-man ends it.
class HoldToRun : public QObject {
  Q_OBJECT
 public:
  struct Config {
    int renew_ms = 40;           ///< 25 Hz
    double stall_s = 0.2;        ///< a window that renews later than this has let go already
    double fresh_view_s = 0.5;   ///< a cloud or camera picture younger than this, for base and arm
    double rtt_refused_s = 0.5;  ///< jogs are refused above
    double rtt_slow_s = 0.15;    ///< above: the robot halves the speed
    double rtt_creep_s = 0.3;    ///< above: the robot creeps
  };
  HoldToRun(StationModels& models, Config config, QObject* parent = nullptr);
  explicit HoldToRun(StationModels& models, QObject* parent = nullptr)
      : HoldToRun(models, Config{}, parent) {}
  ~HoldToRun() override;

  /// Why this kind may not be held now, one sentence; empty if it may.
  [[nodiscard]] QString lock(HoldKind kind) const;
  /// What a slow link does to the speed, for the operator; empty if nothing.
  [[nodiscard]] QString slowdown() const;
  /// Begins or changes a hold. @return false if locked: nothing was sent, and a running hold of the
  /// kind has ended.
  bool hold(HoldKind kind, const CommandBody& body);
  /// Ends one hold; the others go on.
  void release(HoldKind kind);
  /// Ends everything, whatever was held or not: an explicit zero goes out in any case.
  void releaseAll(const QString& why);
  [[nodiscard]] bool holding() const { return !held_.empty(); }
  [[nodiscard]] bool holding(HoldKind kind) const { return held_.count(kind) > 0; }
  [[nodiscard]] StationModels& models() const { return models_; }
  /// Checks the locks and renews what is held; runs by itself while something is held. Tests call
  /// it.
  void renew();

 signals:
  /// Everything was let go by force; controls must fall back to rest. `why` is for the operator.
  void tripped(const QString& why);
  void changed();  ///< something began or ended

 private:
  [[nodiscard]] QString viewLock() const;
  StationModels& models_;
  Config config_;
  struct Hold {
    CommandBody body;
    std::uint64_t press = 0;
  };
  std::map<HoldKind, Hold> held_;
  QTimer renew_;
  Stamp renewed_;  ///< by the link's clock
};

}  // namespace kiln::gui

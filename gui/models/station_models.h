#pragma once

#include <QTimer>

#include "gui/models/alarm_model.h"
#include "gui/models/command_model.h"
#include "gui/models/fsm_model.h"
#include "gui/models/history_model.h"
#include "gui/models/lease_model.h"
#include "gui/models/localization_model.h"
#include "gui/models/mission_model.h"
#include "gui/models/sensor_models.h"
#include "gui/models/status_models.h"
#include "gui/models/stop_model.h"

namespace kiln::gui {

/// All models of one station on one link; what every view is given. Paces changed() to 30 Hz and
/// ages to 5 Hz.
class StationModels : public QObject {
  Q_OBJECT
 public:
  static constexpr int kFlushPeriod_ms = 33;
  static constexpr int kAgePeriod_ms = 200;

  explicit StationModels(Link& link_in, QObject* parent = nullptr);

  Link& link;
  CommandModel commands;
  StatusModel status;
  LinkModel link_state;
  StopModel stop;
  LeaseModel lease;
  FsmModel fsm;
  MissionModel mission;
  CloudModel cloud;
  ThermalModel thermal;
  CameraModel camera;       ///< the operator's, rear top
  CameraModel head_camera;  ///< at the end-effector
  SceneModel scene;
  LocalizationModel localization;
  MapModel map;
  MacroModel macros;
  AlarmModel alarms;
  LogModel log;
  HistoryModel history;

  [[nodiscard]] const Clock& clock() const { return link.clock(); }
  /// Robot time now; the newest status' time while the offset is unknown.
  [[nodiscard]] Stamp robotNow() const;
  /// True if jogging, macros, pump and forced jumps would be accepted as far as the station can
  /// know: fresh status, lease, no stop, no recording. Else `why` (if given) gets one sentence.
  [[nodiscard]] bool mayCommand(QString* why = nullptr) const;
  /// Same, and in Teleop: for hold-to-run controls.
  [[nodiscard]] bool mayJog(QString* why = nullptr) const;
  /// Runs the pacing once, now. Tests call this instead of waiting.
  void flush();

 signals:
  void aged();  ///< 5 Hz: repaint ages

 private:
  void watchLink();
  void watchViews();
  QTimer flush_timer_;
  QTimer age_timer_;
};

}  // namespace kiln::gui

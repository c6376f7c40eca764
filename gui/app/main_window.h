#pragma once

#include <QWidget>

#include "common/robot_model/robot_geometry.h"
#include "gui/app/panel_catalog.h"
#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/tile.h"

class QHBoxLayout;

namespace kiln::gui {

class ActButton;
class AlarmList;
class AlarmStrip;
class CameraTile;
class FsmTile;
class MacrosTile;
class ReplayBar;
class ReplayLink;
class SceneTile;
class StateCard;
class TileLayout;
class TimelineView;
class TopBar;

/// The station's one window: its tiles, the frame that tells who drives, and the keys.
/// Nothing else.
class MainWindow : public QWidget {
  Q_OBJECT
 public:
  struct Options {
    RobotGeometry geometry;
    bool open_gl = true;
    ReplayLink* replay = nullptr;  ///< the models' link, if it is a recording
    const std::vector<PanelKind>* panels = &panelCatalog();
  };
  MainWindow(const Ui& ui, StationModels& models, const Options& options);
  ~MainWindow() override;
  [[nodiscard]] TopBar* topBar() const { return top_bar_; }
  [[nodiscard]] FsmTile* fsmTile() const { return fsm_; }
  [[nodiscard]] StateCard* stateCard() const { return state_; }
  [[nodiscard]] SceneTile* sceneTile() const { return scene_; }
  [[nodiscard]] ForcedJump& forcedJump() { return jump_; }
  [[nodiscard]] ReplayBar* replayBar() const { return replay_bar_; }  ///< null without a replay
  [[nodiscard]] AlarmStrip* alarmStrip() const { return alarms_; }
  [[nodiscard]] AlarmList* alarmList() const { return alarm_list_; }
  [[nodiscard]] ForcedJump& jump() { return jump_; }
  [[nodiscard]] MacrosTile* macrosTile() const { return macros_; }
  [[nodiscard]] HoldToRun& hold() { return hold_; }
  [[nodiscard]] TileLayout& tileLayout() { return *layout_; }
  void showLog(bool shown);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum class Frame { None, Driving, Degraded, Replay };
  [[nodiscard]] Frame frame() const;
  void makeTiles(const Options& options);
  void refreshFrame();
  void refreshTimelineTile();
  void placeAlarmList();
  bool handleKey(int key, bool typing);
  bool handleReplayKey(const QKeyEvent& key);
  Ui ui_;
  StationModels& models_;
  ForcedJump jump_;
  HoldToRun hold_;
  TopBar* top_bar_;
  FsmTile* fsm_;
  StateCard* state_;
  SceneTile* scene_ = nullptr;
  QHBoxLayout* image_row_ = nullptr;
  MacrosTile* macros_ = nullptr;
  CameraTile* camera_ = nullptr;
  Tile* timeline_tile_ = nullptr;
  TimelineView* timeline_ = nullptr;
  TileLayout* layout_ = nullptr;
  AlarmStrip* alarms_;
  AlarmList* alarm_list_;
  ReplayBar* replay_bar_ = nullptr;
  Frame shown_frame_ = Frame::None;
};

}  // namespace kiln::gui

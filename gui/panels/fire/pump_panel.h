#pragma once

#include "gui/panels/fire/water_gauge.h"
#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/hold_button.h"

class QButtonGroup;

namespace kiln::gui {

/// Sprays while its key is held, and tells what is left in the tanks.
class PumpPanel : public QWidget {
  Q_OBJECT
 public:
  /// @param hold  the station's one HoldToRun; outlives this panel.
  PumpPanel(const Ui& ui, HoldToRun& hold, QWidget* parent = nullptr);
  ~PumpPanel() override;
  [[nodiscard]] HoldButton& pump() { return *pump_; }
  [[nodiscard]] WaterGauge& gauge() { return *water_; }

 private:
  enum class Pumps { Both, Left, Right };
  void refresh();
  void begin();
  void end();
  void restyle();
  QWidget* makeKeys();
  [[nodiscard]] WaterLevels water() const;
  [[nodiscard]] HoldActuator setpoint() const;

  Ui ui_;
  HoldToRun& hold_;
  StationModels& models_;
  HoldButton* pump_;
  QButtonGroup* sides_;
  WaterGauge* water_;
  Pumps which_ = Pumps::Both;
  double sprayed_before_l_ = 0.0;  ///< mission total when this spray began
  Stamp spray_began_;
};

}  // namespace kiln::gui

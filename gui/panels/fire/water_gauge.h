#pragma once

#include <QWidget>
#include <array>
#include <optional>

#include "common/wire/fire/fire_model.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Tanks and pumps. Litres are the robot's pump model times time (there is no flow sensor) and
/// always say "est."; the currents are measured.
class WaterGauge : public QWidget {
  Q_OBJECT
 public:
  struct Config {
    double tank_l = 5.0;
    double low_l = 0.7;              ///< below: amber
    double running_current_a = 1.0;  ///< a pump that runs draws at least this
    double check_after_s = 0.6;      ///< a pump needs this long to draw it
  };
  WaterGauge(const Ui& ui, Config config, QWidget* parent = nullptr);
  explicit WaterGauge(const Ui& ui, QWidget* parent = nullptr) : WaterGauge(ui, Config{}, parent) {}
  void show(const WaterLevels& water, bool known);
  /// "left pump draws no current: dry, blocked or broken"; empty if all is well.
  [[nodiscard]] QString warning() const;
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] bool dry(std::size_t pump) const;
  void paintTank(QPainter& painter, const QRectF& row, std::size_t side) const;
  Ui ui_;
  Config config_;
  WaterLevels water_;
  bool known_ = false;
  std::array<std::optional<Stamp>, 2> running_since_{};
};

}  // namespace kiln::gui

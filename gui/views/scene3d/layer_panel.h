#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "gui/views/scene3d/scene_state.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The list of layers over the scene: an eye for each (full = shown, hollow = hidden), and the age
/// of what is old.
class LayerPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LayerPanel(const Ui& ui, QWidget* parent = nullptr);
  void show(const SceneSnapshot& snapshot);
  [[nodiscard]] QSize sizeHint() const override;

 signals:
  void toggled(kiln::gui::SceneLayer layer, bool visible);
  void missionToggled(const std::string& layer, bool visible);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] int rowAt(const QPoint& p) const;  ///< -1: none
  [[nodiscard]] QRect row(int index) const;
  Ui ui_;
  std::vector<MissionLayer> rows_;  ///< the robot's, then the mission's
  int hovered_ = -1;
};

}  // namespace kiln::gui

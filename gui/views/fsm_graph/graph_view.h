#pragma once

#include <QWidget>
#include <optional>

#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/views/fsm_graph/graph_geometry.h"
#include "gui/widgets/text.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The mission's graph: lanes, boxes with time and visits, edges as thick as they were often taken,
/// forced jumps dashed, the last three states fading. Wheel zooms, drag pans, a click on a box is
/// reported (and used by an armed jump).
class GraphView : public QWidget {
  Q_OBJECT
 public:
  GraphView(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent = nullptr);
  /// Highlights states whose label contains `text`. @return the name of the best match, empty if
  /// none.
  QString search(const QString& text);
  void fit();
  [[nodiscard]] std::optional<QRectF> nodeRect(const QString& name) const;  ///< in widget pixels
  /// How many states lie, in part at least, above and below what is shown.
  [[nodiscard]] int hiddenAbove() const;
  [[nodiscard]] int hiddenBelow() const;
  [[nodiscard]] QString nodeAt(const QPointF& position) const;
  [[nodiscard]] QSize minimumSizeHint() const override { return {250, 200}; }

 signals:
  void nodeClicked(const QString& name);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void relayout();
  void arrange();
  void keepInside();
  void showCurrent();
  void paintHidden(QPainter& painter) const;
  void paintMore(QPainter& painter, const QRectF& edge, const QString& text) const;
  [[nodiscard]] Markup tipFor(const QString& name) const;
  Ui ui_;
  StationModels& models_;
  ForcedJump& jump_;
  GraphLayout layout_;
  GraphGeometry geometry_;
  QString search_, hover_;
  double zoom_ = 1.0;
  QPointF offset_;
  QPointF drag_from_;
  bool pressed_ = false, dragging_ = false;
};

}  // namespace kiln::gui

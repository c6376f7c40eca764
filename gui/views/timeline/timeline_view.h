#pragma once

#include <QWidget>

#include "gui/models/station_models.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// States, commands, link, the mission's plotted figures and arm force on one time axis that ends
/// now. Wheel zooms the span, drag leaves "follow" and looks back, a double click follows again.
class TimelineView : public QWidget {
  Q_OBJECT
 public:
  TimelineView(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] double spanS() const { return span_s_; }
  [[nodiscard]] bool following() const { return behind_s_ <= 0.0; }
  void follow();
  [[nodiscard]] QSize minimumSizeHint() const override { return {400, 118}; }

 signals:
  void viewChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  struct Row {
    QString title;
    QRectF area;
  };
  [[nodiscard]] double xOf(Stamp stamp) const;
  [[nodiscard]] Stamp endStamp() const;
  void paintRowFrame(QPainter& painter, const Row& row) const;
  void paintStates(QPainter& painter, const QRectF& area) const;
  void paintLink(QPainter& painter, const QRectF& area) const;
  struct Curve {
    const TrendModel::Series& series;
    QColor color;
    double low = 0.0, high = 1.0;  ///< least range of the axis
    QString unit;
  };
  void paintCurve(QPainter& painter, const QRectF& area, const Curve& curve) const;
  void paintAxis(QPainter& painter, const QRectF& area) const;
  void paintCursor(QPainter& painter, const QRectF& area) const;
  Ui ui_;
  StationModels& models_;
  QRectF plot_;
  Stamp now_;
  double span_s_ = 180.0;
  double behind_s_ = 0.0;
  double cursor_x_ = -1.0;
  double drag_x_ = 0.0;
  bool dragging_ = false;
};

}  // namespace kiln::gui

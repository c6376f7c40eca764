#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "gui/models/station_models.h"
#include "gui/views/timeline/lane_painter.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The run in lanes on one time axis: states, mode, STOP, alarms, commands, macros, actuators, link,
/// the mission's plotted figures, arm force. As many as can be read at the view's height; what
/// matters least is left out first. The cross-hair tells the value of each lane.
///
/// Live the axis ends now: wheel zooms, drag leaves "follow" and looks back, a double click follows
/// again. Of a recording it is the whole run with a line where the replay stands: a click goes
/// there, a double click shows all again.
class TimelineView : public QWidget {
  Q_OBJECT
 public:
  TimelineView(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] double spanS() const;
  [[nodiscard]] bool following() const { return behind_s_ <= 0.0; }
  void follow();
  /// Titles of the lanes that are shown at this height, from above.
  [[nodiscard]] QStringList lanes() const;
  /// What the cross-hair says at `x` (pixels): "State: Aim hose", "Peak °C: 127 °C".
  [[nodiscard]] QStringList valuesAt(double x) const;
  [[nodiscard]] TimeAxis axis() const;
  [[nodiscard]] QSize minimumSizeHint() const override { return {400, 118}; }

 signals:
  void viewChanged();
  void seekWanted(kiln::Stamp position);  ///< only of a recording

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
    int rank;            ///< the highest is left out first
    bool grows = false;  ///< a curve takes what room is left
    std::function<void(LanePainter&, const QRectF&)> paint;
    std::function<QString(Stamp)> value;  ///< empty where there is none
    QRectF area{};
  };
  [[nodiscard]] std::vector<Row> rows() const;
  [[nodiscard]] Row spanRow(const QString& title, int rank, RunHistory::Lane lane) const;
  [[nodiscard]] static Row curveRow(const QString& title, int rank,
                                    const LanePainter::Curve& curve);
  [[nodiscard]] std::vector<Row> placed(std::vector<Row> rows) const;
  [[nodiscard]] QRectF plot() const;
  /// Where the axis ends when nothing is scrolled: now, or the end of the recording.
  [[nodiscard]] Stamp axisEnd() const;
  [[nodiscard]] double longestS() const;
  /// Where the robot is in its run: now, or where the replay stands.
  [[nodiscard]] Stamp position() const;
  [[nodiscard]] const std::vector<Visit>& visits() const;
  [[nodiscard]] Stamp knownUntil() const;
  [[nodiscard]] QString stateAt(Stamp at) const;
  [[nodiscard]] QString commandAt(Stamp at) const;
  void paintRowFrame(QPainter& painter, const Row& row) const;
  void paintUnheard(QPainter& painter, const QRectF& area) const;
  void paintAxis(QPainter& painter, const QRectF& area) const;
  void paintCursor(QPainter& painter, const std::vector<Row>& rows) const;
  void paintCursorText(QPainter& painter, const QRectF& row, const QString& text) const;
  [[nodiscard]] QString timeAt(Stamp at) const;
  Ui ui_;
  StationModels& models_;
  std::optional<double> span_s_;  ///< as the operator has zoomed
  double behind_s_ = 0.0;
  double cursor_x_ = -1.0;
  double drag_x_ = 0.0;
  bool pressed_ = false, dragging_ = false;
};

}  // namespace kiln::gui

#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "common/wire/fire/fire_model.h"
#include "gui/panels/fire/thermal_scale.h"
#include "gui/views/camera/picture_marks.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The thermal picture with its scale: every camera pixel is one square (nothing is invented
/// between them), the accepted source boxed and named, rejected ones outlined thinner with their
/// reason, the temperature under the mouse.
class ThermalView : public QWidget {
  Q_OBJECT
 public:
  explicit ThermalView(const Ui& ui, QWidget* parent = nullptr);
  /// @param heat    may be null; ignored where it belongs to another picture.
  /// @param notice  one sentence why nothing may be read from the picture, else empty.
  void show(const ThermalImagePtr& image, const std::shared_ptr<const HeatDetections>& heat,
            const QString& notice);
  /// Points to mark in the picture, as shares of it.
  void setMarks(std::vector<PlacedMark> marks);
  [[nodiscard]] const std::vector<PlacedMark>& marks() const { return marks_; }
  void setAutomaticScale(bool automatic);
  /// The scale in bare numbers, for the picture's sake.
  void setCompact(bool compact);
  [[nodiscard]] bool automaticScale() const { return automatic_; }
  [[nodiscard]] const ThermalScale& scale() const { return scale_; }
  /// "84.3 °C at (98, 56)" for a position in this widget; empty outside the picture.
  [[nodiscard]] QString readingAt(const QPoint& p) const;
  /// Where the picture lies in this widget.
  [[nodiscard]] QRectF pictureRect() const;
  [[nodiscard]] QSize minimumSizeHint() const override { return {180, 110}; }

 signals:
  void hovered(const QString& reading);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] int barText() const;
  void recolor();
  void paintBlobs(QPainter& painter, const QRectF& picture) const;
  [[nodiscard]] QFont labelFont(const HeatBlob& blob) const;
  void paintBar(QPainter& painter, const QRectF& picture) const;
  void paintNotice(QPainter& painter, const QRectF& picture) const;
  void paintReading(QPainter& painter, const QRectF& picture) const;

  Ui ui_;
  PerceptualMap map_ = PerceptualMap::heat();
  ThermalScale scale_;
  bool automatic_ = false;
  bool compact_ = false;
  ThermalImagePtr image_;
  std::shared_ptr<const HeatDetections> heat_;
  QString notice_;
  QImage colors_;
  std::vector<PlacedMark> marks_;
  std::optional<QPoint> mouse_;
};

}  // namespace kiln::gui

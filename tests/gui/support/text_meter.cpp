#include "tests/gui/support/text_meter.h"

#include <QPaintDevice>
#include <QPaintEngine>
#include <QWidget>
#include <algorithm>
#include <cmath>

namespace kiln::gui {
namespace {

class TextEngine : public QPaintEngine {
 public:
  TextEngine() : QPaintEngine(AllFeatures) {}
  bool begin(QPaintDevice*) override { return true; }
  bool end() override { return true; }
  [[nodiscard]] Type type() const override { return User; }
  void updateState(const QPaintEngineState& state) override {
    if (state.state() & DirtyTransform)
      scale_ = std::sqrt(std::abs(state.transform().determinant()));
  }
  void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
  void drawPath(const QPainterPath&) override {}
  void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
  void drawTextItem(const QPointF&, const QTextItem& item) override {
    ++smallest.texts;
    all += item.text();
    const double points = item.font().pointSizeF() * scale_;
    if (points >= smallest.points) return;
    smallest.points = points;
    smallest.text = item.text();
  }
  SmallestText smallest;
  QString all;

 private:
  double scale_ = 1.0;
};

/// As large and as dense as the widget's own screen.
class TextDevice : public QPaintDevice {
 public:
  explicit TextDevice(const QWidget& like) : like_(like) {}
  [[nodiscard]] QPaintEngine* paintEngine() const override { return &engine; }
  mutable TextEngine engine;

 protected:
  [[nodiscard]] int metric(PaintDeviceMetric which) const override {
    switch (which) {
      case PdmWidth:
        return like_.width();
      case PdmHeight:
        return like_.height();
      case PdmDepth:
        return 32;
      case PdmDevicePixelRatio:
        return 1;
      case PdmDevicePixelRatioScaled:
        return static_cast<int>(devicePixelRatioFScale());
      default:
        return like_.logicalDpiX();
    }
  }

 private:
  const QWidget& like_;
};

}  // namespace

SmallestText smallestText(QWidget& widget) {
  TextDevice device(widget);
  widget.render(&device);
  return device.engine.smallest;
}

QString paintedText(QWidget& widget) {
  TextDevice device(widget);
  widget.render(&device);
  return device.engine.all;
}

}  // namespace kiln::gui

#include "gui/views/replay/time_slider.h"

#include <QFontMetricsF>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kGroove_px = 6.0, kHandle_px = 7.0, kMargin_px = 10.0;
}

QString timeText(double seconds) {
  const auto tenths = static_cast<long long>(std::floor(std::max(0.0, seconds) * 10.0 + 1e-6));
  const long long whole = tenths / 10, hours = whole / 3600;
  const QString rest = QStringLiteral("%1:%2.%3")
                           .arg(whole / 60 % 60, 2, 10, QLatin1Char('0'))
                           .arg(whole % 60, 2, 10, QLatin1Char('0'))
                           .arg(tenths % 10);
  return hours > 0 ? QStringLiteral("%1:").arg(hours) + rest : rest;
}

TimeSlider::TimeSlider(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void TimeSlider::set(double position_s, double length_s) {
  if (dragging_) return;
  position_s_ = position_s;
  length_s_ = length_s;
  update();
}

QRectF TimeSlider::groove() const {
  return {kMargin_px, height() - 13.0, width() - 2.0 * kMargin_px, kGroove_px};
}

double TimeSlider::xOf(double position_s) const {
  const double share = length_s_ > 0.0 ? std::clamp(position_s / length_s_, 0.0, 1.0) : 0.0;
  return groove().left() + share * groove().width();
}

double TimeSlider::timeAt(double x) const {
  return std::clamp((x - groove().left()) / std::max(1.0, groove().width()), 0.0, 1.0) * length_s_;
}

void TimeSlider::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF line = groove();
  const double x = xOf(position_s_);
  painter.setPen(QPen(p.border, 1));
  painter.setBrush(p.sunk);
  painter.drawRoundedRect(line, 3, 3);
  painter.setPen(Qt::NoPen);
  painter.setBrush(p.replay);
  painter.drawRoundedRect(QRectF(line.left(), line.top(), x - line.left(), line.height()), 3, 3);
  painter.setBrush(p.text);
  painter.drawEllipse(QPointF(x, line.center().y()), kHandle_px, kHandle_px);
  painter.setFont(ui_.theme.font(TextRole::Small));
  const double at = hover_x_ >= 0 && !dragging_ ? hover_x_ : x;
  const QString label = timeText(timeAt(at));
  const double width_px = QFontMetricsF(painter.font()).horizontalAdvance(label) + 4;
  painter.setPen(hover_x_ >= 0 && !dragging_ ? p.dim : p.text);
  painter.drawText(QRectF(std::clamp(at - width_px / 2, 0.0, width() - width_px), 0, width_px, 18),
                   Qt::AlignCenter, label);
}

void TimeSlider::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragging_ = true;
  mouseMoveEvent(event);
}

void TimeSlider::mouseMoveEvent(QMouseEvent* event) {
  hover_x_ = event->pos().x();
  if (dragging_) {
    position_s_ = timeAt(hover_x_);
    emit wanted(position_s_);
  }
  update();
}

void TimeSlider::mouseReleaseEvent(QMouseEvent*) { dragging_ = false; }

void TimeSlider::leaveEvent(QEvent*) {
  hover_x_ = -1.0;
  update();
}

}  // namespace kiln::gui

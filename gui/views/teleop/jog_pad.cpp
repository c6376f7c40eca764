#include "gui/views/teleop/jog_pad.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace kiln::gui {
namespace {
constexpr double kKnobShare = 0.30;  // of the radius
constexpr int kThin_px = 26, kRound_px = 92, kLong_px = 92;
}  // namespace

QPointF stickValue(const QPointF& offset_px, double radius_px, double dead_zone) {
  if (!(radius_px > 0.0) || !std::isfinite(offset_px.x()) || !std::isfinite(offset_px.y()))
    return {};
  const QPointF v(offset_px.x() / radius_px, -offset_px.y() / radius_px);
  const double length = std::hypot(v.x(), v.y());
  if (length <= dead_zone) return {};
  const double wanted = (std::min(length, 1.0) - dead_zone) / (1.0 - dead_zone);
  return v * (wanted / length);
}

JogPad::JogPad(const Ui& ui, Axes axes, QWidget* parent)
    : QWidget(parent), ui_(ui), guard_(*this), axes_(axes) {
  connect(&guard_, &PressGuard::over, this, &JogPad::letGo);
  setFocusPolicy(Qt::ClickFocus);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  setCursor(Qt::OpenHandCursor);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

QSize JogPad::sizeHint() const {
  if (axes_ == Axes::Both) return {kRound_px, kRound_px};
  return axes_ == Axes::Horizontal ? QSize(kLong_px, kThin_px) : QSize(kThin_px, kLong_px);
}

QSize JogPad::minimumSizeHint() const { return sizeHint(); }

void JogPad::setEnds(const QString& right, const QString& left, const QString& up,
                     const QString& down) {
  right_ = right;
  left_ = left;
  up_ = up;
  down_ = down;
  update();
}

double JogPad::radius() const {
  const double half = 0.5 * (axes_ == Axes::Horizontal ? width()
                             : axes_ == Axes::Vertical ? height()
                                                       : std::min(width(), height()));
  const double knob = axes_ == Axes::Both ? kKnobShare * half : 0.5 * kThin_px;
  return half - knob - 1.0;
}

void JogPad::rest() {
  pressed_ = false;
  guard_.end();
  value_ = {};
  shown_ = {};
  setCursor(Qt::OpenHandCursor);
  update();
}

void JogPad::setShown(const QPointF& value) {
  if (shown_ == value) return;
  shown_ = value;
  update();
}

void JogPad::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  pressed_ = true;
  guard_.begin(true);
  setCursor(Qt::ClosedHandCursor);
  emit taken();
  if (pressed_) follow(event->localPos());
}

void JogPad::mouseMoveEvent(QMouseEvent* event) {
  if (pressed_) follow(event->localPos());
}

void JogPad::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) letGo();
}

void JogPad::follow(const QPointF& mouse) {
  QPointF offset = mouse - QPointF(0.5 * width(), 0.5 * height());
  if (axes_ == Axes::Horizontal) offset.setY(0.0);
  if (axes_ == Axes::Vertical) offset.setX(0.0);
  const QPointF value = stickValue(offset, radius(), kDeadZone);
  if (value != value_) {
    value_ = value;
    emit moved(value_);
  }
  update();
}

void JogPad::letGo() {
  if (!pressed_) return;
  rest();
  emit moved({});
}

void JogPad::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool live = pressed_ || shown_ != QPointF();
  const QRectF frame = QRectF(rect()).adjusted(1, 1, -1, -1);
  painter.setPen(QPen(live ? p.manual : isEnabled() ? p.border : p.grid, live ? 2.0 : 1.2));
  painter.setBrush(isEnabled() ? p.sunk : p.panel);
  if (axes_ == Axes::Both)
    painter.drawEllipse(frame);
  else
    painter.drawRoundedRect(frame, 0.5 * kThin_px, 0.5 * kThin_px);
  paintEnds(painter);
  paintStick(painter, frame.center(), radius(), live);
}

void JogPad::paintStick(QPainter& painter, const QPointF& middle, double travel, bool live) const {
  const Palette& p = ui_.theme.colors();
  const QPointF at = value_ != QPointF() ? value_ : shown_;
  const QPointF center = middle + travel * QPointF(at.x(), -at.y());
  const double knob = axes_ == Axes::Both ? kKnobShare * 0.5 * width() : 0.5 * kThin_px - 4.0;
  if (live) {
    painter.setPen(QPen(p.manual, 2.0));
    painter.drawLine(middle, center);
  }
  painter.setPen(QPen(live ? p.manual : isEnabled() ? p.border : p.grid, 1.2));
  painter.setBrush(live ? p.manual_fill : isEnabled() ? p.raised : p.panel);
  painter.drawEllipse(center, knob, knob);
}

void JogPad::paintEnds(QPainter& painter) const {
  const Palette& p = ui_.theme.colors();
  painter.setPen(isEnabled() ? p.dim : p.faint);
  painter.setFont(ui_.theme.font(TextRole::Small));
  const QRectF wide = QRectF(rect()).adjusted(7, 3, -7, -3);
  const QRectF high = QRectF(rect()).adjusted(0, 5, 0, -5);  // the words are as wide as the slot
  painter.drawText(wide, Qt::AlignRight | Qt::AlignVCenter, right_);
  painter.drawText(wide, Qt::AlignLeft | Qt::AlignVCenter, left_);
  painter.drawText(high, Qt::AlignTop | Qt::AlignHCenter | Qt::TextDontClip, up_);
  painter.drawText(high, Qt::AlignBottom | Qt::AlignHCenter | Qt::TextDontClip, down_);
}

}  // namespace kiln::gui

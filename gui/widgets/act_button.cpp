#include "gui/widgets/act_button.h"

#include <QFontMetrics>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kPadX_px = 12;
constexpr int kPadY_px = 7;
constexpr double kRadius_px = 4.0;
constexpr double kSmallest =
    0.85;  // of a font that is too wide; more is not readable from a step away

/// The font, a little smaller if the text is too wide for it.
QFont fitted(QFont font, const QString& text, int width_px) {
  const int needed = QFontMetrics(font).horizontalAdvance(text);
  if (needed > width_px) {
    font.setPointSizeF(font.pointSizeF() *
                       std::max(kSmallest, 0.99 * width_px / static_cast<double>(needed)));
  }
  return font;
}

bool isPressKey(int key) { return key == Qt::Key_Return || key == Qt::Key_Enter; }
}  // namespace

ActButton::ActButton(const Ui& ui, const QString& title, QWidget* parent)
    : QAbstractButton(parent), ui_(ui) {
  setText(title);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_Hover);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void ActButton::setSubtext(const QString& text) {
  if (text == subtext_) return;
  const bool other_height = text.isEmpty() != subtext_.isEmpty();
  subtext_ = text;
  if (other_height) updateGeometry();
  update();
}

void ActButton::setKind(ActKind kind) {
  if (kind == kind_) return;
  kind_ = kind;
  update();
}

QSize ActButton::sizeHint() const {
  const QFontMetrics title(ui_.theme.font(TextRole::Strong));
  const QFontMetrics small(ui_.theme.font(TextRole::Small));
  const int width = std::max(title.horizontalAdvance(text()), small.horizontalAdvance(subtext_));
  const int height = title.height() + (subtext_.isEmpty() ? 0 : small.height());
  return {width + 2 * kPadX_px, height + 2 * kPadY_px};
}

QSize ActButton::minimumSizeHint() const {
  const QFontMetrics title(ui_.theme.font(TextRole::Strong));
  return {std::min(sizeHint().width(), title.horizontalAdvance(text()) + kPadX_px),
          sizeHint().height()};
}

ActButton::Look ActButton::look() const {
  const Palette& p = ui_.theme.colors();
  Look look{p.raised, p.border, p.text, p.dim, mixed(p.raised, p.text, 0.28)};
  switch (kind_) {
    case ActKind::Normal:
      break;
    case ActKind::Primary:
      look = {p.active, p.active, p.active_text, p.active_text,
              mixed(p.active, p.active_text, 0.4)};
      break;
    case ActKind::Caution:
      look = {p.caution_fill, p.caution, p.text, p.text, mixed(p.caution_fill, p.caution, 0.6)};
      break;
    case ActKind::Forced:
      look = {p.raised, p.forced, p.text, p.dim, mixed(p.raised, p.forced, 0.55)};
      break;
    case ActKind::Manual:
      look = {p.manual_fill, p.manual, p.text, p.text, mixed(p.manual_fill, p.manual, 0.6)};
      break;
    case ActKind::Danger:
      look = {p.fault_fill, p.fault, p.text, p.text, mixed(p.fault_fill, p.fault, 0.6)};
      break;
  }
  if (!isEnabled()) look = {p.panel, p.grid, p.faint, p.faint, p.panel};
  if (isEnabled() && underMouse() && !lit()) look.fill = mixed(look.fill, p.text, 0.07);
  return look;
}

void ActButton::paintEvent(QPaintEvent*) {
  const Look l = look();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF frame = QRectF(rect()).adjusted(1, 1, -1, -1);
  QPainterPath outline;
  outline.addRoundedRect(frame, kRadius_px, kRadius_px);
  painter.fillPath(outline, lit() && fill() <= 0 ? mixed(l.fill, l.line, 0.3) : l.fill);
  if (fill() > 0) {
    painter.save();
    painter.setClipPath(outline);
    painter.fillRect(QRectF(frame.left(), frame.top(), frame.width() * fill(), frame.height()),
                     l.progress);
    painter.restore();
  }
  painter.setPen(
      QPen(hasFocus() ? ui_.theme.colors().active_line : l.line, hasFocus() || lit() ? 2.0 : 1.2));
  painter.drawPath(outline);

  const int text_width = width() - kPadX_px;
  const QFont title = fitted(ui_.theme.font(TextRole::Strong), text(), text_width);
  const QFont small = fitted(ui_.theme.font(TextRole::Small), subtext_, text_width);
  const int title_height = QFontMetrics(title).height();
  const int small_height = subtext_.isEmpty() ? 0 : QFontMetrics(small).height();
  int y = (height() - title_height - small_height) / 2;
  painter.setPen(l.text);
  painter.setFont(title);
  painter.drawText(QRect(kPadX_px / 2, y, text_width, title_height), Qt::AlignCenter,
                   QFontMetrics(title).elidedText(text(), Qt::ElideRight, text_width));
  if (subtext_.isEmpty()) return;
  painter.setPen(l.sub);
  painter.setFont(small);
  painter.drawText(QRect(kPadX_px / 2, y + title_height, text_width, small_height), Qt::AlignCenter,
                   QFontMetrics(small).elidedText(subtext_, Qt::ElideRight, text_width));
}

void ActButton::keyPressEvent(QKeyEvent* event) {
  if (!isPressKey(event->key()) || event->isAutoRepeat()) {
    event->ignore();
    return;
  }
  setDown(true);
  emit pressed();
}

void ActButton::keyReleaseEvent(QKeyEvent* event) {
  if (!isPressKey(event->key()) || event->isAutoRepeat() || !isDown()) {
    event->ignore();
    return;
  }
  setDown(false);
  emit released();
  emit clicked();
}

}  // namespace kiln::gui

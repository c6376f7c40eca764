#include "gui/widgets/act_button.h"

#include <QFontMetrics>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <QResizeEvent>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kPadX_px = 12;
constexpr int kPadY_px = 7;
constexpr double kRadius_px = 4.0;
constexpr int kMostTitleLines = 2, kMostSubLines = 4;
constexpr int kNarrowest_pct = 85;  // of a font that is too wide

/// One line, a little narrower if need be; else as many lines as there may be.
FittedText fitLines(const QString& text, const QFont& font, int width_px, int max_lines) {
  const QFont smaller = condensed(font, kNarrowest_pct);
  FittedText out = fitText(text, {font, smaller}, width_px, 1);
  if (!out.whole && max_lines > 1) out = fitText(text, {font, smaller}, width_px, max_lines);
  return out;
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
  const bool other_height =
      text.isEmpty() != subtext_.isEmpty() || sizePolicy().hasHeightForWidth();
  subtext_ = text;
  if (other_height) updateGeometry();
  update();
}

void ActButton::setWrapping(bool wrapping) {
  QSizePolicy policy = sizePolicy();
  policy.setHeightForWidth(wrapping);
  // Neighbours in a row become equally high.
  policy.setVerticalPolicy(wrapping ? QSizePolicy::Minimum : QSizePolicy::Fixed);
  setSizePolicy(policy);
}

ActButton::Texts ActButton::textsFor(int width, int height) const {
  const int room = width - kPadX_px;
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  const int free = height < 0 ? 1000 : height - 4, strong_px = QFontMetrics(strong).height(),
            small_px = QFontMetrics(small).height();
  const int least_sub_px = subtext_.isEmpty() ? 0 : small_px;
  Texts out;
  out.title = fitLines(text(), strong, room,
                       std::clamp((free - least_sub_px) / strong_px, 1, kMostTitleLines));
  if (!subtext_.isEmpty()) {
    out.sub = fitLines(subtext_, small, room,
                       std::clamp((free - out.title.height()) / small_px, 1, kMostSubLines));
  }
  return out;
}

bool ActButton::textIsWhole() const {
  const Texts texts = textsFor(width(), height());
  return texts.title.whole && texts.sub.whole &&
         texts.title.height() + texts.sub.height() <= height();
}

int ActButton::heightForWidth(int width) const {
  const Texts texts = textsFor(width, -1);
  return std::max(sizeHint().height(), texts.title.height() + texts.sub.height() + 2 * kPadY_px);
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
          sizePolicy().hasHeightForWidth() ? heightForWidth(width()) : sizeHint().height()};
}

void ActButton::resizeEvent(QResizeEvent* event) {
  QAbstractButton::resizeEvent(event);
  // The words are kept whole even where the layout is short of height: it asks for the minimum
  // anew.
  if (sizePolicy().hasHeightForWidth() && event->oldSize().width() != width()) updateGeometry();
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

  const Texts texts = textsFor(width(), height());
  const double y = (height() - texts.title.height() - texts.sub.height()) / 2.0;
  const QRectF area(kPadX_px / 2.0, y, width() - kPadX_px, texts.title.height());
  painter.setPen(l.text);
  paintFitted(painter, area, Qt::AlignHCenter | Qt::AlignTop, texts.title);
  if (subtext_.isEmpty()) return;
  painter.setPen(l.sub);
  paintFitted(painter, area.translated(0, texts.title.height()), Qt::AlignHCenter | Qt::AlignTop,
              texts.sub);
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

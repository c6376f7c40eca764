#include "gui/views/scene3d/localization_chip.h"

#include <QFontMetrics>
#include <QPainter>
#include <QStringList>
#include <algorithm>

#include "gui/widgets/age_badge.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kPadding_px = 8, kMark_px = 18;
constexpr int kWidest_px = 300;
constexpr int kTitleBottom_px = 21, kMostDetail_px = 48;
}  // namespace

LocalizationChip::LocalizationChip(const Ui& ui, const LocalizationModel& model, QWidget* parent)
    : QWidget(parent), ui_(ui), model_(model) {
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

LocalizationChip::Mark LocalizationChip::mark() const {
  const LocalizationStatus* status = model_.status();
  if (!status || model_.ageLevel() != AgeLevel::Fresh) return Mark::Unknown;
  switch (status->health) {
    case LocalizationHealth::Good:
      return Mark::Good;
    case LocalizationHealth::Degraded:
      return Mark::Degraded;
    case LocalizationHealth::Lost:
      return Mark::Lost;
  }
  return Mark::Unknown;
}

QString LocalizationChip::title() const {
  return mark() == Mark::Lost ? tr("Position LOST") : tr("Position %1").arg(model_.summary());
}

QString LocalizationChip::detail() const {
  const LocalizationStatus* status = model_.status();
  if (!status) return tr("the robot has not told where it is");
  if (mark() == Mark::Unknown) return tr("last heard %1 ago").arg(ageText(model_.ageS()));
  if (status->health != LocalizationHealth::Good && !status->reason.empty())
    return QString::fromStdString(status->reason);
  QStringList words;
  if (!status->submap.empty()) words << tr("%1 map").arg(QString::fromStdString(status->submap));
  if (status->tracking_error_m)
    words << tr("%1 off the path").arg(lengthText(*status->tracking_error_m));
  if (words.isEmpty()) words << QString::fromStdString(status->method);
  return words.join(QStringLiteral(" · "));
}

QSize LocalizationChip::sizeHint() const {
  const int text =
      std::max(QFontMetrics(ui_.theme.font(TextRole::Strong)).horizontalAdvance(title()),
               QFontMetrics(ui_.theme.font(TextRole::Small)).horizontalAdvance(detail()));
  const int widest = widest_px_ > 0 ? std::min(widest_px_, kWidest_px) : kWidest_px;
  const int width = std::min(widest, text + 2 * kPadding_px + kMark_px + 2);
  return {width, detailArea(width).bottom() + 5};
}

QRect LocalizationChip::detailArea(int width) const {
  const int x = kPadding_px + kMark_px, room = width - x - kPadding_px + 2;
  const QRect needs = QFontMetrics(ui_.theme.font(TextRole::Small))
                          .boundingRect(QRect(0, 0, room, 1000), Qt::TextWordWrap, detail());
  return {x, kTitleBottom_px, room, std::min(needs.height(), kMostDetail_px)};
}

void LocalizationChip::setWidest(int widest_px) {
  if (widest_px == widest_px_) return;
  widest_px_ = widest_px;
  resize(sizeHint());  // the caller arranges it
  update();
}

void LocalizationChip::refresh() {
  setTip(*this, model_.details());
  if (size() != sizeHint()) {
    resize(sizeHint());
    emit resized();
  }
  update();
}

void LocalizationChip::paintMark(QPainter& painter, const QPointF& c, const QColor& color) const {
  painter.setPen(QPen(color, 2.0));
  painter.setBrush(mark() == Mark::Unknown ? QBrush(Qt::NoBrush) : QBrush(color));
  switch (mark()) {
    case Mark::Good:
    case Mark::Unknown:
      painter.drawEllipse(c, 4.5, 4.5);
      break;
    case Mark::Degraded:
      painter.drawPolygon(QPolygonF()
                          << c + QPointF(0, -5.5) << c + QPointF(6, 5) << c + QPointF(-6, 5));
      break;
    case Mark::Lost:
      painter.setPen(QPen(color, 3.0, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(c + QPointF(-5, -5), c + QPointF(5, 5));
      painter.drawLine(c + QPointF(-5, 5), c + QPointF(5, -5));
      break;
  }
}

void LocalizationChip::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  const Mark shown = mark();
  const QColor color = shown == Mark::Good       ? p.ok
                       : shown == Mark::Degraded ? p.caution
                       : shown == Mark::Lost     ? p.fault
                                                 : p.dim;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QColor ground = shown == Mark::Lost ? p.fault_fill : p.panel;
  ground.setAlpha(230);
  painter.setPen(QPen(shown == Mark::Good || shown == Mark::Unknown ? p.border : color, 1.2));
  painter.setBrush(ground);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.6, 0.6, -0.6, -0.6), 4, 4);
  paintMark(painter, {kPadding_px + 6.0, 13.0}, color);
  const int x = kPadding_px + kMark_px, room = width() - x - kPadding_px + 2;
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  QFont smaller = strong;
  smaller.setPointSizeF(small.pointSizeF());
  painter.setPen(p.text);
  paintFitted(painter, QRectF(x, 3, room, 19), Qt::AlignVCenter | Qt::AlignLeft,
              fitText(title(), {strong, smaller, condensed(smaller, 92)}, room, 1));
  painter.setFont(small);
  painter.setPen(shown == Mark::Good ? p.dim : p.text);
  painter.drawText(detailArea(width()), int{Qt::TextWordWrap} | Qt::AlignLeft, detail());
}

}  // namespace kiln::gui

#include "gui/views/state_card/tick_list.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kRow_px = 22;
constexpr int kMark_px = 20;
constexpr int kSlack_px = 4;  // a row may lose so much of its air
}  // namespace

TickList::TickList(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void TickList::setRows(std::vector<Row> rows) {
  if (rows == rows_) return;
  const bool resized = rows.size() != rows_.size();
  rows_ = std::move(rows);
  if (resized) updateGeometry();
  update();
}

QSize TickList::sizeHint() const { return {260, static_cast<int>(rows_.size()) * kRow_px}; }

void TickList::paintMark(QPainter& painter, const QRectF& area, Mark mark) {
  const Palette& p = ui_.theme.colors();
  const QPointF c = area.center();
  switch (mark) {
    case Mark::Met:
      painter.setPen(QPen(p.ok, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPolyline(QPolygonF() << c + QPointF(-4.5, 0) << c + QPointF(-1.5, 3.5)
                                       << c + QPointF(4.5, -4));
      break;
    case Mark::Waiting:
      painter.setPen(Qt::NoPen);
      painter.setBrush(p.dim);
      for (int i = -1; i <= 1; ++i) painter.drawEllipse(c + QPointF(i * 4.5, 1), 1.5, 1.5);
      painter.setBrush(Qt::NoBrush);
      break;
    case Mark::Attention:
      painter.setPen(Qt::NoPen);
      painter.setBrush(p.caution);
      painter.drawRoundedRect(QRectF(c.x() - 1.4, c.y() - 6, 2.8, 8), 1, 1);
      painter.drawEllipse(c + QPointF(0, 5), 1.7, 1.7);
      painter.setBrush(Qt::NoBrush);
      break;
  }
}

void TickList::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QFont body = ui_.theme.font(TextRole::Body);
  const QFont small = ui_.theme.font(TextRole::Small);
  // Whole rows only: what does not fit is counted.
  const auto fits = static_cast<std::size_t>(std::max(1, (height() + kSlack_px) / kRow_px));
  const std::size_t shown_rows = rows_.size() <= fits ? rows_.size() : fits - 1;
  if (shown_rows < rows_.size()) {
    painter.setFont(small);
    painter.setPen(p.dim);
    painter.drawText(QRect(kMark_px, static_cast<int>(shown_rows) * kRow_px, width(), kRow_px),
                     Qt::AlignVCenter | Qt::AlignLeft,
                     tr("and %1 more").arg(rows_.size() - shown_rows));
  }
  for (std::size_t i = 0; i < shown_rows; ++i) {
    const Row& row = rows_[i];
    const int y = static_cast<int>(i) * kRow_px;
    paintMark(painter, QRectF(0, y, kMark_px - 4, kRow_px), row.mark);
    const int detail =
        QFontMetrics(small).horizontalAdvance(row.detail) + 4;  // rounding must not elide
    const int shown = std::min(detail, width() * 3 / 5);
    painter.setFont(small);
    painter.setPen(row.mark == Mark::Attention && row.level == AgeLevel::Fresh
                       ? p.caution
                       : ui_.theme.ageColor(row.level));
    painter.drawText(QRect(width() - shown, y, shown, kRow_px), Qt::AlignVCenter | Qt::AlignRight,
                     QFontMetrics(small).elidedText(row.detail, Qt::ElideRight, shown));
    painter.setFont(body);
    painter.setPen(p.text);
    const int room = width() - kMark_px - shown - 8;
    painter.drawText(QRect(kMark_px, y, room, kRow_px), Qt::AlignVCenter | Qt::AlignLeft,
                     QFontMetrics(body).elidedText(row.name, Qt::ElideRight, room));
  }
}

}  // namespace kiln::gui

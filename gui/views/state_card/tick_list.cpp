#include "gui/views/state_card/tick_list.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

#include "gui/widgets/fitted_text.h"

namespace kiln::gui {

namespace {
constexpr int kRow_px = 22;
constexpr int kMark_px = 20;
constexpr int kSlack_px = 4;    // a row may lose so much of its air
constexpr int kSecond_px = 15;  // a detail below its name
constexpr int kBetween_px = 8;
constexpr int kNarrowest_pct = 90;
}  // namespace

TickList::TickList(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void TickList::setRows(std::vector<Row> rows) {
  if (rows == rows_) return;
  std::vector<bool> tall(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool was = i < rows_.size() && tall_[i] && rows_[i].name == rows[i].name;
    tall[i] = was || needsTwoLines(rows[i], width());
  }
  const bool resized = rows.size() != rows_.size() || tall != tall_;
  rows_ = std::move(rows);
  tall_ = std::move(tall);
  if (resized) updateGeometry();
  update();
}

void TickList::resizeEvent(QResizeEvent*) {
  for (std::size_t i = 0; i < rows_.size(); ++i) tall_[i] = needsTwoLines(rows_[i], width());
  updateGeometry();
}

bool TickList::needsTwoLines(const Row& row, int width) const {
  const int name = QFontMetrics(ui_.theme.font(TextRole::Body)).horizontalAdvance(row.name);
  const int detail = QFontMetrics(ui_.theme.font(TextRole::Small)).horizontalAdvance(row.detail);
  return !row.detail.isEmpty() && kMark_px + name + kBetween_px + detail > width;
}

int TickList::rowHeight(std::size_t i, int width) const {
  return tall_[i] || needsTwoLines(rows_[i], width) ? kRow_px + kSecond_px : kRow_px;
}

int TickList::heightForWidth(int width) const {
  int height = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) height += rowHeight(i, width);
  return height;
}

QSize TickList::sizeHint() const { return {260, heightForWidth(std::max(200, width()))}; }

void TickList::paintMark(QPainter& painter, const QRectF& area, Mark mark) const {
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

void TickList::paintRow(QPainter& painter, std::size_t i, int y) const {
  const Palette& p = ui_.theme.colors();
  const Row& row = rows_[i];
  const QFont body = ui_.theme.font(TextRole::Body), small = ui_.theme.font(TextRole::Small);
  const int room = width() - kMark_px;
  const bool two = rowHeight(i, width()) > kRow_px;
  paintMark(painter, QRectF(0, y, kMark_px - 4, kRow_px), row.mark);
  painter.setPen(p.text);
  QFont smaller = body;
  smaller.setPointSizeF(small.pointSizeF());
  paintFitted(painter, QRectF(kMark_px, y, room, kRow_px), Qt::AlignVCenter | Qt::AlignLeft,
              fitText(row.name, {body, smaller}, room, 1));
  painter.setPen(row.mark == Mark::Attention && row.level == AgeLevel::Fresh
                     ? p.caution
                     : ui_.theme.ageColor(row.level));
  if (two) {
    paintFitted(painter, QRectF(kMark_px, y + kRow_px - 4, room, kSecond_px),
                Qt::AlignVCenter | Qt::AlignLeft,
                fitText(row.detail, {small, condensed(small, kNarrowest_pct)}, room, 1));
  } else {
    painter.setFont(small);
    painter.drawText(QRect(kMark_px, y, room, kRow_px), Qt::AlignVCenter | Qt::AlignRight,
                     row.detail);
  }
}

void TickList::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  // Whole rows only: what does not fit is counted.
  int y = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool last = i + 1 == rows_.size();
    const int needs = rowHeight(i, width()) + (last ? 0 : kRow_px);
    if (i > 0 && y + needs > height() + kSlack_px) {
      painter.setFont(ui_.theme.font(TextRole::Small));
      painter.setPen(ui_.theme.colors().dim);
      painter.drawText(QRect(kMark_px, y, width(), kRow_px), Qt::AlignVCenter | Qt::AlignLeft,
                       tr("and %1 more").arg(rows_.size() - i));
      return;
    }
    paintRow(painter, i, y);
    y += rowHeight(i, width());
  }
}

}  // namespace kiln::gui

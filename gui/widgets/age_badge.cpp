#include "gui/widgets/age_badge.h"

#include <QFontMetrics>
#include <QPainter>
#include <QPainterPath>

namespace kiln::gui {

namespace {
constexpr int kMark_px = 14;
}

QString ageText(double age_s) {
  if (age_s < 0) return QObject::tr("no data");
  if (age_s < 1) return QStringLiteral("%1 s").arg(age_s, 0, 'f', 2);
  if (age_s < 10) return QStringLiteral("%1 s").arg(age_s, 0, 'f', 1);
  const int s = static_cast<int>(age_s);
  if (s < 60) return QStringLiteral("%1 s").arg(s);
  return QStringLiteral("%1:%2").arg(s / 60).arg(s % 60, 2, 10, QLatin1Char('0'));
}

AgeBadge::AgeBadge(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void AgeBadge::set(double age_s, AgeLevel level, const QString& prefix) {
  const QString before = text();
  const AgeLevel level_before = level_;
  age_s_ = age_s;
  level_ = level;
  prefix_ = prefix;
  if (text() == before && level_ == level_before) return;
  if (text().size() != before.size() || level_ != level_before) updateGeometry();
  update();
}

QString AgeBadge::text() const {
  return prefix_.isEmpty() ? ageText(age_s_) : prefix_ + QStringLiteral(" · ") + ageText(age_s_);
}

QSize AgeBadge::sizeHint() const {
  const QFontMetrics metrics(ui_.theme.font(TextRole::Small));
  const int mark = level_ == AgeLevel::Amber || level_ == AgeLevel::Red ? kMark_px : 0;
  QString widest = text();  // the next figure of the same length must fit as well
  for (QChar& c : widest) {
    if (c.isDigit()) c = QLatin1Char('8');
  }
  return {metrics.horizontalAdvance(widest) + mark + 2, metrics.height()};
}

void AgeBadge::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor color = ui_.theme.ageColor(level_);
  QRectF area = rect();
  const QPointF c(kMark_px / 2.0 - 1, height() / 2.0);
  painter.setPen(QPen(color, 1.8));
  if (level_ == AgeLevel::Amber) {
    QPainterPath triangle(c + QPointF(0, -5));
    triangle.lineTo(c + QPointF(5, 4));
    triangle.lineTo(c + QPointF(-5, 4));
    triangle.closeSubpath();
    painter.fillPath(triangle, color);
  } else if (level_ == AgeLevel::Red) {
    painter.drawLine(c + QPointF(-4, -4), c + QPointF(4, 4));
    painter.drawLine(c + QPointF(-4, 4), c + QPointF(4, -4));
  }
  if (level_ == AgeLevel::Amber || level_ == AgeLevel::Red) area.setLeft(kMark_px);
  painter.setPen(color);
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.drawText(area, Qt::AlignVCenter | Qt::AlignLeft, text());
}

}  // namespace kiln::gui

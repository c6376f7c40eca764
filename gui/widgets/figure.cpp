#include "gui/widgets/figure.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace kiln::gui {

Figure::Figure(const Ui& ui, const QString& name, const QString& widest, QWidget* parent)
    : QWidget(parent), ui_(ui), name_(name), widest_(widest) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void Figure::set(const QString& value, AgeLevel level) {
  if (value == value_ && level == level_) return;
  value_ = value;
  level_ = level;
  update();
}

void Figure::setBar(std::optional<double> share) {
  if (bar_ == share) return;
  bar_ = share;
  update();
}

void Figure::setRole(TextRole role) {
  role_ = role;
  updateGeometry();
}

QSize Figure::sizeHint() const {
  const int name = QFontMetrics(ui_.theme.font(TextRole::Small)).horizontalAdvance(name_);
  const int value = QFontMetrics(ui_.theme.font(role_)).horizontalAdvance(widest_);
  return {std::max(name, value) + 2, 40};
}

void Figure::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  const bool odd = level_ == AgeLevel::Amber || level_ == AgeLevel::Red;
  QPainter painter(this);
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(odd ? ui_.theme.ageColor(level_) : p.dim);
  painter.drawText(QRect(0, 1, width(), 17), Qt::AlignLeft | Qt::AlignVCenter, name_);
  painter.setFont(ui_.theme.font(role_));
  painter.setPen(odd ? ui_.theme.ageColor(level_) : level_ == AgeLevel::None ? p.faint : p.text);
  painter.drawText(QRect(0, 17, width(), 22), Qt::AlignLeft | Qt::AlignVCenter, value_);
  if (!bar_) return;
  painter.fillRect(QRectF(0, 37, width() - 2, 3), p.border);
  painter.fillRect(QRectF(0, 37, (width() - 2) * std::clamp(*bar_, 0.0, 1.0), 3),
                   odd ? ui_.theme.ageColor(level_) : p.dim);
}

}  // namespace kiln::gui

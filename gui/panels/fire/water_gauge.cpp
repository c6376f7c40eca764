#include "gui/panels/fire/water_gauge.h"

#include <QPainter>
#include <algorithm>

namespace kiln::gui {
namespace {
constexpr int kRow_px = 16, kName_px = 46, kBarHeight_px = 8, kFigure_px = 128;
}

WaterGauge::WaterGauge(const Ui& ui, Config config, QWidget* parent)
    : QWidget(parent), ui_(ui), config_(config) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

QSize WaterGauge::sizeHint() const { return {240, 4 * kRow_px + 2}; }  // a warning takes two

void WaterGauge::show(const WaterLevels& water, bool known) {
  water_ = water;
  known_ = known;
  for (std::size_t i = 0; i < 2; ++i) {
    if (water_.duty[i] <= 0.0)
      running_since_[i].reset();
    else if (!running_since_[i])
      running_since_[i] = ui_.clock.now();
  }
  update();
}

bool WaterGauge::dry(std::size_t pump) const {
  return running_since_[pump] &&
         toSeconds(ui_.clock.now() - *running_since_[pump]) > config_.check_after_s &&
         water_.current_a[pump] < config_.running_current_a;
}

QString WaterGauge::warning() const {
  if (dry(0) && dry(1)) return tr("no pump current: tanks dry, or pumps blocked or broken");
  if (dry(0)) return tr("left pump draws no current: dry, blocked or broken");
  if (dry(1)) return tr("right pump draws no current: dry, blocked or broken");
  return {};
}

void WaterGauge::paintTank(QPainter& painter, const QRectF& row, std::size_t side) const {
  const Palette& p = ui_.theme.colors();
  const double litres = water_.tank_l_est[side];
  const bool low = known_ && litres < config_.low_l;
  painter.setPen(p.dim);
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter, side == 0 ? tr("Tank L") : tr("Tank R"));
  QRectF bar(row.left() + kName_px, row.center().y() - 0.5 * kBarHeight_px,
             row.width() - kName_px - kFigure_px, kBarHeight_px);
  painter.setPen(QPen(p.border, 1));
  painter.setBrush(p.sunk);
  painter.drawRect(bar);
  const double share = known_ ? std::clamp(litres / config_.tank_l, 0.0, 1.0) : 0.0;
  painter.fillRect(
      QRectF(bar.left() + 1, bar.top() + 1, (bar.width() - 1) * share, bar.height() - 1),
      low ? p.caution : p.plot_cool);
  painter.setPen(QPen(p.text, 1));
  const double mark = bar.left() + bar.width() * config_.low_l / config_.tank_l;
  painter.drawLine(QPointF(mark, bar.top() - 2), QPointF(mark, bar.bottom() + 2));
  painter.setPen(low || dry(side) ? p.caution : p.text);
  const QString figure =
      known_ ? tr("est. %1 l · %2 A").arg(litres, 0, 'f', 1).arg(water_.current_a[side], 0, 'f', 1)
             : tr("unknown");
  painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, figure);
}

void WaterGauge::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Palette& p = ui_.theme.colors();
  painter.setFont(ui_.theme.font(TextRole::Small));
  for (std::size_t side = 0; side < 2; ++side)
    paintTank(painter, QRectF(0, static_cast<double>(side) * kRow_px, width(), kRow_px), side);
  const QRectF last(0, 2 * kRow_px, width(), 2 * kRow_px);
  const QString why = warning();
  painter.setPen(why.isEmpty() ? p.dim : p.caution);
  painter.drawText(
      last, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap,
      why.isEmpty() ? tr("sprayed in this mission est. %1 l").arg(water_.sprayed_l_est, 0, 'f', 2)
                    : QStringLiteral("▲ ") + why);
}

}  // namespace kiln::gui

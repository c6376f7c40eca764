#include "gui/views/timeline/lane_painter.h"

#include <QFontMetricsF>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kLeastText_px = 34.0;
constexpr double kRight_px = 54.0;  // for the newest value, behind the lane

struct SpanColors {
  QColor fill, edge;
};

SpanColors colorsOf(SpanLook look, const Palette& p) {
  switch (look) {
    case SpanLook::Plain:
      return {p.raised, p.dim};
    case SpanLook::Active:
      return {mixed(p.raised, p.recent, 0.45), p.active_line};
    case SpanLook::Manual:
      return {p.manual_fill, p.manual};
    case SpanLook::Caution:
      return {p.caution_fill, p.caution};
    case SpanLook::Fault:
      return {p.fault_fill, p.fault};
  }
  return {p.raised, p.dim};
}
}  // namespace

void LanePainter::bar(const QRectF& bar, const QString& text, const QColor& fill,
                      const QColor& ink) {
  painter_.fillRect(bar, fill);
  const QRectF room = bar.intersected(axis_.plot).adjusted(6, 0, -3, 0);
  if (room.width() <= kLeastText_px) return;  // the cross-hair names it
  const QFont font = theme_.font(TextRole::Small);
  painter_.setFont(font);
  painter_.setPen(ink);
  painter_.drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                    QFontMetricsF(font).elidedText(text, Qt::ElideRight, room.width()));
}

void LanePainter::spans(const QRectF& area, const std::vector<HistorySpan>& spans) {
  const Palette& p = theme_.colors();
  painter_.save();
  painter_.setClipRect(area);
  for (const HistorySpan& span : spans) {
    const double x0 = axis_.xOf(span.from), x1 = axis_.xOf(span.to);
    if (x1 < area.left() || x0 > area.right()) continue;
    const SpanColors colors = colorsOf(span.look, p);
    const QRectF box(x0, area.top(), std::max(2.0, x1 - x0 - 1), area.height());
    bar(box, QString::fromStdString(span.text), colors.fill, p.text);
    painter_.fillRect(QRectF(x0, area.top(), 2, area.height()), colors.edge);  // if ever so short
  }
  painter_.restore();
}

void LanePainter::states(const QRectF& area, const States& states) {
  const Palette& p = theme_.colors();
  painter_.save();
  painter_.setClipRect(area);
  auto now = static_cast<int>(states.visits.size()) - 1;  // the visit in which the robot is
  while (now > 0 && states.visits[static_cast<std::size_t>(now)].entered > states.position) --now;
  for (std::size_t i = 0; i < states.visits.size(); ++i) {
    const Visit& visit = states.visits[i];
    const double x0 = axis_.xOf(visit.entered);
    const double x1 = axis_.xOf(visit.left == Stamp{} ? states.known_until : visit.left);
    if (x1 < area.left() || x0 > area.right()) continue;
    const int ago = now - static_cast<int>(i);
    const double share = ago == 0 ? 1.0 : ago == 1 ? 0.45 : ago == 2 ? 0.22 : 0.0;
    bar(QRectF(x0, area.top(), std::max(1.0, x1 - x0 - 1), area.height()),
        states.label(visit.state), mixed(p.raised, p.recent, share),
        share > 0.9 ? p.active_text : p.text);
    if (visit.cause == TransitionCause::Operator)
      painter_.fillRect(QRectF(x0, area.top(), 3, area.height()), p.forced);
  }
  painter_.restore();
}

void LanePainter::newest(const QRectF& area, const QString& text) {
  painter_.setFont(theme_.font(TextRole::Small));
  painter_.setPen(theme_.colors().dim);
  painter_.drawText(QRectF(area.right() + 6, area.top(), kRight_px - 6, area.height()),
                    Qt::AlignVCenter | Qt::AlignLeft | Qt::TextDontClip, text);
}

void LanePainter::link(const QRectF& area, const HistorySeries& series) {
  constexpr double kFull_s = 0.4;
  constexpr double kAmber_s = 0.15;
  constexpr double kRed_s = 0.30;
  constexpr double kBar_px = 5.0;
  const Palette& p = theme_.colors();
  if (series.empty()) return;
  // Worst of each bar's time; bars are anchored to time, so that they do not flicker while they
  // move.
  const double bar_s = kBar_px / area.width() * axis_.span_s;
  double worst = -1.0;
  bool lost = false;
  std::int64_t slot = 0;
  const auto draw = [&] {
    if (worst < 0 && !lost) return;
    const double x = axis_.xOf(Stamp{fromSeconds(static_cast<double>(slot) * bar_s)});
    if (x + kBar_px < area.left() || x > area.right()) return;
    const double height =
        lost ? area.height() : std::clamp(worst / kFull_s, 0.08, 1.0) * area.height();
    const QColor color = lost || worst >= kRed_s ? p.fault
                         : worst >= kAmber_s     ? p.caution
                                                 : p.plot_bar;
    const double x0 = std::max(x, area.left());
    painter_.fillRect(
        QRectF(x0, area.bottom() - height, std::min(x + kBar_px - 1, area.right()) - x0, height),
        color);
  };
  for (const auto& sample : series) {
    const auto at = static_cast<std::int64_t>(toSeconds(sample.stamp) / bar_s);
    if (at != slot) {
      draw();
      slot = at;
      worst = -1.0;
      lost = false;
    }
    if (std::isnan(sample.value))
      lost = true;
    else
      worst = std::max(worst, sample.value);
  }
  draw();
  if (std::isnan(series.back().value)) return;
  newest(area, QString::number(std::lround(series.back().value * 1000)) + QStringLiteral(" ms"));
}

void LanePainter::curve(const QRectF& area, const Curve& curve) {
  double low = curve.low;
  double high = curve.high;
  for (const auto& sample : curve.series) {
    const double shown = sample.value;
    const double x = axis_.xOf(sample.stamp);
    if (!std::isfinite(shown) || x < area.left() || x > area.right()) continue;
    low = std::min(low, shown);
    high = std::max(high, shown);
  }
  QPainterPath path;
  bool pen_down = false;
  double last_x = -1e9;
  for (const auto& sample : curve.series) {
    const double x = axis_.xOf(sample.stamp);
    if (x < area.left() || x > area.right() || (pen_down && x - last_x < 0.7)) continue;
    if (!std::isfinite(sample.value)) {
      pen_down = false;
      continue;
    }
    const double shown = sample.value;
    const QPointF at(x, area.bottom() - 2 - (shown - low) / (high - low) * (area.height() - 4));
    if (pen_down && x - last_x < 0.05 * area.width())
      path.lineTo(at);
    else
      path.moveTo(at);
    pen_down = true;
    last_x = x;
  }
  painter_.setBrush(Qt::NoBrush);
  painter_.setPen(QPen(curve.color, 1.5));
  painter_.drawPath(path);
  if (curve.series.empty() || !std::isfinite(curve.series.back().value)) return;
  newest(area,
         QString::number(std::lround(curve.series.back().value)) + QLatin1Char(' ') + curve.unit);
}

}  // namespace kiln::gui

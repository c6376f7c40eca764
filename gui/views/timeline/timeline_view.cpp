#include "gui/views/timeline/timeline_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <vector>

#include "gui/views/timeline/command_lane.h"

namespace kiln::gui {

namespace {
constexpr double kLabel_px = 92.0;
constexpr double kRight_px = 54.0;
constexpr double kAxis_px = 18.0;
constexpr double kZoomStep = 1.3;
constexpr double kMinSpan_s = 20.0;
constexpr double kMaxSpan_s = 900.0;
constexpr double kDefaultSpan_s = 180.0;
constexpr std::size_t kMostPlots = 3;  // of a mission; lower rows could not be read
}  // namespace

TimelineView::TimelineView(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models), span_s_(kDefaultSpan_s) {
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&models_, &StationModels::aged, this, qOverload<>(&QWidget::update));
  connect(&models_.commands, &Model::changed, this, qOverload<>(&QWidget::update));
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void TimelineView::follow() {
  behind_s_ = 0.0;
  span_s_ = kDefaultSpan_s;
  emit viewChanged();
  update();
}

Stamp TimelineView::endStamp() const { return now_ - fromSeconds(behind_s_); }

double TimelineView::xOf(Stamp stamp) const {
  return plot_.right() + toSeconds(stamp - endStamp()) / span_s_ * plot_.width();
}

void TimelineView::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  now_ = models_.robotNow();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  plot_ = QRectF(kLabel_px, 0, width() - kLabel_px - kRight_px, height() - kAxis_px);
  std::vector<const FigureSpec*> plotted;
  for (const FigureSpec& spec : models_.mission.info().figures)
    if (spec.plot && plotted.size() < kMostPlots) plotted.push_back(&spec);
  const double h = plot_.height() / (4.0 + static_cast<double>(plotted.size()));
  int i = 0;
  const auto row = [&](const QString& title) {
    const QRectF area = QRectF(plot_.left(), plot_.top() + i++ * h, plot_.width(), h);
    paintRowFrame(painter, {title, area.adjusted(0, 1, 0, -1)});
    return area.adjusted(0, 1, 0, -1);
  };
  paintStates(painter, row(tr("State")));
  paintCommandLane(painter, row(tr("Commands")), ui_.theme, models_.commands.commands(),
                   [this](Stamp t) { return xOf(t); });
  paintLink(painter, row(tr("Link ms")));
  for (const FigureSpec* spec : plotted) {
    const QString unit = QString::fromStdString(spec->unit);
    paintCurve(painter, row(QString::fromStdString(spec->label) + QLatin1Char(' ') + unit),
               {models_.trends.figure(spec->id), p.plot_warm, spec->low, spec->high, unit});
  }
  paintCurve(painter, row(tr("Arm force N")),
             {models_.trends.armForceN(), p.plot_cool, 0.0, 20.0, QStringLiteral("N")});
  paintAxis(painter, plot_);
  paintCursor(painter, plot_);
}

void TimelineView::paintRowFrame(QPainter& painter, const Row& row) const {
  const Palette& p = ui_.theme.colors();
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.dim);
  painter.drawText(QRectF(0, row.area.top(), kLabel_px - 8, row.area.height()),
                   Qt::AlignVCenter | Qt::AlignLeft, row.title);
  painter.setPen(QPen(p.grid, 1));
  painter.drawLine(QPointF(row.area.left(), row.area.bottom() + 1),
                   QPointF(row.area.right(), row.area.bottom() + 1));
}

void TimelineView::paintStates(QPainter& painter, const QRectF& area) const {
  const Palette& p = ui_.theme.colors();
  painter.save();
  painter.setClipRect(area);
  const double height = std::min(area.height() - 2, 20.0);
  const auto& visits = models_.fsm.visits();
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto& visit = visits[i];
    const bool current = visit.left == Stamp{};
    const double x0 = xOf(visit.entered);
    const double x1 = xOf(current ? now_ : visit.left);
    if (x1 < area.left() || x0 > area.right()) continue;
    const QRectF bar(x0, area.center().y() - height / 2, std::max(1.0, x1 - x0 - 1), height);
    const int ago = static_cast<int>(visits.size() - 1 - i);
    const double share = ago == 0 ? 1.0 : ago == 1 ? 0.45 : ago == 2 ? 0.22 : 0.0;
    const bool forced = visit.cause == TransitionCause::Operator;
    painter.setPen(Qt::NoPen);
    painter.setBrush(mixed(p.raised, p.recent, share));
    painter.drawRect(bar);
    if (forced) painter.fillRect(QRectF(x0, bar.top(), 3, height), p.forced);
    const QRectF text = bar.intersected(area).adjusted(forced ? 7 : 6, 0, -3, 0);
    const QFont font = ui_.theme.font(TextRole::Small);
    painter.setFont(font);
    painter.setPen(share > 0.9 ? p.active_text : p.text);
    const QString label = models_.fsm.label(visit.state);
    if (text.width() > 34) {
      painter.drawText(text, Qt::AlignVCenter | Qt::AlignLeft,
                       QFontMetricsF(font).elidedText(label, Qt::ElideRight, text.width()));
    }
  }
  painter.restore();
}

void TimelineView::paintLink(QPainter& painter, const QRectF& area) const {
  constexpr double kFull_s = 0.4;
  constexpr double kAmber_s = 0.15;
  constexpr double kRed_s = 0.30;
  constexpr double kBar_px = 5.0;
  const Palette& p = ui_.theme.colors();
  const auto& series = models_.trends.rttS();
  if (series.empty()) return;
  // Worst of each bar's time; bars are anchored to time, so that they do not flicker while they
  // move.
  const double bar_s = kBar_px / area.width() * span_s_;
  double worst = -1.0;
  bool lost = false;
  std::int64_t slot = 0;
  const auto draw = [&] {
    if (worst < 0 && !lost) return;
    const double x = xOf(Stamp{fromSeconds(static_cast<double>(slot) * bar_s)});
    if (x + kBar_px < area.left() || x > area.right()) return;
    const double height =
        lost ? area.height() : std::clamp(worst / kFull_s, 0.08, 1.0) * area.height();
    const QColor color = lost || worst >= kRed_s ? p.fault
                         : worst >= kAmber_s     ? p.caution
                                                 : p.plot_bar;
    const double x0 = std::max(x, area.left());
    painter.fillRect(
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
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.dim);
  painter.drawText(
      QRectF(area.right() + 6, area.top(), kRight_px - 6, area.height()),
      Qt::AlignVCenter | Qt::AlignLeft,
      QString::number(std::lround(series.back().value * 1000)) + QStringLiteral(" ms"));
}

void TimelineView::paintCurve(QPainter& painter, const QRectF& area, const Curve& curve) const {
  double low = curve.low;
  double high = curve.high;
  for (const auto& sample : curve.series) {
    const double shown = sample.value;
    const double x = xOf(sample.stamp);
    if (!std::isfinite(shown) || x < area.left() || x > area.right()) continue;
    low = std::min(low, shown);
    high = std::max(high, shown);
  }
  QPainterPath path;
  bool pen_down = false;
  double last_x = -1e9;
  for (const auto& sample : curve.series) {
    const double x = xOf(sample.stamp);
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
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(curve.color, 1.5));
  painter.drawPath(path);
  if (curve.series.empty() || !std::isfinite(curve.series.back().value)) return;
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(ui_.theme.colors().dim);
  const double newest = curve.series.back().value;
  painter.drawText(QRectF(area.right() + 6, area.top(), kRight_px - 6, area.height()),
                   Qt::AlignVCenter | Qt::AlignLeft,
                   QString::number(std::lround(newest)) + QLatin1Char(' ') + curve.unit);
}

void TimelineView::paintAxis(QPainter& painter, const QRectF& area) const {
  const Palette& p = ui_.theme.colors();
  constexpr double kSteps_s[] = {5, 10, 15, 30, 60, 120, 300};
  double step = kSteps_s[6];
  for (const double candidate : kSteps_s) {
    if (candidate / span_s_ * area.width() >= 70) {
      step = candidate;
      break;
    }
  }
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.dim);
  for (double back = std::ceil(behind_s_ / step) * step; back <= behind_s_ + span_s_ + 1e-6;
       back += step) {
    const double x = xOf(now_ - fromSeconds(back));
    const QString text = back == 0 ? tr("now") : QStringLiteral("−%1 s").arg(back);
    painter.drawText(QRectF(x - 40, area.bottom() + 1, 80, kAxis_px - 1), Qt::AlignCenter, text);
  }
  if (behind_s_ > 0) return;
  painter.setPen(QPen(p.text, 1.4));
  painter.drawLine(area.topRight() + QPointF(0.5, 0), area.bottomRight() + QPointF(0.5, 0));
}

void TimelineView::paintCursor(QPainter& painter, const QRectF& area) const {
  if (cursor_x_ < area.left() || cursor_x_ > area.right() || dragging_) return;
  const Palette& p = ui_.theme.colors();
  painter.setPen(QPen(p.faint, 1, Qt::DashLine));
  painter.drawLine(QPointF(cursor_x_, area.top()), QPointF(cursor_x_, area.bottom()));
  const double back_s = behind_s_ + (area.right() - cursor_x_) / area.width() * span_s_;
  const QString text = QStringLiteral("−%1 s").arg(back_s, 0, 'f', 1);
  const QFont font = ui_.theme.font(TextRole::Small);
  const double w = QFontMetricsF(font).horizontalAdvance(text) + 8;
  const QRectF box(std::min(cursor_x_ + 4, area.right() - w), area.bottom() - 18, w, 16);
  painter.fillRect(box, p.raised);
  painter.setPen(p.text);
  painter.setFont(font);
  painter.drawText(box, Qt::AlignCenter, text);
}

void TimelineView::wheelEvent(QWheelEvent* event) {
  span_s_ = std::clamp(span_s_ * std::pow(kZoomStep, -event->angleDelta().y() / 120.0), kMinSpan_s,
                       kMaxSpan_s);
  emit viewChanged();
  update();
}

void TimelineView::mousePressEvent(QMouseEvent* event) {
  dragging_ = event->button() == Qt::LeftButton;
  drag_x_ = event->pos().x();
}

void TimelineView::mouseMoveEvent(QMouseEvent* event) {
  cursor_x_ = event->pos().x();
  if (dragging_ && plot_.width() > 0) {
    behind_s_ =
        std::clamp(behind_s_ + (cursor_x_ - drag_x_) / plot_.width() * span_s_, 0.0, kMaxSpan_s);
    drag_x_ = cursor_x_;
    emit viewChanged();
  }
  update();
}

void TimelineView::mouseReleaseEvent(QMouseEvent*) { dragging_ = false; }
void TimelineView::mouseDoubleClickEvent(QMouseEvent*) { follow(); }
void TimelineView::leaveEvent(QEvent*) {
  cursor_x_ = -1.0;
  update();
}

}  // namespace kiln::gui

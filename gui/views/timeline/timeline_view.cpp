#include "gui/views/timeline/timeline_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/widgets/hatch.h"

namespace kiln::gui {

namespace {
constexpr double kLabel_px = 92.0;
constexpr double kRight_px = 54.0;
constexpr double kAxis_px = 18.0;
constexpr double kLeastLane_px = 15.0;  // text of 9 pt
constexpr double kLane_px = 20.0;       // more is for the curves
constexpr double kDragStart_px = 4.0;
constexpr double kMarkReach_px = 6.0;
constexpr double kZoomStep = 1.3;
constexpr double kMinSpan_s = 20.0;
constexpr double kDefaultSpan_s = 180.0;
constexpr double kSampleReach_s = 1.0;
constexpr int kMostPlots = 3;  // of a mission; lower rows could not be read

QString durationText(double seconds) {
  return seconds < 10.0 ? QStringLiteral("%1 s").arg(seconds, 0, 'f', 1)
                        : QStringLiteral("%1 s").arg(seconds, 0, 'f', 0);
}

QString clockText(double s) {
  const int whole = static_cast<int>(std::max(0.0, s));
  return QStringLiteral("%1:%2")
      .arg(whole / 60, 2, 10, QLatin1Char('0'))
      .arg(whole % 60, 2, 10, QLatin1Char('0'));
}
}  // namespace

TimelineView::TimelineView(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models) {
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&models_, &StationModels::aged, this, qOverload<>(&QWidget::update));
  connect(&models_.commands, &Model::changed, this, qOverload<>(&QWidget::update));
  connect(&models_.history, &Model::changed, this, [this] {
    if (models_.history.whole()) emit viewChanged();  // it grows while it is read
  });
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

double TimelineView::longestS() const {
  if (!models_.history.whole()) return HistoryModel::kWindow_s;
  const RunHistory& run = models_.history.run();
  return std::max(1.0, toSeconds(run.end() - run.start()));
}

double TimelineView::spanS() const {
  return std::min(longestS(),
                  span_s_.value_or(models_.history.whole() ? longestS() : kDefaultSpan_s));
}

void TimelineView::follow() {
  behind_s_ = 0.0;
  span_s_.reset();
  emit viewChanged();
  update();
}

Stamp TimelineView::position() const { return models_.robotNow(); }

Stamp TimelineView::axisEnd() const {
  return models_.history.whole() ? models_.history.run().end() : position();
}

QRectF TimelineView::plot() const {
  return {kLabel_px, 0, std::max(1.0, width() - kLabel_px - kRight_px), height() - kAxis_px};
}

TimeAxis TimelineView::axis() const {
  return {plot(), axisEnd() - fromSeconds(behind_s_), spanS()};
}

const std::vector<Visit>& TimelineView::visits() const {
  return models_.history.whole() ? models_.history.run().visits() : models_.fsm.visits();
}

Stamp TimelineView::knownUntil() const {
  return models_.history.whole() ? models_.history.run().end() : models_.fsm.knownUntil();
}

TimelineView::Row TimelineView::spanRow(const QString& title, int rank,
                                        RunHistory::Lane lane) const {
  const auto& spans = models_.history.run().lane(lane);
  return {title, rank, false,
          [&spans](LanePainter& lanes, const QRectF& area) { lanes.spans(area, spans); },
          [&spans](Stamp at) {
            const HistorySpan* span = spanAt(spans, at);
            return span ? tr("%1 · %2").arg(QString::fromStdString(span->text),
                                            durationText(toSeconds(span->to - span->from)))
                        : QString();
          }};
}

TimelineView::Row TimelineView::curveRow(const QString& title, int rank,
                                         const LanePainter::Curve& curve) {
  return {title, rank, true,
          [curve](LanePainter& lanes, const QRectF& area) { lanes.curve(area, curve); },
          [curve](Stamp at) {
            const auto value = sampleAt(curve.series, at, kSampleReach_s);
            return value ? QStringLiteral("%1 %2").arg(*value, 0, 'f', 1).arg(curve.unit)
                         : QString();
          }};
}

std::vector<TimelineView::Row> TimelineView::rows() const {
  const Palette& p = ui_.theme.colors();
  const RunHistory& run = models_.history.run();
  std::vector<Row> out;
  out.push_back({tr("State"), 0, false,
                 [this](LanePainter& lanes, const QRectF& area) {
                   lanes.states(area, {visits(), position(), knownUntil(),
                                       [this](const QString& s) { return models_.fsm.label(s); }});
                 },
                 [this](Stamp at) { return stateAt(at); }});
  out.push_back(spanRow(tr("Mode"), 6, RunHistory::Mode));
  out.push_back(spanRow(tr("STOP"), 1, RunHistory::Stop));
  out.push_back(spanRow(tr("Alarms"), 2, RunHistory::Alarms));
  out.push_back({tr("Commands"), 3, false,
                 [this](LanePainter& lanes, const QRectF& area) {
                   lanes.commands(area, models_.history.commands());
                 },
                 [this](Stamp at) { return commandAt(at); }});
  out.push_back(spanRow(tr("Macros"), 4, RunHistory::Macros));
  out.push_back(spanRow(tr("Actuators"), 5, RunHistory::Actuators));
  if (!models_.history.whole())
    out.push_back({tr("Link ms"), 8, true,
                   [this](LanePainter& lanes, const QRectF& area) {
                     lanes.link(area, models_.history.rttS());
                   },
                   [this](Stamp at) {
                     const auto rtt = sampleAt(models_.history.rttS(), at, kSampleReach_s);
                     return rtt ? tr("%1 ms").arg(std::lround(*rtt * 1000)) : QString();
                   }});
  int plotted = 0;
  for (const FigureSpec& spec : models_.mission.info().figures) {
    if (!spec.plot || plotted == kMostPlots) continue;
    const QString unit = QString::fromStdString(spec.unit);
    out.push_back(curveRow(QString::fromStdString(spec.label) + QLatin1Char(' ') + unit,
                           plotted == 0 ? 7 : 10 + plotted,
                           {run.figure(spec.id), p.plot_warm, spec.low, spec.high, unit}));
    ++plotted;
  }
  out.push_back(curveRow(tr("Arm force N"), 9,
                         {run.armForceN(), p.plot_cool, 0.0, 20.0, QStringLiteral("N")}));
  return placed(std::move(out));
}

std::vector<TimelineView::Row> TimelineView::placed(std::vector<Row> rows) const {
  const QRectF area = plot();
  while (rows.size() > 1 && static_cast<double>(rows.size()) * kLeastLane_px > area.height())
    rows.erase(std::max_element(rows.begin(), rows.end(),
                                [](const Row& a, const Row& b) { return a.rank < b.rank; }));
  const auto curves = std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.grows; });
  const double even = area.height() / static_cast<double>(rows.size());
  const double lane = curves > 0 ? std::min(even, kLane_px) : even;
  const auto fixed = static_cast<double>(rows.size()) - static_cast<double>(curves);
  const double curve =
      curves > 0 ? (area.height() - lane * fixed) / static_cast<double>(curves) : 0.0;
  double y = area.top();
  for (Row& row : rows) {
    const double height = row.grows ? curve : lane;
    row.area = QRectF(area.left(), y + 1, area.width(), height - 2);
    y += height;
  }
  return rows;
}

QStringList TimelineView::lanes() const {
  QStringList out;
  for (const Row& row : rows()) out << row.title;
  return out;
}

QStringList TimelineView::valuesAt(double x) const {
  QStringList out;
  for (const Row& row : rows()) {
    const QString value = row.value(axis().stampAt(x));
    if (!value.isEmpty()) out << tr("%1: %2").arg(row.title, value);
  }
  return out;
}

QString TimelineView::stateAt(Stamp at) const {
  for (const Visit& visit : visits()) {
    const Stamp left = visit.left == Stamp{} ? knownUntil() : visit.left;
    if (at < visit.entered || at > left) continue;
    return tr("%1 · %2").arg(models_.fsm.label(visit.state),
                             durationText(toSeconds(left - visit.entered)));
  }
  return {};
}

QString TimelineView::commandAt(Stamp at) const {
  const TimeAxis along = axis();
  const double x = along.xOf(at);
  const TrackedCommand* nearest = nullptr;
  for (const TrackedCommand& command : models_.history.commands()) {
    const double away = std::abs(along.xOf(command.sent) - x);
    if (away <= kMarkReach_px && (!nearest || away <= std::abs(along.xOf(nearest->sent) - x)))
      nearest = &command;
  }
  if (!nearest) return {};
  const QString told = tr("%1 · %2").arg(nearest->label, toText(nearest->state));
  return nearest->reason.isEmpty() ? told : tr("%1: %2").arg(told, nearest->reason);
}

void TimelineView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const std::vector<Row> shown = rows();
  const TimeAxis along = axis();
  LanePainter lanes(painter, ui_.theme, along);
  for (const Row& row : shown) {
    paintRowFrame(painter, row);
    row.paint(lanes, row.area);
  }
  paintUnheard(painter, plot());
  paintAxis(painter, plot());
  paintCursor(painter, shown);
}

void TimelineView::paintRowFrame(QPainter& painter, const Row& row) const {
  const Palette& p = ui_.theme.colors();
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.dim);
  painter.drawText(QRectF(0, row.area.top(), kLabel_px - 8, row.area.height()),
                   Qt::AlignVCenter | Qt::AlignLeft | Qt::TextDontClip, row.title);
  painter.setPen(QPen(p.grid, 1));
  painter.drawLine(QPointF(row.area.left(), row.area.bottom() + 1),
                   QPointF(row.area.right(), row.area.bottom() + 1));
}

/// From when the robot was heard last nobody knows what it did: nothing there may look known.
void TimelineView::paintUnheard(QPainter& painter, const QRectF& area) const {
  if (models_.history.whole() || !models_.fsm.hasData()) return;
  const QRectF unknown = QRectF(QPointF(axis().xOf(knownUntil()), area.top()),
                                QPointF(axis().xOf(position()), area.bottom()))
                             .intersected(area);
  if (unknown.width() < 1.0) return;
  QColor stripe = ui_.theme.colors().caution;
  stripe.setAlphaF(0.35);
  paintHatch(painter, unknown, stripe, 14.0, 3.0);
}

void TimelineView::paintAxis(QPainter& painter, const QRectF& area) const {
  const Palette& p = ui_.theme.colors();
  constexpr double kSteps_s[] = {1, 5, 10, 15, 30, 60, 120, 300, 600};
  double step = kSteps_s[8];
  for (const double candidate : kSteps_s) {
    if (candidate / spanS() * area.width() >= 70) {
      step = candidate;
      break;
    }
  }
  const bool whole = models_.history.whole();
  const TimeAxis along = axis();
  // Of a recording counted from its start, live back from now.
  const Stamp zero = whole ? models_.history.run().start() : axisEnd();
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.dim);
  const double first =
      std::ceil(toSeconds(axis().stampAt(area.left()) - zero) / step - 1e-6) * step;
  for (double at = first; at <= toSeconds(axis().end - zero) + 1e-6; at += step) {
    const double x = along.xOf(zero + fromSeconds(at));
    const QString text = whole       ? clockText(at)
                         : at > -0.5 ? tr("now")
                                     : QStringLiteral("−%1 s").arg(-at);
    painter.drawText(QRectF(x - 40, area.bottom() + 1, 80, kAxis_px - 1), Qt::AlignCenter, text);
  }
  const double x = axis().xOf(position());
  if (x < area.left() || x > area.right() + 1) return;
  painter.setPen(QPen(whole ? p.replay : p.text, whole ? 2.0 : 1.4));
  painter.drawLine(QPointF(x + 0.5, area.top()), QPointF(x + 0.5, area.bottom()));
}

QString TimelineView::timeAt(Stamp at) const {
  if (models_.history.whole()) return clockText(toSeconds(at - models_.history.run().start()));
  return QStringLiteral("−%1 s").arg(std::max(0.0, toSeconds(axisEnd() - at)), 0, 'f', 1);
}

void TimelineView::paintCursor(QPainter& painter, const std::vector<Row>& rows) const {
  const QRectF area = plot();
  if (cursor_x_ < area.left() || cursor_x_ > area.right() || dragging_) return;
  painter.setPen(QPen(ui_.theme.colors().faint, 1, Qt::DashLine));
  painter.drawLine(QPointF(cursor_x_, area.top()), QPointF(cursor_x_, area.bottom()));
  const Stamp at = axis().stampAt(cursor_x_);
  for (const Row& row : rows) paintCursorText(painter, row.area, row.value(at));
  paintCursorText(painter, QRectF(area.left(), area.bottom() + 1, area.width(), kAxis_px - 2),
                  timeAt(at));
}

/// Beside the cross-hair, at the side where there is room.
void TimelineView::paintCursorText(QPainter& painter, const QRectF& row,
                                   const QString& text) const {
  if (text.isEmpty()) return;
  const Palette& p = ui_.theme.colors();
  const QFont font = ui_.theme.font(TextRole::Small);
  const double most = std::max(cursor_x_ - row.left(), row.right() - cursor_x_) - 8;
  const QString shown = QFontMetricsF(font).elidedText(text, Qt::ElideRight, most - 8);
  const double w = QFontMetricsF(font).horizontalAdvance(shown) + 8;
  const double left = cursor_x_ + 5 + w <= row.right() ? cursor_x_ + 5 : cursor_x_ - 5 - w;
  const QRectF box(left, row.top(), w, row.height());
  painter.setPen(QPen(p.border, 1));
  painter.setBrush(p.panel);
  painter.drawRect(box);
  painter.setPen(p.text);
  painter.setFont(font);
  painter.drawText(box, Qt::AlignCenter | Qt::TextDontClip, shown);
}

void TimelineView::wheelEvent(QWheelEvent* event) {
  const double zoomed = spanS() * std::pow(kZoomStep, -event->angleDelta().y() / 120.0);
  span_s_ = std::clamp(zoomed, std::min(kMinSpan_s, longestS()), longestS());
  behind_s_ = std::clamp(behind_s_, 0.0, longestS() - *span_s_);
  emit viewChanged();
  update();
}

void TimelineView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->button() == Qt::LeftButton;
  drag_x_ = event->pos().x();
}

void TimelineView::mouseMoveEvent(QMouseEvent* event) {
  cursor_x_ = event->pos().x();
  if (pressed_ && std::abs(cursor_x_ - drag_x_) >= kDragStart_px) dragging_ = true;
  if (dragging_) {
    const double moved_s = (cursor_x_ - drag_x_) / plot().width() * spanS();
    behind_s_ = std::clamp(behind_s_ + moved_s, 0.0, std::max(0.0, longestS() - spanS()));
    drag_x_ = cursor_x_;
    emit viewChanged();
  }
  update();
}

void TimelineView::mouseReleaseEvent(QMouseEvent* event) {
  if (pressed_ && !dragging_ && models_.history.whole() && plot().contains(event->pos()))
    emit seekWanted(axis().stampAt(event->pos().x()));
  pressed_ = dragging_ = false;
}

void TimelineView::mouseDoubleClickEvent(QMouseEvent*) { follow(); }
void TimelineView::leaveEvent(QEvent*) {
  cursor_x_ = -1.0;
  update();
}

}  // namespace kiln::gui

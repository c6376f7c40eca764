#include "gui/views/fsm_graph/graph_view.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "gui/views/fsm_graph/graph_painter.h"

namespace kiln::gui {

namespace {
constexpr double kZoomStep = 1.15;
constexpr double kMinZoom = 0.6;
constexpr double kMaxZoom = 3.0;
constexpr double kDragStart_px = 4.0;
constexpr double kCut_px = 3.0;    // less of a box missing is no box missing
constexpr double kMore_px = 26.0;  // of the sign that there is more
constexpr int kFewestRows = 6;
constexpr int kMostRows = 12;
}  // namespace

GraphView::GraphView(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models), jump_(jump) {
  setMouseTracking(true);
  setAccessibleName(tr("State graph"));
  const auto repaint = qOverload<>(&QWidget::update);
  connect(&models_.fsm, &FsmModel::missionChanged, this, &GraphView::relayout);
  connect(&models_.fsm, &FsmModel::stateEntered, this, &GraphView::showCurrent);
  connect(&models_.fsm, &Model::changed, this, repaint);
  connect(&models_, &StationModels::aged, this, repaint);
  connect(&jump_, &ForcedJump::changed, this, repaint);
  connect(&ui_.theme, &Theme::changed, this, repaint);
  relayout();
}

void GraphView::relayout() {
  arrange();
  fit();
}

void GraphView::arrange() {
  // Rather longer lanes than columns that stick out at the side.
  layout_ = {};
  for (int rows = kFewestRows; models_.fsm.info() && rows <= kMostRows; ++rows) {
    layout_ = layoutGraph(*models_.fsm.info(), rows);
    if (layout_.columns * GraphGeometry::kMinColumn_px <= width()) break;
  }
  geometry_ = GraphGeometry(layout_, size());
}

void GraphView::fit() {
  zoom_ = 1.0;
  offset_ = {};
  keepInside();
  showCurrent();
  update();
}

QString GraphView::search(const QString& text) {
  search_ = text;
  update();
  if (text.isEmpty()) return {};
  QString best;
  for (const GraphLayout::Node& node : layout_.nodes) {
    const QString label = models_.fsm.label(node.name);
    if (label.startsWith(text, Qt::CaseInsensitive)) return node.name;
    if (best.isEmpty() && label.contains(text, Qt::CaseInsensitive)) best = node.name;
  }
  return best;
}

std::optional<QRectF> GraphView::nodeRect(const QString& name) const {
  const int i = layout_.index.value(name, -1);
  if (i < 0) return std::nullopt;
  const QRectF& box = geometry_.nodes()[static_cast<std::size_t>(i)];
  return QRectF(box.topLeft() * zoom_ + offset_, box.size() * zoom_);
}

QString GraphView::nodeAt(const QPointF& position) const {
  const QPointF p = (position - offset_) / zoom_;
  for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
    if (geometry_.nodes()[i].contains(p)) return layout_.nodes[i].name;
  }
  return {};
}

void GraphView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (layout_.nodes.empty()) {
    painter.setPen(ui_.theme.colors().faint);
    painter.setFont(ui_.theme.font(TextRole::Body));
    painter.drawText(rect(), Qt::AlignCenter, tr("waiting for the mission's graph"));
    return;
  }
  painter.translate(offset_);
  painter.scale(zoom_, zoom_);
  GraphPainter(painter, {ui_.theme, models_, jump_, layout_, geometry_, search_, hover_}).paint();
  painter.resetTransform();
  paintHidden(painter);
}

int GraphView::hiddenAbove() const {
  return static_cast<int>(std::count_if(
      geometry_.nodes().begin(), geometry_.nodes().end(),
      [this](const QRectF& box) { return box.top() * zoom_ + offset_.y() < -kCut_px; }));
}

int GraphView::hiddenBelow() const {
  return static_cast<int>(
      std::count_if(geometry_.nodes().begin(), geometry_.nodes().end(), [this](const QRectF& box) {
        return box.bottom() * zoom_ + offset_.y() > height() + kCut_px;
      }));
}

/// What is cut off at the rim could pass for all there is.
void GraphView::paintHidden(QPainter& painter) const {
  const int above = hiddenAbove(), below = hiddenBelow();
  if (above > 0)
    paintMore(painter, QRectF(0, 0, width(), kMore_px), tr("▴ %1 more: drag").arg(above));
  if (below > 0)
    paintMore(painter, QRectF(0, height() - kMore_px, width(), kMore_px),
              tr("▾ %1 more: drag").arg(below));
}

void GraphView::paintMore(QPainter& painter, const QRectF& edge, const QString& text) const {
  const Palette& p = ui_.theme.colors();
  QColor clear = p.panel, veil = p.panel;
  clear.setAlphaF(0.0);
  veil.setAlphaF(0.94);
  const bool top = edge.top() <= 0.0;
  QLinearGradient fade(edge.topLeft(), edge.bottomLeft());
  fade.setColorAt(top ? 1.0 : 0.0, clear);
  fade.setColorAt(0.5, veil);
  fade.setColorAt(top ? 0.0 : 1.0, veil);
  painter.fillRect(edge, fade);
  painter.setPen(p.text);
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.drawText(edge, (top ? Qt::AlignTop : Qt::AlignBottom) | Qt::AlignHCenter, text);
}

void GraphView::resizeEvent(QResizeEvent*) {
  arrange();
  keepInside();
  showCurrent();
}

void GraphView::keepInside() {
  const QSizeF content = geometry_.size() * zoom_;
  const auto limit = [](double offset, double room, double length) {
    return length <= room ? (room - length) / 2 : std::clamp(offset, room - length, 0.0);
  };
  offset_ = {limit(offset_.x(), width(), content.width()),
             content.height() <= height() ? 0.0 : limit(offset_.y(), height(), content.height())};
}

void GraphView::showCurrent() {
  const auto box = nodeRect(models_.fsm.current());
  if (!box) return;
  const QRectF room = QRectF(rect()).adjusted(4, 4, -4, -4);
  if (room.contains(*box)) return;
  if (box->bottom() > room.bottom()) offset_.ry() -= box->bottom() - room.bottom() + 20;
  if (box->top() < room.top()) offset_.ry() += room.top() - box->top() + 20;
  if (box->right() > room.right()) offset_.rx() -= box->right() - room.right() + 20;
  if (box->left() < room.left()) offset_.rx() += room.left() - box->left() + 20;
  keepInside();
  update();
}

void GraphView::wheelEvent(QWheelEvent* event) {
  const double before = zoom_;
  zoom_ =
      std::clamp(zoom_ * std::pow(kZoomStep, event->angleDelta().y() / 120.0), kMinZoom, kMaxZoom);
  const QPointF at = event->position();
  offset_ = at - (at - offset_) * (zoom_ / before);
  keepInside();
  update();
}

void GraphView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->button() == Qt::LeftButton;
  dragging_ = false;
  drag_from_ = event->pos();
}

void GraphView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->pos();
  const QString over = nodeAt(at);
  if (over != hover_) {
    hover_ = over;
    update();
  }
  if (!pressed_) return;
  const QPointF moved = at - drag_from_;
  if (!dragging_ && std::hypot(moved.x(), moved.y()) < kDragStart_px) return;
  dragging_ = true;
  offset_ += moved;
  drag_from_ = at;
  keepInside();
  update();
}

void GraphView::mouseReleaseEvent(QMouseEvent* event) {
  if (pressed_ && !dragging_) {
    const QString name = nodeAt(event->pos());
    if (!name.isEmpty()) emit nodeClicked(name);
  }
  pressed_ = dragging_ = false;
}

void GraphView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (nodeAt(event->pos()).isEmpty()) fit();
}

Markup GraphView::tipFor(const QString& name) const {
  const FsmStateInfo* state = models_.fsm.state(name);
  if (!state) return {};
  Markup tip = markup(QStringLiteral("<b>%1</b> %2"), models_.fsm.label(name),
                      QString::fromStdString(state->doc));
  if (state->time_limit_s > 0) {
    tip += markup(tr("<br>time limit %1 s, then %2"), QString::number(state->time_limit_s),
                  models_.fsm.label(QString::fromStdString(state->timeout_target)));
  }
  const FsmModel::StateRecord record = models_.fsm.record(name);
  if (record.visits > 1)
    tip += markup(tr("<br>%1 visits, %2 s in all"), QString::number(record.visits),
                  QString::number(record.total_s, 'f', 1));
  QString why;
  if (!jump_.enterable(name, &why)) tip += markup(QStringLiteral("<br>%1"), why);
  return tip;
}

bool GraphView::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  const Markup tip = tipFor(nodeAt(help->pos()));
  if (tip.isEmpty())
    QToolTip::hideText();
  else
    showTip(help->globalPos(), tip, *this);
  return true;
}

}  // namespace kiln::gui

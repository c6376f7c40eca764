#include "gui/views/fsm_graph/graph_painter.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kRadius_px = 4.0;
constexpr int kLeastStretch_pct = 75;
/// A state with this many ways in or out (a fault that everything leads to) would cover the graph
/// with lines: they show once taken, from the current state and under the pointer.
constexpr int kHubEdges = 5;
constexpr double kRecentShare[] = {1.0, 0.55, 0.25, 0.12};

void arrowHead(QPainter& painter, const GraphGeometry::Edge& edge, const QColor& color,
               double size) {
  const QPointF side(-edge.direction.y(), edge.direction.x());
  const QPointF back = edge.head - edge.direction * size;
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  painter.drawPolygon(QPolygonF() << edge.head << back + side * size * 0.5
                                  << back - side * size * 0.5);
  painter.setBrush(Qt::NoBrush);
}

QString duration(double s) {
  if (s < 60) return QStringLiteral("%1 s").arg(s, 0, 'f', s < 10 ? 1 : 0);
  const int whole = static_cast<int>(s);
  return QStringLiteral("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}
}  // namespace

QStringList breakLabel(const QString& label, const QFont& font, double width_px) {
  const QFontMetricsF metrics(font);
  if (metrics.horizontalAdvance(label) <= width_px) return {label};
  QStringList best{label};
  double best_width = metrics.horizontalAdvance(label);
  for (int at = label.indexOf(QLatin1Char(' ')); at > 0;
       at = label.indexOf(QLatin1Char(' '), at + 1)) {
    const QStringList halves{label.left(at), label.mid(at + 1)};
    const double width =
        std::max(metrics.horizontalAdvance(halves[0]), metrics.horizontalAdvance(halves[1]));
    if (width >= best_width) continue;
    best_width = width;
    best = halves;
  }
  return best;
}

QFont narrowed(QFont font, const QStringList& lines, double width_px) {
  double widest_px = 0.0;
  for (const QString& line : lines)
    widest_px = std::max(widest_px, QFontMetricsF(font).horizontalAdvance(line));
  if (widest_px > width_px)
    font.setStretch(std::max(kLeastStretch_pct, static_cast<int>(100.0 * width_px / widest_px)));
  return font;
}

void GraphPainter::paint() {
  painter_.setRenderHint(QPainter::Antialiasing);
  lanes();
  edges();
  forcedEdges();
  for (std::size_t i = 0; i < in_.layout.nodes.size(); ++i)
    node(in_.layout.nodes[i], in_.geometry.nodes()[i]);
}

void GraphPainter::lanes() {
  const Palette& p = in_.theme.colors();
  painter_.setFont(in_.theme.font(TextRole::Small));
  for (std::size_t i = 0; i < in_.layout.lanes.size(); ++i) {
    const QRectF& lane = in_.geometry.lanes()[i];
    painter_.setPen(QPen(p.grid, 1));
    painter_.setBrush(p.sunk);
    painter_.drawRoundedRect(lane, kRadius_px, kRadius_px);
    painter_.setPen(p.dim);
    painter_.drawText(lane.adjusted(8, 2, -4, 0), Qt::AlignTop | Qt::AlignLeft,
                      in_.layout.lanes[i].title);
  }
}

GraphPainter::EdgeLook GraphPainter::lookOf(const FsmEdgeInfo& edge) const {
  const Palette& p = in_.theme.colors();
  const QString from = QString::fromStdString(edge.from);
  const QString to = QString::fromStdString(edge.to);
  const FsmModel& fsm = in_.models.fsm;
  const int taken = fsm.timesTaken(from, to);
  EdgeLook look{p.border, 1.0, edge.timeout ? Qt::DotLine : Qt::SolidLine};
  if (taken > 0)
    look = {p.faint, 1.6 + std::min(2.0, std::log2(static_cast<double>(taken))), Qt::SolidLine};
  if (from == fsm.current() || from == in_.hover || to == in_.hover) look.color = p.dim;
  if (fsm.visits().size() >= 2) {
    const auto& last = fsm.visits().back();
    const auto& before = fsm.visits()[fsm.visits().size() - 2];
    if (before.state == from && last.state == to && last.cause != TransitionCause::Operator) {
      look = {mixed(p.active, p.text, 0.25), 2.8, Qt::SolidLine};
    }
  }
  return look;
}

bool GraphPainter::hidden(const FsmEdgeInfo& edge) const {
  const QString from = QString::fromStdString(edge.from);
  const QString to = QString::fromStdString(edge.to);
  const FsmModel& fsm = in_.models.fsm;
  if (fsm.timesTaken(from, to) > 0) return false;
  for (const QString& end : {from, to}) {
    if (end == fsm.current() || end == in_.hover) return false;
  }
  const auto& edges = fsm.info()->edges;
  const auto into = std::count_if(edges.begin(), edges.end(),
                                  [&](const FsmEdgeInfo& e) { return e.to == edge.to; });
  const auto out = std::count_if(edges.begin(), edges.end(),
                                 [&](const FsmEdgeInfo& e) { return e.from == edge.from; });
  return std::max(into, out) >= kHubEdges;
}

void GraphPainter::edges() {
  const FsmInfo* info = in_.models.fsm.info();
  if (!info) return;
  std::vector<std::pair<EdgeLook, const FsmEdgeInfo*>> sorted;
  for (const FsmEdgeInfo& e : info->edges) {
    if (!hidden(e)) sorted.emplace_back(lookOf(e), &e);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first.width < b.first.width; });
  for (const auto& [look, e] : sorted) {
    const bool both =
        std::any_of(info->edges.begin(), info->edges.end(),
                    [&e = *e](const FsmEdgeInfo& o) { return o.from == e.to && o.to == e.from; });
    edge(QString::fromStdString(e->from), QString::fromStdString(e->to), both, look);
  }
}

void GraphPainter::forcedEdges() {
  const auto& visits = in_.models.fsm.visits();
  const Palette& p = in_.theme.colors();
  for (std::size_t i = 1; i < visits.size(); ++i) {
    if (visits[i].cause != TransitionCause::Operator) continue;
    edge(visits[i - 1].state, visits[i].state, true, {p.forced, 2.0, Qt::DashLine});
  }
  if (in_.jump.phase() == ForcedJump::Phase::Picked ||
      in_.jump.phase() == ForcedJump::Phase::Sent) {
    edge(in_.jump.from(), in_.jump.target(), true, {p.forced, 2.6, Qt::DashLine});
  }
}

void GraphPainter::edge(const QString& from, const QString& to, bool both, const EdgeLook& look) {
  const int a = in_.layout.index.value(from, -1);
  const int b = in_.layout.index.value(to, -1);
  if (a < 0 || b < 0 || a == b) return;
  const GraphGeometry::Edge shape = in_.geometry.edge(a, b, both);
  painter_.setBrush(Qt::NoBrush);
  painter_.setPen(QPen(look.color, look.width, look.style, Qt::FlatCap));
  painter_.drawPath(shape.path);
  arrowHead(painter_, shape, look.color, 5.5 + look.width * 1.4);
}

bool GraphPainter::dimmed(const QString& name) const {
  const bool choosing =
      in_.jump.phase() == ForcedJump::Phase::Armed || in_.jump.phase() == ForcedJump::Phase::Picked;
  if (choosing) return !in_.jump.enterable(name) && name != in_.models.fsm.current();
  return !in_.search.isEmpty() &&
         !in_.models.fsm.label(name).contains(in_.search, Qt::CaseInsensitive);
}

void GraphPainter::node(const GraphLayout::Node& node, const QRectF& box) {
  const Palette& p = in_.theme.colors();
  const FsmModel& fsm = in_.models.fsm;
  const FsmStateInfo* info = fsm.state(node.name);
  const int recency = fsm.recency(node.name);
  const bool current = node.name == fsm.current();
  const bool choosing =
      in_.jump.phase() == ForcedJump::Phase::Armed || in_.jump.phase() == ForcedJump::Phase::Picked;
  const bool chosen = choosing && in_.jump.target() == node.name;
  const bool faded = dimmed(node.name);
  QColor fill = p.panel;
  if (recency >= 0) fill = mixed(p.panel, p.recent, current ? 1.0 : kRecentShare[recency]);
  const bool bad_end = info && info->terminal && !info->success && current;
  if (bad_end) fill = p.fault_fill;
  QPen frame(p.border, 1.2);
  if (choosing && in_.jump.enterable(node.name)) frame = QPen(p.forced, chosen ? 3.0 : 1.8);
  if (current) frame = QPen(p.active_line, 2.2);
  if (!in_.search.isEmpty() && !faded) frame = QPen(p.caution, 2.0);
  painter_.setOpacity(faded ? 0.38 : 1.0);
  painter_.setPen(frame);
  painter_.setBrush(chosen ? p.forced_fill : fill);
  if (info && info->terminal)
    painter_.drawRoundedRect(box, box.height() / 2, box.height() / 2);
  else
    painter_.drawRoundedRect(box, kRadius_px, kRadius_px);

  const bool on_active = current && !bad_end && !chosen;
  const FsmModel::StateRecord record = fsm.record(node.name);
  const double seconds = current ? fsm.timeInStateS() : record.last_s;
  QString below;
  if (record.visits > 0)
    below = record.visits > 1 ? QStringLiteral("%1 · %2×").arg(duration(seconds)).arg(record.visits)
                              : duration(seconds);
  QFont label = in_.theme.font(TextRole::Small);
  label.setWeight(current ? QFont::DemiBold : QFont::Medium);
  painter_.setFont(label);
  painter_.setPen(on_active ? p.active_text : p.text);
  const QRectF text = box.adjusted(2, 1, -2, -2);
  QStringList lines = breakLabel(fsm.label(node.name), label, text.width());
  const QFont fitting = narrowed(label, lines, text.width());
  const QFontMetricsF metrics(fitting);
  painter_.setFont(fitting);
  // With a label of two lines the time goes behind the second, as far as there is room.
  if (lines.size() > 1 && !below.isEmpty()) {
    const QString joined =
        lines.last() + QStringLiteral(" · ") + below.section(QStringLiteral(" · "), 0, 0);
    if (metrics.horizontalAdvance(joined) <= text.width()) lines.last() = joined;
    below.clear();
  }
  for (QString& line : lines) line = metrics.elidedText(line, Qt::ElideRight, text.width());
  painter_.drawText(text, (below.isEmpty() ? Qt::AlignVCenter : Qt::AlignTop) | Qt::AlignHCenter,
                    lines.join(QLatin1Char('\n')));
  if (!below.isEmpty()) {
    painter_.setFont(in_.theme.font(TextRole::Small));
    painter_.setPen(on_active ? mixed(p.active, p.active_text, 0.85) : p.dim);
    painter_.drawText(text, Qt::AlignHCenter | Qt::AlignBottom, below);
  }
  if (info && !info->enterable) lock(box, choosing ? p.caution : p.faint);
  painter_.setOpacity(1.0);
}

void GraphPainter::lock(const QRectF& box, const QColor& color) {
  const QPointF at = box.topRight() + QPointF(-7, -2);  // on the rim: labels need the inside
  painter_.setPen(QPen(color, 1.2));
  painter_.setBrush(Qt::NoBrush);
  painter_.drawArc(QRectF(at + QPointF(-2.2, -2.5), QSizeF(4.4, 6)), 0, 180 * 16);
  painter_.setPen(Qt::NoPen);
  painter_.setBrush(color);
  painter_.drawRect(QRectF(at + QPointF(-3.5, 1), QSizeF(7, 5)));
}

}  // namespace kiln::gui

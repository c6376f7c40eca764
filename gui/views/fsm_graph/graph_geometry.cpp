#include "gui/views/fsm_graph/graph_geometry.h"

#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kMargin_px = 2.0;
constexpr double kLaneGap_px = 6.0;
constexpr double kHeader_px = 21.0;
constexpr double kMinPitch_px = 44.0;
constexpr double kMaxPitch_px = 92.0;
constexpr double kGutterShare = 0.075;
constexpr double kTwinOffset_px = 9.0;

GraphGeometry::Edge finish(QPainterPath path, QPointF head, QPointF direction) {
  const double length = std::hypot(direction.x(), direction.y());
  return {std::move(path), head, length > 0 ? direction / length : QPointF(0, 1)};
}
}  // namespace

GraphGeometry::GraphGeometry(const GraphLayout& layout, QSizeF available) {
  if (layout.nodes.empty()) return;
  const double column = std::max(kMinColumn_px, (available.width() - 2 * kMargin_px + kLaneGap_px) /
                                                    std::max(1, layout.columns));
  const double heads = layout.headers * (kHeader_px + kLaneGap_px);
  const double pitch =
      std::clamp((available.height() - 2 * kMargin_px - heads) / std::max(1, layout.rows),
                 kMinPitch_px, kMaxPitch_px);
  const double width = column - kLaneGap_px;
  gutter_ = std::max(9.0, width * kGutterShare);
  double bottom = 0.0;
  for (const GraphLayout::Lane& lane : layout.lanes) {
    const double top = kMargin_px + lane.above * (kHeader_px + kLaneGap_px) + lane.row * pitch;
    lanes_.emplace_back(kMargin_px + lane.column * column, top, lane.columns * column - kLaneGap_px,
                        kHeader_px + lane.rows * pitch);
    bottom = std::max(bottom, lanes_.back().bottom());
  }
  // Lanes that reach the lowest row of their column end together.
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    const bool last =
        std::none_of(layout.lanes.begin(), layout.lanes.end(), [&](const GraphLayout::Lane& other) {
          return other.column == layout.lanes[i].column && other.row > layout.lanes[i].row;
        });
    if (last) lanes_[i].setBottom(bottom);
  }
  for (const GraphLayout::Node& node : layout.nodes) {
    const auto& lane = layout.lanes[static_cast<std::size_t>(node.lane)];
    const double top =
        kMargin_px + lane.above * (kHeader_px + kLaneGap_px) + kHeader_px + node.row * pitch;
    nodes_.emplace_back(kMargin_px + node.column * column + gutter_, top + 2.0, width - 2 * gutter_,
                        kNodeHeight_px);
    cells_.emplace_back(node.column, node.row);
  }
  size_ = QSizeF(layout.columns * column - kLaneGap_px + 2 * kMargin_px, bottom + kMargin_px);
}

GraphGeometry::Edge GraphGeometry::along(int from, int to, bool both) const {
  const QRectF& a = nodes_[static_cast<std::size_t>(from)];
  const QRectF& b = nodes_[static_cast<std::size_t>(to)];
  const bool down = b.top() > a.top();
  const int rows = std::abs(cells_[static_cast<std::size_t>(from)].y() -
                            cells_[static_cast<std::size_t>(to)].y());
  if (rows == 1) {
    const double dx = both ? (down ? -kTwinOffset_px : kTwinOffset_px) : 0.0;
    const QPointF start(a.center().x() + dx, down ? a.bottom() : a.top());
    const QPointF head(b.center().x() + dx, down ? b.top() : b.bottom());
    QPainterPath path(start);
    path.lineTo(head);
    return finish(path, head, head - start);
  }
  // Past other boxes: down on the right, up on the left, further out the longer the way.
  const double side = down ? 1.0 : -1.0;
  const double x = down ? a.right() : a.left();
  const double reach = side * std::min(gutter_ - 2.0, 4.0 + 2.0 * rows) * 4.0 / 3.0;
  const QPointF start(x, a.center().y() + (down ? 8 : -8));
  const QPointF head(x, b.center().y() + (down ? -8 : 8));
  QPainterPath path(start);
  path.cubicTo(start + QPointF(reach, 0), head + QPointF(reach, 0), head);
  return finish(path, head, QPointF(-side, down ? 0.35 : -0.35));
}

GraphGeometry::Edge GraphGeometry::edge(int from, int to, bool both) const {
  const QRectF& a = nodes_[static_cast<std::size_t>(from)];
  const QRectF& b = nodes_[static_cast<std::size_t>(to)];
  if (cells_[static_cast<std::size_t>(from)].x() == cells_[static_cast<std::size_t>(to)].x())
    return along(from, to, both);
  const bool right = b.left() > a.left();
  const double dy = both ? (right ? -kTwinOffset_px : kTwinOffset_px) : 0.0;
  const QPointF start(right ? a.right() : a.left(), a.center().y() + dy);
  const QPointF head(right ? b.left() : b.right(), b.center().y() + dy);
  const double pull = std::max(14.0, std::abs(head.x() - start.x()) * 0.45) * (right ? 1.0 : -1.0);
  QPainterPath path(start);
  path.cubicTo(start + QPointF(pull, 0), head - QPointF(pull, 0), head);
  return finish(path, head, QPointF(pull, 0));
}

}  // namespace kiln::gui

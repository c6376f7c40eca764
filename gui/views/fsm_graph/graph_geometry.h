#pragma once

#include <QPainterPath>
#include <QRectF>
#include <QSizeF>
#include <vector>

#include "gui/views/fsm_graph/graph_layout.h"

namespace kiln::gui {

/// A layout stretched to a size, in pixels. Boxes never shrink below what a 9 pt label needs; a
/// graph that does not fit is larger than the view and is panned.
class GraphGeometry {
 public:
  static constexpr double kNodeHeight_px = 36.0;
  static constexpr double kMinColumn_px = 98.0;
  GraphGeometry() = default;
  GraphGeometry(const GraphLayout& layout, QSizeF size);
  [[nodiscard]] QSizeF size() const { return size_; }
  [[nodiscard]] const std::vector<QRectF>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<QRectF>& lanes() const { return lanes_; }
  /// Curve from one box to another and where its head points from.
  struct Edge {
    QPainterPath path;
    QPointF head;
    QPointF direction;  ///< unit, into the head
  };
  /// @param both  the opposite edge exists as well: keep to the side so that the two do not cover
  /// each other.
  [[nodiscard]] Edge edge(int from, int to, bool both) const;

 private:
  [[nodiscard]] Edge along(int from, int to, bool both) const;
  std::vector<QRectF> nodes_, lanes_;
  std::vector<QPoint> cells_;
  double gutter_ = 0.0;
  QSizeF size_;
};

}  // namespace kiln::gui

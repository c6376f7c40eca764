#pragma once

#include <QPainter>
#include <QStringList>

#include "gui/models/forced_jump.h"
#include "gui/models/station_models.h"
#include "gui/views/fsm_graph/graph_geometry.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// A label on one line if it fits, else broken at a space so that the longer half is as short as
/// can be.
[[nodiscard]] QStringList breakLabel(const QString& label, const QFont& font, double width_px);
/// Letters narrower by as much as the widest line needs, a quarter at most; never lower ones.
[[nodiscard]] QFont narrowed(QFont font, const QStringList& lines, double width_px);

/// Draws one frame of the graph in the layout's own pixels. Holds references for the length of one
/// paint.
class GraphPainter {
 public:
  struct Input {
    const Theme& theme;
    const StationModels& models;
    const ForcedJump& jump;
    const GraphLayout& layout;
    const GraphGeometry& geometry;
    QString search;
    QString hover;
  };
  GraphPainter(QPainter& painter, Input input) : painter_(painter), in_(std::move(input)) {}
  void paint();

 private:
  struct EdgeLook {
    QColor color;
    double width = 1.0;
    Qt::PenStyle style = Qt::SolidLine;
  };
  void lanes();
  void edges();
  void forcedEdges();
  [[nodiscard]] bool hidden(const FsmEdgeInfo& edge) const;
  void edge(const QString& from, const QString& to, bool both, const EdgeLook& look);
  [[nodiscard]] EdgeLook lookOf(const FsmEdgeInfo& edge) const;
  void node(const GraphLayout::Node& node, const QRectF& box);
  void lock(const QRectF& box, const QColor& color);
  [[nodiscard]] bool dimmed(const QString& name) const;
  QPainter& painter_;
  Input in_;
};

}  // namespace kiln::gui

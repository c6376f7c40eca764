#include "gui/views/fsm_graph/graph_layout.h"

#include <QFontMetricsF>
#include <set>

#include <gtest/gtest.h>

#include "gui/views/fsm_graph/graph_geometry.h"
#include "gui/views/fsm_graph/graph_painter.h"
#include "gui/widgets/theme.h"
#include "tests/support/test_robot.h"

namespace kiln::gui {
namespace {

const FsmInfo& fireGraph() {
  static const FsmInfo info = TestRobot().fsmInfo();
  return info;
}

TEST(GraphLayout, GivesEveryStateACellOfItsOwn) {
  const FsmInfo info = fireGraph();
  const GraphLayout layout = layoutGraph(info);
  ASSERT_EQ(layout.nodes.size(), info.states.size());
  std::set<std::pair<int, int>> cells;
  for (const auto& node : layout.nodes) {
    EXPECT_TRUE(cells.emplace(node.column, node.row).second) << node.name.toStdString();
  }
}

TEST(GraphLayout, ReadsDownwardsAlongTheUsualWay) {
  const GraphLayout layout = layoutGraph(fireGraph());
  const auto row = [&](const char* name) {
    return layout.nodes[static_cast<std::size_t>(layout.index.value(QString::fromLatin1(name)))]
        .row;
  };
  EXPECT_LT(row("EnterBuilding"), row("DriveToLocation"));
  EXPECT_LT(row("DriveToLocation"), row("ArmSearch"));
  EXPECT_LT(row("AimHose"), row("StartPump"));
  EXPECT_LT(row("SpraySteady"), row("SprayPattern"));
}

TEST(GraphLayout, SplitsALongLane) {
  FsmInfo info;
  info.start_state = "s0";
  for (int i = 0; i < 16; ++i) {
    FsmStateInfo state;
    state.name = "s" + std::to_string(i);
    state.group = "one";
    info.states.push_back(state);
  }
  const GraphLayout layout = layoutGraph(info, 7);
  EXPECT_EQ(layout.columns, 3);  // 16 states in columns of at most 7
  EXPECT_LE(layout.rows, 7);
}

TEST(GraphLayout, ToleratesAnEmptyGraphAndEdgesToNowhere) {
  EXPECT_TRUE(layoutGraph(FsmInfo{}).nodes.empty());
  FsmInfo info = fireGraph();
  info.edges.push_back({"EnterBuilding", "NoSuchState", false, ""});
  EXPECT_EQ(layoutGraph(info).nodes.size(), info.states.size());
}

TEST(GraphGeometry, LabelsFitTheirBoxesAtNinePointsInANarrowTile) {
  const FsmInfo info = fireGraph();
  const GraphLayout layout = layoutGraph(info);
  const GraphGeometry geometry(layout, QSizeF(336, 300));
  const Theme theme;
  QFont font = theme.font(TextRole::Small);
  ASSERT_GE(font.pointSizeF(), 9.0);
  font.setWeight(QFont::DemiBold);
  for (std::size_t i = 0; i < info.states.size(); ++i) {
    const int at = layout.index.value(QString::fromStdString(info.states[i].name));
    const double width = geometry.nodes()[static_cast<std::size_t>(at)].width() - 4;
    const QStringList lines = breakLabel(QString::fromStdString(info.states[i].label), font, width);
    const QFontMetricsF metrics(narrowed(font, lines, width));
    for (const QString& line : lines)
      EXPECT_LE(metrics.horizontalAdvance(line), width) << info.states[i].label;
  }
  for (std::size_t i = 0; i < geometry.nodes().size(); ++i) {
    for (std::size_t j = i + 1; j < geometry.nodes().size(); ++j) {
      EXPECT_FALSE(geometry.nodes()[i].intersects(geometry.nodes()[j]));
    }
  }
}

}  // namespace
}  // namespace kiln::gui

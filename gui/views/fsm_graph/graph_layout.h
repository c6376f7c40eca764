#pragma once

#include <QHash>
#include <QString>
#include <vector>

#include "common/model/fsm.h"

namespace kiln::gui {

/// Where every state stands, in cells. Swim lanes are the groups, side by side; short ones share a
/// column. Inside a lane states stand in the order in which a mission reaches them (breadth first
/// from the start), so that the usual way reads downwards. Pure function of the graph: positions
/// are the same in every run.
struct GraphLayout {
  struct Node {
    QString name;
    int column = 0;
    int row = 0;
    int lane = 0;
  };
  struct Lane {
    QString title;
    int column = 0, columns = 1;
    int row = 0, rows = 0;
    int above = 0;  ///< lanes stacked above this one in its column: each costs one header
  };
  std::vector<Node> nodes;
  std::vector<Lane> lanes;
  QHash<QString, int> index;  ///< name -> nodes
  int columns = 0;
  int rows = 0;     ///< of the tallest column
  int headers = 1;  ///< of the column with the most lanes
};

/// @param max_rows  a lane with more states than this becomes two or more columns wide.
[[nodiscard]] GraphLayout layoutGraph(const FsmInfo& info, int max_rows = 7);

}  // namespace kiln::gui

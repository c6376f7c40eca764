#include "gui/views/fsm_graph/graph_layout.h"

#include <algorithm>
#include <deque>
#include <limits>

namespace kiln::gui {

namespace {
/// Transitions from the start; time-outs count as a detour, so that the usual way comes first.
QHash<QString, int> depths(const FsmInfo& info) {
  constexpr int kDetour = 100;
  QHash<QString, int> depth;
  std::deque<QString> open;
  const QString start = QString::fromStdString(info.start_state);
  depth[start] = 0;
  open.push_back(start);
  while (!open.empty()) {
    const QString at = open.front();
    open.pop_front();
    for (const FsmEdgeInfo& edge : info.edges) {
      if (QString::fromStdString(edge.from) != at) continue;
      const QString to = QString::fromStdString(edge.to);
      const int d = depth[at] + (edge.timeout ? kDetour : 1);
      if (depth.contains(to) && depth[to] <= d) continue;
      depth[to] = d;
      open.push_back(to);
    }
  }
  return depth;
}

struct Group {
  QString title;
  std::vector<QString> states;
};

std::vector<Group> groupsOf(const FsmInfo& info) {
  std::vector<Group> groups;
  for (const FsmStateInfo& state : info.states) {
    const QString title = QString::fromStdString(state.group.empty() ? "mission" : state.group);
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.title == title; });
    if (found == groups.end()) found = groups.insert(groups.end(), Group{title, {}});
    found->states.push_back(QString::fromStdString(state.name));
  }
  const QHash<QString, int> depth = depths(info);
  const auto depthOf = [&](const QString& s) {
    return depth.value(s, std::numeric_limits<int>::max());
  };
  for (Group& group : groups) {
    std::stable_sort(group.states.begin(), group.states.end(),
                     [&](const QString& a, const QString& b) { return depthOf(a) < depthOf(b); });
  }
  return groups;
}
}  // namespace

GraphLayout layoutGraph(const FsmInfo& info, int max_rows) {
  GraphLayout layout;
  int next_column = 0;
  int used_rows = 0;     // of the newest column
  int used_headers = 0;  // of the newest column
  bool may_stack = false;
  for (const Group& group : groupsOf(info)) {
    const int count = static_cast<int>(group.states.size());
    const int columns = (count + max_rows - 1) / max_rows;
    const int rows = (count + columns - 1) / columns;
    GraphLayout::Lane lane{group.title, 0, columns, 0, rows, 0};
    if (may_stack && columns == 1 && used_rows + rows <= max_rows) {
      lane.column = next_column - 1;
      lane.row = used_rows;
      lane.above = used_headers;
      used_rows += rows;
      ++used_headers;
    } else {
      lane.column = next_column;
      next_column += columns;
      used_rows = rows;
      used_headers = 1;
    }
    may_stack = columns == 1;
    for (int i = 0; i < count; ++i) {
      const QString& name = group.states[static_cast<std::size_t>(i)];
      layout.index[name] = static_cast<int>(layout.nodes.size());
      layout.nodes.push_back({name, lane.column + i / rows, lane.row + i % rows,
                              static_cast<int>(layout.lanes.size())});
    }
    layout.rows = std::max(layout.rows, lane.row + rows);
    layout.headers = std::max(layout.headers, used_headers);
    layout.lanes.push_back(lane);
  }
  layout.columns = next_column;
  return layout;
}

}  // namespace kiln::gui

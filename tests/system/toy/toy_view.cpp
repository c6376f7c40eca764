#include "tests/system/toy/toy_view.h"

namespace kiln::toy {

MissionInfo missionInfo() {
  MissionInfo info;
  info.title = "A metre of driving";
  FigureSpec drives{"toy.drives", "Drives", "", 0};
  drives.top_bar = true;
  info.figures = {drives};
  info.layers = {{"toy.goal", "Toy's goal"}};
  CommandSpec push{kPush, "Push", "It drives farther."};
  push.while_stopped = true;
  push.arguments = {{"by", "m", 0.0, 0.5, "on top of what is configured"}};
  info.commands = {push};
  info.panels = {"toy.card"};
  return info;
}

std::vector<Figure> figures(int drives) { return {{"toy.drives", static_cast<double>(drives)}}; }

std::vector<SceneItem> items(const Pose2& X_map_goal) {
  SceneItem box;
  box.id = "goal";
  box.layer = "toy.goal";
  box.shape = SceneItem::Shape::Box;
  box.style = ItemStyle::Planned;
  box.X_map_item = toIsometry(X_map_goal);
  box.size = Eigen::Vector3d(1.9, 1.4, 0.1);
  return {box};
}

}  // namespace kiln::toy

#pragma once

#include <QRectF>
#include <deque>
#include <functional>
#include <vector>

#include "gui/models/command_model.h"
#include "gui/widgets/theme.h"

class QPainter;

namespace kiln::gui {

struct CommandMark {
  double x;        ///< pixels
  double name_px;  ///< width of its name
};
struct CommandName {
  std::size_t mark;  ///< index
  double left;       ///< pixels
};
/// Where names stand: directly behind their own mark, else directly before it, the newest first. A
/// name for which there is no such room is left out: beside another mark it would be read as that
/// one's.
/// @param marks  from left to right.
/// @param left, right  ends of the lane.
[[nodiscard]] std::vector<CommandName> placeCommandNames(const std::vector<CommandMark>& marks,
                                                         double left, double right);

/// One mark a command at the time it was sent: a disc when it went well, a ring while it is open, a
/// cross when it was refused or nobody knows; beside it its name, as placeCommandNames() says.
/// @param area  the lane; `x_of` gives the pixel of a station time on it.
void paintCommandLane(QPainter& painter, const QRectF& area, const Theme& theme,
                      const std::deque<TrackedCommand>& commands,
                      const std::function<double(Stamp)>& x_of);

}  // namespace kiln::gui

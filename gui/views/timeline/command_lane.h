#pragma once

#include <QRectF>
#include <deque>
#include <functional>

#include "gui/models/command_model.h"
#include "gui/widgets/theme.h"

class QPainter;

namespace kiln::gui {

/// One mark a command at the time it was sent: a disc when it went well, a ring while it is open, a
/// cross when it was refused or nobody knows; beside it what it was, the newest first, and never
/// over another mark or text.
/// @param area  the lane; `x_of` gives the pixel of a station time on it.
void paintCommandLane(QPainter& painter, const QRectF& area, const Theme& theme,
                      const std::deque<TrackedCommand>& commands,
                      const std::function<double(Stamp)>& x_of);

}  // namespace kiln::gui

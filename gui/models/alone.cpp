#include "gui/models/alone.h"

#include <QCoreApplication>

namespace kiln::gui {

QString whatItDoesAlone(const RobotStatus& last) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("Alone", text); };
  if (last.stop.latched) return tr("it stays stopped");
  if (last.mode == Mode::Teleop)
    return tr("it has ended what was done by hand and stands, pumps off");
  if (last.phase == MissionPhase::Running || last.phase == MissionPhase::Waiting)
    return tr("its mission GOES ON by itself: it may move and spray");
  return tr("it stands and holds");
}

}  // namespace kiln::gui

#pragma once

#include <QCoreApplication>

#include "gui/models/station_models.h"
#include "tests/gui/support/direct_link.h"

namespace kiln::gui {

/// A station on a robot whose time moves only when told; no timers needed.
class SteppedStation {
 public:
  explicit SteppedStation(bool sensors = false) : link(sensors) { link.open(); }
  /// Lets robot and station time pass, then the models speak.
  void pass(double seconds) {
    link.advance(seconds);
    QCoreApplication::sendPostedEvents();
    models.flush();
    emit models.aged();
  }
  /// Until what was sent is answered.
  void settle() {
    link.advance(0.02);
    QCoreApplication::sendPostedEvents();
    models.flush();
  }
  void takeLease() {
    models.lease.request();
    settle();
  }
  void startMission() {
    link.robot().startMission();
    pass(0.2);
  }
  DirectLink link;
  StationModels models{link};
};

}  // namespace kiln::gui

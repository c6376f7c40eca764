#pragma once

#include <QCoreApplication>

#include "gui/link/fake_link.h"
#include "gui/models/station_models.h"

namespace kiln::gui {

/// A station on a fake robot whose time moves only when told; no sensors, no timers needed.
class SteppedStation {
 public:
  SteppedStation() { link.open(); }
  /// Lets robot and station time pass, then everything queued arrive and the models speak.
  void pass(double seconds) {
    link.advance(seconds);
    settle();
    emit models.aged();
  }
  void settle() {
    QCoreApplication::sendPostedEvents();
    models.flush();
  }
  void takeLease() {
    models.lease.request();
    settle();
  }
  FakeLink link{{1, 1.0, false, false, false}};
  StationModels models{link};
};

}  // namespace kiln::gui

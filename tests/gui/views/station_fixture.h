#pragma once

#include <QCoreApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>

#include <gtest/gtest.h>

#include "gui/views/teleop/hold_to_run.h"
#include "gui/widgets/theme.h"
#include "tests/gui/views/qt_app.h"
#include "tests/gui/views/scripted_link.h"

namespace kiln::gui {

/// A station on a scripted link: by default in Teleop, with the lease and a fresh cloud, so that
/// everything is allowed.
class StationTest : public testing::Test {
 protected:
  StationTest() {
    status.mode = Mode::Teleop;
    status.word = StatusWord::Teleop;
    status.lease.holder_client = "me";
    status.lease.holder_name = "Ada";
    health.state = LinkState::Up;
    health.rtt_s = 0.02;
    feed();
  }

  /// The robot speaks, now.
  void feed(bool with_cloud = true) {
    const Stamp now = link.time.now();
    status.stamp = now;
    emit link.health(health);
    emit link.status(std::make_shared<RobotStatus>(status));
    if (with_cloud) {
      auto cloud = std::make_shared<PointCloud>();
      cloud->stamp = now;
      cloud->frame = "map";
      cloud->push(1, 0, 0, 0, 0, 0);
      emit link.cloud(cloud);
    }
    models.flush();
  }

  template <class T>
  [[nodiscard]] const T* lastSetpoint() const {
    return link.setpoints.empty() ? nullptr : std::get_if<T>(&link.setpoints.back());
  }

  static void key(QWidget& to, QEvent::Type type, int code,
                  Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool auto_repeat = false) {
    QKeyEvent event(type, code, modifiers, QString(), auto_repeat);
    QCoreApplication::sendEvent(&to, &event);
  }

  static void mouse(QWidget& to, QEvent::Type type, const QPointF& at) {
    const bool down = type != QEvent::MouseButtonRelease;
    QMouseEvent event(type, at, to.mapToGlobal(at.toPoint()),
                      type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton,
                      down ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&to, &event);
  }

  QApplication& app = testApp();
  Theme theme;
  ScriptedLink link;
  RobotStatus status;
  LinkHealth health;
  StationModels models{link};
  HoldToRun hold{models};
  Ui ui{theme, link.time};
};

}  // namespace kiln::gui

#pragma once

#include <QObject>
#include <QTimer>
#include <vector>

#include "gui/models/station_models.h"

class QWidget;

namespace kiln::gui {

/// Measures how long a press of the STOP key takes to latch on the robot, through everything that a
/// real press goes through after the window system: event queue, window, stop lane, robot and its
/// answer. Presses, waits for the answer, takes the lease, clears, and presses again. `kiln-eval
/// stop` runs it.
class StopProbe : public QObject {
  Q_OBJECT
 public:
  StopProbe(QWidget& window, StationModels& models, int presses, QObject* parent = nullptr);
  [[nodiscard]] const std::vector<double>& latchS() const { return latch_s_; }

 signals:
  void finished();

 private:
  enum class Step { Connect, Press, AwaitLatch, TakeLease, Clear, AwaitClear };
  void step();
  void onLane(const StopLane& lane);
  void enter(Step step);

  QWidget& window_;
  StationModels& models_;
  int presses_;
  Step step_ = Step::Connect;
  bool sent_ = false;
  Stamp entered_, pressed_;
  QTimer timer_;
  std::vector<double> latch_s_;
};

}  // namespace kiln::gui

#pragma once

#include <QObject>
#include <QTimer>
#include <vector>

#include "gui/models/station_models.h"

class QWidget;

namespace kiln::gui {

/// Measures how long a press of the STOP key takes to latch on the robot, through everything that a
/// real press goes through after the window system: event queue, window, stop lane, robot and its
/// answer. Presses, waits for the answer to that very press, takes the lease, clears, and presses
/// again. `kiln-eval stop` runs it.
///
/// Each step has a limit; one that is not reached ends the probe with a sentence that names it.
class StopProbe : public QObject {
  Q_OBJECT
 public:
  StopProbe(QWidget& window, StationModels& models, int presses, QObject* parent = nullptr);
  [[nodiscard]] const std::vector<double>& latchS() const { return latch_s_; }
  /// Looks once whether the present step is reached; its timer calls it at 50 Hz.
  void step();

 signals:
  void finished();
  void failed(const QString& reason);

 private:
  enum class Step { Connect, Press, AwaitLatch, AwaitStatus, TakeLease, Clear };
  void onLane(const StopLane& lane);
  void enter(Step step);
  void press();
  void ask();
  [[nodiscard]] bool reached() const;
  [[nodiscard]] Step next() const;
  [[nodiscard]] QString waitingFor() const;

  QWidget& window_;
  StationModels& models_;
  int presses_;
  Step step_ = Step::Connect;
  std::uint64_t press_ = 0;  ///< number of the press that is timed
  Stamp entered_, asked_, pressed_;
  QTimer timer_;
  std::vector<double> latch_s_;
};

}  // namespace kiln::gui

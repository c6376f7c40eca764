#pragma once

#include <QString>
#include <QTimer>
#include <vector>

#include "common/core/clock.h"

namespace kiln::gui {

/// Measures the gaps of the event loop with a 10 ms heartbeat: how long the window would not have
/// answered a key.
/// The GUI thread's own processor time in each gap tells work in the station from a machine that
/// had no core free.
class StallMeter : public QObject {
  Q_OBJECT
 public:
  static constexpr int kBeat_ms = 10;
  static constexpr double kLimit_s = 0.100;
  explicit StallMeter(const Clock& clock, QObject* parent = nullptr);
  void start();
  [[nodiscard]] double worstS() const { return worst_s_; }
  [[nodiscard]] int above() const { return above_; }
  /// "event loop: 1234 beats, worst gap 23 ms, p99 14 ms, 0 above 100 ms"
  [[nodiscard]] QString report() const;

 private:
  void beat();
  const Clock& clock_;
  QTimer timer_;
  Stamp last_;
  std::vector<int> histogram_;  ///< by millisecond, the last bin open
  double cpu_s_ = 0.0;          ///< GUI thread's processor time at the last beat
  double worst_busy_s_ = 0.0;
  int busy_above_ = 0;
  double worst_s_ = 0.0;
  std::uint64_t beats_ = 0;
  int above_ = 0;
};

}  // namespace kiln::gui

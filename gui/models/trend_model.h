#pragma once

#include <deque>
#include <map>
#include <string>

#include "gui/models/model.h"

namespace kiln::gui {

/// Samples of the timeline's plots over the last kWindow_s, in robot time.
class TrendModel : public Model {
  Q_OBJECT
 public:
  static constexpr double kWindow_s = 900.0;
  struct Sample {
    Stamp stamp;
    double value = 0.0;
  };
  using Series = std::deque<Sample>;

  explicit TrendModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const Series& rttS() const { return rtt_; }  ///< heartbeat round trip, seconds
  /// Of a figure that the mission wants plotted; empty for another.
  [[nodiscard]] const Series& figure(const std::string& id) const;
  [[nodiscard]] const Series& armForceN() const {
    return force_;
  }  ///< norm of the tool force, newton

 private:
  static void add(Series& series, Stamp stamp, double value);
  void addFigures(const RobotStatus& status);
  Series rtt_, force_;
  std::map<std::string, Series> figures_;  ///< of the plotted ones
};

}  // namespace kiln::gui

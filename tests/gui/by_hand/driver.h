#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>

#include "common/geom/pose.h"
#include "tests/gui/by_hand/hand.h"

namespace kiln::gui {

/// Drives the base by the jog keys and by what the window tells in figures.
class Driver {
 public:
  struct Tolerance {
    double m, rad;
    bool rest = true;  ///< and stand there
  };
  Driver(Hand& hand, QWidget& window) : hand_(hand), window_(window) {}
  /// Position and heading in map, as the scene's chip has them.
  [[nodiscard]] std::optional<Pose2> pose() const;
  [[nodiscard]] std::optional<double> speedMps() const;
  /// The way to the nearest work pose, from the line over the tanks; zero when it says so.
  struct Way {
    QString place;
    Pose2 X_base_work;
  };
  [[nodiscard]] std::optional<Way> wayToWork() const;
  /// Pulls the speed slider to about this share. @return what it says then.
  int setSpeed(int percent);
  bool driveTo(const Pose2& X_map_goal, const Tolerance& within, double limit_s);
  /// To the work pose of `place`, which must be the nearest one.
  bool driveToWork(const QString& place, const Tolerance& within, double limit_s);

 private:
  /// What was read when.
  struct Reading {
    double at_s;
    Pose2 to_go;
  };
  /// @param to_go  from the base, in base; nullopt: cannot be read, so nothing is pressed.
  bool drive(const std::function<std::optional<Pose2>()>& to_go, const Tolerance& within,
             double limit_s);
  using Errors = std::array<double, 3>;  ///< ahead, left, turn: where it comes to rest by itself
  void steer(const Tolerance& within, bool moving);
  /// Far off: keys down along the way, short taps for what is off beside it.
  void travel(const Errors& rest);
  /// Near: one direction after the other, standing in between.
  void approach(const Errors& rest, const Errors& dead, bool moving);
  void press(std::size_t axis, int sign);
  Hand& hand_;
  QWidget& window_;
  std::deque<Reading> read_;
  Errors tapped_until_s_{};
  std::optional<std::size_t> axis_;  ///< along which it approaches now
};

}  // namespace kiln::gui

#pragma once

#include <QPointF>
#include <Qt>
#include <set>

#include "common/geom/pose.h"

namespace kiln::gui {

/// Keys that jog, by what is down now: presses and releases, never auto-repeat.
///   base: W S forward/back, A D left/right, Q E turn left/right
///   arm:  arrows in the plane, PageUp/PageDown up/down; with Shift the same keys turn the tool
class JogKeys {
 public:
  /// @return true if the key jogs (it is then consumed).
  bool press(int key, bool auto_repeat);
  bool release(int key, bool auto_repeat);
  void setShift(bool down) { shift_ = down; }
  void clear();
  [[nodiscard]] bool any() const { return !down_.empty(); }
  [[nodiscard]] static bool jogs(int key);

  /// Each axis -1, 0 or 1; opposite keys cancel.
  [[nodiscard]] Eigen::Vector3d base() const;     ///< forward, left, turn left
  [[nodiscard]] Eigen::Vector3d armMove() const;  ///< forward, left, up; zero while Shift is down
  [[nodiscard]] Eigen::Vector3d armTurn()
      const;  ///< about forward, left, up; zero while Shift is up

 private:
  [[nodiscard]] double axis(int plus, int minus) const;
  [[nodiscard]] Eigen::Vector3d arrows() const;
  std::set<int> down_;
  bool shift_ = false;
};

}  // namespace kiln::gui

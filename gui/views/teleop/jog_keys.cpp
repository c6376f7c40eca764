#include "gui/views/teleop/jog_keys.h"

#include <algorithm>
#include <array>

namespace kiln::gui {
namespace {
constexpr std::array kKeys{static_cast<int>(Qt::Key_W),      static_cast<int>(Qt::Key_S),
                           static_cast<int>(Qt::Key_A),      static_cast<int>(Qt::Key_D),
                           static_cast<int>(Qt::Key_Q),      static_cast<int>(Qt::Key_E),
                           static_cast<int>(Qt::Key_Up),     static_cast<int>(Qt::Key_Down),
                           static_cast<int>(Qt::Key_Left),   static_cast<int>(Qt::Key_Right),
                           static_cast<int>(Qt::Key_PageUp), static_cast<int>(Qt::Key_PageDown)};
}

bool JogKeys::jogs(int key) { return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end(); }

bool JogKeys::press(int key, bool auto_repeat) {
  if (!jogs(key)) return false;
  if (!auto_repeat) down_.insert(key);
  return true;
}

bool JogKeys::release(int key, bool auto_repeat) {
  if (!jogs(key)) return false;
  if (!auto_repeat) down_.erase(key);
  return true;
}

void JogKeys::clear() {
  down_.clear();
  shift_ = false;
}

double JogKeys::axis(int plus, int minus) const {
  return static_cast<double>(down_.count(plus)) - static_cast<double>(down_.count(minus));
}

Eigen::Vector3d JogKeys::base() const {
  return {axis(Qt::Key_W, Qt::Key_S), axis(Qt::Key_A, Qt::Key_D), axis(Qt::Key_Q, Qt::Key_E)};
}

Eigen::Vector3d JogKeys::arrows() const {
  return {axis(Qt::Key_Up, Qt::Key_Down), axis(Qt::Key_Left, Qt::Key_Right),
          axis(Qt::Key_PageUp, Qt::Key_PageDown)};
}

Eigen::Vector3d JogKeys::armMove() const {
  return shift_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : arrows();
}
Eigen::Vector3d JogKeys::armTurn() const {
  if (!shift_) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d k = arrows();
  return {k.z(), -k.x(), k.y()};  // PageUp rolls, up lifts the nose, left turns left
}

}  // namespace kiln::gui

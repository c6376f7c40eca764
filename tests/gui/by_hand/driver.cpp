#include "tests/gui/by_hand/driver.h"

#include <QElapsedTimer>
#include <QRegularExpression>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "gui/panels/fire/work_pose.h"
#include "gui/views/scene3d/pose_chip.h"
#include "gui/views/teleop/teleop_tile.h"

namespace kiln::gui {

namespace {
constexpr double kReaction_s = 0.30;  // from what is true to the key that is let go
constexpr double kBrake_mps2 = 1.5, kBrake_radps2 = 1.5;
constexpr double kStill_mps = 0.03, kStill_s = 0.4;
constexpr double kRate_s = 0.3;  // over which the eye judges how fast something changes
constexpr double kDead = 0.4;    // of a tolerance: so far off no key is pressed
constexpr double kFar_m = 0.5;   // from here on one direction after the other
constexpr double kOff_m = 0.07, kOff_rad = 3.0 * kDeg, kTap_s = 0.15, kBetweenTaps_s = 0.9;
constexpr double kStuck_s = 0.7, kAgain_s = 0.1;
constexpr int kHandle_px = 14;

double number(const QString& sign, const QString& digits) {
  return (sign == QStringLiteral("−") ? -1.0 : 1.0) * digits.toDouble();
}

/// Where it comes to rest when all keys are let go now.
double atRest(double to_go, double closing, double brake) {
  return to_go - closing * kReaction_s - closing * std::abs(closing) / (2.0 * brake);
}
}  // namespace

std::optional<Pose2> Driver::pose() const {
  static const QRegularExpression kPose(
      QStringLiteral("x ([+−])([0-9.]+) m\\s*y ([+−])([0-9.]+) m\\s*yaw ([+−])([0-9]+)°"));
  const auto found = kPose.match(hand_.read<PoseChip>());
  if (!found.hasMatch()) return std::nullopt;
  return Pose2{number(found.captured(1), found.captured(2)),
               number(found.captured(3), found.captured(4)),
               number(found.captured(5), found.captured(6)) * kDeg};
}

std::optional<double> Driver::speedMps() const {
  static const QRegularExpression kSpeed(QStringLiteral("([0-9.]+) m/s"));
  const auto found = kSpeed.match(hand_.read<PoseChip>());
  if (!found.hasMatch()) return std::nullopt;
  return found.captured(1).toDouble();
}

std::optional<Driver::Way> Driver::wayToWork() const {
  static const QRegularExpression kWay(QStringLiteral(
      "^(.+): ([0-9.]+) m (ahead|back), ([0-9.]+) m (left|right), turn ([0-9]+)° (left|right)"));
  static const QRegularExpression kThere(QStringLiteral("^(.+): at its work pose"));
  const QString line = hand_.read<WorkPoseLine>();
  if (const auto there = kThere.match(line); there.hasMatch())
    return Way{there.captured(1), Pose2{}};
  const auto found = kWay.match(line);
  if (!found.hasMatch()) return std::nullopt;
  const auto side = [&](int digits, const char* minus) {
    const double value = found.captured(digits).toDouble();
    return found.captured(digits + 1) == QLatin1String(minus) ? -value : value;
  };
  return Way{found.captured(1), Pose2{side(2, "back"), side(4, "right"), side(6, "right") * kDeg}};
}

int Driver::setSpeed(int percent) {
  hand_.letGo();
  auto* slider = window_.findChild<TeleopTile*>()->findChild<QSlider*>();
  const auto at = [&](int value) {
    const double share =
        double(value - slider->minimum()) / (slider->maximum() - slider->minimum());
    return QPoint(kHandle_px / 2 + static_cast<int>(share * (slider->width() - kHandle_px)),
                  slider->height() / 2);
  };
  hand_.drag(*slider, at(slider->value()), at(percent));
  hand_.look(0.5);  // the robot confirms it
  static const QRegularExpression kPercent(QStringLiteral("([0-9]+) %"));
  return kPercent.match(hand_.read<TeleopTile>()).captured(1).toInt();
}

void Driver::press(std::size_t axis, int sign) {
  static constexpr std::array<char, 3> kPlus{'w', 'a', 'q'}, kMinus{'s', 'd', 'e'};
  hand_.key(kPlus[axis], sign > 0);
  hand_.key(kMinus[axis], sign < 0);
}

void Driver::steer(const Tolerance& within, bool moving) {
  const Reading &then = read_.front(), &now = read_.back();
  const double dt = std::max(1e-3, now.at_s - then.at_s);
  const auto rest = [&](double before, double to_go, double brake) {
    return atRest(to_go, (before - to_go) / dt, brake);
  };
  const Errors errors{rest(then.to_go.x_m, now.to_go.x_m, kBrake_mps2),
                      rest(then.to_go.y_m, now.to_go.y_m, kBrake_mps2),
                      rest(then.to_go.yaw_rad, now.to_go.yaw_rad, kBrake_radps2)};
  if (std::max(std::abs(errors[0]), std::abs(errors[1])) > kFar_m) {
    axis_.reset();
    travel(errors);
  } else {
    approach(errors, {kDead * within.m, kDead * within.m, kDead * within.rad}, moving);
  }
}

void Driver::travel(const Errors& rest) {
  const double now_s = read_.back().at_s;
  for (std::size_t axis = 0; axis < rest.size(); ++axis) {
    const int sign = rest[axis] > 0.0 ? 1 : -1;
    if (axis < 2 && std::abs(rest[axis]) > kFar_m) {
      press(axis, sign);
      continue;
    }
    const double off = axis < 2 ? kOff_m : kOff_rad;
    if (now_s < tapped_until_s_[axis]) continue;
    const bool rested = now_s > tapped_until_s_[axis] + kBetweenTaps_s;
    if (rested && std::abs(rest[axis]) > off) {
      press(axis, sign);
      tapped_until_s_[axis] = now_s + kTap_s;
    } else {
      press(axis, 0);
    }
  }
}

void Driver::approach(const Errors& rest, const Errors& dead, bool moving) {
  const auto ratio = [&](std::size_t axis) { return std::abs(rest[axis]) / dead[axis]; };
  if (axis_ && ratio(*axis_) < 1.0) axis_.reset();
  if (!axis_ && !moving) {
    std::size_t worst = 0;
    for (const std::size_t axis : {1, 2})
      if (ratio(axis) > ratio(worst)) worst = axis;
    if (ratio(worst) >= 1.0) axis_ = worst;
  }
  for (std::size_t axis = 0; axis < rest.size(); ++axis)
    press(axis, axis_ != axis ? 0 : rest[axis] > 0.0 ? 1 : -1);
}

bool Driver::drive(const std::function<std::optional<Pose2>()>& to_go, const Tolerance& within,
                   double limit_s) {
  QElapsedTimer timer, still, stuck;
  timer.start();
  read_.clear();
  tapped_until_s_ = {};
  axis_.reset();
  while (timer.elapsed() < 1000 * limit_s) {
    const auto left = to_go();
    const bool there = left && std::hypot(left->x_m, left->y_m) <= within.m &&
                       std::abs(left->yaw_rad) <= within.rad;
    if (there && !within.rest) return true;  // on with the same keys
    const bool moving = speedMps().value_or(1.0) > kStill_mps;
    if (left) {
      read_.push_back({1e-3 * double(timer.elapsed()), *left});
      while (read_.size() > 2 && read_[1].at_s < read_.back().at_s - kRate_s) read_.pop_front();
    }
    if (!left || there)
      hand_.letGo();
    else
      steer(within, moving);
    if (there && !moving) {
      if (!still.isValid()) still.start();
      if (still.elapsed() > 1000 * kStill_s) return true;
    } else {
      still.invalidate();
    }
    // A key that was let go by the window itself (no fresh view, busy) has to be pressed anew.
    if (moving || !hand_.presses()) {
      stuck.restart();
    } else if (stuck.elapsed() > 1000 * kStuck_s) {
      hand_.letGo();
      hand_.look(kAgain_s);
      stuck.restart();
    }
    hand_.look(0.04);
  }
  hand_.letGo();
  return false;
}

bool Driver::driveTo(const Pose2& X_map_goal, const Tolerance& within, double limit_s) {
  return drive(
      [&]() -> std::optional<Pose2> {
        const auto X_map_base = pose();
        if (!X_map_base) return std::nullopt;
        return inverse(*X_map_base) * X_map_goal;
      },
      within, limit_s);
}

bool Driver::driveToWork(const QString& place, const Tolerance& within, double limit_s) {
  return drive(
      [&]() -> std::optional<Pose2> {
        const auto way = wayToWork();
        if (!way || way->place != place) return std::nullopt;
        return way->X_base_work;
      },
      within, limit_s);
}

}  // namespace kiln::gui

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
constexpr double kFullSpeed_mps = 1.0, kFullTurn_radps = 0.6;  // at 100 % of the speed scale
constexpr double kReaction_s = 0.25;  // from what is true to the key that is let go
constexpr double kBrake_mps2 = 1.5;
constexpr double kStill_mps = 0.03, kStill_s = 0.4;
constexpr int kHandle_px = 14;

double number(const QString& sign, const QString& digits) {
  return (sign == QStringLiteral("−") ? -1.0 : 1.0) * digits.toDouble();
}

/// What is left when the key is let go now.
double runOut(double speed) { return kReaction_s * speed + 0.5 * speed * speed / kBrake_mps2; }
}  // namespace

std::optional<Pose2> Driver::pose() const {
  static const QRegularExpression kPose(
      QStringLiteral("x ([+−])([0-9.]+) m\\s+y ([+−])([0-9.]+) m\\s+yaw ([+−])([0-9]+)°"));
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
  percent_ = kPercent.match(hand_.read<TeleopTile>()).captured(1).toInt();
  return percent_;
}

void Driver::steer(const Pose2& to_go, const Tolerance& within) {
  const double scale = 0.01 * percent_;
  const double moving = std::min(kFullSpeed_mps * scale, speedMps().value_or(0.0) + 0.1);
  const double stop_m = std::max(0.4 * within.m, runOut(moving));
  const double stop_rad = std::max(0.4 * within.rad, kReaction_s * kFullTurn_radps * scale);
  const auto press = [&](double error, double stop, char plus, char minus) {
    hand_.key(plus, error > stop);
    hand_.key(minus, error < -stop);
  };
  press(to_go.x_m, stop_m, 'w', 's');
  press(to_go.y_m, stop_m, 'a', 'd');
  press(to_go.yaw_rad, stop_rad, 'q', 'e');
}

bool Driver::drive(const std::function<std::optional<Pose2>()>& to_go, const Tolerance& within,
                   double limit_s) {
  QElapsedTimer timer, still;
  timer.start();
  while (timer.elapsed() < 1000 * limit_s) {
    const auto left = to_go();
    const bool there = left && std::hypot(left->x_m, left->y_m) <= within.m &&
                       std::abs(left->yaw_rad) <= within.rad;
    if (!left || there)
      hand_.letGo();
    else
      steer(*left, within);
    if (!there || speedMps().value_or(1.0) > kStill_mps)
      still.invalidate();
    else if (!still.isValid())
      still.start();
    else if (still.elapsed() > 1000 * kStill_s)
      return true;
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

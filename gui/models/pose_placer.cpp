#include "gui/models/pose_placer.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln::gui {

namespace {
constexpr double kStandstill_mps = 0.02;
constexpr double kStandstill_radps = 0.03;
}  // namespace

PosePlacer::PosePlacer(StationModels& models, QObject* parent) : QObject(parent), models_(models) {
  connect(&models_.commands, &CommandModel::progressed, this, &PosePlacer::onProgress);
  connect(&models_, &StationModels::aged, this, &PosePlacer::watchExpiry);
}

bool PosePlacer::mayStart(QString* why) const {
  const auto refuse = [why](const QString& text) {
    if (why) *why = text;
    return false;
  };
  QString reason;
  // A latched stop does not forbid it: setting the pose moves nothing.
  if (!models_.mayCommand(&reason) && !models_.stop.latched()) return refuse(reason);
  if (models_.link.readOnly()) return refuse(tr("this is a recording"));
  if (!models_.lease.mine()) return refuse(tr("needs the lease: request it in the top bar"));
  const FsmStatus* fsm = models_.fsm.status();
  if (fsm && fsm->running && !fsm->paused) return refuse(tr("a mission runs: pause it first"));
  const RobotStatus* status = models_.status.status();
  if (status && !(std::hypot(status->twist.vx_mps, status->twist.vy_mps) <= kStandstill_mps &&
                  std::abs(status->twist.wz_radps) <= kStandstill_radps)) {
    return refuse(tr("the robot moves: wait for standstill"));
  }
  return true;
}

void PosePlacer::go(Phase phase) {
  phase_ = phase;
  touched_ = models_.clock().now();
  emit changed();
}

void PosePlacer::start() {
  reason_.clear();
  if (!mayStart(&reason_)) return go(Phase::Refused);
  if (const RobotStatus* status = models_.status.status())
    pose_.yaw_rad = status->X_map_base.yaw_rad;
  go(Phase::Armed);
}

void PosePlacer::press(double x_m, double y_m) {
  if (phase_ == Phase::Idle || phase_ == Phase::Sent) return;
  if (!std::isfinite(x_m) || !std::isfinite(y_m)) return;
  pose_.x_m = x_m;
  pose_.y_m = y_m;
  reason_.clear();
  go(Phase::Placed);
}

void PosePlacer::drag(double x_m, double y_m) {
  if (phase_ != Phase::Placed) return;
  const double dx = x_m - pose_.x_m, dy = y_m - pose_.y_m;
  if (!(std::hypot(dx, dy) >= kLeastDrag_m)) return;
  pose_.yaw_rad = std::atan2(dy, dx);
  go(Phase::Placed);
}

void PosePlacer::confirm() {
  if (phase_ != Phase::Placed) return;
  if (!mayStart(&reason_)) return go(Phase::Refused);
  go(Phase::Sent);
  nonce_ = models_.commands.send(SetPose{pose_}, tr("set pose to %1, %2 m, %3°")
                                                     .arg(pose_.x_m, 0, 'f', 2)
                                                     .arg(pose_.y_m, 0, 'f', 2)
                                                     .arg(pose_.yaw_rad / kDeg, 0, 'f', 0));
  if (const TrackedCommand* command = models_.commands.find(nonce_)) onProgress(*command);
}

void PosePlacer::cancel() {
  if (phase_ == Phase::Idle) return;
  reason_.clear();
  go(Phase::Idle);
}

void PosePlacer::onProgress(const TrackedCommand& command) {
  if (phase_ != Phase::Sent || command.nonce != nonce_) return;
  if (command.bad()) {
    reason_ = toText(command.state) + QStringLiteral(": ") + command.reason;
    return go(Phase::Refused);
  }
  if (command.state == CommandState::Done || command.state == CommandState::Accepted)
    go(Phase::Idle);
}

void PosePlacer::watchExpiry() {
  if (phase_ == Phase::Idle || phase_ == Phase::Sent) return;
  if (toSeconds(models_.clock().now() - touched_) > kExpiry_s) cancel();
}

}  // namespace kiln::gui

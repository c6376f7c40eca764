#include "tests/fuzz/drill.h"

namespace kiln {

void Drill::write(double vx_mps, Stamp now) const {
  const bool works = vx_mps != 0.0;
  if (works && moves) moves();
  BaseSetpoint drive;
  drive.stamp = now;
  drive.twist.vx_mps = vx_mps;
  base->setpoint(drive);
  ArmSetpoint turn;
  turn.kind = works ? ArmSetpoint::Kind::JointVelocity : ArmSetpoint::Kind::Hold;
  turn.stamp = now;
  turn.qd[5] = vx_mps;
  arm->setpoint(turn);
  PumpSetpoint spray;
  spray.stamp = now;
  spray.duty.fill(works ? 1.0 : 0.0);
  pumps->setpoint(spray);
}

Transition DrillWork::execute() {
  context().write(0.3, now());
  if (context().finished) return transit<DrillDone>();
  return timeInState() > std::chrono::milliseconds(500) ? transit<DrillRest>() : stay();
}

Transition DrillRest::execute() {
  context().write(-0.3, now());
  return timeInState() > std::chrono::milliseconds(200) ? transit<DrillWork>() : stay();
}

}  // namespace kiln

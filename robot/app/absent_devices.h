#pragma once

#include "robot/hal/arm.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/pumps.h"

namespace kiln {

/// In place of what is not attached, e.g. while recorded sensor data is shown without a robot: no
/// state, and every command is refused with what to do about it.
struct AbsentDevices {
  static tl::unexpected<Error> refuse() {
    return makeError(ErrorCode::Unavailable,
                     "no robot is attached; start kiln-robotd with --sim ENDPOINT");
  }
  struct AbsentArm final : Arm {
    [[nodiscard]] std::optional<ArmState> state() const override { return std::nullopt; }
    Result<void> servo(const ArmServo&) override { return refuse(); }
    Result<void> releaseProtectiveStop() override { return refuse(); }
    Result<void> setPayload(const ArmPayload&) override { return refuse(); }
    Result<void> zeroForceSensor() override { return refuse(); }
  } arm;
  struct AbsentBase final : DriveBase {
    [[nodiscard]] std::optional<BaseState> state() const override { return std::nullopt; }
    Result<void> write(const WheelCommands&) override { return refuse(); }
  } base;
  struct AbsentPumps final : Pumps {
    [[nodiscard]] std::optional<PumpsState> state() const override { return std::nullopt; }
    Result<void> write(const std::array<double, 2>&) override { return refuse(); }
  } pumps;
};

}  // namespace kiln

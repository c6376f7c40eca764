#pragma once

#include "common/core/error.h"
#include "common/model/sensor.h"
#include "kiln/v1/device.pb.h"
#include "robot/hal/device_set.h"
#include "robot/hal/gripper.h"
#include "robot/hal/storage.h"

namespace kiln {

/// The world's messages as model values. `shift` maps world time to the daemon's clock (zero in
/// lockstep). Arrays that do not fit together are refused with the name of the message.
[[nodiscard]] Result<ArmState> armFromProto(const v1::device::Report& report, Duration shift);
[[nodiscard]] Result<BaseState> baseFromProto(const v1::device::Report& report, Duration shift);
[[nodiscard]] Result<PumpsState> pumpsFromProto(const v1::device::Report& report, Duration shift);
[[nodiscard]] Result<PointCloudPtr> cloudFromProto(const v1::device::LidarScan& scan,
                                                   Duration shift);
[[nodiscard]] Result<ThermalImagePtr> thermalFromProto(const v1::device::ThermalFrame& frame,
                                                       Duration shift);
/// @param camera  its frame
[[nodiscard]] Result<RgbImagePtr> colourFromProto(const v1::device::ColourFrame& frame,
                                                  const char* camera, Duration shift);
[[nodiscard]] Result<GripperState> gripperFromProto(const v1::device::Report& report,
                                                    Duration shift);
[[nodiscard]] Result<StorageState> storageFromProto(const v1::device::Report& report,
                                                    Duration shift);

/// A device of a newer world that this robot does not know is left out.
[[nodiscard]] DeviceSet devicesFromProto(const v1::device::HelloReply& reply);

}  // namespace kiln

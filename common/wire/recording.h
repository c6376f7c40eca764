#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/device_sample.h"

/// model <-> recording.proto.
namespace kiln::wire {

[[nodiscard]] std::string encode(const DeviceSample& sample);
/// Error: InvalidInput for what cannot be parsed and for numbers that are not finite.
[[nodiscard]] Result<DeviceSample> decodeDeviceSample(std::string_view bytes);

}  // namespace kiln::wire

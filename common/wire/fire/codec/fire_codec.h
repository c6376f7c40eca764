#pragma once

#include <string_view>

#include "common/core/error.h"
#include "common/model/mission.h"
#include "common/wire/fire/fire_model.h"

/// model <-> kiln/fire/v1/fire.proto, as the details of a mission. Decoders answer corrupt input
/// with an Error.
namespace kiln::wire {

[[nodiscard]] MissionDetail encodeDetail(const FireSite& site);
[[nodiscard]] MissionDetail encodeDetail(const HeatDetections& detections);

[[nodiscard]] Result<FireSite> decodeFireSite(std::string_view bytes);
[[nodiscard]] Result<HeatDetections> decodeHeat(std::string_view bytes);

}  // namespace kiln::wire

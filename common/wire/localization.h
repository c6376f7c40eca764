#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/model/localization.h"

/// model <-> localization.proto. Decoders answer corrupt input with an Error.
namespace kiln::wire {

[[nodiscard]] std::string encode(const LocalizationStatus& status);
/// Points at 1 cm, within 327 m of the origin of map; at most kMaxMapLayerPoints of them.
[[nodiscard]] std::string encode(const MapLayer& layer);
[[nodiscard]] std::string encode(const Trajectory& trajectory);

[[nodiscard]] Result<LocalizationStatus> decodeLocalization(std::string_view bytes);
[[nodiscard]] Result<MapLayer> decodeMapLayer(std::string_view bytes);
[[nodiscard]] Result<Trajectory> decodeTrajectory(std::string_view bytes);

}  // namespace kiln::wire

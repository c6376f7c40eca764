#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/mission.h"
#include "common/model/scene.h"
#include "common/wire/fire/fire_model.h"

/// How the fire mission describes itself: the one place for its ids.
namespace kiln::fire {

inline constexpr const char* kSiteSchema = "kiln.fire.v1.FireSite";
inline constexpr const char* kHeatSchema = "kiln.fire.v1.HeatDetections";

inline constexpr const char* kNudgePlace = "nudge_place";  ///< arguments x, y (m) and yaw (deg)
inline constexpr const char* kContinueDespite = "continue_despite";

/// What the mission brings; whose run it is, the caller adds.
/// @param max_nudge_m  each axis, at a time
[[nodiscard]] MissionInfo missionInfo(double max_nudge_m, double max_nudge_deg);
/// @param peak_k  hottest pixel of the newest image; NaN: none
/// @param score   estimate, points of Challenge 3
[[nodiscard]] std::vector<Figure> figures(const WaterLevels& water, double score, double peak_k);
/// Back from figures(); what is not among them stays zero.
[[nodiscard]] WaterLevels waterLevels(const std::vector<Figure>& figures);
[[nodiscard]] std::vector<SceneItem> sceneItems(const FireSite& site);

/// Where the predicted jet hits. In `map`, metres.
struct JetAim {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  std::string place;  ///< whose plate it passes by kNearPlate_m at most; empty: none, its end
  /// Of the plate's centre, seen by who looks at it: where the heat was found, else as configured.
  double left_m = 0.0;
  double up_m = 0.0;  ///< above it
};
inline constexpr double kNearPlate_m = 0.6;
/// @return nullopt without a jet.
[[nodiscard]] std::optional<JetAim> jetAim(const FireSite& site);

/// The front frame of a place (place_check.h) from its configured plate.
[[nodiscard]] Eigen::Isometry3d frontOf(const FirePlaceInfo& place);
/// A place's box and the way its opening looks.
[[nodiscard]] std::vector<SceneItem> boxItems(const std::string& id,
                                              const Eigen::Isometry3d& X_map_front, ItemStyle style,
                                              double width_px);

}  // namespace kiln::fire

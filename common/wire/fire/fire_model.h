#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/core/stamp.h"
#include "common/geom/pose.h"
#include "common/wire/fire/place_check.h"

namespace kiln {

/// Why a warm blob is not taken for the fire.
enum class HeatRejection {
  None,
  TooCool,
  Reflection,
  Flame,
  Frozen,
  TooSmall,
  OutsideGeofence,
  NotLinear
};
[[nodiscard]] std::string_view toString(HeatRejection rejection);

/// A warm blob in one thermal image. Pixels; kelvin.
struct HeatBlob {
  double u = 0.0, v = 0.0;                         ///< intensity-weighted centre
  int u_min = 0, v_min = 0, u_max = 0, v_max = 0;  ///< bounding box, inclusive
  double peak_k = 0.0;
  double background_k = 0.0;
  double half_max_area_px = 0.0;  ///< area above half of (peak - background)
  HeatRejection rejection = HeatRejection::None;
  std::string reason;  ///< one sentence for the operator when rejected
};

/// Result of one thermal image.
struct HeatDetections {
  Stamp stamp;  ///< of the image
  std::uint64_t image_seq = 0;
  bool usable = true;  ///< false: frozen or not TLinear; `refusal` says why
  std::string refusal;
  double threshold_k = 0.0;
  double max_k = 0.0;
  std::vector<HeatBlob> blobs;  ///< accepted first, by peak
  double cost_ms = 0.0;         ///< filled outside lockstep only
};

/// Position of the heat source, fused over the sweep. In `map`.
struct FireEstimate {
  Stamp stamp;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  int views = 0;
  double peak_k = 0.0;
  double range_m = 0.0;           ///< from the thermal camera at the last view
  double baseline_range_m = 0.0;  ///< the paper's bounding-box method, for comparison
  std::string place;              ///< configured fire place it belongs to, may be empty
};

/// Configured fire place.
struct FirePlaceInfo {
  std::string name;
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< expected plate centre
  double yaw_rad = 0.0;                             ///< direction in which the opening looks
  bool visited = false;
  Pose2 nudge{};  ///< what the operator has moved it by so far; contained in p_map and yaw_rad
  std::optional<Pose2> X_map_work{};  ///< base where the robot works at it; nullopt: not told
};

/// What the mission knows of its places, for scene and panels; mirrors kiln.fire.v1.FireSite.
struct FireSite {
  static constexpr double kBox_m = 0.4;     ///< edge of a place's box (scenario.md section 3)
  static constexpr double kRecess_m = 0.1;  ///< of the plate behind the box's outer face

  Stamp stamp;
  std::vector<FireEstimate> fires;
  std::vector<FirePlaceInfo> places;
  std::vector<Eigen::Vector3d> jet_map;  ///< predicted jet, metres
  bool spraying = false;
  std::vector<PlaceCheck> place_checks;  ///< newest of each place that was looked at
  Eigen::Vector2d footprint_m =
      Eigen::Vector2d::Zero();  ///< of the base, along X and Y; 0: not told
};

/// Tanks and pumps, left and right. Litres are the pump model times time: there is no flow sensor.
struct WaterLevels {
  std::array<double, 2> duty{};
  std::array<double, 2> current_a{};
  std::array<double, 2> tank_l_est{};
  double sprayed_l_est = 0.0;  ///< whole mission
};

}  // namespace kiln

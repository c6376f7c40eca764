#pragma once

/// The register of frame names. `X_parent_child` maps points from child to parent; adjacent words
/// cancel: X_map_lidar = X_map_base * X_base_lidar. Every frame is right-handed, metres, Z up
/// unless said otherwise. Camera convention: X right, Y down, Z viewing.
///
/// | frame           | origin and axes                                    | may jump              |
/// |-----------------|----------------------------------------------------|-----------------------|
/// | map             | arena; Z up; fixed to the building's nominal model | never                 |
/// | odom            | where the wheel odometry started                   | at a reset; drifts    |
/// | base            | robot's centre on the ground, X forward, Y left    | at corrections in map |
/// | arm_base        | mounting flange of the UR10e on the deck           | fixed in base         |
/// | flange          | UR tool flange (DH frame 6), Z out of the flange   | continuous            |
/// | tool            | centre of the end-effector's magnet face           | fixed in flange       |
/// | lidar           | VLP-16 optical centre, X forward, Z along its spin | fixed in flange       |
/// | thermal         | Lepton optical centre, camera convention           | fixed in flange       |
/// | rgb             | head Brio, camera convention                       | fixed in flange       |
/// | operator_camera | rear-top Brio for situational awareness, likewise  | fixed in base         |
/// | nozzle          | nozzle exit, X along the jet at the exit           | fixed in flange       |
namespace kiln::frames {
inline constexpr const char* kMap = "map";
inline constexpr const char* kOdom = "odom";
inline constexpr const char* kBase = "base";
inline constexpr const char* kArmBase = "arm_base";
inline constexpr const char* kFlange = "flange";
inline constexpr const char* kTool = "tool";
inline constexpr const char* kLidar = "lidar";
inline constexpr const char* kThermal = "thermal";
inline constexpr const char* kRgb = "rgb";
inline constexpr const char* kOperatorCamera = "operator_camera";
inline constexpr const char* kNozzle = "nozzle";
}  // namespace kiln::frames

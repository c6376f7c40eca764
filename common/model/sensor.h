#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/stamp.h"
#include "common/geom/camera_model.h"
#include "common/geom/pose.h"

namespace kiln {

/// One LiDAR sweep. Arrays of equal length N; structure of arrays so that codecs and filters stay
/// branch-free.
struct PointCloud {
  Stamp stamp;  ///< time of the first point
  std::uint64_t seq = 0;
  std::string frame;                    ///< frames.h word
  std::vector<float> x, y, z;           ///< metres in `frame`; NaN = no return
  std::vector<std::uint8_t> intensity;  ///< 0-100 diffuse, 101-255 retro-reflector
  std::vector<std::uint8_t> ring;       ///< 0 lowest .. 15 highest laser
  std::vector<float> time_offset_s;     ///< after `stamp`, per point
  [[nodiscard]] std::size_t size() const { return x.size(); }
  void reserve(std::size_t n);
  void push(float px, float py, float pz, std::uint8_t i, std::uint8_t r, float dt_s);
};
using PointCloudPtr = std::shared_ptr<const PointCloud>;

enum class FfcState : std::uint8_t { Never, Imminent, Running, Complete };

/// One Lepton frame. Values are raw counts; only with `tlinear` are they hundredths of a kelvin.
struct ThermalImage {
  Stamp stamp;
  std::uint64_t seq = 0;  ///< host counter
  std::uint32_t frame_counter =
      0;  ///< the camera's own (telemetry words 20-21); stands still when frozen
  int width = 160;
  int height = 120;
  std::vector<std::uint16_t> counts;  ///< row-major, width * height
  bool tlinear = true;
  double kelvin_per_count = 0.01;  ///< meaningful if tlinear
  bool agc = false;
  FfcState ffc = FfcState::Complete;
  [[nodiscard]] double kelvin(int u, int v) const {
    return counts[static_cast<std::size_t>(v * width + u)] * kelvin_per_count;
  }
};
using ThermalImagePtr = std::shared_ptr<const ThermalImage>;

struct RgbImage {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::string frame;  ///< "rgb" or "operator_camera"
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> data;  ///< row-major RGB, 3 bytes a pixel
};
using RgbImagePtr = std::shared_ptr<const RgbImage>;

/// A colour picture as it travels: JPEG bytes, encoded on the robot, decoded by the station's own
/// thread.
struct JpegImage {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::string frame;  ///< "rgb" or "operator_camera"
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> jpeg;
};
using JpegImagePtr = std::shared_ptr<const JpegImage>;

enum class ArmSafetyMode : std::uint8_t { Normal, Reduced, ProtectiveStop, EmergencyStop, Fault };

struct ArmState {
  Stamp stamp;
  std::uint64_t seq = 0;
  Vector6d q = Vector6d::Zero();   ///< rad, UR order: shoulder pan .. wrist 3
  Vector6d qd = Vector6d::Zero();  ///< rad/s
  Vector6d wrench_tool =
      Vector6d::Zero();  ///< external force N (0..2) and torque Nm (3..5) at the tool, in base
                         ///< orientation of arm_base, payload compensated
  ArmSafetyMode safety = ArmSafetyMode::Normal;
  bool powered = true;
};

/// Wheel order everywhere: front-left, front-right, rear-left, rear-right.
struct WheelState {
  double steer_rad = 0.0;
  double drive_radps = 0.0;
  double drive_angle_rad = 0.0;  ///< accumulated, for odometry
  double drive_current_a = 0.0;  ///< of the hub motor, sign of its torque
};
struct BaseState {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::array<WheelState, 4> wheels{};
  double battery_v = 0.0;
  double battery_a = 0.0;
};

/// What the Nano reports.
struct PumpsState {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::array<double, 2> duty{};  ///< 0..1 as applied, left and right
  std::array<double, 2> current_a{};
  bool contact_switch = false;
  bool heartbeat_lost = false;  ///< firmware cut the pumps by itself
};

}  // namespace kiln

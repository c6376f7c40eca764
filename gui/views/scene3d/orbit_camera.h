#pragma once

#include <optional>

#include <Eigen/Geometry>

namespace kiln::gui {

/// Where the scene is looked at from. Frame: map, metres, radians. Up is always +Z.
/// Free and Follow orbit round `target`; Top looks straight down, parallel, with map X up the
/// screen.
class OrbitCamera {
 public:
  enum class Mode { Follow, Top, Free };

  /// 3/4 view from behind and beside the robot.
  void reset(const Eigen::Vector3d& robot);
  void setMode(Mode mode);
  [[nodiscard]] Mode mode() const { return mode_; }
  /// Follow and Top keep the robot at the same place of the picture; Free stays.
  void robotAt(const Eigen::Vector3d& robot);

  /// Drag by pixels; Follow keeps following, from another side. Top pans instead.
  void orbit(double dx_px, double dy_px, int height_px);
  /// Moves the picture with the mouse; Follow becomes Free and Top stays where it is put, since the
  /// operator wants to look elsewhere. setMode() follows again.
  void pan(double dx_px, double dy_px, int height_px);
  /// Turns to a point and stays there until setMode(); metres from it.
  void lookAt(const Eigen::Vector3d& target, double distance);
  /// One wheel notch is +-1; positive comes nearer.
  void zoom(double notches);

  [[nodiscard]] bool parallel() const { return mode_ == Mode::Top; }
  [[nodiscard]] const Eigen::Vector3d& target() const { return target_; }
  [[nodiscard]] Eigen::Vector3d position() const;
  [[nodiscard]] Eigen::Vector3d up() const;
  [[nodiscard]] double fieldOfView() const { return kFieldOfView; }  ///< vertical, radians
  /// Half the height of the picture in metres, at the target.
  [[nodiscard]] double halfHeight() const;
  /// Pixel of a point, origin top left. nullopt behind the camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_map, int width_px,
                                                       int height_px) const;
  /// Where the ray through a pixel meets the kitchen floor (z = 0 of map); nullopt if it does not,
  /// or only beyond 200 m.
  [[nodiscard]] std::optional<Eigen::Vector2d> groundPoint(const Eigen::Vector2d& pixel,
                                                           int width_px, int height_px) const;

 private:
  static constexpr double kFieldOfView = 0.6;
  Mode mode_ = Mode::Follow;
  bool centred_ = true;  ///< on the robot; until panned
  Eigen::Vector3d target_{0, 0, 0.6};
  double azimuth_ = 3.7;    ///< of the camera as seen from the target
  double elevation_ = 0.6;  ///< above the horizon
  double distance_ = 11.0;
};

}  // namespace kiln::gui

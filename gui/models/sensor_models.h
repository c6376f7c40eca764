#pragma once

#include <vector>

#include "gui/models/model.h"

namespace kiln::gui {

/// Newest LiDAR sweep, in the frame it names.
class CloudModel : public Model {
  Q_OBJECT
 public:
  explicit CloudModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const PointCloudPtr& cloud() const { return cloud_; }  ///< may be null

 private:
  PointCloudPtr cloud_;
};

/// Newest thermal image. The age is that of the image; a frozen camera that repeats one frame grows
/// old although frames arrive.
class ThermalModel : public Model {
  Q_OBJECT
 public:
  explicit ThermalModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const ThermalImagePtr& image() const { return image_; }  ///< may be null
  /// Seconds since the picture last moved on (the camera's own counter), < 0 before the first.
  [[nodiscard]] double frozenS() const;

 private:
  ThermalImagePtr image_;
  Stamp advanced_;
};

/// Newest picture of one camera.
class CameraModel : public Model {
  Q_OBJECT
 public:
  /// @param frame  which camera: "operator_camera" or "rgb" (the head's).
  CameraModel(Link& link, std::string frame, QObject* parent = nullptr);
  [[nodiscard]] const RgbImagePtr& image() const { return image_; }  ///< may be null

 private:
  std::string frame_;
  RgbImagePtr image_;
};

/// Overlay of the scene, and the path that the robot has driven as this station saw it.
class SceneModel : public Model {
  Q_OBJECT
 public:
  static constexpr std::size_t kMaxDriven = 4000;
  static constexpr double kDrivenSpacing_m = 0.05;
  explicit SceneModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const {
    return scene_;
  }  ///< may be null
  [[nodiscard]] const std::vector<Pose2>& driven() const { return driven_; }

 private:
  void addPose(const Pose2& X_map_base);
  std::shared_ptr<const Scene> scene_;
  std::vector<Pose2> driven_;
};

}  // namespace kiln::gui

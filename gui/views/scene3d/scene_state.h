#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "common/model/localization.h"
#include "common/model/scene.h"
#include "common/model/status.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln::gui {

/// The layers of every robot; missions add theirs (LayerSpec). Walls: the nominal building. Map:
/// points of the surfel map that the robot localises on.
enum class SceneLayer { Robot, Lidar, Map, Walls, Planned, Driven };
inline constexpr std::size_t kSceneLayers = 6;
[[nodiscard]] const char* toString(SceneLayer layer);  ///< what the operator reads

/// Missing: never came. Aging and Stale: too old by the limits of console.md section 4.4.
enum class Freshness { Missing, Fresh, Aging, Stale };

struct LayerState {
  bool visible = true;
  double age_s = -1.0;  ///< < 0: no data yet
  Freshness freshness = Freshness::Missing;
  std::uint64_t revision = 0;  ///< counts changes of the layer's content
};

struct MissionLayer {
  LayerSpec spec;
  LayerState state;
};

/// Everything that is drawn, as plain values; cheap to copy (clouds are shared). Frame: map.
struct SceneSnapshot {
  bool robot_known = false;
  Pose2 X_map_base;
  /// From base on the ground plane to base as it stands: height, roll and pitch on a slope.
  Eigen::Isometry3d X_ground_base = Eigen::Isometry3d::Identity();
  Vector6d q = Vector6d::Zero();
  std::array<double, 4> steer{};
  std::shared_ptr<const MapLayer> map;
  int submap = -1;  ///< index of the part in use; < 0: unknown, all alike
  LocalizationHealth health = LocalizationHealth::Good;
  Eigen::Matrix2d covariance_xy = Eigen::Matrix2d::Zero();  ///< of X_map_base, m^2
  PointCloudPtr cloud;
  Eigen::Isometry3d X_map_cloud = Eigen::Isometry3d::Identity();
  std::vector<SceneBox> arena;
  PathInfo planned;
  std::vector<std::vector<Eigen::Vector2d>> driven;  ///< one line for each life between resets
  std::array<LayerState, kSceneLayers> layers{};
  std::vector<MissionLayer> mission_layers;
  std::vector<SceneItem> items;
  std::uint64_t items_revision = 0;  ///< counts changes of the items and of their layers
  [[nodiscard]] Eigen::Isometry3d robotPose() const {
    return toIsometry(X_map_base) * X_ground_base;
  }
  [[nodiscard]] const LayerState& layer(SceneLayer l) const {
    return layers[static_cast<std::size_t>(l)];
  }
  /// Of an item; a layer that the mission has not told of is shown.
  [[nodiscard]] const LayerState& layer(const std::string& mission_layer) const;
};

/// Gathers what the models deliver into one picture of the world, remembers the driven path and
/// grows old by layers. Without Qt and without a renderer; confined to the GUI thread.
class SceneState {
 public:
  struct Config {
    double aging_s = 1.5;             ///< desaturated from here
    double stale_s = 3.0;             ///< outlined and labelled with its age from here
    double trail_step_m = 0.05;       ///< distance between points of the driven path
    std::size_t trail_points = 6000;  ///< whole path; the oldest points go first
    std::size_t pose_history = 40;    ///< status messages kept to place a cloud at its own time
  };
  SceneState(Config config, RobotGeometry geometry)
      : config_(config), geometry_(std::move(geometry)) {}

  void setStatus(const RobotStatus& status);
  /// Placed by the pose nearest in time to the cloud's stamp. Clouds in map, base or lidar are
  /// understood; another frame is refused with a sentence in cloudRefusal().
  void setCloud(PointCloudPtr cloud);
  void setScene(const Scene& scene);
  /// The layers of the mission; one that was there before stays shown or hidden.
  void setMission(const MissionInfo& info);
  void setLocalization(const LocalizationStatus& status);
  void setMap(std::shared_ptr<const MapLayer> map);
  /// What the robot remembers of its way replaces what this station has seen of it.
  void setTrajectory(const Trajectory& trajectory);
  /// Forgets the way and the poses: what follows is of another time.
  void restart();
  /// @param age_s  since the data arrived; < 0: never.
  void setAge(SceneLayer layer, double age_s);
  void setMissionAge(double age_s);  ///< of all that the mission draws
  void setVisible(SceneLayer layer, bool visible);
  void setVisible(const std::string& mission_layer, bool visible);
  [[nodiscard]] const std::string& cloudRefusal() const { return cloud_refusal_; }
  [[nodiscard]] const SceneSnapshot& snapshot() const { return snapshot_; }
  [[nodiscard]] const RobotGeometry& geometry() const { return geometry_; }

 private:
  struct PoseAt {
    Stamp stamp;
    Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();
    Vector6d q = Vector6d::Zero();
  };
  void refreshSubmap();
  LayerState& layer(SceneLayer l) { return snapshot_.layers[static_cast<std::size_t>(l)]; }
  void touch(SceneLayer l);
  [[nodiscard]] Freshness freshnessAt(double age_s) const;
  void extendTrail(const RobotStatus& status);
  void trimTrail();
  [[nodiscard]] const PoseAt* poseNear(Stamp stamp) const;

  Config config_;
  RobotGeometry geometry_;
  SceneSnapshot snapshot_;
  std::deque<PoseAt> poses_;
  std::string cloud_refusal_;
  bool cloud_waits_ = false;  ///< drawn round the origin until a pose is known
  std::string submap_name_;
  int resets_ = 0;
};

}  // namespace kiln::gui

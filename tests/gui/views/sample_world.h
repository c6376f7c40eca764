#pragma once

#include "common/model/scene.h"
#include "common/model/sensor.h"
#include "common/model/status.h"
#include "common/robot_model/robot_geometry.h"
#include "common/wire/fire/fire_model.h"
#include "robot/scene/fire_site_map.h"

namespace kiln::gui {

/// A believable moment of the fire mission for tests, benches and pictures: the nominal kitchen,
/// Bob in front of the first place, a LiDAR sweep cast against the boxes, a thermal image with a
/// hot plate and a reflection. Deterministic.
class SampleWorld {
 public:
  SampleWorld();  ///< loads the shipped robot and arena files
  [[nodiscard]] const RobotGeometry& robot() const { return robot_; }
  /// @param t_s  moves robot and arm along.
  [[nodiscard]] RobotStatus status(Stamp stamp, double t_s) const;
  /// Tanks and pumps of that moment.
  [[nodiscard]] WaterLevels water() const;
  [[nodiscard]] MissionInfo mission() const;
  /// @param columns  rays a ring; 1800 gives about 28,800 points.
  [[nodiscard]] PointCloudPtr cloud(const RobotStatus& status, int columns) const;
  [[nodiscard]] Scene scene(Stamp stamp, const RobotStatus& status, bool spraying) const;
  [[nodiscard]] ThermalImagePtr thermal(Stamp stamp, std::uint32_t counter) const;
  [[nodiscard]] HeatDetections heat(const ThermalImage& image) const;
  [[nodiscard]] RgbImagePtr picture(Stamp stamp, std::uint64_t seq) const;
  [[nodiscard]] std::vector<MacroInfo> macros() const;

 private:
  RobotGeometry robot_;
  ArenaMap arena_;
  FireSiteMap site_;
  std::vector<SceneBox> boxes_;
};

}  // namespace kiln::gui

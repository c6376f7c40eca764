#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/geom/camera_model.h"
#include "common/model/scene.h"
#include "common/model/sensor.h"
#include "common/wire/fire/fire_model.h"
#include "gui/link/fake_robot.h"

namespace kiln::gui {

/// Pictures of the fake arena: rays against axis-aligned boxes and the floor. Deterministic in
/// (robot, seq).
[[nodiscard]] PointCloudPtr makeFakeCloud(const FakeRobot& robot,
                                          std::uint64_t seq);  ///< in `lidar`, 16 x 900
[[nodiscard]] ThermalImagePtr makeFakeThermal(const FakeRobot& robot, std::uint64_t seq);
[[nodiscard]] HeatDetections makeFakeHeat(const FakeRobot& robot, const ThermalImage& image);
[[nodiscard]] RgbImagePtr makeFakeCamera(const FakeRobot& robot,
                                         std::uint64_t seq);  ///< operator camera, 320 x 180

}  // namespace kiln::gui

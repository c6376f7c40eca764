#include "robot/app/recorded_sensors.h"

#include "robot/drivers/lepton/device/lepton_file_camera.h"
#include "robot/drivers/velodyne/device/velodyne_file_lidar.h"

namespace kiln {

Result<void> RecordedSensors::open(const std::string& lidar_path, const std::string& thermal_folder,
                                   Executor& executor) {
  if (!lidar_path.empty()) {
    auto lidar = VelodyneFileLidar::open(lidar_path, executor);
    if (!lidar) return tl::make_unexpected(lidar.error());
    lidar_ = std::move(*lidar);
  }
  if (!thermal_folder.empty()) {
    auto thermal = LeptonFileCamera::open(thermal_folder, executor);
    if (!thermal) return tl::make_unexpected(thermal.error());
    thermal_ = std::move(*thermal);
  }
  return {};
}

}  // namespace kiln

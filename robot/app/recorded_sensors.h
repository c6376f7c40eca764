#pragma once

#include <memory>
#include <string>

#include "common/core/executor.h"
#include "robot/hal/lidar.h"
#include "robot/hal/thermal_camera.h"

namespace kiln {

/// Sensors played from files: a VLP-16 capture and a folder of Lepton stills. Their frames take the
/// same way as live ones: packet codec, perception, station.
class RecordedSensors {
 public:
  /// Empty paths are skipped. Checks the files before anything starts. Error: what is wrong with
  /// which file.
  [[nodiscard]] Result<void> open(const std::string& lidar_path, const std::string& thermal_folder,
                                  Executor& executor);
  [[nodiscard]] Lidar* lidar() const { return lidar_.get(); }
  [[nodiscard]] ThermalCamera* thermal() const { return thermal_.get(); }

 private:
  std::unique_ptr<Lidar> lidar_;
  std::unique_ptr<ThermalCamera> thermal_;
};

}  // namespace kiln

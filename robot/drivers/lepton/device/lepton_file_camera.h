#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/clock.h"
#include "common/core/executor.h"
#include "robot/hal/thermal_camera.h"

namespace kiln {

/// A folder of thermal stills as if a Lepton showed them: one frame every 1 / 8.77 s, each still
/// for a while, over and over. `frame_counter` counts the shown frames instead of repeating the
/// still's own: a still that is shown again is a camera that runs in front of a scene that does not
/// move, not a frozen camera. Everything else (TLinear, AGC, FFC) is the still's own telemetry.
/// Thread-safe; the sink is called on the executor's tick thread `io.thermal`.
class LeptonFileCamera final : public ThermalCamera {
 public:
  struct Config {
    double rate_hz = 8.77;
    int frames_per_still = 9;  ///< about a second each; 1 for a folder that is a sequence
  };
  /// Reads and checks every still, and registers the tick: call it before the executor starts.
  /// Error: one sentence with file and what to do.
  [[nodiscard]] static Result<std::unique_ptr<LeptonFileCamera>> open(const std::string& folder,
                                                                      Executor& executor,
                                                                      Config config);
  [[nodiscard]] static Result<std::unique_ptr<LeptonFileCamera>> open(const std::string& folder,
                                                                      Executor& executor) {
    return open(folder, executor, Config{});
  }
  ~LeptonFileCamera() override;

  Result<void> start(Sink<ThermalImagePtr> sink) override;
  void stop() override;
  /// Names of the stills in the order shown.
  [[nodiscard]] const std::vector<std::string>& stills() const;

 private:
  struct Player;
  explicit LeptonFileCamera(std::shared_ptr<Player> player);
  std::shared_ptr<Player> player_;  ///< shared with the tick, which may outlive the device
};

}  // namespace kiln

#pragma once

#include <optional>
#include <string>

#include "common/config/config_archive.h"
#include "robot/planning/base_path/corridor.h"
#include "robot/skills/surroundings.h"

namespace kiln {

/// Watches the piece of the path that lies ahead of the driving base: slows down towards what
/// stands there, waits before it, and lets go on when it is gone. Confined to the mission thread.
class CorridorGuard {
 public:
  struct Config {
    bool enabled = true;
    CorridorConfig corridor;
    double stop_gap_m = 0.45;  ///< waits this far before something
    double decel_mps2 = 0.5;   ///< slows down by this towards it
    double clear_s = 0.5;      ///< free for so long before it drives on
    double blind_s = 1.0;      ///< no scan for so long: waits
    double give_up_s = 30.0;   ///< blocked for so long: the drive has failed
    void visit(ConfigArchive& a);
  };
  struct View {
    double max_speed_mps = 1e9;  ///< along the path; 0 = wait
    std::string reason;          ///< "path blocked by something 0.8 m ahead"; empty when free
    bool given_up = false;
  };
  explicit CorridorGuard(Config config) : config_(config) {}
  void restart();
  /// @param from_s  path coordinate of the reference.
  [[nodiscard]] View look(const Surroundings& surroundings, const BasePath& path, double from_s,
                          const Pose2& X_map_base, double length_m, double width_m, Stamp now);

 private:
  [[nodiscard]] std::optional<CorridorHit> search(const Surroundings& surroundings,
                                                  const ObstacleCloud& cloud, const BasePath& path,
                                                  double from_s, const Pose2& X_map_base,
                                                  double length_m, double width_m) const;
  Config config_;
  std::optional<Stamp> judged_;     ///< stamp of the cloud that was last looked at
  std::optional<CorridorHit> hit_;  ///< with the distance from judged_s_
  double judged_s_ = 0.0;
  std::optional<Stamp> last_hit_, waiting_since_;
};

}  // namespace kiln

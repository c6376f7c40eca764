#pragma once

#include <memory>
#include <optional>
#include <string>

#include "robot/missions/common/pool_question.h"
#include "robot/perception/bricks/pile_detector.h"
#include "robot/scene/wall_site_map.h"

namespace kiln {

/// What a look for the pile found, in `map`.
struct PileAnswer {
  struct Found {
    Pose2 X_map_pile;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y (m), yaw (rad), axes of map
    bool second_line = false;
  };
  std::optional<Found> found;
  std::string why;  ///< none was found
  int candidates = 0;
};

/// Has the pool look for the pile in a sweep (NimbRo UGV paper, "Rough Pile Detection"). Confined
/// to the mission thread, the pool's work aside.
class PileTask {
 public:
  struct Config {
    PileDetector::Config detector;
    double margin_m = 1.0;   ///< around where the pile may be, beside how well it is known
    double latency_s = 0.1;  ///< modelled in lockstep
    void visit(ConfigArchive& a);
  };
  PileTask(const Config& config, const WallSiteMap& site, Executor& executor);

  /// The pile may stand as far from `X_map_pile` as the site says.
  /// @param sweep  in base, which stood at X_map_base.
  void begin(std::shared_ptr<const BrickSweep> sweep, const Pose2& X_map_base,
             const Pose2& X_map_pile);
  [[nodiscard]] const std::optional<PileAnswer>& answer() const { return question_.answer(); }
  void tick() { question_.tick(); }
  void clear() { question_.clear(); }

 private:
  Config config_;
  PileLayout layout_;
  double known_m_, known_rad_;
  PoolQuestion<PileAnswer> question_;
};

}  // namespace kiln

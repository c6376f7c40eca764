#pragma once

#include <optional>
#include <vector>

#include "robot/scene/raycaster.h"
#include "robot/sim/jet_profile.h"
#include "robot/sim/random.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// The jet as drops of equal volume in free fall (no drag: at 0.9 m that changes the sag by under a
/// centimetre). A drop that crosses the round opening of a fire place from outside and then meets
/// its plate is delivered there; any other is lost. The robot's own body does not stop drops.
/// Thread-compatible.
class WaterJet {
 public:
  WaterJet(const WaterConfig& config, const std::vector<TrueFirePlace>& places, std::uint64_t seed);

  /// Adds what left the nozzle in this step. @param X_map_nozzle X along the jet; @param v_nozzle
  /// its velocity.
  void emit(double litres, double flow_fraction, const Eigen::Isometry3d& X_map_nozzle,
            const Eigen::Vector3d& v_nozzle);
  void step(double step_s, const Raycaster& scene);
  /// Where drops of the last step met something.
  struct Landing {
    Raycaster::Hit on;
    Eigen::Vector3d p_map;
  };
  [[nodiscard]] const std::vector<Landing>& landings() const { return landings_; }
  [[nodiscard]] const std::vector<double>& deliveredLitres() const { return delivered_l_; }
  [[nodiscard]] double emittedLitres() const { return emitted_l_; }
  [[nodiscard]] const JetProfile& profile() const { return profile_; }
  [[nodiscard]] bool flying() const { return !drops_.empty(); }
  /// Positions in map, newest last.
  [[nodiscard]] std::vector<Eigen::Vector3d> drops() const;

 private:
  struct Drop {
    Eigen::Vector3d p, v;
    double age_s = 0.0;
    Eigen::Isometry3d X_map_nozzle = Eigen::Isometry3d::Identity();  ///< when it left
    std::optional<std::size_t> inside;  ///< the fire place whose opening it has passed
  };
  /// Whether the way from a to b leads inwards through the opening; then the share of the way at
  /// which it does.
  [[nodiscard]] static bool throughOpening(const TrueFirePlace& place, const Eigen::Vector3d& a,
                                           const Eigen::Vector3d& b, double& share);

  WaterConfig config_;
  const std::vector<TrueFirePlace>& places_;
  Random random_;
  std::vector<Drop> drops_;
  std::vector<Landing> landings_;
  JetProfile profile_;
  std::vector<double> delivered_l_;
  double emitted_l_ = 0.0, waiting_l_ = 0.0;
  std::vector<Raycaster::Ray> rays_;
  std::vector<Raycaster::Hit> hits_;
};

}  // namespace kiln::sim

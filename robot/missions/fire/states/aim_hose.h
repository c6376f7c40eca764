#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class StartPump;
class LostTarget;
class ArmBlocked;

/// "Aim Hose": brings the nozzle to the spray pose in steps of 10 cm; after each it looks again,
/// and the goal follows the improved estimate.
class AimHose
    : public FireState<AimHose, To<StartPump, LostTarget, ArmBlocked>, OnTimeout<LostTarget>> {
 public:
  static constexpr const char* kGroup = kExtinguish;
  static constexpr const char* kDoc = "Brings the nozzle to its spray pose in steps of 10 cm";
  static constexpr const char* kConsequence = "The arm moves the nozzle towards the heat source";
  static double timeLimit(const FireContext& context) { return context.config.aim.time_limit_s; }
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void enter() override;
  Transition execute() override;
  void leave() override;

 private:
  [[nodiscard]] bool targetLost() const;
  void publishGuards(const FireEstimate& estimate);
  [[nodiscard]] bool settled() const;
  /// Error: no spray pose can be reached.
  [[nodiscard]] Result<void> updateAim(const FireEstimate& estimate);
  void beginStep(const Eigen::Isometry3d& X_map_nozzle);
  [[nodiscard]] Transition onStepFailed(const SkillStatus& arm);

  bool moving_ = false;
  bool detour_ = false;  ///< this step goes by a joint motion, the straight line was not possible
  int steps_ = 0;
  int sightings_at_stop_ = 0;
  Stamp stopped_;
  Eigen::Isometry3d X_base_flange_step_ = Eigen::Isometry3d::Identity();
};

}  // namespace kiln

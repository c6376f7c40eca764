#pragma once

#include "robot/missions/fire/fire_state.h"

namespace kiln {

class ArmSearch;
class PlaceRefused;

/// Configured against sensed: the arm unfolds only before a fire box that stands where it was
/// configured (NimbRo UGV paper: a wrongly configured place made the arm collide with it).
class CheckPlace
    : public FireState<CheckPlace, To<ArmSearch, PlaceRefused>, OnTimeout<PlaceRefused>> {
 public:
  static constexpr const char* kGroup = kSearchFire;
  static constexpr const char* kLabel = "Place as configured?";
  static constexpr const char* kDoc = "Looks for the fire box in the live cloud";
  static constexpr const char* kConsequence =
      "The robot compares the configured place with the live cloud, then unfolds its arm or asks";
  static double timeLimit(const FireContext& context) {
    const FireCheckConfig& c = context.config.check;
    return c.max_looks * (c.look_timeout_s + c.between_looks_s) + 1.0;
  }
  static std::string denyEntry(const FireContext& context) { return context.whyNoPlace(); }
  void enter() override;
  Transition execute() override;

 private:
  void look();
  int looks_ = 0;
  bool asked_ = false;
  Stamp next_look_, asked_at_;
};

}  // namespace kiln

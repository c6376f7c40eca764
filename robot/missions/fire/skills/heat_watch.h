#pragma once

#include <cstdint>
#include <string>

#include "robot/missions/fire/skills/heat_sweep.h"

namespace kiln {

/// Remembers what the thermal camera saw and when, and feeds the sweep while the arm looks or aims.
/// Frozen frames (the shutter closes for 0.6 s about every 3 min) neither count as seen nor as
/// lost. Confined to the mission thread.
class HeatWatch {
 public:
  explicit HeatWatch(HeatSweep& sweep) : sweep_(sweep) {}

  /// Starts a sweep: forgets all views and listens.
  void begin(const Eigen::Vector3d& normal_map);
  /// Goes on feeding the present sweep (aiming) without forgetting.
  void listen(const Eigen::Vector3d& normal_map);
  void stopListening() { listening_ = false; }
  [[nodiscard]] bool listening() const { return listening_; }
  void onDetections(const HeatDetections& detections, const Eigen::Isometry3d& X_map_thermal);

  /// Computed once for each new image.
  [[nodiscard]] const std::optional<FireEstimate>& estimate();
  /// Images in which an accepted blob was seen since begin().
  [[nodiscard]] int sightings() const { return sightings_; }
  /// Usable images since begin().
  [[nodiscard]] int looks() const { return looks_; }
  /// Seconds since the last image, usable or not; < 0 = none yet.
  [[nodiscard]] double imageAgeS(Stamp now) const;
  /// Seconds since an accepted blob was last seen; < 0 = never since begin().
  [[nodiscard]] double seenAgeS(Stamp now) const;
  /// Time of usable images that passed without a sighting since the last one, s.
  [[nodiscard]] double unseenForS() const { return unseen_for_s_; }
  [[nodiscard]] const std::string& lastRefusal() const { return last_refusal_; }

 private:
  HeatSweep& sweep_;
  std::optional<FireEstimate> estimate_;
  bool estimate_is_current_ = false;
  bool listening_ = false;
  Eigen::Vector3d normal_map_ = Eigen::Vector3d::UnitX();
  int sightings_ = 0;
  int looks_ = 0;
  std::optional<Stamp> last_image_;
  std::optional<Stamp> last_usable_;
  std::optional<Stamp> last_seen_;
  double unseen_for_s_ = 0.0;
  std::string last_refusal_;
};

}  // namespace kiln

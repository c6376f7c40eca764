#pragma once

#include "gui/models/model.h"

namespace kiln::gui {

/// Where the robot believes to be and how sure it is; amber at 1.5 s, red at 3 s.
class LocalizationModel : public Model {
  Q_OBJECT
 public:
  explicit LocalizationModel(Link& link, QObject* parent = nullptr);
  /// nullptr before the first.
  [[nodiscard]] const LocalizationStatus* status() const { return status_.get(); }
  /// "good ±1.2 cm ±0.3°", "degraded ±12 cm ±1.4°", "lost"; "unknown" while nothing is known or
  /// what is known is too old.
  [[nodiscard]] QString summary() const;
  /// Lines for a tooltip: why, method, part of the map, last match, tracking error.
  [[nodiscard]] QString details() const;

 private:
  std::shared_ptr<const LocalizationStatus> status_;
};

/// The map in use and the path driven on it. Sent on change only: does not age.
class MapModel : public Model {
  Q_OBJECT
 public:
  explicit MapModel(Link& link, QObject* parent = nullptr);
  [[nodiscard]] const std::shared_ptr<const MapLayer>& layer() const { return layer_; }
  [[nodiscard]] const std::shared_ptr<const Trajectory>& trajectory() const { return trajectory_; }

 private:
  std::shared_ptr<const MapLayer> layer_;
  std::shared_ptr<const Trajectory> trajectory_;
};

/// "8 mm", "1.2 cm", "12 cm", "1.3 m".
[[nodiscard]] QString lengthText(double metres);
/// "0.3°", "12°".
[[nodiscard]] QString angleText(double radians);

}  // namespace kiln::gui

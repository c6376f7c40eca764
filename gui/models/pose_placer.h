#pragma once

#include "gui/models/station_models.h"

namespace kiln::gui {

/// The operator's word where the robot stands: choose, press and drag an arrow, hold to confirm.
/// Nothing is sent before confirm(). Armed too long without a hand on it, it ends by itself.
class PosePlacer : public QObject {
  Q_OBJECT
 public:
  enum class Phase : std::uint8_t {
    Idle,
    Armed,    ///< waits for a press on the map
    Placed,   ///< an arrow lies on the map; a drag may still turn it
    Sent,     ///< confirmed, no answer yet
    Refused,  ///< the robot said no: reason()
  };
  static constexpr double kExpiry_s = 30.0;
  static constexpr double kLeastDrag_m = 0.15;  ///< shorter drags do not turn the arrow

  explicit PosePlacer(StationModels& models, QObject* parent = nullptr);
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] bool active() const { return phase_ != Phase::Idle; }
  /// Meaningful from Placed on. In map.
  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const QString& reason() const { return reason_; }
  /// Whether the robot would take it, as far as the station can know; else `why` gets one sentence.
  [[nodiscard]] bool mayStart(QString* why = nullptr) const;

  void start();
  void press(double x_m, double y_m);
  void drag(double x_m, double y_m);
  void confirm();
  void cancel();

 signals:
  void changed();

 private:
  void go(Phase phase);
  void onProgress(const TrackedCommand& command);
  void watchExpiry();
  StationModels& models_;
  Phase phase_ = Phase::Idle;
  Pose2 pose_;
  QString reason_;
  std::uint64_t nonce_ = 0;
  Stamp touched_;
};

}  // namespace kiln::gui

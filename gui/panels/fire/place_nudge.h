#pragma once

#include "common/wire/fire/fire_model.h"
#include "gui/models/station_models.h"

namespace kiln::gui {

/// The configured fire places beside what the robot saw of them, and a wish to move one: collected
/// here, shown as a ghost, sent on confirm().
class PlaceNudge : public QObject {
  Q_OBJECT
 public:
  explicit PlaceNudge(StationModels& models, QObject* parent = nullptr);
  /// Names of all places, in the robot's order.
  [[nodiscard]] QStringList places() const;
  [[nodiscard]] const QString& selected() const { return selected_; }
  void select(const QString& place);
  /// What the robot saw of `place`; nullptr when it has not looked yet.
  [[nodiscard]] const PlaceCheck* check(const QString& place) const;
  [[nodiscard]] const FirePlaceInfo* place(const QString& name) const;
  /// The first place whose check says Misplaced; empty: none.
  [[nodiscard]] QString misplaced() const;

  /// Not sent yet; zero after confirm() or cancel().
  [[nodiscard]] const Pose2& wish() const { return wish_; }
  [[nodiscard]] bool hasWish() const;
  void add(double dx_m, double dy_m, double dyaw_rad);
  /// Wishes the configured place onto the sensed one. No effect without a sensed pose.
  void wishSensed();
  void confirm();
  void continueDespite();
  void cancel();
  /// Why the last wish was not granted; empty when it was.
  [[nodiscard]] const QString& refusal() const { return refusal_; }

 signals:
  void changed();

 private:
  void onProgress(const TrackedCommand& command);
  void follow();
  [[nodiscard]] double limited(const char* argument, double value) const;
  void send(MissionCommand command, const QString& label);
  StationModels& models_;
  FireSite site_;
  QString selected_, shown_misplaced_, refusal_;
  Pose2 wish_;
  std::uint64_t nonce_ = 0;
};

/// "18 cm off (x +12 cm, y −13 cm, yaw +2.0°)"; a sentence when nothing was sensed.
[[nodiscard]] QString offsetText(const PlaceCheck& check);

}  // namespace kiln::gui

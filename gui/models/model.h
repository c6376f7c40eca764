#pragma once

#include <QObject>

#include "common/core/clock.h"
#include "gui/link/link.h"
#include "gui/models/age.h"

namespace kiln::gui {

/// Base of all models: the newest value of one topic, its stamp and its age. No widgets, GUI thread
/// only.
///
/// Incoming data marks the model; `flush()` (called by StationModels at most 30 times a second)
/// turns any number of marks into one changed(). So a fast topic never repaints a view more often
/// than the screen shows it.
class Model : public QObject {
  Q_OBJECT
 public:
  explicit Model(Link& link, AgeLimits limits = {}, QObject* parent = nullptr);

  [[nodiscard]] bool hasData() const { return received_.has_value(); }
  /// Robot time of the newest value; Stamp{} before the first.
  [[nodiscard]] Stamp stamp() const { return stamp_; }
  /// Seconds since the value was true: the larger of the time since it arrived and its age in robot
  /// time. So both a dead link and a frozen sensor that keeps sending look old. < 0 before the
  /// first value.
  [[nodiscard]] double ageS() const;
  [[nodiscard]] AgeLimits ageLimits() const { return limits_; }
  [[nodiscard]] AgeLevel ageLevel() const { return judgeAge(ageS(), limits_); }
  /// Values a second over the last few, 0 while unknown.
  [[nodiscard]] double rateHz() const;
  /// Emits changed() if something was marked since the last call.
  void flush();

 signals:
  void changed();

 protected:
  /// Note a new value that was true at `stamp` (robot time).
  void arrived(Stamp stamp);
  /// Back to the time before the first value.
  void forget();
  /// Ask for a changed() without new data.
  void touch() { dirty_ = true; }
  [[nodiscard]] Link& link() const { return link_; }
  [[nodiscard]] Stamp stationNow() const { return link_.clock().now(); }

 private:
  Link& link_;
  AgeLimits limits_;
  Stamp stamp_;
  std::optional<Stamp> received_;  ///< station time
  double period_s_ = 0.0;          ///< smoothed
  bool jumped_ = false;            ///< nothing has arrived since a jump in time
  bool dirty_ = false;
};

}  // namespace kiln::gui

#pragma once

#include <QTimer>
#include <optional>

#include "gui/widgets/act_button.h"
#include "gui/widgets/press_guard.h"

namespace kiln::gui {

/// Acts only when held. Two uses:
///  - hold to act (hold_s > 0): `completed()` once, after the full hold; released earlier, nothing
///  happened;
///  - hold to run (hold_s = 0): `engaged()` at the press, `disengaged()` at the release.
/// The release ends it wherever it happens, and so does all that PressGuard knows of, and the
/// pointer leaving the button. What has ended needs a new press: coming back with the button down
/// is none. `engaged`/`disengaged` always come in pairs.
class HoldButton : public ActButton {
  Q_OBJECT
 public:
  /// @param hold_s  1.0 for dangerous acts, 0 for hold-to-run.
  HoldButton(const Ui& ui, const QString& title, double hold_s = 1.0, QWidget* parent = nullptr);
  ~HoldButton() override;
  void setHold(double hold_s) { hold_s_ = hold_s; }
  [[nodiscard]] bool isEngaged() const { return since_.has_value(); }
  [[nodiscard]] double progress() const;  ///< 0..1 of the hold
  /// Looks at the clock; runs by itself at 30 Hz while held. Tests with a manual clock call it.
  void tick();
  /// End the hold as a release would.
  void cancel();
  [[nodiscard]] QSize sizeHint() const override;

 signals:
  void engaged();
  void disengaged();
  void completed();

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  [[nodiscard]] double fill() const override { return hold_s_ > 0 ? progress() : 0.0; }
  [[nodiscard]] bool lit() const override { return isEngaged(); }

 private:
  void begin(bool by_mouse);
  void end();
  PressGuard guard_;
  double hold_s_;
  std::optional<Stamp> since_;
  bool done_ = false;  ///< completed, still pressed
  QTimer timer_;
};

}  // namespace kiln::gui

#pragma once

#include <QWidget>

#include "gui/views/teleop/hold_to_run.h"
#include "gui/views/teleop/jog_keys.h"
#include "gui/views/teleop/jog_mixer.h"
#include "gui/views/teleop/jog_pad.h"
#include "gui/widgets/text.h"

class QButtonGroup;

namespace kiln::gui {

/// The sticks for base and arm, by mouse and keyboard. Only sends while HoldToRun allows it;
/// everything at rest ends the streams. The keyboard jogs while the keyboard focus is in this panel
/// or in another that it listens in.
class JogPanel : public QWidget {
  Q_OBJECT
 public:
  JogPanel(const Ui& ui, HoldToRun& hold, QWidget* parent = nullptr);
  /// The jog keys work in `other` too. It has a DeadMan of its own, and outlives this panel.
  void listenIn(QWidget& other);
  /// Enables or greys out the sticks.
  void setLocked(bool locked);
  /// All sticks and keys to rest, without sending: after the streams were ended elsewhere.
  void rest();
  [[nodiscard]] JogPad& drivePad() { return *drive_; }
  [[nodiscard]] JogPad& armPad() { return *arm_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void build();
  QWidget* buildArmModes();
  void push();
  void showKeys();
  void setArmMode(ArmJogMode mode, int joint);
  void restyle();

  Ui ui_;
  HoldToRun& hold_;
  JogKeys keys_;
  JogMixer mixer_;
  JogPad *drive_, *turn_, *arm_, *up_;
  Label *drive_caption_, *arm_caption_;
  QButtonGroup* modes_;
};

}  // namespace kiln::gui

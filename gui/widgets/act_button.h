#pragma once

#include <QAbstractButton>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

enum class ActKind {
  Normal,
  Primary,  ///< the expected next act
  Caution,  ///< the robot asks, or it is marginal
  Forced,   ///< operator overrides the mission
  Manual,   ///< operator drives
  Danger,   ///< clears a stop, sprays by hand
};

/// A push button with a title and a line that says what will happen. Space never presses it: Space
/// is STOP.
class ActButton : public QAbstractButton {
  Q_OBJECT
 public:
  ActButton(const Ui& ui, const QString& title, QWidget* parent = nullptr);
  void setSubtext(const QString& text);
  [[nodiscard]] QString subtext() const { return subtext_; }
  /// Long texts take more lines and the button grows higher, as far as its layout gives it the
  /// room.
  void setWrapping(bool wrapping);
  /// Whether all of both texts is to be read at the present size.
  [[nodiscard]] bool textIsWhole() const;
  void setKind(ActKind kind);
  [[nodiscard]] ActKind kind() const { return kind_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  /// 0..1, painted as a fill from the left.
  [[nodiscard]] virtual double fill() const { return 0.0; }
  [[nodiscard]] virtual bool lit() const { return isDown(); }
  [[nodiscard]] const Ui& ui() const { return ui_; }

 private:
  struct Look {
    QColor fill, line, text, sub, progress;
  };
  struct Texts {
    FittedText title, sub;
  };
  [[nodiscard]] Look look() const;
  /// @param height  -1: as high as the texts need.
  [[nodiscard]] Texts textsFor(int width, int height) const;
  Ui ui_;
  QString subtext_;
  ActKind kind_ = ActKind::Normal;
};

}  // namespace kiln::gui

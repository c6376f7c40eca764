#pragma once

#include <QWidget>
#include <vector>

#include "gui/widgets/act_button.h"

namespace kiln::gui {

/// The ways out of a state as buttons. How high the block is and where its buttons stand follows
/// from their number and from the room alone, never from their words. Up to two have what the robot
/// will do then on them; of more, a strip below tells it of the one that the pointer or the
/// keyboard is on, unless there is room enough.
class ExitList : public QWidget {
  Q_OBJECT
 public:
  static constexpr std::size_t kMost = 4;
  struct Exit {
    QString to, label, consequence;
  };
  explicit ExitList(const Ui& ui, QWidget* parent = nullptr);
  void setExits(const std::vector<Exit>& exits);
  /// Room for all words of four.
  void setTall(bool tall);
  /// @param why  why none can be taken now; empty: they can.
  void setLock(const QString& why);
  [[nodiscard]] const std::vector<ActButton*>& buttons() const { return buttons_; }
  /// What the strip tells; empty where there is none.
  [[nodiscard]] QString told() const;
  /// Whether all that it tells now is to be read, not shortened.
  [[nodiscard]] bool whole() const;

 signals:
  void picked(const QString& to);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  [[nodiscard]] bool strip() const { return exits_.size() > 2 && !tall_; }
  void arrange();
  [[nodiscard]] FittedText fitted() const;
  Ui ui_;
  std::vector<Exit> exits_;
  std::vector<ActButton*> buttons_;
  const ActButton* pointed_ = nullptr;
  bool tall_ = false;
  QString lock_;
};

}  // namespace kiln::gui

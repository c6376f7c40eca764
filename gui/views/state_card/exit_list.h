#pragma once

#include <QWidget>
#include <vector>

#include "gui/widgets/act_button.h"

namespace kiln::gui {

/// The ways out of a state as buttons. How high the block is and where its buttons stand follows
/// from their number and from the room alone, never from their words. What the robot will do then
/// stands on them where there is room; else a strip below tells it of the one that the pointer or
/// the keyboard is on.
class ExitList : public QWidget {
  Q_OBJECT
 public:
  static constexpr std::size_t kMost = 4;
  struct Exit {
    QString to, label, consequence;
  };
  explicit ExitList(const Ui& ui, QWidget* parent = nullptr);
  void setExits(const std::vector<Exit>& exits);
  /// For the words of one, of two, of all.
  enum class Room { Low, Middle, Tall };
  void setRoom(Room room);
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
  [[nodiscard]] bool strip() const;
  void arrange();
  [[nodiscard]] FittedText fitted() const;
  Ui ui_;
  std::vector<Exit> exits_;
  std::vector<ActButton*> buttons_;
  const ActButton* pointed_ = nullptr;
  Room room_ = Room::Low;
  QString lock_;
};

}  // namespace kiln::gui

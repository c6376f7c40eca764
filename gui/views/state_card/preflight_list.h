#pragma once

#include <QWidget>
#include <vector>

#include "common/model/status.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The checks before a start. What fails stands on top (exclamation mark), then what holds and yet
/// wants a look (triangle), each with what was found and what to do about it; what holds stands
/// below, and shrinks to one line where there is no room.
class PreflightList : public QWidget {
  Q_OBJECT
 public:
  explicit PreflightList(const Ui& ui, QWidget* parent = nullptr);
  void setChecks(const std::vector<Check>& checks);
  [[nodiscard]] int failing() const;
  [[nodiscard]] int warning() const;
  [[nodiscard]] int total() const { return static_cast<int>(checks_.size()); }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] int actionHeight(const Check& check, int width) const;
  [[nodiscard]] int detailHeight(const Check& check, int width) const;
  [[nodiscard]] int rowHeight(const Check& check, int width) const;
  [[nodiscard]] int notedHeight(int width) const;
  void paintNoted(QPainter& painter, const Check& check, int y, int width) const;
  void paintPassing(QPainter& painter, const Check& check, int y) const;
  Ui ui_;
  std::vector<Check> checks_;  ///< failing first, then warnings, else in the robot's order
};

}  // namespace kiln::gui

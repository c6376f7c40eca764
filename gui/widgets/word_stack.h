#pragma once

#include <QWidget>
#include <vector>

namespace kiln::gui {

/// Words one below the other, each as high as it needs while there is room: what was added first
/// has the room first. How much there is to say never changes the size of the stack, so that no
/// neighbour moves when a text does.
class WordStack : public QWidget {
  Q_OBJECT
 public:
  explicit WordStack(int spacing_px, QWidget* parent = nullptr);
  /// Below those that are there already. Takes ownership. Less than `least_px` of it is nothing.
  void add(QWidget* child, int least_px = 14);
  [[nodiscard]] QSize sizeHint() const override { return {200, 60}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 0}; }

 protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Row {
    QWidget* widget;
    int least_px;
  };
  void arrange();
  int spacing_px_;
  std::vector<Row> rows_;
};

}  // namespace kiln::gui

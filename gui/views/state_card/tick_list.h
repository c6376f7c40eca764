#pragma once

#include <QWidget>
#include <vector>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Rows of "mark, what, detail, age": guards of a state or checks before a start. The mark differs
/// in shape, not only in colour: tick met, dots waiting, exclamation mark for what needs somebody.
class TickList : public QWidget {
  Q_OBJECT
 public:
  enum class Mark { Met, Waiting, Attention };
  struct Row {
    Mark mark = Mark::Waiting;
    QString name;
    QString detail;
    AgeLevel level = AgeLevel::Fresh;  ///< colours the detail
    bool operator==(const Row&) const = default;
  };
  explicit TickList(const Ui& ui, QWidget* parent = nullptr);
  void setRows(std::vector<Row> rows);
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, sizeHint().height()}; }
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// Where name and detail do not fit beside each other the detail goes below.
  [[nodiscard]] bool needsTwoLines(const Row& row, int width) const;
  [[nodiscard]] int rowHeight(std::size_t i, int width) const;
  void paintRow(QPainter& painter, std::size_t i, int y) const;
  void paintMark(QPainter& painter, const QRectF& area, Mark mark) const;
  Ui ui_;
  std::vector<Row> rows_;
  std::vector<bool>
      tall_;  ///< rows that once needed two lines: they keep them while their name stays
};

}  // namespace kiln::gui

#pragma once

#include <QWidget>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// Small words in as many lines as its room has, set narrower before any is cut; all of them in the
/// tip. What it says never changes its size.
class FittedLabel : public QWidget {
  Q_OBJECT
 public:
  explicit FittedLabel(const Ui& ui, QWidget* parent = nullptr);
  void set(const QString& text, const QColor& color);
  [[nodiscard]] QString text() const { return text_; }
  [[nodiscard]] QSize sizeHint() const override { return {60, 30}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {20, 14}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Ui ui_;
  QString text_;
  QColor color_;
};

}  // namespace kiln::gui

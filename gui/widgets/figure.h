#pragma once

#include <QWidget>
#include <optional>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// One figure of the top bar: a small name above, the value (and a thin bar with limits) below.
class Figure : public QWidget {
  Q_OBJECT
 public:
  /// @param widest  text that the value never outgrows; keeps positions fixed.
  Figure(const Ui& ui, const QString& name, const QString& widest, QWidget* parent = nullptr);
  void set(const QString& value, AgeLevel level = AgeLevel::Fresh);
  /// A bar of `share` (0..1) under the name instead of large text; nullopt removes it.
  void setBar(std::optional<double> share);
  void setRole(TextRole role);
  [[nodiscard]] QString value() const { return value_; }
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Ui ui_;
  QString name_, widest_, value_;
  TextRole role_ = TextRole::Body;
  AgeLevel level_ = AgeLevel::Fresh;
  std::optional<double> bar_;
};

}  // namespace kiln::gui

#pragma once

#include <QWidget>

#include "gui/widgets/theme.h"

namespace kiln::gui {

/// "0.11 s", "0.9 s", "12 s", "2:05"; "no data" below zero.
[[nodiscard]] QString ageText(double age_s);

/// A small age with its level: plain when fresh, a triangle when amber, a cross when red. Shape,
/// text and colour.
class AgeBadge : public QWidget {
  Q_OBJECT
 public:
  explicit AgeBadge(const Ui& ui, QWidget* parent = nullptr);
  /// @param prefix e.g. "8.8 Hz"; shown before the age.
  void set(double age_s, AgeLevel level, const QString& prefix = {});
  [[nodiscard]] AgeLevel level() const { return level_; }
  [[nodiscard]] QString text() const;
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Ui ui_;
  double age_s_ = -1.0;
  AgeLevel level_ = AgeLevel::None;
  QString prefix_;
};

}  // namespace kiln::gui

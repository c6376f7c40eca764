#pragma once

#include "gui/widgets/text.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

enum class BannerKind { Plain, Good, Caution, Fault, Forced };

/// A few words on a coloured ground with a bar at the left; Plain has neither. Hidden while empty.
/// Cheap to set again with the same words, so that a view may do it on every change of its model.
class Banner : public Label {
  Q_OBJECT
 public:
  explicit Banner(const Ui& ui, TextRole role = TextRole::Body, QWidget* parent = nullptr);
  /// `kind` gives ground, bar and colour.
  void set(const Markup& words, BannerKind kind = BannerKind::Plain);
  /// Secondary text colour, for captions.
  void setDim(bool dim);
  [[nodiscard]] BannerKind kind() const { return kind_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void restyle();
  Ui ui_;
  TextRole role_;
  BannerKind kind_ = BannerKind::Plain;
  bool dim_ = false;
};

}  // namespace kiln::gui

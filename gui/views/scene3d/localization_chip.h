#pragma once

#include <QWidget>

#include "gui/models/localization_model.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// How far the robot's position may be trusted: shape, word and figure. A disc good, a triangle
/// degraded, a cross lost, a ring unknown; the reason below while it is not good.
class LocalizationChip : public QWidget {
  Q_OBJECT
 public:
  LocalizationChip(const Ui& ui, const LocalizationModel& model, QWidget* parent = nullptr);
  [[nodiscard]] QString title() const;   ///< "Position good ±1.2 cm ±0.3°"
  [[nodiscard]] QString detail() const;  ///< "indoor map · 2 cm off the path", or why not good
  [[nodiscard]] QSize sizeHint() const override;
  void refresh();
  /// No wider than this, 0: as it likes; texts are shortened.
  void setWidest(int widest_px);

 signals:
  void resized();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  enum class Mark : std::uint8_t { Good, Degraded, Lost, Unknown };
  [[nodiscard]] Mark mark() const;
  [[nodiscard]] QRect detailArea(int width) const;
  void paintMark(QPainter& painter, const QPointF& center, const QColor& color) const;
  Ui ui_;
  const LocalizationModel& model_;
  int widest_px_ = 0;
};

}  // namespace kiln::gui

#include "gui/widgets/fitted_label.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kNarrow_pct = 85, kNarrowest_pct = 72;
}

FittedLabel::FittedLabel(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
}

void FittedLabel::set(const QString& text, const QColor& color) {
  if (text == text_ && color == color_) return;
  text_ = text;
  color_ = color;
  setTip(*this, text);
  update();
}

void FittedLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(color_);
  const QFont small = ui_.theme.font(TextRole::Small);
  const int lines = std::max(1, height() / QFontMetrics(small).height());
  paintFitted(
      painter, rect(), Qt::AlignTop | Qt::AlignLeft,
      fitText(text_, {small, condensed(small, kNarrow_pct), condensed(small, kNarrowest_pct)},
              width(), lines));
}

}  // namespace kiln::gui

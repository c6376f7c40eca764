#include "gui/widgets/word_stack.h"

#include <QEvent>
#include <algorithm>

namespace kiln::gui {

WordStack::WordStack(int spacing_px, QWidget* parent) : QWidget(parent), spacing_px_(spacing_px) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
}

void WordStack::add(QWidget* child, int least_px) {
  child->setParent(this);
  rows_.push_back({child, least_px});
}

/// Without a layout of its own it is asked when a child shows, hides or needs another size.
bool WordStack::event(QEvent* event) {
  if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show) arrange();
  return QWidget::event(event);
}

void WordStack::resizeEvent(QResizeEvent*) { arrange(); }

void WordStack::arrange() {
  int y = 0;
  for (const auto& [widget, least_px] : rows_) {
    if (widget->isHidden()) continue;
    const int needs =
        widget->hasHeightForWidth() ? widget->heightForWidth(width()) : widget->sizeHint().height();
    const int room = std::min(needs, height() - y);
    widget->setGeometry(0, y, width(), room < std::min(least_px, needs) ? 0 : room);
    if (room > 0) y += room + spacing_px_;
  }
}

}  // namespace kiln::gui

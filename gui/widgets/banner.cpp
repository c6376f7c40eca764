#include "gui/widgets/banner.h"

#include <QPainter>

namespace kiln::gui {

Banner::Banner(const Ui& ui, TextRole role, QWidget* parent) : Label(parent), ui_(ui), role_(role) {
  setTextFormat(Qt::RichText);
  setWordWrap(true);
  setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  setVisible(false);
  connect(&ui_.theme, &Theme::changed, this, &Banner::restyle);
  restyle();
}

void Banner::set(const Markup& words, BannerKind kind) {
  if (kind != kind_) {
    kind_ = kind;
    restyle();
  }
  if (words.html() != text()) {
    setText(words.html());
    setTip(*this, words);  // for a banner that has not the room for all of them
  }
  if (isHidden() != words.isEmpty()) setVisible(!words.isEmpty());
}

void Banner::setDim(bool dim) {
  dim_ = dim;
  restyle();
}

void Banner::restyle() {
  const Palette& p = ui_.theme.colors();
  setFont(ui_.theme.font(role_));
  QPalette colors = palette();
  colors.setColor(QPalette::WindowText, dim_ ? p.dim : p.text);
  setPalette(colors);
  setContentsMargins(kind_ == BannerKind::Plain ? 0 : 12, kind_ == BannerKind::Plain ? 0 : 5, 6,
                     kind_ == BannerKind::Plain ? 0 : 5);
  update();
}

void Banner::paintEvent(QPaintEvent* event) {
  const Palette& p = ui_.theme.colors();
  QColor ground, bar;
  switch (kind_) {
    case BannerKind::Plain:
      break;
    case BannerKind::Good:
      ground = p.raised, bar = p.ok;
      break;
    case BannerKind::Caution:
      ground = p.caution_fill, bar = p.caution;
      break;
    case BannerKind::Fault:
      ground = p.fault_fill, bar = p.fault;
      break;
    case BannerKind::Forced:
      ground = p.forced_fill, bar = p.forced;
      break;
  }
  if (kind_ != BannerKind::Plain) {
    QPainter painter(this);
    painter.fillRect(rect(), ground);
    painter.fillRect(QRect(0, 0, 4, height()), bar);
  }
  Label::paintEvent(event);
}

}  // namespace kiln::gui

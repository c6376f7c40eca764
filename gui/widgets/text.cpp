#include "gui/widgets/text.h"

#include <QTextDocument>
#include <QToolTip>

namespace kiln::gui {

Markup::Markup(const QString& plain) : html_(plain.toHtmlEscaped()) {
  html_.replace(QLatin1Char('\n'), QStringLiteral("<br>"));
}

Markup& Markup::operator+=(const Markup& more) {
  html_ += more.html_;
  return *this;
}

Label::Label(const QString& text, QWidget* parent) : QLabel(parent) {
  setTextFormat(Qt::PlainText);
  setText(text);
}

QString tipText(const QString& plain) {
  return Qt::mightBeRichText(plain) ? QStringLiteral("<qt>") + Markup(plain).html() : plain;
}

void setTip(QWidget& widget, const QString& plain) { widget.setToolTip(tipText(plain)); }

void setTip(QWidget& widget, const Markup& tip) {
  widget.setToolTip(tip.isEmpty() ? QString() : QStringLiteral("<qt>") + tip.html());
}

void showTip(const QPoint& global, const Markup& tip, QWidget& owner) {
  QToolTip::showText(global, QStringLiteral("<qt>") + tip.html(), &owner);
}

}  // namespace kiln::gui

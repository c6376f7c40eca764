#pragma once

#include <QLabel>
#include <QString>

namespace kiln::gui {

/// Words with markup of our own. Text from outside gets in escaped only, so that a name which came
/// over the network is never read as HTML. Plain text converts by itself.
class Markup {
 public:
  Markup() = default;
  Markup(const QString& plain);  // NOLINT(google-explicit-constructor): safe, it escapes
  /// @param pattern  a literal with tags and %1 ...; each argument is escaped, or Markup.
  template <class... Args>
  friend Markup markup(const QString& pattern, const Args&... args);

  [[nodiscard]] const QString& html() const { return html_; }
  [[nodiscard]] bool isEmpty() const { return html_.isEmpty(); }
  Markup& operator+=(const Markup& more);

 private:
  QString html_;
};

template <class... Args>
Markup markup(const QString& pattern, const Args&... args) {
  Markup out;
  if constexpr (sizeof...(Args) == 0)
    out.html_ = pattern;
  else
    out.html_ = pattern.arg(Markup(args).html()...);  // all at once: a %1 in a name stays a %1
  return out;
}

/// The station's label: plain text, always.
class Label : public QLabel {
  Q_OBJECT
 public:
  explicit Label(const QString& text = {}, QWidget* parent = nullptr);
  explicit Label(QWidget* parent) : Label(QString(), parent) {}
};

/// What a tool tip must be given so that Qt, which guesses, does not read it as markup.
[[nodiscard]] QString tipText(const QString& plain);
void setTip(QWidget& widget, const QString& plain);
void setTip(QWidget& widget, const Markup& tip);
/// A tip of one place in a widget, at once.
void showTip(const QPoint& global, const Markup& tip, QWidget& owner);

}  // namespace kiln::gui

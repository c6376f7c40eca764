#include "gui/widgets/theme.h"

#include <QApplication>
#include <QFontDatabase>
#include <QPalette>
#include <cmath>

namespace kiln::gui {

namespace {
QString familyName() {
  const QFontDatabase fonts;
  for (const char* family : {"Inter", "Noto Sans", "DejaVu Sans"}) {
    if (fonts.hasFamily(QString::fromLatin1(family))) return QString::fromLatin1(family);
  }
  return QApplication::font().family();
}

QString styleSheet(const Palette& p) {
  return QStringLiteral(R"(
    QToolTip { background: %1; color: %2; border: 1px solid %3; padding: 4px; }
    QLineEdit { background: %4; color: %2; border: 1px solid %3; border-radius: 3px; padding: 2px 6px;
                selection-background-color: %5; }
    QScrollBar:vertical { background: transparent; width: 8px; margin: 0; }
    QScrollBar:horizontal { background: transparent; height: 8px; margin: 0; }
    QScrollBar::handle { background: %3; border-radius: 3px; min-height: 24px; min-width: 24px; }
    QScrollBar::add-line, QScrollBar::sub-line, QScrollBar::add-page, QScrollBar::sub-page
      { background: none; height: 0; width: 0; }
    QScrollArea, QAbstractScrollArea { border: none; background: transparent; }
    QCheckBox, QLabel { background: transparent; }
  )")
      .arg(p.raised.name(), p.text.name(), p.border.name(), p.sunk.name(), p.active.name());
}

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}
double luminance(const QColor& c) {
  return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
}
}  // namespace

Palette darkPalette() {
  Palette p;
  p.ground = QColor("#1b1e20");
  p.panel = QColor("#25292b");
  p.raised = QColor("#2f3437");
  p.sunk = QColor("#1f2224");
  p.border = QColor("#41474b");
  p.grid = QColor("#33383b");
  p.text = QColor("#e4e7e9");
  p.dim = QColor("#a9afb4");
  p.faint = QColor("#7b8288");
  p.active = QColor("#2f6f8f");
  p.active_text = QColor("#ffffff");
  p.active_line = QColor("#f2f5f7");
  p.recent = QColor("#2f6f8f");
  p.ok = QColor("#8cc29a");
  p.caution = QColor("#eda73f");
  p.caution_fill = QColor("#4f3a18");
  p.fault = QColor("#ff6b70");
  p.fault_fill = QColor("#5e1f25");
  p.manual = QColor("#5b9fe3");
  p.manual_fill = QColor("#20384f");
  p.forced = QColor("#d681d0");
  p.forced_fill = QColor("#412740");
  p.stop_body = QColor("#8c1620");
  p.stop_latched = QColor("#f32836");
  p.stop_text = QColor("#ffffff");
  p.sim = QColor("#7fb28b");
  p.replay = QColor("#a98ce0");
  p.plot_warm = QColor("#d9915b");
  p.plot_cool = QColor("#8fb0c4");
  p.plot_bar = QColor("#596066");
  p.scene_ground = QColor("#202427");
  p.scene_line = QColor("#3a4044");
  return p;
}

Palette lightPalette() {
  Palette p;
  p.ground = QColor("#d5d8da");
  p.panel = QColor("#eff1f2");
  p.raised = QColor("#ffffff");
  p.sunk = QColor("#e3e6e8");
  p.border = QColor("#a3a9ae");
  p.grid = QColor("#cfd3d6");
  p.text = QColor("#14181b");
  p.dim = QColor("#464e54");
  p.faint = QColor("#6a727a");
  p.active = QColor("#1d6288");
  p.active_text = QColor("#ffffff");
  p.active_line = QColor("#0b1a24");
  p.recent = QColor("#1d6288");
  p.ok = QColor("#216a37");
  p.caution = QColor("#8a4b00");
  p.caution_fill = QColor("#ffdf9e");
  p.fault = QColor("#b00716");
  p.fault_fill = QColor("#ffd0d2");
  p.manual = QColor("#0f5cb0");
  p.manual_fill = QColor("#cfe3f9");
  p.forced = QColor("#8f2389");
  p.forced_fill = QColor("#f3dcf1");
  p.stop_body = QColor("#a31522");
  p.stop_latched = QColor("#ee0f22");
  p.stop_text = QColor("#ffffff");
  p.sim = QColor("#216a37");
  p.replay = QColor("#5c3aa8");
  p.plot_warm = QColor("#a8500f");
  p.plot_cool = QColor("#265d80");
  p.plot_bar = QColor("#9aa1a6");
  p.scene_ground = QColor("#e6e9eb");
  p.scene_line = QColor("#c0c5c9");
  return p;
}

Theme::Theme(ThemeKind kind, QObject* parent)
    : QObject(parent),
      kind_(kind),
      palette_(kind == ThemeKind::Dark ? darkPalette() : lightPalette()) {}

QFont Theme::font(TextRole role) const {
  static const QString family = familyName();
  QFont font(family);
  switch (role) {
    case TextRole::Small:
      font.setPointSizeF(9);
      break;
    case TextRole::Body:
      font.setPointSizeF(10);
      break;
    case TextRole::Strong:
      font.setPointSizeF(10);
      font.setWeight(QFont::DemiBold);
      break;
    case TextRole::Value:
      font.setPointSizeF(13);
      font.setWeight(QFont::DemiBold);
      break;
    case TextRole::Word:
      font.setPointSizeF(19);
      font.setWeight(QFont::Bold);
      break;
  }
  font.setStyleStrategy(QFont::PreferAntialias);
  return font;
}

QColor Theme::ageColor(AgeLevel level) const {
  switch (level) {
    case AgeLevel::None:
      return palette_.faint;
    case AgeLevel::Fresh:
      return palette_.dim;
    case AgeLevel::Amber:
      return palette_.caution;
    case AgeLevel::Red:
      return palette_.fault;
  }
  return palette_.dim;
}

void Theme::setKind(ThemeKind kind) {
  if (kind == kind_) return;
  kind_ = kind;
  palette_ = kind == ThemeKind::Dark ? darkPalette() : lightPalette();
  apply();
  emit changed();
}

void Theme::apply() {
  QPalette q;
  q.setColor(QPalette::Window, palette_.ground);
  q.setColor(QPalette::Base, palette_.sunk);
  q.setColor(QPalette::AlternateBase, palette_.panel);
  q.setColor(QPalette::Button, palette_.raised);
  for (const auto role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    q.setColor(role, palette_.text);
    q.setColor(QPalette::Disabled, role, palette_.faint);
  }
  q.setColor(QPalette::ToolTipBase, palette_.raised);
  q.setColor(QPalette::Highlight, palette_.active);
  q.setColor(QPalette::HighlightedText, palette_.active_text);
  QApplication::setPalette(q);
  QApplication::setFont(font(TextRole::Body));
  if (auto* app = qobject_cast<QApplication*>(QCoreApplication::instance()))
    app->setStyleSheet(styleSheet(palette_));
}

QColor mixed(const QColor& a, const QColor& b, double share_of_b) {
  const auto blend = [share_of_b](double x, double y) { return x + (y - x) * share_of_b; };
  return QColor::fromRgbF(blend(a.redF(), b.redF()), blend(a.greenF(), b.greenF()),
                          blend(a.blueF(), b.blueF()));
}

double contrast(const QColor& a, const QColor& b) {
  const double la = luminance(a) + 0.05;
  const double lb = luminance(b) + 0.05;
  return la > lb ? la / lb : lb / la;
}

}  // namespace kiln::gui

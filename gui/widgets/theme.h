#pragma once

#include <QColor>
#include <QFont>
#include <QObject>

#include "common/core/clock.h"
#include "gui/models/age.h"

class QApplication;

namespace kiln::gui {

enum class ThemeKind { Dark, Light };

/// Colours by meaning, never by hue. Quiet greys; colour is for the abnormal and for what is
/// active. Every pair of text and its ground reaches a contrast of 4.5 in both themes
/// (tests/gui/theme_test).
struct Palette {
  QColor ground, panel, raised, sunk, border, grid;
  QColor text, dim, faint;       ///< normal, secondary, disabled text
  QColor active, active_text;    ///< what runs now: fill and the text on it
  QColor active_line;            ///< border of the active state
  QColor recent;                 ///< fills of recent states are this at 55 % and 25 %
  QColor ok;                     ///< ready, met; sparingly
  QColor caution, caution_fill;  ///< needs attention, marginal; text/line and fill
  QColor fault, fault_fill;      ///< danger, alarm
  QColor manual, manual_fill;    ///< operator drives
  QColor forced, forced_fill;    ///< operator's jumps
  QColor stop_body, stop_latched, stop_text;
  QColor sim, replay;
  QColor plot_warm, plot_cool, plot_bar;
  QColor scene_ground, scene_line;  ///< 3D background and grid
};

/// Type scale: three sizes and the one status word.
enum class TextRole {
  Small,   ///< 9 pt: ages, units, hints
  Body,    ///< 10 pt
  Strong,  ///< 10 pt, semi-bold: titles
  Value,   ///< 13 pt, semi-bold: figures that matter
  Word,    ///< 19 pt, bold: the status word
};

/// The look of the station. One per program, handed to every widget by reference (see Ui); GUI
/// thread only.
class Theme : public QObject {
  Q_OBJECT
 public:
  explicit Theme(ThemeKind kind = ThemeKind::Dark, QObject* parent = nullptr);
  [[nodiscard]] ThemeKind kind() const { return kind_; }
  [[nodiscard]] const Palette& colors() const { return palette_; }
  [[nodiscard]] QFont font(TextRole role) const;
  /// Colour of an age or a text that carries one.
  [[nodiscard]] QColor ageColor(AgeLevel level) const;
  void setKind(ThemeKind kind);
  void toggle() { setKind(kind_ == ThemeKind::Dark ? ThemeKind::Light : ThemeKind::Dark); }
  /// Palette, style sheet and font of the whole application; called again by setKind().
  void apply();

 signals:
  void changed();

 private:
  ThemeKind kind_;
  Palette palette_;
};

[[nodiscard]] Palette darkPalette();
[[nodiscard]] Palette lightPalette();
[[nodiscard]] QColor mixed(const QColor& a, const QColor& b, double share_of_b);
/// WCAG contrast ratio, 1..21.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);

/// What every widget is given: the look and the clock that holds are measured on.
struct Ui {
  Theme& theme;
  const Clock& clock;
};

}  // namespace kiln::gui

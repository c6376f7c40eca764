#include "gui/widgets/theme.h"

#include <gtest/gtest.h>

namespace kiln::gui {
namespace {

class ThemeContrast : public testing::TestWithParam<ThemeKind> {
 protected:
  Theme theme{GetParam()};
  const Palette& p = theme.colors();
};

TEST_P(ThemeContrast, EveryTextCanBeReadOnEveryGroundItStandsOn) {
  for (const QColor& ground : {p.panel, p.raised, p.sunk, p.ground}) {
    for (const QColor& text : {p.text, p.dim, p.caution, p.fault, p.manual, p.forced, p.sim}) {
      EXPECT_GE(contrast(text, ground), 4.5)
          << text.name().toStdString() << " on " << ground.name().toStdString();
    }
  }
}

TEST_P(ThemeContrast, TextOnFillsCanBeRead) {
  EXPECT_GE(contrast(p.active_text, p.active), 4.5);
  EXPECT_GE(contrast(p.stop_text, p.stop_body), 4.5);
  for (const QColor& fill : {p.caution_fill, p.fault_fill, p.manual_fill, p.forced_fill}) {
    EXPECT_GE(contrast(p.text, fill), 4.5) << fill.name().toStdString();
  }
}

TEST_P(ThemeContrast, ALatchedStopIsBrighterThanAClearOne) {
  EXPECT_GE(contrast(p.stop_latched, p.stop_body), 1.5);
}

INSTANTIATE_TEST_SUITE_P(BothThemes, ThemeContrast,
                         testing::Values(ThemeKind::Dark, ThemeKind::Light));

}  // namespace
}  // namespace kiln::gui

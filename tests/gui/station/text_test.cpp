#include "gui/widgets/text.h"

#include <QFontMetrics>
#include <QTextDocument>
#include <QWidget>

#include <gtest/gtest.h>

#include "common/core/clock.h"
#include "gui/widgets/act_button.h"
#include "gui/widgets/banner.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/label_layout.h"

namespace kiln::gui {
namespace {

QFont small() {
  QFont font(QStringLiteral("Inter"));
  font.setPointSizeF(9);
  return font;
}

TEST(FittedText, WrapsWhatIsTooWideAndKeepsEveryWord) {
  const QString text = "pumps start: water flows within 0.4 s";
  const int width = QFontMetrics(small()).horizontalAdvance(text) * 2 / 3;
  const FittedText one = fitText(text, {small()}, width, 1);
  EXPECT_FALSE(one.whole);
  EXPECT_EQ(one.lines.size(), 1);
  const FittedText two = fitText(text, {small()}, width, 2);
  EXPECT_TRUE(two.whole);
  EXPECT_EQ(two.lines.join(' '), text);
  for (const QString& line : two.lines)
    EXPECT_LE(QFontMetrics(small()).horizontalAdvance(line), width);
}

TEST(FittedText, TakesASmallerFontBeforeItCuts) {
  QFont smaller = small();
  smaller.setPointSizeF(7);
  const QString text = "standstill is proven";
  const int width = QFontMetrics(smaller).horizontalAdvance(text) + 2;
  ASSERT_GT(QFontMetrics(small()).horizontalAdvance(text), width);
  const FittedText fitted = fitText(text, {small(), smaller}, width, 1);
  EXPECT_TRUE(fitted.whole);
  EXPECT_EQ(fitted.font.pointSizeF(), 7);
}

TEST(FittedText, EmptyTextAndNoRoomAreNoCrash) {
  EXPECT_TRUE(fitText({}, {small()}, 100, 1).whole);
  EXPECT_FALSE(fitText("word", {small()}, 0, 1).whole);
  EXPECT_FALSE(fitText("two words", {small()}, -5, 3).whole);
}

TEST(ActButton, AWrappingButtonGrowsUntilItsWordsAreWhole) {
  Theme theme;
  const SteadyClock clock;
  ActButton button({theme, clock}, "Lost target");
  button.setSubtext("gives the search up and goes on to the next place without spraying");
  button.setWrapping(true);
  button.resize(170, button.sizeHint().height());
  EXPECT_FALSE(button.textIsWhole());
  button.resize(170, button.heightForWidth(170));
  EXPECT_TRUE(button.textIsWhole());
  EXPECT_LT(button.heightForWidth(600), button.heightForWidth(170));
}

TEST(LabelLayout, CloseTargetsGetPlatesThatCoverNothing) {
  const QRectF picture(0, 0, 240, 180);
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 6; ++i)  // a row of boxes nearer to each other than their labels are wide
    wishes.push_back({QRectF(60 + 18 * i, 80 + 3 * (i % 2), 14, 14), QSizeF(62, 16)});
  const auto places = placeLabels(wishes, picture);
  ASSERT_EQ(places.size(), wishes.size());
  bool led = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_TRUE(places[i]) << i;
    EXPECT_TRUE(picture.contains(places[i]->plate)) << i;
    led = led || places[i]->leader;
    for (std::size_t k = 0; k < places.size(); ++k) {
      EXPECT_FALSE(places[i]->plate.intersects(wishes[k].target)) << i << " covers target " << k;
      if (k != i) {
        EXPECT_FALSE(places[i]->plate.intersects(places[k]->plate)) << i << " " << k;
      }
    }
  }
  EXPECT_TRUE(led) << "not all can stand at their target";
}

TEST(LabelLayout, ALoneLabelStandsAboveAndOneAtTheRimBelow) {
  const QRectF picture(0, 0, 240, 180);
  const auto above = placeLabels({{QRectF(100, 90, 20, 20), QSizeF(50, 16)}}, picture);
  ASSERT_TRUE(above[0]);
  EXPECT_LT(above[0]->plate.bottom(), 90);
  EXPECT_FALSE(above[0]->leader);
  const auto rim = placeLabels({{QRectF(100, 4, 20, 20), QSizeF(50, 16)}}, picture);
  ASSERT_TRUE(rim[0]);
  EXPECT_GT(rim[0]->plate.top(), 24);
}

TEST(LabelLayout, ATargetThatFillsThePictureIsLabelledAllTheSame) {
  const auto places = placeLabels({{QRectF(-5, -5, 300, 200), QSizeF(50, 16)}}, {0, 0, 240, 180});
  ASSERT_TRUE(places[0]);
  const auto none = placeLabels({{QRectF(1, 1, 4, 4), QSizeF(50, 16)}}, {0, 0, 40, 10});
  EXPECT_FALSE(none[0]) << "a plate larger than the picture has no place";
}

/// What a reader sees of it.
QString shown(const QString& html) {
  QTextDocument document;
  document.setHtml(html);
  return document.toPlainText();
}
const QString kHostile = QStringLiteral("<img src=\"/dev/zero\"> %1 & <b>all is well</b>");

TEST(Markup, ANameFromOutsideStandsThereAsItIs) {
  const Markup words = markup(QStringLiteral("<b>Stopped</b>: %1. %2"), kHostile, "At rest.");
  EXPECT_EQ(shown(words.html()), "Stopped: " + kHostile + ". At rest.");
  EXPECT_FALSE(words.html().contains("<img"));
  EXPECT_EQ(shown(Markup(kHostile).html()), kHostile);
}

TEST(Markup, LabelsBannersAndTipsShowTagsAndDoNotObeyThem) {
  Label label(kHostile);
  EXPECT_EQ(label.textFormat(), Qt::PlainText);
  Theme theme;
  ManualClock clock;
  Banner banner({theme, clock});
  banner.set(kHostile);
  EXPECT_EQ(shown(banner.text()), kHostile);
  QWidget widget;
  setTip(widget, kHostile);
  EXPECT_EQ(shown(widget.toolTip()), kHostile);
  setTip(widget, "plain & simple");
  EXPECT_EQ(widget.toolTip(), "plain & simple");
}

}  // namespace
}  // namespace kiln::gui

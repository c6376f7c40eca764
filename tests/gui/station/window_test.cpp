#include <QGuiApplication>
#include <QLineEdit>
#include <QScreen>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "gui/app/main_window.h"
#include "gui/app/window_memory.h"
#include "gui/views/alarm_strip/alarm_strip.h"
#include "gui/views/fsm_graph/fsm_tile.h"
#include "gui/views/state_card/state_card.h"
#include "gui/views/top_bar/top_bar.h"
#include "tests/gui/support/direct_link.h"

namespace kiln::gui {
namespace {

class WindowTest : public testing::TestWithParam<QSize> {
 protected:
  WindowTest() {
    theme.apply();
    window.resize(GetParam());
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    link.open();
    for (int i = 0; i < 20; ++i) step();
  }
  void step() {
    link.advance(0.1);
    QCoreApplication::processEvents();
    models.flush();
    emit models.aged();
  }
  DirectLink link{true};
  StationModels models{link};
  Theme theme;
  MainWindow window{{theme, link.clock()}, models, {RobotGeometry{}, false}};
};

TEST_P(WindowTest, NothingIsSqueezedOrCutOff) {
  EXPECT_EQ(window.size(), GetParam()) << "the tiles' least sizes force the window larger";
  EXPECT_EQ(window.topBar()->geometry().height(), 48);
  for (const QWidget* child : window.findChildren<QWidget*>()) {
    if (!child->isVisible() || child->window() != &window) continue;
    const QWidget* parent = child->parentWidget();
    const QWidget* grandparent = parent->parentWidget();  // none above the window itself
    if (parent->inherits("QAbstractScrollArea") ||
        (grandparent && grandparent->inherits("QAbstractScrollArea")))
      continue;
    EXPECT_TRUE(parent->rect().adjusted(-2, -2, 2, 2).contains(child->geometry()))
        << child->metaObject()->className() << " '"
        << child->property("text").toString().toStdString() << "' sticks out of "
        << parent->metaObject()->className() << " by "
        << child->geometry().right() - parent->rect().right() << " px to the right, "
        << child->geometry().bottom() - parent->rect().bottom() << " px below";
  }
}

TEST_P(WindowTest, SpaceStopsWhereverTheFocusIs) {
  QTest::keyClick(&window, Qt::Key_Slash);
  auto* search = window.fsmTile()->findChild<QLineEdit*>();
  ASSERT_NE(search, nullptr);
  ASSERT_TRUE(search->isVisible());
  QTest::keyClick(search, Qt::Key_Space);
  models.flush();
  EXPECT_TRUE(models.stop.latched());
  EXPECT_TRUE(search->text().isEmpty());
}

TEST_P(WindowTest, TheThemeChangesAndThePictureWithIt) {
  const QImage dark = window.grab().toImage();
  QTest::keyClick(&window, Qt::Key_T);
  EXPECT_EQ(theme.kind(), ThemeKind::Light);
  const QImage light = window.grab().toImage();
  const auto brightness = [](const QImage& image) {
    double sum = 0;
    for (int y = 0; y < image.height(); y += 7) {
      for (int x = 0; x < image.width(); x += 7) sum += qGray(image.pixel(x, y));
    }
    return sum / (image.width() / 7.0 * (image.height() / 7.0));
  };
  EXPECT_LT(brightness(dark), 80.0);
  EXPECT_GT(brightness(light), 150.0);
}

TEST(WindowMemory, TheWindowOpensWithinItsScreenAndAsItWasLeft) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("station.ini");
  const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
  {
    QWidget window;
    WindowMemory memory(file);
    memory.place(window, {9000, 5000});
    window.show();
    EXPECT_TRUE(room.contains(window.frameGeometry())) << "larger than the screen";
  }
  QWidget left;
  left.setGeometry(37, 61, 801, 603);
  left.show();
  WindowMemory(file).keep(left, ThemeKind::Light);
  QWidget again;
  const WindowMemory memory(file);
  memory.place(again, {});
  EXPECT_EQ(again.size(), left.size());
  EXPECT_EQ(memory.theme(), ThemeKind::Light);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WindowTest,
                         testing::Values(QSize(1366, 768), QSize(1400, 850), QSize(1680, 1020)));

}  // namespace
}  // namespace kiln::gui

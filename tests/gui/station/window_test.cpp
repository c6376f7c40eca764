#include <QFile>
#include <QGuiApplication>
#include <QLineEdit>
#include <QScreen>
#include <QTemporaryDir>
#include <QTest>
#include <functional>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "gui/app/main_window.h"
#include "gui/app/tile_layout.h"
#include "gui/app/window_memory.h"
#include "gui/views/alarm_strip/alarm_list.h"
#include "gui/views/alarm_strip/alarm_strip.h"
#include "gui/views/fsm_graph/fsm_tile.h"
#include "gui/views/fsm_graph/graph_view.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/state_card/state_card.h"
#include "gui/views/teleop/teleop_tile.h"
#include "gui/views/top_bar/stop_button.h"
#include "gui/views/top_bar/top_bar.h"
#include "robot/app/alarm_book.h"
#include "robot/safety/dead_man.h"
#include "tests/gui/support/direct_link.h"
#include "tests/gui/support/text_meter.h"

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

TEST_P(WindowTest, WhatAnOperatorNeedsAtOnceIsThere) {
  const auto there = [&](const QWidget* widget) {
    return widget->isVisible() &&
           window.rect().contains(QRect(widget->mapTo(&window, QPoint()), widget->size()));
  };
  EXPECT_TRUE(there(window.topBar()->stopButton()));
  EXPECT_TRUE(there(window.stateCard()));
  EXPECT_GE(window.stateCard()->height(), 120);
  EXPECT_TRUE(there(window.alarmStrip()));
  JogPanel& jog = window.findChild<TeleopTile*>()->panel();
  for (const QWidget* pad : {&jog.drivePad(), &jog.armPad()}) EXPECT_TRUE(there(pad));
}

TEST_P(WindowTest, NoTextIsBelowNinePoints) {
  for (const auto& disturb : std::vector<std::function<void()>>{
           [] {},
           [&] {
             link.robot().checks[1] = {"LiDAR", false, "no scan", "cable"};
           },
           [&] { link.robot().startMission(); }, [&] { link.robot().stop("Benjamin the second"); },
           [&] { window.showLog(true); }, [&] { link.setSilent(true); }}) {
    disturb();
    for (int i = 0; i < 15; ++i) step();
    const auto smallest = smallestText(window);
    EXPECT_GE(smallest.points, 9.0) << smallest.text.toStdString();
    EXPECT_GT(smallest.texts, 40) << "nothing was painted";
  }
}

TEST_P(WindowTest, JogKeysWorkWhileTheMacrosAreInFront) {
  models.lease.request();
  for (int i = 0; i < 5; ++i) step();
  models.commands.send(SetMode{Mode::Teleop}, "teleop");
  for (int i = 0; i < 10; ++i) step();
  window.tileLayout().showMacros(true);
  ASSERT_TRUE(window.macrosTile()->isVisible());
  QTest::keyPress(window.macrosTile(), Qt::Key_W);
  step();
  EXPECT_TRUE(link.robot().held(kiln::HoldKind::BaseJog));
  QTest::keyRelease(window.macrosTile(), Qt::Key_W);
  step();
  EXPECT_FALSE(link.robot().held(kiln::HoldKind::BaseJog));
}

TEST_P(WindowTest, ADoubleClickOnItsTitleGivesATileTheMiddle) {
  for (Tile* tile : window.findChildren<Tile*>()) {
    if (tile == window.stateCard() || tile == window.macrosTile() || !tile->isVisible() ||
        qobject_cast<TeleopTile*>(tile))
      continue;
    const QSize before = tile->size();
    QTest::mouseDClick(tile, Qt::LeftButton, {}, {12, 12});
    step();
    EXPECT_EQ(window.tileLayout().enlarged(), tile);
    EXPECT_GE(tile->height(), before.height());
    EXPECT_GT(tile->width() * tile->height(), 0.35 * window.width() * window.height());
    QTest::mouseDClick(tile, Qt::LeftButton, {}, {12, 12});
    step();
    EXPECT_EQ(tile->size(), before);
  }
}

TEST_P(WindowTest, TheGraphSaysThatThereIsMoreOfIt) {
  const GraphView& graph = *window.fsmTile()->graph();
  window.tileLayout().bringToFront(*window.fsmTile());
  step();
  int cut = 0;
  for (const FsmStateInfo& state : models.fsm.info()->states) {
    const auto box = graph.nodeRect(QString::fromStdString(state.name));
    ASSERT_TRUE(box);
    cut += box->bottom() > graph.height() + 3 || box->top() < -3 ? 1 : 0;
  }
  EXPECT_EQ(graph.hiddenAbove() + graph.hiddenBelow(), cut);
  const bool fits = GetParam().height() >= 1000;
  EXPECT_EQ(cut == 0, fits) << cut << " states are cut off";
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

TEST_P(WindowTest, F2OpensTheListOfAlarmsAndEscClosesIt) {
  for (int i = 0; i < 12; ++i)
    link.robot().alarms().set(
        "many." + std::to_string(i), true, AlarmLevel::Warning,
        "STOP by motion watch: the wheels turn at 0.41 m/s, 0.20 m/s are told",
        "look at the wheels and at what the robot stands against", link.robot().now());
  step();
  const AlarmList& list = *window.alarmList();
  EXPECT_FALSE(list.isVisible());
  const auto over = [&](const QWidget& other) {
    return QRect(other.mapTo(&window, QPoint()), other.size()).intersects(list.geometry());
  };
  for (const Qt::Key close : {Qt::Key_F2, Qt::Key_Escape}) {
    QTest::keyClick(&window, Qt::Key_F2);
    step();
    ASSERT_TRUE(list.isVisible());
    EXPECT_EQ(list.rows().size(), 12U);
    EXPECT_TRUE(window.rect().contains(list.geometry()));
    for (const QWidget* kept :
         {static_cast<QWidget*>(window.topBar()), static_cast<QWidget*>(window.stateCard()),
          static_cast<QWidget*>(window.alarmStrip()), static_cast<QWidget*>(window.macrosTile())})
      EXPECT_FALSE(kept->isVisible() && over(*kept)) << kept->metaObject()->className();
    QTest::keyClick(&window, close);
    step();
    EXPECT_FALSE(list.isVisible()) << "key " << close;
  }
  // While a word is typed into the search, too.
  QTest::keyClick(&window, Qt::Key_Slash);
  QTest::keyClick(window.fsmTile()->findChild<QLineEdit*>(), Qt::Key_F2);
  EXPECT_TRUE(list.isVisible());
  QTest::keyClick(window.fsmTile()->findChild<QLineEdit*>(), Qt::Key_Escape);
  EXPECT_FALSE(list.isVisible());
  EXPECT_FALSE(window.fsmTile()->findChild<QLineEdit*>()->isVisible());
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
  WindowMemory(file).keep(left, ThemeKind::Light, "log");
  QWidget again;
  const WindowMemory memory(file);
  memory.place(again, {});
  EXPECT_EQ(again.size(), left.size());
  EXPECT_EQ(memory.theme(), ThemeKind::Light);
  EXPECT_EQ(memory.choices(), "log");
}

TEST(WindowMemory, ABrokenOrForeignFileIsSurvived) {
  const QTemporaryDir folder;
  const QString garbage = folder.filePath("garbage"), foreign = folder.filePath("foreign"),
                pipe = folder.filePath("pipe");
  QFile file(garbage);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray("\xff\0[[[window\n=%%\\x@ByteArray(", 26) + QByteArray(5000, '\xfe'));
  file.close();
  QSettings other(foreign, QSettings::IniFormat);
  other.setValue("window/geometry", QByteArray(70, '\x7f'));
  other.setValue("window/theme", 17);
  other.setValue("window/choices", QByteArray(100, '\0'));
  other.sync();
  ASSERT_EQ(::mkfifo(pipe.toLocal8Bit().constData(), 0600), 0);
  for (const QString& name : {garbage, foreign, pipe, folder.path(), QString("/dev/zero")}) {
    QWidget window;
    WindowMemory memory(name);
    memory.place(window, {});
    window.show();
    EXPECT_EQ(memory.theme(), ThemeKind::Dark);
    EXPECT_TRUE(
        QGuiApplication::primaryScreen()->availableGeometry().contains(window.frameGeometry()))
        << name.toStdString();
    memory.keep(window, ThemeKind::Dark, {});
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, WindowTest,
                         testing::Values(TileLayout::kLeast, QSize(1280, 690), QSize(1366, 768),
                                         QSize(1400, 850), QSize(1680, 1020)));

}  // namespace
}  // namespace kiln::gui

#include "gui/app/stop_probe.h"

#include <QKeyEvent>
#include <QWidget>

#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

/// Does what the main window does with the STOP key, nothing else.
class KeyWindow : public QWidget {
 public:
  explicit KeyWindow(StationModels& models) : models_(models) {}

 protected:
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Pause) models_.stop.press();
  }

 private:
  StationModels& models_;
};

class StopProbeTest : public testing::Test {
 protected:
  StopProbeTest() {
    QObject::connect(&probe, &StopProbe::finished, [this] { finished = true; });
    QObject::connect(&probe, &StopProbe::failed,
                     [this](const QString& reason) { failure = reason.toStdString(); });
  }
  void run(double seconds) {
    for (double t = 0; t < seconds && !finished && failure.empty(); t += 0.1) {
      probe.step();
      station.pass(0.1);
    }
  }
  SteppedStation station;
  KeyWindow window{station.models};
  StopProbe probe{window, station.models, 3};
  bool finished = false;
  std::string failure;
};

// The robot answers within the press, as a quick robot does before the window has looked.
TEST_F(StopProbeTest, TimesEveryPressThoughTheAnswerIsAtOnce) {
  run(20.0);
  EXPECT_TRUE(finished) << failure;
  EXPECT_EQ(probe.latchS().size(), 3U);
  EXPECT_FALSE(station.models.stop.latched());
}

TEST_F(StopProbeTest, NamesTheStepThatIsNotReached) {
  station.link.setSilent(true);
  run(20.0);
  EXPECT_FALSE(finished);
  EXPECT_NE(failure.find("in vain for the answer to the STOP, after 0 of 3"), std::string::npos)
      << failure;
}

}  // namespace
}  // namespace kiln::gui

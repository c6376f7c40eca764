#include "tests/gui/by_hand/hand.h"

#include <QAbstractButton>
#include <QTest>

#include "tests/gui/support/text_meter.h"

namespace kiln::gui {

namespace {
// The rhythm of a hand, part of what is measured: nothing is awaited in it.
constexpr int kMove_ms = 250;  // of the pointer to where it is wanted
constexpr int kMoveSteps = 10;
constexpr int kTap_ms = 90;
}  // namespace

bool Hand::waitFor(double seconds, const std::function<bool()>& seen) {
  return QTest::qWaitFor(seen, static_cast<int>(1000 * seconds));
}

void Hand::look(double seconds) { QTest::qWait(static_cast<int>(1000 * seconds)); }

QWidget* Hand::button(const QString& words) const {
  for (auto* button : window_.findChildren<QAbstractButton*>())
    if (button->isVisible() && button->isEnabled() && button->text() == words) return button;
  return nullptr;
}

void Hand::pointAt(const QPoint& global) {
  const QPoint from = at_;
  for (int i = 1; i <= kMoveSteps; ++i) {
    at_ = from + (global - from) * i / kMoveSteps;
    x_.moveTo(at_.x(), at_.y());
    QTest::qWait(kMove_ms / kMoveSteps);
  }
}

bool Hand::click(const QString& words) { return hold(words, 0.001 * kTap_ms); }

bool Hand::hold(const QString& words, double seconds) {
  return holdUntil(words, seconds, [] { return false; });
}

bool Hand::holdUntil(const QString& words, double limit_s, const std::function<bool()>& done) {
  QWidget* target = button(words);
  if (!target) return false;
  pointAt(target->mapToGlobal(target->rect().center()));
  x_.press();
  waitFor(limit_s, done);
  x_.release();
  look(0.05);
  return true;
}

void Hand::drag(QWidget& widget, const QPoint& from, const QPoint& to) {
  pointAt(widget.mapToGlobal(from));
  x_.press();
  pointAt(widget.mapToGlobal(to));
  x_.release();
  look(0.05);
}

void Hand::key(char letter, bool down) {
  if (down_.contains(QLatin1Char(letter)) == down) return;
  down ? down_.append(QLatin1Char(letter)) : down_.remove(QLatin1Char(letter));
  x_.key(static_cast<unsigned long>(letter), down);
}

void Hand::letGo() {
  const QString down = down_;
  for (const QChar letter : down) key(letter.toLatin1(), false);
  x_.release();
}

QString Hand::painted(QWidget& widget) { return paintedText(widget); }

}  // namespace kiln::gui

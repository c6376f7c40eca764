#include "gui/views/state_card/exit_list.h"

#include <QEvent>
#include <QPainter>
#include <algorithm>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kGap_px = 5;
constexpr int kWide_px = 57;  // title and two lines, over the whole width
constexpr int kTall_px = 84;  // title and four lines, over half of it
constexpr int kTitle_px = 30, kStrip_px = 36;
constexpr int kNarrow_pct = 85, kNarrowest_pct = 72;
}  // namespace

ExitList::ExitList(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  arrange();
}

void ExitList::setExits(const std::vector<Exit>& exits) {
  for (ActButton* button : buttons_) {
    button->hide();
    button->deleteLater();
  }
  buttons_.clear();
  pointed_ = nullptr;
  exits_ = exits;
  if (exits_.size() > kMost) exits_.resize(kMost);
  for (const Exit& exit : exits_) {
    auto* button = new ActButton(ui_, QStringLiteral("→ ") + exit.label, this);
    button->installEventFilter(this);
    connect(button, &QAbstractButton::clicked, this, [this, to = exit.to] { emit picked(to); });
    buttons_.push_back(button);
    button->show();
  }
  arrange();
  setLock(lock_);
}

void ExitList::setRoom(Room room) {
  if (room == room_) return;
  room_ = room;
  arrange();
}

bool ExitList::strip() const {
  const std::size_t whole = room_ == Room::Tall ? kMost : room_ == Room::Middle ? 2 : 1;
  return exits_.size() > whole;
}

void ExitList::setLock(const QString& why) {
  lock_ = why;
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    buttons_[i]->setEnabled(why.isEmpty());
    const QString& does = exits_[i].consequence;
    setTip(*buttons_[i], why.isEmpty() ? tr("%1.\nThen hold to jump, below the graph.").arg(does)
                                       : tr("%1.\nNot now: %2").arg(does, why));
  }
}

/// Rows of half width where each is too low for its words, else of the whole width.
void ExitList::arrange() {
  const int count = static_cast<int>(buttons_.size());
  const int columns = count > 2 || strip() ? 2 : 1;
  const int row_px = columns == 1 ? kWide_px : strip() ? kTitle_px : kTall_px;
  const int rows = (count + columns - 1) / columns;
  for (int n = 0; n < count; ++n) {
    const bool alone = n == count - 1 && n % columns == 0;
    const int width_px = alone ? width() : (width() - kGap_px * (columns - 1)) / columns;
    ActButton* button = buttons_[static_cast<std::size_t>(n)];
    button->setSubtext(strip() ? QString() : exits_[static_cast<std::size_t>(n)].consequence);
    button->setGeometry(n % columns == 0 ? 0 : width() - width_px, n / columns * (row_px + kGap_px),
                        width_px, row_px);
  }
  const int buttons_px = rows * row_px + std::max(0, rows - 1) * kGap_px;
  const int height_px = buttons_px + (strip() ? kGap_px + kStrip_px : 0);
  if (height_px != minimumHeight()) setFixedHeight(height_px);
  update();
}

void ExitList::resizeEvent(QResizeEvent*) { arrange(); }

bool ExitList::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Enter:
    case QEvent::FocusIn:
      pointed_ = static_cast<ActButton*>(watched);
      update();
      break;
    case QEvent::Leave:
    case QEvent::FocusOut:
      pointed_ = nullptr;
      update();
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

QString ExitList::told() const {
  if (!strip()) return {};
  for (std::size_t i = 0; i < buttons_.size(); ++i)
    if (buttons_[i] == pointed_) return tr("%1: %2").arg(exits_[i].label, exits_[i].consequence);
  return tr("Go there instead: point at one to read what the robot does then");
}

FittedText ExitList::fitted() const {
  const QFont small = ui_.theme.font(TextRole::Small);
  return fitText(told(), {small, condensed(small, kNarrow_pct), condensed(small, kNarrowest_pct)},
                 width(), 2);
}

bool ExitList::whole() const {
  for (const ActButton* button : buttons_)
    if (!button->textIsWhole()) return false;
  return fitted().whole;
}

void ExitList::paintEvent(QPaintEvent*) {
  if (!strip()) return;
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setPen(pointed_ ? p.text : p.dim);
  paintFitted(painter, QRectF(0, height() - kStrip_px, width(), kStrip_px),
              Qt::AlignLeft | Qt::AlignVCenter, fitted());
}

}  // namespace kiln::gui

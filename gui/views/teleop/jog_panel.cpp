#include "gui/views/teleop/jog_panel.h"

#include <QButtonGroup>
#include <QGridLayout>
#include <QKeyEvent>
#include <QPainter>
#include <QToolButton>

#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kWordButton_px = 28, kJointButton_px = 13;
constexpr int kFirstJoint = 2;  // ids of the mode buttons: 0 Move, 1 Turn, 2..7 joints 1..6

QString caption(bool joints, int joint) {
  return joints ? JogPanel::tr("arm joint %1").arg(joint + 1) : JogPanel::tr("arrows PgUp/Dn ⇧");
}
}  // namespace

JogPanel::JogPanel(const Ui& ui, HoldToRun& hold, QWidget* parent)
    : QWidget(parent),
      ui_(ui),
      hold_(hold),
      drive_(new JogPad(ui, JogPad::Axes::Both)),
      turn_(new JogPad(ui, JogPad::Axes::Horizontal)),
      arm_(new JogPad(ui, JogPad::Axes::Both)),
      up_(new JogPad(ui, JogPad::Axes::Vertical)),
      drive_caption_(new Label(tr("W A S D · Q E"))),
      arm_caption_(new Label),
      modes_(new QButtonGroup(this)) {
  setFocusPolicy(Qt::StrongFocus);
  build();
  connect(drive_, &JogPad::moved, this, [this](const QPointF& v) {
    mixer_.drive = v;
    push();
  });
  connect(turn_, &JogPad::moved, this, [this](const QPointF& v) {
    mixer_.turn = v.x();
    push();
  });
  connect(arm_, &JogPad::moved, this, [this](const QPointF& v) {
    mixer_.arm = v;
    push();
  });
  connect(up_, &JogPad::moved, this, [this](const QPointF& v) {
    mixer_.arm_up = v.y();
    push();
  });
  connect(&hold_, &HoldToRun::tripped, this, &JogPanel::rest);
  connect(&ui_.theme, &Theme::changed, this, &JogPanel::restyle);
  turn_->setEnds(QStringLiteral("↻"), QStringLiteral("↺"), {}, {});
  setArmMode(ArmJogMode::Move, 0);
  restyle();
}

void JogPanel::build() {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(5, 3, 5, 1);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->addWidget(drive_, 0, 0, Qt::AlignCenter);
  grid->addWidget(turn_, 1, 0, Qt::AlignCenter);
  auto* arm = new QHBoxLayout;
  arm->setSpacing(8);
  arm->addStretch(1);
  arm->addWidget(arm_);
  arm->addWidget(up_);
  QSizePolicy kept = up_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);  // the stick beside it stays where it is
  up_->setSizePolicy(kept);
  arm->addStretch(1);
  grid->addLayout(arm, 0, 2);
  grid->addWidget(buildArmModes(), 1, 2, Qt::AlignCenter);
  grid->addWidget(drive_caption_, 2, 0, Qt::AlignCenter);
  grid->addWidget(arm_caption_, 2, 2, Qt::AlignCenter);
  grid->setColumnMinimumWidth(1, 2);
}

QWidget* JogPanel::buildArmModes() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  const auto add = [&](const QString& text, const QString& tip, int id) {
    auto* button = new QToolButton;
    button->setText(text);
    setTip(*button, tip);
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    button->setFixedWidth(id < kFirstJoint ? kWordButton_px : kJointButton_px);
    modes_->addButton(button, id);
    row->addWidget(button);
  };
  add(tr("xyz"), tr("tool forward, left, up, along the robot's axes"), 0);
  add(tr("rpy"), tr("tool pitch, yaw, roll"), 1);
  for (int i = 0; i < 6; ++i)
    add(QString::number(i + 1), tr("joint %1, by the stick to the sides").arg(i + 1),
        kFirstJoint + i);
  connect(modes_, &QButtonGroup::idClicked, this, [this](int id) {
    setArmMode(id == 0   ? ArmJogMode::Move
               : id == 1 ? ArmJogMode::Turn
                         : ArmJogMode::Joint,
               std::max(0, id - kFirstJoint));
  });
  return bar;
}

void JogPanel::setArmMode(ArmJogMode mode, int joint) {
  mixer_.arm_mode = mode;
  mixer_.joint = joint;
  const bool joints = mode == ArmJogMode::Joint;
  up_->setVisible(!joints);
  const QString sign = joints ? QString::number(joint + 1) : QString();
  arm_->setEnds(joints ? sign + "+" : QString(), joints ? sign + "−" : QString(), {}, {});
  up_->setEnds({}, {}, mode == ArmJogMode::Turn ? QStringLiteral("↻") : QStringLiteral("up"),
               mode == ArmJogMode::Turn ? QStringLiteral("↺") : QStringLiteral("dn"));
  arm_caption_->setText(caption(joints, joint));
  restyle();
}

void JogPanel::push() {
  const JogBase base = mixer_.base(keys_);
  const JogArm arm = mixer_.armSetpoint(keys_);
  // hold() refuses while locked and trips what runs; then rest() has already put everything back.
  if (JogMixer::moves(base)) {
    if (!hold_.hold(HoldKind::Base, base)) return rest();
  } else {
    hold_.release(HoldKind::Base);
  }
  if (JogMixer::moves(arm)) {
    if (!hold_.hold(HoldKind::Arm, arm)) return rest();
  } else {
    hold_.release(HoldKind::Arm);
  }
  showKeys();
}

void JogPanel::showKeys() {
  const Eigen::Vector3d base = keys_.base(), move = keys_.armMove(), turn = keys_.armTurn();
  drive_->setShown({-base.y(), base.x()});
  turn_->setShown({-base.z(), 0.0});
  arm_->setShown({-move.y() - turn.z(), move.x() - turn.y()});
  up_->setShown({0.0, move.z() + turn.x()});
}

void JogPanel::rest() {
  keys_.clear();
  mixer_.rest();
  for (JogPad* pad : {drive_, turn_, arm_, up_}) pad->rest();
}

void JogPanel::setLocked(bool locked) {
  for (JogPad* pad : {drive_, turn_, arm_, up_}) pad->setEnabled(!locked);
}

void JogPanel::listenIn(QWidget& other) {
  other.setFocusPolicy(Qt::ClickFocus);
  other.installEventFilter(this);
}

bool JogPanel::eventFilter(QObject* watched, QEvent* event) {
  const bool press = event->type() == QEvent::KeyPress;
  if (!press && event->type() != QEvent::KeyRelease) return QWidget::eventFilter(watched, event);
  auto* key = static_cast<QKeyEvent*>(event);
  if (!JogKeys::jogs(key->key()) && key->key() != Qt::Key_Shift)
    return QWidget::eventFilter(watched, event);
  press ? keyPressEvent(key) : keyReleaseEvent(key);
  return true;
}

void JogPanel::keyPressEvent(QKeyEvent* event) {
  keys_.setShift(event->modifiers() & Qt::ShiftModifier);
  if (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier) ||
      !keys_.press(event->key(), event->isAutoRepeat())) {
    if (event->key() == Qt::Key_Shift) push();
    return QWidget::keyPressEvent(event);
  }
  if (!event->isAutoRepeat()) push();
}

void JogPanel::keyReleaseEvent(QKeyEvent* event) {
  keys_.setShift(event->modifiers() & Qt::ShiftModifier);
  const bool jog = keys_.release(event->key(), event->isAutoRepeat());
  if (!jog && event->key() != Qt::Key_Shift) return QWidget::keyReleaseEvent(event);
  if (!event->isAutoRepeat()) push();
}

void JogPanel::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  update();
}

void JogPanel::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  update();
}

void JogPanel::paintEvent(QPaintEvent*) {
  if (!hasFocus()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(ui_.theme.colors().manual, 1.0, Qt::DashLine));
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
}

void JogPanel::restyle() {
  const Palette& p = ui_.theme.colors();
  for (Label* label : {drive_caption_, arm_caption_}) {
    label->setFont(ui_.theme.font(TextRole::Small));
    label->setStyleSheet(QStringLiteral("color: %1").arg(p.dim.name()));
  }
  // As wide as its longest words: the sticks stand still when they change.
  const QFontMetrics metrics(ui_.theme.font(TextRole::Small));
  arm_caption_->setAlignment(Qt::AlignCenter);
  arm_caption_->setFixedWidth(std::max(metrics.horizontalAdvance(caption(false, 0)),
                                       metrics.horizontalAdvance(caption(true, 0))) +
                              2);
  const int chosen = mixer_.arm_mode == ArmJogMode::Move   ? 0
                     : mixer_.arm_mode == ArmJogMode::Turn ? 1
                                                           : kFirstJoint + mixer_.joint;
  for (QAbstractButton* button : modes_->buttons()) {
    const bool on = modes_->id(button) == chosen;
    button->setChecked(on);
    button->setFont(ui_.theme.font(TextRole::Small));
    button->setStyleSheet(QStringLiteral("QToolButton { border: none; border-radius: 3px; padding: "
                                         "2px 0px; color: %1; background: %2; }")
                              .arg(on ? p.text.name() : p.dim.name(),
                                   on ? p.raised.name() : QStringLiteral("transparent")));
  }
}

}  // namespace kiln::gui

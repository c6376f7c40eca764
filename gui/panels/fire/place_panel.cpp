#include "gui/panels/fire/place_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "common/wire/fire/fire_view.h"
#include "gui/models/localization_model.h"
#include "gui/widgets/text.h"
#include "gui/widgets/word_stack.h"

namespace kiln::gui {

namespace {
constexpr int kWidth_px = 316;
constexpr int kStepHeight_px = 28, kActHeight_px = 42;
constexpr int kWords_px = 82;  // five lines: the keys below stand still whatever is said
constexpr double kHold_s = 1.0;

QString signedLength(double metres) {
  return (metres < 0 ? QStringLiteral("−") : QStringLiteral("+")) + lengthText(std::abs(metres));
}
}  // namespace

PlacePanel::PlacePanel(const Ui& ui, StationModels& models, QWidget* parent)
    : SceneCard(parent),
      ui_(ui),
      models_(models),
      nudge_(models),
      name_(new ActButton(ui, tr("place"))),
      close_(new ActButton(ui, QStringLiteral("×"))),
      words_(new Banner(ui, TextRole::Small)),
      sensed_(new ActButton(ui, tr("Take sensed"))),
      cancel_(new ActButton(ui, tr("Undo"))),
      move_(new HoldButton(ui, tr("Move place"), kHold_s)),
      go_on_(new HoldButton(ui, tr("Go on anyway"), kHold_s)) {
  setObjectName(QStringLiteral("overlay"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(6);
  auto* head = new QHBoxLayout;
  name_->setFixedHeight(kStepHeight_px);
  setTip(*name_, tr("show the next fire place"));
  close_->setFixedSize(kStepHeight_px, kStepHeight_px);
  setTip(*close_, tr("close"));
  head->addWidget(name_, 1);
  head->addWidget(close_);
  column->addLayout(head);
  auto* said = new WordStack(0);
  said->setFixedHeight(kWords_px);
  said->add(words_);
  column->addWidget(said);
  auto* steps = new QHBoxLayout;
  steps->setSpacing(4);
  steps_ = {step(tr("x−"), tr("2 cm towards −x of the map"), -kStep_m, 0, 0),
            step(tr("x+"), tr("2 cm towards +x of the map"), kStep_m, 0, 0),
            step(tr("y−"), tr("2 cm towards −y of the map"), 0, -kStep_m, 0),
            step(tr("y+"), tr("2 cm towards +y of the map"), 0, kStep_m, 0),
            step(QStringLiteral("↻"), tr("1 degree clockwise"), 0, 0, -kStepYaw_rad),
            step(QStringLiteral("↺"), tr("1 degree counter-clockwise"), 0, 0, kStepYaw_rad)};
  for (ActButton* button : steps_) steps->addWidget(button, 1);
  column->addLayout(steps);
  auto* acts = new QGridLayout;
  acts->setSpacing(6);
  for (const int side : {0, 1}) {
    acts->setColumnStretch(side, 1);
    acts->setColumnMinimumWidth(side, (kWidth_px - 22) / 2);
  }
  setTip(*sensed_, tr("wish the configured place where the cloud shows the box"));
  setTip(*cancel_, tr("forget the wish"));
  move_->setKind(ActKind::Manual);
  move_->setSubtext(tr("hold 1 s"));
  go_on_->setKind(ActKind::Caution);
  go_on_->setSubtext(tr("hold 1 s, look first"));
  for (ActButton* button : {sensed_, cancel_}) button->setFixedHeight(kStepHeight_px);
  for (ActButton* button : {static_cast<ActButton*>(move_), static_cast<ActButton*>(go_on_)})
    button->setFixedHeight(kActHeight_px);
  acts->addWidget(sensed_, 0, 0);
  acts->addWidget(cancel_, 0, 1);
  acts->addWidget(move_, 1, 0);
  acts->addWidget(go_on_, 1, 1);
  column->addLayout(acts);
  connect(name_, &QAbstractButton::clicked, this, &PlacePanel::next);
  connect(close_, &QAbstractButton::clicked, this, &PlacePanel::toggle);
  connect(sensed_, &QAbstractButton::clicked, &nudge_, &PlaceNudge::wishSensed);
  connect(cancel_, &QAbstractButton::clicked, &nudge_, &PlaceNudge::cancel);
  connect(move_, &HoldButton::completed, &nudge_, &PlaceNudge::confirm);
  connect(go_on_, &HoldButton::completed, &nudge_, &PlaceNudge::continueDespite);
  connect(&nudge_, &PlaceNudge::changed, this, &PlacePanel::refresh);
  connect(&models_, &StationModels::aged, this, &PlacePanel::refreshButtons);
  connect(&ui_.theme, &Theme::changed, this, &PlacePanel::restyle);
  restyle();
  refresh();
}

ActButton* PlacePanel::step(const QString& text, const QString& tip, double dx, double dy,
                            double dyaw) {
  auto* button = new ActButton(ui_, text);
  button->setFixedHeight(kStepHeight_px);
  setTip(*button, tip);
  connect(button, &QAbstractButton::clicked, this, [=, this] { nudge_.add(dx, dy, dyaw); });
  return button;
}

void PlacePanel::toggle() {
  opened_ = isHidden();
  closed_for_ = opened_ ? QString() : nudge_.misplaced();
  if (!opened_) nudge_.cancel();
  refresh();
}

bool PlacePanel::open(const SceneItem& item) {
  const QString name = QString::fromStdString(item.id);
  if (!nudge_.place(name)) return false;
  nudge_.select(name);
  opened_ = true;
  refresh();
  return true;
}

std::vector<SceneItem> PlacePanel::ghosts() const {
  constexpr double kGhost_px = 2.5;
  const FirePlaceInfo* place = nudge_.hasWish() ? nudge_.place(nudge_.selected()) : nullptr;
  if (!place) return {};
  FirePlaceInfo moved = *place;
  moved.p_map += Eigen::Vector3d(nudge_.wish().x_m, nudge_.wish().y_m, 0.0);
  moved.yaw_rad += nudge_.wish().yaw_rad;
  return fire::boxItems(moved.name, fire::frontOf(moved), ItemStyle::Intent, kGhost_px);
}

std::optional<Eigen::Vector2d> PlacePanel::subject() const {
  const FirePlaceInfo* place = isHidden() ? nullptr : nudge_.place(nudge_.selected());
  if (!place) return std::nullopt;
  return Eigen::Vector2d(place->p_map.head<2>());
}

void PlacePanel::next() {
  const QStringList names = nudge_.places();
  if (names.isEmpty()) return;
  nudge_.select(names[(names.indexOf(nudge_.selected()) + 1) % names.size()]);
}

void PlacePanel::refresh() {
  const QString bad = nudge_.misplaced();
  if (bad.isEmpty()) closed_for_.clear();
  setVisible(opened_ || (!bad.isEmpty() && bad != closed_for_));
  if (isHidden()) {
    emit refreshed();
    return;
  }
  const QString place = nudge_.selected();
  const PlaceCheck* check = nudge_.check(place);
  name_->setText(place.isEmpty() ? tr("no fire place") : place);
  Markup text = check ? markup(QStringLiteral("<b>%1</b>"), offsetText(*check))
                      : Markup(tr("The robot has not looked at it yet."));
  // What an operator has done comes first: the last lines may not find room.
  if (nudge_.hasWish()) {
    const Pose2& wish = nudge_.wish();
    text += markup(tr("<br>wish: x %1, y %2, yaw %3"), signedLength(wish.x_m),
                   signedLength(wish.y_m), angleText(wish.yaw_rad));
  }
  if (!nudge_.refusal().isEmpty()) text += markup(QStringLiteral("<br>%1"), nudge_.refusal());
  if (check && !check->reason.empty())
    text += markup(QStringLiteral("<br>%1"), QString::fromStdString(check->reason));
  const bool caution =
      !nudge_.refusal().isEmpty() || (check && check->verdict == PlaceVerdict::Misplaced);
  words_->set(text, caution ? BannerKind::Caution : BannerKind::Plain);
  refreshButtons();
  if (const QSize needs(kWidth_px, sizeHint().height()); needs != size()) {
    resize(needs);
    emit resized();
  }
  raise();
  emit refreshed();
}

void PlacePanel::refreshButtons() {
  if (isHidden()) return;
  QString why;
  const bool may = models_.mayCommand(&why);
  const PlaceCheck* check = nudge_.check(nudge_.selected());
  const FsmStatus* fsm = models_.fsm.status();
  for (ActButton* button : steps_) button->setEnabled(may && !nudge_.selected().isEmpty());
  sensed_->setEnabled(may && check && check->X_map_sensed.has_value());
  cancel_->setEnabled(nudge_.hasWish());
  move_->setEnabled(may && nudge_.hasWish());
  setTip(*move_, may ? tr("The robot then drives and aims by the moved place.") : why);
  go_on_->setEnabled(may && fsm && fsm->running && check &&
                     check->verdict == PlaceVerdict::Misplaced);
  setTip(*go_on_, may ? tr("The mission goes on with the place as it is configured.") : why);
}

void PlacePanel::restyle() {
  const Palette& p = ui_.theme.colors();
  setStyleSheet(
      QStringLiteral("#overlay { background: %1; border: 1px solid %2; border-radius: 4px; }")
          .arg(p.panel.name(), p.border.name()));
}

}  // namespace kiln::gui

#include "gui/views/state_card/state_card.h"

#include <QGridLayout>
#include <QResizeEvent>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kMaxExits = 4;
constexpr int kExitsBesideRelease = 2;  // the release needs the room
constexpr int kExitsInOneColumn = 2;    // more stand two a row, and their texts are shorter
constexpr int kLow_px = 300;
constexpr int kTight_px = 200;  // no room for exits; they are in the graph
constexpr double kInputAmber_s = 0.5;
constexpr double kInputRed_s = 2.0;
constexpr double kInputShown_s = 0.005;

bool warned(const RobotStatus& status) {
  return std::any_of(status.checks.begin(), status.checks.end(),
                     [](const Check& check) { return check.warn; });
}
bool needsRelease(ArmSafetyMode mode) { return mode == ArmSafetyMode::ProtectiveStop; }
}  // namespace

StateCard::StateCard(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent)
    : Tile(ui, tr("State"), parent),
      ui_(ui),
      models_(models),
      jump_(jump),
      notice_(new Banner(ui)),
      display_(new Banner(ui)),
      ticks_(new TickList(ui)),
      preflight_(new PreflightList(ui)),
      release_(new HoldButton(ui, tr("Release protective stop"), 1.0)),
      exits_title_(new Banner(ui, TextRole::Small)),
      exits_grid_(new QGridLayout) {
  auto* body = new QWidget;
  auto* column = new QVBoxLayout(body);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  release_->setKind(ActKind::Caution);
  release_->setSubtext(tr("hold 1 s; the arm stays where it is"));
  exits_title_->setDim(true);
  exits_grid_->setContentsMargins(0, 0, 0, 0);
  exits_grid_->setSpacing(6);
  for (const int side : {0, 1}) exits_grid_->setColumnStretch(side, 1);
  column->addWidget(release_);  // above words that change: it must not move under the hand
  column->addWidget(notice_);
  column->addWidget(display_);
  column->addWidget(ticks_);
  column->addWidget(preflight_, 100);
  column->addStretch(1);
  column->addWidget(exits_title_);
  column->addLayout(exits_grid_);
  setContent(body);
  connect(release_, &HoldButton::completed, this, [this] {
    models_.commands.send(ReleaseProtectiveStop{}, tr("release the protective stop"));
  });
  connect(&models_.fsm, &Model::changed, this, &StateCard::refresh);
  connect(&models_.status, &Model::changed, this, &StateCard::refresh);
  connect(&models_.lease, &Model::changed, this, &StateCard::refresh);
  connect(&models_, &StationModels::aged, this, &StateCard::refresh);
  connect(&ui_.theme, &Theme::changed, this, &StateCard::refresh);
  refresh();
}

std::vector<TickList::Row> StateCard::guardRows(const FsmStatus& fsm) const {
  std::vector<TickList::Row> rows;
  for (const GuardStatus& guard : fsm.guards) {
    TickList::Row row;
    // A paused machine does not look at its guards: their age then says nothing of the inputs.
    const bool never = guard.input_age_s < 0, aged = !never && !fsm.paused;
    row.mark = guard.met ? TickList::Mark::Met
               : never   ? TickList::Mark::Attention
                         : TickList::Mark::Waiting;
    row.name = QString::fromStdString(guard.name);
    row.detail = QString::fromStdString(guard.detail);
    if (aged && guard.input_age_s >= kInputAmber_s) {
      row.level = guard.input_age_s >= kInputRed_s ? AgeLevel::Red : AgeLevel::Amber;
      row.mark = TickList::Mark::Attention;
    }
    if (aged && guard.input_age_s >= kInputShown_s) {
      row.detail +=
          (row.detail.isEmpty() ? QString{} : QStringLiteral(" · ")) + ageText(guard.input_age_s);
    } else if (never && row.detail.isEmpty()) {
      row.detail = tr("no input yet");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void StateCard::refreshHeader(const FsmStatus& fsm) {
  setTitle(models_.fsm.label(models_.fsm.current()));
  const double in_state_s = models_.fsm.timeInStateS();
  const FsmStateInfo* state = models_.fsm.state(models_.fsm.current());
  if (fsm.terminal) {
    setInfo(fsm.success ? tr("mission succeeded") : tr("mission ended without success"));
  } else if (models_.fsm.ageLevel() != AgeLevel::Fresh) {
    setInfo(tr("%1 s when last heard").arg(in_state_s, 0, 'f', 1));
  } else if (state && state->time_limit_s > 0) {
    setInfo(
        tr("in state %1 s of %2 s").arg(in_state_s, 0, 'f', 1).arg(state->time_limit_s, 0, 'f', 0));
  } else {
    setInfo(tr("in state %1 s").arg(in_state_s, 0, 'f', 1));
  }
}

void StateCard::refreshNotice() {
  const RobotStatus* status = models_.status.status();
  const FsmStatus* fsm = models_.fsm.status();
  Markup text;
  bool fault = false;
  bool good = false;
  if (status && models_.status.word() == StatusWord::Stopped) {
    text = markup(
        tr("<b>Stopped</b>: %1. %2"), QString::fromStdString(status->stop.source),
        status->stop.standstill_proven ? tr("Standstill is proven.") : tr("Coming to rest …"));
    fault = true;
  } else if (status && needsRelease(status->arm.safety)) {
    text = markup(tr("<b>Protective stop of the arm.</b> Look at the arm, then release it."));
    fault = true;
  } else if (fsm && fsm->terminal) {
    good = fsm->success;
    text = good ? markup(tr("✓ <b>Mission succeeded.</b>"))
                : markup(tr("<b>Mission ended without success.</b>"));
  } else if (fsm && !fsm->blocked.empty()) {
    text = markup(tr("<b>Mission blocked</b>: %1"), QString::fromStdString(fsm->blocked));
  } else if (fsm && fsm->paused && status && status->word == StatusWord::Paused) {
    QString why = QString::fromStdString(status->reason);
    if (!why.isEmpty()) why[0] = why[0].toUpper();
    text = markup(tr("<b>%1.</b> The robot holds; the state's clock stands."),
                  why.isEmpty() ? tr("Paused") : why);
  }
  notice_->set(text, fault ? BannerKind::Fault : good ? BannerKind::Good : BannerKind::Caution);
  release_->setVisible(status && needsRelease(status->arm.safety));
  QString why;
  release_->setEnabled(models_.mayCommand(&why));
  setTip(*release_, why.isEmpty() ? release_->subtext() : why);
}

void StateCard::refresh() {
  setAge(models_.fsm.ageS(), models_.fsm.ageLevel());
  const FsmStatus* fsm = models_.fsm.status();
  const RobotStatus* status = models_.status.status();
  refreshNotice();
  const bool idle = !fsm || fsm->state.empty();
  const bool not_ready =
      status && (models_.status.word() == StatusWord::NotReady ||
                 (models_.status.word() == StatusWord::Ready && (idle || warned(*status))));
  if (fsm) refreshHeader(*fsm);
  preflight_->setVisible(not_ready);
  ticks_->setVisible(!not_ready);
  if (not_ready) {
    preflight_->setChecks(status->checks);
    setTitle(tr("Before a start"));
    const int failing = preflight_->failing(), warning = preflight_->warning();
    setInfo(failing > 0   ? tr("%1 of %2 checks fail").arg(failing).arg(preflight_->total())
            : warning > 0 ? tr("%1 checks hold, look at %2").arg(preflight_->total()).arg(warning)
                          : tr("%1 checks hold").arg(preflight_->total()));
  }
  ticks_->setRows(fsm && !not_ready ? guardRows(*fsm) : std::vector<TickList::Row>{});
  // What a paused machine has to say stands in the notice, or is Teleop.
  display_->set(fsm && !not_ready && !fsm->paused ? QString::fromStdString(fsm->display_text)
                                                  : QString{});
  refreshExits();
}

void StateCard::arrangeExits() {
  const int count = static_cast<int>(exits_.size());
  // In a low card the guards need the room.
  const int columns = count <= 1 || (count <= kExitsInOneColumn && height() >= kLow_px) ? 1 : 2;
  for (int n = 0; n < count; ++n) {
    const bool alone = columns == 2 && n == count - 1 && n % 2 == 0;
    exits_grid_->addWidget(exits_[static_cast<std::size_t>(n)], n / columns, n % columns, 1,
                           columns == 1 || alone ? 2 : 1);
  }
}

void StateCard::resizeEvent(QResizeEvent* event) {
  Tile::resizeEvent(event);
  if ((event->oldSize().height() >= kLow_px) != (height() >= kLow_px)) arrangeExits();
}

void StateCard::refreshExits() {
  const QString current = models_.fsm.current();
  const FsmInfo* info = models_.fsm.info();
  const QString key = (info ? QString::fromStdString(info->mission_uuid) : QString{}) + current;
  if (key != exits_of_) {
    exits_of_ = key;
    for (ActButton* button : exits_) button->deleteLater();
    exits_.clear();
    for (std::size_t i = 0; info && i < info->edges.size(); ++i) {
      const FsmEdgeInfo& edge = info->edges[i];
      if (QString::fromStdString(edge.from) != current ||
          static_cast<int>(exits_.size()) == kMaxExits)
        continue;
      const QString to = QString::fromStdString(edge.to);
      if (!jump_.enterable(to)) continue;
      auto* button = new ActButton(ui_, models_.fsm.label(to));
      button->setSubtext(QString::fromStdString(edge.consequence));
      button->setWrapping(true);
      connect(button, &QAbstractButton::clicked, this, [this, to] { jump_.pick(to); });
      exits_.push_back(button);
    }
    arrangeExits();
  }
  QString why;
  const bool may = models_.mayCommand(&why);
  // The checks need the room; a recording has no use for exits.
  const bool checks = !preflight_->isHidden() || models_.link.readOnly();
  const bool room = height() >= kTight_px;
  const int shown = checks || !room ? 0 : release_->isHidden() ? kMaxExits : kExitsBesideRelease;
  for (std::size_t i = 0; i < exits_.size(); ++i) {
    ActButton* button = exits_[i];
    button->setVisible(static_cast<int>(i) < shown);
    button->setEnabled(may);
    setTip(*button,
           may ? tr("%1\nThen hold to jump, below the graph.").arg(button->subtext()) : why);
  }
  exits_title_->set(exits_.empty() || shown == 0 ? QString{} : tr("Go to instead"));
}

}  // namespace kiln::gui

#include "gui/views/state_card/state_card.h"

#include <QResizeEvent>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kTall_px = 380;    // room for all words of the exits
constexpr int kMiddle_px = 240;  // room for those of two
constexpr int kTight_px = 200;   // no room for exits; they are in the graph
constexpr int kRow_px = 18;      // less of a list is nothing
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
      exits_(new ExitList(ui)) {
  auto* body = new QWidget;
  auto* column = new QVBoxLayout(body);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  release_->setKind(ActKind::Caution);
  release_->setSubtext(tr("hold 1 s; the arm stays where it is"));
  for (Banner* words : {notice_, display_}) words->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  auto* words = new WordStack(6);
  words->add(release_);  // above words that change: it must not move under the hand
  words->add(notice_);
  words->add(display_);
  words->add(ticks_, kRow_px);
  words->add(preflight_, kRow_px);
  column->addWidget(words, 1);
  column->addWidget(exits_);
  setContent(body);
  connect(exits_, &ExitList::picked, &jump_, &ForcedJump::pick);
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

void StateCard::resizeEvent(QResizeEvent* event) {
  Tile::resizeEvent(event);
  exits_->setRoom(height() >= kTall_px     ? ExitList::Room::Tall
                  : height() >= kMiddle_px ? ExitList::Room::Middle
                                           : ExitList::Room::Low);
  refreshExits();
}

void StateCard::refreshExits() {
  const QString current = models_.fsm.current();
  const FsmInfo* info = models_.fsm.info();
  const QString key = (info ? QString::fromStdString(info->mission_uuid) : QString{}) + current;
  if (key != exits_of_) {
    exits_of_ = key;
    std::vector<ExitList::Exit> exits;
    for (std::size_t i = 0; info && i < info->edges.size(); ++i) {
      const FsmEdgeInfo& edge = info->edges[i];
      const QString to = QString::fromStdString(edge.to);
      if (QString::fromStdString(edge.from) == current && jump_.enterable(to))
        exits.push_back({to, models_.fsm.label(to), QString::fromStdString(edge.consequence)});
    }
    exits_->setExits(exits);
  }
  QString why;
  (void)models_.mayCommand(&why);
  exits_->setLock(why);
  // The checks and a release need the room; a recording has no use for exits.
  const bool other = !preflight_->isHidden() || models_.link.readOnly() ||
                     (!release_->isHidden() && height() < kTall_px);
  exits_->setVisible(!other && height() >= kTight_px && !exits_->buttons().empty());
}

}  // namespace kiln::gui

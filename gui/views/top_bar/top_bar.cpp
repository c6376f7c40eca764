#include "gui/views/top_bar/top_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QPainter>
#include <cmath>

#include "gui/views/top_bar/lease_chip.h"
#include "gui/views/top_bar/status_word.h"
#include "gui/views/top_bar/stop_button.h"
#include "gui/widgets/age_badge.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kHeight_px = 48;
constexpr int kLeast_px = 936;
constexpr int kRoomForMost_px = 1264, kRoomForAll_px = 1500;
constexpr double kBatteryEmpty_v = 24.0;
constexpr double kBatteryLow_v = 26.0;
constexpr double kBatteryFull_v = 29.6;
constexpr double kSlowLink_s = 0.150;
constexpr double kVerySlowLink_s = 0.300;
constexpr double kClockLow_s = 60.0;
constexpr std::size_t kMostFigures = 4;  // of a mission; the bar has no room for more

QString clockText(double s) {
  const int whole = static_cast<int>(s);
  return QStringLiteral("%1:%2")
      .arg(whole / 60, 2, 10, QLatin1Char('0'))
      .arg(whole % 60, 2, 10, QLatin1Char('0'));
}
/// Without the "est." that stands in the name.
QString valueText(const FigureSpec& spec, double value) {
  FigureSpec bare = spec;
  bare.estimated = false;
  return QString::fromStdString(figureText(bare, value));
}
}  // namespace

TopBar::TopBar(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent),
      ui_(ui),
      models_(models),
      status_(new StatusBlock(ui, models, this)),
      lease_(new LeaseChip(ui, models.lease, this)),
      link_(new Figure(ui, tr("Link"), QStringLiteral("8888 ms · 88 %"), this)),
      age_(new Figure(ui, tr("Data age"), QStringLiteral("8.88 s"), this)),
      battery_(new Figure(ui, tr("Battery"), QStringLiteral("88.8 V"), this)),
      clock_(new Figure(ui, tr("Mission clock"), QStringLiteral("88:88 / 88:88"), this)),
      clear_(new HoldButton(ui, tr("Clear stop"), 1.0, this)),
      stop_note_(new StopNote(ui, models.stop, this)),
      stop_(new StopButton(ui, models.stop, this)) {
  setFixedHeight(kHeight_px);
  setMinimumWidth(kLeast_px);
  clock_->setRole(TextRole::Strong);
  clear_->setSubtext(tr("hold 1 s"));
  clear_->setKind(ActKind::Caution);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 1, 1, 1);
  row->setSpacing(14);
  row->addWidget(status_, 1);
  for (QWidget* widget :
       {static_cast<QWidget*>(lease_), static_cast<QWidget*>(link_), static_cast<QWidget*>(age_),
        static_cast<QWidget*>(battery_), static_cast<QWidget*>(clock_),
        static_cast<QWidget*>(clear_), static_cast<QWidget*>(stop_)}) {
    row->addWidget(widget);
  }
  QSizePolicy kept = clear_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);  // nothing moves when a STOP latches
  clear_->setSizePolicy(kept);
  stop_note_->resize(stop_note_->sizeHint());
  connect(&models_, &StationModels::aged, lease_, &LeaseChip::refresh);
  connect(clear_, &HoldButton::completed, &models_.stop, &StopModel::clear);
  for (const Model* model :
       {static_cast<const Model*>(&models_.status), static_cast<const Model*>(&models_.stop),
        static_cast<const Model*>(&models_.link_state),
        static_cast<const Model*>(&models_.lease)}) {
    connect(model, &Model::changed, this, &TopBar::refresh);
  }
  connect(&models_, &StationModels::aged, this, &TopBar::refresh);
  connect(&models_.mission, &Model::changed, this, &TopBar::makeMissionFigures);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  makeMissionFigures();
}

void TopBar::makeMissionFigures() {
  for (const MissionFigure& figure : mission_) delete figure.view;
  mission_.clear();
  auto* row = static_cast<QHBoxLayout*>(layout());
  for (const FigureSpec& spec : models_.mission.info().figures) {
    if (!spec.top_bar || mission_.size() == kMostFigures) continue;
    const QString name = QString::fromStdString(spec.label) + (spec.estimated ? tr(" est.") : "");
    const double widest = spec.high > spec.low ? spec.high : 8.8;
    auto* view = new Figure(ui_, name, valueText(spec, widest), this);
    setTip(*view, QString::fromStdString(spec.doc));
    row->insertWidget(row->indexOf(clear_), view);
    mission_.push_back({spec, view});
  }
  refresh();
  arrange();
}

QStringList TopBar::missionFigures() const {
  QStringList out;
  for (const MissionFigure& figure : mission_)
    out << QString::fromStdString(figure.spec.label) + QLatin1Char(' ') + figure.view->value();
  return out;
}

void TopBar::refreshMission(const RobotStatus& status, AgeLevel shown) {
  for (const auto& [spec, view] : mission_) {
    const kiln::Figure* figure = findFigure(status.figures, spec.id);
    const double value = figure ? figure->value : NAN;
    const bool caution = (spec.caution_below && value < *spec.caution_below) ||
                         (spec.caution_above && value > *spec.caution_above);
    view->set(valueText(spec, value),
              shown == AgeLevel::Fresh && caution ? AgeLevel::Amber : shown);
    if (spec.high > spec.low && std::isfinite(value))
      view->setBar((value - spec.low) / (spec.high - spec.low));
    else
      view->setBar(std::nullopt);
  }
}

void TopBar::refresh() {
  refreshLink();
  const AgeLevel level = models_.status.ageLevel();
  clear_->setVisible(models_.stop.latched());
  clear_->setEnabled(models_.lease.mine());
  setTip(*clear_, models_.lease.mine() ? tr("Clears the latch. Nothing moves by itself afterwards.")
                                       : tr("Clearing a stop needs the lease."));
  stop_note_->refresh();
  const RobotStatus* status = models_.status.status();
  if (!status) {
    for (Figure* figure : {battery_, clock_}) figure->set(QStringLiteral("–"), AgeLevel::None);
    return;
  }
  const AgeLevel shown = level == AgeLevel::Red ? AgeLevel::Red : AgeLevel::Fresh;
  const auto judged = [shown](bool low) {
    return shown == AgeLevel::Fresh && low ? AgeLevel::Amber : shown;
  };
  // A base that is silent tells nothing of its battery.
  battery_->set(std::isfinite(status->battery_v)
                    ? QStringLiteral("%1 V").arg(status->battery_v, 0, 'f', 1)
                    : QStringLiteral("–"),
                judged(status->battery_v < kBatteryLow_v));
  battery_->setBar((status->battery_v - kBatteryEmpty_v) / (kBatteryFull_v - kBatteryEmpty_v));
  const double left_s = status->mission_limit_s - status->mission_elapsed_s;
  clock_->set(clockText(status->mission_elapsed_s) + QStringLiteral(" / ") +
                  clockText(status->mission_limit_s),
              judged(left_s < kClockLow_s));
  clock_->setBar(status->mission_limit_s > 0 ? status->mission_elapsed_s / status->mission_limit_s
                                             : 0.0);
  refreshMission(*status, shown);
}

void TopBar::refreshLink() {
  const LinkHealth& health = models_.link_state.health();
  AgeLevel level = health.rtt_s >= kVerySlowLink_s ? AgeLevel::Red
                   : health.rtt_s >= kSlowLink_s   ? AgeLevel::Amber
                                                   : AgeLevel::Fresh;
  if (health.state == LinkState::Degraded) level = AgeLevel::Amber;
  if (!models_.link_state.usable()) {
    link_->set(health.state == LinkState::Connecting ? tr("connecting …")
               : health.state == LinkState::Refused  ? tr("refused")
                                                     : tr("lost"),
               health.state == LinkState::Connecting ? AgeLevel::None : AgeLevel::Red);
  } else if (health.robot_hears_age_s > 1.5) {
    link_->set(tr("robot is deaf"), AgeLevel::Red);
  } else {
    link_->set(QStringLiteral("%1 ms · %2 %")
                   .arg(health.rtt_s < 0 ? QStringLiteral("–")
                                         : QString::number(std::lround(1e3 * health.rtt_s)))
                   .arg(100 * health.loss, 0, 'f', 0),
               level);
  }
  setTip(*link_,
         tr("%1\nround trip of the last heartbeat; share of status messages lost lately (of about "
            "the last 50)")
             .arg(health.endpoint));
  const double age_s = models_.status.ageS();
  age_->set(age_s < 0 ? QStringLiteral("–") : ageText(age_s), models_.status.ageLevel());
}

void TopBar::arrange() {
  const bool all = width() >= kRoomForAll_px;
  const bool most = width() >= kRoomForMost_px;
  age_->setVisible(all);
  for (Figure* figure : {link_, battery_}) figure->setVisible(most);
  for (std::size_t i = 0; i < mission_.size(); ++i)
    mission_[i].view->setVisible(i == 0 ? most : all);
  // Over figures that nobody knows while it is there, and never over the key.
  stop_note_->move(stop_->x() - stop_note_->width() - 2, stop_->y());
  stop_note_->raise();
}

void TopBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

bool TopBar::event(QEvent* event) {
  const bool handled = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show) {
    layout()->activate();
    arrange();
  }
  return handled;
}

void TopBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), ui_.theme.colors().panel);
  painter.fillRect(QRect(0, height() - 1, width(), 1), ui_.theme.colors().border);
}

}  // namespace kiln::gui

#include "gui/views/replay/replay_bar.h"

#include <QFontMetrics>
#include <QHBoxLayout>
#include <QPainter>
#include <algorithm>
#include <array>

#include "gui/views/replay/time_slider.h"
#include "gui/widgets/hatch.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kHeight_px = 44, kTitle_px = 360, kTimes_px = 128, kSpeed_px = 52;
constexpr std::array<double, 8> kSpeeds{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 7.0, 10.0};
}  // namespace

ReplayBar::ReplayBar(const Ui& ui, ReplayLink& link, QWidget* parent)
    : QWidget(parent), ui_(ui), link_(link), slider_(new TimeSlider(ui)) {
  setFixedHeight(kHeight_px);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(kTitle_px, 4, 6, 4);
  row->setSpacing(4);
  back_ = button(QStringLiteral("−10 s"), tr("10 s back (Shift + ,)"), 52);
  step_back_ = button(QStringLiteral("‹"), tr("a tenth of a second back (,)"), 30);
  play_ = button(tr("Pause"), tr("play or pause (P; Space pauses)"), 68);
  step_on_ = button(QStringLiteral("›"), tr("a tenth of a second on (.)"), 30);
  forward_ = button(QStringLiteral("+10 s"), tr("10 s on (Shift + .)"), 52);
  for (ActButton* b : {back_, step_back_, play_, step_on_, forward_}) row->addWidget(b);
  row->addWidget(slider_, 1);
  row->addSpacing(kTimes_px);
  slower_ = button(QStringLiteral("−"), tr("slower ([)"), 28);
  faster_ = button(QStringLiteral("+"), tr("faster (])"), 28);
  row->addWidget(slower_);
  row->addSpacing(kSpeed_px);
  row->addWidget(faster_);
  connect(play_, &QAbstractButton::clicked, this, &ReplayBar::togglePlaying);
  connect(back_, &QAbstractButton::clicked, this, [this] { step(-kJump_s); });
  connect(step_back_, &QAbstractButton::clicked, this, [this] { step(-kStep_s); });
  connect(step_on_, &QAbstractButton::clicked, this, [this] { step(kStep_s); });
  connect(forward_, &QAbstractButton::clicked, this, [this] { step(kJump_s); });
  connect(slower_, &QAbstractButton::clicked, this, [this] { changeSpeed(-1); });
  connect(faster_, &QAbstractButton::clicked, this, [this] { changeSpeed(+1); });
  connect(slider_, &TimeSlider::wanted, this,
          [this](double s) { link_.seek(playback_.start + fromSeconds(s)); });
  connect(&link_, &ReplayLink::playbackChanged, this, &ReplayBar::show);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  show(link_.playback());
}

ActButton* ReplayBar::button(const QString& text, const QString& tip, int width) {
  auto* made = new ActButton(ui_, text);
  made->setFixedSize(width, kHeight_px - 14);
  setTip(*made, tip);
  return made;
}

void ReplayBar::togglePlaying() { link_.setPlaying(!playback_.playing); }

void ReplayBar::changeSpeed(int notches) {
  const auto nearest = std::min_element(kSpeeds.begin(), kSpeeds.end(), [this](double a, double b) {
    return std::abs(a - playback_.speed) < std::abs(b - playback_.speed);
  });
  const auto index = std::clamp<std::ptrdiff_t>(nearest - kSpeeds.begin() + notches, 0,
                                                static_cast<std::ptrdiff_t>(kSpeeds.size()) - 1);
  link_.setSpeed(kSpeeds[static_cast<std::size_t>(index)]);
}

void ReplayBar::step(double seconds) {
  // A jump keeps playing; only the small step is for looking at single frames.
  if (std::abs(seconds) < 1.0) return link_.step(seconds);
  link_.seek(playback_.position + fromSeconds(seconds));
}

void ReplayBar::show(const Playback& playback) {
  playback_ = playback;
  play_->setText(playback.playing ? tr("Pause") : playback.ended ? tr("Again") : tr("Play"));
  slower_->setEnabled(playback.speed > kSpeeds.front());
  faster_->setEnabled(playback.speed < kSpeeds.back());
  slider_->set(toSeconds(playback.position - playback.start),
               toSeconds(playback.end - playback.start));
  setTip(*this,
         playback.file + QLatin1Char('\n') + playback.run +
             (playback.problem.isEmpty() ? QString() : QLatin1Char('\n') + playback.problem));
  update();
}

QString ReplayBar::title() const {
  return playback_.problem.isEmpty() ? playback_.run : playback_.problem;
}

void ReplayBar::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), p.panel);
  QColor stripe = p.replay;
  stripe.setAlphaF(0.16);
  paintHatch(painter, rect(), stripe, 14.0, 5.0);
  painter.setPen(QPen(p.replay, 2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
  const QFont value = ui_.theme.font(TextRole::Value), small = ui_.theme.font(TextRole::Small);
  painter.setFont(value);
  painter.setPen(p.replay);
  painter.drawText(QRect(12, 0, 90, height()), Qt::AlignVCenter | Qt::AlignLeft, tr("REPLAY"));
  const int x = 12 + QFontMetrics(value).horizontalAdvance(tr("REPLAY")) + 12;
  const int room = kTitle_px - x - 10;
  painter.setFont(ui_.theme.font(TextRole::Strong));
  painter.setPen(p.text);
  painter.drawText(QRect(x, 4, room, 18), Qt::AlignVCenter | Qt::AlignLeft,
                   painter.fontMetrics().elidedText(playback_.file, Qt::ElideMiddle, room));
  painter.setFont(small);
  painter.setPen(playback_.problem.isEmpty() ? p.text : p.caution);
  painter.drawText(QRect(x, 22, room, 18), Qt::AlignVCenter | Qt::AlignLeft,
                   painter.fontMetrics().elidedText(title(), Qt::ElideRight, room));
  const double at = toSeconds(playback_.position - playback_.start);
  const double length = toSeconds(playback_.end - playback_.start);
  painter.setPen(p.text);
  painter.setFont(ui_.theme.font(TextRole::Body));
  painter.drawText(QRect(slider_->geometry().right() + 8, 0, kTimes_px, height()),
                   Qt::AlignVCenter | Qt::AlignLeft,
                   QStringLiteral("%1 / %2").arg(timeText(at), timeText(length)));
  painter.drawText(QRect(slower_->geometry().right() + 2, 0,
                         faster_->x() - slower_->geometry().right() - 4, height()),
                   Qt::AlignCenter, QStringLiteral("%1×").arg(playback_.speed));
}

}  // namespace kiln::gui

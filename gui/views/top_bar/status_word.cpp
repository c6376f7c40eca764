#include "gui/views/top_bar/status_word.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "gui/models/alone.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/hatch.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr double kGap_px = 12.0;
constexpr int kNarrow_px = 520;  // a narrower block keeps its room for the reason
constexpr int kNameless_px = 400;
constexpr int kNarrow_pct = 80;
constexpr double kNarrowWord_pt = 15.0;  // leaves the reason its room

/// "a; b · c: d" -> "a; b · c" -> "a; b" -> "a"; itself if it is one clause.
QString withoutLastClause(const QString& text) {
  int at = -1;
  for (const char* end : {"; ", " · ", ": ", ". ", ", "})
    at = std::max(at, static_cast<int>(text.lastIndexOf(QString::fromUtf8(end))));
  return at > 0 ? text.left(at) : text;
}

QString fromView(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}
}  // namespace

StatusBlock::StatusBlock(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setFixedHeight(46);
  const auto repaint = qOverload<>(&QWidget::update);
  connect(&models_.status, &Model::changed, this, repaint);
  connect(&models_.fsm, &Model::changed, this, repaint);
  connect(&models_.link_state, &Model::changed, this, repaint);
  connect(&models_, &StationModels::aged, this, repaint);
  connect(&ui_.theme, &Theme::changed, this, repaint);
}

QString StatusBlock::word() const { return fromView(toString(models_.status.word())); }

QString StatusBlock::reason() const {
  const StatusWord word = models_.status.word();
  const LinkHealth& link = models_.link_state.health();
  if (word == StatusWord::NoLink && models_.link.readOnly()) return tr("nothing recorded here");
  const RobotStatus* last = models_.status.status();
  if (last && (word == StatusWord::NoLink || link.state == LinkState::Lost))
    return tr("As last heard %1; %2").arg(whatItDoesAlone(*last), link.reason);
  if (!last) return link.reason.isEmpty() ? tr("connecting …") : link.reason;
  const RobotStatus& status = *last;
  if (!status.reason.empty()) return QString::fromStdString(status.reason);
  const FsmStatus* fsm = models_.fsm.status();
  if (!fsm) return {};
  const QString label = models_.fsm.label(models_.fsm.current());
  return fsm->display_text.empty()
             ? label
             : label + QStringLiteral(" · ") + QString::fromStdString(fsm->display_text);
}

QColor StatusBlock::wordColor() const {
  const Palette& p = ui_.theme.colors();
  switch (models_.status.word()) {
    case StatusWord::NoLink:
    case StatusWord::Stopped:
      return p.fault;
    case StatusWord::NotReady:
    case StatusWord::Paused:
      return p.caution;
    case StatusWord::Teleop:
      return p.manual;
    default:
      return p.text;
  }
}

double StatusBlock::paintName(QPainter& painter) {
  if (width() < kNameless_px) return 4;
  const Palette& p = ui_.theme.colors();
  QFont brand = ui_.theme.font(TextRole::Value);
  brand.setWeight(QFont::Bold);
  painter.setFont(brand);
  painter.setPen(p.text);
  double x = 4;
  painter.drawText(QRectF(x, 0, 80, height()), Qt::AlignVCenter | Qt::AlignLeft,
                   QStringLiteral("KILN"));
  x += QFontMetricsF(brand).horizontalAdvance(QStringLiteral("KILN")) + kGap_px;
  const QString name = models_.status.robotName();
  painter.setFont(ui_.theme.font(TextRole::Body));
  painter.setPen(p.dim);
  painter.drawText(QRectF(x, 0, 120, height()), Qt::AlignVCenter | Qt::AlignLeft, name);
  return x + QFontMetricsF(painter.font()).horizontalAdvance(name) + (name.isEmpty() ? 0 : kGap_px);
}

double StatusBlock::paintChip(QPainter& painter, double x) {
  const Palette& p = ui_.theme.colors();
  const RobotStatus* status = models_.status.status();
  if (!status) return x;
  const Environment environment = status->environment;
  const QString text = environment == Environment::Sim
                           ? (width() < kNarrow_px ? tr("SIM") : tr("SIMULATOR"))
                       : environment == Environment::Replay ? tr("REPLAY")
                                                            : tr("LIVE");
  const QColor color = environment == Environment::Sim      ? p.sim
                       : environment == Environment::Replay ? p.replay
                                                            : p.text;
  QFont font = ui_.theme.font(TextRole::Small);
  font.setWeight(QFont::DemiBold);
  const QRectF chip(x, height() / 2.0 - 11, QFontMetricsF(font).horizontalAdvance(text) + 20, 22);
  QPainterPath outline;
  outline.addRoundedRect(chip, 3, 3);
  if (environment != Environment::Live) {
    QColor stripe = color;
    stripe.setAlphaF(0.22);
    painter.save();
    painter.setClipPath(outline);
    paintHatch(painter, chip, stripe, 9.0, 3.0);
    painter.restore();
  }
  painter.setPen(QPen(color, 1.4));
  painter.drawPath(outline);
  painter.setFont(font);
  painter.drawText(chip, Qt::AlignCenter, text);
  return chip.right() + kGap_px + 4;
}

void StatusBlock::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  double x = paintChip(painter, paintName(painter));
  QFont large = ui_.theme.font(TextRole::Word);
  if (width() < kNarrow_px) large.setPointSizeF(kNarrowWord_pt);
  painter.setFont(large);
  painter.setPen(wordColor());
  painter.drawText(QRectF(x, 0, width() - x, height()), Qt::AlignVCenter | Qt::AlignLeft, word());
  x += QFontMetricsF(large).horizontalAdvance(word()) + kGap_px;
  painter.setPen(ui_.theme.colors().text);
  const QString text = reason();
  setTip(*this, text);
  reason_room_px_ = static_cast<int>(width() - x - 6);
  paintFitted(painter, QRectF(x, 0, reason_room_px_, height()), Qt::AlignVCenter | Qt::AlignLeft,
              fittedReason());
}

FittedText StatusBlock::fittedReason() const {
  const QFont body = ui_.theme.font(TextRole::Body), small = ui_.theme.font(TextRole::Small);
  for (QString text = reason();;) {
    FittedText out = fitText(text, {body, small}, reason_room_px_, 2);
    if (!out.whole) out = fitText(text, {small, condensed(small, kNarrow_pct)}, reason_room_px_, 3);
    // Rather without its last clause than cut in the middle of a word.
    const QString shorter = withoutLastClause(text);
    const int most_px = height() / std::max(1, static_cast<int>(out.lines.size()));
    out.line_px = std::min(out.line_px, most_px);  // three lines stand close
    if (out.whole || shorter == text) return out;
    text = shorter;
  }
}

}  // namespace kiln::gui

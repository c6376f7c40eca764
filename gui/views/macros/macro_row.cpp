#include "gui/views/macros/macro_row.h"

#include <QPainter>
#include <QPainterPath>
#include <QStringList>
#include <algorithm>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kHeight_px = 41, kPad_px = 9, kRestart_px = 34;
}

MacroRow::MacroRow(const Ui& ui, MacroInfo macro, QWidget* parent)
    : HoldButton(ui, QString::fromStdString(macro.name), 0.0, parent),
      macro_(std::move(macro)),
      restart_(new HoldButton(ui, QStringLiteral("↺"), 0.0)),
      hint_(tr("hold to run")) {
  setFocusPolicy(Qt::TabFocus);
  setTip(*this, tr("%1\nGoes on with the step in which it was let go.")
                    .arg(QString::fromStdString(macro_.doc)));
  restart_->setFocusPolicy(Qt::TabFocus);
  restart_->setFixedSize(kRestart_px, kHeight_px);
  setTip(*restart_, tr("hold to run %1 from its first step").arg(text()));
}

QString MacroRow::summary(const MacroInfo& macro) {
  QStringList parts{tr("%1 s").arg(macro.duration_s, 0, 'f', 0)};
  if (!macro.uses.empty()) parts << QString::fromStdString(macro.uses);
  if (!macro.start_condition.empty()) parts << QString::fromStdString(macro.start_condition);
  return parts.join(QStringLiteral(" · "));
}

void MacroRow::setStatus(const MacroStatus& status) {
  const bool mine = status.running == macro_.name;
  progress_ = mine ? std::clamp(status.progress, 0.0, 1.0) : 0.0;
  step_ = mine ? tr("step %1 of %2 · %3")
                     .arg(status.step)
                     .arg(status.steps)
                     .arg(QString::fromStdString(status.step_text))
               : QString();
  update();
}

void MacroRow::setHint(const QString& hint) {
  if (hint == hint_) return;
  hint_ = hint;
  update();
}

QSize MacroRow::sizeHint() const { return {200, kHeight_px}; }

void MacroRow::paintEvent(QPaintEvent*) {
  const Palette& p = ui().theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool running = !step_.isEmpty();
  QPainterPath outline;
  const QRectF frame = QRectF(rect()).adjusted(1, 1, -1, -1);
  outline.addRoundedRect(frame, 4, 4);
  painter.fillPath(outline, !isEnabled()   ? p.panel
                            : isEngaged()  ? p.manual_fill
                            : underMouse() ? mixed(p.raised, p.text, 0.07)
                                           : p.raised);
  if (running) {
    painter.save();
    painter.setClipPath(outline);
    painter.fillRect(QRectF(frame.left(), frame.bottom() - 4, frame.width() * progress_, 4),
                     p.manual);
    painter.restore();
  }
  painter.setPen(QPen(isEngaged() || running ? p.manual
                      : isEnabled()          ? p.border
                                             : p.grid,
                      isEngaged() ? 2.0 : 1.2));
  painter.drawPath(outline);
  const QRectF text = frame.adjusted(kPad_px, 2, -kPad_px, -4);
  const QFont strong = ui().theme.font(TextRole::Body), small = ui().theme.font(TextRole::Small);
  painter.setFont(small);
  const QString hint = isEngaged() ? tr("release to cancel") : hint_;
  const double hint_width = QFontMetricsF(small).horizontalAdvance(hint);
  painter.setPen(isEngaged() ? p.manual : isEnabled() ? p.dim : p.faint);
  painter.drawText(text, Qt::AlignRight | Qt::AlignTop, hint);
  // What it does and where it may start needs the whole width: the hint stands beside the name.
  const int room = static_cast<int>(text.width());
  painter.setPen(isEnabled() ? p.dim : p.faint);
  paintFitted(painter, text, Qt::AlignLeft | Qt::AlignBottom,
              fitText(line(), {small, condensed(small, 88)}, room, 1));
  painter.setPen(isEnabled() ? p.text : p.faint);
  paintFitted(painter, text, Qt::AlignLeft | Qt::AlignTop,
              fitText(QString::fromStdString(macro_.name), {strong, small},
                      room - static_cast<int>(hint_width) - 8, 1));
}

}  // namespace kiln::gui
